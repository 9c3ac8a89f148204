#include "advise/lint_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "advise/approach.hpp"
#include "advise/waves.hpp"
#include "build/facing.hpp"
#include "build/groups.hpp"
#include "build/parts.hpp"
#include "contact/row_maker.hpp"
#include "math/vec3.hpp"
#include "model/bodies.hpp"
#include "model/outer_facets.hpp"
#include "parallel/threads.hpp"
#include "solid/smallest_cell.hpp"

namespace carom {

namespace {

/// Area of a facet as Surface counts it, of the section of this part.
double area_of(const Mesh& mesh, const Facet& facet, const Part& part) {
  const auto x = [&](std::size_t a) { return mesh.coordinates[static_cast<std::size_t>(facet[a])]; };
  if (facet.size == 1) return part.thickness;
  if (facet.size == 3) return 0.5 * norm(cross(subtract(x(1), x(0)), subtract(x(2), x(0))));
  if (facet.size == 4)
    return 0.5 * norm(cross(subtract(x(2), x(0)), subtract(x(3), x(1))));  // exact for plane quadrilaterals
  const double ring = std::numbers::pi * (x(0)[0] + x(1)[0]);
  return norm(subtract(x(1), x(0))) * (part.section == Section::axisymmetric ? ring : part.thickness);
}

/// Area of the part of the skin that the nodes of a contact make up; 0 when they make up none.
double surface_area(const Simulation& s, const CaseContact& contact) {
  const Groups groups(s.mesh());
  const Parts parts(s.given(), s.mesh(), groups);
  const std::vector<Index> nodes = groups.nodes(contact.group(), "contact.group");
  const auto is_member = [&](Index n) { return std::binary_search(nodes.begin(), nodes.end(), n); };
  double area = 0.0;
  const auto skin = outer_facets(s.model());
  for (const OuterFacet& outer : *skin) {
    const Part* part = parts.part_of(outer.cell);
    if (part != nullptr && std::all_of(outer.facet.begin(), outer.facet.end(), is_member))
      area += area_of(s.mesh(), outer.facet, *part);
  }
  return area;
}

/// Of a cell or a speed: less is the round-off of meshes, which often come in single precision.
constexpr double touching = 1e-6;

bool moves(const PrescribedMotion& motion) {
  return !is_zero(motion.function.value);
}

/// A motion of nodes of bodies, not of obstacles alone.
bool moves_bodies(const Simulation& s) {
  const std::vector<Index> body = bodies_of_nodes(s.model());
  return std::ranges::any_of(s.model().motions, [&](const PrescribedMotion& motion) {
    const auto is_held = [&](Index n) { return body[static_cast<std::size_t>(n)] >= 0; };
    return moves(motion) && std::ranges::any_of(motion.nodes, is_held);
  });
}

/// Something else than initial velocities that may bring bodies together.
bool is_driven(const Simulation& s) {
  return !s.model().loads.empty() || std::any_of(s.model().motions.begin(), s.model().motions.end(), moves);
}

class ContactLint {
 public:
  explicit ContactLint(const Simulation& s)
      : s_(s),
        state_(s.initial_state()),
        approaches_(approaches(s, state_)),
        impedances_(node_impedances(s)),
        waves_(waves(s)),
        cell_(smallest_cell(s.solid())) {}

  std::vector<std::string> run() {
    for (std::size_t c = 0; c < approaches_.size(); ++c) {
      if (parts(c).nature == ContactNature::bonds) continue;  // nothing is to meet
      where_ = fmt::format("{}: contact \"{}\"", to_string(given(c).where), *given(c).name);
      check_place(c);
      check_sides(c);
      check_roundness(c);
      check_step(c);
      if (is_led_to_turn(c)) check_turning(c);
      check_stiffness(c);
    }
    return std::move(out_);
  }

 private:
  const CaseContact& given(std::size_t c) const { return s_.given().contacts[c]; }
  ContactParts parts(std::size_t c) const { return parts_of(s_.model().contacts[c]); }
  bool is_led_to_turn(std::size_t c) const {
    const Index body = parts(c).body;
    return body >= 0 && s_.model().turning_bodies[static_cast<std::size_t>(body)].is_led();
  }
  bool is_spring(std::size_t c) const { return parts(c).nature == ContactNature::springs; }

  template <class... Values>
  void say(fmt::format_string<Values...> format, Values&&... values) {
    out_.push_back(where_ + fmt::format(format, std::forward<Values>(values)...));
  }

