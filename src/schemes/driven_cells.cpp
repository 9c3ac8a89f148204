#include "schemes/driven_cells.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "schemes/imposed_motion.hpp"
#include "solid/stability.hpp"

namespace carom {

namespace {

/// Which motion leads a dof: an index in Supports::motions, or one of these.
constexpr int nobody = -2, held = -1;

std::vector<int> leaders(const Supports& supports, std::size_t dofs) {
  std::vector<int> leader(dofs, nobody);
  for (const PrescribedDof& p : supports.prescribed()) {
    const std::vector<double>& values = supports.motions()[p.motion].function.value;
    const bool moves =
        p.start_velocity != 0.0 || supports.motions()[p.motion].kind == MotionKind::rotation || !is_zero(values);
    leader[static_cast<std::size_t>(p.dof)] = moves ? static_cast<int>(p.motion) : held;
  }
  return leader;
}

/// Are two nodes of the cell led along one axis by different motions?
bool is_led_apart(std::span<const Index> nodes, const std::vector<int>& leader) {
  for (std::size_t c = 0; c < 3; ++c) {
    int first = nobody;
    for (const Index n : nodes) {
      const int now = leader[3 * static_cast<std::size_t>(n) + c];
      if (now == nobody) continue;
      if (first != nobody && now != first) return true;
      first = now;
    }
  }
  return false;
}

/// The times between which the motions are looked at: an even division, and where they have kinks.
std::vector<double> times_of(const Supports& supports, double begin, double end) {
  constexpr int parts = 200;
  std::vector<double> times;
  for (int k = 0; k <= parts; ++k) times.push_back(std::lerp(begin, end, static_cast<double>(k) / parts));
  const double least = 1e-9 * (end - begin);
  for (const Supports::Motion& motion : supports.motions()) {
    for (const double t : motion.function.time) {
      if (t - 2.0 * least > begin) times.push_back(t - 2.0 * least);  // before a jump
      if (t > begin && t < end) times.push_back(t);
    }
  }
  std::sort(times.begin(), times.end());
  while (times.back() > end) times.pop_back();
  times.erase(std::unique(times.begin(), times.end(), [&](double a, double b) { return b - a < least; }), times.end());
  return times;
}

/// Displacements of the dofs that supports lead, 0 of the others, one time after the other.
class LedNodes {
 public:
  LedNodes(const System& system, double begin) : supports_(system.supports), u_(system.solid.dof_count(), 0.0) {
    if (begin > 0.0) {
      go(0.0, begin);
      return;
    }
    for (const PrescribedDof& p : supports_.prescribed()) {
      const Supports::Motion& motion = supports_.motions()[p.motion];
      if (motion.kind == MotionKind::displacement) u_[static_cast<std::size_t>(p.dof)] = motion.function(begin);
    }
  }
  void go(double from, double to) {
    imposed_steps(supports_, from, to, u_, steps_);
    for (const ImposedStep& step : steps_) u_[step.dof] = step.u;
  }
  const std::vector<double>& u() const { return u_; }

 private:
  const Supports& supports_;
  std::vector<double> u_;
  std::vector<ImposedStep> steps_;
};

/// x + u of one node as seen from another, without what only one of them is led along.
Vec3 distance(const System& system, const std::vector<int>& leader, const std::vector<double>& u, Index a, Index b) {
  const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
  Vec3 d = subtract(system.mesh.coordinates[k], system.mesh.coordinates[i]);
  for (std::size_t c = 0; c < 3; ++c)
    if (leader[3 * i + c] != nobody && leader[3 * k + c] != nobody) d[c] += u[3 * k + c] - u[3 * i + c];
  return d;
}

/// The largest change of the logarithm of a distance in the cell.
double largest_strain(const System& system, const std::vector<int>& leader, std::span<const Index> nodes,
                      const std::vector<double>& before, const std::vector<double>& after) {
  double largest = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t k = i + 1; k < nodes.size(); ++k) {
      const double from = norm(distance(system, leader, before, nodes[i], nodes[k])),
                   to = norm(distance(system, leader, after, nodes[i], nodes[k]));
      if (from > 0.0 && to > 0.0) largest = std::max(largest, std::abs(std::log(to / from)));
    }
  }
  return largest;
}

}  // namespace

std::vector<double> cell_bounds(const System& system) {
  std::vector<double> bounds = cell_frequency_bounds(system.solid);
  const std::vector<double> lumped = system.solid.mass(MassKind::lumped).node_diagonal();
  const std::vector<double>& own = system.mass.node_diagonal();
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    double lightest = 0.0;
    for (const Index node : system.solid.cells().nodes_of(k)) {
      const auto n = static_cast<std::size_t>(node);
      if (own[n] > 0.0) lightest = std::max(lightest, lumped[n] / own[n]);
    }
    bounds[k] *= lightest;
  }
  return bounds;
}

DrivenCells driven_cells(const System& system, double begin, double end) {
  const std::vector<int> leader = leaders(system.supports, system.solid.dof_count());
  std::vector<std::size_t> cells;
  for (std::size_t k = 0; k < system.solid.cells().size(); ++k)
    if (is_led_apart(system.solid.cells().nodes_of(k), leader)) cells.push_back(k);
  DrivenCells out;
  if (cells.empty()) return out;
  const std::vector<double> bounds = cell_bounds(system);
  std::vector<bool> is_strained(cells.size(), false);
  const std::vector<double> times = times_of(system.supports, begin, end);
  LedNodes led(system, begin);
  for (std::size_t t = 1; t < times.size(); ++t) {
    const std::vector<double> before = led.u();
    const double length = times[t] - times[t - 1];
    led.go(times[t - 1], times[t]);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      constexpr double rounding = 1e-12;
      const double strain = largest_strain(system, leader, system.solid.cells().nodes_of(cells[k]), before, led.u());
      if (strain <= rounding) continue;
      is_strained[k] = true;
      const double fastest = std::sqrt(bounds[cells[k]]);
      if (strain <= fastest * length) out.dt_strain = std::min(out.dt_strain, most_imposed_strain * length / strain);
    }
  }
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (!is_strained[k]) continue;
    if (out.count++ == 0) out.first = static_cast<Index>(cells[k]);
    out.omega_max_squared = std::max(out.omega_max_squared, bounds[cells[k]]);
  }
  return out;
}

}  // namespace carom
