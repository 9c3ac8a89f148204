#include "surface/surface_point.hpp"

#include <algorithm>

#include "math/vec3.hpp"

namespace carom {

FacetFoot foot_at(Index f, const Projection& p, const Vec3& normal, double gap) {
  return {f, 1.0, p.xi, p.eta, p.N, p.a_1, p.a_2, p.normal, normal, gap, {}, {}, p.N};
}

bool fade_unlike(FacetFoot& foot, double b, const FacetFoot& nearest) {
  const double z = foot.gap - nearest.gap, rest = 1.0 - z * z / (b * b);
  if (!(rest > 0.0)) return false;
  const double share = rest * rest;
  foot.unlike_slope = -4.0 * z * rest / (b * b) * foot.weight;
  foot.weight *= share;
  foot.gradient = scaled(foot.gradient, share);
  foot.at_closest = scaled(foot.at_closest, share);
  return true;
}

void take_mean(SurfacePoint& met) {
  double sum = 0.0;
  for (const FacetFoot& foot : met.feet) sum += foot.weight;
  met.gap = 0.0;
  met.gradient = {};
  for (FacetFoot& foot : met.feet) {
    foot.weight /= sum;
    met.gap += foot.weight * foot.gap;
  }
  double of_nearest = 0.0;  // slope of the mean in the nearest facet's gap, by the weights of the others
  for (FacetFoot& foot : met.feet) {
    const double share = (foot.gap - met.gap) / sum, of_gap = share * foot.unlike_slope;
    of_nearest -= of_gap;
    foot.at_closest = scaled(foot.at_closest, share);
    foot.gradient = add(scaled(foot.gradient, share), scaled(foot.normal, foot.weight + of_gap));
    met.gradient = add(met.gradient, add(foot.gradient, foot.at_closest));
  }
  const Vec3 rest = scaled(met.feet.front().normal, of_nearest);
  met.feet.front().gradient = add(met.feet.front().gradient, rest);
  met.gradient = add(met.gradient, rest);
}

void take_only(Index f, const Projection& p, const SignedDistance& at, SurfacePoint& met) {
  met.facet = f;
  met.feet.assign(1, foot_at(f, p, at.normal, at.gap));
  met.feet.front().gradient = at.normal;
  met.gradient = at.normal;
  met.gap = at.gap;
  met.rounded = 0.0;
}

void fade(Index f, const Projection& p, const Rim& rim, const Vec3& x, SurfacePoint& met) {
  const Vec3 way = subtract(x, rim.point);
  const double width_2 = rim.width * rim.width;
  const double rest = std::max(0.0, 1.0 - std::max(0.0, dot(way, way) - p.gap * p.gap) / width_2);
  const double share = rest * rest, slope = -4.0 * rest / width_2;  // of the share in t^2 / 2
  for (FacetFoot& foot : met.feet) {
    foot.gradient = scaled(foot.gradient, share);
    foot.at_closest = scaled(foot.at_closest, share);
  }
  FacetFoot at_end = foot_at(f, p, p.normal, 0.0);
  at_end.weight = 0.0;
  at_end.gradient = scaled(p.normal, -met.gap * slope * p.gap);
  at_end.at_closest = scaled(way, met.gap * slope);
  at_end.N_closest = rim.N;
  met.feet.push_back(at_end);
  met.gradient = add(scaled(met.gradient, share), add(at_end.gradient, at_end.at_closest));
  met.gap *= share;
}

}  // namespace carom
