#include "surface/active_facets.hpp"

#include "parallel/threads.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

void ActiveFacets::choose(const BroadPhase& lists) {
  active_.assign(lists.targets().size(), [&](const auto& name) {
    for (std::size_t q = 0; q < lists.queries().size(); ++q)
      for (const Index f : lists.targets_of(q)) name(f);
  });
}

void ActiveFacets::move_to(std::span<const Facet> facets, std::span<const Vec3> x) {
  bounds_.resize(facets.size());
  normals_.resize(facets.size());
  const std::span<const Index> active = active_.numbers();
  parallel_for(active.size(), facet_grain, [&](std::size_t begin, std::size_t end) {
    for (const Index f : active.subspan(begin, end - begin)) {
      const PlacedFacet facet = place(facets[f], x);
      Bounds& box = bounds_[f] = {};
      for (int a = 0; a < facet.size; ++a) box.include(facet.x[static_cast<std::size_t>(a)]);
      normals_[f] = direction(area_vector(facet));
    }
  });
}

}  // namespace carom
