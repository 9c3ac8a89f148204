#include "surface/bilinear_patch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/vec3.hpp"

namespace carom {
namespace {

Vec3 axpy(const Vec3& a, double s, const Vec3& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

/// Point of least model(s, t) = g . (s, t) + (s, t) . H (s, t) / 2 over the box, as absolute coordinates.
struct BoxModel {
  double g_1, g_2, h_11, h_12, h_22;
  double operator()(double s, double t) const {
    return s * (g_1 + 0.5 * h_11 * s + h_12 * t) + t * (g_2 + 0.5 * h_22 * t);
  }
};

ParentPoint box_minimum(const BoxModel& model, const ParentPoint& from) {
  const double det = model.h_11 * model.h_22 - model.h_12 * model.h_12;
  const ParentPoint free{from.xi + (model.h_12 * model.g_2 - model.h_22 * model.g_1) / det,
                         from.eta + (model.h_12 * model.g_1 - model.h_11 * model.g_2) / det};
  if (std::abs(free.xi) <= 1.0 && std::abs(free.eta) <= 1.0) return free;
  ParentPoint best;
  double least = INFINITY;
  const auto consider = [&](const ParentPoint& point) {
    const double value = model(point.xi - from.xi, point.eta - from.eta);
    if (value < least) {
      least = value;
      best = point;
    }
  };
  for (const double side : {-1.0, 1.0}) {
    const double t = -(model.g_2 + model.h_12 * (side - from.xi)) / model.h_22;
    consider({side, std::clamp(from.eta + t, -1.0, 1.0)});
    const double s = -(model.g_1 + model.h_12 * (side - from.eta)) / model.h_11;
    consider({std::clamp(from.xi + s, -1.0, 1.0), side});
  }
  return best;
}

/// Newton's method for 1/2 |x - x(xi, eta)|^2 on the box; the Hessian's curvature term is left out where it makes the
/// Hessian indefinite. Nothing when it does not settle.
std::optional<ParentPoint> newton_on_box(const BilinearPatch& patch, const Vec3& x, ParentPoint point) {
  constexpr int limit = 15;
  constexpr double settled = 1e-9;  // steps shrink quadratically: the next one would be of the order of round-off
  for (int k = 0; k < limit; ++k) {
    const Vec3 a_1 = patch.tangent_1(point.eta), a_2 = patch.tangent_2(point.xi);
    const Vec3 r = subtract(x, patch.at(point.xi, point.eta));
    BoxModel model{-dot(r, a_1), -dot(r, a_2), dot(a_1, a_1), dot(a_1, a_2) - dot(r, patch.c), dot(a_2, a_2)};
    const double product = model.h_11 * model.h_22;
    if (model.h_12 * model.h_12 > 0.99 * product) model.h_12 = dot(a_1, a_2);
    if (!(model.h_12 * model.h_12 < (1.0 - 1e-12) * product)) return std::nullopt;
    const ParentPoint next = box_minimum(model, point);
    const double step = std::max(std::abs(next.xi - point.xi), std::abs(next.eta - point.eta));
    point = next;
    if (step < settled) return point;
  }
  return std::nullopt;
}

/// True if a point that satisfies the first-order conditions on the box is proven to be the global minimum.
/// With r = x - x(xi, eta), any other point of the patch differs by M = s u + t v, where v = a_2(xi) and
/// u = p + c eta' for some eta' in [-1, 1], and r . M <= (r . c) s t by the first-order conditions. So
///   |r - M|^2 >= |r|^2 + 2 |s t| (|u| |v| - |u . v| - |r . c|),   |u| |v| - |u . v| >= |u x v|^2 / (2 |u| |v|),
/// and |u x v| >= n . (u x v), which is linear in eta': its least value is at eta' = -1 or 1, as the largest |u| is.
bool is_certain_minimum(const BilinearPatch& patch, const Vec3& x, const ParentPoint& point) {
  const Vec3 r = subtract(x, patch.at(point.xi, point.eta));
  const Vec3 v = patch.tangent_2(point.xi), low = patch.tangent_1(-1.0), high = patch.tangent_1(1.0);
  const Vec3 n = cross(patch.tangent_1(point.eta), v);
  const double least = std::min(dot(n, cross(low, v)), dot(n, cross(high, v)));
  const double longest = std::sqrt(std::max(dot(low, low), dot(high, high)) * dot(v, v));
  return least > 0.0 && least * least >= 2.0 * longest * std::abs(dot(r, patch.c)) * dot(n, n);
}

/// Polynomial of degree 5 or less, coefficients by rising powers.
using Quintic = std::array<double, 6>;

Quintic product(const Quintic& a, const Quintic& b) {
  Quintic c{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; i + j < 6; ++j) c[i + j] += a[i] * b[j];
  return c;
}

double value(const Quintic& a, double s) {
  double sum = 0.0;
  for (std::size_t i = 6; i-- > 0;) sum = sum * s + a[i];
  return sum;
}

Quintic derivative(const Quintic& a) {
  Quintic d{};
  for (std::size_t i = 1; i < 6; ++i) d[i - 1] = static_cast<double>(i) * a[i];
  return d;
}

/// Values in increasing order, at most 24 of them: -1, 1 and the roots of five derivatives between.
struct Breakpoints {
  std::array<double, 24> s{};
  int count = 0;
  void push(double value) { s[static_cast<std::size_t>(count++)] = value; }
};

double bisect(const Quintic& a, double low, double high) {
  const bool rising = value(a, low) < 0.0;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high || high - low < 1e-15) return middle;
    ((value(a, middle) < 0.0) == rising ? low : high) = middle;
  }
}

/// -1, 1, and every root in between of the polynomial and of its derivatives: between neighbouring breakpoints of its
/// derivative a polynomial is monotone, so that a change of sign holds one root. A multiple root is one of a
/// derivative.
Breakpoints roots_and_turning_points(const Quintic& a) {
  std::array<Quintic, 5> chain{a};
  for (std::size_t k = 1; k < 5; ++k) chain[k] = derivative(chain[k - 1]);
  Breakpoints points;
  points.push(-1.0);
  points.push(1.0);
  for (std::size_t k = 5; k-- > 0;) {
    Breakpoints finer;
    finer.push(-1.0);
    for (int i = 1; i < points.count; ++i) {
      const double low = points.s[static_cast<std::size_t>(i - 1)], high = points.s[static_cast<std::size_t>(i)];
      if ((value(chain[k], low) < 0.0) != (value(chain[k], high) < 0.0)) finer.push(bisect(chain[k], low, high));
      finer.push(high);
    }
    points = finer;
  }
  return points;
}

/// Numerator of d/dxi of min over eta of |x - x(xi, eta)|^2 / 2. With A(xi) = m - x + p xi, B(xi) = q + c xi and
/// eta = -e / b, e = A . B, b = B . B:  b^2 A . p - b e (A . c + B . p) + e^2 B . c.
Quintic stationarity(const BilinearPatch& patch, const Vec3& x) {
  const Vec3 a = subtract(patch.m, x);
  const auto& [m, p, q, c] = patch;
  const Quintic b{dot(q, q), 2 * dot(q, c), dot(c, c)}, e{dot(a, q), dot(a, c) + dot(p, q), dot(p, c)};
  const Quintic ap{dot(a, p), dot(p, p)}, de{e[1], 2 * e[2]}, bc{dot(q, c), dot(c, c)};
  const Quintic first = product(product(b, b), ap), second = product(product(b, e), de),
                third = product(product(e, e), bc);
  Quintic sum{};
  for (std::size_t i = 0; i < 6; ++i) sum[i] = first[i] - second[i] + third[i];
  return sum;
}

double squared_distance(const BilinearPatch& patch, const Vec3& x, const ParentPoint& point) {
  const Vec3 r = subtract(x, patch.at(point.xi, point.eta));
  return dot(r, r);
}

/// Parameter in [-1, 1] of the closest point to x on the segment centre + s half.
double closest_parameter(const Vec3& centre, const Vec3& half, const Vec3& x) {
  const double length_2 = dot(half, half);
  return length_2 > 0.0 ? std::clamp(dot(subtract(x, centre), half) / length_2, -1.0, 1.0) : 0.0;
}

}  // namespace

