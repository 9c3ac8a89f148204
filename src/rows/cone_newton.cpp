#include "rows/cone_newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "linalg/conjugate_gradients.hpp"
#include "linalg/gmres.hpp"
#include "linalg/nested_dissection.hpp"
#include "math/vec3.hpp"

namespace carom::cone {

namespace {

/// Forces and relative motions of the wrong sign below this part of the scale are zero within round-off.
constexpr double negligible = 1e-14;
constexpr auto no_row = static_cast<std::size_t>(-1);

/// Where each row of W stands among some of them, no_row where it does not.
std::vector<std::size_t> positions(const Problem& p, const RowList& set) {
  std::vector<std::size_t> position(p.W.size(), no_row);
  for (std::size_t k = 0; k < set.size(); ++k) position[set[k]] = k;
  return position;
}

/// Which rows of a set know each other, in their order.
CsrMatrix neighbours(const Problem& p, const RowList& set, const std::vector<std::size_t>& position) {
  CsrMatrix graph;
  graph.size = static_cast<Index>(set.size());
  graph.row_begin.push_back(0);
  for (const std::size_t i : set) {
    p.W.each(i, [&](std::size_t j, std::size_t) {
      if (position[j] != no_row) graph.column.push_back(static_cast<Index>(position[j]));
    });
    graph.row_begin.push_back(static_cast<std::int64_t>(graph.column.size()));
  }
  graph.value.assign(graph.column.size(), 1.0);
  return graph;
}

}  // namespace

bool is_sparse(const Problem& p, const RowList& set) {
  constexpr std::size_t least = 100;
  constexpr double most_filled = 0.2;
  if (set.size() < least) return false;
  std::size_t blocks = 0;
  for (const std::size_t i : set) blocks += p.W.end_entry(i) - p.W.first_entry(i);
  const double rows = static_cast<double>(set.size());
  return static_cast<double>(blocks) < most_filled * rows * rows;
}

// Normal forces on the active rows from (W_AA + rho D) r_A = -(b_A - rho D centre_A); zero on the others. False if the
// system is singular all the same.
bool ActiveSystem::solve(Problem& p, const std::vector<bool>& active) {
  RowList set;
  std::vector<std::size_t> names;
  std::vector<double> rhs, x;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const std::size_t i = p.rows()[k];
    if (active[k]) {
      set.push_back(i);
      names.push_back(p.W.name(i));
      rhs.push_back(-p.unit(i) * (p.b[i][0] - p.added(i) * p.centre(i)));
      x.push_back(p.force(i)[0] / p.unit(i));
    }
    p.set_force(i, {});
  }
  const std::size_t n = set.size();
  std::vector<double> r(p.W.size(), 0.0);
  const LinearOperator apply = [&](std::span<const double> v, std::span<double> y) {
    for (std::size_t k = 0; k < n; ++k) r[set[k]] = p.unit(set[k]) * v[k];
    parallel_for(n, 32, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        y[k] = p.unit(set[k]) * (p.normal_motion(set[k], r) + p.added(set[k]) * r[set[k]]);
    });
  };
  constexpr double round_off = 1e-14;
  const bool is_sparse = cone::is_sparse(p, set), is_large = !is_sparse && n > dense_limit;
  bool is_solved = false;
  if (is_large || (is_sparse && !resists_)) {
    constexpr int most_iterations = 300;  // of sparse rows: those of regular W need 20 to 60
    is_solved =
        ConjugateGradients()
            .solve(apply, std::vector<double>(n, 1.0), rhs, x, round_off, 0.0, is_large ? 2000 : most_iterations)
            .converged;
    resists_ = !is_solved;
  }
  if (!is_solved && !is_large && !factors_.solve(names, apply, rhs, x, round_off)) {
    const std::vector<std::size_t> position = positions(p, set);
    const auto entry = [&](std::size_t i, std::size_t j, std::size_t k) {
      return p.unit(i) * p.unit(j) * (p.normal_entry(k) + (i == j ? p.added(j) : 0.0));
    };
    if (is_sparse) {
      CsrMatrix A = neighbours(p, set, position);
      A.value.clear();
      for (const std::size_t i : set) {
        p.W.each(i, [&](std::size_t j, std::size_t k) {
          if (position[j] != no_row) A.value.push_back(entry(i, j, k));
        });
      }
      if (!factors_.factor(names, A, nested_dissection(A), rhs, x)) return false;
    } else {
      std::vector<double> A(n * n, 0.0);
      for (std::size_t row = 0; row < n; ++row) {
        p.W.each(set[row], [&](std::size_t j, std::size_t k) {
          if (position[j] != no_row) A[row * n + position[j]] = entry(set[row], j, k);
        });
      }
      if (!factors_.factor(names, std::move(A), rhs, x)) return false;
    }
  }
  for (std::size_t row = 0; row < n; ++row) p.set_force(set[row], {p.unit(set[row]) * x[row], 0.0, 0.0});
  return true;
}

