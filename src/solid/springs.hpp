// Linear springs between nodes.
#pragma once

#include <span>
#include <vector>

#include "model/model.hpp"
#include "solid/contributor.hpp"

namespace carom {

/// Springs between two nodes a and b each, with the constant 3 x 3 stiffness k of Spring:
///   f_a = k (u_a - u_b) = -f_b,  W = 1/2 (u_a - u_b) . k (u_a - u_b).
/// They have no mass. W feeds the ledger's `strain`. Their forces are linear in u, so that the energy-momentum force is
/// that of the mean displacement, and balance in moment about the reference positions.
class Springs : public Contributor {
 public:
  explicit Springs(std::vector<Spring> springs) : springs_(std::move(springs)) {}

  const std::vector<Spring>& all() const { return springs_; }

  bool empty() const override { return springs_.empty(); }
  bool is_linear() const override { return true; }
  std::vector<std::vector<Index>> links() const override;
  void add_force(std::span<const double> u, const PointStep& step, std::span<double> f, SolidEnergies* energies,
                 std::span<double> end) const override;
  void add_discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1,
                                   std::span<double> f) const override;
  void add_tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                          const PointStep& step) const override;
  void add_tangent(std::span<const double> u, const PointStep& step, CsrMatrix& K) const override;
  void add_tangent_diagonal(std::span<const double> u, const PointStep& step,
                            std::span<double> diagonal) const override;

 private:
  /// f += scale K u
  void add_scaled(double scale, std::span<const double> u, std::span<double> f) const;

  std::vector<Spring> springs_;
};

}  // namespace carom
