#include "contact/cone_newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "linalg/conjugate_gradients.hpp"
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

}  // namespace

// Normal forces on the active rows from (W_AA + rho D) r_A = -(b_A - rho D centre_A); zero on the others. False if the
// system is singular all the same.
bool ActiveSystem::solve(Problem& p, const std::vector<bool>& active) {
  RowList set;
  std::vector<std::size_t> names;
  std::vector<double> rhs;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const std::size_t i = p.rows()[k];
    p.set_force(i, {});
    if (!active[k]) continue;
    set.push_back(i);
    names.push_back(p.W.name(i));
    rhs.push_back(-p.unit(i) * (p.b[i][0] - p.added(i) * p.centre(i)));
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
  std::vector<double> x(n);
  if (n > dense_limit) {
    ConjugateGradients().solve(apply, std::vector<double>(n, 1.0), rhs, x, round_off, 0.0, 2000);
  } else if (!factors_.solve(names, apply, rhs, x, round_off)) {
    const std::vector<std::size_t> position = positions(p, set);
    std::vector<double> A(n * n, 0.0);
    for (std::size_t row = 0; row < n; ++row) {
      const std::size_t i = set[row];
      for (std::size_t k = p.W.begin[i]; k < p.W.begin[i + 1]; ++k) {
        const std::size_t j = p.W.column[k];
        if (position[j] == no_row) continue;
        A[row * n + position[j]] = p.unit(i) * p.unit(j) * (p.normal_entry(k) + (i == j ? p.added(j) : 0.0));
      }
    }
    if (!factors_.factor(names, std::move(A), rhs, x)) return false;
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

/// A of the Newton system, row-major.
std::vector<double> newton_matrix(const Problem& p, const std::vector<NewtonRow>& closed,
                                  const std::vector<NewtonEquations>& equations, std::size_t n) {
  std::vector<double> A(n * n, 0.0);
  RowList set;
  for (const NewtonRow& row : closed) set.push_back(row.i);
  const std::vector<std::size_t> position = positions(p, set);
  for (std::size_t r = 0; r < closed.size(); ++r) {
    const NewtonRow& row = closed[r];
    const NewtonEquations& eq = equations[r];
    for (std::size_t k = p.W.begin[row.i]; k < p.W.begin[row.i + 1]; ++k) {
      const std::size_t j = p.W.column[k];
      if (position[j] == no_row) continue;
      const NewtonRow& other = closed[position[j]];
      const double d = p.unit(row.i) * p.unit(j);
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
  return A;
}

}  // namespace

bool NewtonSystem::step(Problem& p) {
  const std::vector<NewtonRow> closed = closed_rows(p);
  if (closed.empty()) return true;
  std::vector<NewtonEquations> equations;
  std::vector<std::size_t> names;
  std::vector<double> rhs;
  for (const NewtonRow& row : closed) {
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
  std::vector<double> x(rhs.size());
  if (!factors_.solve(names, apply, rhs, x, accuracy) &&
      !factors_.factor(names, newton_matrix(p, closed, equations, rhs.size()), rhs, x))
    return false;
  for (const NewtonRow& row : closed) {
    Vec3 r = p.force(row.i);
    for (std::size_t a = 0; a < row.count; ++a) r[a] += x[row.first + a] * p.unit(row.i);
    p.set_force(row.i, r);
  }
  return true;
}

namespace {

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

int pivot(Problem& p, std::vector<bool>& active, ActiveSystem& system) {
  const RowList& rows = p.rows();
  const std::size_t n = rows.size();
  const int most = 100 + 5 * static_cast<int>(n);
  std::size_t fewest = n + 1;
  int patience = 10;
  for (int step = 1; step <= most; ++step) {
    if (!system.solve(p, active)) return step;
    const double tiny = negligible * p.scale();
    std::vector<std::size_t> wrong;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = rows[k];
      if (p.normal_compliance(i) == 0.0) continue;
      const double value = active[k] ? p.normal_compliance(i) * p.force(i)[0] : p.motion(i)[0];
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
