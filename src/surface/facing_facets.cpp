#include "surface/facing_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <utility>

#include "math/vec3.hpp"
#include "surface/box_tree.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

namespace {

/// Of the sizes of two facets: how far one may be behind the other.
constexpr double slack = 0.25;

/// A facet as something that looks along its normal.
struct Look {
  PlacedFacet placed;
  Vec3 centre{}, normal{};
  double size = 0.0;

  Look(const Facet& facet, std::span<const Vec3> x) : placed(place(facet, x)) {
    const ParentPoint middle = facet_centre(facet.size);
    const FacetFrame frame = facet_frame(placed, middle.xi, middle.eta);
    centre = frame.position;
    normal = frame.normal;
    for (std::size_t a = 0; a < static_cast<std::size_t>(placed.size); ++a)
      size = std::max(size, norm(subtract(placed.x[a], centre)));
  }
  /// How far the foremost node of the other lies before this facet's plane.
  double before(const Look& other) const {
    double most = -INFINITY;
    for (std::size_t a = 0; a < static_cast<std::size_t>(other.placed.size); ++a)
      most = std::max(most, dot(normal, subtract(other.placed.x[a], centre)));
    return most;
  }
};

bool look_at_each_other(const Look& a, const Look& b) {
  const double least = -slack * (a.size + b.size);
  return dot(a.normal, b.normal) < opposed && a.before(b) > least && b.before(a) > least;
}

/// Facets of one side, grouped by what they look at, so that few have to be compared.
class Looks {
 public:
  Looks(std::span<const Facet> facets, std::span<const Vec3> x) {
    for (const Facet& facet : facets) all_.emplace_back(facet, x);
    for (std::size_t i = 0; i < all_.size(); ++i) {
      std::array<long, 3> key{};
      for (std::size_t c = 0; c < 3; ++c) key[c] = std::lround(parts * all_[i].normal[c]);
      Group& group = groups_[key];
      group.members.push_back(i);
      group.size = std::max(group.size, all_[i].size);
      for (std::size_t a = 0; a < static_cast<std::size_t>(all_[i].placed.size); ++a)
        group.box.include(all_[i].placed.x[a]);
    }
  }
  std::span<const Look> all() const { return all_; }

  /// True where `a` looks at one of the facets.
  bool are_seen_by(const Look& a) const {
    return std::any_of(groups_.begin(), groups_.end(), [&](const auto& entry) {
      const auto& [key, group] = entry;
      double product = 0.0, most = -dot(a.normal, a.centre);
      for (std::size_t c = 0; c < 3; ++c) {
        product += a.normal[c] * static_cast<double>(key[c]) / parts;
        most += std::max(a.normal[c] * group.box.low[c], a.normal[c] * group.box.high[c]);
      }
      // normals of a group are within the half diagonal of a cube of edge 1 / parts
      if (product - 0.5 * std::sqrt(3.0) / parts >= opposed || most <= -slack * (a.size + group.size)) return false;
      return std::any_of(group.members.begin(), group.members.end(),
                         [&](std::size_t i) { return look_at_each_other(a, all_[i]); });
    });
  }

 private:
  static constexpr double parts = 4.0;
  struct Group {
    std::vector<std::size_t> members;
    Bounds box;
    double size = 0.0;
  };
  std::vector<Look> all_;
  std::map<std::array<long, 3>, Group> groups_;
};

std::vector<Facet> seen(std::span<const Facet> facets, const Looks& own, const Looks& others) {
  std::vector<Facet> out;
  for (std::size_t i = 0; i < facets.size(); ++i)
    if (others.are_seen_by(own.all()[i])) out.push_back(facets[i]);
  return out;
}

std::vector<Vec3> initial_positions(const Model& model) {
  std::vector<Vec3> x = model.mesh->coordinates;
  for (const InitialState& initial : model.initial) {
    if (initial.displacement.empty() || initial.stage > 0) continue;
    for (std::size_t k = 0; k < initial.nodes.size(); ++k) {
      const auto i = static_cast<std::size_t>(initial.nodes[k]);
      x[i] = add(model.mesh->coordinates[i], initial.displacement_of(k));
    }
  }
  return x;
}

}  // namespace

FacingFacets facing_facets(const Model& model, const PairContact& pair) {
  const std::vector<Facet>&slave = pair.slave.facets, &master = pair.master.facets;
  const auto is_point = [](const Facet& facet) { return facet.size == 1; };
  if (pair.self || std::any_of(slave.begin(), slave.end(), is_point)) return {slave, master};
  const std::vector<Vec3> x = initial_positions(model);
  const Looks slaves(slave, x), masters(master, x);
  FacingFacets facing{seen(slave, slaves, masters), seen(master, masters, slaves)};
  if (facing.slave.empty()) return {slave, master};
  return facing;
}

Model with_facing_facets(Model model) {
  for (ContactDefinition& contact : model.contacts) {
    auto* pair = std::get_if<PairContact>(&contact);
    if (pair == nullptr) continue;
    FacingFacets facing = facing_facets(model, *pair);
    pair->slave.facets = std::move(facing.slave);
    pair->master.facets = std::move(facing.master);
  }
  return model;
}

}  // namespace carom
