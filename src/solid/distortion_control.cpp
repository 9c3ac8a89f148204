#include "solid/distortion_control.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "base/types.hpp"

namespace carom {

namespace {

using Edges = std::array<Vec3, 3>;

/// The edges of a corner whose ends can move.
std::size_t moving(const CornerFrame& frame) {
  return frame.c == frame.corner ? 2 : 3;
}
std::array<LocalNode, 3> ends(const CornerFrame& frame) {
  return {frame.a, frame.b, frame.c};
}

/// A corner that resists, with what it has of its cell.
struct FlatCorner {
  const CornerFrame& frame;
  std::span<const Index> nodes;
  Edges edge;      ///< now
  Edges slope;     ///< dJ by each edge
  double inverse;  ///< of the volume at rest
  double scale;    ///< of w
  CornerEnergy w;

  /// The change of the forces on the ends for a change of the edges.
  Edges force_change(const Edges& d) const {
    double dJ = 0.0;
    for (std::size_t e = 0; e < moving(frame); ++e) dJ += dot(slope[e], d[e]);
    Edges change;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t f = (e + 1) % 3, g = (e + 2) % 3;
      const Vec3 turned = add(cross(d[f], edge[g]), cross(edge[f], d[g]));
      change[e] = add(scaled(slope[e], scale * w.stiffness * dJ), scaled(turned, scale * w.slope * inverse));
    }
    return change;
  }
  /// Adds to a dof vector forces on the ends, and what keeps them in balance on the corner.
  void scatter(const Edges& on_ends, std::span<double> f) const {
    for (std::size_t e = 0; e < moving(frame); ++e)
      for (std::size_t i = 0; i < 3; ++i) {
        f[3 * at(nodes[ends(frame)[e]]) + i] += on_ends[e][i];
        f[3 * at(nodes[frame.corner]) + i] -= on_ends[e][i];
      }
  }
};

}  // namespace

CornerEnergy::CornerEnergy(double J, double limit) {
  const double from = 0.1 * limit, at = J < from ? from : J, beyond = J - at;
  stiffness = limit / (at * at);
  slope = 1.0 - limit / at + stiffness * beyond;
  energy = limit * std::log(limit / at) - (limit - at) + beyond * (1.0 - limit / at + 0.5 * stiffness * beyond);
}

DistortionControl::DistortionControl(std::shared_ptr<const Mesh> mesh, CellType type, std::vector<Index> of_cells,
                                     std::span<const double> volumes, double limit, double modulus)
    : mesh_(std::move(mesh)), corners_(cell_corners(type)), nodes_(std::move(of_cells)), limit_(limit) {
  for (const double volume : volumes) scale_.push_back(volume / static_cast<double>(corners_.size()) * modulus);
  for (std::size_t cell = 0; cell < volumes.size(); ++cell) {
    const std::span<const Index> nodes = nodes_of(cell);
    for (const CornerFrame& frame : corners_) {
      const CornerEdges rest(frame, [&](std::size_t a) { return mesh_->coordinates[at(nodes[a])]; });
      inverse_.push_back(rest.has_volume() ? 1.0 / rest.volume() : 0.0);
    }
  }
}

/// Calls visit(corner) for those below the limit.
template <class Visit>
void DistortionControl::for_each_flat_corner(std::size_t cell, std::span<const double> u, const Visit& visit) const {
  const std::span<const Index> nodes = nodes_of(cell);
  std::array<Vec3, 8> x;
  for (std::size_t a = 0; a < x.size() && a < nodes.size(); ++a)
    x[a] = add(mesh_->coordinates[at(nodes[a])], vector_at(u, at(nodes[a])));
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const CornerFrame& frame = corners_[k];
    const CornerEdges edges(frame, [&x](std::size_t a) { return x[a]; });
    const double inverse = inverse_[corners_.size() * cell + k], J = inverse * edges.volume();
    if (inverse == 0.0 || !(J < limit_)) continue;
    const auto& [a, b, c] = edges.edge;
    const Edges slope{scaled(cross(b, c), inverse), scaled(cross(c, a), inverse), scaled(cross(a, b), inverse)};
    visit(FlatCorner{frame, nodes, edges.edge, slope, inverse, scale_[cell], CornerEnergy(J, limit_)});
  }
}

double DistortionControl::add_force(std::size_t cell, std::span<const double> u, std::span<double> f) const {
  double energy = 0.0;
  for_each_flat_corner(cell, u, [&](const FlatCorner& corner) {
    Edges on_ends = corner.slope;
    for (Vec3& force : on_ends) force = scaled(force, corner.scale * corner.w.slope);
    corner.scatter(on_ends, f);
    energy += corner.scale * corner.w.energy;
  });
  return energy;
}

void DistortionControl::add_tangent_action(std::size_t cell, std::span<const double> u, std::span<const double> x,
                                           std::span<double> y) const {
  for_each_flat_corner(cell, u, [&](const FlatCorner& corner) {
    Edges change{};
    for (std::size_t e = 0; e < moving(corner.frame); ++e)
      change[e] = subtract(vector_at(x, at(corner.nodes[ends(corner.frame)[e]])),
                           vector_at(x, at(corner.nodes[corner.frame.corner])));
    corner.scatter(corner.force_change(change), y);
  });
}

bool DistortionControl::add_stiffness(std::size_t cell, std::span<const double> u, std::span<double> K) const {
  bool resists = false;
  for_each_flat_corner(cell, u, [&](const FlatCorner& corner) {
    resists = true;
    const std::size_t dofs = 3 * corner.nodes.size();
    const auto add = [&](std::size_t a, std::size_t i, std::size_t column, double value) {
      K[(3 * a + i) * dofs + column] += value;
    };
    for (std::size_t of = 0; of < moving(corner.frame); ++of)
      for (std::size_t j = 0; j < 3; ++j) {
        Edges unit{};
        unit[of][j] = 1.0;
        const Edges change = corner.force_change(unit);
        const std::size_t end = 3 * std::size_t{ends(corner.frame)[of]} + j,
                          base = 3 * std::size_t{corner.frame.corner} + j;
        for (std::size_t e = 0; e < moving(corner.frame); ++e)
          for (std::size_t i = 0; i < 3; ++i) {
            add(ends(corner.frame)[e], i, end, change[e][i]);
            add(ends(corner.frame)[e], i, base, -change[e][i]);
            add(corner.frame.corner, i, end, -change[e][i]);
            add(corner.frame.corner, i, base, change[e][i]);
          }
      }
  });
  return resists;
}

double DistortionControl::frequency_bound(std::size_t cell, std::span<const double> u,
                                          std::span<const double> mass) const {
  const std::size_t dofs = 3 * mass.size();
  std::vector<double> K(dofs * dofs, 0.0);
  if (!add_stiffness(cell, u, K)) return 0.0;
  double square = 0.0;
  for (std::size_t r = 0; r < dofs; ++r)
    for (std::size_t s = 0; s < dofs; ++s) square += K[r * dofs + s] * K[r * dofs + s] / (mass[r / 3] * mass[s / 3]);
  return std::sqrt(square);
}

}  // namespace carom
