// A function of time that somebody else's code computes.
#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace carom {

/// What such code has thrown, on its way back to those who gave it: no std::exception, so that nobody takes it for an
/// error of the run.
struct CallFailure {
  std::exception_ptr error;
};

/// Integrals by Gauss' rule of five points on panels, of which there are 4096 over [0, span]; derivatives by
/// differences over a 2^-20 of the span (relative error about 1e-9 where the function changes over the span). A jump is
/// smeared over the panel that it lies in. The function gives the same value whenever it is asked for the same time:
/// steps may be made again.
class CalledFunction {
 public:
  /// span > 0: what the run lasts.
  CalledFunction(std::function<double(double)> f, double span) : f_(std::move(f)), span_(span) {}

  double at(double t) const { return f_(t); }
  double derivative(double t) const;
  double integral(double a, double b) const;
  /// Integral of (b - s) f(s) from a to b.
  double second_integral(double a, double b) const;

 private:
  struct Integrals {
    double first = 0.0, second = 0.0;  ///< of f(s), and of (end - s) f(s)
  };
  double panel() const { return span_ / panels; }
  Integrals over(double a, double b) const;
  Integrals from_zero(double t) const;

  static constexpr int panels = 4096;
  std::function<double(double)> f_;
  double span_;
  mutable std::once_flag once_;
  mutable std::vector<Integrals> from_zero_;  ///< to the end of each panel, made when first asked for
};

}  // namespace carom
