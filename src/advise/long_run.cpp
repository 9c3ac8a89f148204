#include "advise/long_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "advise/approach.hpp"
#include "advise/stage_time.hpp"
#include "base/units.hpp"
#include "math/vec3.hpp"
#include "model/bodies.hpp"

namespace carom {

namespace {

constexpr double most_crossings = 1e4, most_lengths = 20.0, most_rebounds = 2.0;

/// Has the case nothing but velocities, gravity and contact?
bool is_plain_impact(const Simulation& s) {
  const Case& given = s.given();
  const Model& model = s.model();
  const auto is_gravity = [](const CaseLoad& load) { return load.kind == CaseLoad::Kind::gravity; };
  const auto turns = [](const CaseInitial& i) { return i.angular_velocity || i.velocity_field; };
  const auto moves = [](const PrescribedMotion& m) { return m.rotation || !is_zero(m.function.value); };
  const auto is_static = [](const auto& stage) { return !has_inertia(stage->settings().kind); };
  const auto is_physical = [](const ContactDefinition& c) { return parts_of(c).nature == ContactNature::springs; };
  return !given.contacts.empty() && given.functions.empty() && !given.initial_state &&
         std::ranges::all_of(given.loads, is_gravity) && std::ranges::none_of(given.initial, turns) &&
         std::ranges::none_of(model.motions, moves) && std::ranges::none_of(s.stages(), is_static) &&
         std::ranges::none_of(model.contacts, is_physical) && model.springs.empty() && model.point_masses.empty() &&
         model.rigid_bodies.empty() && model.turning_bodies.empty();
}

/// The diagonal of the largest body.
double largest_body(const Simulation& s) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const std::vector<Index> body = bodies_of_nodes(s.model());
  const Index count = body.empty() ? 0 : *std::ranges::max_element(body) + 1;
  std::vector<Vec3> low(at(count), Vec3{far, far, far}), high(at(count), Vec3{-far, -far, -far});
  for (std::size_t n = 0; n < body.size(); ++n)
    for (std::size_t c = 0; c < 3 && body[n] >= 0; ++c) {
      low[at(body[n])][c] = std::min(low[at(body[n])][c], s.mesh().coordinates[n][c]);
      high[at(body[n])][c] = std::max(high[at(body[n])][c], s.mesh().coordinates[n][c]);
    }
  double most = 0.0;
  for (std::size_t b = 0; b < low.size(); ++b)
    if (low[b][0] <= high[b][0]) most = std::max(most, norm(subtract(high[b], low[b])));
  return most;
}

double slowest_wave(const Model& model) {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : model.parts)
    least = std::min(least, std::sqrt(part.material.at_rest().E / part.material.rho));
  return least;
}

double gravity_of(const Case& given) {
  Vec3 sum{};
  for (const CaseLoad& load : given.loads) sum = add(sum, load.vector);
  return norm(sum);
}

}  // namespace

std::optional<std::string> long_run_warning(const Simulation& s) {
  if (!is_plain_impact(s)) return std::nullopt;
  const State state = s.initial_state();
  double speed = 0.0;
  for (std::size_t n = 0; n < s.mesh().node_count(); ++n) speed = std::max(speed, norm(vector_at(state.v, n)));
  const double end = s.end(), length = largest_body(s), crossings = slowest_wave(s.model()) * end / length;
  const double g = gravity_of(s.given());
  if (!(crossings > most_crossings) || !(speed * end > most_lengths * length) ||
      (g > 0.0 && end * g < most_rebounds * 2.0 * speed))
    return std::nullopt;
  double touch = std::numeric_limits<double>::infinity();
  for (const Approach& a : approaches(s, state)) touch = std::min(touch, a.first_touch);
  const double lengths = speed * (end - touch) / length;
  if (!(lengths > most_lengths)) return std::nullopt;
  long long steps = 0;
  for (const auto& stage : s.stages()) steps += expected_steps(*stage, s);
  const auto unit = [&](Dimension d) { return unit_name(d, s.given().units); };
  const CaseTime& last = s.given().stages.empty() ? s.given().time : s.given().stages.back().time;
  return fmt::format(
      "{}: time.end = {:g} {}: about {:.2g} steps, in which waves cross the largest body ({:.3g} {}) {:.2g} times, and "
      "what moves at {:.3g} {} goes on by {:.2g} times its length after it has touched; an impact is over after some "
      "hundreds of crossings: was end = {:g} meant (times are in {})?",
      to_string(last.end.where), end, unit(Dimension::time), static_cast<double>(steps), length,
      unit(Dimension::length), crossings, speed, unit(Dimension::velocity), lengths, 1e-3 * end, unit(Dimension::time));
}

}  // namespace carom