namespace {

enum class Status { stick, slip };

/// One closed row of the Newton system: where its unknowns stand and how its tangential force follows.
struct NewtonRow {
  std::size_t i = 0;
  std::size_t first = 0;  ///< number of the first unknown
  std::size_t count = 1;  ///< unknowns: 1 without friction, else 3
  Status status = Status::stick;
  double e_1 = 0.0, e_2 = 0.0;  ///< direction of slip force
  double keep = 0.0;            ///< mu r_n / |p_T|
};

/// Closed rows by the projection equations at r; open ones get r = 0.
std::vector<NewtonRow> closed_rows(Problem& p) {
  std::vector<NewtonRow> closed;
  std::vector<std::size_t> open;
  std::size_t unknowns = 0;
  for (const std::size_t i : p.rows()) {
    const Vec3 w = p.motion(i);
    const bool presses = p.is_bond(i) || p.normal_compliance(i) * p.force(i)[0] > w[0];
    if (!p.gives_way(i) || !presses) {
      open.push_back(i);
      continue;
    }
    NewtonRow row{i, unknowns, p.components(i), Status::stick, 0.0, 0.0, 0.0};
    if (!p.is_bond(i) && p.mu(i) > 0.0) {
      const double compliance = p.tangential_compliance(i);
      const double p_1 = p.force(i)[1] - w[1] / compliance, p_2 = p.force(i)[2] - w[2] / compliance;
      const double length = std::hypot(p_1, p_2), radius = p.mu(i) * std::max(0.0, p.force(i)[0]);
      if (length > radius) row = {i, unknowns, 3, Status::slip, p_1 / length, p_2 / length, radius / length};
    }
    unknowns += row.count;
    closed.push_back(row);
  }
  for (const std::size_t i : open) p.set_force(i, {});
  return closed;
}

/// The equations of one closed row as motions: coefficients of the row's own dr (own) and of dw (through), and the
/// right side, where own dr + through dw = rhs. Stick: dw = -w. Slip: w_n + dw_n = 0 and, with r_T = mu r_n e,
///   dr_T - mu e dr_n - keep (1 - e e^T) (dr_T - dw_T / W_tt) = mu r_n e - r_T, times W_tt.
struct NewtonEquations {
  FrameBlock own{}, through{};
  Vec3 rhs{};
};

NewtonEquations newton_equations(const Problem& p, const NewtonRow& row) {
  const Vec3 w = p.motion(row.i);
  NewtonEquations eq;
  eq.through = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  eq.rhs = {-w[0], -w[1], -w[2]};
  if (row.status == Status::stick) return eq;
  const double compliance = p.tangential_compliance(row.i), mu = p.mu(row.i);
  const Vec3& r = p.force(row.i);
  const std::array<double, 2> e{row.e_1, row.e_2};
  for (std::size_t a = 0; a < 2; ++a) {
    eq.own[3 * (a + 1)] = -compliance * mu * e[a];
    eq.rhs[a + 1] = compliance * (mu * r[0] * e[a] - r[a + 1]);
    for (std::size_t c = 0; c < 2; ++c) {
      const double unit = a == c ? 1.0 : 0.0, across = row.keep * (unit - e[a] * e[c]);
      eq.own[3 * (a + 1) + c + 1] = compliance * (unit - across);
      eq.through[3 * (a + 1) + c + 1] = across;
    }
  }
  return eq;
}

/// y = A x of the Newton system
void apply_newton(const Problem& p, const std::vector<NewtonRow>& closed, const std::vector<NewtonEquations>& equations,
                  std::span<const double> x, std::span<double> y) {
  std::vector<Vec3> change(p.W.size());
  for (const NewtonRow& row : closed)
    for (std::size_t a = 0; a < row.count; ++a) change[row.i][a] = x[row.first + a] * p.unit(row.i);
  each_of(closed, [&](const NewtonRow& row) {
    const Vec3 w = p.change_of_motion(row.i, change), &own = change[row.i];
    const NewtonEquations& eq = equations[static_cast<std::size_t>(&row - closed.data())];
    for (std::size_t a = 0; a < row.count; ++a) {
      double sum = 0.0;
      for (std::size_t m = 0; m < 3; ++m) sum += eq.own[3 * a + m] * own[m] + eq.through[3 * a + m] * w[m];
      y[row.first + a] = p.unit(row.i) * sum;
    }
  });
}

/// Block of the Newton system in a row, of the entry k of W, which is of the row j.
FrameBlock newton_block(const Problem& p, const NewtonRow& row, const NewtonEquations& eq, std::size_t j,
                        std::size_t k) {
  const bool is_own = j == row.i;
  const double d = p.unit(row.i) * p.unit(j);
  const FrameBlock B = is_own ? p.own_block(j) : p.W.block_at(k);
  FrameBlock out;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t c = 0; c < 3; ++c) {
      double value = is_own ? eq.own[3 * a + c] : 0.0;
      for (std::size_t m = 0; m < 3; ++m) value += eq.through[3 * a + m] * B[3 * m + c];
      out[3 * a + c] = d * value;
    }
  }
  return out;
}

