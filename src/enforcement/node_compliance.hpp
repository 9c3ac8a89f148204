// The motion of contact nodes under forces on contact nodes, for rows that move over bodies whose operator stays.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rows/compliance.hpp"
#include "rows/delassus.hpp"
#include "state/growth.hpp"

namespace carom {

/// C = E^T A^-1 E, E the unit vectors of the dofs of some nodes. Rows that slide are other combinations of the same
/// nodes at every iterate, so that W = G A^-1 G^T = G_E C G_E^T costs no solve. Only a node that takes part for the
/// first time costs three solves, whose results are kept until forget().
class NodeCompliance {
 public:
  /// The largest number n of nodes that are taken in: each takes 36 n bytes, and all of them as much as a dense W may
  /// take.
  static constexpr std::size_t most_nodes = 7700;
  static_assert(36 * most_nodes * most_nodes <= Delassus::most_bytes);

  /// capacity: of nodes.
  explicit NodeCompliance(std::size_t capacity = most_nodes) : capacity_(capacity) {}

  /// Forgets all, since another operator A is to come.
  void forget();
  /// Takes in the nodes of the chosen rows. Returns false, and does nothing, when there would be too many.
  bool extend(const ConstraintRows& rows, std::span<const std::size_t> chosen, std::size_t dof_count,
              const InverseOperator& inverse);
  /// The order in which the nodes came. A compliance that grows in the same order has the same bits.
  const Growth& growth() const { return growth_; }
  /// Makes this compliance the one that has grown in the given order. Returns true when it was another one.
  bool grow_as(const Growth& growth, std::size_t dof_count, const InverseOperator& inverse);
  /// W of the chosen rows, whose nodes have been taken in, dense. Row chosen[i] has components[i] components (1: the
  /// normal; 3); the entries of others are zero. Throws TooManyRows.
  Delassus compliance(const ConstraintRows& rows, std::span<const std::size_t> chosen,
                      std::span<const std::size_t> components) const;
  /// y += C f on the nodes, for a force that acts on them.
  void add_motion(std::span<const double> f, std::span<double> y) const;

 private:
  void add(std::span<const Index> missing, std::size_t dof_count, const InverseOperator& inverse);

  std::size_t capacity_;
  Growth growth_;             ///< the nodes, in the order in which they came
  std::vector<Index> place_;  ///< of each node of the mesh in nodes_, -1: not there
  Compliance of_dofs_;        ///< in the order of the nodes
};

}  // namespace carom
