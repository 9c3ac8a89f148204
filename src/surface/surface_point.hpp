// The point of a surface that a node meets, put together from feet on facets.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "math/vec3.hpp"
#include "surface/facet_projection.hpp"

namespace carom {

/// The foot of a node on one facet that it meets: the point of the perpendicular.
struct FacetFoot {
  /// The part of a gradient that a foot stands for: `gradient` along x, and times -N_a along x_a; at_closest the same
  /// with N_closest.
  struct Slope {
    Vec3 gradient{}, at_closest{};
  };
  Index facet = -1;
  double weight = 1.0;         ///< share of this facet in what the node meets
  double xi = 0.0, eta = 0.0;  ///< a little outside of the facet beyond an edge
  std::array<double, 4> N{};
  Vec3 a_1{}, a_2{}, facet_normal{};  ///< tangents and normal of the facet there
  Vec3 normal{};                      ///< unit vector along x - foot
  double gap = 0.0;                   ///< (x - foot) . normal
  Slope slope{};                      ///< of the node's gap
  std::array<double, 4> N_closest{};  ///< at the facet's closest point
  Slope of_weight{};                  ///< the slope of the weight without the change of unlike gaps,
  double unlike_slope = 0.0;          ///< and of the weight in the difference of the gap to that of the nearest facet
};

/// The point that a node meets: on one facet, or beside edges on several, whose weights add up to 1. gap = sum_f
/// weight_f gap_f; its gradient by x is `gradient` (of length 1 where the facets lie in one plane), by the facets'
/// nodes see FacetFoot.
struct SurfacePoint {
  Index facet = -1;  ///< the nearest
  std::vector<FacetFoot> feet;
  Vec3 gradient{};
  double gap = 0.0;
  /// The length, >= 0, by which the gap is below that of the nearest facet alone and of the body with its sides where
  /// they are.
  double rounded = 0.0;
};

FacetFoot::Slope scaled(const FacetFoot::Slope& slope, double factor);

/// A foot at the facet's closest point, alone.
FacetFoot foot_at(Index f, const Projection& p, const Vec3& normal, double gap);

/// Multiplies the weight of a foot by (1 - z^2 / b^2)^2, z = g - g_0 the difference of its gap to that of the nearest
/// facet; false where nothing is left.
bool fade_unlike(FacetFoot& foot, double b, const FacetFoot& nearest);

/// Makes the point the mean over its feet, the nearest first: their weights and the slopes of these are divided by the
/// sum.
void take_mean(SurfacePoint& met);

/// sum_f weight_f n_f, n_f the normals of the facets.
Vec3 mean_normal(const SurfacePoint& met);

/// The gradient of sum_f weight_f value(f), the values held, which is that of the weights: calls use(f, slope) for the
/// part of each foot.
template <class Value, class Use>
void for_each_slope_of_weights(const SurfacePoint& met, const Value& value, const Use& use) {
  double mean = 0.0, of_nearest = 0.0;  // the latter in the nearest facet's gap, by the weights of the others
  for (std::size_t f = 0; f < met.feet.size(); ++f) mean += met.feet[f].weight * value(f);
  for (std::size_t f = 0; f < met.feet.size(); ++f) of_nearest -= (value(f) - mean) * met.feet[f].unlike_slope;
  for (std::size_t f = 0; f < met.feet.size(); ++f) {
    const FacetFoot& foot = met.feet[f];
    const double beyond = value(f) - mean, of_gap = beyond * foot.unlike_slope + (f == 0 ? of_nearest : 0.0);
    FacetFoot::Slope slope = scaled(foot.of_weight, beyond);
    slope.gradient = add(slope.gradient, scaled(foot.normal, of_gap));
    use(f, slope);
  }
}

/// Makes the point one of facet f alone.
void take_only(Index f, const Projection& p, const SignedDistance& at, SurfacePoint& met);

/// The closest point of a facet's end, and how far the facet is continued beyond it.
struct Rim {
  Vec3 point{};
  std::array<double, 4> N{};
  double width = 0.0;
};

/// Multiplies the gap of a point beyond the end of facet f by (1 - t^2 / w^2)^2, t^2 = |x - p|^2 - g^2 the distance
/// from the end's closest point p along the facet, g the gap from the facet: so that it begins at zero at t = w,
/// without a kink at either end. The gradient is exact.
void fade(Index f, const Projection& p, const Rim& rim, const Vec3& x, SurfacePoint& met);

}  // namespace carom
