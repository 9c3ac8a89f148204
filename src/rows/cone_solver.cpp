#include "rows/cone_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "math/vec3.hpp"
#include "rows/cone_newton.hpp"
#include "rows/cone_problem.hpp"

namespace carom {

namespace {

using cone::Problem;
using cone::RowList;

/// Before active sets, and before Newton (3 to 20 of them cost the same time in all).
constexpr int first_sweeps = 3, few_sweeps = 8;
constexpr int most_sweeps = 20000;
/// Least rho: what a factorisation in double precision still tells from nothing.
constexpr double least_proximal = 1e-13;

/// The best forces of the rows so far, and how far from a solution they are.
struct Best {
  std::vector<Vec3> force;
  double error = infinity;

  /// Takes the present forces when they are better.
  void offer(const Problem& p) {
    const double now = p.error();
    if (now >= error) return;
    error = now;
    force = p.forces();
  }
};

/// Frictionless rows: proximal steps around the active set, so that redundant rows have an answer; one or two steps
/// where W is regular. Sparse rows come down to the small rho from a large one, each step from the active set of the
/// last, and so do others that change sides again and again at the small one: of hundreds of redundant rows forces
/// grow there until rho or one of the rows ends it.
int solve_frictionless(Problem& p, double tolerance, double accepted, cone::ActiveSystem& system) {
  std::vector<bool> active;
  for (const std::size_t i : p.rows())
    active.push_back(p.normal_compliance(i) > 0.0 && p.normal_compliance(i) * p.force(i)[0] > p.motion(i)[0]);
  Best best;
  best.offer(p);
  constexpr int most_proximal_steps = 60;
  constexpr double large = 1e-3, small = 1e-10;
  bool comes_down = cone::is_sparse(p, p.rows());
  double rho = comes_down ? large : small;
  int steps = 0;
  for (int n = 0; n < most_proximal_steps && best.error > tolerance; ++n) {
    p.regularise(rho);
    const std::vector<Vec3> from = p.forces();
    cone::Pivots pivots = cone::pivot(p, active, system);
    steps += pivots.systems;
    if (!pivots.settled) {
      p.set_forces(from);
      if (!comes_down) {
        comes_down = true;
        rho = large;
        p.regularise(rho);
      }
      pivots = cone::descend(p, active, system);
      steps += pivots.systems;
    }
    for (const std::size_t i : p.rows()) p.set_force(i, {std::max(0.0, p.force(i)[0]), 0.0, 0.0});
    const double before = best.error;
    best.offer(p);
    if (best.error > 0.5 * before && before <= accepted && rho <= small) break;
    if (rho > small)
      rho = std::max(small, 0.1 * rho);
    else if (best.error > 0.1 * before)
      rho = std::max(least_proximal, 0.1 * rho);
  }
  p.set_forces(best.force);
  return steps;
}

/// Sweeps worth the time of one factorisation: 18 operations per block against 2/3 n^3 at ten times the speed. Those of
/// sparse rows cost about as much as ten sweeps.
int sweeps_per_factorisation(const Problem& p) {
  if (cone::is_sparse(p, p.rows())) return 10;
  double blocks = 0.0;
  for (const std::size_t i : p.rows()) blocks += static_cast<double>(p.W.end_entry(i) - p.W.first_entry(i));
  const double n = 3.0 * static_cast<double>(p.rows().size());
  return static_cast<int>(std::clamp(n * n * n / (15.0 * 18.0 * blocks), 5.0, 500.0));
}

/// Solves the proximal problem by Newton and sweeps in turn; false when it is not solved.
bool solve_proximal(Problem& p, double tolerance, cone::NewtonSystem& system, int& steps) {
  constexpr int rounds = 3, most_newton_steps = 20;
  int sweeps = sweeps_per_factorisation(p);
  for (int round = 0; round < rounds; ++round, sweeps *= 2) {
    steps += cone::newton(p, tolerance, most_newton_steps, system);
    for (int n = 0; n < sweeps; ++n, ++steps) {
      if (n % 8 == 0 && p.proximal_error() <= tolerance) return true;
      p.sweep(n % 2 == 0);
    }
  }
  return p.proximal_error() <= tolerance;
}

/// How many times the change d of its force takes a row from r, inside its cone, to the cone; `longest` where that is
/// more, and on the cone.
double way_to_cone(const Vec3& r, const Vec3& d, const Admissible& set, double longest) {
  if (set.is_bond()) return longest;
  const double mu = set.mu;
  if (mu == 0.0) return d[0] < 0.0 && r[0] > 0.0 ? std::min(longest, -r[0] / d[0]) : longest;
  // (mu r_n)^2 - |r_T|^2 along r + t d: a + 2 b t + c t^2
  const double a = mu * mu * r[0] * r[0] - r[1] * r[1] - r[2] * r[2];
  const double b = mu * mu * r[0] * d[0] - r[1] * d[1] - r[2] * d[2];
  const double c = mu * mu * d[0] * d[0] - d[1] * d[1] - d[2] * d[2];
  if (!(a > 1e-9 * mu * mu * r[0] * r[0])) return d[0] < 0.0 && r[0] > 0.0 ? std::min(longest, -r[0] / d[0]) : longest;
  const double root = b * b - a * c;
  if (root < 0.0) return longest;
  const double below = std::sqrt(root) - b;  // a / below is the first positive root, where it is positive
  return below > 0.0 ? std::min(longest, a / below) : longest;
}

/// Moves the forces on by their change since `from` until the first row reaches its cone, at most ten times as far.
void continue_drift(Problem& p, const std::vector<Vec3>& from) {
  double longer = 10.0;
  const std::vector<Vec3> now = p.forces();
  for (std::size_t k = 0; k < now.size(); ++k)
    longer = way_to_cone(now[k], subtract(now[k], from[k]), p.sets[p.rows()[k]], longer);
  for (std::size_t k = 0; k < now.size(); ++k)
    p.set_force(p.rows()[k], add(now[k], scaled(subtract(now[k], from[k]), longer)));
}

/// Rows with friction, few enough to factor: proximal steps. Where redundant rows contradict each other by a little,
/// each step adds contradiction / rho to forces that cancel, until one of the rows slips; so rho falls, slowly where
/// only such forces grow, and rises where Newton finds no way (of sparse rows at once to where thousands of redundant
/// ones find one), and after two steps of that kind the next is longer.
int approach(Problem& p, double tolerance, double accepted, cone::NewtonSystem& system, Best& best) {
  constexpr int most_proximal_steps = 100;
  best.offer(p);
  const double least_after_failure = cone::is_sparse(p, p.rows()) ? 1e-3 : 0.0;
  double rho = 1e-6, last = best.error;
  std::vector<Vec3> from;
  int steps = 0;
  for (int n = 0; n < most_proximal_steps && best.error > tolerance; ++n) {
    p.regularise(rho);
    const bool found = solve_proximal(p, 0.3 * tolerance, system, steps);
    best.offer(p);
    if (!found) {
      rho = std::min(1.0, std::max(least_after_failure, 10.0 * rho));
      from.clear();
      continue;
    }
    const double error = p.error();
    const bool stays = error > 0.5 * last, drifts = stays && !from.empty();
    if (stays && last <= accepted) break;
    last = error;
    if (drifts) {
      continue_drift(p, from);
      from.clear();
      continue;
    }
    rho = std::max(least_proximal, (stays ? 0.5 : 0.1) * rho);
    from = p.forces();
  }
  return steps;
}

/// The same from the forces given, from none, and from the best of both, until they are accepted.
int solve_with_friction(Problem& p, double tolerance, double accepted, cone::NewtonSystem& system) {
  Best best;
  int steps = approach(p, tolerance, accepted, system, best);
  for (const bool from_none : {true, false}) {
    if (best.error <= accepted) break;
    p.set_forces(best.force);
    if (from_none) {
      for (const std::size_t i : p.rows()) p.set_force(i, {});
    }
    steps += approach(p, tolerance, accepted, system, best);
  }
  p.set_forces(best.force);
  return steps;
}

/// Sweeps until solved, or accepted and no longer getting much better, or `most` are done. Returns their number.
int sweeps(Problem& p, double tolerance, double accepted, int most) {
  constexpr int batch = 64;
  double last = infinity;
  for (int n = 0; n < most; ++n) {
    if (n < first_sweeps || n % 8 == 0) {
      const double error = p.error();
      if (error <= tolerance) return n;
      if (n % batch == 0) {
        if (error <= accepted && error > 0.5 * last) return n;
        last = error;
      }
    }
    p.sweep(n % 2 == 0);
  }
  return most;
}

int solve_set(Problem& p, double tolerance, double accepted, ConeFactors& factors) {
  const bool frictionless = std::ranges::all_of(p.rows(), [&](std::size_t i) { return p.components(i) == 1; });
  const bool has_factors = 3 * p.rows().size() <= cone::newton_limit || cone::is_sparse(p, p.rows());
  const int most = frictionless ? first_sweeps : has_factors ? few_sweeps : most_sweeps;
  const int swept = sweeps(p, tolerance, accepted, most);
  if (p.error() <= tolerance || (!frictionless && !has_factors)) return swept;
  return swept + (frictionless ? solve_frictionless(p, tolerance, accepted, factors.active)
                               : solve_with_friction(p, tolerance, accepted, factors.newton));
}

}  // namespace

ConeResult solve_cone(const Delassus& W, std::span<const Vec3> b, std::span<const Admissible> sets,
                      std::vector<Vec3>& r, double tolerance, double accepted, double round_off, ConeFactors* factors) {
  assert(b.size() == W.size() && sets.size() == W.size());
  r.resize(W.size());
  const auto finite = [](const Vec3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); };
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!finite(b[i])) return {false, 0, infinity, i};
  }
  ConeFactors of_this_call;
  ConeFactors& kept = factors != nullptr ? *factors : of_this_call;
  Problem p(W, b, sets, r);
  for (std::size_t i = 0; i < W.size(); ++i) {
    if (p.normal_compliance(i) < 0.0) return {false, 0, infinity, i};
    if (!finite(r[i])) r[i] = {};
    if (sets[i].opens()) r[i][0] = std::max(0.0, r[i][0]);
    if (!p.gives_way(i)) r[i] = {};
    if (p.components(i) == 1) r[i][1] = r[i][2] = 0.0;
  }
  ConeResult result;
  result.converged = true;
  for (const RowList& rows : cone::coupled_sets(W)) {
    p.select(rows);
    const double given = p.scale_of_given();
    const double enough = std::max({accepted, tolerance, given > 0.0 ? round_off / given : 0.0});
    result.iterations = std::max(result.iterations, solve_set(p, tolerance, enough, kept));
    const double error = p.error();
    if (!(error <= enough)) result.converged = false;
    if (error <= result.error) continue;
    result.error = error;
    result.worst = p.worst();
  }
  return result;
}

ConeResult solve_cone(const Delassus& W, std::span<const Vec3> b, std::span<const double> mu, std::vector<Vec3>& r,
                      double tolerance, double accepted, double round_off, ConeFactors* factors) {
  std::vector<Admissible> sets;
  for (const double m : mu) sets.push_back({AdmissibleSet::cone, m});
  return solve_cone(W, b, sets, r, tolerance, accepted, round_off, factors);
}

}  // namespace carom
