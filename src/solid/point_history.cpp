#include "solid/point_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/page_memory.hpp"
#include "base/types.hpp"
#include "solid/solid_impl.hpp"

namespace carom {

std::size_t history_size(const Solid& solid) {
  return solid.parts().points_history_size() + solid.cohesive().history_size();
}
std::vector<double> initial_history(const Solid& solid) {
  return unwritten_zeros(history_size(solid));
}

void complete_history(const Solid& solid, std::span<double> history) {
  const Solid::Parts& parts = solid.parts();
  if (parts.share_of_cells && !history.empty()) parts.share_of_cells->history.gather(history);
}

void collect_history(const Solid& solid, std::span<double> history) {
  const Solid::Parts& parts = solid.parts();
  if (parts.share_of_cells && !history.empty()) parts.share_of_cells->history.collect(history);
}

void release_history(const Solid& solid, std::span<double> history) {
  const Solid::Parts& parts = solid.parts();
  if (!parts.share_of_cells || history.empty()) return;
  each_gap(parts.share_of_cells->held_history, history.size(),
           [&](std::size_t begin, std::size_t end) { release_pages(history.subspan(begin, end - begin)); });
}

std::vector<double> history_by_cell(const Solid& solid, std::span<const double> history) {
  const Solid::Parts& parts = solid.parts();
  if (history.empty()) return {};
  if (history.size() != history_size(solid)) throw std::invalid_argument("a history of other bodies");
  std::vector<double> out(history.size());
  std::size_t begin = 0;
  for (const SolidCells* cells : {&parts.solid, &parts.patches.cells})
    begin += cells->for_each_history(
        [&](std::size_t place, std::size_t position) { out[begin + position] = history[place]; });
  const std::span<const double> others = history.subspan(parts.points_history_size());
  out.resize(begin);
  out.insert(out.end(), others.begin(), others.end());
  return out;
}

std::vector<double> history_of_lanes(const Solid& solid, std::span<const double> by_cell) {
  const Solid::Parts& parts = solid.parts();
  if (by_cell.empty()) return {};
  std::vector<double> out(history_size(solid));
  std::size_t size = out.size() - parts.points_history_size();
  for (const SolidCells* cells : {&parts.solid, &parts.patches.cells})
    size += cells->for_each_history([](std::size_t, std::size_t) {});
  if (by_cell.size() != size)
    throw std::invalid_argument(
        fmt::format("the points of the bodies remember {} numbers, and {} are given", size, by_cell.size()));
  std::size_t begin = 0;
  for (const SolidCells* cells : {&parts.solid, &parts.patches.cells})
    begin += cells->for_each_history(
        [&](std::size_t place, std::size_t position) { out[place] = by_cell[begin + position]; });
  std::copy(by_cell.begin() + static_cast<std::ptrdiff_t>(begin), by_cell.end(),
            out.begin() + static_cast<std::ptrdiff_t>(parts.points_history_size()));
  return out;
}

void forget_gone(const Solid& solid, std::span<const std::uint8_t> alive, std::span<double> history) {
  for (const Block& block : solid.parts().solid.blocks) {
    if (block.is_rigid) continue;
    const std::size_t lanes = block.lanes(), values = block.history_per_cell();
    for (std::size_t c = 0; c < at(block.cells) && values > 0; ++c) {
      if (alive[at(block.first) + c] != 0) continue;
      const std::size_t batch = block.history_first + values * (c / lanes * lanes);
      for (std::size_t k = 0; k < values; ++k) history[batch + k * lanes + c % lanes] = 0.0;
    }
  }
}

}  // namespace carom
