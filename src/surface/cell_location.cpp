#include "surface/cell_location.hpp"

#include <algorithm>
#include <cmath>

#include "element/hexa8.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_size.hpp"
#include "parallel/ranks.hpp"
#include "parallel/threads.hpp"

namespace carom {
namespace {

/// Shape functions of a linear solid and their derivatives by the parent coordinates.
struct LinearShape {
  CornerValues N{};
  std::array<Vec3, 8> dN{};
};

/// N = 1 - r - s - t, r, s, t.
LinearShape tetrahedron(const Vec3& xi) {
  return {{1.0 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]}, {{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
}

/// Triangle (r, s) times line t in [-1, 1].
LinearShape pentahedron(const Vec3& xi) {
  const std::array<double, 3> L{1.0 - xi[0] - xi[1], xi[0], xi[1]};
  constexpr std::array<std::array<double, 2>, 3> dL{{{-1, -1}, {1, 0}, {0, 1}}};
  LinearShape shape;
  for (std::size_t a = 0; a < 6; ++a) {
    const std::size_t c = a % 3;
    const double side = a < 3 ? -0.5 : 0.5, along = 0.5 + side * xi[2];
    shape.N[a] = L[c] * along;
    shape.dN[a] = {dL[c][0] * along, dL[c][1] * along, L[c] * side};
  }
  return shape;
}

LinearShape hexahedron(const Vec3& xi) {
  return {hexa8::shape(xi), hexa8::shape_gradient(xi)};
}

/// The hexahedron with its upper four nodes in one.
LinearShape pyramid(const Vec3& xi) {
  LinearShape shape = hexahedron(xi);
  for (std::size_t a = 5; a < 8; ++a) {
    shape.N[4] += shape.N[a];
    shape.dN[4] = add(shape.dN[4], shape.dN[a]);
    shape.N[a] = 0.0;
    shape.dN[a] = {};
  }
  return shape;
}

struct ParentCell {
  LinearShape (*shape)(const Vec3&);
  Vec3 centre;
};

ParentCell parent_cell(CellType linear) {
  switch (linear) {
    case CellType::tetra4:
      return {tetrahedron, {0.25, 0.25, 0.25}};
    case CellType::penta6:
      return {pentahedron, {1.0 / 3.0, 1.0 / 3.0, 0.0}};
    case CellType::pyra5:
      return {pyramid, {0.0, 0.0, -0.5}};
    default:
      return {hexahedron, {}};
  }
}

/// The linear solid of the corners, or the prism over a plane cell.
CellType solid_of(CellType type) {
  if (dimension(type) == 3) return linear_type(type);
  return corner_count(type) == 3 ? CellType::penta6 : CellType::hexa8;
}

std::size_t solid_corners(CellType type) {
  const auto corners = static_cast<std::size_t>(corner_count(type));
  return dimension(type) == 2 ? 2 * corners : corners;
}

/// x from 0 to 255 across a box that it is in; increasing, also as it is rounded.
Vec3 in_parts(const Bounds& box, const Vec3& x) {
  constexpr double parts = 255.0;
  Vec3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = box.high[i] - box.low[i];
    if (side > 0.0) out[i] = std::min(parts, parts * ((x[i] - box.low[i]) / side));
  }
  return out;
}

}  // namespace

std::optional<CornerValues> shape_at(CellType linear, const Corners& corners, const Vec3& x) {
  const ParentCell parent = parent_cell(linear);
  const auto n = static_cast<std::size_t>(node_count(linear));
  Vec3 xi = parent.centre;
  for (int i = 0; i < 20; ++i) {
    const LinearShape shape = parent.shape(xi);
    Vec3 r = x;
    std::array<Vec3, 3> J{};  // dx / dxi_k
    for (std::size_t a = 0; a < n; ++a) {
      r = subtract(r, scaled(corners[a], shape.N[a]));
      for (std::size_t k = 0; k < 3; ++k) J[k] = add(J[k], scaled(corners[a], shape.dN[a][k]));
    }
    const double det = dot(J[0], cross(J[1], J[2]));
    if (!(det > 0.0)) return std::nullopt;
    const Vec3 step{dot(r, cross(J[1], J[2])) / det, dot(r, cross(J[2], J[0])) / det, dot(r, cross(J[0], J[1])) / det};
    xi = add(xi, step);
    if (!(std::max({std::abs(xi[0]), std::abs(xi[1]), std::abs(xi[2])}) < 10.0)) return std::nullopt;
    if (norm(step) < 1e-9) return parent.shape(xi).N;
  }
  return std::nullopt;
}

PlacedCells::PlacedCells(const Model& model, std::span<const double> u, CellsOf which) : model_(&model), u_(u) {
  const Mesh& mesh = *model.mesh;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    if (dimension(part.type) < 2 || part.cells.empty()) continue;
    runs_.push_back({size_, static_cast<Index>(p), static_cast<Index>(mesh.block(part.type) - mesh.blocks.data())});
    size_ += part.cells.size();
  }
  const EntryRange own = own_share_of(mesh.node_count());
  for (std::size_t k = 0; k < size_; ++k) {
    if (which == CellsOf::rank && !own.has(at(nodes(k)[0]))) continue;
    const auto cell = static_cast<Index>(k);
    if (clusters_.empty() || at(clusters_.back().count) == cluster ||
        clusters_.back().first + clusters_.back().count != cell)
      clusters_.push_back({cell, 0, {}, {}});
    ++clusters_.back().count;
  }
  bound();
  tree_.build(leaves_);
}

void PlacedCells::place(std::span<const double> u) {
  u_ = u;
  bound();
  tree_.refit(leaves_);
}

const PlacedCells::Run& PlacedCells::run_of(std::size_t k) const {
  return *(std::upper_bound(runs_.begin(), runs_.end(), k,
                            [](std::size_t cell, const Run& run) { return cell < run.first; }) -
           1);
}

Vec3 PlacedCells::position(Index node) const {
  const auto n = static_cast<std::size_t>(node);
  const Vec3& X = model_->mesh->coordinates[n];
  return u_.empty() ? X : add(X, vector_at(u_, n));
}

void PlacedCells::bound(Placed& placed) const {
  const std::size_t first = at(placed.first), count = at(placed.count);
  std::array<Bounds, cluster> own{};
  placed.bounds = {};
  for (std::size_t k = 0; k < count; ++k) {
    const Corners corner = corners(first + k);
    for (std::size_t a = 0; a < solid_corners(type(first + k)); ++a) own[k].include(corner[a]);
    placed.bounds.include(own[k]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 low = in_parts(placed.bounds, own[k].low), high = in_parts(placed.bounds, own[k].high);
    for (std::size_t i = 0; i < 3; ++i) {
      placed.boxes[k].low[i] = static_cast<std::uint8_t>(std::floor(low[i]));
      placed.boxes[k].high[i] = static_cast<std::uint8_t>(std::ceil(high[i]));
    }
  }
}

void PlacedCells::bound() {
  constexpr std::size_t grain = 64;
  leaves_.resize(clusters_.size());
  parallel_for(clusters_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      bound(clusters_[c]);
      leaves_[c] = clusters_[c].bounds;
    }
  });
}

