// Values of the cells of a Solid: rotations, growth of frequencies, stresses, history.
#include <algorithm>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "parallel/threads.hpp"
#include "solid/solid_impl.hpp"

namespace carom {

Rotation Solid::largest_rotation(std::span<const double> u) const {
  std::vector<Rotation> partial(impl_->solid.chunks.size());
  parallel_for(partial.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    if (!block.small_strain) return;
    for (Index first = 0; first < chunk.cells; first += block.stages.lanes) {
      const BatchGradients gradients(impl_->solid.batches(block, chunk.first + first, 1), u.data());
      const Index count = std::min<Index>(block.stages.lanes, chunk.cells - first);
      follow_rotation(gradients, block.type, block.stages.lanes, static_cast<int>(count),
                      block.first + chunk.first + first, partial[c]);
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
      return impl_->solid.add_distortion_growth(chunk, u, impl_->bounds_at_rest, own);
    }
    wave_modulus(impl_->solid.batches(chunk, step), block.law(), u.data(), own.data());
    std::vector<double> length(own.size());
    impl_->solid.lengths(block, chunk.first, u, length);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const double shortening = impl_->lengths[at(block.first + chunk.first) + k] / length[k];
      own[k] *= shortening * shortening / block.wave_modulus;
    }
    impl_->solid.add_distortion_growth(chunk, u, impl_->bounds_at_rest, own);
  });
}

std::vector<std::array<double, 6>> Solid::cell_stress(std::span<const double> u, const PointStep& step) const {
  std::vector<std::array<double, 6>> stress(cell_count());
  parallel_for(impl_->solid.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    double* first = stress[at(block.first + chunk.first)].data();
    if (!block.is_nodal()) block.kernels.mean_stress(impl_->solid.batches(chunk, step), block.law(), u.data(), first);
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
    block.kernels.mean_stress(impl_->solid.batches(chunk, step), block.law(), u.data(), stress.front().data());
    for (std::size_t k = 0; k < stress.size(); ++k)
      of_chunk[c] = std::max(of_chunk[c], {measure(stress[k]), at(block.first + chunk.first) + k}, is_less);
  });
  return of_chunk.empty() ? Largest{-1.0, 0} : *std::max_element(of_chunk.begin(), of_chunk.end(), is_less);
}

std::vector<double> Solid::cell_history(std::string_view variable, std::span<const double> history) const {
  const auto position = [&](const Block& block) {
    const std::vector<std::string>& names = block.law_row->history;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), variable) - names.begin());
  };
  const auto has_it = [&](const Block& block) { return position(block) < block.law_row->history.size(); };
  if (std::none_of(impl_->solid.blocks.begin(), impl_->solid.blocks.end(), has_it)) return {};
  const auto means_of = [&](const SolidCells& cells) {
    std::vector<double> means(cells.size());
    cells.for_each_batch({0.0, history}, [&](std::size_t first, const Block& block, const CellBatches& batch) {
      if (block.is_nodal() || !has_it(block)) return;
      const BatchGradients gradients(batch);
      const std::size_t lanes = block.lanes(), variables = at(batch.history_variables), of_law = position(block);
      for (int l = 0; l < batch.cells; ++l) {
        double& mean = means[first + at(l)];
        for (int p = 0; p < gradients.points(); ++p)
          mean += gradients.weight(p, l) * batch.history[(variables * at(p) + of_law) * lanes + at(l)];
        mean /= gradients.volume(l);
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
