#include "surface/body_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <tuple>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_size.hpp"
#include "model/bodies.hpp"
#include "model/node_lengths.hpp"
#include "model/outer_facets.hpp"
#include "parallel/found_by_ranks.hpp"
#include "parallel/threads.hpp"
#include "surface/cell_location.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/facet_projection.hpp"
#include "surface/rigid_shapes.hpp"

namespace carom {
namespace {

/// A signed distance from the surface that faces the node within `reach`, infinite where none does.
double distance_behind(const Surface& surface, std::span<const Vec3> X, const Vec3& x, double reach) {
  Projection nearest;
  nearest.distance = reach;
  bool is_found = false;
  for (const Facet& facet : surface.facets) {
    const PlacedFacet placed = place(facet, X);
    Bounds box;
    for (int a = 0; a < placed.size; ++a) box.include(placed.x[static_cast<std::size_t>(a)]);
    box.grow(nearest.distance);
    if (!box.contains(x)) continue;
    const Projection p = project(placed, x);
    if (p.distance >= nearest.distance) continue;
    nearest = p;
    is_found = true;
  }
  return is_found && nearest.site == ProjectionSite::interior ? nearest.gap : infinity;
}

/// All nodes of the bars that have one of the nodes.
void add_bars(const Model& model, std::vector<Index>& nodes) {
  std::vector<bool> is_named(model.mesh->node_count(), false);
  for (const Index n : nodes) is_named[static_cast<std::size_t>(n)] = true;
  for (const Part& part : model.parts) {
    if (part.cells.empty() || dimension(part.type) != 1) continue;
    std::vector<Index> own;
    for (const Index cell : part.cells)
      for (const Index n : model.mesh->block(part.type)->nodes(cell)) own.push_back(n);
    const auto named = [&](Index n) { return is_named[static_cast<std::size_t>(n)]; };
    if (std::any_of(own.begin(), own.end(), named)) nodes.insert(nodes.end(), own.begin(), own.end());
  }
}

struct GapOfShape {
  std::span<const Vec3> X;
  const Vec3& x;
  double reach;

  double operator()(const RigidSurface& rigid) const { return distance_behind(rigid.surface, X, x, reach); }
  template <class Shape>
  double operator()(const Shape& shape) const {
    return signed_distance(shape, x).gap;
  }
};

}  // namespace

struct BodyOverlap::Impl {
  const Model& model;
  PlacedCells cells;  ///< where they were looked at last
  std::shared_ptr<const std::vector<OuterFacet>> skin;
  std::shared_ptr<const std::vector<double>> lengths;  ///< node_lengths
  std::vector<Index> skin_nodes;                       ///< increasing
  std::vector<Index> number;                           ///< of a node among them; -1: inside
  std::vector<Index> first_cell, cells_at;             ///< by skin node (position in skin_nodes): rows of its cells
  std::vector<Index> first_facet, facets_at;           ///< and of its facets
  std::vector<Index> body;                             ///< by node: the same for nodes of one connected body
  std::vector<double> at_start;                        ///< by skin node: depth in cells
  std::vector<std::vector<double>> obstacle_at_start;  ///< by contact and node of it
  std::vector<std::vector<Index>> obstacle_nodes;      ///< by contact

