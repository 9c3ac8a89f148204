#include "advise/law_depth_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/units.hpp"

namespace carom {

void LawDepthWatch::see(const StepView& view) {
  depths_.resize(view.stage.model().contacts.size());
  const ConstraintRows& rows = *view.forces.rows.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows.law[r].own.table == nullptr || view.forces.rows.status[r] == RowStatus::open) continue;
    double& depth = depths_[at(rows.source[r])];
    depth = std::max(depth, -rows.gap_at(r, view.state.q));
  }
}

std::vector<Doubt> LawDepthWatch::doubts(const Simulation& s) const {
  constexpr double rounding = 1e-9;
  std::vector<Doubt> out;
  for (std::size_t c = 0; c < depths_.size(); ++c) {
    const ContactLaw* law = law_of(s.model().contacts[c]);
    if (law == nullptr || !law->pressure || depths_[c] <= law->pressure->last_depth() * (1.0 + rounding)) continue;
    const CaseContact& given = s.given().contacts[c];
    const double last = law->pressure->last_depth();
    out.push_back(
        {fmt::format("contact \"{}\" was deeper than its law goes", *given.name),
         fmt::format("{}: contact \"{}\" was pressed to a depth of {:.4g} {}, {:.3g} times the last of its "
                     "`depths`, {:.4g}: beyond it the last slope was continued; give the law up to {:.2g}",
                     to_string(given.where), *given.name, depths_[c], unit_name(Dimension::length, s.given().units),
                     depths_[c] / last, last, 1.1 * depths_[c])});
  }
  return out;
}

}  // namespace carom
