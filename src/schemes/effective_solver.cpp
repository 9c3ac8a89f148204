#include "schemes/effective_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "linalg/cholesky.hpp"
#include "linalg/conjugate_gradients.hpp"
#include "linalg/dense.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

bool acts(const RowTangent& D) {
  return std::any_of(D.begin(), D.end(), [](double d) { return d != 0.0; });
}

Vec3 multiply(const RowTangent& D, const Vec3& w) {
  return {D[0] * w[0] + D[1] * w[1] + D[2] * w[2], D[3] * w[0] + D[4] * w[1] + D[5] * w[2],
          D[6] * w[0] + D[7] * w[1] + D[8] * w[2]};
}

/// The tangent as conjugate gradients can take it: where sliding couples the tangential force to the normal
/// displacement and nothing back, the coupling is left out. The iteration on the contact state then converges linearly.
RowTangent without_one_way_coupling(RowTangent D) {
  if (D[1] != D[3] || D[2] != D[6]) D[1] = D[2] = D[3] = D[6] = 0.0;
  return D;
}

/// Jacobi-preconditioned conjugate gradients on the whole operator, contact rows included.
class CgSolver final : public EffectiveSolver {
 public:
  explicit CgSolver(const System& system)
      : system_(system),
        zero_(system.solid.dof_count(), 0.0),
        stiffness_diagonal_(system.solid.tangent_diagonal(zero_)),
        inverse_diagonal_(zero_.size()),
        work_(zero_.size()),
        tangents_(system.contact.rows().size()) {}

  void prepare(double s) override { s_ = s; }

  LinearSolveReport solve(std::span<const double> b, const std::vector<RowTangent>& D, double absolute,
                          std::span<double> x) override {
    std::transform(D.begin(), D.end(), tangents_.begin(), without_one_way_coupling);
    set_diagonal(tangents_);
    std::fill(x.begin(), x.end(), 0.0);
    const LinearOperator A = [&](std::span<const double> in, std::span<double> out) { apply(tangents_, in, out); };
    const int most = 1000 + static_cast<int>(10.0 * std::sqrt(static_cast<double>(x.size())));
    const CgResult result = cg_.solve(A, inverse_diagonal_, b, x, 1e-14, absolute, most);
    return {result.converged, result.iterations, result.residual};
  }

  std::string name() const override { return "conjugate gradients"; }

 private:
  void apply(const std::vector<RowTangent>& D, std::span<const double> x, std::span<double> y) {
    const std::vector<bool>& fixed = system_.supports.fixed();
    system_.solid.tangent_action(zero_, x, y);
    system_.mass.apply(x, work_);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = work_[i] + s_ * y[i];
    const ConstraintRows& rows = system_.contact.rows();
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (acts(D[r])) rows.scatter(r, multiply(D[r], rows.relative(r, x)), y);
    }
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (fixed[i]) y[i] = x[i];
    }
  }

  void set_diagonal(const std::vector<RowTangent>& D) {
    const std::vector<double>& m = system_.mass.node_diagonal();
    const std::vector<bool>& fixed = system_.supports.fixed();
    for (std::size_t i = 0; i < inverse_diagonal_.size(); ++i) {
      inverse_diagonal_[i] = m[i / 3] + s_ * stiffness_diagonal_[i];
    }
    const ConstraintRows& rows = system_.contact.rows();
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (Index k = rows.begin[r]; k < rows.begin[r + 1]; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          const Vec3 frame{rows.normal[r][c], rows.tangent_1[r][c], rows.tangent_2[r][c]};
          const Vec3 s = multiply(D[r], frame);
          inverse_diagonal_[3 * static_cast<std::size_t>(rows.node[k]) + c] +=
              rows.weight[k] * rows.weight[k] * (frame[0] * s[0] + frame[1] * s[1] + frame[2] * s[2]);
        }
      }
    }
    for (std::size_t i = 0; i < inverse_diagonal_.size(); ++i) {
      inverse_diagonal_[i] = fixed[i] ? 1.0 : 1.0 / inverse_diagonal_[i];
    }
  }

  const System& system_;
  std::vector<double> zero_, stiffness_diagonal_, inverse_diagonal_, work_;
  std::vector<RowTangent> tangents_;
  double s_ = 0.0;
  ConjugateGradients cg_;
};

/// One component of one row: a column of G^T.
struct RowComponent {
  std::size_t row;
  std::size_t component;
};

