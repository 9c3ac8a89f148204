#include "surface/feature_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

#include "math/vec3.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {
namespace {

constexpr double goes_straight = 1.0 - 5e-7;             // cosine of 1e-3 between segments
constexpr double passing = 0.1, ending = 0.02;           // EdgeEnd::width
constexpr double warped = 0.5 * std::numbers::pi / 180;  // turn of the halves of a quadrilateral

/// A side of a facet.
struct FacetSide {
  Index low, high;  ///< its nodes
  Facet facet;
  bool is_forward;  ///< the facet has them in this order
  bool is_own;      ///< of the surface
};

std::array<Index, 4> sorted_nodes(const Facet& facet) {
  std::array<Index, 4> nodes = facet.node;
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

void add_sides(std::span<const Facet> facets, bool is_own, std::vector<FacetSide>& sides) {
  for (const Facet& facet : facets) {
    const auto n = static_cast<std::size_t>(facet.size);
    for (std::size_t k = 0; n > 2 && k < n; ++k) {
      const Index a = facet[k], b = facet[(k + 1) % n];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), facet, a < b, is_own});
    }
  }
}

/// Sides of the surface and of what is beside it, those of one edge together.
std::vector<FacetSide> sides_by_edge(std::span<const Facet> surface, std::span<const Facet> beside) {
  std::vector<FacetSide> sides;
  add_sides(surface, true, sides);
  if (!beside.empty()) {
    add_sides(facets_beside(surface, beside), false, sides);
  }
  std::stable_sort(sides.begin(), sides.end(), [](const FacetSide& a, const FacetSide& b) {
    return std::tie(a.low, a.high) < std::tie(b.low, b.high);
  });
  return sides;
}

/// Calls f with the sides of each edge.
template <class F>
void for_each_edge(std::span<const FacetSide> sides, const F& f) {
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    f(sides.subspan(begin, end - begin));
  }
}

Vec3 normal_of(const Facet& facet, std::span<const Vec3> X) {
  const ParentPoint centre = facet_centre(facet.size);
  return facet_frame(place(facet, X), centre.xi, centre.eta).normal;
}

Vec3 mean_of(const Facet& facet, std::span<const Vec3> X) {
  Vec3 sum{};
  for (const Index n : facet) sum = add(sum, X[n]);
  return scaled(sum, 1.0 / facet.size);
}

/// The edge from node a to node b, which the first facet has in this order and the second in the other.
FeatureEdge edge_between(Index a, Index b, const Facet& first, const Facet& second, std::span<const Vec3> X) {
  const Vec3 n = normal_of(first, X), m = normal_of(second, X);
  const bool sticks_out = dot(n, subtract(mean_of(second, X), X[a])) < 0.0;
  const double turn = std::atan2(norm(cross(n, m)), dot(n, m));
  const double measure = carom::measure(place(first, X)) / first.size + carom::measure(place(second, X)) / second.size;
  return {{a, b}, {first, second}, sticks_out ? turn : -turn, measure, {}, false, false};
}

std::optional<FeatureEdge> edge_of(std::span<const FacetSide> sides, std::span<const Vec3> X) {
  if (sides.size() != 2 || sides[0].is_forward == sides[1].is_forward) return std::nullopt;
  if (!sides[0].is_own && !sides[1].is_own) return std::nullopt;
  const std::size_t first = sides[0].is_forward ? 0 : 1;
  return edge_between(sides[0].low, sides[0].high, sides[first].facet, sides[1 - first].facet, X);
}

/// The diagonal from a corner of a quadrilateral.
FeatureEdge diagonal(const Facet& facet, std::size_t corner, std::span<const Vec3> X) {
  const Index a = facet[corner], b = facet[corner + 1], c = facet[corner + 2], d = facet[(corner + 3) % 4];
  const Facet ahead{{a, c, d, -1}, 3}, back{{c, a, b, -1}, 3};
  return a < c ? edge_between(a, c, ahead, back, X) : edge_between(c, a, back, ahead, X);
}