  /// Does the shape stay where it is while it turns?
  static bool is_round(const RigidShape& shape, const TurningBody& body) {
    const auto is_near = [](const Vec3& way, double size) { return norm(way) <= touching * size; };
    if (const auto* sphere = std::get_if<Sphere>(&shape))
      return is_near(subtract(sphere->centre, body.centre), sphere->radius);
    const auto* cylinder = std::get_if<Cylinder>(&shape);
    return cylinder != nullptr && is_near(cross(cylinder->axis, body.axes[2]), 1.0) &&
           is_near(cross(cylinder->axis, subtract(cylinder->point, body.centre)), cylinder->radius);
  }

  void check_turning(std::size_t c) {
    const TurningBody& body = s_.model().turning_bodies[static_cast<std::size_t>(parts(c).body)];
    if (is_round(*parts(c).shape, body) && law_of(s_.model().contacts[c])->mu == 0.0)
      say(": a round body that turns about itself moves nothing without friction: is the friction forgotten?");
    double rate = 0.0;
    for (const PrescribedMotion& motion : s_.model().motions)
      if (motion.rotation && motion.nodes[0] == body.nodes[0])
        for (const double value : motion.function.value) rate = std::max(rate, std::abs(value));
    constexpr double large = 0.2;  // of a radian: the chord is shorter than the arc by 0.2 %
    const double angle = rate * s_.dt();
    if (angle > large)
      say(": a step turns it by {:.2g} radians, and bodies feel it at the ends of steps alone: lower time.step to "
          "about {:.2g}",
          angle, s_.dt() * 0.1 / angle);
  }

  /// Will the surfaces meet at all?
  void check_place(std::size_t c) {
    const Approach& a = approaches_[c];
    if (shows_its_back(s_.model(), c, state_)) {
      say(": the faces of its rigid surface look away from \"{}\", and what comes from behind passes: turn the faces "
          "round (the order of their nodes)",
          *given(c).group());
      return;
    }
    if (is_led_to_turn(c)) return;  // where it looks and goes at the start says little of where it comes to
    if (faces_away(s_.model(), *s_.contact().rows_at(state_.q, state_.q), c, state_)) {
      const Located<std::string>* master = given(c).master();
      say(": no face of \"{}\" looks at {}: are these the faces that touch?", *given(c).group(),
          master != nullptr ? fmt::format("a face of \"{}\"", **master) : "the obstacle");
      return;
    }
    if (parts(c).is_self) {  // its rows see neither bodies that are farther apart than a facet, nor how a body folds
      const bool is_free = approaches_.size() == 1 && !is_driven(s_);
      if (is_free && all_stay_apart(s_.model(), c, state_, s_.end()))
        say(": no two of its bodies come together before the end, at the velocities that they start with");
      return;
    }
    if (a.speed > 0.0 && a.first_touch > s_.end() && is_foretold(c)) {
      say(" is not reached before the end: gap {:.4g} at speed {:.4g}, and the run ends at {:.4g}{}", a.gap, a.speed,
          s_.end(), std::isfinite(a.first_touch) ? fmt::format("; it would close at {:.4g}", a.first_touch) : "");
      return;
    }
    if (is_driven(s_)) return;
    const double speed = std::isfinite(a.gap) ? a.speed : middle_approach(s_.model(), c, state_).value_or(1.0);
    if (speed <= 0.0 && a.gap > 0.0) {
      say(": nothing moves towards it (is the sign of the velocity or of the normal right?)");
    } else if (!std::isfinite(a.gap) && passes_by(s_.model(), c, state_, s_.end())) {
      say(": its surfaces do not come together before the end, at the velocities that they start with");
    }
  }

  /// Does the flight of free bodies say when the contact closes? Not where it is closed at the start; nor where bodies
  /// are moved at some nodes, whose motion the rest takes over, far enough to close it; nor where what closes is
  /// round-off beside the bodies' speeds and another contact or a motion changes those.
  bool is_foretold(std::size_t c) const {
    const Approach& a = approaches_[c];
    if (a.gap <= touching * cell_ || (moves_bodies(s_) && a.gap <= a.speed * s_.end())) return false;
    double fastest = 0.0;
    for (const double v : state_.v) fastest = std::max(fastest, std::abs(v));
    return a.speed > touching * fastest || (approaches_.size() == 1 && !is_driven(s_));
  }

