// External forces as fixed vectors times functions of time.
#pragma once

#include <vector>

#include "model/model.hpp"

namespace carom {

/// factor(t) x force on the dofs of some nodes.
struct LoadVector {
  std::vector<Index> nodes;
  std::vector<Vec3> force;  ///< one per node
  TimeFunction factor;
};

/// One vector per nodal force and pressure of the model. Nodal forces as they are; pressure: f_a = -p integral of
/// N_a n dA over the reference facets, exact; dA is measured as Surface says. Throws CaseError for a pressure on a
/// single node that is not the end of one bar.
std::vector<LoadVector> make_loads(const Model& model);
/// The gravity loads of the model; they act on the mass of the scheme.
std::vector<Gravity> gravity_loads(const Model& model);

}  // namespace carom