  Impl(const Model& of, std::span<const double> u);
  /// A node of the skin inside of a cell, so deep, in cells.
  struct Inside {
    Index skin_node = -1, cell = -1;
    double depth = 0.0;
  };
  void find_skin();
  template <class ForEach>
  void gather(const ForEach& for_each, std::vector<Index>& first, std::vector<Index>& at) const;
  double node_length(Index n) const { return (*lengths)[static_cast<std::size_t>(n)]; }
  double reference_length(std::size_t cell) const;
  bool may_meet(std::size_t skin_node, Index cell) const;
  double depth(std::size_t skin_node, Index cell, const Vec3& x) const;
  double depth_under_skin(std::size_t cell, const Vec3& x) const;
  std::vector<Inside> inside(std::span<const double> u);
  std::vector<double> obstacle_depths(std::size_t c, std::span<const double> u) const;  ///< after inside
};

BodyOverlap::Impl::Impl(const Model& of, std::span<const double> u)
    : model(of),
      cells(of, {}, CellsOf::rank),
      skin(outer_facets(of)),
      lengths(node_lengths(of)),
      body(bodies_of_nodes(of)) {
  find_skin();
  at_start.assign(skin_nodes.size(), 0.0);
  for (const Inside& found : inside(u)) at_start[at(found.skin_node)] = found.depth;
  for (const ContactDefinition& definition : model.contacts) {
    obstacle_nodes.emplace_back();
    if (const ContactParts obstacle = parts_of(definition); obstacle.shape != nullptr) {
      std::vector<Index>& nodes = obstacle_nodes.back();
      nodes = nodes_of(obstacle, *model.mesh);
      add_bars(model, nodes);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      std::erase_if(nodes, [&](Index n) { return node_length(n) == infinity; });
    }
    obstacle_at_start.push_back(obstacle_depths(obstacle_nodes.size() - 1, u));
  }
}

/// The nodes of the skin of the mesh, their cells and their facets.
void BodyOverlap::Impl::find_skin() {
  number.assign(model.mesh->node_count(), -1);
  for (const OuterFacet& outer : *skin)
    for (const Index n : outer.facet) number[n] = 0;
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] < 0) continue;
    number[n] = static_cast<Index>(skin_nodes.size());
    skin_nodes.push_back(static_cast<Index>(n));
  }
  gather(
      [&](const auto& visit) {
        for (std::size_t k = 0; k < cells.size(); ++k)
          for (const Index n : cells.nodes(k)) visit(number[n], static_cast<Index>(k));
      },
      first_cell, cells_at);
  gather(
      [&](const auto& visit) {
        for (std::size_t f = 0; f < skin->size(); ++f)
          for (const Index n : (*skin)[f].facet) visit(number[n], static_cast<Index>(f));
      },
      first_facet, facets_at);
}

/// What for_each visits with a skin node, by skin node.
template <class ForEach>
void BodyOverlap::Impl::gather(const ForEach& for_each, std::vector<Index>& first, std::vector<Index>& at) const {
  first.assign(skin_nodes.size() + 1, 0);
  for_each([&](Index skin_node, Index /*item*/) {
    if (skin_node >= 0) ++first[skin_node + 1];
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  at.resize(first.back());
  std::vector<Index> next = first;
  for_each([&](Index skin_node, Index item) {
    if (skin_node >= 0) at[next[skin_node]++] = item;
  });
}

/// False for cells of the node and their neighbours.
bool BodyOverlap::Impl::may_meet(std::size_t skin_node, Index cell) const {
  const std::span<const Index> nodes = cells.nodes(static_cast<std::size_t>(cell));
  if (body[nodes[0]] != body[skin_nodes[skin_node]]) return true;
  const auto first = cells_at.begin() + first_cell[skin_node], last = cells_at.begin() + first_cell[skin_node + 1];
  return std::none_of(first, last, [&](Index own) {
    const std::span<const Index> others = cells.nodes(static_cast<std::size_t>(own));
    return std::find_first_of(nodes.begin(), nodes.end(), others.begin(), others.end()) != nodes.end();
  });
}

/// In cells; zero outside of the cell.
double BodyOverlap::Impl::depth(std::size_t skin_node, Index cell, const Vec3& x) const {
  const auto k = static_cast<std::size_t>(cell);
  if (!cells.inside(k, x)) return 0.0;
  return depth_under_skin(k, x) / std::min(reference_length(k), node_length(skin_nodes[skin_node]));
}

/// How far a point of a cell is behind the nearest facet at the cell's nodes; 0 in front of it, where curved faces of
/// the cell stand back from its corners; the cell's length where there is no facet.
double BodyOverlap::Impl::depth_under_skin(std::size_t cell, const Vec3& x) const {
  constexpr double same = 1.0 + 1e-9;
  double least = infinity, in_front = 0.0;  // sum over the nearest: two at an edge
  for (const Index n : cells.nodes(cell)) {
    if (number[n] < 0) continue;
    for (Index f = first_facet[number[n]]; f < first_facet[number[n] + 1]; ++f) {
      const Facet& facet = (*skin)[facets_at[f]].facet;
      PlacedFacet placed{{}, facet.size};
      for (int a = 0; a < facet.size; ++a) placed.x[static_cast<std::size_t>(a)] = cells.position(facet[a]);
      const Projection p = project(placed, x);
      if (p.distance > same * least) continue;
      if (same * p.distance < least) in_front = 0.0;
      in_front += p.gap;
      least = std::min(least, p.distance);
    }
  }
  if (least == infinity) return cells.length(cell);
  return in_front > 0.0 ? 0.0 : least;
}

double BodyOverlap::Impl::reference_length(std::size_t cell) const {
  Corners corner{};
  const auto n = static_cast<std::size_t>(corner_count(cells.type(cell)));
  for (std::size_t a = 0; a < n; ++a) corner[a] = model.mesh->coordinates[cells.nodes(cell)[a]];
  return cell_length(cells.type(cell), std::span(corner).first(n));
}

/// The skin nodes that are inside of a cell, increasing, each with the cell that it is deepest in.
std::vector<BodyOverlap::Impl::Inside> BodyOverlap::Impl::inside(std::span<const double> u) {
  cells.place(u);
  constexpr std::size_t grain = 64;
  std::vector<std::vector<Inside>> of_task((skin_nodes.size() + grain - 1) / grain);
  parallel_for(skin_nodes.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> near;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 x = cells.position(skin_nodes[i]);
      cells.find(x, near);
      Inside deepest;
      for (const Index cell : near) {
        if (!may_meet(i, cell)) continue;
        const double d = depth(i, cell, x);
        if (d > deepest.depth) deepest = {static_cast<Index>(i), cell, d};
      }
      if (deepest.cell >= 0) of_task[begin / grain].push_back(deepest);
    }
  });
  std::vector<Inside> all;
  for (const std::vector<Inside>& found : of_task) all.insert(all.end(), found.begin(), found.end());
  all = found_by_ranks(std::move(all));
  const auto order = [](const Inside& x) { return std::tuple(x.skin_node, -x.depth, x.cell); };
  std::sort(all.begin(), all.end(), [&](const Inside& a, const Inside& b) { return order(a) < order(b); });
  const auto is_same = [](const Inside& a, const Inside& b) { return a.skin_node == b.skin_node; };
  all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
  return all;
}

