#include "mesh/orientation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {

namespace {

/// Triple products at the corners: the extremes, and how many are clearly positive or negative.
struct CornerJacobians {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  std::size_t positive = 0, negative = 0;
};

const Vec3& position(const Mesh& mesh, std::span<const Index> nodes, LocalNode local) {
  return mesh.coordinates[static_cast<std::size_t>(nodes[local])];
}

/// A Jacobian counts as zero below 1e-10 of the product of the edge lengths: far above round-off, far below any cell
/// that could be computed with.
constexpr double kFlat2 = 1e-20;

void count(double det, double scale2, CornerJacobians& J) {
  J.min = std::min(J.min, det);
  J.max = std::max(J.max, det);
  const bool clear = det * det > kFlat2 * scale2;
  if (clear && det > 0) ++J.positive;
  if (clear && det < 0) ++J.negative;
}

CornerJacobians corner_jacobians(const Mesh& mesh, CellType type, std::span<const Index> nodes) {
  CornerJacobians J;
  for (const CornerFrame& frame : corner_frames(type)) {
    const Vec3& origin = position(mesh, nodes, frame.corner);
    const Vec3 a = subtract(position(mesh, nodes, frame.a), origin);
    const Vec3 b = subtract(position(mesh, nodes, frame.b), origin);
    const Vec3 c = subtract(position(mesh, nodes, frame.c), origin);
    count(dot(cross(a, b), c), dot(a, a) * dot(b, b) * dot(c, c), J);
  }
  return J;
}

CornerJacobians plane_jacobians(const Mesh& mesh, std::span<const Index> corners) {
  CornerJacobians J;
  const auto n = static_cast<LocalNode>(corners.size());
  for (LocalNode corner = 0; corner < n; ++corner) {
    const Vec3& origin = position(mesh, corners, corner);
    const Vec3 a = subtract(position(mesh, corners, static_cast<LocalNode>((corner + 1) % n)), origin);
    const Vec3 b = subtract(position(mesh, corners, static_cast<LocalNode>((corner + n - 1) % n)), origin);
    count(a[0] * b[1] - a[1] * b[0], dot(a, a) * dot(b, b), J);
  }
  return J;
}

/// No solids in space, and all nodes in one plane z = const: to 1e-9 of the size, above the round-off of any writer.
bool is_plane(const Mesh& mesh) {
  constexpr double kFlatness = 1e-9;
  const auto is_solid = [](const CellBlock& block) { return dimension(block.type) == 3; };
  if (std::any_of(mesh.blocks.begin(), mesh.blocks.end(), is_solid) || mesh.coordinates.empty()) return false;
  Vec3 low = mesh.coordinates[0], high = low;
  for (const Vec3& x : mesh.coordinates)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], x[c]);
      high[c] = std::max(high[c], x[c]);
    }
  return high[2] - low[2] <= kFlatness * std::max(high[0] - low[0], high[1] - low[1]);
}

bool has_repeated_nodes(std::span<const Index> nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (std::find(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes[i]) !=
        nodes.begin() + static_cast<std::ptrdiff_t>(i))
      return true;
  return false;
}

/// What is wrong with a cell and where it is.
std::string fault(const Mesh& mesh, std::span<const Index> nodes, const CornerJacobians& J) {
  Vec3 centroid{};
  for (const Index n : nodes)
    centroid =
        add(centroid, scaled(mesh.coordinates[static_cast<std::size_t>(n)], 1.0 / static_cast<double>(nodes.size())));
  std::string what;
  if (has_repeated_nodes(nodes))
    what = "a node that occurs twice in the cell";
  else if (J.positive > 0 && J.negative > 0)
    what = fmt::format("Jacobians of both signs at the corners (from {:.3g} to {:.3g})", J.min, J.max);
  else
    what = fmt::format("no volume at a corner (Jacobians from {:.3g} to {:.3g})", J.min, J.max);
  return fmt::format("{}, at ({:.6g}, {:.6g}, {:.6g})", what, centroid[0], centroid[1], centroid[2]);
}

/// The cells that cannot be computed with.
struct Faults {
  std::string first_cell, first_fault;
  std::vector<std::string> others;
};

