#include "march/inside_out.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "solid/cell_values.hpp"

namespace carom {

std::string inside_out(const Simulation& simulation, std::span<const double> u, std::span<const std::uint8_t> alive) {
  const Solid& solid = simulation.solid();
  const bool is_finite = u.size() == solid.dof_count() && carom::is_finite(u);
  if (solid.is_linear() || !is_finite) return {};
  const Index k = first_inverted_cell(solid, u, alive);
  if (k < 0) return {};
  const std::span<const Index> nodes = solid.cells().nodes_of(static_cast<std::size_t>(k));
  Vec3 centre{};
  for (const Index n : nodes) {
    const auto i = 3 * static_cast<std::size_t>(n);
    const Vec3 x = add(simulation.mesh().coordinates[static_cast<std::size_t>(n)], {u[i], u[i + 1], u[i + 2]});
    centre = add(centre, scaled(x, 1.0 / static_cast<double>(nodes.size())));
  }
  const CellRef cell = solid.cells()[static_cast<std::size_t>(k)];
  const Part* part = simulation.model().part_of(cell);
  return fmt::format(
      "cell {} of part \"{}\" at ({:.4g}, {:.4g}, {:.4g}) turns inside out: it is crushed or sheared beyond what its "
      "shape can follow. distortion_control = 0.1, finer cells there, a law that stiffens enough, a lower speed or "
      "load, or a stiffer contact "
      "that spreads the load help; smaller steps (time.safety, time.step) where it happens at once",
      simulation.mesh().cell_label(cell), part == nullptr ? "" : part->name, centre[0], centre[1], centre[2]);
}

}  // namespace carom