/// By node of the contact, in cells; not positive outside.
std::vector<double> BodyOverlap::Impl::obstacle_depths(std::size_t c, std::span<const double> u) const {
  std::vector<double> depths;
  const ContactParts obstacle = parts_of(model.contacts[c]);
  if (obstacle.shape == nullptr) return depths;
  std::optional<BodyPlacement> placement;
  if (obstacle.body >= 0) placement = place_body(model.turning_bodies[static_cast<std::size_t>(obstacle.body)], u);
  const std::vector<Vec3>& X = model.mesh->coordinates;
  const Index carrier = obstacle.carrier;
  const Vec3 shift = carrier < 0 ? Vec3{} : subtract(cells.position(carrier), X[carrier]);
  for (const Index n : obstacle_nodes[c]) {
    const Vec3 x = cells.position(n), seen = placement ? placement->reference(x) : subtract(x, shift);
    depths.push_back(-std::visit(GapOfShape{X, seen, 2.0 * node_length(n)}, *obstacle.shape) / node_length(n));
  }
  return depths;
}

BodyOverlap::BodyOverlap(const Model& model, std::span<const double> u) : impl_(std::make_unique<Impl>(model, u)) {}
BodyOverlap::~BodyOverlap() = default;
BodyOverlap::BodyOverlap(BodyOverlap&&) noexcept = default;

Overlap BodyOverlap::deepest(std::span<const double> u) {
  Impl& impl = *impl_;
  Overlap worst;
  const bool is_finite = std::all_of(impl.skin_nodes.begin(), impl.skin_nodes.end(), [&](Index n) {
    const Vec3 moved = vector_at(u, at(n));
    return std::isfinite(moved[0] + moved[1] + moved[2]);
  });
  if (!is_finite) return worst;
  for (const Impl::Inside& found : impl.inside(u)) {
    const double growth = found.depth - impl.at_start[at(found.skin_node)];
    if (growth <= worst.depth) continue;
    const Index n = impl.skin_nodes[at(found.skin_node)];
    worst = {growth, n, impl.cells.position(n), impl.cells.ref(at(found.cell))};
  }
  for (std::size_t c = 0; c < impl.model.contacts.size(); ++c) {
    const std::vector<double> depths = impl.obstacle_depths(c, u);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const double growth = depths[i] - std::max(0.0, impl.obstacle_at_start[c][i]);
      const Index n = impl.obstacle_nodes[c][i];
      if (growth > worst.depth) worst = {growth, n, impl.cells.position(n), {-1, -1}, static_cast<Index>(c)};
    }
  }
  return worst;
}

void BodyOverlap::each_at_start(const std::function<void(Index, double)>& visit) const {
  for (std::size_t i = 0; i < impl_->at_start.size(); ++i)
    if (impl_->at_start[i] > 0.0) visit(impl_->skin_nodes[i], impl_->at_start[i]);
}

}  // namespace carom
