#include "system/effective_solver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <optional>

#include "linalg/conjugate_gradients.hpp"
#include "linalg/dense.hpp"
#include "math/vec3.hpp"
#include "parallel/entries.hpp"
#include "parallel/threads.hpp"
#include "system/multigrid.hpp"
#include "system/row_compliance.hpp"
#include "system/tangent_factors.hpp"

namespace carom {

namespace {

/// Why a tangent has no inverse: the dof moves, alone or with others, and nothing resists.
std::string describe_free_motion(const Mesh& mesh, std::size_t dof) {
  return fmt::format(
      "{} without resistance: the tangent is singular. Hold the node by a [[support]] or a [[spring]] (bars resist "
      "along their axis only); where stiffness is lost on the way (a limit or bifurcation point), change the step or "
      "follow the motion by a scheme with inertia",
      describe_motion(mesh, dof));
}

/// The tangent as conjugate gradients can take it: where sliding couples the tangential force to the normal
/// displacement and nothing back, the coupling is left out. The iteration on the contact state then converges linearly.
RowTangent without_one_way_coupling(RowTangent D) {
  if (D[1] != D[3] || D[2] != D[6]) D[1] = D[2] = D[3] = D[6] = 0.0;
  return D;
}

/// rhs -= G^T D w.
void subtract_contact(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                      const std::vector<RowComponent>& active, const std::vector<double>& w, std::span<double> rhs) {
  for (std::size_t k = 0; k < active.size();) {
    const std::size_t r = active[k].row;
    Vec3 displacement{};
    for (; k < active.size() && active[k].row == r; ++k) displacement[active[k].component] = w[k];
    rows.scatter(r, scaled(product(D[r], displacement), -1.0), rhs);
  }
}

/// Conjugate gradients on the whole operator, contact rows included; preconditioned by its diagonal, or by a V-cycle.
class CgSolver final : public EffectiveSolver {
 public:
  CgSolver(const System& system, bool is_multilevel)
      : system_(system), nodes_(system.solid.shared_nodes()), u_(system.solid.dof_count(), 0.0) {
    if (is_multilevel) {
      grids_.emplace(system);
      return;
    }
    stiffness_diagonal_ = system.solid.diagonal_at_rest();
    inverse_diagonal_.resize(u_.size());
    if (!system.solid.is_linear()) diagonal_at_ = u_;
  }

  bool iterates() const override { return true; }
  void begin(const StageMemory& memory) override {
    if (system_.solid.is_linear()) return;
    diagonal_at_ = memory.diagonal_at;
    stiffness_diagonal_ = memory.diagonal;
    are_grids_made_ = are_grids_made_ && memory.grids_at == grids_at_;
    grids_at_ = memory.grids_at;
  }
  void leave(StageMemory& memory) const override {
    if (system_.solid.is_linear()) return;
    memory.diagonal_at = diagonal_at_;
    memory.diagonal = stiffness_diagonal_;
    memory.grids_at = grids_at_;
  }

  std::string prepare(double m, double c, std::span<const double> u, const PointStep& step) override {
    const bool is_linear = system_.solid.is_linear(), is_same = m == m_ && c == c_;
    if (is_linear && is_same && (!grids_ || are_grids_made_)) return {};
    ++operators_made_;
    m_ = m;
    c_ = c;
    are_grids_made_ = are_grids_made_ && is_same;
    if (!is_linear) {
      u_.assign(u.begin(), u.end());
      step_ = step;
      if (has_changed()) {
        if (grids_) {
          are_grids_made_ = false;
          grids_at_ = std::make_shared<const TangentPlace>(
              TangentPlace{step.dt, u_, {step.history.begin(), step.history.end()}});
        } else {
          stiffness_diagonal_ = system_.solid.tangent_diagonal(u_, step_);
          diagonal_at_ = u_;
        }
      }
    }
    if (grids_ && !are_grids_made_) make_grids();
    return {};
  }

  LinearSolveReport solve(std::span<const double> b, const std::shared_ptr<const ConstraintRows>& rows,
                          const std::vector<RowTangent>& D, double absolute, std::span<double> x) override {
    rows_ = rows;
    tangents_.resize(D.size());
    std::transform(D.begin(), D.end(), tangents_.begin(), without_one_way_coupling);
    return iterate(b, 1e-14, absolute, x);
  }

