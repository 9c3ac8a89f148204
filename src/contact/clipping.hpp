// Overlap of two facets: clipped polygons with quadrature points, for surface-to-surface contact.
#pragma once

#include <vector>

#include "base/types.hpp"
#include "contact/facet_geometry.hpp"

namespace carom {

/// Quadrature point of the overlap of a slave and a master facet.
struct OverlapPoint {
  ParentPoint slave, master;  ///< inside of their facets
  double weight = 0.0;        ///< area (length for segments) of the slave that the point stands for
  double gap = 0.0;           ///< (x_master - x_slave) . n_0: positive when the master lies on the slave's outer side
};

/// Appends the quadrature points of the part of the slave that lies under the master, seen along the slave's normal n_0
/// at its centre, and returns their number. Which side the master shows is not looked at: that is the caller's choice,
/// as is the largest gap. Both facets are projected on the plane through the slave's centre with normal n_0 and clipped
/// against each other (Sutherland and Hodgman, Comm. ACM 17, 1974; contact: Puso and Laursen, Comput. Methods Appl.
/// Mech. Engrg. 193, 2004, section 5). The overlap is divided into triangles from one corner with the rule of 7
/// points and degree 5 (Radon 1948; Strang and Fix 1973) on each; on segments 3 Gauss points. weight = dA |a_1 x a_2| /
/// (n_0 . a_1 x a_2), the true area on a warped slave, too. On flat facets whose parametrisation is affine N_a N_b is
/// integrated exactly. A facet that is not convex when projected is split into two triangles. Overlaps below 1e-12 of
/// the smaller facet's area are dropped. Both facets: segments, or triangles and quadrilaterals.
int add_overlap(const PlacedFacet& slave, const PlacedFacet& master, std::vector<OverlapPoint>& points);

}  // namespace carom
