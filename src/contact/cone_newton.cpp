#include "contact/cone_newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "linalg/conjugate_gradients.hpp"

namespace carom::cone {

namespace {

/// Forces and relative motions of the wrong sign below this part of the scale are zero within round-off.
constexpr double negligible = 1e-14;
constexpr auto no_row = static_cast<std::size_t>(-1);

}  // namespace

// Normal forces on the active rows from (W_AA + rho D) r_A = -(b_A - rho D centre_A); zero on the others. False if the
// system is singular all the same.
bool ActiveSystem::solve(Problem& p, const RowList& rows, const std::vector<bool>& active) {
  RowList set;
  std::vector<double> x, d;  // unknowns r_i / d_i, which make the diagonal 1
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t i = rows[k];
    p.r[i][0] = 0.0;
    if (!active[k]) continue;
    set.push_back(i);
    d.push_back(1.0 / std::sqrt(p.normal_compliance(i)));
    x.push_back(-d.back() * (p.b[i][0] - p.added(i) * p.centre(i)));
  }
  const std::size_t n = set.size();
  if (n <= dense_limit) {
    if (!factor(p, set, d)) return false;
    factors_->solve(x);
  } else {
    std::vector<std::size_t> position(p.W.size(), no_row);
    for (std::size_t k = 0; k < n; ++k) position[set[k]] = k;
    const std::vector<double> rhs = x, ones(n, 1.0);
    const LinearOperator apply = [&](std::span<const double> v, std::span<double> y) {
      for (std::size_t row = 0; row < n; ++row) {
        double sum = p.added(set[row]) * d[row] * d[row] * v[row];
        p.each_normal(set[row], [&](std::size_t j, double value) {
          if (position[j] != no_row) sum += d[row] * d[position[j]] * value * v[position[j]];
        });
        y[row] = sum;
      }
    };
    ConjugateGradients().solve(apply, ones, rhs, x, 1e-14, 0.0, 2000);
  }
  for (std::size_t row = 0; row < n; ++row) p.r[set[row]][0] = d[row] * x[row];
  return true;
}

/// Makes the factors, unless they are those of this system.
bool ActiveSystem::factor(const Problem& p, const RowList& set, const std::vector<double>& d) {
  if (factors_ && set == set_ && p.strength() == strength_) return true;
  const std::size_t n = set.size();
  std::vector<std::size_t> position(p.W.size(), no_row);
  for (std::size_t k = 0; k < n; ++k) position[set[k]] = k;
  std::vector<double> A(n * n, 0.0);
  for (std::size_t row = 0; row < n; ++row) {
    p.each_normal(set[row], [&](std::size_t j, double value) {
      if (position[j] == no_row) return;
      A[row * n + position[j]] = d[row] * d[position[j]] * (value + (set[row] == j ? p.added(j) : 0.0));
    });
  }
  set_ = set;
  strength_ = p.strength();
  factors_.reset();
  try {
    factors_.emplace(std::move(A), static_cast<int>(n));
  } catch (const std::runtime_error&) {
    return false;
  }
  return true;
}

namespace {

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
    if (p.normal_compliance(i) == 0.0 || !(p.normal_compliance(i) * p.r[i][0] > w[0])) {
      open.push_back(i);
      continue;
    }
    NewtonRow row{i, unknowns, p.mu[i] > 0.0 ? std::size_t{3} : std::size_t{1}, Status::stick, 0.0, 0.0, 0.0};
    if (p.mu[i] > 0.0) {
      const double compliance = p.tangential_compliance(i);
      const double p_1 = p.r[i][1] - w[1] / compliance, p_2 = p.r[i][2] - w[2] / compliance;
      const double length = std::hypot(p_1, p_2), radius = p.mu[i] * std::max(0.0, p.r[i][0]);
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
  std::vector<std::size_t> position(p.W.size(), no_row);
  for (std::size_t k = 0; k < closed.size(); ++k) position[closed[k].i] = k;
  for (const NewtonRow& row : closed) {
    const NewtonEquations eq = newton_equations(p, row);
    const double d_row = 1.0 / std::sqrt(p.normal_compliance(row.i));
    for (std::size_t a = 0; a < row.count; ++a) x[row.first + a] = d_row * eq.rhs[a];
    for (std::size_t k = p.W.begin[row.i]; k < p.W.begin[row.i + 1]; ++k) {
      const std::size_t j = p.W.column[k];
      if (position[j] == no_row) continue;
      const NewtonRow& other = closed[position[j]];
      const double d = d_row / std::sqrt(p.normal_compliance(j));
      const FrameBlock B = j == row.i ? p.own_block(j) : p.W.block[k];
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
    for (std::size_t a = 0; a < row.count; ++a)
      p.r[row.i][a] += x[row.first + a] / std::sqrt(p.normal_compliance(row.i));
  }
  return true;
}

void set_forces(Problem& p, const RowList& rows, const std::vector<Vec3>& forces) {
  for (std::size_t k = 0; k < rows.size(); ++k) p.r[rows[k]] = forces[k];
}

/// Goes back from r towards `from` by halves until the merit is below that of `from`; false when it does not fall.
bool shorten(Problem& p, const RowList& rows, const std::vector<Vec3>& from, double merit) {
  constexpr int most_halvings = 6;
  const std::vector<Vec3> full = p.forces(rows);
  double length = 1.0;
  for (int n = 0; n <= most_halvings; ++n, length *= 0.5) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      for (std::size_t a = 0; a < 3; ++a) p.r[rows[k]][a] = from[k][a] + length * (full[k][a] - from[k][a]);
    }
    if (p.merit(rows) < merit) return true;
  }
  set_forces(p, rows, from);
  return false;
}

}  // namespace

int pivot(Problem& p, const RowList& rows, std::vector<bool>& active, ActiveSystem& system) {
  const std::size_t n = rows.size();
  const int most = 100 + 5 * static_cast<int>(n);
  std::size_t fewest = n + 1;
  int patience = 10;
  for (int step = 1; step <= most; ++step) {
    if (!system.solve(p, rows, active)) return step;
    const double tiny = negligible * p.scale(rows);
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = rows[k];
      if (p.normal_compliance(i) == 0.0) continue;
      const double value = active[k] ? p.normal_compliance(i) * p.r[i][0] : p.motion(i)[0];
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

int newton(Problem& p, const RowList& rows, double tolerance, int most) {
  int steps = 0;
  while (steps < most && p.proximal_error(rows) > tolerance) {
    ++steps;
    const std::vector<Vec3> before = p.forces(rows);
    const double merit = p.merit(rows);
    if (!newton_step(p, rows)) {
      set_forces(p, rows, before);
      break;
    }
    if (!shorten(p, rows, before, merit)) break;
  }
  return steps;
}

}  // namespace carom::cone