  /// To a relative 1e-13: close to round-off, and within reach of the recurrence.
  LinearSolveReport invert(std::span<double> b, int columns) override {
    rows_ = nullptr;
    tangents_.clear();
    LinearSolveReport all{true, 0, 0.0, false};
    const std::size_t n = u_.size();
    std::vector<double> x(n);
    for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) {
      const std::span<double> column = b.subspan(k * n, n);
      const LinearSolveReport one = iterate(column, 1e-13, 0.0, x);
      std::copy(x.begin(), x.end(), column.begin());
      if (!one.converged) all.worst = one.worst;
      all.converged = all.converged && one.converged;
      all.iterations += one.iterations;
      all.residual = std::max(all.residual, one.residual);
      all.is_indefinite = all.is_indefinite || one.is_indefinite;
    }
    return all;
  }

  std::string name(const StageMemory& /*memory*/) const override {
    if (!grids_) return "conjugate gradients";
    return fmt::format("conjugate gradients with multigrid, {} corners", fmt::join(grids_->sizes(), ", "));
  }

 private:
  /// Whether the tangent is another one than what preconditions it: by how much, nothing but the number of iterations
  /// hangs on. A diagonal costs as much as some tens of them; grids cost as much as ten, which a body that has turned
  /// by half a radian needs more. A body that flies keeps both.
  bool has_changed() const {
    if (grids_ && !grids_at_) return true;
    const std::vector<double>& before = grids_ ? grids_at_->u : diagonal_at_;
    const double enough = grids_ ? 0.3 : 0.03;
    return !(system_.solid.largest_change(before, u_) < enough);
  }

  LinearSolveReport iterate(std::span<const double> b, double relative, double absolute, std::span<double> x) {
    std::fill(x.begin(), x.end(), 0.0);
    const LinearOperator A = [&](std::span<const double> in, std::span<double> out) { apply(tangents_, in, out); };
    const int most = 1000 + static_cast<int>(10.0 * std::sqrt(static_cast<double>(x.size())));
    const Entries entries(nodes_);
    CgResult result;
    if (grids_) {
      grids_->use(rows_, tangents_);
      const LinearOperator B = [&](std::span<const double> r, std::span<double> z) { grids_->apply(r, z); };
      result = cg_.solve(A, B, b, x, relative, absolute, most, entries);
    } else {
      set_diagonal(tangents_);
      result = cg_.solve(A, inverse_diagonal_, b, x, relative, absolute, most, entries);
    }
    if (result.converged) return {true, result.iterations, result.residual, false};
    const bool broke_down = result.iterations < most;
    return {false, result.iterations, result.residual, broke_down, result.worst};
  }

  /// Of the nodes that this rank holds.
  void apply(const std::vector<RowTangent>& D, std::span<const double> x, std::span<double> y) {
    const std::vector<bool>& fixed = system_.supports.fixed();
    PointStep step = step_;
    step.nodes = &nodes_;
    system_.solid.tangent_action(u_, x, y, step);
    system_.mass.combine(m_, x, c_, y, nodes_);
    for (const DofSpring& spring : springs_) y[spring.dof] += spring.stiffness * x[spring.dof];
    for (std::size_t r = 0; r < D.size(); ++r) {
      if (acts(D[r])) rows_->scatter(r, product(D[r], rows_->relative(r, x)), y);
    }
    Entries(nodes_).each([&](std::size_t i) {
      if (fixed[i]) y[i] = x[i];
    });
  }

