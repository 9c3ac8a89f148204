#include "contact/cone_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>

#include "contact/coulomb_block.hpp"
#include "linalg/conjugate_gradients.hpp"
#include "linalg/dense.hpp"

namespace carom {

namespace {

/// Compliance added to the diagonal of systems that are solved directly, relative to it, so that redundant rows can be
/// solved; iterated away (proximal point method), never part of the answer.
constexpr double proximal = 1e-10;
/// Unknowns from which on active sets are solved by conjugate gradients, and Newton is left to the sweeps.
constexpr std::size_t dense_limit = 2000;
/// Forces and relative motions of the wrong sign below this part of the scale are zero within round-off.
constexpr double negligible = 1e-14;
/// Motions caused by forces count into the scale of errors up to this multiple of the given ones.
constexpr double most_amplified = 1e6;
constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr int first_sweeps = 3;
constexpr int most_sweeps = 20000;
constexpr int most_newton_steps = 20;
constexpr int most_proximal_steps = 30;

using RowList = std::vector<std::size_t>;
constexpr auto no_row = static_cast<std::size_t>(-1);

/// What is known and what is wanted, with the diagonal of W at hand.
struct Problem {
  const Delassus& W;
  std::span<const Vec3> b;
  std::span<const double> mu;
  double tolerance, accepted;  ///< the latter is not below the former
  std::vector<Vec3>& r;
  std::vector<double> W_nn, W_tt;     ///< largest tangential diagonal entry; 0 without friction
  std::vector<FrameBlock> own;        ///< diagonal blocks
  std::vector<std::size_t> position;  ///< scratch: place of a row in the system that is assembled

  Problem(const Delassus& operator_W, std::span<const Vec3> given, std::span<const double> friction, double wanted,
          double enough, std::vector<Vec3>& force)
      : W(operator_W),
        b(given),
        mu(friction),
        tolerance(wanted),
        accepted(std::max(wanted, enough)),
        r(force),
        position(operator_W.size()) {
    for (std::size_t i = 0; i < W.size(); ++i) {
      for (std::size_t k = W.begin[i]; k < W.begin[i + 1]; ++k) {
        if (W.column[k] == i) own.push_back(W.block[k]);
      }
      const FrameBlock& block = own.back();
      W_nn.push_back(block[0]);
      W_tt.push_back(mu[i] > 0.0 ? std::max(block[4], block[8]) : 0.0);
    }
  }

  /// w_i = (W r + b)_i, or without the part of the row's own force
  Vec3 motion(std::size_t i) const { return sum_of_blocks(i, W.size()); }
  Vec3 motion_by_others(std::size_t i) const { return sum_of_blocks(i, i); }

  /// b_i + sum over j of W_ij r_j, j == left_out being left out
  Vec3 sum_of_blocks(std::size_t i, std::size_t left_out) const {
    Vec3 w = b[i];
    for (std::size_t k = W.begin[i]; k < W.begin[i + 1]; ++k) {
      if (W.column[k] == left_out) continue;
      const FrameBlock& B = W.block[k];
      const Vec3& s = r[W.column[k]];
      for (std::size_t a = 0; a < 3; ++a) w[a] += B[3 * a] * s[0] + B[3 * a + 1] * s[1] + B[3 * a + 2] * s[2];
    }
    return w;
  }

  /// Compliance by which tangential forces are compared with motions.
  double tangential_compliance(std::size_t i) const { return W_tt[i] > 0.0 ? W_tt[i] : W_nn[i]; }

  /// The natural map of the row as a motion: min(w_n, W_nn r_n), and W_tt (r_T - the projection of r_T - w_T / W_tt on
  /// the disc of radius mu r_n).
  double violation(std::size_t i) const {
    const Vec3 w = motion(i);
    if (W_nn[i] == 0.0) return std::max(0.0, -w[0]);
    const double normal = std::abs(std::min(w[0], W_nn[i] * r[i][0]));
    if (mu[i] == 0.0) return normal;
    const double compliance = tangential_compliance(i), radius = mu[i] * std::max(0.0, r[i][0]);
    const double p_1 = r[i][1] - w[1] / compliance, p_2 = r[i][2] - w[2] / compliance;
    const double length = std::hypot(p_1, p_2), keep = length > radius ? radius / length : 1.0;
    const double tangential = compliance * std::hypot(r[i][1] - keep * p_1, r[i][2] - keep * p_2);
    return normal + tangential;
  }