/// The closed rows in their order, and where each row of W stands among them.
struct ClosedSet {
  explicit ClosedSet(const Problem& p, const std::vector<NewtonRow>& closed) {
    for (const NewtonRow& row : closed) set.push_back(row.i);
    position = positions(p, set);
  }
  RowList set;
  std::vector<std::size_t> position;
};

/// A of the Newton system, row-major.
std::vector<double> newton_matrix(const Problem& p, const std::vector<NewtonRow>& closed,
                                  const std::vector<NewtonEquations>& equations, std::size_t n) {
  std::vector<double> A(n * n, 0.0);
  const ClosedSet at(p, closed);
  for (std::size_t r = 0; r < closed.size(); ++r) {
    const NewtonRow& row = closed[r];
    p.W.each(row.i, [&](std::size_t j, std::size_t k) {
      const std::size_t place = at.position[j];
      if (place == no_row) return;
      const FrameBlock block = newton_block(p, row, equations[r], j, k);
      for (std::size_t a = 0; a < row.count; ++a)
        for (std::size_t c = 0; c < closed[place].count; ++c)
          A[(row.first + a) * n + closed[place].first + c] = block[3 * a + c];
    });
  }
  return A;
}

/// The same as a sparse matrix, and the order of elimination: that of the rows.
CsrMatrix sparse_newton_matrix(const Problem& p, const std::vector<NewtonRow>& closed,
                               const std::vector<NewtonEquations>& equations, std::vector<Index>& order) {
  const ClosedSet at(p, closed);
  for (const Index k : nested_dissection(neighbours(p, at.set, at.position))) {
    const NewtonRow& row = closed[static_cast<std::size_t>(k)];
    for (std::size_t a = 0; a < row.count; ++a) order.push_back(static_cast<Index>(row.first + a));
  }
  CsrMatrix A;
  A.size = static_cast<Index>(order.size());
  A.row_begin.push_back(0);
  std::vector<std::pair<const NewtonRow*, FrameBlock>> of_row;
  for (std::size_t r = 0; r < closed.size(); ++r) {
    of_row.clear();
    p.W.each(closed[r].i, [&](std::size_t j, std::size_t k) {
      if (at.position[j] == no_row) return;
      of_row.emplace_back(&closed[at.position[j]], newton_block(p, closed[r], equations[r], j, k));
    });
    for (std::size_t a = 0; a < closed[r].count; ++a) {
      for (const auto& [other, block] : of_row) {
        for (std::size_t c = 0; c < other->count; ++c) {
          A.column.push_back(static_cast<Index>(other->first + c));
          A.value.push_back(block[3 * a + c]);
        }
      }
      A.row_begin.push_back(static_cast<std::int64_t>(A.column.size()));
    }
  }
  return A;
}

/// Inverse of the first `count` rows and columns; the unit matrix where there is none.
FrameBlock inverse_of(const FrameBlock& A, std::size_t count) {
  const auto solve = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    return A[3 * i + j] * A[3 * k + l] - A[3 * i + l] * A[3 * k + j];
  };
  const FrameBlock unit{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  if (count == 1) return A[0] == 0.0 ? unit : FrameBlock{1.0 / A[0], 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  FrameBlock adjugate;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t c = 0; c < 3; ++c) adjugate[3 * a + c] = solve((c + 1) % 3, (a + 1) % 3, (c + 2) % 3, (a + 2) % 3);
  const double determinant = A[0] * adjugate[0] + A[1] * adjugate[3] + A[2] * adjugate[6];
  if (determinant == 0.0 || !std::isfinite(determinant)) return unit;
  for (double& entry : adjugate) entry /= determinant;
  return adjugate;
}

