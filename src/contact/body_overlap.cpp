#include "contact/body_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>

#include "base/types.hpp"
#include "contact/cell_location.hpp"
#include "contact/facet_geometry.hpp"
#include "contact/facet_projection.hpp"
#include "contact/rigid_shapes.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_size.hpp"
#include "model/bodies.hpp"
#include "model/node_lengths.hpp"
#include "model/outer_facets.hpp"
#include "parallel/threads.hpp"

namespace carom {
namespace {

constexpr std::size_t most_faces = 6;  ///< of a cell

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
  PlacedCells cells;                                   ///< where they were looked at last
  std::vector<std::uint8_t> on_skin;                   ///< by cell: which of its faces, a bit each
  std::shared_ptr<const std::vector<double>> lengths;  ///< node_lengths
  std::vector<Index> skin_nodes;                       ///< increasing
  std::vector<bool> is_skin;                           ///< by node
  std::vector<Index> first_cell, cells_at;             ///< by skin node (position in skin_nodes): rows of its cells
  std::vector<Index> body;                             ///< by node: the same for nodes of one connected body
  std::vector<double> at_start;                        ///< by skin node: depth in cells
  std::vector<std::vector<double>> obstacle_at_start;  ///< by contact and node of it
  std::vector<std::vector<Index>> obstacle_nodes;      ///< by contact

  Impl(const Model& of, std::span<const double> u);
  void find_skin();
  void find_cells_at_skin();
  double node_length(Index n) const { return (*lengths)[static_cast<std::size_t>(n)]; }
  double reference_length(std::size_t cell) const;
  bool may_meet(std::size_t skin_node, Index cell) const;
  double depth(std::size_t skin_node, Index cell, const Vec3& x) const;
  std::vector<Overlap> depths(std::span<const double> u);
  std::vector<double> obstacle_depths(std::size_t c, std::span<const double> u) const;  ///< after depths
};

BodyOverlap::Impl::Impl(const Model& of, std::span<const double> u)
    : model(of), cells(of, {}), lengths(node_lengths(of)), body(bodies_of_nodes(of)) {
  find_skin();
  find_cells_at_skin();
  for (const Overlap& overlap : depths(u)) at_start.push_back(overlap.depth);
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

/// The faces of cells that the skin of the mesh consists of.
void BodyOverlap::Impl::find_skin() {
  is_skin.assign(model.mesh->node_count(), false);
  on_skin.assign(cells.size(), 0);
  std::vector<std::vector<Index>> number;  // by block and cell
  for (const CellBlock& block : model.mesh->blocks) number.emplace_back(block.size(), -1);
  for (std::size_t k = 0; k < cells.size(); ++k) number[cells.ref(k).block][cells.ref(k).cell] = static_cast<Index>(k);
  const auto skin = outer_facets(model);
  for (const OuterFacet& outer : *skin) {
    const Index k = number[outer.cell.block][outer.cell.cell];
    if (k < 0) continue;
    on_skin[k] = static_cast<std::uint8_t>(on_skin[k] | 1U << static_cast<unsigned>(outer.face));
    for (const Index n : outer.facet) is_skin[n] = true;
  }
}

void BodyOverlap::Impl::find_cells_at_skin() {
  std::vector<Index> position(is_skin.size(), -1);
  for (std::size_t n = 0; n < is_skin.size(); ++n) {
    if (!is_skin[n]) continue;
    position[n] = static_cast<Index>(skin_nodes.size());
    skin_nodes.push_back(static_cast<Index>(n));
  }
  first_cell.assign(skin_nodes.size() + 1, 0);
  const auto for_each = [&](const auto& visit) {
    for (std::size_t k = 0; k < cells.size(); ++k)
      for (const Index n : cells.nodes(k))
        if (position[n] >= 0) visit(position[n], static_cast<Index>(k));
  };
  for_each([&](Index skin_node, Index /*cell*/) { ++first_cell[skin_node + 1]; });
  std::partial_sum(first_cell.begin(), first_cell.end(), first_cell.begin());
  cells_at.resize(first_cell.back());
  std::vector<Index> next = first_cell;
  for_each([&](Index skin_node, Index k) { cells_at[next[skin_node]++] = k; });
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
  const std::optional<CornerValues> N = cells.inside(k, x);
  if (!N) return 0.0;
  double share = infinity;
  for (std::size_t face = 0; face < most_faces; ++face)
    if ((on_skin[k] >> face & 1U) != 0) share = std::min(share, cells.depth_under(k, face, *N));
  if (share == infinity) {
    share = 0.0;
    const std::span<const Index> nodes = cells.nodes(k);
    for (std::size_t a = 0; a < static_cast<std::size_t>(corner_count(cells.type(k))); ++a)
      if (!is_skin[nodes[a]]) share += (*N)[a];
  }
  return share * cells.length(k) / std::min(reference_length(k), node_length(skin_nodes[skin_node]));
}

double BodyOverlap::Impl::reference_length(std::size_t cell) const {
  Corners corner{};
  const auto n = static_cast<std::size_t>(corner_count(cells.type(cell)));
  for (std::size_t a = 0; a < n; ++a) corner[a] = model.mesh->coordinates[cells.nodes(cell)[a]];
  return cell_length(cells.type(cell), std::span(corner).first(n));
}

/// One entry per skin node: its deepest cell.
std::vector<Overlap> BodyOverlap::Impl::depths(std::span<const double> u) {
  cells.place(u);
  std::vector<Overlap> found(skin_nodes.size());
  constexpr std::size_t grain = 64;
  parallel_for(skin_nodes.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> near;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 x = cells.position(skin_nodes[i]);
      cells.find(x, near);
      for (const Index cell : near) {
        if (!may_meet(i, cell)) continue;
        const double d = depth(i, cell, x);
        if (d > found[i].depth) found[i] = {d, skin_nodes[i], x, cells.ref(static_cast<std::size_t>(cell))};
      }
    }
  });
  return found;
}

/// By node of the contact, in cells; not positive outside.
std::vector<double> BodyOverlap::Impl::obstacle_depths(std::size_t c, std::span<const double> u) const {
  std::vector<double> depths;
  const ContactParts obstacle = parts_of(model.contacts[c]);
  if (obstacle.shape == nullptr) return depths;
  std::optional<BodyPlacement> placement;
  if (obstacle.body >= 0) {
    const TurningBody& turning = model.turning_bodies[static_cast<std::size_t>(obstacle.body)];
    placement.emplace(turning, body_frame(turning, nodal_values(turning, current_positions(*model.mesh, u))));
  }
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
  const bool is_finite = std::all_of(u.begin(), u.end(), [](double value) { return std::isfinite(value); });
  if (!is_finite) return worst;
  const std::vector<Overlap> now = impl.depths(u);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double growth = now[i].depth - impl.at_start[i];
    if (growth <= worst.depth) continue;
    worst = now[i];
    worst.depth = growth;
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

Index BodyOverlap::part_of(Index node) const {
  const std::vector<Part>& parts = impl_->model.parts;
  const auto has_node = [&](const Part& part) {
    return std::any_of(part.cells.begin(), part.cells.end(), [&](Index cell) {
      const std::span<const Index> nodes = impl_->model.mesh->block(part.type)->nodes(cell);
      return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
    });
  };
  const auto found = std::find_if(parts.begin(), parts.end(), has_node);
  return found == parts.end() ? -1 : static_cast<Index>(found - parts.begin());
}

Index BodyOverlap::part_of(const CellRef& cell) const {
  const PlacedCells& cells = impl_->cells;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (cells.ref(k) == cell) return cells.part(k);
  return -1;
}

}  // namespace carom
