// Mass of the solids: consistent or lumped.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "linalg/csr_matrix.hpp"
#include "parallel/holding.hpp"

namespace carom {

enum class MassKind : std::uint8_t { consistent, lumped };

/// M = sum over cells of the integral of rho N_a N_b, the same for the three components of a node, so that one scalar
/// matrix of nodes serves (consistent), or its diagonal scaled to the exact mass of each cell (lumped, Hinton, Rock and
/// Zienkiewicz 1976). Nodes without mass (clamped walls of interface cells) have zero rows.
class Mass {
 public:
  /// Consistent: nodes x nodes, entries are masses.
  explicit Mass(CsrMatrix node_matrix);
  /// Lumped: the masses of the nodes.
  explicit Mass(std::vector<double> node_masses);

  MassKind kind() const { return kind_; }
  /// y = M x, dof vectors of 3 x nodes entries, x y z of a node together. Threaded, same bits for any thread count.
  void apply(std::span<const double> x, std::span<double> y) const { combine(1.0, x, 0.0, y); }
  /// y = m M x + c y, the same way; y is not read where c = 0.
  void combine(double m, std::span<const double> x, double c, std::span<double> y) const;
  /// The same at the nodes that this rank holds; x is right there, and at the nodes around its own ones. All ranks call
  /// it.
  void combine(double m, std::span<const double> x, double c, std::span<double> y, const Holding& nodes) const;
  /// (M x) at a node.
  Vec3 at_node(std::size_t n, std::span<const double> x) const {
    if (kind_ == MassKind::lumped)
      return {diagonal_[n] * x[3 * n], diagonal_[n] * x[3 * n + 1], diagonal_[n] * x[3 * n + 2]};
    Vec3 sum{};
    for (auto k = static_cast<std::size_t>(matrix_.row_begin[n]);
         k < static_cast<std::size_t>(matrix_.row_begin[n + 1]); ++k) {
      const std::size_t column = 3 * static_cast<std::size_t>(matrix_.column[k]);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += matrix_.value[k] * x[column + i];
    }
    return sum;
  }
  /// Diagonal of M, one entry per node.
  const std::vector<double>& node_diagonal() const { return diagonal_; }
  /// f += M 1 times a uniform acceleration at some nodes: the force of gravity, under which every free body falls with
  /// a = g.
  void add_gravity(const Vec3& acceleration, EntryRange nodes, std::span<double> f) const;
  /// The node matrix of a consistent mass.
  const CsrMatrix& node_matrix() const { return matrix_; }
  /// Sum of all entries: the total mass.
  double total() const;

 private:
  void combine(double m, std::span<const double> x, double c, std::span<double> y, EntryRange range) const;

  MassKind kind_;
  CsrMatrix matrix_;  ///< empty when lumped
  std::vector<double> diagonal_;
  std::vector<double> row_sums_;  ///< likewise
};

}  // namespace carom
