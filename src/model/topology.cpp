#include "model/topology.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "math/vec3.hpp"
#include "model/outer_facets.hpp"

namespace carom {

namespace {

std::array<Index, 4> key_of(const Facet& facet) {
  std::array<Index, 4> key = facet.node;
  std::sort(key.begin(), key.end());
  return key;
}

/// Of the facets of a surface (Surface), the mean.
double mean_measure(const Model& model, const Surface& surface) {
  double sum = 0.0;
  for (const Facet& facet : surface.facets) {
    const auto x = [&](std::size_t a) { return model.mesh->coordinates[at(facet[a])]; };
    if (facet.size == 2)
      sum += norm(subtract(x(1), x(0))) * surface.thickness;
    else if (facet.size > 2)
      sum += 0.5 * norm(cross(subtract(x(2), x(0)), subtract(x(facet.size == 3 ? 1 : 3), x(1))));
    else
      sum += surface.thickness;
  }
  return surface.facets.empty() ? 0.0 : sum / static_cast<double>(surface.facets.size());
}

/// Positions of the cells that may go.
std::vector<bool> may_go(const Model& model, std::size_t count) {
  std::vector<bool> out(count, false);
  for (const Erosion& erosion : model.erosion)
    for (const Index cell : erosion.cells) out[at(cell)] = true;
  return out;
}

}  // namespace

Topologies::Topologies(const Model& model, std::span<const CellRef> cells)
    : model_(model), outer_(outer_facets(model)), cells_(cells.begin(), cells.end()) {
  const std::vector<bool> goes = may_go(model, cells_.size());
  for (const CellBlock& block : model.mesh->blocks) position_.emplace_back(block.size(), -1);
  for (std::size_t k = 0; k < cells_.size(); ++k)
    position_[at(cells_[k].block)][at(cells_[k].cell)] = static_cast<Index>(k);
  const auto is_wanted = [&](const CellRef& cell) {
    const Index k = position_of(cell);
    return k >= 0 && goes[at(k)];
  };
  for (const SharedFace& shared : shared_faces(*model.mesh, is_wanted))
    beyond_[position_of(shared.cell)].push_back({position_of(shared.other), shared.other, shared.other_face});
  for (const OuterFacet& outer : *outer_)
    if (is_wanted(outer.cell)) owner_.emplace(key_of(outer.facet), position_of(outer.cell));
}

Index Topologies::position_of(const CellRef& cell) const {
  return position_[at(cell.block)][at(cell.cell)];
}

/// The cell that an outer facet is of, if it may go; else -1.
Index Topologies::owner_of(const Facet& facet) const {
  const auto found = owner_.find(key_of(facet));
  return found == owner_.end() ? -1 : found->second;
}

/// What the holes that these cells are of consist of, and the facets that living cells have towards them, by increasing
/// cell and face.
Topologies::Holes Topologies::holes(std::vector<Index> gone, const std::vector<std::uint8_t>& alive) const {
  Holes holes;
  holes.cells.insert(gone.begin(), gone.end());
  std::set<std::tuple<Index, int>> faces;
  while (!gone.empty()) {
    const Index cell = gone.back();
    gone.pop_back();
    const auto neighbours = beyond_.find(cell);
    if (neighbours == beyond_.end()) continue;
    for (const Beyond& beyond : neighbours->second) {
      if (beyond.cell < 0) continue;
      if (alive[at(beyond.cell)] != 0)
        faces.emplace(beyond.cell, beyond.face);
      else if (holes.cells.insert(beyond.cell).second)
        gone.push_back(beyond.cell);
    }
  }
  for (const auto& [cell, face] : faces) append_facets(*model_.mesh, cells_[at(cell)], face, holes.bare);
  return holes;
}

/// The nodes of the holes that no cell has any more, as points that stand for a mean facet of the surface each.
Surface Topologies::loose_nodes(const Surface& surface, const Holes& holes, const std::vector<bool>& is_held) const {
  Surface loose{{}, surface.section, mean_measure(model_, surface)};
  std::set<Index> nodes;
  for (const Index cell : holes.cells)
    for (const Index n : connectivity(cell))
      if (!is_held[at(n)]) nodes.insert(n);
  for (const Index n : nodes) loose.facets.push_back({{n, -1, -1, -1}, 1});
  return loose;
}

std::span<const Index> Topologies::connectivity(Index cell) const {
  const CellRef& ref = cells_[at(cell)];
  return model_.mesh->blocks[at(ref.block)].nodes(ref.cell);
}

/// Takes the facets that have gone from the surface and adds those that have been laid bare; the loose nodes.
Surface Topologies::replace(Surface& surface, const std::vector<std::uint8_t>& alive,
                            const std::vector<bool>& is_held) const {
  const Surface before = surface;
  std::vector<Index> gone;
  std::erase_if(surface.facets, [&](const Facet& facet) {
    const Index owner = owner_of(facet);
    if (owner < 0 || alive[at(owner)] != 0) return false;
    gone.push_back(owner);
    return true;
  });
  const Holes of_surface = holes(std::move(gone), alive);
  for (const OuterFacet& outer : of_surface.bare) surface.facets.push_back(outer.facet);
  return loose_nodes(before, of_surface, is_held);
}

/// Adds the nodes of the faces that holes at the nodes have laid bare.
void Topologies::replace_nodes(std::vector<Index>& nodes, const std::vector<std::uint8_t>& alive) const {
  const std::set<Index> before(nodes.begin(), nodes.end());
  std::vector<Index> gone;
  for (const auto& [key, owner] : owner_)
    if (alive[at(owner)] == 0 && std::ranges::any_of(key, [&](Index n) { return before.contains(n); }))
      gone.push_back(owner);
  std::set<Index> added;
  for (const OuterFacet& outer : holes(std::move(gone), alive).bare)
    for (const Index n : outer.facet)
      if (!before.contains(n)) added.insert(n);
  nodes.insert(nodes.end(), added.begin(), added.end());
}

std::shared_ptr<const Topology> Topologies::of(std::vector<std::uint8_t> alive) const {
  auto made = std::make_shared<Topology>(Topology{std::move(alive), model_});
  const std::vector<std::uint8_t>& is_there = made->alive;
  made->model.is_eroded = true;
  std::size_t k = 0;
  for (Part& part : made->model.parts) std::erase_if(part.cells, [&](Index) { return is_there[k++] == 0; });
  std::vector<bool> is_held(model_.mesh->node_count(), false);
  for (std::size_t cell = 0; cell < is_there.size(); ++cell)
    for (const Index n : connectivity(static_cast<Index>(cell))) is_held[at(n)] = is_held[at(n)] || is_there[cell] != 0;
  for (ContactDefinition& contact : made->model.contacts) {
    if (auto* pair = std::get_if<PairContact>(&contact)) {
      pair->loose_slave = replace(pair->slave, is_there, is_held);
      if (pair->self)
        pair->master.facets = pair->slave.facets;
      else
        pair->loose_master = replace(pair->master, is_there, is_held);
    } else if (auto* obstacle = std::get_if<ObstacleContact>(&contact)) {
      obstacle->loose = replace(obstacle->surface, is_there, is_held);
      replace_nodes(obstacle->nodes, is_there);
    }
  }
  auto outer = std::make_shared<std::vector<OuterFacet>>();
  for (const OuterFacet& facet : *outer_)
    if (const Index cell = position_of(facet.cell); cell < 0 || is_there[at(cell)] != 0) outer->push_back(facet);
  std::vector<Index> gone;
  for (std::size_t cell = 0; cell < is_there.size(); ++cell)
    if (is_there[cell] == 0) gone.push_back(static_cast<Index>(cell));
  const std::vector<OuterFacet> bare = holes(std::move(gone), is_there).bare;
  outer->insert(outer->end(), bare.begin(), bare.end());
  made->model.outer_facets = std::move(outer);
  return made;
}

}  // namespace carom
