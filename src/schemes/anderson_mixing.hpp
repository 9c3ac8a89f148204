// Acceleration of an iteration that converges linearly.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace carom {

/// Anderson's acceleration (J. ACM 12, 1965; Walker and Ni, SIAM J. Numer. Anal. 49, 2011) of y <- y + f(y), where f is
/// the correction that a Newton step with an incomplete tangent finds:
///   y + f - (dY + dF) c,  c = argmin |f - dF c|,
/// dY and dF being the last differences of y and of f, at most five. What the tangent leaves out then costs an
/// iteration for each of its few modes, even where it makes the plain iteration diverge. It begins with a
/// correction of more than a tenth of the last: quicker iterations are left as they are.
class AndersonMixing {
 public:
  void forget() {
    dy_.clear();
    df_.clear();
    f_.clear();
  }
  /// y becomes the next iterate; f is its correction, and becomes the step that y takes.
  void advance(std::span<double> y, std::span<double> f);

 private:
  bool is_slow(std::span<const double> f) const;
  void push(std::span<const double> y, std::span<const double> f);
  std::vector<double> combination(std::span<const double> f) const;

  std::vector<std::vector<double>> dy_, df_;  ///< newest last
  std::vector<double> y_, f_;                 ///< of the last iterate
};

}  // namespace carom