/// By the diagonal blocks of the closed rows.
Preconditioner block_jacobi(const Problem& p, const std::vector<NewtonRow>& closed,
                            const std::vector<NewtonEquations>& equations) {
  std::vector<FrameBlock> inverse;
  for (std::size_t r = 0; r < closed.size(); ++r) {
    const std::size_t i = closed[r].i;
    const FrameBlock own = newton_block(p, closed[r], equations[r], i, p.W.own_entry(i));
    inverse.push_back(inverse_of(own, closed[r].count));
  }
  return [inverse = std::move(inverse), &closed](std::span<double> v) {
    for (std::size_t r = 0; r < closed.size(); ++r) {
      const NewtonRow& row = closed[r];
      const Vec3 given{v[row.first], row.count > 1 ? v[row.first + 1] : 0.0, row.count > 1 ? v[row.first + 2] : 0.0};
      for (std::size_t a = 0; a < row.count; ++a)
        v[row.first + a] =
            inverse[r][3 * a] * given[0] + inverse[r][3 * a + 1] * given[1] + inverse[r][3 * a + 2] * given[2];
    }
  };
}

}  // namespace

bool NewtonSystem::step(Problem& p) {
  const std::vector<NewtonRow> closed = closed_rows(p);
  if (closed.empty()) return true;
  std::vector<NewtonEquations> equations;
  std::vector<std::size_t> names;
  std::vector<double> rhs;
  RowList set;
  for (const NewtonRow& row : closed) {
    set.push_back(row.i);
    equations.push_back(newton_equations(p, row));
    for (std::size_t a = 0; a < row.count; ++a) {
      names.push_back(3 * p.W.name(row.i) + a);
      rhs.push_back(p.unit(row.i) * equations.back().rhs[a]);
    }
  }
  const LinearOperator apply = [&](std::span<const double> v, std::span<double> y) {
    apply_newton(p, closed, equations, v, y);
  };
  constexpr double accuracy = 1e-6;  // near the solution a step takes so much of the error at least
  constexpr int most_iterations = 80;
  const bool is_sparse = cone::is_sparse(p, set), is_large = !is_sparse && rhs.size() > newton_limit;
  std::vector<double> x(rhs.size());
  bool is_solved = factors_.solve(names, apply, rhs, x, accuracy);
  if (!is_solved && (is_large || (is_sparse && !resists_))) {
    is_solved = gmres(apply, block_jacobi(p, closed, equations), rhs, x, accuracy, most_iterations);
    resists_ = !is_solved;
  }
  if (!is_solved && is_large) return false;
  if (!is_solved && is_sparse) {
    std::vector<Index> order;
    const CsrMatrix A = sparse_newton_matrix(p, closed, equations, order);
    is_solved = factors_.factor(names, A, order, rhs, x);
  } else if (!is_solved) {
    is_solved = factors_.factor(names, newton_matrix(p, closed, equations, rhs.size()), rhs, x);
  }
  if (!is_solved) return false;
  for (const NewtonRow& row : closed) {
    Vec3 r = p.force(row.i);
    for (std::size_t a = 0; a < row.count; ++a) r[a] += x[row.first + a] * p.unit(row.i);
    p.set_force(row.i, r);
  }
  return true;
}

namespace {

/// Places in p.rows() of active rows that pull, and of others that are pressed on.
std::vector<std::size_t> wrong_rows(const Problem& p, const std::vector<bool>& active) {
  const double tiny = negligible * p.scale();
  std::vector<std::size_t> wrong;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const std::size_t i = p.rows()[k];
    if (p.normal_compliance(i) == 0.0) continue;
    const double value = active[k] ? p.normal_compliance(i) * p.force(i)[0] : p.motion(i)[0];
    if (value < -tiny) wrong.push_back(k);
  }
  return wrong;
}

/// Goes back from r towards `from` by halves, what pulls being cut at 0, until the energy 1/2 r (w + b) is below that
/// of `from`, where the rows have these motions; false, with `from`, where it does not fall.
bool lower_energy(Problem& p, const std::vector<Vec3>& from, std::span<const double> motion) {
  constexpr int most_halvings = 40;
  constexpr double least_part = 1e-4;  // of the fall that the slope at `from` tells (Armijo)
  const std::vector<Vec3> full = p.forces();
  double length = 1.0;
  for (int n = 0; n <= most_halvings; ++n, length *= 0.5) {
    double slope = 0.0, fall = 0.0;
    for (std::size_t k = 0; k < full.size(); ++k) {
      const double force = from[k][0] + length * (full[k][0] - from[k][0]);
      p.set_force(p.rows()[k], {std::max(0.0, force), 0.0, 0.0});
    }
    for (std::size_t k = 0; k < full.size(); ++k) {
      const std::size_t i = p.rows()[k];
      const double change = p.force(i)[0] - from[k][0];
      slope += change * motion[k];
      fall += 0.5 * change * (motion[k] + p.motion(i)[0]);
    }
    if (fall < 0.0 && fall <= least_part * slope) return true;
  }
  p.set_forces(from);
  return false;
}

