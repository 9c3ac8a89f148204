// Values of the cells of a Solid: rotations, growth of frequencies, stresses, history.
#include <algorithm>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "parallel/threads.hpp"
#include "solid/solid_impl.hpp"

namespace carom {

Rotation Solid::largest_rotation(std::span<const double> u, std::span<const std::uint8_t> alive) const {
  std::vector<Rotation> partial(impl_->solid.chunks.size());
  parallel_for(partial.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    if (!block.small_strain) return;
    for (Index first = 0; first < chunk.cells; first += block.stages.lanes) {
      const Index count = std::min<Index>(block.stages.lanes, chunk.cells - first), cell = chunk.first + first;
      const CellBatches batch = impl_->solid.batches(block, cell, 1);
      const auto follow = [&](const BatchGradients& gradients) {
        follow_rotation(gradients, block.type, block.stages.lanes, static_cast<int>(count), block.first + cell,
                        partial[c]);
      };
      const std::span<const std::uint8_t> own =
          impl_->solid.gone_among(block, cell, count, {.history = {}, .alive = alive});
      if (own.empty()) {
        follow(BatchGradients(batch, u.data()));
      } else {
        const CellsApart apart(batch, std::array{u.data()}, own);
        follow(BatchGradients(apart.batch, apart.at[0].data()));
      }
    }
  });
  Rotation largest;
  for (const Rotation& rotation : partial)
    if (rotation.angle > largest.angle) largest = rotation;
  return largest;
}

void Solid::frequency_growth(std::span<const double> u, const PointStep& step, std::span<double> growth) const {
  const SolidCells& patches = impl_->patches.cells;
  std::vector<double> of_patches(patches.size()), of_cells(patches.size() == 0 ? 0 : cell_count(), 0.0);
  patches.for_each_batch(step, [&](std::size_t first, const Block& block, const CellBatches& batch) {
    if (block.small_strain) return;
    double* own = &of_patches[first];
    wave_modulus(batch, block.law(), u.data(), own);
    const BatchGradients gradients(batch, u.data());
    for (int l = 0; l < batch.cells; ++l) own[l] /= block.wave_modulus * gradients.least_stretch_squared(l);
  });
  impl_->largest_of_patches(of_patches, of_cells);
  parallel_for(impl_->solid.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    const std::span<double> own = growth.subspan(at(block.first + chunk.first), at(chunk.cells));
    if (block.small_strain) return std::fill(own.begin(), own.end(), 1.0);
    if (block.is_nodal()) {
      std::copy_n(of_cells.begin() + block.first + chunk.first, own.size(), own.begin());
      return impl_->solid.add_distortion_growth(chunk, u, impl_->bounds_at_rest, own, step);
    }
    impl_->solid.for_each_living(
        chunk, step, {}, std::array{u.data()},
        [&](Index first, const CellBatches& batch, const std::array<const double*, 1>& of_living,
            std::span<const std::uint8_t>) { wave_modulus(batch, block.law(), of_living[0], &own[at(first)]); });
    std::vector<double> length(own.size());
    impl_->solid.lengths(block, chunk.first, u, length);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (!impl_->solid.is_there(block.first + chunk.first + static_cast<Index>(k), step)) {
        own[k] = 0.0;
        continue;
      }
      const double shortening = impl_->lengths[at(block.first + chunk.first) + k] / length[k];
      own[k] *= shortening * shortening / block.wave_modulus;
    }
    impl_->solid.add_distortion_growth(chunk, u, impl_->bounds_at_rest, own, step);
  });
}

std::vector<std::array<double, 6>> Solid::cell_stress(std::span<const double> u, const PointStep& step) const {
  std::vector<std::array<double, 6>> stress(cell_count());
  parallel_for(impl_->solid.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    double* first = stress[at(block.first + chunk.first)].data();
    if (!block.is_nodal()) impl_->mean_stress(chunk, block, u, step, first);
  });
  const SolidCells& patches = impl_->patches.cells;
  std::vector<double> of_patches(6 * patches.size());
  parallel_for(patches.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = patches.chunks[c];
    const Block& block = patches.blocks[at(chunk.block)];
    block.kernels.mean_stress(patches.batches(chunk, step), block.law(), u.data(),
                              &of_patches[6 * at(block.first + chunk.first)]);
  });
  for (std::size_t k = 0; k < stress.size(); ++k) impl_->add_mean_of_patches(k, 6, of_patches, stress[k].data());
  return stress;
}

