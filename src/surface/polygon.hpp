// Convex polygons in a plane: clipping, and the shadows of facets.
#pragma once

#include <array>
#include <cstddef>

#include "surface/facet_geometry.hpp"

namespace carom {

/// A point of the plane.
using PlanePoint = std::array<double, 2>;

/// The area of a triangle, positive when counter-clockwise.
inline double area_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

/// Convex polygon, counter-clockwise. Clipping a quadrilateral by four lines makes at most 8 corners; the rest is for
/// corners that are doubled by round-off, of which any beyond the last place bound no area.
struct Polygon {
  std::array<PlanePoint, 16> corner{};
  std::size_t size = 0;

  void push(const PlanePoint& p) {
    if (size < corner.size()) corner[size++] = p;
  }
  double area() const;
};

/// The part of the polygon inside of the window, both convex (Sutherland and Hodgman, Comm. ACM 17, 1974).
Polygon clip(Polygon polygon, const Polygon& window);

/// The polygon without corners that stand out of the side between their neighbours by round-off alone: sides that lie
/// on each other cross somewhere, and the points of a rule would move with that.
Polygon without_flat_corners(Polygon polygon);

/// The stretch [low, high] of a segment from a (0) to b (1); empty where low >= high.
struct Stretch {
  double low = 0.0, high = 1.0;

  /// Keeps the part where the value, linear from `at_a` to `at_b`, is positive.
  void keep_positive(double at_a, double at_b);
};

/// The stretch inside of a convex polygon, away from its sides by more than round-off. A segment that runs along a side
/// counts when it lies a thousandth of the polygon inside: borders of bodies of one width would else be pushed by what
/// round-off makes of their common border, on one side and not on the other.
Stretch inside(const PlanePoint& a, const PlanePoint& b, const Polygon& polygon);

/// The shadow on the x-y plane of a triangle or quadrilateral, as one or two convex polygons: a facet that is not
/// convex when projected is split into two triangles.
class Shadow {
 public:
  std::array<Polygon, 2> part;
  std::size_t count = 0;

  Shadow() = default;  ///< none
  explicit Shadow(const PlacedFacet& facet);

 private:
  void add_part(const std::array<PlanePoint, 4>& p, double sign, std::array<std::size_t, 4> corners, std::size_t size);
};

}  // namespace carom