  void set_diagonal(const std::vector<RowTangent>& D) {
    const std::vector<double>& m = system_.mass.node_diagonal();
    const std::vector<bool>& fixed = system_.supports.fixed();
    for (std::size_t i = 0; i < inverse_diagonal_.size(); ++i) {
      inverse_diagonal_[i] = m_ * m[i / 3] + c_ * stiffness_diagonal_[i];
    }
    for (const DofSpring& spring : springs_) inverse_diagonal_[spring.dof] += spring.stiffness;
    for (std::size_t r = 0; r < D.size(); ++r) {
      const ConstraintRows& rows = *rows_;
      for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          const Vec3 column{rows.block[k][0][c], rows.block[k][1][c], rows.block[k][2][c]};
          inverse_diagonal_[3 * static_cast<std::size_t>(rows.node[k]) + c] += dot(column, product(D[r], column));
        }
      }
    }
    // Nothing resists a dof without a diagonal entry: any finite number serves it.
    const double most = *std::max_element(inverse_diagonal_.begin(), inverse_diagonal_.end());
    for (std::size_t i = 0; i < inverse_diagonal_.size(); ++i) {
      const double d = inverse_diagonal_[i] == 0.0 ? most : inverse_diagonal_[i];
      inverse_diagonal_[i] = fixed[i] ? 1.0 : 1.0 / d;
    }
  }

  /// At grids_at_; none: at rest.
  void make_grids() {
    are_grids_made_ = true;
    const auto place =
        grids_at_ ? grids_at_
                  : std::make_shared<const TangentPlace>(TangentPlace{0.0, std::vector<double>(u_.size(), 0.0), {}});
    grids_->make(m_, c_, place, springs_);
  }

  const System& system_;
  const Holding& nodes_;  ///< who holds which of the vectors of a solve
  std::vector<double> u_, stiffness_diagonal_, inverse_diagonal_;
  std::vector<double> diagonal_at_;             ///< of bodies that are not linear
  PointStep step_;                              ///< that ends at u_
  std::shared_ptr<const ConstraintRows> rows_;  ///< of the solve under way
  std::vector<RowTangent> tangents_;
  double m_ = 1.0, c_ = 0.0;
  ConjugateGradients cg_;
  std::optional<Multigrid> grids_;
  std::shared_ptr<const TangentPlace> grids_at_;  ///< where the tangent of the grids was made; none: at rest
  bool are_grids_made_ = false;                   ///< for m_ and c_, at grids_at_
};