  /// Largest |b| and |W_ii r_i|, the latter counted up to a limit: forces that grow without end, since no force would
  /// do, must not make any motion look small.
  double scale(const RowList& rows) const {
    double given = 0.0, caused = 0.0;
    for (const std::size_t i : rows) {
      given = std::max({given, std::abs(b[i][0]), mu[i] > 0.0 ? std::hypot(b[i][1], b[i][2]) : 0.0});
      caused = std::max({caused, W_nn[i] * r[i][0], W_tt[i] * std::hypot(r[i][1], r[i][2])});
    }
    return std::max(given, std::min(caused, most_amplified * given));
  }

  double error(const RowList& rows) const {
    double worst = 0.0;
    for (const std::size_t i : rows) {
      const double v = violation(i);
      if (!std::isfinite(v)) return infinity;
      worst = std::max(worst, v);
    }
    if (worst == 0.0) return 0.0;
    const double s = scale(rows);
    return s > 0.0 ? worst / s : infinity;
  }

  bool solved(const RowList& rows) const { return error(rows) <= tolerance; }
};

/// Rows that act on each other, directly or through others, so that each set is a problem of its own.
std::vector<RowList> coupled_sets(const Delassus& W) {
  std::vector<RowList> sets;
  std::vector<bool> seen(W.size(), false);
  for (std::size_t first = 0; first < W.size(); ++first) {
    if (seen[first]) continue;
    RowList set{first};
    seen[first] = true;
    for (std::size_t next = 0; next < set.size(); ++next) {
      for (std::size_t k = W.begin[set[next]]; k < W.begin[set[next] + 1]; ++k) {
        if (seen[W.column[k]] || W.block[k] == FrameBlock{}) continue;
        seen[W.column[k]] = true;
        set.push_back(W.column[k]);
      }
    }
    std::ranges::sort(set);
    sets.push_back(std::move(set));
  }
  return sets;
}

/// One Gauss-Seidel sweep, each row solved exactly for the forces of the others; forwards or backwards.
void sweep(Problem& p, const RowList& rows, bool forwards) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t i = rows[forwards ? k : rows.size() - 1 - k];
    if (p.W_nn[i] == 0.0) continue;
    p.r[i] = solve_coulomb(p.own[i], p.motion_by_others(i), p.mu[i]);
  }
}

/// Sweeps until solved or `most` are done; returns the number of sweeps.
int sweeps(Problem& p, const RowList& rows, int most) {
  for (int n = 0; n < most; ++n) {
    if (p.solved(rows)) return n;
    sweep(p, rows, n % 2 == 0);
  }
  return most;
}

/// Normal forces on the active rows from (W_AA + proximal D) r_A = -(b_A - proximal D centre_A), D the diagonal of W;
/// zero on the others. False if the system is singular all the same.
bool solve_active(Problem& p, const RowList& rows, const std::vector<bool>& active, const std::vector<double>& centre) {
  RowList set;
  std::vector<double> x, d;  // unknowns r_i / d_i, which make the diagonal 1
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t i = rows[k];
    p.r[i][0] = 0.0;
    p.position[i] = active[k] ? set.size() : no_row;
    if (!active[k]) continue;
    set.push_back(i);
    d.push_back(1.0 / std::sqrt(p.W_nn[i]));
    x.push_back(-d.back() * (p.b[i][0] - proximal * p.W_nn[i] * centre[k]));
  }
  const std::size_t n = set.size();
  const auto each_entry = [&](std::size_t row, auto&& visit) {
    for (std::size_t k = p.W.begin[set[row]]; k < p.W.begin[set[row] + 1]; ++k) {
      const std::size_t column = p.position[p.W.column[k]];
      if (column == no_row) continue;
      visit(column, d[row] * d[column] * p.W.block[k][0] + (row == column ? proximal : 0.0));
    }
  };
  if (n <= dense_limit) {
    std::vector<double> A(n * n, 0.0);
    for (std::size_t row = 0; row < n; ++row)
      each_entry(row, [&](std::size_t column, double value) { A[row * n + column] = value; });
    try {
      DenseLu(std::move(A), static_cast<int>(n)).solve(x);
    } catch (const std::runtime_error&) {
      return false;
    }
  } else {
    const std::vector<double> rhs = x, ones(n, 1.0);
    const LinearOperator apply = [&](std::span<const double> v, std::span<double> y) {
      for (std::size_t row = 0; row < n; ++row) {
        double sum = 0.0;
        each_entry(row, [&](std::size_t column, double value) { sum += value * v[column]; });
        y[row] = sum;
      }
    };
    ConjugateGradients().solve(apply, ones, rhs, x, 1e-14, 0.0, 2000);
  }
  for (std::size_t row = 0; row < n; ++row) p.r[set[row]][0] = d[row] * x[row];
  return true;
}

