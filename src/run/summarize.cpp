#include "run/summarize.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "base/version.hpp"
#include "build/build_mesh.hpp"
#include "build/digests.hpp"
#include "march/body_scales.hpp"
#include "march/verdict.hpp"
#include "parallel/threads.hpp"
#include "run/crossings.hpp"

namespace carom {

namespace {

/// Round-off, but where a scheme keeps the angular momentum of turning bodies to its order only, and where parts of
/// small strain stand beside others.
double angular_limit(const Simulation& s) {
  const auto keeps_it = [](const auto& stage) {
    return traits(stage->settings().kind).angular_momentum == AngularMomentum::exactly;
  };
  const auto is_small_strain = [](const Part& part) { return part.material.law->measure == Measure::small_strain; };
  const std::vector<Part>& parts = s.model().parts;
  // Moments are taken where nodes stand; the internal forces of small strain and springs balance where nodes stood.
  const bool is_mixed = !s.solid().is_linear() &&
                        (!s.model().springs.empty() || std::any_of(parts.begin(), parts.end(), is_small_strain));
  const bool is_kept = !is_mixed && std::all_of(s.stages().begin(), s.stages().end(), keeps_it);
  const bool exact = s.solid().is_linear() || is_kept;
  return exact ? 1e-9 : 1e-2;
}

/// That of the stage that may gain most.
double gain_limit(const Simulation& s) {
  double limit = 0.0;
  for (const auto& stage : s.stages()) limit = std::max(limit, traits(stage->settings().kind).gains);
  return limit;
}

/// All schemes of the run, in their order.
std::string scheme_names(const Simulation& s) {
  std::string names;
  for (const auto& stage : s.stages()) names += (names.empty() ? "" : "; then ") + stage->name();
  return names;
}

}  // namespace

VerdictItem body_strain_item(double strain) {
  constexpr double limit = 1e-3, margin = 2.0;
  std::string text = "largest strain of the rigid bodies that turn, which should have none";
  if (strain > limit)
    text += fmt::format(": it falls with the square of their rigidity, which {:.2g} times as high would do",
                        std::sqrt(margin * strain / limit));
  return {"rigid body strain", strain, limit, strain <= limit, text};
}

void fill(Summary& summary, const Simulation& s, const March& march) {
  summary.scheme = {scheme_names(s),     march.is_started() ? march.scheme().solver_name(march.state()) : "",
                    march.dt_smallest(), march.dt_largest(),
                    march.steps(),       march.end(),
                    march.state().t};
  for (const auto& stage : s.stages()) {
    const Stage::MassNotes& notes = stage->mass_notes();
    if (notes.added > summary.scheme.added_mass) {
      summary.scheme.added_mass = notes.added;
      summary.scheme.added_mass_share = notes.added_share;
    }
    summary.scheme.mass_notes.insert(summary.scheme.mass_notes.end(), notes.lines.begin(), notes.lines.end());
  }
  double stage_begin = 0.0;
  for (const auto& stage : s.stages()) {
    summary.scheme.stages.push_back({stage->name(), stage_begin, stage->end()});
    stage_begin = stage->end();
  }
  summary.scheme.stages.back().end = march.end();
  if (!march.is_started()) return;
  const EnergyLedger& ledger = march.ledger();
  const RunMonitor& monitor = march.monitor();
  const EnergyTerms e = ledger.now();
  for (const EnergyTerm& term : energy_terms) summary.ledger.push_back({std::string(term.name), e.*term.value});
  summary.ledger.push_back({"imbalance", ledger.imbalance()});
  const std::array<double, 6> aster = aster_values(ledger.aster());
  for (std::size_t i = 0; i < aster.size(); ++i) summary.code_aster.push_back({std::string(aster_names[i]), aster[i]});
  const Momentum begin = ledger.initial_momentum(), end = ledger.momentum(), impulse = ledger.impulse();
  summary.linear_momentum = {begin.linear, end.linear, impulse.linear, monitor.linear_momentum_error()};
  summary.angular_momentum = {begin.angular, end.angular, impulse.angular, monitor.angular_momentum_error()};
  // Energies at whole steps and the one that explicit schemes keep, differ by h^2/8 a.Ma with central differences.
  const double lent = 0.25 * march.dt_largest() * march.dt_largest() * march.state().forces.inertia_power;
  summary.verdict = monitor.items({angular_limit(s), gain_limit(s), lent});
}

Summary summary_of(const Simulation& s) {
  Summary summary;
  summary.program = {version(), compiler(), std::string(name(chosen_isa())), thread_count()};
  summary.case_info = {s.given().file, s.given().title, std::string(name(s.given().units))};
  summary.mesh.nodes = given_nodes(s.given(), s.mesh());
  summary.mesh.cells = s.solid().cells().size();
  summary.mesh.reach = reach(s.mesh());
  summary.mesh.checksum = fmt::format("{:016x}", mesh_digest(s.mesh()));
  for (const CaseContact& contact : s.given().contacts) {
    summary.contacts.push_back(*contact.name);
    if (const auto* tie = std::get_if<CaseTie>(&contact.of); tie != nullptr && !tie->tears())
      summary.ties.push_back(*contact.name);
  }
  summary.crossings = crossing_times(s);
  for (const std::string& group : s.mesh().group_names()) {
    const auto cells = s.mesh().cell_groups.find(group);
    summary.mesh.groups.push_back(
        {group, s.mesh().nodes_of(group).size(), cells == s.mesh().cell_groups.end() ? 0 : cells->second.size()});
  }
  return summary;
}

/// Fails what did not pass; "good" and "failed" only for runs that reached the end.
void judge(Summary& summary) {
  const auto failed = [](const auto& list) {
    return std::count_if(list.begin(), list.end(), [](const auto& item) { return !item.pass; });
  };
  const auto checks = failed(summary.checks), items = failed(summary.verdict);
  if (summary.outcome != Outcome::good) return;
  if (checks + items > 0) summary.outcome = Outcome::failed;
  std::string verdict = fmt::format("{} of {} verdict items passed",
                                    summary.verdict.size() - static_cast<std::size_t>(items), summary.verdict.size());
  const char* before = " (not ";
  for (const VerdictItem& item : summary.verdict) {
    if (!item.pass) verdict += std::exchange(before, ", ") + item.name;
  }
  if (items > 0) verdict += ")";
  summary.message = summary.checks.empty() ? verdict + "; no checks: nothing was compared"
                                           : fmt::format("{} of {} checks and {}",
                                                         summary.checks.size() - static_cast<std::size_t>(checks),
                                                         summary.checks.size(), verdict);
  if (!summary.doubts.empty()) summary.message += fmt::format("; in doubt: {}", fmt::join(summary.doubts, ", "));
}

}  // namespace carom