BilinearPatch::BilinearPatch(const PlacedFacet& facet) {
  const auto& x = facet.x;
  if (facet.size == 3) {
    m = x[0];
    p = subtract(x[1], x[0]);
    q = subtract(x[2], x[0]);
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double sum = x[0][i] + x[2][i], other = x[1][i] + x[3][i];
    const double diagonal = x[2][i] - x[0][i], cross_diagonal = x[1][i] - x[3][i];
    m[i] = 0.25 * (sum + other);
    p[i] = 0.25 * (diagonal + cross_diagonal);
    q[i] = 0.25 * (diagonal - cross_diagonal);
    c[i] = 0.25 * (sum - other);
  }
}

Vec3 BilinearPatch::at(double xi, double eta) const {
  return axpy(axpy(m, xi, p), eta, tangent_2(xi));
}

Vec3 BilinearPatch::tangent_1(double eta) const {
  return axpy(p, eta, c);
}

Vec3 BilinearPatch::tangent_2(double xi) const {
  return axpy(q, xi, c);
}

ParentPoint closest_of_stationary_points(const BilinearPatch& patch, const Vec3& x) {
  ParentPoint best;
  double least = INFINITY;
  const auto consider = [&](const ParentPoint& point) {
    const double distance_2 = squared_distance(patch, x, point);
    if (distance_2 < least) {
      least = distance_2;
      best = point;
    }
  };
  const Breakpoints candidates = roots_and_turning_points(stationarity(patch, x));
  for (int i = 0; i < candidates.count; ++i) {
    const double xi = candidates.s[static_cast<std::size_t>(i)];
    consider({xi, closest_parameter(axpy(patch.m, xi, patch.p), patch.tangent_2(xi), x)});
  }
  for (const double eta : {-1.0, 1.0})
    consider({closest_parameter(axpy(patch.m, eta, patch.q), patch.tangent_1(eta), x), eta});
  return best;
}

