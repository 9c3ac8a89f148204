#include "surface/surface_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {
namespace {

constexpr std::size_t piece_grain = 64;
constexpr double along_facet = 1e-6;  // sin^2 of an angle

bool share_a_node(std::span<const Index> a, std::span<const Index> b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

/// How far the way between two piercings is from the line in which the planes that are pierced meet; infinite where
/// they are parallel, or the way is to that line.
double to_ridge(const Piercing& one, const Piercing& two) {
  const double c = dot(one.normal, two.normal), sin_squared = 1.0 - c * c;
  const Vec3 way = subtract(two.position, one.position), out = cross(way, cross(one.normal, two.normal));
  if (!(sin_squared > along_facet) || !(dot(out, out) > along_facet * sin_squared * dot(way, way))) return infinity;
  // The point p - p_1 = w (n_2 - c n_1) of that line, n_2 . (p - p_2) = 0.
  const double w = dot(two.normal, way) / sin_squared;
  return std::abs(w * dot(subtract(two.normal, scaled(one.normal, c)), out)) / norm(out);
}

}  // namespace

SurfaceCrossings::SurfaceCrossings(const Model& model, std::span<const double> u)
    : model_(model), skin_(model), number_(model.mesh->node_count(), -1), start_(skin_.nodes.size(), 0.0) {
  for (std::size_t k = 0; k < skin_.nodes.size(); ++k)
    number_[static_cast<std::size_t>(skin_.nodes[k])] = static_cast<Index>(k);
  for (const Found& found : find(u, Folds::seen)) {
    const auto raise = [&](Index n) {
      double& depth = start_[static_cast<std::size_t>(n)];
      depth = std::max(depth, found.depth);
    };
    for (const Index n : skin_.edges[static_cast<std::size_t>(found.edge)].node) raise(n);
    for (const Index n : skin_.pieces[static_cast<std::size_t>(found.piece)].facet) raise(n);
  }
}

void SurfaceCrossings::add_start(Index node, double depth) {
  const Index n = number_[static_cast<std::size_t>(node)];
  if (n >= 0) start_[static_cast<std::size_t>(n)] = std::max(start_[static_cast<std::size_t>(n)], depth);
}

double SurfaceCrossings::at_start(const Found& found) const {
  double depth = 0.0;
  const auto raise = [&](Index n) { depth = std::max(depth, start_[static_cast<std::size_t>(n)]); };
  for (const Index n : skin_.edges[static_cast<std::size_t>(found.edge)].node) raise(n);
  for (const Index n : skin_.pieces[static_cast<std::size_t>(found.piece)].facet) raise(n);
  return depth;
}

SurfaceCrossing SurfaceCrossings::deepest(std::span<const double> u, Folds folds) {
  SurfaceCrossing worst;
  const Found* of = nullptr;
  const std::vector<Found> all = find(u, folds);
  for (const Found& found : all) {
    const double growth = found.depth - at_start(found);
    const bool is_first =
        of != nullptr && growth == worst.depth && std::tie(found.edge, found.piece) < std::tie(of->edge, of->piece);
    if (growth < worst.depth || growth <= 0.0 || (growth == worst.depth && !is_first)) continue;
    worst.depth = growth;
    of = &found;
  }
  if (of == nullptr) return worst;
  const Index side = skin_.edges[static_cast<std::size_t>(of->edge)].piece[0];
  worst.position = of->piercing.position;
  worst.edge_cell = skin_.pieces[static_cast<std::size_t>(side)].cell;
  worst.cell = skin_.pieces[static_cast<std::size_t>(of->piece)].cell;
  return worst;
}

/// Positions and the boxes of the bodies; false where some are not finite.
bool SurfaceCrossings::place(std::span<const double> u) {
  x_.resize(skin_.nodes.size());
  parallel_each(x_.size(), [&](std::size_t k) {
    const auto n = static_cast<std::size_t>(skin_.nodes[k]);
    x_[k] = add(model_.mesh->coordinates[n], vector_at(u, n));
  });
  body_box_.assign(skin_.body_count(), {});
  bool is_finite = true;
  for (std::size_t b = 0; b < body_box_.size(); ++b) {
    for (auto k = static_cast<std::size_t>(skin_.first_node_of_body[b]);
         k < static_cast<std::size_t>(skin_.first_node_of_body[b + 1]); ++k) {
      body_box_[b].include(x_[k]);
      is_finite = is_finite && std::isfinite(x_[k][0] + x_[k][1] + x_[k][2]);
    }
  }
  return is_finite;
}

/// The pieces that reach into the box of another body, or all.
void SurfaceCrossings::choose(Folds folds) {
  chosen_.clear();
  chosen_box_.clear();
  BoxTree bodies;
  bodies.build(body_box_);
  std::vector<Index> near;
  for (std::size_t b = 0; b < body_box_.size(); ++b) {
    near.clear();
    bodies.find(body_box_[b], near);
    std::erase(near, static_cast<Index>(b));
    if (near.empty() && folds == Folds::left_out) continue;
    for (Index p = skin_.first_piece_of_body[b]; p < skin_.first_piece_of_body[b + 1]; ++p) {
      Bounds box;
      for (const Index n : skin_.pieces[static_cast<std::size_t>(p)].facet)
        box.include(x_[static_cast<std::size_t>(n)]);
      const auto reaches = [&](Index other) { return body_box_[static_cast<std::size_t>(other)].overlaps(box); };
      if (folds == Folds::left_out && std::none_of(near.begin(), near.end(), reaches)) continue;
      chosen_.push_back(p);
      chosen_box_.push_back(box);
    }
  }
}

/// All crossings, in an order that does not depend on threads.
std::vector<SurfaceCrossings::Found> SurfaceCrossings::find(std::span<const double> u, Folds folds) {
  if (!place(u)) return {};
  choose(folds);
  tree_.build(chosen_box_);
  std::vector<std::vector<Found>> parts((chosen_.size() + piece_grain - 1) / piece_grain);
  parallel_for(chosen_.size(), piece_grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> near;
    for (std::size_t i = begin; i < end; ++i) {
      near.clear();
      tree_.find(chosen_box_[i], near);
      for (const Index j : near)
        meet(chosen_[i], chosen_[static_cast<std::size_t>(j)], folds, parts[begin / piece_grain]);
    }
  });
  std::vector<Found> all;
  for (const std::vector<Found>& part : parts) all.insert(all.end(), part.begin(), part.end());
  join_ways(all);
  return all;
}

