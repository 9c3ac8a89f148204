#include "exact/bouncing_bar.hpp"

#include <algorithm>
#include <memory>

#include "base/types.hpp"
#include "exact/arguments.hpp"
#include "exact/solution.hpp"

namespace carom {

namespace {

FaceContact solve(const BouncingBarData& data, double until) {
  data.bar.check("bouncing bar");
  require_not_negative("bouncing bar", {{"gravity", data.gravity}, {"gap", data.gap}});
  require_positive("bouncing bar", {{"until", until}});
  const BarFace floor{.impedance = infinity, .round_trip = infinity};
  const BarFace face{.impedance = data.bar.impedance(),
                     .round_trip = data.bar.round_trip(),
                     .velocity = data.bar.velocity,
                     .acceleration = -data.gravity};
  return solve_face_contact(floor, face, data.gap, until);
}

}  // namespace

BouncingBar::BouncingBar(const BouncingBarData& data, double until)
    : gravity_(data.gravity),
      gap_(data.gap),
      contact_(solve(data, until)),
      motion_(data.bar, -data.gravity, contact_.waves[1]) {}

double BouncingBar::potential_energy(double t) const {
  return motion_.bar().mass() * gravity_ * (gap_ + motion_.mean_displacement(t));
}

ExactSolution bouncing_bar_row() {
  ExactSolution row{.name = "bouncing_bar",
                    .summary = "an elastic bar falls on a rigid floor, again and again",
                    .parameters = bar_parameters()};
  row.parameters.push_back(
      {.key = "speed", .meaning = "Speed towards the floor.", .unit = Dimension::velocity, .initial = 0.0});
  row.parameters.push_back(gap_parameter());
  row.parameters.push_back(gravity_parameter());
  row.motion = [](const ExactValues& values, const ExactCase& given) {
    ElasticBar data = bar_of(values);
    data.velocity = -data.velocity;
    const auto bar =
        std::make_shared<const BouncingBar>(BouncingBarData{data, values.at("gravity"), values.at("gap")}, given.until);
    ExactMotion motion;
    motion.at = [bar, lowest = given.lowest, length = data.length](const ExactPlace& place) {
      const double z = std::clamp(place.x - lowest, 0.0, length);
      return ExactPoint{[bar, z](double t) { return bar->displacement(z, t); },
                        [bar, z](double t) { return bar->velocity(z, t); },
                        [bar, z](double t) { return bar->stress(z, t); }};
    };
    motion.force = [bar](double t) { return bar->contact_force(t); };
    motion.energies = {{"kinetic", [bar](double t) { return bar->kinetic_energy(t); }},
                       {"strain", [bar](double t) { return bar->strain_energy(t); }}};
    return motion;
  };
  return row;
}

}  // namespace carom
