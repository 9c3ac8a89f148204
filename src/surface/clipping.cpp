#include "surface/clipping.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "math/gauss_legendre.hpp"
#include "math/vec3.hpp"
#include "surface/bilinear_patch.hpp"
#include "surface/facet_projection.hpp"
#include "surface/polygon.hpp"

namespace carom {
namespace {

constexpr double negligible = 1e-12;  // part of the smaller facet's area

/// A facet in the plane's axes.
struct SeenFacet {
  BilinearPatch patch;
  int size;

  /// Point of the facet over a point of its shadow, moved by round-off into the facet.
  std::optional<ParentPoint> over(const PlanePoint& p) const;
  /// Its height there; that of the plane through its middle where round-off has no point.
  double height(const PlanePoint& p) const;
};

double SeenFacet::height(const PlanePoint& p) const {
  if (size == 4) {
    if (const std::optional<ParentPoint> at = over(p)) return patch.at(at->xi, at->eta)[2];
  }
  const Vec3 n = cross(patch.p, patch.q);
  return patch.m[2] - (n[0] * (p[0] - patch.m[0]) + n[1] * (p[1] - patch.m[1])) / n[2];
}

std::optional<ParentPoint> SeenFacet::over(const PlanePoint& p) const {
  constexpr double slack = 1e-6;  // p lies in the shadow: only the round-off of slender shadows is to be allowed
  const double low = size == 4 ? -1.0 : 0.0;
  std::array<ParentPoint, 2> points;
  const int count = points_over(patch, p[0], p[1], points);
  for (int i = 0; i < count; ++i) {
    const auto [xi, eta] = points[static_cast<std::size_t>(i)];
    const double high = size == 4 ? 1.0 : 1.0 - std::clamp(xi, 0.0, 1.0);
    if (xi < low - slack || xi > 1.0 + slack || eta < low - slack || eta > high + slack) continue;
    return ParentPoint{std::clamp(xi, low, 1.0), std::clamp(eta, low, high)};
  }
  return std::nullopt;
}

/// Radon's rule of degree 5 on the triangle: barycentric coordinates (1 - 2 r, r, r) and their rotations.
struct TrianglePoint {
  std::array<double, 3> barycentric;
  double weight;  ///< of the triangle's area
};

std::array<TrianglePoint, 7> radon_rule() {
  const double root = std::sqrt(15.0);
  std::array<TrianglePoint, 7> rule{};
  rule[0] = {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, 9.0 / 40.0};
  std::size_t k = 1;
  for (const double sign : {-1.0, 1.0}) {
    const double r = (6.0 + sign * root) / 21.0, weight = (155.0 + sign * root) / 1200.0;
    for (std::size_t i = 0; i < 3; ++i, ++k) {
      rule[k] = {{r, r, r}, weight};
      rule[k].barycentric[i] = 1.0 - 2.0 * r;
    }
  }
  return rule;
}

/// One overlap in the making.
struct Clipping {
  SeenFacet slave, master;
  const OverlapRule& rule;
  std::vector<OverlapPoint>& points;
  OverlapExtent extent{};

  void add(const Polygon& polygon);

