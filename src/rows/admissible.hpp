// The forces that a row may bear: the one place that knows which rows open, which slide, and which hold whatever comes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rows/constraint_rows.hpp"

namespace carom {

enum class RowStatus : std::uint8_t { open, stick, slip };

/// The set of forces that a row may bear, as a solver needs to know it. Of a cone it is
///   r_n >= 0, |r_T| <= mu r_n (a half-line where mu = 0),
/// of a bond all of R^3, whose motion w is zero. A linear equation is a bond that sees one component only.
struct Admissible {
  AdmissibleSet set = AdmissibleSet::cone;
  double mu = 0.0;

  bool is_bond() const { return set != AdmissibleSet::cone; }
  /// The number of components (normal, tangent_1, tangent_2) that take part.
  std::size_t components() const { return is_bond() || mu > 0.0 ? 3 : 1; }
  /// Bonds never open.
  bool opens() const { return !is_bond(); }
  /// True when the normal part of the row's work over a step is the loss of an impact. A bond does no work, since its
  /// two sides move as one.
  bool feeds_impact() const { return !is_bond(); }
  /// This set without friction.
  Admissible without_friction() const { return {set, 0.0}; }

  /// The admissible force that a trial force stands for: the normal part first, then the tangential one on the disc
  /// that belongs to it.
  Vec3 project(const Vec3& trial) const {
    if (is_bond()) return trial;
    const double r_n = std::max(0.0, trial[0]), limit = mu * r_n, t = std::hypot(trial[1], trial[2]);
    const double keep = t > limit ? limit / t : 1.0;
    return {r_n, keep * trial[1], keep * trial[2]};
  }
  /// The status under an admissible force, open, held or sliding. A solver may leave the force short of its cone by
  /// this share.
  RowStatus status(const Vec3& force) const {
    constexpr double share = 1e-9;
    if (is_bond()) return RowStatus::stick;
    if (!(force[0] > 0.0)) return RowStatus::open;
    const bool slides = mu > 0.0 && std::hypot(force[1], force[2]) >= mu * force[0] * (1.0 - share);
    return slides ? RowStatus::slip : RowStatus::stick;
  }
  /// True when the motion w, which includes the gap, violates the conditions of the set by more than this length.
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
/// True for the rows of linear equations: bonds that springs never hold, whatever the enforcement (HeldRows).
inline bool is_equation(const RowLaw& law) {
  return law.set == AdmissibleSet::equation;
}
inline std::size_t components(const RowLaw& law) {
  return admissible(law).components();
}

/// The distance by which the two sides of a bond have parted at displacement x, as a vector in the row's frame.
inline Vec3 parted(const ConstraintRows& rows, std::size_t r, std::span<const double> x) {
  Vec3 w = rows.relative(r, x);
  w[0] += rows.gap[r];
  return w;
}

}  // namespace carom
