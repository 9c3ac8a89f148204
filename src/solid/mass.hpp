// Mass of the solids: consistent or lumped.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linalg/csr_matrix.hpp"

namespace carom {

enum class MassKind : std::uint8_t { consistent, lumped };

/// M = sum over cells of the integral of rho N_a N_b, the same for the three components of a node, so that one scalar
/// matrix of nodes serves (consistent), or its diagonal scaled to the exact mass of each cell (lumped, Hinton, Rock and
/// Zienkiewicz 1976). Nodes without mass (clamped walls of interface cells) have zero rows.
class Mass {
 public:
  /// node_matrix: nodes x nodes, entries are masses. For `lumped` only its diagonal is kept.
  Mass(MassKind kind, CsrMatrix node_matrix);

  MassKind kind() const { return kind_; }
  /// y = M x, dof vectors of 3 x nodes entries, x y z of a node together. Threaded, same bits for any thread count.
  void apply(std::span<const double> x, std::span<double> y) const;
  /// Diagonal of M, one entry per node.
  const std::vector<double>& node_diagonal() const { return diagonal_; }
  /// f += M 1 times a uniform acceleration: the force of gravity, under which every free body falls with a = g.
  void add_gravity(const Vec3& acceleration, std::span<double> f) const;
  /// The node matrix (diagonal matrix when lumped).
  const CsrMatrix& node_matrix() const { return matrix_; }
  /// Sum of all entries: the total mass.
  double total() const;

 private:
  MassKind kind_;
  CsrMatrix matrix_;
  std::vector<double> diagonal_;
  std::vector<double> row_sums_;
};

}  // namespace carom
