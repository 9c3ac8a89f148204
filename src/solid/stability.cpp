#include "solid/stability.hpp"

#include <algorithm>
#include <array>

#include "base/types.hpp"
#include "parallel/threads.hpp"
#include "solid/solid_impl.hpp"

namespace carom {

std::vector<double> cell_frequency_bounds(const Solid& solid) {
  return solid.parts().cell_frequency_bounds();
}

double largest_frequency_bound(const Solid& solid) {
  return solid.parts().largest_bound();
}

double largest_damping(const Solid& solid, std::span<const double> history) {
  const Solid::Parts& parts = solid.parts();
  return std::max(largest_damping(parts.solid, parts.damping, history),
                  largest_damping(parts.patches.cells, parts.patch_damping, history));
}

void frequency_growth(const Solid& solid, std::span<const double> u, const PointStep& step, std::span<double> growth) {
  const Solid::Parts& parts = solid.parts();
  const SolidCells& patches = parts.patches.cells;
  std::vector<double> of_patches(patches.size()), of_cells(patches.size() == 0 ? 0 : solid.cells().size(), 0.0);
  patches.for_each_batch(step, [&](std::size_t first, const Block& block, const CellBatches& batch) {
    if (block.small_strain) return;
    double* own = &of_patches[first];
    wave_modulus(batch, block.law(), u.data(), own);
    const BatchGradients gradients(batch, u.data());
    for (int l = 0; l < batch.cells; ++l) own[l] /= block.wave_modulus * gradients.least_stretch_squared(l);
  });
  parts.largest_of_patches(of_patches, of_cells);
  parallel_for(parts.solid.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = parts.solid.chunks[c];
    const Block& block = parts.block(chunk);
    if (!parts.looks_at(c)) return;
    const std::span<double> own = growth.subspan(at(block.first + chunk.first), at(chunk.cells));
    if (block.small_strain) return std::fill(own.begin(), own.end(), 1.0);
    if (block.is_nodal()) {
      std::copy_n(of_cells.begin() + block.first + chunk.first, own.size(), own.begin());
      return parts.solid.add_distortion_growth(chunk, u, parts.bounds_at_rest, own, step);
    }
    parts.solid.for_each_living(
        chunk, step, {}, std::array{u.data()},
        [&](Index first, const CellBatches& batch, const std::array<const double*, 1>& of_living,
            std::span<const std::uint8_t>) { wave_modulus(batch, block.law(), of_living[0], &own[at(first)]); });
    std::vector<double> length(own.size());
    parts.solid.lengths(block, chunk.first, u, length);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (!parts.solid.is_there(block.first + chunk.first + static_cast<Index>(k), step)) {
        own[k] = 0.0;
        continue;
      }
      const double shortening = solid.cells().lengths[at(block.first + chunk.first) + k] / length[k];
      own[k] *= shortening * shortening / block.wave_modulus;
    }
    parts.solid.add_distortion_growth(chunk, u, parts.bounds_at_rest, own, step);
  });
}

}  // namespace carom