ParentPoint closest_point(const BilinearPatch& patch, const Vec3& x) {
  const std::optional<ParentPoint> found = newton_on_box(patch, x, {0.0, 0.0});
  if (found && is_certain_minimum(patch, x, *found)) return *found;
  const ParentPoint best = closest_of_stationary_points(patch, x);
  const std::optional<ParentPoint> polished = newton_on_box(patch, x, best);
  const double allowed = squared_distance(patch, x, best);
  if (polished && squared_distance(patch, x, *polished) <= allowed) return *polished;
  return best;
}

int points_over(const BilinearPatch& patch, double s, double t, std::array<ParentPoint, 2>& points) {
  // 0 = A + B eta in the x-y plane with A = m - (s, t) + p xi, B = q + c xi; so A x B = 0, a quadratic in xi.
  const auto area = [](const Vec3& u, const Vec3& v) { return u[0] * v[1] - u[1] * v[0]; };
  const Vec3 a = subtract(patch.m, {s, t, 0.0});
  if (patch.c[0] == 0.0 && patch.c[1] == 0.0) {
    const double det = area(patch.p, patch.q);
    if (det == 0.0) return 0;
    points[0] = {-area(a, patch.q) / det, -area(patch.p, a) / det};
    return std::abs(points[0].xi) < 2.0 && std::abs(points[0].eta) < 2.0 ? 1 : 0;
  }
  const double k_0 = area(a, patch.q), k_1 = area(a, patch.c) + area(patch.p, patch.q), k_2 = area(patch.p, patch.c);
  const double discriminant = k_1 * k_1 - 4.0 * k_2 * k_0;
  if (!(discriminant >= 0.0)) return 0;
  const double w = -0.5 * (k_1 + std::copysign(std::sqrt(discriminant), k_1));
  int count = 0;
  const auto add_root = [&](double xi) {
    if (!(std::abs(xi) < 2.0)) return;
    const Vec3 b = patch.tangent_2(xi), from = axpy(a, xi, patch.p);
    ParentPoint point{xi, -(from[0] * b[0] + from[1] * b[1]) / (b[0] * b[0] + b[1] * b[1])};
    for (int k = 0; k < 3; ++k) {  // the quadratic loses digits where its roots nearly coincide
      const Vec3 a_1 = patch.tangent_1(point.eta), a_2 = patch.tangent_2(point.xi);
      const Vec3 r = axpy(axpy(a, point.xi, patch.p), point.eta, a_2);
      const double det = area(a_1, a_2);
      if (det == 0.0) break;
      const double d_xi = -area(r, a_2) / det, d_eta = -area(a_1, r) / det;
      point = {point.xi + d_xi, point.eta + d_eta};
      if (std::max(std::abs(d_xi), std::abs(d_eta)) < 1e-9) break;
    }
    if (std::abs(point.xi) < 2.0 && std::abs(point.eta) < 2.0) points[static_cast<std::size_t>(count++)] = point;
  };
  add_root(k_0 / w);
  if (k_2 != 0.0) add_root(w / k_2);
  return count;
}

}  // namespace carom
