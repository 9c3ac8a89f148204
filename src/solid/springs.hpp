// Linear springs between nodes.
#pragma once

#include <span>
#include <vector>

#include "linalg/csr_matrix.hpp"
#include "model/model.hpp"

namespace carom {

/// Springs between two nodes a and b each, with the constant 3 x 3 stiffness k of Spring:
///   f_a = k (u_a - u_b) = -f_b,  W = 1/2 (u_a - u_b) . k (u_a - u_b).
/// They have no mass. W feeds the ledger's `strain`. Their forces are linear in u, so that the energy-momentum force is
/// that of the mean displacement, and balance in moment about the reference positions.
class Springs {
 public:
  explicit Springs(std::vector<Spring> springs) : springs_(std::move(springs)) {}

  bool empty() const { return springs_.empty(); }
  const std::vector<Spring>& all() const { return springs_; }
  /// f += scale K u; also the action of the tangent.
  void add_force(double scale, std::span<const double> u, std::span<double> f) const;
  double energy(std::span<const double> u) const;
  /// Adds to K, which has entries for all pairs of nodes of a spring (node_graph).
  void add_tangent(CsrMatrix& K) const;
  void add_tangent_diagonal(std::span<double> diagonal) const;

 private:
  std::vector<Spring> springs_;
};

}  // namespace carom
