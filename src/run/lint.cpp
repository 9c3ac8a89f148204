#include "run/lint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "base/units.hpp"
#include "casefile/plausibility.hpp"
#include "contact/facet_geometry.hpp"
#include "math/vec3.hpp"
#include "mesh/skin.hpp"
#include "output/cfc_filter.hpp"
#include "run/groups.hpp"
#include "run/locking.hpp"
#include "run/parts.hpp"
#include "schemes/touch_rebound.hpp"

namespace carom {

namespace {

/// Mass, kinetic energy and momentum of one part, by the lumped shares of its cells (exact for a common velocity).
struct PartSummary {
  double mass = 0.0, kinetic = 0.0;
  Vec3 momentum{};
};

PartSummary summarise(const Simulation& s, const Part& part, const State& state) {
  PartSummary sum;
  const double rho = std::visit([](const auto& material) { return material.rho; }, part.material);
  const Solid& solid = s.solid();
  std::vector<char> is_member(s.mesh().block(part.type)->size(), 0);
  for (const Index cell : part.cells) is_member[static_cast<std::size_t>(cell)] = 1;
  for (std::size_t k = 0; k < solid.cell_count(); ++k) {
    const CellRef& cell = solid.cells()[k];
    if (s.mesh().blocks[static_cast<std::size_t>(cell.block)].type != part.type) continue;
    if (is_member[static_cast<std::size_t>(cell.cell)] == 0) continue;
    const std::span<const Index> nodes = solid.nodes_of_cell(k);
    const double share = rho * solid.cell_volumes()[k] / static_cast<double>(nodes.size());
    for (const Index node : nodes) {
      const auto n = static_cast<std::size_t>(node);
      const Vec3 v{state.v[3 * n], state.v[3 * n + 1], state.v[3 * n + 2]};
      sum.mass += share;
      sum.kinetic += 0.5 * share * dot(v, v);
      sum.momentum = add(sum.momentum, scaled(v, share));
    }
  }
  return sum;
}

/// Smallest gap, and the earliest time at which a row closes when everything keeps its initial velocity.
struct Approach {
  double gap = std::numeric_limits<double>::infinity();
  double speed = 0.0;  ///< largest closing speed
  double first_touch = std::numeric_limits<double>::infinity();
  double stiffness = 0.0, measure = 0.0;  ///< sums over the rows
};

Approach approach(const Simulation& s, std::size_t contact, const State& state) {
  const std::shared_ptr<const ConstraintRows> shared = s.initial_rows();
  const ConstraintRows& rows = *shared;
  Approach a;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (static_cast<std::size_t>(rows.source[r]) != contact) continue;
    const double gap = rows.gap_at(r, state.q), closing = -rows.relative(r, state.v)[0];
    a.gap = std::min(a.gap, gap);
    a.speed = std::max(a.speed, closing);
    if (closing > 0.0) a.first_touch = std::min(a.first_touch, std::max(gap, 0.0) / closing);
    a.stiffness += rows.law[r].eps_N;
    a.measure += rows.measure[r];
  }
  return a;
}

/// Mean position and velocity of the nodes of facets.
struct Motion {
  Vec3 x{}, v{};
};
Motion mean_motion(const Simulation& s, std::span<const Facet> facets, const State& state) {
  Motion m;
  double count = 0.0;
  for (const Facet& facet : facets) {
    for (const Index n : facet) {
      const auto i = static_cast<std::size_t>(n);
      for (std::size_t c = 0; c < 3; ++c) {
        m.x[c] += s.mesh().coordinates[i][c] + state.q[3 * i + c];
        m.v[c] += state.v[3 * i + c];
      }
      ++count;
    }
  }
  return {scaled(m.x, 1.0 / count), scaled(m.v, 1.0 / count)};
}

/// Speed at which the middles of two surfaces approach each other that are too far apart for rows; without a value
/// where that says nothing.
std::optional<double> far_approach(const Simulation& s, std::size_t c, const State& state) {
  const auto* pair = std::get_if<PairContact>(&s.model().contacts[c]);
  if (pair == nullptr || pair->self) return std::nullopt;
  const Motion slave = mean_motion(s, pair->slave.facets, state), master = mean_motion(s, pair->master.facets, state);
  const Vec3 way = subtract(master.x, slave.x);
  return norm(way) > 0.0 ? std::optional(dot(subtract(slave.v, master.v), way) / norm(way)) : std::nullopt;
}

/// True when a rigid surface shows its back: the facet nearest to the middle of the touching surface looks the same way
/// as that does and lies before it.
bool shows_its_back(const Simulation& s, std::size_t c, const State& state) {
  const auto* obstacle = std::get_if<ObstacleContact>(&s.model().contacts[c]);
  const auto* rigid = obstacle == nullptr ? nullptr : std::get_if<RigidSurface>(&obstacle->shape);
  if (rigid == nullptr || obstacle->surface.facets.empty()) return false;
  const Vec3 middle = mean_motion(s, obstacle->surface.facets, state).x;
  const auto centre = [&](const Facet& facet) { return mean_motion(s, std::span(&facet, 1), state).x; };
  const auto distance = [&](const Facet& facet) { return norm(subtract(centre(facet), middle)); };
  const auto nearer = [&](const Facet& a, const Facet& b) { return distance(a) < distance(b); };
  const auto normal = [&](const Facet& facet) {
    const PlacedFacet placed = place(facet, s.mesh().coordinates);
    const ParentPoint at = facet_centre(facet.size);
    return facet_frame(placed, at.xi, at.eta).normal;
  };
  const std::vector<Facet>&own = obstacle->surface.facets, &others = rigid->surface.facets;
  const Facet& here = *std::min_element(own.begin(), own.end(), nearer);
  const Facet& there = *std::min_element(others.begin(), others.end(), nearer);
  return dot(normal(here), normal(there)) > 0.5 && dot(subtract(centre(there), centre(here)), normal(here)) > 0.0;
}

double smallest_cell(const Simulation& s) {
  const std::vector<double>& lengths = s.solid().cell_lengths();
  return *std::min_element(lengths.begin(), lengths.end());
}

/// Fastest wave and largest impedance over the materials.
struct Waves {
  double speed = 0.0, impedance = 0.0, modulus = 0.0;
};

/// Stress over strain of the fastest wave that a part carries: E of bars, E / (1 - nu^2) of plane stress, else the
/// P-wave modulus (K. F. Graff, Wave Motion in Elastic Solids, 1975, sections 2.1, 8.3 and 5.1).
double wave_modulus(const Part& part, const IsotropicElastic& m) {
  if (part.section == Section::bar) return m.E;
  if (part.section == Section::plane_stress) return m.E / (1.0 - m.nu * m.nu);
  return m.p_wave_modulus();
}

Waves waves(const Simulation& s) {
  Waves w;
  for (const Part& part : s.model().parts) {
    const auto m = std::visit([](const IsotropicElastic& law) { return law; }, part.material);
    const double modulus = wave_modulus(part, m), c = std::sqrt(modulus / m.rho);
    w.speed = std::max(w.speed, c);
    w.impedance = std::max(w.impedance, m.rho * c);
    w.modulus = std::max(w.modulus, modulus);
  }
  return w;
}

/// Area of a facet as Surface counts it, of the section of this part.
double area_of(const Mesh& mesh, const Facet& facet, const Part& part) {
  const auto x = [&](std::size_t a) { return mesh.coordinates[static_cast<std::size_t>(facet[a])]; };
  if (facet.size == 1) return part.thickness;
  if (facet.size == 4)
    return 0.5 * norm(cross(subtract(x(2), x(0)), subtract(x(3), x(1))));  // exact for plane quadrilaterals
  const double ring = std::numbers::pi * (x(0)[0] + x(1)[0]);
  return norm(subtract(x(1), x(0))) * (part.section == Section::axisymmetric ? ring : part.thickness);
}

/// Area of the part of the skin that the nodes of a contact make up; 0 when they make up none.
double surface_area(const Simulation& s, const CaseContact& contact) {
  const Groups groups(s.mesh());
  const Parts parts(s.given(), s.mesh(), groups);
  const std::vector<Index> nodes = groups.nodes(contact.group, "contact.group");
  const auto is_member = [&](Index n) { return std::binary_search(nodes.begin(), nodes.end(), n); };
  double area = 0.0;
  for (const OuterFacet& outer : outer_facets(s.mesh())) {
    const Part* part = parts.part_of(outer.cell);
    if (part != nullptr && std::all_of(outer.facet.begin(), outer.facet.end(), is_member))
      area += area_of(s.mesh(), outer.facet, *part);
  }
  return area;
}

void lint_contact(const Simulation& s, std::size_t c, const State& state, std::vector<std::string>& out) {
  const CaseContact& contact = s.given().contacts[c];
  const std::string at = fmt::format("{}: contact \"{}\"", to_string(contact.where), *contact.name);
  const Approach a = approach(s, c, state);
  const double end = s.end(), h = smallest_cell(s);
  if (a.speed > 0.0 && a.first_touch > end) {
    out.push_back(fmt::format(
        "{} is not reached before the end: gap {:.4g} at speed {:.4g} closes at t = {:.4g}, the run ends at {:.4g}", at,
        a.gap, a.speed, a.first_touch, end));
  }
  const bool is_turned = shows_its_back(s, c, state);
  if (is_turned) {
    out.push_back(
        fmt::format("{}: the faces of its rigid surface look away from \"{}\", and what comes from behind "
                    "passes: turn the faces round (the order of their nodes)",
                    at, *contact.group));
  }
  const double speed = std::isfinite(a.gap) ? a.speed : far_approach(s, c, state).value_or(1.0);
  if (speed <= 0.0 && a.gap > 0.0 && !is_turned && s.model().loads.empty()) {
    out.push_back(
        fmt::format("{}: nothing moves towards it (is the sign of the velocity or of the normal right?)", at));
  }
  if (*contact.kind == CaseContact::Kind::stop || a.stiffness <= 0.0) return;
  const Waves w = waves(s);
  // A plane wave presses with rho c v; the stiffness per area is that of the rows over the area they stand for.
  const double area = contact.per_node ? surface_area(s, contact) : a.measure;
  if (area <= 0.0) return;
  const double per_area = a.stiffness / area, penetration = w.impedance * a.speed / per_area;
  if (penetration > 0.01 * h) {
    out.push_back(
        fmt::format("{} is soft: impact at {:.4g} will penetrate by about {:.3g} ({:.3g} cells); stiffness {:.3g} "
                    "would keep it below 1 %",
                    at, a.speed, penetration, penetration / h, a.stiffness / a.measure * penetration / (0.01 * h)));
  }
  if (per_area > 20.0 * w.modulus / h) {
    out.push_back(
        fmt::format("{} is {:.3g} times stiffer than a cell (modulus / cell length = {:.3g}): more stiffness brings "
                    "noise and, in explicit runs, a smaller step, not accuracy",
                    at, per_area * h / w.modulus, w.modulus / h));
  }
}

/// Multipliers that throw back what touches them.
void lint_touches(const Simulation& s, std::vector<std::string>& out) {
  if (s.given().contacts.empty()) return;
  for (const auto& stage : s.stages()) {
    const std::string remedy = touch_remedy(*stage);
    if (!remedy.empty()) out.push_back(fmt::format("{}: {}", to_string(stage->scheme().where), remedy));
  }
}

/// A run in which no wave crosses a cell: somewhere a unit is wrong.
void lint_duration(const Simulation& s, std::vector<std::string>& out) {
  const bool is_static = std::all_of(s.stages().begin(), s.stages().end(),
                                     [](const auto& stage) { return stage->settings().kind == SchemeKind::statics; });
  const double travel = waves(s).speed * s.end(), h = smallest_cell(s);
  if (is_static || travel >= h) return;
  const std::string_view length = unit_name(Dimension::length, s.given().units);
  out.push_back(
      fmt::format("{}: waves travel {:.3g} {} in the whole run, less than the smallest cell ({:.3g} {}): nothing will "
                  "deform. Are the mesh, E, rho and the time in one system of units (units = \"{}\")?",
                  to_string(s.given().time.where), travel, length, h, length, name(s.given().units)));
}

void lint_scheme(const Simulation& s, std::vector<std::string>& out) {
  if (is_explicit(s.first().settings().kind) || s.first().settings().kind == SchemeKind::statics) return;
  const double courant = waves(s).speed * s.dt() / smallest_cell(s);
  if (courant > 20.0 && !s.given().contacts.empty()) {
    out.push_back(
        fmt::format("{}: Courant number {:.3g}: waves cross {:.3g} cells in a step; contact forces and wave fronts "
                    "will be smeared (step {:.3g} gives Courant number 1)",
                    to_string(s.given().time.where), courant, courant, s.dt() / courant));
  }
}

/// A filter that would not be applied, since the rows of probes.csv are too far apart.
void lint_filters(const Simulation& s, std::vector<std::string>& out) {
  const double sampling = s.dt() * s.given().output.curves_every * si_factor(Dimension::time, s.given().units);
  for (const CaseProbe& probe : s.given().probes) {
    if (!probe.cfc || sampling * *probe.cfc <= cfc_longest_sampling * (1.0 + 1e-9)) continue;
    out.push_back(fmt::format(
        "{}: probe \"{}\": will not be filtered: CFC {:g} needs a row at least every {:.3g} s, and rows will "
        "be {:.3g} s apart",
        to_string(probe.where), *probe.name, *probe.cfc, cfc_longest_sampling / *probe.cfc, sampling));
  }
}

std::string format_vector(const Vec3& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
}

}  // namespace