bool has_diagonals(const Facet& facet) {
  return facet.size == 4 && facet[0] != facet[1] && facet[1] != facet[2] && facet[2] != facet[3] &&
         facet[3] != facet[0];
}

/// The diagonal of a quadrilateral that sticks out; nothing where it is flat.
std::optional<FeatureEdge> diagonal_of(const Facet& facet, std::span<const Vec3> X) {
  for (std::size_t corner = 0; corner < 2 && has_diagonals(facet); ++corner) {
    const FeatureEdge edge = diagonal(facet, corner, X);
    if (edge.turn > warped) return edge;
  }
  return std::nullopt;
}

/// Direction of edge e away from its end.
Vec3 leaving(const FeatureEdge& edge, std::size_t end, std::span<const Vec3> X) {
  return direction(subtract(X[edge.node[1 - end]], X[edge.node[end]]));
}

double length_of(const FeatureEdge& edge, std::span<const Vec3> X) {
  return norm(subtract(X[edge.node[1]], X[edge.node[0]]));
}

void find_ends(std::vector<FeatureEdge>& edges, std::span<const Vec3> X) {
  std::map<Index, std::vector<std::pair<std::size_t, std::size_t>>> at;  // edges at a node, with their end there
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (std::size_t end = 0; end < 2; ++end) at[edges[e].node[end]].emplace_back(e, end);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (std::size_t end = 0; end < 2; ++end) {
      const Vec3 arriving = scaled(leaving(edges[e], end, X), -1.0);
      int found = 0;
      double shorter = length_of(edges[e], X);
      for (const auto& [other, there] : at[edges[e].node[end]]) {
        if (other == e || !(dot(leaving(edges[other], there, X), arriving) > goes_straight)) continue;
        ++found;
        shorter = std::min(shorter, length_of(edges[other], X));
      }
      edges[e].end[end].goes_on = found == 1;
      edges[e].end[end].width = found == 1 ? passing * shorter / length_of(edges[e], X) : ending;
    }
  }
}

}  // namespace

std::vector<Facet> facets_beside(std::span<const Facet> surface, std::span<const Facet> skin) {
  std::set<std::array<Index, 4>> own;
  for (const Facet& facet : surface) own.insert(sorted_nodes(facet));
  std::vector<Facet> others;
  std::copy_if(skin.begin(), skin.end(), std::back_inserter(others),
               [&](const Facet& facet) { return !own.contains(sorted_nodes(facet)); });
  return others;
}

std::vector<FeatureEdge> feature_edges(std::span<const Vec3> X, std::span<const Facet> surface,
                                       std::span<const Facet> beside, double least_turn) {
  std::vector<FeatureEdge> edges;
  const auto add = [&](const std::optional<FeatureEdge>& edge) {
    if (edge && edge->turn > least_turn) edges.push_back(*edge);
  };
  for_each_edge(sides_by_edge(surface, beside), [&](std::span<const FacetSide> sides) { add(edge_of(sides, X)); });
  for (const Facet& facet : surface)
    if (facet.size == 4) add(diagonal_of(facet, X));
  std::ranges::stable_sort(edges, {}, &FeatureEdge::node);
  find_ends(edges, X);
  return edges;
}

std::vector<FeatureEdge> fold_edges(std::span<const Vec3> X, std::span<const Facet> surface) {
  std::vector<FeatureEdge> edges;
  for (const Facet& facet : surface) {
    if (!has_diagonals(facet) || diagonal_of(facet, X)) continue;
    for (std::size_t corner = 0; corner < 2; ++corner) {
      edges.push_back(diagonal(facet, corner, X));
      edges.back().end = {EdgeEnd{false, ending}, EdgeEnd{false, ending}};
      edges.back().is_fold = true;
    }
  }
  std::ranges::stable_sort(edges, {}, &FeatureEdge::node);
  return edges;
}

bool has_open_edges(std::span<const Facet> surface) {
  bool is_open = false;
  for_each_edge(sides_by_edge(surface, {}), [&](std::span<const FacetSide> sides) {
    if (sides.size() == 1) is_open = true;
  });
  return is_open;
}

}  // namespace carom
