// A slave facet's column along its normal, in which the facets of the other surface are looked for.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact/box_tree.hpp"
#include "contact/clipping.hpp"

namespace carom {

/// a^alpha N_b,alpha at the facet's centre, where its frame is given: its normal turns by
/// dn = - sum over b of turn_b (n . du_b)   (1 / length).
std::array<Vec3, 4> turn_of_normal(const PlacedFacet& facet, const FacetFrame& at_centre);

/// A slave facet at its current position, and its extent along its plane's axes and normal at the centre.
struct OverlapColumn {
  PlacedFacet placed;
  FacetFrame frame;  ///< at the centre
  Vec3 axis_1, axis_2;
  Bounds extent;

  explicit OverlapColumn(const PlacedFacet& facet);
  const Vec3& normal() const { return frame.normal; }
  /// False when the other facet lies nowhere over or under this one, or farther outward than `reach` (length).
  bool may_overlap(const PlacedFacet& other, double reach) const;

 private:
  Bounds extent_of(const PlacedFacet& facet) const;
};

/// A master facet that lies in a column, and the range of its points in a list.
struct ColumnMaster {
  Index facet;
  PlacedFacet placed;
  std::size_t begin, end;
};

/// Sets the weight of every point to zero that has another master nearer along the normal.
void hide_layers(const OverlapColumn& column, std::span<const ColumnMaster> masters, std::vector<OverlapPoint>& points);

/// True when the master's point lies on the slave's outer side, or by no more than rounding behind it, the facets being
/// given where they stood. size: of the facets.
bool is_in_front(const PlacedFacet& slave, const PlacedFacet& master, const OverlapPoint& point, double size);

}  // namespace carom
