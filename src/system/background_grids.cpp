#include "system/background_grids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {
namespace {

constexpr std::size_t many_corners = 10'000;  // of sheets, for a factorisation in every cycle

/// A corner of a body's grid.
struct Corner {
  Index body = 0;
  std::array<Index, 3> at{};
  friend bool operator==(const Corner&, const Corner&) = default;
};

struct HashCorner {
  std::size_t operator()(const Corner& corner) const {
    auto hash = static_cast<std::uint64_t>(corner.body);
    for (const Index i : corner.at) {
      hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

/// The corners of a grid, numbered as they are met.
class Corners {
 public:
  Index number(const Corner& corner) {
    const auto [place, is_new] = numbers_.emplace(corner, static_cast<Index>(all_.size()));
    if (is_new) all_.push_back(corner);
    return place->second;
  }
  const std::vector<Corner>& all() const { return all_; }

 private:
  std::unordered_map<Corner, Index, HashCorner> numbers_;
  std::vector<Corner> all_;
};

/// One coordinate between the corners below and above it.
struct Between {
  Index below = 0;
  double share = 0.0;  ///< of the one above
};

void add_point(const std::array<Between, 3>& at, Index body, Corners& corners, Interpolation& out) {
  std::array<Index, 8> coarse{};
  std::array<double, 8> weights{};
  std::size_t count = 0;
  for (unsigned k = 0; k < 8; ++k) {
    Corner corner{body, {}};
    double weight = 1.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const bool above = (k >> c & 1U) != 0;
      corner.at[c] = at[c].below + (above ? 1 : 0);
      weight *= above ? at[c].share : 1.0 - at[c].share;
    }
    if (weight == 0.0) continue;
    coarse[count] = corners.number(corner);
    weights[count++] = weight;
  }
  out.add_point({coarse.data(), count}, {weights.data(), count});
}

/// The body of each node: what cells connect, and a free node alone; -1: fixed nodes without cells.
std::vector<Index> bodies_of(const Solid& solid, std::span<const std::uint8_t> fixed) {
  std::vector<Index> parent(solid.node_count(), -1);
  const auto root = [&](Index n) {
    while (parent[at(n)] != n) n = parent[at(n)] = parent[at(parent[at(n)])];
    return n;
  };
  for (std::size_t k = 0; k < solid.cells().size(); ++k) {
    const auto nodes = solid.cells().nodes_of(k);
    for (const Index n : nodes) {
      if (parent[at(n)] < 0) parent[at(n)] = n;
      const Index a = root(nodes[0]), b = root(n);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  }
  constexpr std::uint8_t all_components = 7;
  std::vector<Index> body(parent.size(), -1);
  Index bodies = 0;
  for (std::size_t n = 0; n < parent.size(); ++n) {
    const auto node = static_cast<Index>(n);
    if (parent[n] < 0 ? fixed[n] != all_components : parent[n] == node)
      body[n] = bodies++;
    else if (parent[n] >= 0)
      body[n] = body[at(root(node))];
  }
  return body;
}

/// A body's grid: where it begins, how far it reaches, and the widths of its boxes.
struct Grid {
  Vec3 origin{infinity, infinity, infinity}, extent{}, width{};

  /// Doubles the widths that are the smallest ones or near; which are said. Where the body has but one box across, what
  /// is left are the boxes of a sheet: widened, they bend less and less (locking), so that this is done only if asked.
  std::array<bool, 3> widen(bool sheets) {
    constexpr double whole = 0.999, near = 1.5;
    std::array<bool, 3> doubled{};
    double least = infinity;
    for (std::size_t c = 0; c < 3; ++c)
      if (!sheets || width[c] < whole * extent[c]) least = std::min(least, width[c]);
    for (std::size_t c = 0; c < 3; ++c) {
      doubled[c] = width[c] < std::min(near * least, whole * extent[c]);
      if (doubled[c]) width[c] *= 2.0;
    }
    return doubled;
  }
};

/// The finest grid of each body. Its boxes are twice as wide as the mean cell, divided by the number of spaces between
/// the nodes of an edge.
std::vector<Grid> finest_grids(const Mesh& mesh, const Solid& solid, const std::vector<Index>& body) {
  const Index bodies = body.empty() ? 0 : *std::max_element(body.begin(), body.end()) + 1;
  std::vector<Grid> grids(at(bodies));
  std::vector<double> cells(at(bodies), 0.0);
  std::vector<Vec3> end(at(bodies), {-infinity, -infinity, -infinity});
  for (std::size_t k = 0; k < solid.cells().size(); ++k) {
    const auto nodes = solid.cells().nodes_of(k);
    const CellType type = mesh.blocks[at(solid.cells()[k].block)].type;
    const double spaces = node_count(type) > corner_count(type) ? 2.0 : 1.0;
    Grid& grid = grids[at(body[at(nodes[0])])];
    cells[at(body[at(nodes[0])])] += spaces;
    for (std::size_t c = 0; c < 3; ++c) {
      double low = infinity, high = -infinity;
      for (const Index n : nodes) {
        low = std::min(low, mesh.coordinates[at(n)][c]);
        high = std::max(high, mesh.coordinates[at(n)][c]);
      }
      grid.width[c] += high - low;
    }
  }
  for (std::size_t n = 0; n < body.size(); ++n)
    for (std::size_t c = 0; c < 3 && body[n] >= 0; ++c) {
      Grid& grid = grids[at(body[n])];
      const double x = mesh.coordinates[n][c];
      grid.origin[c] = std::min(grid.origin[c], x);
      end[at(body[n])][c] = std::max(end[at(body[n])][c], x);
    }
  for (std::size_t b = 0; b < grids.size(); ++b) {
    Grid& grid = grids[b];
    const double most = *std::max_element(grid.width.begin(), grid.width.end());
    for (double& side : grid.width) side = most > 0.0 ? (side > 0.0 ? side : most) / cells[b] : 1.0;
    grid.extent = subtract(end[b], grid.origin);
    grid.widen(mesh.node_count() > many_corners);
  }
  return grids;
}

}  // namespace

std::vector<Interpolation> background_grids(const Mesh& mesh, const Solid& solid, std::span<const std::uint8_t> fixed,
                                            std::size_t enough) {
  const std::vector<Index> body = bodies_of(solid, fixed);
  std::vector<Grid> grids = finest_grids(mesh, solid, body);
  std::vector<Interpolation> levels(1);
  Corners corners;
  for (std::size_t n = 0; n < body.size(); ++n) {
    if (body[n] < 0) {
      levels[0].add_point({}, {});
      continue;
    }
    const Grid& grid = grids[at(body[n])];
    std::array<Between, 3> place;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = (mesh.coordinates[n][c] - grid.origin[c]) / grid.width[c];
      constexpr double near = 1e-6;  // of a box: as good as on the corner
      const double below = std::floor(x + near);
      place[c] = {static_cast<Index>(below), x - below < near ? 0.0 : x - below};
    }
    add_point(place, body[n], corners, levels[0]);
  }
  levels[0].finish(corners.all().size());
  const auto coarsen = [&](bool sheets) {
    std::vector<Grid> wider = grids;
    std::vector<std::array<bool, 3>> doubled;
    for (Grid& grid : wider) doubled.push_back(grid.widen(sheets));
    Corners next;
    Interpolation level;
    for (const Corner& corner : corners.all()) {
      std::array<Between, 3> place;
      for (std::size_t c = 0; c < 3; ++c)
        place[c] = doubled[at(corner.body)][c] ? Between{corner.at[c] / 2, corner.at[c] % 2 == 0 ? 0.0 : 0.5}
                                               : Between{corner.at[c], 0.0};
      add_point(place, corner.body, next, level);
    }
    constexpr double worth = 0.8;
    if (static_cast<double>(next.all().size()) > worth * static_cast<double>(corners.all().size())) return false;
    level.finish(next.all().size());
    levels.push_back(std::move(level));
    corners = std::move(next);
    grids = std::move(wider);
    return true;
  };
  while (corners.all().size() > enough && (coarsen(false) || (corners.all().size() > many_corners && coarsen(true)))) {
  }
  return levels;
}

}  // namespace carom
