#include "schemes/mass_solver.hpp"

#include <cmath>

#include "parallel/threads.hpp"

namespace carom {

MassSolver::MassSolver(const System& system) : system_(system) {
  const std::vector<double>& m = system.mass.node_diagonal();
  const std::vector<bool>& fixed = system.supports.fixed();
  inverse_diagonal_.resize(fixed.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) inverse_diagonal_[i] = fixed[i] ? 1.0 : 1.0 / m[i / 3];
  rhs_.resize(fixed.size());
  free_.resize(fixed.size());
}

int MassSolver::solve(std::span<const double> f, std::span<double> a) {
  const std::vector<bool>& fixed = system_.supports.fixed();
  const std::size_t n = fixed.size();
  if (system_.mass.kind() == MassKind::lumped) {
    parallel_each(n, [&](std::size_t i) {
      if (!fixed[i]) a[i] = f[i] * inverse_diagonal_[i];
    });
    return 0;
  }
  // Prescribed accelerations go to the right-hand side; the unknown vector is zero there.
  for (std::size_t i = 0; i < n; ++i) free_[i] = fixed[i] ? a[i] : 0.0;
  system_.mass.apply(free_, rhs_);
  for (std::size_t i = 0; i < n; ++i) {
    rhs_[i] = fixed[i] ? 0.0 : f[i] - rhs_[i];
    free_[i] = fixed[i] ? 0.0 : a[i];
  }
  const LinearOperator M = [&](std::span<const double> x, std::span<double> y) {
    system_.mass.apply(x, y);
    for (std::size_t i = 0; i < n; ++i) {
      if (fixed[i]) y[i] = x[i];
    }
  };
  const CgResult result = cg_.solve(M, inverse_diagonal_, rhs_, free_, 1e-15, 0.0, 200);
  for (std::size_t i = 0; i < n; ++i) {
    if (!fixed[i]) a[i] = free_[i];
  }
  // 1e-15 asks for round-off; a stagnation just above it is as good, a residual above 1e-12 is not.
  return result.converged || result.residual <= 1e-12 * std::sqrt(dot(rhs_, rhs_)) ? result.iterations : -1;
}

}  // namespace carom
