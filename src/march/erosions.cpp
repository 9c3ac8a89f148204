#include "march/erosions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "build/eroding_parts.hpp"
#include "march/folded_cells.hpp"
#include "solid/cell_values.hpp"

namespace carom {

Erosions::Erosions(const Simulation& simulation)
    : s_(simulation),
      topologies_(simulation.model(), simulation.solid().cells()),
      so_far_(simulation.model().erosion.size()) {}

/// A variable of all cells, the largest of their points; empty where its criterion is none of the model's.
std::vector<double> Erosions::largest(const char* variable, std::optional<double> Erosion::*criterion,
                                      const State& state) const {
  if (std::ranges::none_of(s_.model().erosion, [&](const Erosion& e) { return (e.*criterion).has_value(); })) return {};
  return cell_history(s_.solid(), variable, state.points, OverPoints::largest);
}

bool Erosions::goes(const Erosion& erosion, Index cell, const State& state, const Reached& reached) const {
  if (erosion.time && state.t >= *erosion.time) return true;
  if (erosion.plastic_strain && reached.plastic_strain[at(cell)] >= *erosion.plastic_strain) return true;
  if (erosion.damage && reached.damage[at(cell)] >= *erosion.damage) return true;
  if (!erosion.distortion) return false;
  const CellType type = s_.mesh().blocks[at(s_.solid().cells()[at(cell)].block)].type;
  return flattest_share(s_.mesh(), type, s_.solid().cells().nodes_of(at(cell)), state.q) <= *erosion.distortion;
}

std::vector<std::uint8_t> Erosions::next(const State& state) const {
  std::vector<std::uint8_t> alive(state.alive().begin(), state.alive().end());
  if (alive.empty()) alive.assign(s_.solid().cells().size(), 1);
  const Reached reached{largest(yielding_by, &Erosion::plastic_strain, state),
                        largest(damaged_by, &Erosion::damage, state)};
  bool changes = false;
  for (const Erosion& erosion : s_.model().erosion)
    for (const Index cell : erosion.cells) {
      if (alive[at(cell)] == 0 || !goes(erosion, cell, state, reached)) continue;
      alive[at(cell)] = 0;
      changes = true;
    }
  return changes ? alive : std::vector<std::uint8_t>{};
}

void Erosions::note(const State& state, const std::vector<std::uint8_t>& next) {
  const std::span<const std::uint8_t> before = state.alive();
  for (std::size_t e = 0; e < so_far_.size(); ++e) {
    std::size_t cells = 0;
    for (const Index cell : s_.model().erosion[e].cells)
      if (next[at(cell)] == 0 && (before.empty() || before[at(cell)] != 0)) ++cells;
    if (cells == 0) continue;
    if (so_far_[e].cells == 0) so_far_[e].first = state.t;
    so_far_[e].last = state.t;
    so_far_[e].cells += cells;
  }
}

std::vector<std::string> Erosions::log() const {
  std::vector<std::string> lines;
  for (std::size_t e = 0; e < so_far_.size(); ++e) {
    const ErodedSoFar& so_far = so_far_[e];
    if (so_far.cells == 0) continue;
    const Erosion& erosion = s_.model().erosion[e];
    lines.push_back(fmt::format("erosion: {} of the {} cells of part \"{}\" have gone, from t = {:.6g} to {:.6g}",
                                so_far.cells, erosion.cells.size(), erosion.name, so_far.first, so_far.last));
  }
  return lines;
}

}  // namespace carom
