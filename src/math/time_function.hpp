// Functions of time for loads and imposed motions.
#pragma once

#include <memory>
#include <vector>

namespace carom {

class CalledFunction;

/// The side from which a value is taken where it jumps.
enum class JumpSide : bool { after, before };

/// Piecewise linear table; constant before the first and after the last entry. Two entries at the same time make a
/// step: the value jumps there (right-continuous). A single entry is a constant. Times must not decrease. Where there
/// is a called function, the table has a single entry, which multiplies it.
struct TimeFunction {
  std::vector<double> time{0.0};
  std::vector<double> value{1.0};
  std::shared_ptr<const CalledFunction> called{};

  /// Value at t.
  double operator()(double t, JumpSide side = JumpSide::after) const;
  /// First derivative at t (from the right at a kink; jumps do not count).
  double derivative(double t) const;
  /// Integral of f from a to b >= a, piece by piece: exact up to rounding, whatever kinks and jumps lie between (of a
  /// called function as exact as CalledFunction says).
  double integral(double a, double b) const;
  /// Integral of (b - s) f(s) from a to b >= a: what an acceleration f adds to the way.
  double second_integral(double a, double b) const;
};

}  // namespace carom
