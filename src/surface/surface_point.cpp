#include "surface/surface_point.hpp"

#include <algorithm>

#include "math/vec3.hpp"

namespace carom {

FacetFoot foot_at(Index f, const Projection& p, const Vec3& normal, double gap) {
  FacetFoot foot{f, 1.0, p.xi, p.eta, p.N, p.a_1, p.a_2, p.normal, normal, gap};
  foot.N_closest = p.N;
  return foot;
}

FacetFoot::Slope scaled(const FacetFoot::Slope& slope, double factor) {
  return {scaled(slope.gradient, factor), scaled(slope.at_closest, factor)};
}

bool fade_unlike(FacetFoot& foot, double b, const FacetFoot& nearest) {
  const double z = foot.gap - nearest.gap, rest = 1.0 - z * z / (b * b);
  if (!(rest > 0.0)) return false;
  const double share = rest * rest;
  foot.unlike_slope = -4.0 * z * rest / (b * b) * foot.weight;
  foot.weight *= share;
  foot.of_weight = scaled(foot.of_weight, share);
  return true;
}

void take_mean(SurfacePoint& met) {
  double sum = 0.0;
  for (const FacetFoot& foot : met.feet) sum += foot.weight;
  met.gap = 0.0;
  for (FacetFoot& foot : met.feet) {
    foot.weight /= sum;
    foot.of_weight = scaled(foot.of_weight, 1.0 / sum);
    foot.unlike_slope /= sum;
    met.gap += foot.weight * foot.gap;
  }
  met.gradient = {};
  const auto gap = [&](std::size_t f) { return met.feet[f].gap; };
  for_each_slope_of_weights(met, gap, [&](std::size_t f, const FacetFoot::Slope& of_weight) {
    FacetFoot& foot = met.feet[f];
    foot.slope = of_weight;
    foot.slope.gradient = add(foot.slope.gradient, scaled(foot.normal, foot.weight));
    met.gradient = add(met.gradient, add(foot.slope.gradient, foot.slope.at_closest));
  });
}

Vec3 mean_normal(const SurfacePoint& met) {
  Vec3 normal{};
  for (const FacetFoot& foot : met.feet) normal = add(normal, scaled(foot.facet_normal, foot.weight));
  return normal;
}

void take_only(Index f, const Projection& p, const SignedDistance& at, SurfacePoint& met) {
  met.facet = f;
  met.feet.assign(1, foot_at(f, p, at.normal, at.gap));
  met.feet.front().slope.gradient = at.normal;
  met.gradient = at.normal;
  met.gap = at.gap;
  met.rounded = 0.0;
}

void fade(Index f, const Projection& p, const Rim& rim, const Vec3& x, SurfacePoint& met) {
  const Vec3 way = subtract(x, rim.point);
  const double width_2 = rim.width * rim.width;
  const double rest = std::max(0.0, 1.0 - std::max(0.0, dot(way, way) - p.gap * p.gap) / width_2);
  const double share = rest * rest, slope = -4.0 * rest / width_2;  // of the share in t^2 / 2
  for (FacetFoot& foot : met.feet) foot.slope = scaled(foot.slope, share);
  FacetFoot at_end = foot_at(f, p, p.normal, 0.0);
  at_end.weight = 0.0;
  at_end.slope = {scaled(p.normal, -met.gap * slope * p.gap), scaled(way, met.gap * slope)};
  at_end.N_closest = rim.N;
  met.feet.push_back(at_end);
  met.gradient = add(scaled(met.gradient, share), add(at_end.slope.gradient, at_end.slope.at_closest));
  met.gap *= share;
}

}  // namespace carom
