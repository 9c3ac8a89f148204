#include "advise/approach.hpp"

#include <algorithm>
#include <cmath>

#include "parallel/threads.hpp"
#include "rows/admissible.hpp"

namespace carom {

namespace {

constexpr int intervals = 512;

/// Displacements over the run when no force acts.
class Flight {
 public:
  Flight(const Simulation& s, const State& state) : s_(s), state_(state) {
    const std::vector<PrescribedMotion>& motions = s.model().motions;
    for (const PrescribedMotion& motion : motions) {
      const TimeFunction& f = motion.function;
      const bool is_zero = carom::is_zero(f.value);
      if (is_zero && !motion.rotation) continue;
      moved_.push_back({&motion, path_of(motion), {}});
      if (motion.rotation) moved_.back().angle = integrals(f);
    }
  }
  /// Does every node keep its initial velocity?
  bool is_uniform() const { return moved_.empty(); }

  /// At interval k of `intervals` over the run.
  void displace(int k, std::vector<double>& q) const {
    const double t = s_.end() * k / intervals;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = state_.q[i] + state_.v[i] * t;
    for (const Moved& moved : moved_)
      for (const Index n : moved.motion->nodes) {
        const std::size_t i = 3 * static_cast<std::size_t>(n) + static_cast<std::size_t>(moved.motion->component);
        q[i] = state_.q[i] + moved.path[static_cast<std::size_t>(k)];
        if (moved.motion->rotation) q[i] += moved.angle[static_cast<std::size_t>(k)] * tangent(*moved.motion, n);
      }
  }

 private:
  struct Moved {
    const PrescribedMotion* motion;
    std::vector<double> path;   ///< displacement since the start
    std::vector<double> angle;  ///< of a rotation
  };

  /// Rows are straight, and what turns leaves along the tangent: a roller stays where it is.
  double tangent(const PrescribedMotion& motion, Index n) const {
    const Vec3& X = s_.mesh().coordinates[static_cast<std::size_t>(n)];
    return rotated_point(*motion.rotation, X).sine[static_cast<std::size_t>(motion.component)];
  }

  std::vector<double> integrals(const TimeFunction& f) const {
    std::vector<double> values;
    for (int k = 0; k <= intervals; ++k) values.push_back(f.integral(0.0, s_.end() * k / intervals));
    return values;
  }

  std::vector<double> path_of(const PrescribedMotion& motion) const {
    if (motion.rotation) return integrals(motion.rotation->travel);
    const double dt = s_.end() / intervals;
    const std::size_t node = motion.nodes.empty() ? 0 : static_cast<std::size_t>(motion.nodes[0]);
    const double start = state_.v[3 * node + static_cast<std::size_t>(motion.component)];
    std::vector<double> path;
    for (int k = 0; k <= intervals; ++k) {
      const double t = k * dt;
      switch (motion.kind) {
        case MotionKind::displacement:
          path.push_back(motion.function(t) - motion.function(0.0));
          break;
        case MotionKind::velocity:
        case MotionKind::rotation:
          path.push_back(motion.function.integral(0.0, t));
          break;
        case MotionKind::acceleration:
          path.push_back(start * t + motion.function.second_integral(0.0, t));
          break;
      }
    }
    return path;
  }

  const Simulation& s_;
  const State& state_;
  std::vector<Moved> moved_;
};

/// First touches along a flight that is not uniform.
void follow(const Simulation& s, const ConstraintRows& rows, const Flight& flight, std::vector<Approach>& out) {
  std::vector<double> q(s.solid().dof_count()), gap(rows.size()), before(rows.size());
  const double dt = s.end() / intervals;
  for (Approach& a : out) a.first_touch = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= intervals; ++k) {
    flight.displace(k, q);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (is_bond(rows.law[r])) continue;
      gap[r] = rows.gap_at(r, q);
      Approach& a = out[static_cast<std::size_t>(rows.source[r])];
      if (k == 0 || gap[r] > 0.0 || gap[r] >= before[r]) continue;
      const double share = before[r] > 0.0 ? before[r] / (before[r] - gap[r]) : 0.0;
      a.first_touch = std::min(a.first_touch, dt * (k - 1 + share));
    }
    if (k > 0)
      for (std::size_t r = 0; r < rows.size(); ++r) {
        if (is_bond(rows.law[r])) continue;
        Approach& a = out[static_cast<std::size_t>(rows.source[r])];
        a.speed = std::max(a.speed, (before[r] - gap[r]) / dt);
      }
    before = gap;
  }
}

}  // namespace

std::vector<Approach> approaches(const Simulation& s, const State& state) {
  const std::shared_ptr<const ConstraintRows> shared = s.contact().rows_at(state.q, state.q);
  const ConstraintRows& rows = *shared;
  const std::vector<double>& masses = s.mass().node_diagonal();
  std::vector<Approach> out(s.given().contacts.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (is_bond(rows.law[r])) continue;
    Approach& a = out[static_cast<std::size_t>(rows.source[r])];
    const double gap = rows.gap_at(r, state.q), closing = -rows.relative(r, state.v)[0];
    a.gap = std::min(a.gap, gap);
    a.speed = std::max(a.speed, closing);
    a.speed_rounding = std::max(a.speed_rounding, rows.rounding(r, state.v));
    if (closing > 0.0) a.first_touch = std::min(a.first_touch, std::max(gap, 0.0) / closing);
    if (rows.allowed[r] > 0.0) {
      a.has_guards = true;
    } else {
      a.stiffness += rows.law[r].eps_N;
      a.measure += rows.measure[r];
    }
    const auto node = static_cast<std::size_t>(rows.node[static_cast<std::size_t>(rows.begin[r])]);
    if (!(masses[node] > 0.0)) continue;
    a.frequency_squared = std::max(a.frequency_squared, rows.law[r].eps_N / masses[node]);
    a.rate = std::max(a.rate, rows.law[r].damping / masses[node]);
  }
  const Flight flight(s, state);
  if (!flight.is_uniform()) follow(s, rows, flight, out);
  return out;
}

}  // namespace carom