/// A = m M + c K factored (once for a linear body); contact by the Schur complement on its active rows (Woodbury):
///   (1 + S D) w = G A^-1 b,  x = A^-1 (b - G^T D w),  S = G A^-1 G^T,
/// where S grows by a row and a column when a component of a row first becomes active; only S is kept.
class DirectSolver final : public EffectiveSolver {
 public:
  DirectSolver(const System& system, TangentFactors::Method method)
      : system_(system), factors_(method), compliance_(system.solid.dof_count(), 0) {
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

  bool iterates() const override { return false; }
  void begin(const StageMemory& memory) override {
    memory_ = &memory;
    is_compliance_ready_ = false;
    factors_.go_on(memory.negative_eigenvalues);
  }
  void leave(StageMemory& memory) const override {
    memory.negative_eigenvalues = factors_.negative_eigenvalues();
    if (is_compliance_ready_) memory.solver_rows = compliance_.growth();
  }

  std::string prepare(double m, double c, std::span<const double> u, const PointStep& step) override {
    const bool is_linear = system_.solid.is_linear();
    if (factors_.has_factors() && is_linear && m == m_ && c == c_) return {};
    ++operators_made_;
    m_ = m;
    c_ = c;
    compliance_.forget();
    if (!is_linear) stiffness_ = system_.solid.tangent(u, step);
    const std::string failure = factors_.factorize(assemble());
    if (factors_.singular_row() < 0) return failure;
    return describe_free_motion(system_.mesh, free_[static_cast<std::size_t>(factors_.singular_row())]);
  }

  LinearSolveReport solve(std::span<const double> b, const std::shared_ptr<const ConstraintRows>& rows,
                          const std::vector<RowTangent>& D, double /*absolute*/, std::span<double> x) override {
    std::copy(b.begin(), b.end(), x.begin());
    back_substitute(x, 1);
    const std::vector<RowComponent> active = active_components(D);
    if (active.empty()) return {true, 1, 0.0, false};
    compliance_.use(rows);
    go_on();
    const std::vector<double> w = contact_displacements(*rows, D, active, x);
    std::copy(b.begin(), b.end(), x.begin());
    subtract_contact(*rows, D, active, w, x);
    back_substitute(x, 1);
    return {true, 1, 0.0, false};
  }

  LinearSolveReport invert(std::span<double> b, int columns) override {
    back_substitute(b, columns);
    return {true, columns, 0.0, false};
  }

  std::function<std::vector<HalfPanel>(const SparseColumns&)> halves() override {
    if (factors_.cholesky() == nullptr) return {};
    return [this](const SparseColumns& B) { return factors_.cholesky()->half_solve(on_unknowns(B)); };
  }

  std::string name(const StageMemory& memory) const override { return factors_.name(memory.negative_eigenvalues); }

 private:
  /// Brings the compliance of fixed rows to where the memory has it, if it belongs to this operator.
  void go_on() {
    if (is_compliance_ready_ || memory_ == nullptr || !system_.solid.is_linear() || !system_.contact.is_fixed()) return;
    const bool is_same = memory_->m == m_ && memory_->c == c_;
    compliance_.grow_as(is_same ? memory_->solver_rows : Growth{}, inverse());
    is_compliance_ready_ = true;
  }
  InverseOperator inverse() {
    return {[this](std::span<double> b, int columns) { back_substitute(b, columns); }, halves()};
  }
  SparseColumns on_unknowns(const SparseColumns& B) const;
  CsrMatrix assemble() const;
  std::vector<RowComponent> active_components(const std::vector<RowTangent>& D) const;
  void back_substitute(std::span<double> b, int columns) const;
  std::vector<double> contact_displacements(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                            const std::vector<RowComponent>& active, std::span<const double> x);

  const System& system_;
  CsrMatrix stiffness_;
  std::vector<std::size_t> free_;     ///< dof of each unknown
  std::vector<Index> compressed_of_;  ///< unknown of each dof, -1 when fixed
  TangentFactors factors_;
  RowCompliance compliance_;
  const StageMemory* memory_ = nullptr;  ///< at the beginning of the stage
  bool is_compliance_ready_ = false;     ///< compliance_ goes on from it
  double m_ = 1.0, c_ = 0.0;
};

CsrMatrix DirectSolver::assemble() const {
  const bool is_lumped = system_.mass.kind() == MassKind::lumped;
  const CsrMatrix lumped = is_lumped ? diagonal_matrix(system_.mass.node_diagonal()) : CsrMatrix{};
  const CsrMatrix& M = is_lumped ? lumped : system_.mass.node_matrix();
  std::vector<double> held(compressed_of_.size(), 0.0);
  for (const DofSpring& spring : springs_) held[spring.dof] += spring.stiffness;
  CsrMatrix A;
  A.size = static_cast<Index>(free_.size());
  A.row_begin.push_back(0);
  for (const std::size_t i : free_) {
    std::int64_t m = M.row_begin[i / 3];
    if (stiffness_.row_begin[i] == stiffness_.row_begin[i + 1] && m < M.row_begin[i / 3 + 1]) {  // a rigid body's node
      A.column.push_back(compressed_of_[i]);
      A.value.push_back(m_ * M.value[m] + held[i]);
    }
    for (std::int64_t k = stiffness_.row_begin[i]; k < stiffness_.row_begin[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(stiffness_.column[k]);
      if (compressed_of_[j] < 0 || (c_ == 0.0 && j % 3 != i % 3)) continue;  // a mass couples no directions
      double value = c_ * stiffness_.value[k] + (j == i ? held[i] : 0.0);
      if (j % 3 == i % 3) {
        while (m < M.row_begin[i / 3 + 1] && static_cast<std::size_t>(M.column[m]) < j / 3) ++m;
        if (m < M.row_begin[i / 3 + 1] && static_cast<std::size_t>(M.column[m]) == j / 3) value += m_ * M.value[m];
      }
      A.column.push_back(compressed_of_[j]);
      A.value.push_back(value);
    }
    A.row_begin.push_back(static_cast<std::int64_t>(A.column.size()));
  }
  return A;
}

std::vector<RowComponent> DirectSolver::active_components(const std::vector<RowTangent>& D) const {
  std::vector<RowComponent> active;
  for (std::size_t r = 0; r < D.size(); ++r) {
    if (!acts(D[r])) continue;
    const bool tangential = !is_zero({D[r].begin() + 1, D[r].end()});
    for (std::size_t c = 0; c < (tangential ? 3U : 1U); ++c) active.push_back({r, c});
  }
  return active;
}

/// The entries of B on free dofs, by unknowns.
SparseColumns DirectSolver::on_unknowns(const SparseColumns& B) const {
  SparseColumns out;
  for (std::size_t c = 0; c < B.size(); ++c) {
    for (std::size_t e = B.begin[c]; e < B.begin[c + 1]; ++e) {
      const Index unknown = compressed_of_[static_cast<std::size_t>(B.row[e])];
      if (unknown >= 0) out.add_entry(unknown, B.value[e]);
    }
    out.end_column();
  }
  return out;
}

/// b = A^-1 b on the free dofs, zero elsewhere.
void DirectSolver::back_substitute(std::span<double> b, int columns) const {
  const std::size_t n = free_.size(), all = compressed_of_.size();
  const auto count = static_cast<std::size_t>(columns);
  std::vector<double> y(n * count);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < n; ++i) y[k * n + i] = b[k * all + free_[i]];
  }
  factors_.solve(y, columns);
  std::fill(b.begin(), b.end(), 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < n; ++i) b[k * all + free_[i]] = y[k * n + i];
  }
}

