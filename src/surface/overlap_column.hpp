// A slave facet's column along its normal, in which the facets of the other surface are looked for.
#pragma once

#include <array>

#include "surface/box_tree.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/polygon.hpp"

namespace carom {

/// a^alpha N_b,alpha at the facet's centre, where its frame is given: its normal turns by
/// dn = - sum over b of turn_b (n . du_b)   (1 / length).
std::array<Vec3, 4> turn_of_normal(const PlacedFacet& facet, const FacetFrame& at_centre);

/// A slave facet at its current position, and all that is seen in the axes of its plane: origin at its centre, x and y
/// in the plane, z along its normal there.
class OverlapColumn {
 public:
  explicit OverlapColumn(const PlacedFacet& facet);

  const PlacedFacet& placed() const { return placed_; }
  const FacetFrame& frame() const { return frame_; }  ///< at the centre
  const Vec3& normal() const { return frame_.normal; }
  const Vec3& axis_1() const { return axis_1_; }
  const Vec3& axis_2() const { return axis_2_; }
  double measure() const { return measure_; }        ///< area, or length
  const PlacedFacet& seen() const { return seen_; }  ///< itself in these axes
  const Shadow& shadow() const { return shadow_; }   ///< empty for segments

  /// Another facet in these axes.
  PlacedFacet seen(const PlacedFacet& facet) const;
  /// False when a facet, given in these axes, lies nowhere over or under this one, or farther outward than `reach`
  /// (length).
  bool may_overlap(const PlacedFacet& seen_facet, double reach) const;

 private:
  PlacedFacet placed_;
  FacetFrame frame_;
  Vec3 axis_1_, axis_2_;
  PlacedFacet seen_;
  Bounds extent_;
  Shadow shadow_;
  double measure_;
};

}  // namespace carom