  /// Only the nodes of the group are seen: a finer master enters between them.
  void check_sides(std::size_t c) {
    const ContactParts pair = parts(c);
    if (pair.other == nullptr || pair.is_self || pair.sees_both_sides) return;
    constexpr double coarser = 1.5;
    const double slave = mean_facet_size(s_.mesh().coordinates, pair.own->facets);
    const double master = mean_facet_size(s_.mesh().coordinates, pair.other->facets);
    if (slave <= coarser * master) return;
    say(": facets of its group are {:.2g} times as long as those of its master, which enters between its nodes unseen: "
        "exchange group and master, or take method = \"two_pass\"",
        slave / master);
  }

  /// A row alone, with its node, sets this step: 2 / omega, or 2 mass / damping.
  void check_step(std::size_t c) {
    const Approach& a = approaches_[c];
    const Stage& stage = s_.first();
    const bool has_springs = is_spring(c) || traits(stage.settings().enforcement).adds_stiffness;
    if (!is_explicit(stage.settings().kind) || !has_springs) return;
    const double of_cells = cell_ / waves_.speed;
    const double of_spring = a.frequency_squared > 0.0 ? 2.0 / std::sqrt(a.frequency_squared) : of_cells;
    const double of_damper = a.rate > 0.0 ? 2.0 / a.rate : of_cells;
    constexpr double too_small = 0.05;
    const double step = std::min(of_spring, of_damper);
    if (step >= too_small * of_cells) return;
    const PressureTable* table = table_of(c);
    const double reached = table != nullptr ? penetration(c) : 0.0;
    if (table != nullptr && of_spring <= of_damper && table->largest_slope(reached) < table->largest_slope()) {
      const double of_reached = of_spring * std::sqrt(table->largest_slope() / table->largest_slope(reached));
      say(": the steepest piece of its pressures makes the explicit step about {:.2g} times smaller than the cells need "
          "({:.3g} instead of {:.3g}), and impact at {:.4g} will reach a depth of about {:.2g} alone, for which {:.3g} "
          "would do: leave out the depths far beyond, or take an implicit scheme",
          of_cells / step, step, of_cells, a.speed, reached, std::min({of_reached, of_damper, of_cells}));
      return;
    }
    say(": its {} makes the explicit step about {:.2g} times smaller than the cells need ({:.3g} instead of {:.3g}): "
        "{} it, or take an implicit scheme",
        of_damper < of_spring ? "damping" : "stiffness", of_cells / step, step, of_cells,
        of_damper < of_spring ? "lower" : "soften");
  }

  /// What a plane wave presses with when the bodies meet: rho c v, of two bodies in series.
  double pressure(std::size_t c) const {
    const ContactParts contact = parts(c);
    double z = 0.0;
    if (contact.other != nullptr) {
      const double slave = mean_impedance(contact.own->facets, impedances_);
      const double master = mean_impedance(contact.other->facets, impedances_);
      z = slave * master / (slave + master);
    } else if (contact.own != nullptr) {
      z = mean_impedance(contact.own->facets, impedances_);
    }
    if (z == 0.0) z = *std::max_element(impedances_.begin(), impedances_.end());
    return z * approaches_[c].speed;
  }

  /// Area that the rows of a contact stand for, once, where both sides have rows.
  double area(std::size_t c) const {
    if (given(c).obstacle() != nullptr && given(c).obstacle()->per_node) return surface_area(s_, given(c));
    const ContactParts contact = parts(c);
    const bool has_facets = contact.other != nullptr && !contact.own->facets.empty() && contact.own->facets[0].size > 1;
    const bool has_both = contact.sees_both_sides && !approaches_[c].has_guards;
    const bool is_twice = has_facets && (contact.is_self || has_both);
    return approaches_[c].measure / (is_twice ? 2.0 : 1.0);
  }

  /// eps_N as the case counts it, given or chosen.
  double stiffness(std::size_t c) const { return law_of(s_.model().contacts[c])->eps_N.value_or(0.0); }

  /// Springs that harden keep to the verdict's limits by themselves.
  bool hardens(std::size_t c) const { return std::isfinite(law_of(s_.model().contacts[c])->linear_depth); }