std::string touch_remedy(const Stage& stage) {
  const std::optional<double> rebound = touch_rebound(stage.settings());
  const bool has_inertia = **stage.scheme().mass != CaseScheme::Mass::modified;
  if (!rebound || !has_inertia || *rebound <= largest_touch_rebound) return {};
  return fmt::format(
      "{} with multipliers throws a node that touches for one step back with up to {:.3g} times its speed, and so "
      "makes "
      "energy where touches are short; generalized_alpha (at most 1.25 times), bathe, contact_stabilized_newmark, "
      "moreau_jean, or mass = \"modified\" do not",
      describe(stage.settings()), *rebound);
}

std::vector<std::string> lint_warnings(const Simulation& s) {
  std::vector<std::string> out = plausibility_warnings(s.given());
  const State state = s.initial_state();
  for (std::size_t c = 0; c < s.given().contacts.size(); ++c) lint_contact(s, c, state, out);
  lint_scheme(s, out);
  lint_duration(s, out);
  lint_touches(s, out);
  lint_filters(s, out);
  for (std::string& warning : locking_warnings(s)) out.push_back(std::move(warning));
  return out;
}

std::string check_summary(const Simulation& s) {
  const UnitSystem units = s.given().units;
  const auto unit = [&](Dimension d) { return unit_name(d, units); };
  const State state = s.initial_state();
  const double h = smallest_cell(s), c = waves(s).speed;
  std::string text = fmt::format("{}\n  units     {}\n  mesh      {} nodes, {} solid cells, smallest cell {:.4g} {}\n",
                                 s.given().title, name(units), s.mesh().node_count(), s.solid().cell_count(), h,
                                 unit(Dimension::length));
  for (const Part& part : s.model().parts) {
    const PartSummary p = summarise(s, part, state);
    text += fmt::format("  part      \"{}\": {} cells, mass {:.6g} {}, kinetic energy {:.6g} {}, momentum {}\n",
                        part.name, part.cells.size(), p.mass, unit(Dimension::mass), p.kinetic, unit(Dimension::energy),
                        format_vector(p.momentum));
  }
  for (const PointMass& point : s.model().point_masses) {
    text += fmt::format("  masses    {} nodes with {:.6g} {} each\n", point.nodes.size(), point.mass,
                        unit(Dimension::mass));
  }
  if (!s.model().springs.empty()) text += fmt::format("  springs   {}\n", s.model().springs.size());
  for (std::size_t i = 0; i < s.given().contacts.size(); ++i) {
    const Approach a = approach(s, i, state);
    const std::string touch =
        std::isfinite(a.first_touch) ? fmt::format("first touch at t = {:.6g}", a.first_touch) : "no approach";
    text += fmt::format("  contact   \"{}\": {}\n", *s.given().contacts[i].name,
                        std::isfinite(a.gap) ? fmt::format("gap {:.6g} {}, closing speed {:.6g}, {}", a.gap,
                                                           unit(Dimension::length), a.speed, touch)
                                             : "the surfaces are more than a facet apart");
  }
  const std::vector<double> bounds = s.solid().cell_frequency_bounds();
  const double estimate = 2.0 / std::sqrt(*std::max_element(bounds.begin(), bounds.end()));
  text += fmt::format(
      "  scheme    {}\n  step      {:.6g} {}, {} steps to t = {:.6g}; Courant number {:.3g} (fastest wave {:.5g})\n",
      s.first().name(), s.dt(), unit(Dimension::time), s.steps(), *s.given().time.end, c * s.dt() / h, c);
  const StableStep stable = s.stable();
  text += fmt::format(
      "  stable    explicit step {:.4g} with contact, {:.4g} without; element estimate (lumped mass) {:.4g}\n",
      stable.dt, stable.dt_free, estimate);
  if (std::isfinite(stable.dt_closing))
    text += fmt::format("  closing   contact springs that open and close need {:.4g}\n", stable.dt_closing);
  // 1 million cell-steps per second and core explicit, ten times that work per implicit step: orders of magnitude only.
  const bool implicit_scheme = !is_explicit(s.first().settings().kind);
  const double work =
      static_cast<double>(s.solid().cell_count()) * static_cast<double>(s.steps()) * (implicit_scheme ? 30.0 : 1.0);
  text += fmt::format("  cost      about {:.1g} s on one core\n", std::max(0.01, work / 2e6));
  return text;
}

}  // namespace carom
