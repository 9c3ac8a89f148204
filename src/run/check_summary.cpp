#include "run/check_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/units.hpp"
#include "math/vec3.hpp"
#include "run/approach.hpp"
#include "run/build_mesh.hpp"
#include "run/cost_estimate.hpp"
#include "run/lint.hpp"
#include "run/locking.hpp"
#include "run/recorder.hpp"
#include "run/waves.hpp"
#include "solid/smallest_cell.hpp"

namespace carom {

namespace {

/// Mass, kinetic energy and momentum of one part, by the lumped shares of its cells (exact for a common velocity).
struct PartLine {
  double mass = 0.0, kinetic = 0.0;
  Vec3 momentum{};
};

PartLine summarise(const Simulation& s, const Part& part, const State& state) {
  PartLine sum;
  const double rho = part.material.rho;
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

std::string format_vector(const Vec3& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v[0], v[1], v[2]);
}

std::string count_of(long long n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string describe(const Approach& a, const UnitSystem units) {
  if (!std::isfinite(a.gap)) return "the surfaces are more than a facet apart";
  const std::string touch =
      std::isfinite(a.first_touch) ? fmt::format("first touch at t = {:.6g}", a.first_touch) : "no approach";
  return fmt::format("gap {:.6g} {}, closing speed {:.6g}, {}", a.gap, unit_name(Dimension::length, units), a.speed,
                     touch);
}

/// Scheme, step, end and Courant number of one stage; statics knows no waves.
std::string describe(const Stage& stage, const Simulation& s) {
  const bool is_static = stage.settings().kind == SchemeKind::statics;
  const Waves wave = waves(s);
  return fmt::format("  scheme    {}\n  step      {:.6g} {}, {} from t = {:.6g} to {:.6g}{}\n", stage.name(),
                     stage.dt(), unit_name(Dimension::time, s.given().units), count_of(stage.steps(), "step"),
                     stage.begin(), stage.end(),
                     is_static ? ""
                               : fmt::format("; Courant number {:.3g} (fastest wave {:.5g})",
                                             wave.speed * stage.dt() / smallest_cell(s.solid()), wave.speed));
}

std::string step_text(double step) {
  return std::isfinite(step) ? fmt::format("{:.4g}", step) : "of any length";
}

/// What bounds the step on account of cells that supports strain.
std::string describe_driven(const Stage& stage, const Simulation& s) {
  const DrivenCells& driven = stage.driven();
  if (driven.count == 0) return {};
  const CellRef& cell = s.solid().cells()[static_cast<std::size_t>(driven.first)];
  const CellBlock& block = s.mesh().blocks[static_cast<std::size_t>(cell.block)];
  return fmt::format(
      "  driven    {} strained by supports alone, as cell {}: free, the stable step would be {}; for {:g} % of strain "
      "a "
      "step {}\n",
      count_of(driven.count, "cell"), block.file_numbers[static_cast<std::size_t>(cell.cell)],
      step_text(stable_step_of(stability_limit(stage.settings()), driven.omega_max_squared)),
      100.0 * most_imposed_strain, step_text(driven.dt_strain));
}

}  // namespace

std::string check_summary(const Simulation& s) {
  const UnitSystem units = s.given().units;
  const auto unit = [&](Dimension d) { return unit_name(d, units); };
  const State state = s.initial_state();
  std::string text =
      fmt::format("{}\n  units     {}\n  mesh      {}, {}, smallest cell {:.4g} {}\n", s.given().title, name(units),
                  count_of(static_cast<long long>(given_nodes(s.given(), s.mesh())), "node"),
                  count_of(static_cast<long long>(s.solid().cell_count()), "solid cell"), smallest_cell(s.solid()),
                  unit(Dimension::length));
  for (const Part& part : s.model().parts) {
    const PartLine p = summarise(s, part, state);
    text += fmt::format("  part      \"{}\": {}, mass {:.6g} {}, kinetic energy {:.6g} {}, momentum {}\n", part.name,
                        count_of(static_cast<long long>(part.cells.size()), "cell"), p.mass, unit(Dimension::mass),
                        p.kinetic, unit(Dimension::energy), format_vector(p.momentum));
  }
  for (const PointMass& point : s.model().point_masses) {
    text +=
        fmt::format("  masses    {} with {:.6g} {} each\n",
                    count_of(static_cast<long long>(point.nodes.size()), "node"), point.mass, unit(Dimension::mass));
  }
  if (!s.model().springs.empty()) text += fmt::format("  springs   {}\n", s.model().springs.size());
  if (!s.model().equations.empty()) text += fmt::format("  equations {}\n", s.model().equations.size());
  const std::vector<Approach> contacts = approaches(s, state);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    text += fmt::format("  contact   \"{}\": {}\n", *s.given().contacts[i].name, describe(contacts[i], units));
  for (const auto& stage : s.stages()) text += describe(*stage, s);
  const StableStep stable = s.stable();
  text += fmt::format("  stable    explicit step {} with contact, {} without; element estimate (lumped mass) {}\n",
                      step_text(stable.dt), step_text(stable.dt_free),
                      step_text(stable_step_of(2.0, s.solid().largest_frequency_bound())));
  if (std::isfinite(stable.dt_closing))
    text += fmt::format("  closing   contact springs that open and close need {:.4g}\n", stable.dt_closing);
  for (const auto& stage : s.stages()) text += describe_driven(*stage, s);
  const CostEstimate cost = estimate_cost(s);
  return text + fmt::format("  cost      {} on one core, {} of memory, {} on disk ({})\n", about_seconds(cost.seconds),
                            about_bytes(cost.memory_bytes), about_bytes(cost.disk_bytes),
                            count_of(cost.frames, "file") + " of fields");
}

std::string Examination::text() const {
  std::string out = summary;
  for (const std::string& note : notes) out += fmt::format("note: {}\n", note);
  for (const std::string& warning : warnings) out += fmt::format("warning: {}\n", warning);
  return out + (warnings.empty() ? "ready to run"
                                 : fmt::format("{} warning{}", warnings.size(), warnings.size() == 1 ? "" : "s"));
}

Examination examine(const Simulation& simulation, const std::string& folder) {
  const RunTables tables(simulation);
  Examination out{check_summary(simulation), simulation.notes(), lint_warnings(simulation)};
  const std::vector<std::string>& places = tables.probes.notes();
  out.notes.insert(out.notes.end(), places.begin(), places.end());
  for (Doubt& doubt : locking_doubts(simulation)) out.warnings.push_back(std::move(doubt.warning));
  for (std::string& warning : cost_warnings(simulation, folder)) out.warnings.push_back(std::move(warning));
  return out;
}

}  // namespace carom
