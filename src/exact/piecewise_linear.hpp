// A function of time made of straight pieces, with jumps.
#pragma once

#include <limits>
#include <vector>

namespace carom {

/// f(t), constant before t = 0, then pieces f(t) = value + slope (t - begin) up to the begin of the next piece; at a
/// jump the value is the one after it. Times and values in any consistent units.
class PiecewiseLinear {
 public:
  struct Piece {
    double begin = 0.0;
    double value = 0.0;     ///< at begin
    double slope = 0.0;     ///< per unit of time
    double integral = 0.0;  ///< of f from 0 to begin
    double at(double t) const { return value + slope * (t - begin); }
    double integral_at(double t) const { return integral + (t - begin) * (value + 0.5 * slope * (t - begin)); }
  };

  /// f = before for t < 0, and after it until a piece is appended.
  explicit PiecewiseLinear(double before) : pieces_{{0.0, before, 0.0, 0.0}} {}

  /// Starts a new piece at begin >= the begin of the last one, and >= 0.
  void append(double begin, double value, double slope);
  /// f is known up to t only; to ask for later values is a bug.
  void end_at(double t) { end_ = t; }

  double value(double t) const { return piece_at(t).at(t); }
  /// Integral of f from 0 to t; negative times count backwards.
  double integral(double t) const { return piece_at(t).integral_at(t); }
  /// In order of time; the first is the constant before t = 0.
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Begins of the pieces inside (from, to), in order.
  std::vector<double> breaks(double from, double to) const;

 private:
  const Piece& piece_at(double t) const;

  std::vector<Piece> pieces_;
  double end_ = std::numeric_limits<double>::infinity();
};

}  // namespace carom