/// Block principal pivoting (Judice and Pires, Comput. Oper. Res. 21, 1994): every wrong row changes sides, as in the
/// primal-dual active set; when that has not lowered their number for ten steps, only the last of them does, which ends
/// after finitely many steps (Murty). Returns the number of systems solved.
int pivot(Problem& p, const RowList& rows, std::vector<bool>& active, const std::vector<double>& centre) {
  const std::size_t n = rows.size();
  const int most = 100 + 5 * static_cast<int>(n);
  std::size_t fewest = n + 1;
  int patience = 10;
  for (int step = 1; step <= most; ++step) {
    if (!solve_active(p, rows, active, centre)) return step;
    const double tiny = negligible * p.scale(rows);
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = rows[k];
      if (p.W_nn[i] == 0.0) continue;
      const double value = active[k] ? p.W_nn[i] * p.r[i][0] : p.motion(i)[0] - proximal * p.W_nn[i] * centre[k];
      if (value < -tiny) wrong.push_back(k);
    }
    if (wrong.empty()) return step;
    if (wrong.size() < fewest) {
      fewest = wrong.size();
      patience = 10;
    } else if (--patience < 0) {
      wrong.erase(wrong.begin(), wrong.end() - 1);
    }
    for (const std::size_t k : wrong) active[k] = !active[k];
  }
  return most;
}

/// Frictionless rows: the proximal point method (Rockafellar, SIAM J. Control Optim. 14, 1976) around the active set,
/// so that redundant rows have an answer; one or two steps where W is regular.
int solve_frictionless(Problem& p, const RowList& rows) {
  std::vector<bool> active;
  for (const std::size_t i : rows) active.push_back(p.W_nn[i] > 0.0 && p.W_nn[i] * p.r[i][0] > p.motion(i)[0]);
  std::vector<double> centre(rows.size());
  int steps = 0;
  double error = p.error(rows), before = infinity;
  for (int n = 0; n < most_proximal_steps && error > p.tolerance && error < before; ++n) {
    for (std::size_t k = 0; k < rows.size(); ++k) centre[k] = p.r[rows[k]][0];
    steps += pivot(p, rows, active, centre);
    for (const std::size_t i : rows) p.r[i][0] = std::max(0.0, p.r[i][0]);
    before = n == 0 ? infinity : error;
    error = p.error(rows);
  }
  return steps;
}

enum class Status { stick, slip };

/// One row of the Newton system: where its unknowns stand and how its tangential force follows.
struct NewtonRow {
  std::size_t i = 0;
  std::size_t first = 0;  ///< number of the first unknown
  std::size_t count = 1;  ///< unknowns: 1 without friction, else 3
  Status status = Status::stick;
  double e_1 = 0.0, e_2 = 0.0;  ///< direction of slip force
  double keep = 0.0;            ///< mu r_n / |p_T|
};

