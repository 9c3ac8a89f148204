// What a row's force may be: the one place that knows which rows open, which slide, and which hold whatever comes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "contact/constraint_rows.hpp"
#include "contact/response.hpp"

namespace carom {

/// The forces that a row may bear, as a solver needs to know them: of a cone
///   r_n >= 0, |r_T| <= mu r_n (a half-line where mu = 0),
/// of a bond all of R^3, its motion w being zero then. A linear equation is a bond that sees one component only.
struct Admissible {
  AdmissibleSet set = AdmissibleSet::cone;
  double mu = 0.0;

  bool is_bond() const { return set != AdmissibleSet::cone; }
  /// How many of (normal, tangent_1, tangent_2) take part.
  std::size_t components() const { return is_bond() || mu > 0.0 ? 3 : 1; }
  /// Bonds never open.
  bool opens() const { return !is_bond(); }
  /// The normal part of what it does over a step is the loss of an impact; a bond's work is that of its two sides on
  /// each other, which is none.
  bool feeds_impact() const { return !is_bond(); }
  /// The same set without friction.
  Admissible without_friction() const { return {set, 0.0}; }

  /// The admissible force that a trial force stands for: the normal part first, then the tangential one on the disc
  /// that belongs to it.
  Vec3 project(const Vec3& trial) const {
    if (is_bond()) return trial;
    const double r_n = std::max(0.0, trial[0]), limit = mu * r_n, t = std::hypot(trial[1], trial[2]);
    const double keep = t > limit ? limit / t : 1.0;
    return {r_n, keep * trial[1], keep * trial[2]};
  }
  /// Open, held or sliding under an admissible force, which a solver may leave short of its cone by this share.
  RowStatus status(const Vec3& force) const {
    constexpr double share = 1e-9;
    if (is_bond()) return RowStatus::stick;
    if (!(force[0] > 0.0)) return RowStatus::open;
    const bool slides = mu > 0.0 && std::hypot(force[1], force[2]) >= mu * force[0] * (1.0 - share);
    return slides ? RowStatus::slip : RowStatus::stick;
  }
  /// True when the motion w, the gap being part of it, is not allowed by more than this length.
  bool violates(const Vec3& w, double tolerance) const {
    if (!is_bond()) return !(w[0] >= -tolerance);
    return !(std::max({std::abs(w[0]), std::abs(w[1]), std::abs(w[2])}) <= tolerance);
  }
};

inline Admissible admissible(const RowLaw& law) {
  return {law.set, law.mu};
}
inline bool is_bond(const RowLaw& law) {
  return admissible(law).is_bond();
}
/// Bonds that springs do not hold, whatever the enforcement (HeldRows).
inline bool is_equation(const RowLaw& law) {
  return law.set == AdmissibleSet::equation;
}
inline std::size_t components(const RowLaw& law) {
  return admissible(law).components();
}

/// What a bond sees at displacement x: the way that its two sides have parted, in the row's frame.
inline Vec3 parted(const ConstraintRows& rows, std::size_t r, std::span<const double> x) {
  Vec3 w = rows.relative(r, x);
  w[0] += rows.gap[r];
  return w;
}

}  // namespace carom