/// w of (1 + S D) w = G x.
std::vector<double> DirectSolver::contact_displacements(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                                        const std::vector<RowComponent>& active,
                                                        std::span<const double> x) {
  compliance_.extend(active, inverse());
  const std::size_t m = active.size();
  std::vector<double> matrix(m * m, 0.0), w(m);
  for (std::size_t i = 0; i < m; ++i) {
    w[i] = rows.relative(active[i].row, x)[active[i].component];
    matrix[i * m + i] += 1.0;
    for (std::size_t k = 0; k < m; ++k) {
      const double s = compliance_(active[i], active[k]);
      // D couples the components of one row only, and these stand side by side in `active`.
      for (std::size_t j = k - active[k].component; j < m && active[j].row == active[k].row; ++j) {
        matrix[i * m + j] += s * D[active[k].row][3 * active[k].component + active[j].component];
      }
    }
  }
  DenseLu(std::move(matrix), static_cast<int>(m)).solve(w);
  return w;
}

}  // namespace

std::string describe_motion(const Mesh& mesh, std::size_t dof) {
  const Vec3& x = mesh.coordinates[dof / 3];
  return fmt::format("node {} at ({:.4g}, {:.4g}, {:.4g}) moves along {}", mesh.node_label(static_cast<Index>(dof / 3)),
                     x[0], x[1], x[2], "xyz"[dof % 3]);
}

SolverKind chosen_solver(const System& system, SolverKind kind, EnforcementKind enforcement, double ratio,
                         double omega_max_squared) {
  if (kind != SolverKind::automatic) return kind;
  const std::size_t dofs = system.solid.dof_count(), rows = system.contact.slots();
  if (traits(enforcement).is_exact && rows > 0 && dofs <= (system.solid.is_linear() ? 500'000U : 50'000U))
    return SolverKind::cholesky;
  const double iterations = 0.5 * std::sqrt(1.0 + ratio * omega_max_squared) * std::log(2.0 / 1e-12);
  if (iterations <= 60.0) return SolverKind::conjugate_gradients;
  const bool is_large = dofs > (system.solid.is_linear() ? 50'000U : 200'000U) || rows > 1000;
  return is_large ? SolverKind::multigrid : SolverKind::cholesky;
}

std::unique_ptr<EffectiveSolver> make_effective_solver(const System& system, SolverKind kind) {
  if (kind == SolverKind::cholesky) return std::make_unique<DirectSolver>(system, TangentFactors::Method::cholesky);
  if (kind == SolverKind::ldlt) return std::make_unique<DirectSolver>(system, TangentFactors::Method::ldlt);
  return std::make_unique<CgSolver>(system, kind == SolverKind::multigrid);
}

}  // namespace carom
