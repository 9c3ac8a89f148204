#include "surface/node_normals.hpp"

#include <utility>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/surface_topology.hpp"

namespace carom {

NodeNormals::NodeNormals(std::span<const Index> nodes, std::vector<Facet> own, std::size_t node_count)
    : own_(std::move(own)) {
  const std::vector<std::vector<Index>> facets_at = facets_of_nodes(own_, node_count);
  for (const Index n : nodes) {
    at_.insert(at_.end(), facets_at[n].begin(), facets_at[n].end());
    begin_.push_back(at_.size());
  }
}

void NodeNormals::choose(const BroadPhase& lists) {
  active_.assign(own_.size(), [&](const auto& name) {
    for (std::size_t q = 0; q < lists.queries().size(); ++q) {
      if (lists.targets_of(q).empty()) continue;
      for (const Index f : facets_of(q)) name(f);
    }
  });
}

void NodeNormals::move_to(std::span<const Vec3> x) {
  x_ = x;
  areas_.resize(own_.size());
  const std::span<const Index> active = active_.numbers();
  parallel_for(active.size(), facet_grain, [&](std::size_t begin, std::size_t end) {
    for (const Index f : active.subspan(begin, end - begin)) areas_[f] = area_vector(place(own_[f], x));
  });
}

Vec3 NodeNormals::at(std::size_t q) const {
  Vec3 sum{};
  for (const Index f : facets_of(q)) sum = add(sum, active_.contains(f) ? areas_[f] : area_vector(place(own_[f], x_)));
  return direction(sum);
}

}  // namespace carom