[[noreturn]] void refuse(const Mesh& mesh, const Faults& faults) {
  constexpr std::size_t most = 1000;
  std::string found = faults.first_fault;
  if (!faults.others.empty()) {
    const std::size_t count = std::min(most, faults.others.size());
    found +=
        fmt::format("; {} more cell{} like it: {}{}", faults.others.size(), faults.others.size() == 1 ? "" : "s",
                    fmt::join(faults.others.begin(), faults.others.begin() + static_cast<std::ptrdiff_t>(count), ", "),
                    count < faults.others.size() ? ", ..." : "");
  }
  throw CaseError({mesh.report.source, 0, 0}, faults.first_cell, found,
                  "a cell with volume, not folded, over distinct nodes",
                  "Mesh the place again, or write the node order of this cell anew.");
}

}  // namespace

bool has_zero_thickness(const Mesh& mesh, CellType type, std::span<const Index> nodes) {
  const auto pairings = opposite_faces(type);
  if (pairings.empty()) return false;
  constexpr double kCoincident = 1e-6;
  Vec3 low = position(mesh, nodes, 0), high = low;
  for (const Index n : nodes)
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], mesh.coordinates[static_cast<std::size_t>(n)][c]);
      high[c] = std::max(high[c], mesh.coordinates[static_cast<std::size_t>(n)][c]);
    }
  const Vec3 size = subtract(high, low);
  const double near = kCoincident * kCoincident * dot(size, size);
  const auto coincide = [&](const std::array<LocalNode, 2>& pair) {
    const Vec3 d = subtract(position(mesh, nodes, pair[0]), position(mesh, nodes, pair[1]));
    return dot(d, d) <= near;
  };
  const auto faces_coincide = [&](std::span<const std::array<LocalNode, 2>> pairs) {
    return std::all_of(pairs.begin(), pairs.end(), coincide);
  };
  const auto collapsed = std::count_if(pairings.begin(), pairings.end(), faces_coincide);
  return collapsed == 1 && !has_repeated_nodes(nodes);
}

int plane_turn(const Mesh& mesh, std::span<const Index> corners) {
  const CornerJacobians J = plane_jacobians(mesh, corners);
  return J.positive == corners.size() ? 1 : (J.negative == corners.size() ? -1 : 0);
}

void orient_cells(Mesh& mesh) {
  MeshReport& report = mesh.report;
  report.turned = 0;
  bool any = false;
  Faults faults;
  const bool flat = is_plane(mesh);
  for (CellBlock& block : mesh.blocks) {
    const bool is_plane_solid = flat && dimension(block.type) == 2;
    if (!is_plane_solid && dimension(block.type) < 3) continue;
    const std::span<const LocalNode> mirror = mirrored_order(block.type);
    const auto plane_corners = static_cast<std::size_t>(corner_count(block.type));
    const std::size_t corners = is_plane_solid ? plane_corners : corner_frames(block.type).size();
    const auto n = static_cast<std::size_t>(node_count(block.type));
    for (std::size_t cell = 0; cell < block.size(); ++cell) {
      const std::span<Index> nodes(&block.connectivity[cell * n], n);
      const CornerJacobians J =
          is_plane_solid ? plane_jacobians(mesh, nodes.first(corners)) : corner_jacobians(mesh, block.type, nodes);
      if (J.positive != corners && J.negative != corners) {
        if (has_zero_thickness(mesh, block.type, nodes)) continue;
        if (faults.first_cell.empty()) {
          faults.first_cell = fmt::format("cell {} ({})", mesh.cell_label(block.file_numbers[cell]), name(block.type));
          faults.first_fault = fault(mesh, nodes, J);
        } else {
          faults.others.push_back(mesh.cell_label(block.file_numbers[cell]));
        }
        continue;
      }
      if (J.negative == corners) {
        std::array<Index, 27> old{};
        std::copy(nodes.begin(), nodes.end(), old.begin());
        for (std::size_t i = 0; i < n; ++i) nodes[i] = old[mirror[i]];
        if (++report.turned == 1) report.first_turned = block.file_numbers[cell];
      }
      const double ratio = J.negative == corners ? J.max / J.min : J.min / J.max;
      if (any && ratio >= report.worst_jacobian) continue;
      any = true;
      report.worst_jacobian = ratio;
      report.worst_cell = block.file_numbers[cell];
    }
  }
  if (!faults.first_cell.empty()) refuse(mesh, faults);
}

}  // namespace carom
