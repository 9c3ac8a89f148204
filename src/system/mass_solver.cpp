#include "system/mass_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "parallel/threads.hpp"

namespace carom {

MassSolver::MassSolver(const System& system) : system_(system) {
  if (system.mass.kind() == MassKind::lumped) return;
  const std::vector<double>& m = system.mass.node_diagonal();
  const std::vector<bool>& fixed = system.supports.fixed();
  inverse_diagonal_.resize(fixed.size());
  for (std::size_t i = 0; i < fixed.size(); ++i)
    inverse_diagonal_[i] = fixed[i] ? 1.0 : m[i / 3] > 0.0 ? 1.0 / m[i / 3] : 0.0;
  rhs_.resize(fixed.size());
  free_.resize(fixed.size());
}

MassSolver::~MassSolver() = default;

void MassSolver::factorise() {
  constexpr std::size_t most_dofs = 500'000;
  if (factors_ || system_.mass.kind() == MassKind::lumped || rhs_.size() > most_dofs) return;
  auto factors = make_effective_solver(system_, SolverKind::cholesky);
  const std::vector<double> at_rest(rhs_.size(), 0.0);
  if (factors->prepare(1.0, 0.0, at_rest).empty()) factors_ = std::move(factors);
}

std::string MassSolver::name() const {
  return system_.mass.kind() == MassKind::lumped ? "lumped mass, no solve" : "conjugate gradients on the mass";
}

int MassSolver::solve(std::span<const double> f, std::span<double> a) {
  const std::vector<bool>& fixed = system_.supports.fixed();
  const std::size_t n = fixed.size();
  if (system_.mass.kind() == MassKind::lumped) {
    const std::vector<double>& m = system_.mass.node_diagonal();
    parallel_each(n, [&](std::size_t i) {
      if (!fixed[i]) a[i] = m[i / 3] > 0.0 ? f[i] / m[i / 3] : 0.0;
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
  if (factors_) {
    const bool is_solved = factors_->invert(rhs_, 1).converged;
    for (std::size_t i = 0; i < n; ++i) {
      if (!fixed[i]) a[i] = rhs_[i];
    }
    return is_solved ? 0 : -1;
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

ContactOperator mass_operator(const System& system, MassSolver& solver) {
  const std::vector<bool>& fixed = system.supports.fixed();
  const std::size_t n = fixed.size();
  ContactOperator out;
  out.inverse = [&solver, rhs = std::vector<double>()](std::span<double> b) mutable {
    rhs.assign(b.begin(), b.end());
    std::fill(b.begin(), b.end(), 0.0);
    solver.solve(rhs, b);
  };
  if (system.mass.kind() == MassKind::lumped) {
    std::vector<double> inverse(n);
    const std::vector<double>& m = system.mass.node_diagonal();
    for (std::size_t i = 0; i < n; ++i) inverse[i] = fixed[i] || m[i / 3] == 0.0 ? 0.0 : 1.0 / m[i / 3];
    out.delassus = [inverse = std::move(inverse)](const ConstraintRows& rows, const std::vector<std::size_t>& chosen) {
      return make_delassus(rows, chosen, inverse);
    };
    return out;
  }
  out.delassus = [n, &solver, invert = out.inverse](const ConstraintRows& rows,
                                                    const std::vector<std::size_t>& chosen) {
    const auto solve = [&](std::span<double> b, int columns) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) invert(b.subspan(k * n, n));
    };
    return make_delassus(rows, chosen, n, {solve, solver.halves()});
  };
  return out;
}

}  // namespace carom
