#include "advise/lint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "advise/lint_contact.hpp"
#include "advise/lint_start.hpp"
#include "advise/lone_cells.hpp"
#include "advise/long_run.hpp"
#include "advise/loose_faces.hpp"
#include "advise/waves.hpp"
#include "base/units.hpp"
#include "casefile/plausibility.hpp"
#include "march/failure_text.hpp"
#include "output/cfc_filter.hpp"
#include "schemes/scheme_table.hpp"
#include "solid/smallest_cell.hpp"

namespace carom {

namespace {

/// Multipliers that throw back what touches them.
void lint_touches(const Simulation& s, std::vector<std::string>& out) {
  if (s.given().contacts.empty()) return;
  for (const auto& stage : s.stages()) {
    const std::string remedy = touch_remedy(*stage);
    if (!remedy.empty()) out.push_back(fmt::format("{}: {}", to_string(stage->scheme().where), remedy));
  }
}

/// A run in which no wave crosses a cell: somewhere a unit is wrong.
std::vector<UnitSign> lint_duration(const Simulation& s) {
  const bool is_static = std::all_of(s.stages().begin(), s.stages().end(),
                                     [](const auto& stage) { return !has_inertia(stage->settings().kind); });
  const double travel = waves(s).speed * s.end(), h = smallest_cell(s.solid());
  if (is_static || travel >= h) return {};
  const std::string_view length = unit_name(Dimension::length, s.given().units);
  return {
      {s.given().time.where,
       fmt::format("time: waves travel {:.3g} {} in the whole run, less than the smallest cell ({:.3g} {}): nothing "
                   "will deform",
                   travel, length, h, length),
       fmt::format("are the mesh, E, rho and the time in one system of units (units = \"{}\")?",
                   name(s.given().units))}};
}

void lint_scheme(const Simulation& s, std::vector<std::string>& out) {
  if (is_explicit(s.first().settings().kind) || !has_inertia(s.first().settings().kind)) return;
  const double courant = waves(s).speed * s.dt() / smallest_cell(s.solid());
  if (courant > 20.0 && !s.given().contacts.empty()) {
    out.push_back(
        fmt::format("{}: Courant number {:.3g}: waves cross {:.3g} cells in a step; contact forces and wave fronts "
                    "will be smeared (step {:.3g} gives Courant number 1)",
                    to_string(s.given().time.where), courant, courant, s.dt() / courant));
  }
}

/// Faces with two layers of cells behind them give a quarter of the mass away. More than that makes another body of it.
void lint_moved_mass(const Simulation& s, std::vector<std::string>& out) {
  constexpr double most = 0.25;
  for (const auto& stage : s.stages()) {
    const double share = stage->mass_notes().moved_share;
    if (share <= most * (1.0 + 1e-9)) continue;
    out.push_back(
        fmt::format("{}: the modified mass takes {:.3g} % of all mass from contact nodes to the inside, so that waves "
                    "and rotations go wrong by up to as much: let contact groups hold only the faces that can touch, "
                    "refine the mesh behind them, or choose another scheme",
                    to_string(stage->scheme().where), 100.0 * share));
  }
}

/// A filter that would not be applied, since the rows of probes.csv are too far apart.
void lint_filters(const Simulation& s, std::vector<std::string>& out) {
  double dt = 0.0;
  for (const auto& stage : s.stages())
    if (has_inertia(stage->settings().kind)) dt = std::max(dt, stage->dt());
  const double sampling = dt * s.given().output.curves_every * si_factor(Dimension::time, s.given().units);
  const auto lint = [&](const char* what, const std::string& name, const Location& where, std::optional<double> cfc) {
    if (!cfc || sampling * *cfc <= cfc_longest_sampling * (1.0 + 1e-9)) return;
    out.push_back(fmt::format(
        "{}: {} \"{}\": will not be filtered: CFC {:g} needs a row at least every {:.3g} s, and rows will be {:.3g} s "
        "apart",
        to_string(where), what, name, *cfc, cfc_longest_sampling / *cfc, sampling));
  };
  for (const CaseProbe& probe : s.given().probes) lint("probe", *probe.name, probe.where, probe.cfc);
  for (const CaseContact& contact : s.given().contacts) lint("contact", *contact.name, contact.where, contact.cfc);
}

}  // namespace

std::vector<std::string> lint_warnings(const Simulation& s) {
  std::vector<std::string> out = plausibility_warnings(s.given(), lint_duration(s));
  for (std::string& warning : start_warnings(s)) out.push_back(std::move(warning));
  for (std::string& warning : contact_warnings(s)) out.push_back(std::move(warning));
  for (std::string& warning : loose_face_warnings(s)) out.push_back(std::move(warning));
  lint_scheme(s, out);
  if (std::optional<std::string> warning = long_run_warning(s)) out.push_back(std::move(*warning));
  lint_touches(s, out);
  lint_moved_mass(s, out);
  lint_filters(s, out);
  for (std::string& warning : lone_cell_warnings(s)) out.push_back(std::move(warning));
  return out;
}

}  // namespace carom