void PlacedCells::find(const Vec3& x, std::vector<Index>& found) const {
  Bounds point;
  point.include(x);
  found.clear();
  tree_.find(point, found);
  const std::vector<Index> clusters = found;
  found.clear();
  for (const Index c : clusters) {
    const Placed& placed = clusters_[at(c)];
    const std::size_t first = at(placed.first);
    const Vec3 in_cluster = in_parts(placed.bounds, x);
    for (std::size_t k = first; k < first + at(placed.count); ++k) {
      const Box& box = placed.boxes[k - first];
      bool is_in = true;
      for (std::size_t i = 0; i < 3; ++i) is_in = is_in && box.low[i] <= in_cluster[i] && in_cluster[i] <= box.high[i];
      if (is_in) found.push_back(static_cast<Index>(k));
    }
  }
  std::sort(found.begin(), found.end());
}

Corners PlacedCells::corners(std::size_t k) const {
  const std::span<const Index> own = nodes(k);
  const auto n = static_cast<std::size_t>(corner_count(type(k)));
  const std::size_t all = solid_corners(type(k));
  Corners corner{};
  for (std::size_t a = 0; a < all; ++a) corner[a] = position(own[a % n]);
  if (all > n) {
    const double half = 0.5 * norm(subtract(corner[2], corner[0]));
    for (std::size_t a = 0; a < all; ++a) corner[a][2] += a < n ? -half : half;
  }
  return corner;
}

double PlacedCells::length(std::size_t k) const {
  const Corners corner = corners(k);
  return cell_length(type(k), std::span(corner).first(static_cast<std::size_t>(corner_count(type(k)))));
}

std::optional<CornerValues> PlacedCells::inside(std::size_t k, const Vec3& x, double margin) const {
  std::optional<CornerValues> N = shape_at(solid_of(type(k)), corners(k), x);
  if (!N) return std::nullopt;
  if (dimension(type(k)) == 2) {
    const auto n = static_cast<std::size_t>(corner_count(type(k)));
    double lower = 0.0;
    for (std::size_t a = 0; a < n; ++a) {
      lower += (*N)[a];
      (*N)[a] += (*N)[a + n];
    }
    if (lower <= margin || 1.0 - lower <= margin) return std::nullopt;
  }
  for (std::size_t face = 0; face < cell_faces(type(k)).size(); ++face)
    if (!(depth_under(k, face, *N) > margin)) return std::nullopt;
  return N;
}

double PlacedCells::depth_under(std::size_t k, std::size_t face, const CornerValues& N) const {
  double on_face = 0.0;
  for (const LocalNode a : cell_faces(type(k))[face].corners()) on_face += N[a];
  return 1.0 - on_face;
}

std::vector<Vec3> current_positions(const Mesh& mesh, std::span<const double> u) {
  std::vector<Vec3> x = mesh.coordinates;
  for (std::size_t n = 0; n < x.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) x[n][c] += u[3 * n + c];
  return x;
}

}  // namespace carom
