#include "record/probe_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/types.hpp"
#include "build/groups.hpp"
#include "build/rigid_bodies.hpp"
#include "build/rigid_parts.hpp"
#include "math/principal_axes.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

/// Nodes of no part stay where they are.
bool moves(const Simulation& simulation, Index node) {
  return simulation.mass().node_diagonal()[static_cast<std::size_t>(node)] > 0.0 ||
         simulation.model().embedding.find(node) != nullptr;
}

Index numbered_node(const Located<std::int64_t>& number, const Simulation& simulation) {
  const std::vector<std::int64_t>& numbers = simulation.mesh().node_numbers;
  const auto found = std::find(numbers.begin(), numbers.end(), *number);
  if (found == numbers.end()) {
    const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
    throw CaseError(number.where, "probe.node", fmt::format("{}, which the mesh does not have", *number),
                    fmt::format("a node number of the mesh ({} to {})", *least, *most));
  }
  const auto node = static_cast<Index>(found - numbers.begin());
  if (!moves(simulation, node))
    throw CaseError(number.where, "probe.node", fmt::format("node {}, which belongs to no part", *number),
                    "a node of a part: others do not move");
  return node;
}

/// The longest line between two nodes of a cell at the node.
double cell_size(Index node, const Simulation& simulation) {
  const std::vector<Vec3>& x = simulation.mesh().coordinates;
  double size = 0.0;
  for (std::size_t k = 0; k < simulation.solid().cells().size(); ++k) {
    const std::span<const Index> nodes = simulation.solid().cells().nodes_of(k);
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) continue;
    for (const Index a : nodes)
      for (const Index b : nodes) size = std::max(size, norm(subtract(x[at(a)], x[at(b)])));
  }
  return size;
}

ProbePlace nearest_node(const CaseProbe& given, const Simulation& simulation) {
  const Located<Vec3>& point = *given.point;
  const Mesh& mesh = simulation.mesh();
  std::size_t nearest = 0;
  double best = std::numeric_limits<double>::infinity();
  const std::size_t of_parts = mesh.node_count() - carrier_nodes(simulation.given()) - rigid_nodes(simulation.given());
  for (std::size_t n = 0; n < of_parts; ++n) {
    if (!moves(simulation, static_cast<Index>(n))) continue;
    const double distance = norm(subtract(mesh.coordinates[n], *point));
    if (distance >= best) continue;
    best = distance;
    nearest = n;
  }
  const auto node = static_cast<Index>(nearest);
  constexpr double round_off = 1e-9;  // a distance of just the size of a cell is one
  const double most = given.within ? *given.within : (1.0 + round_off) * cell_size(node, simulation);
  if (best > most) {
    const Vec3& x = mesh.coordinates[nearest];
    throw CaseError(point.where, "probe.point",
                    fmt::format("({:.6g}, {:.6g}, {:.6g}), which is {:.4g} from the nearest node of a part, node {} at "
                                "({:.6g}, {:.6g}, {:.6g})",
                                (*point)[0], (*point)[1], (*point)[2], best,
                                mesh.node_label(static_cast<Index>(nearest)), x[0], x[1], x[2]),
                    fmt::format("a point within {:.4g} of a node{}", most,
                                given.within ? " (within)" : ", which is the size of a cell there"),
                    "If that node is meant, name it (node = ...) or allow the distance (within = ...).");
  }
  return {{node}, best};
}

}  // namespace

ProbePlace place_probe(const CaseProbe& given, const Simulation& simulation) {
  if (given.group) return {Groups(simulation.mesh()).nodes(*given.group, "probe.group"), 0.0};
  if (given.node) return {{numbered_node(*given.node, simulation)}, 0.0};
  return nearest_node(given, simulation);
}

Vec3 across_section(const CaseProbe& given, std::span<const Index> nodes, const Mesh& mesh) {
  const auto& x = mesh.coordinates;
  Vec3 centre{};
  for (const Index n : nodes) centre = add(centre, scaled(x[at(n)], 1.0 / static_cast<double>(nodes.size())));
  Vec3 squares{}, products{};
  for (const Index n : nodes) {
    const Vec3 d = subtract(x[at(n)], centre);
    squares = add(squares, {d[0] * d[0], d[1] * d[1], d[2] * d[2]});
    products = add(products, {d[0] * d[1], d[1] * d[2], d[2] * d[0]});
  }
  const PrincipalAxes spread = principal_axes(squares, products);
  // A direction in which the nodes spread by less than 1e-3 of the widest is across a plane, and likewise for a line.
  constexpr double flat = 1e-6;
  const double widest = *std::max_element(spread.values.begin(), spread.values.end());
  Vec3 across = *given.side;
  std::size_t along = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(spread.values[c] > flat * widest)) continue;
    across = subtract(across, scaled(spread.axes[c], dot(across, spread.axes[c])));
    ++along;
  }
  if (along == 3) return *given.side;
  constexpr double least = 0.01;  // half a degree: nobody aims so closely past a plane
  if (norm(across) > least * norm(*given.side)) return across;
  throw CaseError(given.where, "probe.side",
                  fmt::format("({:g}, {:g}, {:g}), which lies in the plane of the section \"{}\"", (*given.side)[0],
                              (*given.side)[1], (*given.side)[2], *given.name),
                  "a direction across the section, to the cells whose forces are summed");
}

}  // namespace carom
