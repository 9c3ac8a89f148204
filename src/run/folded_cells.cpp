#include "run/folded_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "parallel/threads.hpp"
#include "solid/element_table.hpp"

namespace carom {

namespace {

/// Corners of one cell, at rest and displaced.
class Corners {
 public:
  Corners(const Mesh& mesh, std::span<const double> u, std::span<const Index> nodes)
      : mesh_(mesh), u_(u), nodes_(nodes) {}

  Vec3 rest(std::size_t a) const { return mesh_.coordinates[at(nodes_[a])]; }
  Vec3 now(std::size_t a) const {
    const std::size_t d = 3 * at(nodes_[a]);
    return add(rest(a), {u_[d], u_[d + 1], u_[d + 2]});
  }
  /// The volume at a corner between its edges to three others over that at rest; 1 where it is flat at rest.
  double share(const CornerFrame& f) const {
    const auto edge = [&f](const auto& x, LocalNode to) { return subtract(x(to), x(f.corner)); };
    const auto volume = [&](const auto& x) { return dot(cross(edge(x, f.a), edge(x, f.b)), edge(x, f.c)); };
    const auto before = [this](std::size_t a) { return rest(a); };
    const double size = norm(edge(before, f.a)) * norm(edge(before, f.b)) * norm(edge(before, f.c));
    return ratio(volume([this](std::size_t a) { return now(a); }), volume(before), size);
  }
  /// The area at a corner of a plane cell over that at rest.
  double share(std::size_t corner, std::size_t corners) const {
    const auto next = (corner + 1) % corners, last = (corner + corners - 1) % corners;
    const auto area = [&](const auto& x) {
      return cross(subtract(x(next), x(corner)), subtract(x(last), x(corner)))[2];
    };
    const auto before = [this](std::size_t a) { return rest(a); };
    const double size = norm(subtract(rest(next), rest(corner))) * norm(subtract(rest(last), rest(corner)));
    return ratio(area([this](std::size_t a) { return now(a); }), area(before), size);
  }

 private:
  static double ratio(double now, double rest, double size) {
    constexpr double flat = 1e-10;  // as meshes are read (mesh/orientation.cpp)
    return rest > flat * size ? now / rest : 1.0;
  }

  const Mesh& mesh_;
  std::span<const double> u_;
  std::span<const Index> nodes_;
};

/// The least share of a cell's corners.
double least_share(const Corners& of_cell, CellType type) {
  double least = 1.0;
  if (dimension(type) == 3)
    for (const CornerFrame& frame : corner_frames(type)) least = std::min(least, of_cell.share(frame));
  if (dimension(type) == 2) {
    const auto corners = static_cast<std::size_t>(corner_count(type));
    for (std::size_t corner = 0; corner < corners; ++corner) least = std::min(least, of_cell.share(corner, corners));
  }
  return least;
}

std::string_view advice(const Part& part) {
  switch (find_element(part.type, part.section, part.formulation)->formulation) {
    case Formulation::one_point:
      return "One point sees its mean volume alone, and its hourglass modes are soft: leave the formulation out, or "
             "raise hourglass";
    case Formulation::stabilised:
      return "One point sees its mean volume alone: cells that are finer there, or longer in the direction that is "
             "crushed, keep their shape; formulation = \"full\" stops at such a cell";
    case Formulation::reduced:
      return "Its points do not see its corners: formulation = \"mean_dilatation\" has more of them";
    case Formulation::full:
    case Formulation::mean_dilatation:
      break;
  }
  return "Cells that are finer there, or longer in the direction that is crushed, or a contact that spreads the load, "
         "keep their shape";
}

}  // namespace

FlattestCorner flattest_corner(const Simulation& simulation, std::span<const double> u) {
  const Solid& solid = simulation.solid();
  const Mesh& mesh = simulation.mesh();
  constexpr std::size_t grain = 1024;
  std::vector<FlattestCorner> of_task((solid.cell_count() + grain - 1) / grain);
  parallel_for(of_task.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task)
      for (std::size_t k = grain * task; k < std::min(grain * (task + 1), solid.cell_count()); ++k) {
        const CellType type = mesh.blocks[at(solid.cells()[k].block)].type;
        const double share = least_share(Corners(mesh, u, solid.nodes_of_cell(k)), type);
        if (share < of_task[task].share) of_task[task] = {static_cast<Index>(k), share};
      }
  });
  FlattestCorner least;
  for (const FlattestCorner& found : of_task)
    if (found.share < least.share) least = found;
  return least;
}

std::string describe_fold(const Simulation& simulation, const FlattestCorner& corner, std::span<const double> u) {
  const std::span<const Index> nodes = simulation.solid().nodes_of_cell(at(corner.cell));
  const Corners of_cell(simulation.mesh(), u, nodes);
  Vec3 centre{};
  for (std::size_t a = 0; a < nodes.size(); ++a)
    centre = add(centre, scaled(of_cell.now(a), 1.0 / static_cast<double>(nodes.size())));
  const CellRef cell = simulation.solid().cells()[at(corner.cell)];
  const Part& part = *simulation.model().part_of(cell);
  return fmt::format(
      "cell {} of part \"{}\" at ({:.4g}, {:.4g}, {:.4g}) has folded: its volume at a corner is {:.3g} of "
      "that at rest. {}",
      simulation.mesh().blocks[at(cell.block)].file_numbers[at(cell.cell)], part.name, centre[0], centre[1], centre[2],
      corner.share, advice(part));
}

}  // namespace carom