std::pair<double, std::size_t> Solid::largest_stress(std::span<const double> u, const PointStep& step,
                                                     double (*measure)(const Voigt& stress)) const {
  using Largest = std::pair<double, std::size_t>;
  if (!impl_->patches.empty()) {
    Largest largest{-1.0, 0};
    const std::vector<Voigt> stress = cell_stress(u, step);
    for (std::size_t k = 0; k < stress.size(); ++k)
      if (const double size = measure(stress[k]); size > largest.first) largest = {size, k};
    return largest;
  }
  const auto is_less = [](const Largest& a, const Largest& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::vector<Largest> of_chunk(impl_->solid.chunks.size(), {-1.0, 0});
  parallel_for(of_chunk.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    std::vector<Voigt> stress(at(chunk.cells));
    impl_->mean_stress(chunk, block, u, step, stress.front().data());
    for (std::size_t k = 0; k < stress.size(); ++k)
      of_chunk[c] = std::max(of_chunk[c], {measure(stress[k]), at(block.first + chunk.first) + k}, is_less);
  });
  return of_chunk.empty() ? Largest{-1.0, 0} : *std::max_element(of_chunk.begin(), of_chunk.end(), is_less);
}

std::vector<double> Solid::history_by_cell(std::span<const double> history) const {
  if (history.empty()) return {};
  if (history.size() != history_size()) throw std::invalid_argument("a history of other bodies");
  std::vector<double> out(history.size());
  std::size_t begin = 0;
  for (const SolidCells* cells : {&impl_->solid, &impl_->patches.cells})
    begin += cells->for_each_history(
        [&](std::size_t place, std::size_t position) { out[begin + position] = history[place]; });
  const std::span<const double> others = history.subspan(impl_->points_history_size());
  out.resize(begin);
  out.insert(out.end(), others.begin(), others.end());
  return out;
}

std::vector<double> Solid::history_of_lanes(std::span<const double> by_cell) const {
  if (by_cell.empty()) return {};
  std::vector<double> out(history_size());
  std::size_t size = out.size() - impl_->points_history_size();
  for (const SolidCells* cells : {&impl_->solid, &impl_->patches.cells})
    size += cells->for_each_history([](std::size_t, std::size_t) {});
  if (by_cell.size() != size)
    throw std::invalid_argument(
        fmt::format("the points of the bodies remember {} numbers, and {} are given", size, by_cell.size()));
  std::size_t begin = 0;
  for (const SolidCells* cells : {&impl_->solid, &impl_->patches.cells})
    begin += cells->for_each_history(
        [&](std::size_t place, std::size_t position) { out[place] = by_cell[begin + position]; });
  std::copy(by_cell.begin() + static_cast<std::ptrdiff_t>(begin), by_cell.end(),
            out.begin() + static_cast<std::ptrdiff_t>(impl_->points_history_size()));
  return out;
}

void Solid::forget_gone(std::span<const std::uint8_t> alive, std::span<double> history) const {
  for (const Block& block : impl_->solid.blocks) {
    if (block.is_rigid) continue;
    const std::size_t lanes = block.lanes(), values = block.history_per_cell();
    for (std::size_t c = 0; c < at(block.cells) && values > 0; ++c) {
      if (alive[at(block.first) + c] != 0) continue;
      const std::size_t batch = block.history_first + values * (c / lanes * lanes);
      for (std::size_t k = 0; k < values; ++k) history[batch + k * lanes + c % lanes] = 0.0;
    }
  }
}

std::vector<double> Solid::cell_history(std::string_view variable, std::span<const double> history,
                                        OverPoints over) const {
  const auto position = [&](const Block& block) {
    const std::vector<std::string>& names = block.history_names;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), variable) - names.begin());
  };
  const auto has_it = [&](const Block& block) { return position(block) < block.history_names.size(); };
  if (std::none_of(impl_->solid.blocks.begin(), impl_->solid.blocks.end(), has_it)) return {};
  const auto means_of = [&](const SolidCells& cells) {
    std::vector<double> means(cells.size());
    cells.for_each_batch({0.0, history}, [&](std::size_t first, const Block& block, const CellBatches& batch) {
      if (block.is_nodal() || !has_it(block)) return;
      const BatchGradients gradients(batch);
      const std::size_t lanes = block.lanes(), variables = at(batch.history_variables), of_law = position(block);
      for (int l = 0; l < batch.cells; ++l) {
        double& mean = means[first + at(l)];
        for (int p = 0; p < gradients.points(); ++p) {
          const double value = batch.history[(variables * at(p) + of_law) * lanes + at(l)];
          if (over == OverPoints::largest)
            mean = p == 0 ? value : std::max(mean, value);
          else
            mean += gradients.weight(p, l) * value;
        }
        if (over == OverPoints::mean) mean /= gradients.volume(l);
      }
    });
    return means;
  };
  std::vector<double> means = means_of(impl_->solid);
  const std::vector<double> of_patches = means_of(impl_->patches.cells);
  for (std::size_t k = 0; k < means.size(); ++k) impl_->add_mean_of_patches(k, 1, of_patches, &means[k]);
  return means;
}

}  // namespace carom