/// A = M + s K factored once; contact by the Schur complement on its active rows (Woodbury):
///   (1 + S D) w = G A^-1 b,  x = A^-1 (b - G^T D w),  S = G A^-1 G^T,
/// where S grows by a row and a column when a component of a row first becomes active; only S is kept.
class CholeskySolver final : public EffectiveSolver {
 public:
  explicit CholeskySolver(const System& system) : system_(system), known_(3 * system.contact.rows().size(), -1) {
    const std::vector<bool>& fixed = system.supports.fixed();
    compressed_of_.assign(fixed.size(), -1);
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      if (fixed[i]) continue;
      compressed_of_[i] = static_cast<Index>(free_.size());
      free_.push_back(i);
    }
    const std::vector<double> zero(fixed.size(), 0.0);
    stiffness_ = system.solid.tangent(zero);
  }

  void prepare(double s) override {
    if (factor_ && s == s_) return;
    s_ = s;
    factor_.emplace(assemble());
    components_.clear();
    schur_.clear();
    std::fill(known_.begin(), known_.end(), -1);
  }

  LinearSolveReport solve(std::span<const double> b, const std::vector<RowTangent>& D, double /*absolute*/,
                          std::span<double> x) override {
    back_substitute(b, x);
    const std::vector<RowComponent> active = active_components(D);
    if (active.empty()) return {true, 1, 0.0};
    std::vector<double> rhs(b.begin(), b.end());
    subtract_contact(D, active, contact_displacements(D, active, x), rhs);
    back_substitute(rhs, x);
    return {true, 1, 0.0};
  }

  std::string name() const override { return "Cholesky factorisation"; }

 private:
  CsrMatrix assemble() const;
  std::vector<RowComponent> active_components(const std::vector<RowTangent>& D) const;
  void back_substitute(std::span<const double> b, std::span<double> x) const;
  void extend_schur(const std::vector<RowComponent>& active);
  std::vector<double> contact_displacements(const std::vector<RowTangent>& D, const std::vector<RowComponent>& active,
                                            std::span<const double> x);
  void subtract_contact(const std::vector<RowTangent>& D, const std::vector<RowComponent>& active,
                        const std::vector<double>& w, std::span<double> rhs) const;

  const System& system_;
  CsrMatrix stiffness_;
  std::vector<std::size_t> free_;     ///< dof of each unknown
  std::vector<Index> compressed_of_;  ///< unknown of each dof, -1 when fixed
  std::optional<Cholesky> factor_;
  std::vector<RowComponent> components_;    ///< those that S knows
  std::vector<int> known_;                  ///< position in S of each row component, -1 when it is not there yet
  std::vector<std::vector<double>> schur_;  ///< lower triangle of S: row i has i + 1 entries
  double s_ = 0.0;
};