/// Closed rows by the projection equations at r; open ones get r = 0.
std::vector<NewtonRow> closed_rows(Problem& p, const RowList& rows) {
  std::vector<NewtonRow> closed;
  std::vector<std::size_t> open;
  std::size_t unknowns = 0;
  for (const std::size_t i : rows) {
    const Vec3 w = p.motion(i);
    if (p.W_nn[i] == 0.0 || !(p.W_nn[i] * p.r[i][0] > w[0])) {
      open.push_back(i);
      continue;
    }
    NewtonRow row{i, unknowns, p.mu[i] > 0.0 ? std::size_t{3} : std::size_t{1}, Status::stick, 0.0, 0.0, 0.0};
    if (p.mu[i] > 0.0) {
      const double compliance = p.tangential_compliance(i);
      const double p_1 = p.r[i][1] - w[1] / compliance, p_2 = p.r[i][2] - w[2] / compliance;
      const double length = std::hypot(p_1, p_2), radius = p.mu[i] * p.r[i][0];
      if (length > radius) row = {i, unknowns, 3, Status::slip, p_1 / length, p_2 / length, radius / length};
    }
    unknowns += row.count;
    closed.push_back(row);
  }
  for (const std::size_t i : open) p.r[i] = {};
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
  const double compliance = p.tangential_compliance(row.i), mu = p.mu[row.i];
  const Vec3& r = p.r[row.i];
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

/// One step of semismooth Newton from r; false if the system is singular.
bool newton_step(Problem& p, const RowList& rows) {
  const std::vector<NewtonRow> closed = closed_rows(p, rows);
  if (closed.empty()) return true;
  const std::size_t n = closed.back().first + closed.back().count;
  std::vector<double> A(n * n, 0.0), x(n);
  for (const std::size_t i : rows) p.position[i] = no_row;
  for (std::size_t k = 0; k < closed.size(); ++k) p.position[closed[k].i] = k;
  for (const NewtonRow& row : closed) {
    const NewtonEquations eq = newton_equations(p, row);
    const double d_row = 1.0 / std::sqrt(p.W_nn[row.i]);
    for (std::size_t a = 0; a < row.count; ++a) x[row.first + a] = d_row * eq.rhs[a];
    for (std::size_t k = p.W.begin[row.i]; k < p.W.begin[row.i + 1]; ++k) {
      const std::size_t j = p.W.column[k];
      if (p.position[j] == no_row) continue;
      const NewtonRow& other = closed[p.position[j]];
      const double d = d_row / std::sqrt(p.W_nn[j]);
      FrameBlock B = p.W.block[k];
      if (j == row.i) {
        for (std::size_t a = 0; a < 3; ++a) B[4 * a] += proximal * std::max(p.W_nn[j], p.W_tt[j]);
      }
      for (std::size_t a = 0; a < row.count; ++a) {
        for (std::size_t c = 0; c < other.count; ++c) {
          double value = j == row.i ? eq.own[3 * a + c] : 0.0;
          for (std::size_t m = 0; m < 3; ++m) value += eq.through[3 * a + m] * B[3 * m + c];
          A[(row.first + a) * n + other.first + c] = d * value;
        }
      }
    }
  }
  try {
    DenseLu(std::move(A), static_cast<int>(n)).solve(x);
  } catch (const std::runtime_error&) {
    return false;
  }
  for (const NewtonRow& row : closed) {
    for (std::size_t a = 0; a < row.count; ++a) p.r[row.i][a] += x[row.first + a] / std::sqrt(p.W_nn[row.i]);
  }
  return true;
}

/// Newton from r, keeping the best r on the way; returns the number of steps.
int newton(Problem& p, const RowList& rows) {
  std::vector<Vec3> best;
  for (const std::size_t i : rows) best.push_back(p.r[i]);
  double least = p.error(rows);
  int steps = 0;
  while (steps < most_newton_steps && least > p.tolerance) {
    ++steps;
    if (!newton_step(p, rows)) break;
    const double error = p.error(rows);
    if (!std::isfinite(error)) break;
    if (error >= least && least <= p.accepted) break;
    if (error >= least) continue;
    least = error;
    for (std::size_t k = 0; k < rows.size(); ++k) best[k] = p.r[rows[k]];
  }
  for (std::size_t k = 0; k < rows.size(); ++k) p.r[rows[k]] = best[k];
  return steps;
}

/// Rows with friction: sweeps and Newton in turn, more sweeps each time that Newton fails.
int solve_with_friction(Problem& p, const RowList& rows) {
  const bool small = 3 * rows.size() <= dense_limit;
  int done = 0;
  for (int swept = 0, most = 10; swept < most_sweeps && !p.solved(rows); most *= 2) {
    const double before = p.error(rows);
    if (small) done += newton(p, rows);
    if (before <= p.accepted && p.error(rows) > 0.5 * before) break;
    const int now = sweeps(p, rows, std::min(most, most_sweeps - swept));
    swept += now;
    done += now;
    if (now == 0) break;
  }
  return done;
}

int solve_set(Problem& p, const RowList& rows) {
  const int start = sweeps(p, rows, first_sweeps);
  if (p.solved(rows)) return start;
  const bool frictionless = std::ranges::all_of(rows, [&](std::size_t i) { return p.mu[i] == 0.0; });
  return start + (frictionless ? solve_frictionless(p, rows) : solve_with_friction(p, rows));
}

}  // namespace

ConeResult solve_cone(const Delassus& W, std::span<const Vec3> b, std::span<const double> mu, std::vector<Vec3>& r,
                      double tolerance, double accepted) {
  assert(b.size() == W.size() && mu.size() == W.size());
  r.resize(W.size());
  const auto finite = [](const Vec3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); };
  if (!std::ranges::all_of(b, finite)) return {false, 0, infinity};
  Problem p(W, b, mu, tolerance, accepted, r);
  for (std::size_t i = 0; i < W.size(); ++i) {
    if (p.W_nn[i] < 0.0) return {false, 0, infinity};
    if (!finite(r[i])) r[i] = {};
    r[i][0] = std::max(0.0, r[i][0]);
    if (p.W_nn[i] == 0.0) r[i] = {};
    if (mu[i] == 0.0) r[i][1] = r[i][2] = 0.0;
  }
  ConeResult result;
  result.converged = true;
  for (const RowList& rows : coupled_sets(W)) {
    result.iterations = std::max(result.iterations, solve_set(p, rows));
    const double error = p.error(rows);
    result.error = std::max(result.error, error);
    if (error > p.accepted) result.converged = false;
  }
  return result;
}

}  // namespace carom
