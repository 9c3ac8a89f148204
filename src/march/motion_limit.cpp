#include "march/motion_limit.hpp"

#include <algorithm>
#include <span>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "model/node_lengths.hpp"

namespace carom {

namespace {

constexpr double share_of_cell = 0.5;

/// What may close within a step on account of the shape: half of half of its thickness.
struct MostOfShape {
  double operator()(const Plane& /*plane*/) const { return infinity; }
  double operator()(const Sphere& sphere) const { return sphere.inside ? infinity : share_of_cell * sphere.radius; }
  double operator()(const Cylinder& cylinder) const {
    return cylinder.inside ? infinity : share_of_cell * cylinder.radius;
  }
  double operator()(const Box& box) const {
    const Vec3 size = subtract(box.upper, box.lower);
    return share_of_cell * 0.5 * std::min({size[0], size[1], size[2]});
  }
  double operator()(const RigidSurface& /*rigid*/) const { return infinity; }
};

/// Negative: not limited.
double most_of(const ContactParts& contact) {
  if (contact.shape != nullptr) return std::visit(MostOfShape{}, *contact.shape);
  double radii = infinity;  // bars pass each other at the sum of theirs
  for (const BarSide& bar : contact.other_bars) radii = std::min(radii, share_of_cell * 2.0 * bar.radius);
  if (radii < infinity) return radii;
  return contact.other != nullptr && contact.nature == ContactNature::touches ? infinity : -1.0;
}

}  // namespace

MotionLimit::MotionLimit(const Model& model) : length_(node_lengths(model)) {
  for (const ContactDefinition& contact : model.contacts) most_.push_back(most_of(parts_of(contact)));
  least_ = share_of_cell * *std::min_element(length_->begin(), length_->end());
  for (const double most : most_)
    if (most >= 0.0) least_ = std::min(least_, most);
}

/// Negative where the row is not limited.
double MotionLimit::allowed(const ConstraintRows& rows, std::size_t r) const {
  if (rows.source[r] < 0) return -1.0;  // an equation
  const auto first = static_cast<std::size_t>(rows.begin[r]), last = static_cast<std::size_t>(rows.begin[r + 1]);
  const double length = least_length(*length_, std::span(rows.node).subspan(first, last - first));
  const double most = std::min(most_[static_cast<std::size_t>(rows.source[r])], share_of_cell * length);
  return most < infinity ? most : -1.0;
}

/// Makes row r the worst if it goes from one gap to the other, too far, and has to be cut more.
void MotionLimit::judge(const ConstraintRows& rows, std::size_t r, double before, double after,
                        std::optional<Overrun>& worst) const {
  const double depth = std::min(0.0, before) - after;
  if (!(depth > least_)) return;
  const double most = allowed(rows, r);
  if (most < 0.0 || depth <= most) return;
  const double fraction = (std::max(0.0, before) + 0.5 * most) / (before - after);
  if (!worst || fraction < worst->fraction) worst = {fraction, share_of_cell * depth / most, rows.source[r], r};
}

std::optional<MotionLimit::Overrun> MotionLimit::foreseen(const State& begin, const ConstraintRows& rows,
                                                          double h) const {
  std::optional<Overrun> worst;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double before = rows.gap_at(r, begin.q);
    judge(rows, r, before, before + h * rows.relative(r, begin.v)[0], worst);
  }
  return worst;
}

std::optional<MotionLimit::Overrun> MotionLimit::overrun(const State& begin, const State& end,
                                                         const ContactResponse& at_end) const {
  const ConstraintRows& rows = *at_end.rows;
  const double h = end.t - begin.t;
  std::optional<Overrun> worst;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double before = rows.gap_at(r, begin.q);
    double after = rows.gap_at(r, end.q);
    if (before > 0.0 && at_end.status[r] != RowStatus::open)
      after = std::min(after, before + h * rows.relative(r, begin.v)[0]);
    judge(rows, r, before, after, worst);
  }
  return worst;
}

}  // namespace carom