 private:
  double gap_over(const PlanePoint& p) const { return master.height(p) - slave.height(p); }
  Polygon part_behind(const Polygon& polygon, std::span<const double> gap) const;
  void add_point(const PlanePoint& p, double area) const;
  void add_triangle(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) const;
  void add_polygon(const Polygon& polygon) const;
  void add_star(const Polygon& polygon) const;
  void add_moment_points(const Polygon& polygon) const;
};

/// The polygon with what there is of it over its whole extent.
void Clipping::add(const Polygon& polygon) {
  std::array<double, 16> gap{};
  double least = std::numeric_limits<double>::infinity();
  bool is_divided = false;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    gap[i] = gap_over(polygon.corner[i]) - rule.nearer;
    least = std::min(least, gap[i]);
    is_divided = is_divided || (gap[i] < 0.0) != (gap[0] < 0.0);
  }
  extent.least_gap = std::min(extent.least_gap, least + rule.nearer);
  extent.area += polygon.area();
  const Polygon part = rule.only_behind && is_divided ? part_behind(polygon, gap) : polygon;
  const bool is_curved = slave.size == 4 || master.size == 4;  // what is integrated may be no polynomial
  if (!rule.only_behind && !is_curved)
    add_polygon(part);
  else if (rule.is_high || (is_curved && least < 0.0))
    add_star(part);
  else
    add_moment_points(part);
}

/// The part where the gap is negative, linear along the sides.
Polygon Clipping::part_behind(const Polygon& polygon, std::span<const double> gap) const {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const std::size_t next = i + 1 < polygon.size ? i + 1 : 0;
    const PlanePoint &p = polygon.corner[i], &q = polygon.corner[next];
    if (gap[i] <= 0.0) kept.push(p);
    if ((gap[i] > 0.0 && gap[next] < 0.0) || (gap[i] < 0.0 && gap[next] > 0.0)) {
      const double s = gap[i] / (gap[i] - gap[next]);
      kept.push({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
    }
  }
  return kept;
}

void Clipping::add_point(const PlanePoint& p, double area) const {
  const std::optional<ParentPoint> on_slave = slave.over(p), on_master = master.over(p);
  if (!on_slave || !on_master) return;
  const Vec3 n = cross(slave.patch.tangent_1(on_slave->eta), slave.patch.tangent_2(on_slave->xi));
  const double gap = master.patch.at(on_master->xi, on_master->eta)[2] - slave.patch.at(on_slave->xi, on_slave->eta)[2];
  if (n[2] > 0.0) points.push_back({*on_slave, *on_master, area * std::sqrt(dot(n, n)) / n[2], gap});
}

void Clipping::add_triangle(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) const {
  static const std::array<TrianglePoint, 7> of_triangle = radon_rule();
  const double area = area_of(a, b, c);
  if (!(area > 0.0)) return;
  for (const auto& [l, weight] : of_triangle)
    add_point({l[0] * a[0] + l[1] * b[0] + l[2] * c[0], l[0] * a[1] + l[1] * b[1] + l[2] * c[1]}, weight * area);
}

void Clipping::add_polygon(const Polygon& polygon) const {
  for (std::size_t i = 2; i < polygon.size; ++i)
    add_triangle(polygon.corner[0], polygon.corner[i - 1], polygon.corner[i]);
}

/// Triangles from the centroid: whatever mirrors the polygon mirrors its points, and a corner that comes in beside
/// another one, as a motion by round-off makes them on sides that lie on each other, moves none of them.
void Clipping::add_star(const Polygon& polygon) const {
  const PlanePoint& o = polygon.corner[0];
  PlanePoint middle{};
  double total = 0.0;
  for (std::size_t i = 2; i < polygon.size; ++i) {
    const PlanePoint &p = polygon.corner[i - 1], &q = polygon.corner[i];
    const double a = area_of(o, p, q);
    total += a;
    for (std::size_t k = 0; k < 2; ++k) middle[k] += a / 3.0 * (p[k] + q[k] - 2.0 * o[k]);
  }
  if (!(total > 0.0)) return;
  for (std::size_t k = 0; k < 2; ++k) middle[k] = o[k] + middle[k] / total;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const PlanePoint &a = polygon.corner[i], &b = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
    if (rule.is_high) {
      add_triangle(middle, a, b);
      continue;
    }
    const double area = area_of(middle, a, b);
    if (!(area > 0.0)) continue;
    const PlanePoint* corner[3] = {&middle, &a, &b};
    for (const PlanePoint* near : corner) {  // 2/3 towards each corner: degree 2 (Strang and Fix 1973)
      PlanePoint p{};
      for (std::size_t k = 0; k < 2; ++k) p[k] = (middle[k] + a[k] + b[k] + 3.0 * (*near)[k]) / 6.0;
      add_point(p, area / 3.0);
    }
  }
}

void Clipping::add_moment_points(const Polygon& polygon) const {
  double area = 0.0, first[2]{}, xx = 0.0, xy = 0.0, yy = 0.0;
  const PlanePoint& o = polygon.corner[0];
  for (std::size_t i = 2; i < polygon.size; ++i) {
    const PlanePoint &p = polygon.corner[i - 1], &q = polygon.corner[i];
    const double a = area_of(o, p, q), px = p[0] - o[0], py = p[1] - o[1], qx = q[0] - o[0], qy = q[1] - o[1];
    area += a;
    first[0] += a / 3.0 * (px + qx);
    first[1] += a / 3.0 * (py + qy);
    xx += a / 6.0 * (px * px + px * qx + qx * qx);
    yy += a / 6.0 * (py * py + py * qy + qy * qy);
    xy += a / 12.0 * (2.0 * px * py + 2.0 * qx * qy + px * qy + qx * py);
  }
  if (!(area > 0.0)) return;
  const double cx = first[0] / area, cy = first[1] / area;
  const double l_11 = std::sqrt(std::max(0.0, xx / area - cx * cx));
  const double l_21 = l_11 > 0.0 ? (xy / area - cx * cy) / l_11 : 0.0;
  const double l_22 = std::sqrt(std::max(0.0, yy / area - cy * cy - l_21 * l_21));
  const double half_root = std::sqrt(0.5), root = std::sqrt(1.5);  // sqrt(2) sin 30, sqrt(2) cos 30
  const double s[3] = {0.0, -root, root}, t[3] = {2.0 * half_root, -half_root, -half_root};
  for (std::size_t k = 0; k < 3; ++k)
    add_point({o[0] + cx + l_11 * s[k], o[1] + cy + l_21 * s[k] + l_22 * t[k]}, area / 3.0);
}

OverlapExtent add_segment_overlap(const OverlapColumn& slave, const PlacedFacet& seen, const OverlapRule& rule,
                                  std::vector<OverlapPoint>& points) {
  static const std::vector<QuadraturePoint> gauss = gauss_legendre(3);
  const double half = 0.5 * slave.measure(), start = seen.x[0][0], end = seen.x[1][0];
  double low = std::max(-half, std::min(start, end)), high = std::min(half, std::max(start, end));
  if (!(high - low > negligible * std::min(2.0 * half, measure(seen)))) return {};
  const double slope = (seen.x[1][2] - seen.x[0][2]) / (end - start);
  const double gap_low = seen.x[0][2] + slope * (low - start), gap_high = seen.x[0][2] + slope * (high - start);
  const OverlapExtent extent{high - low, std::min(gap_low, gap_high)};
  if (rule.only_behind) {
    const double at_low = gap_low - rule.nearer, at_high = gap_high - rule.nearer;
    if (at_low < 0.0 && at_high > 0.0) high = low + (high - low) * at_low / (at_low - at_high);
    if (at_low > 0.0 && at_high < 0.0) low = high - (high - low) * at_high / (at_high - at_low);
  }
  for (const QuadraturePoint& point : gauss) {
    const double s = 0.5 * (low + high) + 0.5 * (high - low) * point.x;
    const double master_xi = std::clamp((2.0 * s - start - end) / (end - start), -1.0, 1.0);
    points.push_back({{s / half, 0.0},
                      {master_xi, 0.0},
                      0.5 * (high - low) * point.weight,
                      facet_position(seen, master_xi, 0.0)[2]});
  }
  return extent;
}

}  // namespace

