#include "surface/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

double Polygon::area() const {
  double sum = 0.0;
  for (std::size_t i = 2; i < size; ++i) sum += area_of(corner[0], corner[i - 1], corner[i]);
  return sum;
}

Polygon without_flat_corners(Polygon polygon) {
  constexpr double flat = 1e-9;  // of the area
  const double least = flat * polygon.area();
  for (std::size_t i = 0; i < polygon.size && polygon.size > 3;) {
    const PlanePoint& before = polygon.corner[(i + polygon.size - 1) % polygon.size];
    const PlanePoint& after = polygon.corner[(i + 1) % polygon.size];
    if (area_of(before, polygon.corner[i], after) > least) {
      ++i;
      continue;
    }
    for (std::size_t k = i + 1; k < polygon.size; ++k) polygon.corner[k - 1] = polygon.corner[k];
    --polygon.size;
    if (i > 0) --i;
  }
  return polygon;
}

namespace {

/// The part of the polygon on the left of the line from a to b.
Polygon clip(const Polygon& polygon, const PlanePoint& a, const PlanePoint& b) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const PlanePoint& p = polygon.corner[i];
    const PlanePoint& q = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
    const double side_p = area_of(a, b, p), side_q = area_of(a, b, q);
    if (side_p >= 0.0) kept.push(p);
    if ((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0)) {
      const double s = side_p / (side_p - side_q);
      kept.push({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
    }
  }
  return kept;
}

}  // namespace

Polygon clip(Polygon polygon, const Polygon& window) {
  for (std::size_t i = 0; i < window.size && polygon.size > 2; ++i)
    polygon = clip(polygon, window.corner[i], window.corner[i + 1 < window.size ? i + 1 : 0]);
  return polygon;
}

void Stretch::keep_positive(double at_a, double at_b) {
  if (at_a <= 0.0 && at_b <= 0.0) high = low;
  if (at_a <= 0.0 && at_b > 0.0) low = std::max(low, at_a / (at_a - at_b));
  if (at_a > 0.0 && at_b <= 0.0) high = std::min(high, at_a / (at_a - at_b));
}

Stretch inside(const PlanePoint& a, const PlanePoint& b, const Polygon& polygon) {
  constexpr double inset = 1e-9, of_parallels = 1e-3, parallel = 0.01;  // of the polygon's area; sine of the angle
  Stretch stretch;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const PlanePoint &p = polygon.corner[i], &q = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
    const double at_a = area_of(p, q, a), at_b = area_of(p, q, b);
    const double side = std::hypot(q[0] - p[0], q[1] - p[1]), way = std::hypot(b[0] - a[0], b[1] - a[1]);
    const bool is_along = 2.0 * std::abs(at_b - at_a) < parallel * side * way;
    const double least = (is_along ? of_parallels : inset) * polygon.area();
    stretch.keep_positive(at_a - least, at_b - least);
  }
  return stretch;
}

Shadow::Shadow(const PlacedFacet& facet) {
  constexpr double round_off = 1e-12;  // of the area: a corner on the line between its neighbours is not reflex
  const auto size = static_cast<std::size_t>(facet.size);
  std::array<PlanePoint, 4> p{};
  for (std::size_t a = 0; a < size; ++a) p[a] = {facet.x[a][0], facet.x[a][1]};
  double total = area_of(p[0], p[1], p[2]);
  if (size == 4) total += area_of(p[0], p[2], p[3]);
  const double sign = total < 0.0 ? -1.0 : 1.0;
  if (size == 3) {
    add_part(p, sign, {0, 1, 2}, 3);
    return;
  }
  std::size_t reflex = 4;
  for (std::size_t a = 0; a < 4; ++a)
    if (sign * area_of(p[(a + 3) % 4], p[a], p[(a + 1) % 4]) < -round_off * std::abs(total)) reflex = a;
  if (reflex == 4) {
    add_part(p, sign, {0, 1, 2, 3}, 4);
  } else {
    add_part(p, sign, {reflex, (reflex + 1) % 4, (reflex + 2) % 4}, 3);
    add_part(p, sign, {reflex, (reflex + 2) % 4, (reflex + 3) % 4}, 3);
  }
}

/// Counter-clockwise; parts that are turned over against the whole (a facet folded in the projection) are left out.
void Shadow::add_part(const std::array<PlanePoint, 4>& p, double sign, std::array<std::size_t, 4> corners,
                      std::size_t size) {
  if (sign < 0.0) std::reverse(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(size));
  Polygon polygon;
  for (std::size_t i = 0; i < size; ++i) polygon.push(p[corners[i]]);
  if (polygon.area() > 0.0) part[count++] = polygon;
}

}  // namespace carom
