// What acts between nodes beside the cells.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "linalg/csr_matrix.hpp"
#include "solid/point_step.hpp"

namespace carom {

/// One kind of what a Solid sums besides its cells: springs, cohesive zones, rigid bodies that turn. It adds itself to
/// every sum; a Solid knows nothing else of it. A new one is a class, and a line in Solid::Parts::contributors.
class Contributor {
 public:
  virtual ~Contributor() = default;

  /// True when there is nothing of the kind: it is left out of all sums.
  virtual bool empty() const = 0;
  /// True when its forces are linear in u.
  virtual bool is_linear() const = 0;
  /// Nodes that act on each other, a list for each piece: all pairs of a list have entries in the tangent.
  virtual std::vector<std::vector<Index>> links() const = 0;
  /// Mass that stands at nodes.
  virtual std::vector<std::pair<Index, double>> masses() const { return {}; }
  /// Numbers of history, and where they begin in that of a step.
  virtual std::size_t history_size() const { return 0; }
  virtual void place_history(std::size_t /*first*/) {}

  /// f += F(u) for the step that ends at u; adds what is stored and has been dissipated unless null; the history at the
  /// end of the step goes to `end` unless it is empty.
  virtual void add_force(std::span<const double> u, const PointStep& step, std::span<double> f, SolidEnergies* energies,
                         std::span<double> end) const = 0;
  /// Adds the energy-momentum force of a step from u_0 to u_1 (Solid::discrete_gradient_force).
  virtual void add_discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1,
                                           std::span<double> f) const = 0;
  /// y += K(u) x
  virtual void add_tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                                  const PointStep& step) const = 0;
  /// Adds K(u) to a matrix that has entries for the links.
  virtual void add_tangent(std::span<const double> u, const PointStep& step, CsrMatrix& K) const = 0;
  virtual void add_tangent_diagonal(std::span<const double> u, const PointStep& step,
                                    std::span<double> diagonal) const = 0;
  /// How far its tangent is another one at u_1 than at u_0 (Solid::largest_change); 0 where it is linear.
  virtual double largest_change(std::span<const double> /*u_0*/, std::span<const double> /*u_1*/) const { return 0.0; }
};

}  // namespace carom
