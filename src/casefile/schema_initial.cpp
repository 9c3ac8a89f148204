#include "casefile/case_schema.hpp"
#include "casefile/section_rules.hpp"
#include "math/expression.hpp"

namespace carom {

namespace {

void add_velocity_keys(SectionSchema<CaseInitial>& s) {
  s.key("velocity", &CaseInitial::velocity, "The same velocity for all; angular_velocity and velocity_field add to it.",
        {.unit = Dimension::velocity});
  s.key("angular_velocity", &CaseInitial::angular_velocity,
        "Rotation about an axis: the velocity angular_velocity x (X - centre) at X; radians.",
        {.unit = Dimension::angular_velocity});
  s.key("centre", &CaseInitial::centre, "A point of the axis, with angular_velocity.",
        {.unit = Dimension::length, .aliases = {"center", "point"}});
  s.key(
      "velocity_field", &CaseInitial::velocity_field,
      "Velocity as three formulas in the coordinates x, y, z of the undeformed mesh, in the units of the case, e.g. "
      "[\"-8000 * y * z\", \"8000 * x * z\", \"0\"] for a bar that is twisted about z. They take numbers, pi, + - * / "
      "^, brackets, (condition) ? a : b and functions such as sin, sqrt, exp, abs, min, max.",
      {.default_phrase = "0"});
  s.key("drop_height", &CaseInitial::drop_height,
        "The height of a free fall from rest before the run: adds the velocity (2 g h)^(1/2) along g, the sum of the "
        "gravity of all [[load]]s without their functions. Gravity goes on in the run.",
        {.unit = Dimension::length, .range = greater_than(0.0)});
}

void check_velocity(CaseInitial& initial, const Node&, const ReadContext& at) {
  if (initial.centre.has_value() != initial.angular_velocity.has_value())
    throw CaseError(initial.where, at.at("angular_velocity").path,
                    initial.centre ? "a centre without angular_velocity" : "angular_velocity without a centre",
                    "both: angular_velocity = [wx, wy, wz] and centre = [x, y, z], a point of the axis");
  if (!initial.velocity_field) return;
  for (const Located<std::string>& text : *initial.velocity_field) {
    try {
      const Expression formula(*text);
    } catch (const ExpressionError& e) {
      throw CaseError(text.where, at.at("velocity_field").path, '"' + *text + "\": " + e.what(),
                      "a formula in x, y, z");
    }
  }
}

}  // namespace

SectionSchema<CaseInitialState> initial_state_section() {
  SectionSchema<CaseInitialState> s(
      "The run begins, at t = 0, in the state in which another run has ended: displacements, velocities, and what the "
      "points of the bodies remember (docs/resume.md). Mesh, parts and their materials are those of that run; all else "
      "may differ. Sections [[initial]] then replace velocities, and give no displacements.");
  s.key("from", &CaseInitialState::from,
        "The results folder of that run, relative to the folder of the case file. The state is that of its last "
        "checkpoint.",
        {.need = KeyOptions::Need::required});
  return s;
}

SectionSchema<CaseInitial> initial_section() {
  SectionSchema<CaseInitial> s(
      "Initial displacement and velocity; later sections overwrite earlier ones. Velocities are those at the beginning "
      "of the first stage that is no statics; until then a body that has one stays where it is, unless it has "
      "supports, a force or a pressure of its own, or touches what its weight can rest on.");
  s.key("nodes", &CaseInitial::nodes, "Group of nodes or cells, or \"all\".");
  s.key("part", &CaseInitial::part, "Name of a [[part]].");
  s.key("displacement", &CaseInitial::displacement, "Initial displacement, stress-free where it is uniform.",
        {.unit = Dimension::length});
  add_velocity_keys(s);
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"nodes", "part"}},
                                {Alternatives::Count::at_least_one,
                                 {"displacement", "velocity", "angular_velocity", "velocity_field", "drop_height"}}};
  s.finish = check_velocity;
  return s;
}

SectionSchema<CaseInitial> stage_initial_section() {
  SectionSchema<CaseInitial> s(
      "Velocities that begin with the stage, whatever the nodes did before; later sections overwrite earlier ones. "
      "What they add to the energy counts as initial energy.");
  s.key("nodes", &CaseInitial::nodes, "Group of nodes or cells, or \"all\".");
  s.key("part", &CaseInitial::part, "Name of a [[part]].");
  add_velocity_keys(s);
  s.description.alternatives = {
      {Alternatives::Count::exactly_one, {"nodes", "part"}},
      {Alternatives::Count::at_least_one, {"velocity", "angular_velocity", "velocity_field", "drop_height"}}};
  s.finish = check_velocity;
  return s;
}

}  // namespace carom
