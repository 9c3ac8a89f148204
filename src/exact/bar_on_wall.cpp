#include <algorithm>
#include <memory>

#include "exact/bar_impact.hpp"
#include "exact/solution.hpp"

namespace carom {

namespace {

BarImpactData impact_data(const ExactValues& values) {
  return {.length = values.at("length"),
          .modulus = values.at("modulus"),
          .density = values.at("density"),
          .area = values.at("area"),
          .speed = values.at("speed"),
          .gap = values.at("gap")};
}

ExactMotion motion_of(const BarImpactData& data, double shift, double lowest) {
  const auto bar = std::make_shared<const BarImpact>(data);
  ExactMotion motion;
  motion.at = [bar, shift, lowest, length = data.length](const ExactPlace& place) {
    const double z = std::clamp(place.x - lowest, 0.0, length);
    return ExactPoint{[bar, z, shift](double t) { return shift + bar->displacement(z, t); },
                      [bar, z](double t) { return bar->velocity(z, t); },
                      [bar, z](double t) { return bar->stress(z, t); }};
  };
  motion.force = [bar](double t) { return bar->contact_force(t); };
  const double mass = data.wall_mass;
  if (mass > 0.0) motion.obstacle_velocity = [bar](double t) { return bar->wall_velocity(t); };
  motion.energies = {{"kinetic",
                      [bar, mass](double t) {
                        const double v = bar->wall_velocity(t);
                        return bar->kinetic_energy(t) + 0.5 * mass * v * v;
                      }},
                     {"strain", [bar](double t) { return bar->strain_energy(t); }},
                     {"contact_stored", [bar](double t) { return bar->contact_energy(t); }}};
  return motion;
}

/// What all walls have, with what is their own.
std::vector<ExactParameter> wall_parameters(const std::vector<ExactParameter>& own) {
  std::vector<ExactParameter> all = bar_parameters();
  all.insert(all.end(), own.begin(), own.end());
  all.push_back({.key = "speed", .meaning = "Speed towards the wall.", .unit = Dimension::velocity});
  all.push_back(gap_parameter());
  all.push_back(
      {.key = "initial_displacement", .meaning = "Added to displacements.", .unit = Dimension::length, .initial = 0.0});
  return all;
}

}  // namespace

ExactSolution bar_on_rigid_wall_row() {
  return {.name = "bar_on_rigid_wall",
          .summary = "an elastic bar flies against a rigid wall",
          .parameters = wall_parameters({}),
          .motion = [](const ExactValues& values, const ExactCase& given) {
            return motion_of(impact_data(values), values.at("initial_displacement"), given.lowest);
          }};
}

ExactSolution bar_on_penalty_wall_row() {
  return {.name = "bar_on_penalty_wall",
          .summary = "against a wall that gives way as the springs of the penalty do",
          .parameters = wall_parameters(
              {positive("stiffness", "Stress per penetration of the wall.", Dimension::stress_per_length)}),
          .motion = [](const ExactValues& values, const ExactCase& given) {
            BarImpactData data = impact_data(values);
            data.stiffness = values.at("stiffness");
            return motion_of(data, values.at("initial_displacement"), given.lowest);
          }};
}

ExactSolution bar_on_free_mass_row() {
  return {
      .name = "bar_on_free_mass",
      .summary = "against a rigid body that is free and at rest before",
      .parameters = wall_parameters({positive("mass", "Mass of the rigid body that the bar hits.", Dimension::mass)}),
      .motion = [](const ExactValues& values, const ExactCase& given) {
        BarImpactData data = impact_data(values);
        data.wall_mass = values.at("mass");
        return motion_of(data, values.at("initial_displacement"), given.lowest);
      }};
}

}  // namespace carom
