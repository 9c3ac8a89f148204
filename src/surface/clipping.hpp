// Overlap of two facets: clipped polygons with quadrature points, for surface-to-surface contact.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/overlap_column.hpp"

namespace carom {

/// Quadrature point of the overlap of a slave and a master facet.
struct OverlapPoint {
  ParentPoint slave, master;  ///< inside of their facets
  double weight = 0.0;        ///< area (length for segments) of the slave that the point stands for
  double gap = 0.0;           ///< (x_master - x_slave) . n_0: positive when the master lies on the slave's outer side
};

/// Says which quadrature points stand for an overlap.
struct OverlapRule {
  /// True: 7 points a triangle, as above. False, where one of the facets is a quadrilateral and the overlap is behind:
  /// 3 points, degree 2, in each triangle from the polygon's centroid, so that what mirrors it mirrors them. Else three
  /// points a polygon, c + sqrt(2) L (cos t, sin t) at t = 90, 210 and 330 degrees, c being its centroid and L L^T = S
  /// its second moments over its area: degree 2 exactly, whatever its corners, and always inside (Kannan, Lovasz and
  /// Simonovits, Discrete Comput. Geom. 13, 1995: a convex body holds sqrt(1 + 2 / n) times the ball of its second
  /// moments).
  bool is_high = true;
  /// Overlaps that the gap 0 divides have points where it is negative alone. The triangles of the rule of 7 points then
  /// are those from the polygon's centroid, too.
  bool only_behind = false;
  /// Gaps below this count as behind there: what the faces that the facets are pieces of may be nearer to each other
  /// by.
  double nearer = 0.0;
};

/// The size of an overlap, whether it has points or not.
struct OverlapExtent {
  double area = 0.0;
  double least_gap = std::numeric_limits<double>::infinity();  ///< at the polygon's corners
};

/// Appends the quadrature points of the part of the slave that lies under a master, seen along the slave's normal n_0
/// at its centre; the master is given in the axes of the slave's column. Which side the master shows is not looked at:
/// that is the caller's choice, as is the largest gap. The shadows of both facets in the plane through the slave's
/// centre with normal n_0 are clipped against each other (polygon.hpp; contact: Puso and Laursen, Comput. Methods Appl.
/// Mech. Engrg. 193, 2004, section 5). The overlap is divided into triangles, from its centroid where
/// one of the facets is a quadrilateral and else from one corner, with the rule of 7 points and degree 5 (Radon 1948;
/// Strang and Fix 1973) on each; on segments 3 Gauss points. weight = dA |a_1 x a_2| /
/// (n_0 . a_1 x a_2), the true area on a warped slave, too. On flat facets whose parametrisation is affine N_a N_b is
/// integrated exactly. Overlaps below 1e-12 of the smaller facet's area are dropped. Both facets: segments, or
/// triangles and quadrilaterals.
OverlapExtent add_overlap(const OverlapColumn& slave, const PlacedFacet& seen_master, const OverlapRule& rule,
                          std::vector<OverlapPoint>& points);

/// A point of the master's border over the slave.
struct BorderPoint {
  ParentPoint slave, master;  ///< inside of the slave, on the edge of the master
  double length = 0.0;        ///< of the border that the point stands for; 1 for segments
  double gap = 0.0;           ///< as of OverlapPoint
  Vec3 outward{};             ///< unit vector in the slave's plane, normal to the border, away from the master
};

/// Appends points of edge `edge` of the master (from its node `edge` to the next; of a segment that node) where it lies
/// over the inside of the slave, by more than round-off, and behind it or less than `nearer` in front of it
/// (OverlapRule): 3 Gauss points. An overlap grows by what this border moves outward.
void add_border(const OverlapColumn& slave, const PlacedFacet& seen_master, std::size_t edge, double nearer,
                std::vector<BorderPoint>& points);

/// A master facet that lies in a column, and the range of its points in a list.
struct ColumnMaster {
  Index facet;
  PlacedFacet placed, seen;  ///< seen: in the axes of the column
  std::size_t begin, end;
};

/// Sets the weight of every point to zero that has another master nearer along the normal.
void hide_layers(const OverlapColumn& column, std::span<const ColumnMaster> masters, std::vector<OverlapPoint>& points);

/// True when the master's point lies on the slave's outer side, or by no more than rounding behind it, the facets being
/// given where they stood. size: of the facets.
bool is_in_front(const PlacedFacet& slave, const PlacedFacet& master, const OverlapPoint& point, double size);

}  // namespace carom
