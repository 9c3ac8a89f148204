#include "surface/target_surface.hpp"

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"

namespace carom {

Vec3 TargetSurface::pseudonormal(Index f, const Projection& p) const {
  const Facet& at = facet(f);
  const auto k = static_cast<std::size_t>(p.feature);
  Vec3 sum{};
  for (const Index other : topology_.around(f, p)) {
    const Facet& beside = facet(other);
    const PlacedFacet there = placed(other);
    if (!topology_.is_at(other, f, p)) continue;
    double weight = 1.0;
    if (p.site == ProjectionSite::vertex && beside.size > 2) {
      const auto n = static_cast<std::size_t>(beside.size);
      const auto a = static_cast<std::size_t>(std::find(beside.begin(), beside.end(), at[k]) - beside.begin());
      const Vec3& corner = there.x[a];
      const Vec3 to_next = subtract(there.x[(a + 1) % n], corner);
      const Vec3 to_last = subtract(there.x[(a + n - 1) % n], corner);
      weight = std::atan2(norm(cross(to_next, to_last)), dot(to_next, to_last));
    }
    sum = add(sum, scaled(project(there, p.point).normal, weight));
  }
  const double length = norm(sum);
  return length > 0.0 ? scaled(sum, 1.0 / length) : p.normal;
}

}  // namespace carom