/// Where the active rows are in balance, the one that is pressed on most becomes active too.
void admit_one(const Problem& p, std::span<const double> motion, std::vector<bool>& active) {
  const double balanced = 100.0 * negligible * p.scale();
  std::size_t most = active.size();
  for (std::size_t k = 0; k < active.size(); ++k) {
    if (active[k] && std::abs(motion[k]) > balanced) return;
    if (active[k] || p.normal_compliance(p.rows()[k]) == 0.0 || motion[k] >= 0.0) continue;
    if (most == active.size() || motion[k] < motion[most]) most = k;
  }
  if (most < active.size()) active[most] = true;
}

/// Goes back from r towards `from` until no row pulls; the first that would gets exactly 0.
void stop_at_first(Problem& p, const std::vector<Vec3>& from) {
  const std::vector<Vec3> full = p.forces();
  double length = 1.0;
  std::size_t first = full.size();
  for (std::size_t k = 0; k < full.size(); ++k) {
    const double reach = full[k][0] < 0.0 ? from[k][0] / (from[k][0] - full[k][0]) : 1.0;
    if (reach >= length) continue;
    length = reach;
    first = k;
  }
  for (std::size_t k = 0; k < full.size(); ++k) {
    const double force = from[k][0] + length * (full[k][0] - from[k][0]);
    p.set_force(p.rows()[k], {k == first ? 0.0 : std::max(0.0, force), 0.0, 0.0});
  }
}

/// Goes back from r towards `from` by halves until the merit is below that of `from`; false when it does not fall.
bool shorten(Problem& p, const std::vector<Vec3>& from, double merit) {
  constexpr int most_halvings = 6;
  const std::vector<Vec3> full = p.forces();
  double length = 1.0;
  for (int n = 0; n <= most_halvings; ++n, length *= 0.5) {
    for (std::size_t k = 0; k < full.size(); ++k)
      p.set_force(p.rows()[k], add(from[k], scaled(subtract(full[k], from[k]), length)));
    if (p.merit() < merit) return true;
  }
  p.set_forces(from);
  return false;
}

}  // namespace

Pivots pivot(Problem& p, std::vector<bool>& active, ActiveSystem& system) {
  constexpr int most_patience = 10;
  std::size_t fewest = p.rows().size() + 1;
  int patience = most_patience;
  for (int step = 1;; ++step) {
    if (!system.solve(p, active)) return {step, false};
    const std::vector<std::size_t> wrong = wrong_rows(p, active);
    if (wrong.empty()) return {step, true};
    if (wrong.size() < fewest) {
      fewest = wrong.size();
      patience = most_patience;
    } else if (--patience < 0) {
      return {step, false};
    }
    for (const std::size_t k : wrong) active[k] = !active[k];
  }
}

Pivots descend(Problem& p, std::vector<bool>& active, ActiveSystem& system) {
  const RowList& rows = p.rows();
  const int most = 100 + static_cast<int>(rows.size());
  std::vector<double> motion(rows.size());
  bool is_stuck = false;
  for (int step = 1; step <= most; ++step) {
    const std::vector<Vec3> from = p.forces();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      motion[k] = p.motion(rows[k])[0];
      active[k] = p.normal_compliance(rows[k]) > 0.0 && (from[k][0] > 0.0 || (!is_stuck && motion[k] < 0.0));
    }
    if (is_stuck) admit_one(p, motion, active);
    if (!system.solve(p, active)) return {step, false};
    if (wrong_rows(p, active).empty()) return {step, true};
    if (is_stuck) stop_at_first(p, from);
    is_stuck = !is_stuck && !lower_energy(p, from, motion);
  }
  return {most, false};
}

int newton(Problem& p, double tolerance, int most, NewtonSystem& system) {
  int steps = 0;
  while (steps < most && p.proximal_error() > tolerance) {
    ++steps;
    const std::vector<Vec3> before = p.forces();
    const double merit = p.merit();
    if (!system.step(p)) {
      p.set_forces(before);
      break;
    }
    if (!shorten(p, before, merit)) break;
  }
  return steps;
}

}  // namespace carom::cone