OverlapExtent add_overlap(const OverlapColumn& slave, const PlacedFacet& seen_master, const OverlapRule& rule,
                          std::vector<OverlapPoint>& points) {
  const PlacedFacet& seen_slave = slave.seen();
  assert((seen_slave.size == 2) == (seen_master.size == 2) && seen_slave.size > 1 && seen_master.size > 1);
  if (seen_slave.size == 2) return add_segment_overlap(slave, seen_master, rule, points);
  const Shadow of_master(seen_master);
  Clipping overlap{
      {BilinearPatch(seen_slave), seen_slave.size}, {BilinearPatch(seen_master), seen_master.size}, rule, points};
  const double least = negligible * std::min(slave.measure(), measure(seen_master));
  for (std::size_t i = 0; i < slave.shadow().count; ++i) {
    for (std::size_t j = 0; j < of_master.count; ++j) {
      const Polygon common = clip(slave.shadow().part[i], of_master.part[j]);
      if (common.area() > least) overlap.add(without_flat_corners(common));
    }
  }
  return overlap.extent;
}

namespace {

ParentPoint on_edge(int size, std::size_t edge, double s) {
  static constexpr ParentPoint triangle[3] = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
  static constexpr ParentPoint quad[4] = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
  const auto n = static_cast<std::size_t>(size);
  const ParentPoint &p = size == 3 ? triangle[edge] : quad[edge],
                    &q = size == 3 ? triangle[(edge + 1) % n] : quad[(edge + 1) % n];
  return {p.xi + s * (q.xi - p.xi), p.eta + s * (q.eta - p.eta)};
}

void add_end(const OverlapColumn& slave, const PlacedFacet& seen, std::size_t end, double nearer,
             std::vector<BorderPoint>& points) {
  constexpr double inside_by = 1.0 - 2e-3;  // as along the sides of polygons
  const double half = 0.5 * slave.measure(), at = seen.x[end][0], gap = seen.x[end][2];
  if (!(std::abs(at) < inside_by * half) || !(gap < nearer)) return;
  const double sign = at > seen.x[1 - end][0] ? 1.0 : -1.0;
  points.push_back({{at / half, 0.0}, {end == 0 ? -1.0 : 1.0, 0.0}, 1.0, gap, scaled(slave.axis_1(), sign)});
}

}  // namespace

