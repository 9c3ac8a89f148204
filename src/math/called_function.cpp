#include "math/called_function.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "math/gauss_legendre.hpp"

namespace carom {

double CalledFunction::derivative(double t) const {
  const double h = std::ldexp(span_, -20);
  if (t < h) return (-3.0 * f_(t) + 4.0 * f_(t + h) - f_(t + 2.0 * h)) / (2.0 * h);
  return (f_(t + h) - f_(t - h)) / (2.0 * h);
}

/// Over as many panels as the interval is long.
CalledFunction::Integrals CalledFunction::over(double a, double b) const {
  static const std::vector<QuadraturePoint> rule = gauss_legendre(5);
  Integrals sum;
  if (!(b > a)) return sum;
  const double count = std::max(1.0, std::ceil((b - a) / panel() * (1.0 - 1e-9)));
  const double length = (b - a) / count;
  for (double k = 0.0; k < count; k += 1.0) {
    const double middle = a + (k + 0.5) * length;
    for (const QuadraturePoint& point : rule) {
      const double s = middle + 0.5 * length * point.x;
      const double share = 0.5 * length * point.weight * f_(s);
      sum.first += share;
      sum.second += (b - s) * share;
    }
  }
  return sum;
}

/// The whole panels before t are made once; what is left, and what lies behind the span, is made when asked for.
CalledFunction::Integrals CalledFunction::from_zero(double t) const {
  std::call_once(once_, [&] {
    from_zero_.assign(panels + 1, {});
    for (int k = 0; k < panels; ++k) {
      const Integrals &before = from_zero_[static_cast<std::size_t>(k)], added = over(k * panel(), (k + 1) * panel());
      from_zero_[static_cast<std::size_t>(k) + 1] = {before.first + added.first,
                                                     before.second + panel() * before.first + added.second};
    }
  });
  const double whole = std::clamp(std::floor(t / panel()), 0.0, static_cast<double>(panels));
  const Integrals before = from_zero_[static_cast<std::size_t>(whole)], added = over(whole * panel(), t);
  return {before.first + added.first, before.second + (t - whole * panel()) * before.first + added.second};
}

double CalledFunction::integral(double a, double b) const {
  return a == 0.0 ? from_zero(b).first : over(a, b).first;
}

double CalledFunction::second_integral(double a, double b) const {
  return a == 0.0 ? from_zero(b).second : over(a, b).second;
}

}  // namespace carom
