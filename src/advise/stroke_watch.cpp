#include "advise/stroke_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rows/admissible.hpp"

namespace carom {

void StrokeWatch::see(const StepView& view) {
  const SchemeSettings& settings = view.stage.settings();
  if (has_inertia(settings.kind) || settings.enforcement != EnforcementKind::penalty) return;
  for (const PrescribedDof& p : view.stage.system().supports.prescribed())
    motion_ = std::max(motion_, std::abs(view.state.q[static_cast<std::size_t>(p.dof)]));
  const ConstraintRows& rows = *view.forces.rows.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const ContactDefinition* contact =
        rows.source[r] < 0 ? nullptr : &view.stage.model().contacts[static_cast<std::size_t>(rows.source[r])];
    if (contact == nullptr || is_bond(rows.law[r]) || parts_of(*contact).nature == ContactNature::springs) continue;
    if (view.forces.rows.status[r] != RowStatus::open) depth_ = std::max(depth_, -rows.gap_at(r, view.state.q));
  }
}

std::optional<Doubt> StrokeWatch::doubt() const {
  constexpr double much = 0.02;
  if (!(depth_ > much * motion_) || motion_ == 0.0) return std::nullopt;
  const double share = 100.0 * depth_ / motion_;
  return Doubt{
      fmt::format("springs of contact take {:.2g} % of the motion", share),
      fmt::format("springs of contact give way by up to {:.2g} % of the motion that is imposed in statics, so "
                  "that forces may be too small by as much: leave out enforcement = \"penalty\" (the augmented "
                  "Lagrangian, the default of statics, closes the gap), or raise contact.stiffness_factor",
                  share)};
}

}  // namespace carom