void add_border(const OverlapColumn& slave, const PlacedFacet& seen, std::size_t edge, double nearer,
                std::vector<BorderPoint>& points) {
  static const std::vector<QuadraturePoint> rule = gauss_legendre(3);
  if (seen.size == 2) {
    add_end(slave, seen, edge, nearer, points);
    return;
  }
  const SeenFacet over_slave{BilinearPatch(slave.seen()), slave.seen().size};
  const auto next = (edge + 1) % static_cast<std::size_t>(seen.size);
  const PlanePoint a{seen.x[edge][0], seen.x[edge][1]}, b{seen.x[next][0], seen.x[next][1]};
  PlanePoint middle{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(seen.size); ++c)
    for (std::size_t k = 0; k < 2; ++k) middle[k] += seen.x[c][k] / seen.size;
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  if (!(length > 0.0)) return;
  const double side = area_of(a, b, middle) > 0.0 ? 1.0 : -1.0;  // the master lies on the left: outward is the right
  const Vec3 outward = add(scaled(slave.axis_1(), side * (b[1] - a[1]) / length),
                           scaled(slave.axis_2(), -side * (b[0] - a[0]) / length));
  const double gap_a = seen.x[edge][2] - over_slave.height(a), gap_b = seen.x[next][2] - over_slave.height(b);
  for (std::size_t i = 0; i < slave.shadow().count; ++i) {
    Stretch stretch = inside(a, b, slave.shadow().part[i]);
    stretch.keep_positive(nearer - gap_a, nearer - gap_b);
    if (!(stretch.high > stretch.low)) continue;
    for (const QuadraturePoint& point : rule) {
      const double s = 0.5 * (stretch.low + stretch.high) + 0.5 * (stretch.high - stretch.low) * point.x;
      const PlanePoint p{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
      const std::optional<ParentPoint> on_slave = over_slave.over(p);
      if (!on_slave) continue;
      const double gap = seen.x[edge][2] + s * (seen.x[next][2] - seen.x[edge][2]) - over_slave.height(p);
      if (gap < nearer)
        points.push_back({*on_slave, on_edge(seen.size, edge, s),
                          0.5 * point.weight * (stretch.high - stretch.low) * length, gap, outward});
    }
  }
}

void hide_layers(const OverlapColumn& column, std::span<const ColumnMaster> masters,
                 std::vector<OverlapPoint>& points) {
  for (const ColumnMaster& own : masters) {
    for (std::size_t q = own.begin; q < own.end; ++q) {
      const Vec3 x = facet_position(column.placed(), points[q].slave.xi, points[q].slave.eta);
      for (const ColumnMaster& other : masters) {
        if (other.facet == own.facet) continue;
        const std::optional<RayHit> hit = intersect(other.placed, x, column.normal());
        if (hit && std::abs(hit->distance) < std::abs(points[q].gap)) points[q].weight = 0.0;
      }
    }
  }
}

bool is_in_front(const PlacedFacet& slave, const PlacedFacet& master, const OverlapPoint& point, double size) {
  constexpr double round_off = 1e-9;  // bodies that touch each other at the start are in front of each other
  const Vec3 way = subtract(facet_position(master, point.master.xi, point.master.eta),
                            facet_position(slave, point.slave.xi, point.slave.eta));
  return dot(way, facet_frame(slave, point.slave.xi, point.slave.eta).normal) >= -round_off * size;
}

}  // namespace carom
