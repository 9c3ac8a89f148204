#include "record/turning_axes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "math/principal_axes.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

/// The body that all of the nodes follow; null where there is none.
const TurningBody* body_of_all(const Model& model, std::span<const Index> nodes) {
  const Embedding::Follower* first = model.embedding.find(nodes.front());
  const bool is_one = first != nullptr && std::ranges::all_of(nodes, [&](Index n) {
                        const Embedding::Follower* other = model.embedding.find(n);
                        return other != nullptr && other->body == first->body;
                      });
  return is_one ? &model.turning_bodies[at(first->body)] : nullptr;
}

/// Sums over the nodes of cells, a node counting once for each cell: r from their middle in the mesh, x now.
struct NodeMoments {
  Columns3 rr{};  ///< sum of r r^T
  Columns3 xr{};  ///< sum of x r^T

  NodeMoments(const Simulation& s, const std::vector<Index>& cells, std::span<const double> u) {
    const std::vector<Vec3>& X = s.mesh().coordinates;
    Vec3 middle{};
    double count = 0.0;
    const auto each_node = [&](const auto& use) {
      for (const Index k : cells)
        for (const Index n : s.solid().cells().nodes_of(at(k))) use(at(n));
    };
    each_node([&](std::size_t n) {
      middle = add(middle, X[n]);
      count += 1.0;
    });
    middle = scaled(middle, 1.0 / count);
    each_node([&](std::size_t n) {
      const Vec3 r = subtract(X[n], middle), x = u.empty() ? r : add(r, vector_at(u, n));
      for (std::size_t c = 0; c < 3; ++c) {
        rr[c] = add(rr[c], scaled(r, r[c]));
        xr[c] = add(xr[c], scaled(x, r[c]));
      }
    });
  }

  PrincipalAxes shape() const { return principal_axes({rr[0][0], rr[1][1], rr[2][2]}, {rr[0][1], rr[1][2], rr[0][2]}); }
};

/// Directions in which the nodes have no extent have less of the moment than this: rounding of the coordinates.
constexpr double flat = 1e-12;

std::vector<std::size_t> extents(const PrincipalAxes& shape) {
  const double largest = *std::ranges::max_element(shape.values);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < 3; ++i)
    if (shape.values[i] > flat * largest) found.push_back(i);
  return found;
}

}  // namespace

TurningAxes::TurningAxes(const CaseProbe& given, std::span<const Index> nodes, const Simulation& simulation)
    : simulation_(&simulation), body_(body_of_all(simulation.model(), nodes)) {
  if (body_ != nullptr) return;
  const BodyCells& cells = simulation.solid().cells();
  std::vector<bool> is_member(simulation.mesh().node_count(), false);
  for (const Index n : nodes) is_member[static_cast<std::size_t>(n)] = true;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (std::ranges::any_of(cells.nodes_of(k), [&](Index n) { return is_member[static_cast<std::size_t>(n)]; }))
      cells_.push_back(static_cast<Index>(k));
  if (cells_.empty())
    throw CaseError(given.where, "probe.quantities",
                    fmt::format("\"local_acceleration\" of \"{}\", which no cell touches", *given.name),
                    "nodes of a part, or of a rigid body");
  if (extents(NodeMoments(simulation, cells_, {}).shape()).size() < 2)
    throw CaseError(given.where, "probe.quantities",
                    fmt::format("\"local_acceleration\" of \"{}\", whose cells lie on one line", *given.name),
                    "cells with an extent across, or several bars in different directions",
                    "How a bar turns about itself nobody knows: take acceleration.");
}

Columns3 TurningAxes::at(std::span<const double> u, std::span<const std::uint8_t> alive) const {
  if (body_ != nullptr) return of_body(u);
  std::vector<Index> there;
  for (const Index k : cells_)
    if (alive.empty() || alive[static_cast<std::size_t>(k)] != 0) there.push_back(k);
  return of_cells(u, there.empty() ? cells_ : there);
}

/// The sum of d_i e_i^T, made a rotation: the directors d_i vibrate a little about those of a rigid body.
Columns3 TurningAxes::of_body(std::span<const double> u) const {
  std::array<Vec3, 4> x = nodal_values(*body_, u);
  for (std::size_t a = 0; a < 4; ++a) x[a] = add(x[a], corner(*body_, a));
  const BodyFrame now = body_frame(*body_, x);
  Columns3 F{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < 3; ++i) F[c] = add(F[c], scaled(now.directors[i], body_->axes[i][c]));
  return nearest_rotation(F);
}

/// F = (sum of x r^T) (sum of r r^T)^-1, written with the principal axes of the latter.
Columns3 TurningAxes::of_cells(std::span<const double> u, const std::vector<Index>& cells) const {
  const NodeMoments moments(*simulation_, cells, u);
  const PrincipalAxes shape = moments.shape();
  const std::vector<std::size_t> wide = extents(shape);
  Columns3 stretched{};  // F times the principal axes
  for (const std::size_t i : wide) {
    for (std::size_t c = 0; c < 3; ++c)
      stretched[i] = add(stretched[i], scaled(moments.xr[c], shape.axes[i][c] / shape.values[i]));
  }
  if (wide.size() == 2) {
    const std::size_t i = 3 - wide[0] - wide[1];
    stretched[i] = normalized(cross(stretched[(i + 1) % 3], stretched[(i + 2) % 3]));
  }
  Columns3 F{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < 3; ++i) F[c] = add(F[c], scaled(stretched[i], shape.axes[i][c]));
  return nearest_rotation(F);
}

Vec3 along(const Columns3& axes, const Vec3& v) {
  return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
}

}  // namespace carom
