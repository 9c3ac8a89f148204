#include "advise/check_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "advise/approach.hpp"
#include "advise/cost_estimate.hpp"
#include "advise/lint.hpp"
#include "advise/locking.hpp"
#include "advise/stage_time.hpp"
#include "advise/waves.hpp"
#include "base/amounts.hpp"
#include "base/types.hpp"
#include "base/units.hpp"
#include "build/build_mesh.hpp"
#include "math/vec3.hpp"
#include "record/frame_plan.hpp"
#include "record/recorder.hpp"
#include "solid/loads.hpp"
#include "solid/part_inertia.hpp"
#include "solid/smallest_cell.hpp"
#include "solid/stability.hpp"

namespace carom {

namespace {

/// Mass, kinetic energy and momentum of one part, by the lumped shares of its cells (exact for a common velocity).
struct PartLine {
  std::string name;
  long long cells = 0;
  double mass = 0.0, kinetic = 0.0;
  Vec3 momentum{};
  std::string rigid_body;            ///< whose mass is that of the whole
  std::vector<const Part*> parts{};  ///< of one name, one for each type of cells
};

void summarise(const Simulation& s, const Part& part, std::size_t first, const State& state, PartLine& sum) {
  const Solid& solid = s.solid();
  sum.cells += static_cast<long long>(part.cells.size());
  if (part.rigid_body >= 0) {
    sum.rigid_body = s.model().turning_bodies[static_cast<std::size_t>(part.rigid_body)].name;
    return;
  }
  for (std::size_t k = first; k < first + part.cells.size(); ++k) {
    const std::span<const Index> nodes = solid.cells().nodes_of(k);
    const double share = part.material.rho * solid.cells().volumes[k] / static_cast<double>(nodes.size());
    for (const Index node : nodes) {
      const auto n = static_cast<std::size_t>(node);
      const Vec3 v{state.v[3 * n], state.v[3 * n + 1], state.v[3 * n + 2]};
      sum.mass += share;
      sum.kinetic += 0.5 * share * dot(v, v);
      sum.momentum = add(sum.momentum, scaled(v, share));
    }
  }
}

/// One line for each part.
std::vector<PartLine> summarise(const Simulation& s, const State& state) {
  std::vector<PartLine> lines;
  const std::vector<Index> numbers = s.model().part_numbers();
  std::size_t first = 0;  // the solid has the cells part after part
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    const Part& part = s.model().parts[p];
    if (at(numbers[p]) == lines.size()) lines.push_back({part.name, 0, 0.0, 0.0, {}, {}});
    lines.back().parts.push_back(&part);
    summarise(s, part, first, state, lines.back());
    first += part.cells.size();
  }
  return lines;
}

/// What is rounding beside `size` is 0.
std::string format_vector(Vec3 v, double size = 0.0) {
  for (double& component : v)
    if (std::abs(component) < 1e-12 * size) component = 0.0;
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
}

std::string format_momentum(const PartLine& of) {
  return format_vector(of.momentum, std::sqrt(2.0 * of.mass * of.kinetic));
}

/// Centre, and inertia about it; of rings their mass says all.
std::string describe_inertia(const Mesh& mesh, std::span<const Part* const> parts, UnitSystem units) {
  const auto is_ring = [](const Part* part) { return part->section == Section::axisymmetric; };
  if (std::ranges::any_of(parts, is_ring)) return {};
  constexpr double noise = 1e-9;
  const PartInertia its = inertia_of(mesh, parts);
  const double trace = its.moments[0] + its.moments[1] + its.moments[2];
  const bool is_turned = norm(its.products) > noise * trace;
  return fmt::format("            centre {}, inertia about it {}{} {} {}2\n",
                     format_vector(its.centre, std::sqrt(trace / its.mass)), format_vector(its.moments),
                     is_turned ? ", products xy, yz, zx " + format_vector(its.products) : "",
                     unit_name(Dimension::mass, units), unit_name(Dimension::length, units));
}

/// Several parts together; nothing of one.
std::string describe_all(const Mesh& mesh, std::span<const PartLine> lines, UnitSystem units) {
  PartLine all;
  std::size_t count = 0;
  for (const PartLine& line : lines) {
    if (!line.rigid_body.empty()) continue;
    ++count;
    all.mass += line.mass;
    all.kinetic += line.kinetic;
    all.momentum = add(all.momentum, line.momentum);
    all.parts.insert(all.parts.end(), line.parts.begin(), line.parts.end());
  }
  if (count < 2) return {};
  return fmt::format("  all parts mass {:.6g} {}, kinetic energy {:.6g} {}, momentum {}\n", all.mass,
                     unit_name(Dimension::mass, units), all.kinetic, unit_name(Dimension::energy, units),
                     format_momentum(all)) +
         describe_inertia(mesh, all.parts, units);
}

std::string count_of(long long n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string describe(const CaseContact& contact, const Approach& a, const UnitSystem units) {
  if (const auto* tie = std::get_if<CaseTie>(&contact.of))
    return tie->tears() ? "holds its sides together until it tears" : "holds its sides together";
  if (!std::isfinite(a.gap)) return "the surfaces are more than a facet apart";
  if (a.gap > 0.0 && std::abs(a.speed) <= a.speed_rounding)
    return fmt::format("gap {:.6g} {}, its sides move together", a.gap, unit_name(Dimension::length, units));
  const std::string touch =
      std::isfinite(a.first_touch) ? fmt::format("first touch at t = {:.6g}", a.first_touch) : "no approach";
  return fmt::format("gap {:.6g} {}, closing speed {:.6g}, {}", a.gap, unit_name(Dimension::length, units), a.speed,
                     touch);
}

/// Scheme, step, end and Courant number of one stage; statics knows no waves.
std::string describe(const Stage& stage, long long steps, const Simulation& s) {
  const bool is_static = !has_inertia(stage.settings().kind);
  const Waves wave = waves(s);
  return fmt::format("  scheme    {}\n  step      {:.6g} {}{}, {}{} from t = {:.6g} to {:.6g}{}\n", stage.name(),
                     stage.dt(), unit_name(Dimension::time, s.given().units),
                     steps > stage.steps() ? " (shorter on the way)" : "", steps != stage.steps() ? "about " : "",
                     count_of(steps, "step"), stage.begin(), stage.end(),
                     is_static ? ""
                               : fmt::format("; Courant number {:.3g} (fastest wave {:.5g})",
                                             wave.speed * stage.dt() / smallest_cell(s.solid()), wave.speed));
}

std::string describe(const Rehearsal& seen) {
  long long steps = 0;
  for (const Pace& stage : seen.stages) steps += stage.steps;
  return fmt::format("  rehearsed {}, {}\n", count_of(steps, "step"),
                     seen.is_whole ? "to the end" : fmt::format("to t = {:.6g}", seen.t));
}

std::string step_text(double step) {
  return std::isfinite(step) ? fmt::format("{:.4g}", step) : "of any length";
}

/// What bounds the step on account of cells that supports strain.
std::string describe_driven(const Stage& stage, const Simulation& s) {
  const DrivenCells& driven = stage.driven();
  if (driven.count == 0) return {};
  const CellRef& cell = s.solid().cells()[static_cast<std::size_t>(driven.first)];
  return fmt::format(
      "  driven    {} strained by supports alone, as cell {}: free, the stable step would be {}; for {:g} % of strain "
      "a step {}\n",
      count_of(driven.count, "cell"), s.mesh().cell_label(cell),
      step_text(stable_step_of(stability_limit(stage.settings()), driven.omega_max_squared)),
      100.0 * most_imposed_strain, step_text(driven.dt_strain));
}

/// Forces and pressures: what all nodes together have, times the function of the load.
std::string describe_loads(const Simulation& s) {
  std::string text;
  const std::vector<LoadVector> vectors = make_loads(s.model());
  auto vector = vectors.begin();
  for (const CaseLoad& load : s.given().loads) {
    if (load.kind == CaseLoad::Kind::gravity) continue;
    Vec3 sum{};
    for (const Vec3& force : vector->force) sum = add(sum, force);
    text += fmt::format("  load      on \"{}\": {} {} in all{}\n", **load.group, format_vector(sum, norm(sum)),
                        unit_name(Dimension::force, s.given().units),
                        load.function ? fmt::format(", times \"{}\"", **load.function) : "");
    ++vector;
  }
  return text;
}

std::string describe(const Erosion& erosion, std::string_view time) {
  std::vector<std::string> when;
  if (erosion.plastic_strain) when.push_back(fmt::format("a plastic strain of {:g}", *erosion.plastic_strain));
  if (erosion.damage) when.push_back(fmt::format("a damage of {:g}", *erosion.damage));
  if (erosion.distortion) when.push_back(fmt::format("a corner's volume of {:g} of that at rest", *erosion.distortion));
  if (erosion.time) when.push_back(fmt::format("t = {:g} {}", *erosion.time, time));
  return fmt::format("  erosion   \"{}\": {} may go, at {}\n", erosion.name,
                     count_of(static_cast<long long>(erosion.cells.size()), "cell"), fmt::join(when, " or "));
}

/// A free rigid body that turns, as its four nodes have it.
std::string describe(const TurningBody& body, const Simulation& s, const State& state) {
  if (body.is_led()) return {};
  const auto unit = [&](Dimension d) { return unit_name(d, s.given().units); };
  double kinetic = 0.0;
  Vec3 momentum{};
  for (const Vec3& v : nodal_values(body, state.v)) {
    kinetic += 0.125 * body.mass * dot(v, v);
    momentum = add(momentum, scaled(v, 0.25 * body.mass));
  }
  return fmt::format("  rigid     \"{}\": mass {:.6g} {}, centre {}, kinetic energy {:.6g} {}, momentum {}\n",
                     body.name, body.mass, unit(Dimension::mass), format_vector(body.centre), kinetic,
                     unit(Dimension::energy), format_vector(momentum));
}

}  // namespace

std::string check_summary(const Simulation& s, const Rehearsal& seen) {
  const UnitSystem units = s.given().units;
  const auto unit = [&](Dimension d) { return unit_name(d, units); };
  const State state = s.initial_state();
  std::string text =
      fmt::format("{}\n  units     {}\n  mesh      {}, {}, smallest cell {:.4g} {}\n", s.given().title, name(units),
                  count_of(static_cast<long long>(given_nodes(s.given(), s.mesh())), "node"),
                  count_of(static_cast<long long>(s.solid().cells().size()), "solid cell"), smallest_cell(s.solid()),
                  unit(Dimension::length));
  const std::vector<PartLine> lines = summarise(s, state);
  for (const PartLine& p : lines) {
    if (!p.rigid_body.empty()) {
      text +=
          fmt::format("  part      \"{}\": {} of rigid body \"{}\"\n", p.name, count_of(p.cells, "cell"), p.rigid_body);
      continue;
    }
    text += fmt::format("  part      \"{}\": {}, mass {:.6g} {}, kinetic energy {:.6g} {}, momentum {}\n", p.name,
                        count_of(p.cells, "cell"), p.mass, unit(Dimension::mass), p.kinetic, unit(Dimension::energy),
                        format_momentum(p));
    text += describe_inertia(s.mesh(), p.parts, units);
  }
  text += describe_all(s.mesh(), lines, units);
  for (const TurningBody& body : s.model().turning_bodies) text += describe(body, s, state);
  for (const PointMass& point : s.model().point_masses) {
    text +=
        fmt::format("  masses    {} with {:.6g} {} each\n",
                    count_of(static_cast<long long>(point.nodes.size()), "node"), point.mass, unit(Dimension::mass));
  }
  text += describe_loads(s);
  for (const Erosion& erosion : s.model().erosion) text += describe(erosion, unit(Dimension::time));
  if (!s.model().springs.empty()) text += fmt::format("  springs   {}\n", s.model().springs.size());
  if (!s.model().equations.empty()) text += fmt::format("  equations {}\n", s.model().equations.size());
  const std::vector<Approach> contacts = approaches(s, state);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    text += fmt::format("  contact   \"{}\": {}\n", *s.given().contacts[i].name,
                        describe(s.given().contacts[i], contacts[i], units));
  const CostEstimate cost = estimate_cost(s, seen);
  for (std::size_t i = 0; i < s.stages().size(); ++i) text += describe(*s.stages()[i], cost.stages[i].steps, s);
  const StableStep stable = s.stable();
  text += fmt::format("  stable    explicit step {} with contact, {} without; element estimate (lumped mass) {}\n",
                      step_text(stable.dt), step_text(stable.dt_free),
                      step_text(stable_step_of(2.0, largest_frequency_bound(s.solid()))));
  if (std::isfinite(stable.dt_closing))
    text += fmt::format("  closing   contact springs that open and close need {:.4g}\n", stable.dt_closing);
  for (const auto& stage : s.stages()) text += describe_driven(*stage, s);
  if (!seen.stages.empty()) text += describe(seen);
  return text + fmt::format("  cost      {} on one core, {} of memory, {} on disk ({})\n", about_seconds(cost.seconds),
                            about_bytes(cost.memory_bytes), about_bytes(cost.disk_bytes),
                            count_of(cost.frames, "frame") + " of fields");
}

std::string Examination::text() const {
  std::string out = summary;
  for (const std::string& note : notes) out += fmt::format("note: {}\n", note);
  for (const std::string& warning : warnings) out += fmt::format("warning: {}\n", warning);
  return out + (warnings.empty() ? "ready to run"
                                 : fmt::format("{} warning{}", warnings.size(), warnings.size() == 1 ? "" : "s"));
}

Examination examine(const Simulation& simulation, const std::string& folder, double rehearsal) {
  const RunTables tables(simulation);
  const Rehearsal seen = rehearsal > 0.0 ? rehearse(simulation, rehearsal) : Rehearsal{};
  Examination out{check_summary(simulation, seen), simulation.notes(), lint_warnings(simulation)};
  const std::vector<std::string>& places = tables.probes.notes();
  out.notes.insert(out.notes.end(), places.begin(), places.end());
  if (std::string note = frame_note(simulation); !note.empty()) out.notes.push_back(std::move(note));
  for (Doubt& doubt : locking_doubts(simulation)) out.warnings.push_back(std::move(doubt.warning));
  for (std::string& warning : cost_warnings(simulation, folder, seen)) out.warnings.push_back(std::move(warning));
  if (!seen.failure.empty()) out.warnings.push_back(fmt::format("the run will not come to its end: {}", seen.failure));
  return out;
}

}  // namespace carom