/// An edge that goes into a body once and out of it once is as deep as the least that undoes one of the two ways.
void SurfaceCrossings::join_ways(std::vector<Found>& all) const {
  const auto key = [&](const Found* x) {
    return std::pair(x->edge, skin_.pieces[static_cast<std::size_t>(x->piece)].body);
  };
  std::vector<Found*> by_edge;
  for (Found& found : all) by_edge.push_back(&found);
  std::ranges::stable_sort(by_edge, {}, key);
  for (std::size_t begin = 0, end = 0; begin < by_edge.size(); begin = end) {
    while (end < by_edge.size() && key(by_edge[end]) == key(by_edge[begin])) ++end;
    if (end != begin + 2) continue;
    Found &one = *by_edge[begin], &two = *by_edge[begin + 1];
    if (one.piercing.below == two.piercing.below) continue;
    const double least =
        std::min(std::min(one.depth * one.length, two.depth * two.length), to_ridge(one.piercing, two.piercing));
    one.depth = least / one.length;
    two.depth = least / two.length;
  }
}

/// Edges of one piece that go through another one; each edge is looked at by the first of its pieces.
void SurfaceCrossings::meet(Index mine, Index other, Folds folds, std::vector<Found>& found) const {
  const SkinPieces::Piece &own = skin_.pieces[static_cast<std::size_t>(mine)],
                          &pierced = skin_.pieces[static_cast<std::size_t>(other)];
  const bool is_same_body = own.body == pierced.body;
  if (pierced.is_line || (is_same_body && folds == Folds::left_out)) return;
  if (is_same_body && share_a_node({own.facet.begin(), own.facet.end()}, {pierced.facet.begin(), pierced.facet.end()}))
    return;
  for (const Index e : own.edge) {
    if (e < 0) continue;
    const SkinPieces::Edge& edge = skin_.edges[static_cast<std::size_t>(e)];
    if (edge.piece[0] != mine) continue;
    const std::optional<Piercing> piercing = pierce(skin_, x_, e, other);
    if (!piercing || (is_same_body && are_neighbours(e, other))) continue;
    double length = std::min(own.length, pierced.length);
    if (edge.piece[1] >= 0) length = std::min(length, skin_.pieces[static_cast<std::size_t>(edge.piece[1])].length);
    const double depth = CrossingDepth(skin_, x_)(*piercing, e, other);
    if (depth > 0.0) found.push_back({depth / length, e, other, length, *piercing});
  }
}

/// True where a cell at the edge shares a node with the cell of the piece.
bool SurfaceCrossings::are_neighbours(Index edge, Index piece) const {
  const auto nodes = [&](const SkinPieces::Piece& p) {
    return model_.mesh->blocks[static_cast<std::size_t>(p.cell.block)].nodes(p.cell.cell);
  };
  const std::span<const Index> own = nodes(skin_.pieces[static_cast<std::size_t>(piece)]);
  for (const Index n : skin_.edges[static_cast<std::size_t>(edge)].node)
    for (const Index p : skin_.at(n))
      if (share_a_node(own, nodes(skin_.pieces[static_cast<std::size_t>(p)]))) return true;
  return false;
}

}  // namespace carom