CsrMatrix CholeskySolver::assemble() const {
  const CsrMatrix& M = system_.mass.node_matrix();
  CsrMatrix A;
  A.size = static_cast<Index>(free_.size());
  A.row_begin.push_back(0);
  for (const std::size_t i : free_) {
    std::int64_t m = M.row_begin[i / 3];
    for (std::int64_t k = stiffness_.row_begin[i]; k < stiffness_.row_begin[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(stiffness_.column[k]);
      if (compressed_of_[j] < 0) continue;
      double value = s_ * stiffness_.value[k];
      if (j % 3 == i % 3) {
        while (m < M.row_begin[i / 3 + 1] && static_cast<std::size_t>(M.column[m]) < j / 3) ++m;
        if (m < M.row_begin[i / 3 + 1] && static_cast<std::size_t>(M.column[m]) == j / 3) value += M.value[m];
      }
      A.column.push_back(compressed_of_[j]);
      A.value.push_back(value);
    }
    A.row_begin.push_back(static_cast<std::int64_t>(A.column.size()));
  }
  return A;
}

std::vector<RowComponent> CholeskySolver::active_components(const std::vector<RowTangent>& D) const {
  std::vector<RowComponent> active;
  for (std::size_t r = 0; r < D.size(); ++r) {
    if (!acts(D[r])) continue;
    const bool tangential = std::any_of(D[r].begin() + 1, D[r].end(), [](double d) { return d != 0.0; });
    for (std::size_t c = 0; c < (tangential ? 3U : 1U); ++c) active.push_back({r, c});
  }
  return active;
}

/// x = A^-1 b on the free dofs, zero elsewhere.
void CholeskySolver::back_substitute(std::span<const double> b, std::span<double> x) const {
  std::vector<double> y(free_.size());
  for (std::size_t i = 0; i < free_.size(); ++i) y[i] = b[free_[i]];
  factor_->solve(y);
  std::fill(x.begin(), x.end(), 0.0);
  for (std::size_t i = 0; i < free_.size(); ++i) x[free_[i]] = y[i];
}

void CholeskySolver::extend_schur(const std::vector<RowComponent>& active) {
  std::vector<RowComponent> missing;
  for (const RowComponent& rc : active) {
    if (known_[3 * rc.row + rc.component] < 0) missing.push_back(rc);
  }
  const ConstraintRows& rows = system_.contact.rows();
  const std::size_t n = free_.size();
  std::vector<double> full(system_.solid.dof_count());
  constexpr std::size_t most = 32;  // columns per call: enough for the matrix-matrix kernels of the solver
  for (std::size_t first = 0; first < missing.size(); first += most) {
    const std::size_t count = std::min(most, missing.size() - first);
    std::vector<double> block(n * count);
    for (std::size_t k = 0; k < count; ++k) {
      std::fill(full.begin(), full.end(), 0.0);
      Vec3 unit{};
      unit[missing[first + k].component] = 1.0;
      rows.scatter(missing[first + k].row, unit, full);
      for (std::size_t i = 0; i < n; ++i) block[k * n + i] = full[free_[i]];
    }
    factor_->solve(block, static_cast<int>(count));
    std::fill(full.begin(), full.end(), 0.0);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < n; ++i) full[free_[i]] = block[k * n + i];
      const RowComponent& rc = missing[first + k];
      known_[3 * rc.row + rc.component] = static_cast<int>(components_.size());
      components_.push_back(rc);
      std::vector<double>& line = schur_.emplace_back();
      for (const RowComponent& other : components_) line.push_back(rows.relative(other.row, full)[other.component]);
    }
  }
}

/// w of (1 + S D) w = G x.
std::vector<double> CholeskySolver::contact_displacements(const std::vector<RowTangent>& D,
                                                          const std::vector<RowComponent>& active,
                                                          std::span<const double> x) {
  extend_schur(active);
  const std::size_t m = active.size();
  const auto S = [&](const RowComponent& a, const RowComponent& b) {
    const auto i = static_cast<std::size_t>(known_[3 * a.row + a.component]);
    const auto j = static_cast<std::size_t>(known_[3 * b.row + b.component]);
    return schur_[std::max(i, j)][std::min(i, j)];
  };
  std::vector<double> matrix(m * m, 0.0), w(m);
  for (std::size_t i = 0; i < m; ++i) {
    w[i] = system_.contact.rows().relative(active[i].row, x)[active[i].component];
    matrix[i * m + i] += 1.0;
    for (std::size_t k = 0; k < m; ++k) {
      const double s = S(active[i], active[k]);
      // D couples the components of one row only, and these stand side by side in `active`.
      for (std::size_t j = k - active[k].component; j < m && active[j].row == active[k].row; ++j) {
        matrix[i * m + j] += s * D[active[k].row][3 * active[k].component + active[j].component];
      }
    }
  }
  DenseLu(std::move(matrix), static_cast<int>(m)).solve(w);
  return w;
}

/// rhs -= G^T D w.
void CholeskySolver::subtract_contact(const std::vector<RowTangent>& D, const std::vector<RowComponent>& active,
                                      const std::vector<double>& w, std::span<double> rhs) const {
  for (std::size_t k = 0; k < active.size();) {
    const std::size_t r = active[k].row;
    Vec3 displacement{};
    for (; k < active.size() && active[k].row == r; ++k) displacement[active[k].component] = w[k];
    system_.contact.rows().scatter(r, scaled(multiply(D[r], displacement), -1.0), rhs);
  }
}

}  // namespace

std::unique_ptr<EffectiveSolver> make_effective_solver(const System& system, SolverKind kind, double s,
                                                       double omega_max_squared) {
  if (kind == SolverKind::automatic) {
    const double iterations = 0.5 * std::sqrt(1.0 + s * omega_max_squared) * std::log(2.0 / 1e-12);
    const bool large = system.solid.dof_count() > 2'000'000 || system.contact.rows().size() > 1000;
    kind = iterations <= 60.0 || large ? SolverKind::conjugate_gradients : SolverKind::cholesky;
  }
  if (kind == SolverKind::cholesky) return std::make_unique<CholeskySolver>(system);
  return std::make_unique<CgSolver>(system);
}

}  // namespace carom