  /// Nodes alone touch obstacles: how deep does a ball or a cylinder sink into a face before a node meets it?
  void check_roundness(std::size_t c) {
    const auto* obstacle = std::get_if<ObstacleContact>(&s_.model().contacts[c]);
    if (obstacle == nullptr) return;
    const auto* sphere = std::get_if<Sphere>(&obstacle->shape);
    const auto* cylinder = std::get_if<Cylinder>(&obstacle->shape);
    if ((sphere == nullptr || sphere->inside) && (cylinder == nullptr || cylinder->inside)) return;
    const double radius = sphere != nullptr ? sphere->radius : cylinder->radius;
    double reach = 0.0;  // from the middle of a face to its nodes, across the cylinder
    for (const Facet& facet : obstacle->surface.facets) {
      Vec3 middle{};
      const auto x = [&](Index n) { return s_.mesh().coordinates[static_cast<std::size_t>(n)]; };
      for (const Index n : facet) middle = add(middle, scaled(x(n), 1.0 / facet.size));
      double least = facet.size > 1 ? std::numeric_limits<double>::infinity() : 0.0;
      for (const Index n : facet) {
        const Vec3 way = subtract(x(n), middle);
        least = std::min(least, norm(cylinder != nullptr ? cross(way, normalized(cylinder->axis)) : way));
      }
      reach = std::max(reach, least);
    }
    // As deep as bodies may be in each other for the verdict, a quarter of a cell, whose side is 2^(1/2) times as long.
    const double unseen = reach < radius ? radius - std::sqrt(radius * radius - reach * reach) : reach;
    if (unseen <= 0.25 * std::numbers::sqrt2 * reach) return;
    const char* kind = sphere != nullptr ? "ball" : "cylinder";
    if (reach >= radius)
      say(": nodes alone touch it, and faces of the body are so large that the {} passes between their nodes: smaller "
          "cells there, or a mesh of the {} as the master of a pair",
          kind, kind);
    else
      say(": nodes alone touch it, and the {} sinks by up to {:.2g} into the middle of a face before a node meets it: "
          "smaller cells there, or a mesh of the {} as the master of a pair",
          kind, unseen, kind);
  }

  const PressureTable* table_of(std::size_t c) const {
    const ContactLaw* law = law_of(s_.model().contacts[c]);
    return law == nullptr ? nullptr : law->pressure.get();
  }

  /// Stiffness of the whole contact over its area; of a law of pressure that of its steepest piece.
  double stiffness_per_area(std::size_t c) const {
    const double all = area(c);
    return all > 0.0 ? approaches_[c].stiffness / all : 0.0;
  }

  /// At which the contact presses as a plane wave does.
  double penetration(std::size_t c) const {
    const PressureTable* table = table_of(c);
    const double depth = pressure(c) / stiffness_per_area(c);
    return table == nullptr ? depth : table->depth(depth * table->largest_slope());
  }

  void check_stiffness(std::size_t c) {
    const Approach& a = approaches_[c];
    if (is_spring(c) || stiffness_per_area(c) <= 0.0) return;
    const PressureTable* table = table_of(c);
    const double depth = penetration(c);
    if (!std::isfinite(depth)) {
      say(" is soft: impact at {:.4g} presses by about {:.3g}, more than the last of its pressures, which is level: give "
          "the law higher ones",
          a.speed, pressure(c));
      return;
    }
    const double of_reached = table == nullptr ? 1.0 : table->largest_slope(depth) / table->largest_slope();
    const double per_area = stiffness_per_area(c) * of_reached;
    // What the user chose is held to a hundredth of a cell; what was chosen from the cells to what the verdict allows.
    const double most = given(c).springs()->stiffness ? 0.01 : 0.05;
    if (depth > most * cell_ && !hardens(c)) {
      const std::string remedy = table != nullptr
                                     ? std::string("are its pressures those of the units of this case?")
                                     : fmt::format("stiffness {:.3g} instead of {:.3g} would keep it below 1 %",
                                                   stiffness(c) * depth / (0.01 * cell_), stiffness(c));
      say(" is soft: impact at {:.4g} will penetrate by about {:.3g} ({:.3g} cells); {}", a.speed, depth, depth / cell_,
          remedy);
    }
    if (per_area > 20.0 * waves_.modulus / cell_) {
      say(" is {:.3g} times stiffer than a cell (modulus / cell length = {:.3g}): more stiffness brings noise and, in "
          "explicit runs, a smaller step, not accuracy",
          per_area * cell_ / waves_.modulus, waves_.modulus / cell_);
    }
  }

  const Simulation& s_;
  const State state_;
  const std::vector<Approach> approaches_;
  const std::vector<double> impedances_;
  const Waves waves_;
  const double cell_;
  std::string where_;
  std::vector<std::string> out_;
};

}  // namespace

std::vector<std::string> contact_warnings(const Simulation& simulation) {
  return simulation.given().contacts.empty() ? std::vector<std::string>{} : ContactLint(simulation).run();
}

}  // namespace carom
