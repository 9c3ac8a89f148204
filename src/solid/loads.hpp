// External forces as fixed vectors times functions of time.
#pragma once

#include <span>
#include <vector>

#include "model/model.hpp"
#include "solid/mass.hpp"

namespace carom {

/// factor(t) x force on the dofs of some nodes.
struct LoadVector {
  std::vector<Index> nodes;
  std::vector<Vec3> force;  ///< one per node
  TimeFunction factor;
};

/// The external forces of a model.
class Loads {
 public:
  explicit Loads(const Model& model);

  bool empty() const { return nodes_.empty(); }
  /// The nodes that they may act on, increasing: all of them under gravity.
  const std::vector<Index>& nodes() const { return nodes_; }
  /// f = external force at time t (nodal forces, pressures, gravity); overwrites f, where nodes are shared out at those
  /// that this rank holds (null: they are not). Gravity acts on the mass that the scheme uses.
  void force(double t, const Mass& mass, std::span<double> f, JumpSide side = JumpSide::after,
             const Holding* shared = nullptr) const;

 private:
  std::vector<LoadVector> vectors_;
  std::vector<Gravity> gravity_;
  std::vector<Index> nodes_;
};

/// One vector per nodal force and pressure of the model. Nodal forces as they are; pressure: f_a = -p integral of
/// N_a n dA over the reference facets, exact; dA is measured as Surface says. Throws CaseError for a pressure on a
/// single node that is not the end of one bar.
std::vector<LoadVector> make_loads(const Model& model);
/// The shares that nodes have of a total force: of the area of a surface, integral of N_a dA over its faces, which
/// makes the traction uniform (a face that is not flat counts by its mean plane), or of the mass of the model's cells,
/// lumped as MassKind::lumped is. 1 in all.
std::vector<double> area_shares(const Mesh& mesh, const Surface& surface, std::span<const Index> nodes);
std::vector<double> mass_shares(const Model& model, std::span<const Index> nodes);
/// The gravity loads of the model; they act on the mass of the scheme.
std::vector<Gravity> gravity_loads(const Model& model);

}  // namespace carom
