#include "march/folded_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "mesh/corner_shapes.hpp"
#include "parallel/ranks.hpp"
#include "parallel/threads.hpp"
#include "solid/element_table.hpp"

namespace carom {

namespace {

/// The nodes of one cell, at rest and displaced.
class Corners {
 public:
  Corners(const Mesh& mesh, std::span<const double> u, std::span<const Index> nodes)
      : mesh_(mesh), u_(u), nodes_(nodes) {}

  Vec3 rest(std::size_t a) const { return mesh_.coordinates[at(nodes_[a])]; }
  Vec3 now(std::size_t a) const { return add(rest(a), vector_at(u_, at(nodes_[a]))); }
  /// The volume at a corner over that at rest; 1 where it is flat at rest.
  double share(const CornerFrame& frame) const {
    const CornerEdges before(frame, [this](std::size_t a) { return rest(a); });
    const CornerEdges after(frame, [this](std::size_t a) { return now(a); });
    return before.has_volume() ? after.volume() / before.volume() : 1.0;
  }

 private:
  const Mesh& mesh_;
  std::span<const double> u_;
  std::span<const Index> nodes_;
};

/// The least share of a cell's corners.
double least_corner_share(const Corners& of_cell, CellType type) {
  double least = 1.0;
  for (const CornerFrame& frame : cell_corners(type)) least = std::min(least, of_cell.share(frame));
  return least;
}

bool is_small_strain(const Part& part) {
  return part.material.law->measure == Measure::small_strain;
}
/// Of each of Solid::cells(), which are those of one part after the other.
std::vector<char> are_small_strain(const Model& model) {
  std::vector<char> are;
  for (const Part& part : model.parts) are.insert(are.end(), part.cells.size(), is_small_strain(part) ? 1 : 0);
  return are;
}

/// What helps a cell that folds.
std::string advice(const Part& part) {
  const Law& law = *part.material.law;
  if (is_small_strain(part))
    return fmt::format("Its law is one of small strain, for which such a cell means nothing: take law = {}",
                       law.when_turning);
  std::string text = part.distortion_control > 0.0 ? "A larger distortion_control acts earlier"
                                                   : "distortion_control = 0.1 keeps corners from folding";
  switch (find_element(part.type, part.section, part.formulation)->formulation) {
    case Formulation::one_point:
      text += ", or leave the formulation out: hourglass modes of one point are soft";
      break;
    case Formulation::reduced:
      text += "; formulation = \"mean_dilatation\" has more points, which see more of it";
      break;
    case Formulation::stabilised:
    case Formulation::nodal:
    case Formulation::full:
    case Formulation::mean_dilatation:
      break;
  }
  return text +
         ". Cells that are finer there, or longer in the direction that is crushed, or a contact that spreads the "
         "load, keep their shape by themselves";
}

}  // namespace

double flattest_share(const Mesh& mesh, CellType type, std::span<const Index> nodes, std::span<const double> u) {
  return least_corner_share(Corners(mesh, u, nodes), type);
}

FlattestCorner flattest_corner(const Simulation& simulation, std::span<const double> u,
                               std::span<const std::uint8_t> alive) {
  const Solid& solid = simulation.solid();
  const Mesh& mesh = simulation.mesh();
  const std::vector<char> is_small = are_small_strain(simulation.model());
  const EntryRange own = own_share_of(mesh.node_count());
  constexpr std::size_t grain = 1024;
  std::vector<FlattestCorner> of_task((solid.cells().size() + grain - 1) / grain);
  parallel_for(solid.cells().size(), grain, [&](std::size_t begin, std::size_t end) {
    FlattestCorner& least = of_task[begin / grain];
    for (std::size_t k = begin; k < end; ++k) {
      const std::span<const Index> nodes = solid.cells().nodes_of(k);
      if (!own.has(at(nodes[0])) || (!alive.empty() && alive[k] == 0)) continue;
      const double share = flattest_share(mesh, mesh.blocks[at(solid.cells()[k].block)].type, nodes, u);
      if (share < least.small_strain && is_small[k] != 0) least.small_strain = share;
      if (share >= least.share) continue;
      least.cell = static_cast<Index>(k);
      least.share = share;
    }
  });
  FlattestCorner least;
  double small_strain = 1.0;
  for (const FlattestCorner& found : of_task) {
    small_strain = std::min(small_strain, found.small_strain);
    if (found.share < least.share) least = found;
  }
  const auto [share, cell] = largest_on_ranks(-least.share, at(least.cell + 1));
  return {static_cast<Index>(cell) - 1, -share, -largest_on_ranks(-small_strain, 0).first};
}

std::string describe_fold(const Simulation& simulation, const FlattestCorner& corner, std::span<const double> u) {
  const std::span<const Index> nodes = simulation.solid().cells().nodes_of(at(corner.cell));
  const Corners of_cell(simulation.mesh(), u, nodes);
  Vec3 centre{};
  for (std::size_t a = 0; a < nodes.size(); ++a)
    centre = add(centre, scaled(of_cell.now(a), 1.0 / static_cast<double>(nodes.size())));
  const CellRef cell = simulation.solid().cells()[at(corner.cell)];
  const Part& part = *simulation.model().part_of(cell);
  return fmt::format(
      "cell {} of part \"{}\" at ({:.4g}, {:.4g}, {:.4g}) has folded: its volume at a corner is {:.3g} of "
      "that at rest. {}",
      simulation.mesh().cell_label(cell), part.name, centre[0], centre[1], centre[2], corner.share, advice(part));
}

}  // namespace carom
