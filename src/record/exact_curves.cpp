#include "record/exact_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>

#include "exact/solution.hpp"

namespace carom {

namespace {

using Columns = std::vector<ExactCurves::Column>;

/// Makes the columns of one case.
class CurveBuilder {
 public:
  CurveBuilder(const Simulation& simulation, const ProbeCurves& probes)
      : simulation_(simulation),
        given_(simulation.given()),
        exact_(*given_.exact),
        probes_(probes),
        axis_(static_cast<std::size_t>(exact_.axis)),
        letter_("xyz"[axis_]) {}

  Columns build() {
    const std::string& solution = *exact_.solution;
    try {
      add(exact_solution(solution).motion(exact_.values, case_of_solution()));
    } catch (const std::invalid_argument& error) {
      throw CaseError(exact_.where, "exact", error.what(), fmt::format("the data of {}", solution));
    }
    return std::move(columns_);
  }

 private:
  ExactCase case_of_solution() const {
    constexpr double past_the_end = 1.0 + 1e-6;  // so that the last step's rounding stays inside
    return {.until = simulation_.end() * past_the_end,
            .lowest = lowest(),
            .parts = given_.parts.size(),
            .pressed_part = pressed_part()};
  }

  void add(const ExactMotion& motion) {
    if (motion.at) add_probes(motion);
    if (motion.force) add_force(motion.force);
    if (motion.obstacle_velocity && given_.contacts.size() == 1)
      columns_.push_back({fmt::format("{}.velocity_{}", *given_.contacts[0].name, letter_), motion.obstacle_velocity});
    for (const auto& [term, value] : motion.energies) columns_.push_back({term, value});
  }

  void add_probes(const ExactMotion& motion) {
    for (std::size_t p = 0; p < given_.probes.size(); ++p) {
      const std::vector<Index>& nodes = probes_.nodes(p);
      if (nodes.empty()) continue;  // of a part, not of a place
      const std::string& probe = *given_.probes[p].name;
      const ExactPoint point = motion.at({.x = probes_.positions()[p][axis_], .part = part_of_node(nodes.front())});
      add_probe_column(fmt::format("{}.displacement_{}", probe, letter_), point.displacement);
      add_probe_column(fmt::format("{}.velocity_{}", probe, letter_), point.velocity);
      add_probe_column(fmt::format("{}.stress_{}{}", probe, letter_, letter_), point.stress);
    }
  }

  void add_probe_column(const std::string& name, const ExactCurve& value) {
    if (value && probes_.table().find(name)) columns_.push_back({name, value});
  }

  /// Of the only resultant, where there is one.
  void add_force(const ExactCurve& value) {
    const ContactResultants resultants(simulation_.model(), std::vector<std::optional<Vec3>>(given_.contacts.size()));
    if (resultants.places().size() == 1)
      columns_.push_back({fmt::format("{}.force_{}", resultants.places()[0].name, letter_), value});
  }

  /// Lowest coordinate of the parts along the axis.
  double lowest() const {
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < simulation_.solid().cells().size(); ++k)
      for (const Index n : simulation_.solid().cells().nodes_of(k))
        low = std::min(low, simulation_.mesh().coordinates[static_cast<std::size_t>(n)][axis_]);
    return low;
  }

  /// Position in the case of the part that holds the node.
  int part_of_node(Index node) const {
    std::size_t cell = 0;
    const std::vector<Part>& parts = simulation_.model().parts;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (std::size_t k = 0; k < parts[p].cells.size(); ++k, ++cell) {
        const auto nodes = simulation_.solid().cells().nodes_of(cell);
        if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) return simulation_.model().part_numbers()[p];
      }
    }
    return 0;
  }

  /// The part that the contact's force acts on: the first of two in self-contact (ResultantPlace).
  int pressed_part() const {
    if (simulation_.model().contacts.empty()) return 1;
    const ContactParts contact = parts_of(simulation_.model().contacts[0]);
    if (contact.is_self) return 0;
    const bool is_pair = contact.other != nullptr && contact.nature == ContactNature::touches;
    return !is_pair || contact.own->facets.empty() ? 1 : part_of_node(contact.own->facets[0][0]);
  }

  const Simulation& simulation_;
  const Case& given_;
  const CaseExact& exact_;
  const ProbeCurves& probes_;
  std::size_t axis_;
  char letter_;
  Columns columns_;
};

}  // namespace

ExactCurves::ExactCurves(const Simulation& simulation, const ProbeCurves& probes)
    : columns_(CurveBuilder(simulation, probes).build()) {
  table_.columns = {"time"};
  for (const Column& c : columns_) table_.columns.push_back(c.name);
}

std::optional<double> ExactCurves::value(const std::string& column, double t) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == column; });
  if (found == columns_.end()) return std::nullopt;
  return found->value(t);
}

void ExactCurves::sample(double t) {
  table_.row = {t};
  for (const Column& c : columns_) table_.row.push_back(c.value(t));
}

}  // namespace carom
