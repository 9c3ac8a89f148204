#include "solid/cell_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "parallel/threads.hpp"
#include "solid/solid_impl.hpp"

namespace carom {

Rotation largest_rotation(const Solid& solid, std::span<const double> u, std::span<const std::uint8_t> alive) {
  const Solid::Parts& parts = solid.parts();
  std::vector<Rotation> partial(parts.solid.chunks.size());
  parallel_for(partial.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = parts.solid.chunks[c];
    const Block& block = parts.block(chunk);
    if (!block.small_strain || !parts.looks_at(c)) return;
    for (Index first = 0; first < chunk.cells; first += block.stages.lanes) {
      const Index count = std::min<Index>(block.stages.lanes, chunk.cells - first), cell = chunk.first + first;
      const CellBatches batch = parts.solid.batches(block, cell, 1);
      const auto follow = [&](const BatchGradients& gradients) {
        follow_rotation(gradients, block.type, block.stages.lanes, static_cast<int>(count), block.first + cell,
                        partial[c]);
      };
      const std::span<const std::uint8_t> own =
          parts.solid.gone_among(block, cell, count, {.history = {}, .alive = alive});
      if (own.empty()) {
        follow(BatchGradients(batch, u.data()));
      } else {
        const CellsApart apart(batch, std::array{u.data()}, own);
        follow(BatchGradients(apart.batch, apart.at[0].data()));
      }
    }
  });
  parts.gather_by_chunk(std::span(partial), &Rotation::angle, &Rotation::cell);
  Rotation largest;
  for (const Rotation& rotation : partial)
    if (rotation.angle > largest.angle) largest = rotation;
  return largest;
}

namespace {

/// Has a chunk one of the sorted positions? All chunks have where there is none.
bool has_any(const Block& block, const Chunk& chunk, std::span<const Index> positions) {
  const Index begin = block.first + chunk.first;
  const auto next = std::ranges::lower_bound(positions, begin);
  return positions.empty() || (next != positions.end() && *next < begin + chunk.cells);
}

std::vector<Index> patches_of(const Solid::Parts& parts, std::span<const Index> cells) {
  std::vector<Index> patches;
  for (const Index k : cells) {
    const std::span<const Index> own = parts.patches.of(at(k));
    patches.insert(patches.end(), own.begin(), own.end());
  }
  std::ranges::sort(patches);
  return patches;
}

}  // namespace

std::vector<std::array<double, 6>> cell_stress(const Solid& solid, std::span<const double> u, const PointStep& step,
                                               std::span<const Index> wanted) {
  const Solid::Parts& parts = solid.parts();
  std::vector<std::array<double, 6>> stress(solid.cells().size());
  parallel_for(parts.solid.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = parts.solid.chunks[c];
    const Block& block = parts.block(chunk);
    if (!block.is_nodal() && has_any(block, chunk, wanted))
      parts.mean_stress(chunk, block, u, step, stress[at(block.first + chunk.first)].data());
  });
  const SolidCells& patches = parts.patches.cells;
  const std::vector<Index> wanted_patches = patches_of(parts, wanted);
  if (parts.patches.empty() || (!wanted.empty() && wanted_patches.empty())) return stress;
  std::vector<double> of_patches(6 * patches.size());
  parallel_for(patches.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = patches.chunks[c];
    const Block& block = patches.blocks[at(chunk.block)];
    if (has_any(block, chunk, wanted_patches))
      block.kernels.mean_stress(patches.batches(chunk, step), block.law(), u.data(),
                                &of_patches[6 * at(block.first + chunk.first)]);
  });
  for (std::size_t k = 0; k < stress.size(); ++k) parts.add_mean_of_patches(k, 6, of_patches, stress[k].data());
  return stress;
}

std::pair<double, std::size_t> largest_stress(const Solid& solid, std::span<const double> u, const PointStep& step,
                                              double (*measure)(const Voigt& stress)) {
  const Solid::Parts& parts = solid.parts();
  using Largest = std::pair<double, std::size_t>;
  if (!parts.patches.empty()) {
    Largest largest{-1.0, 0};
    const std::vector<Voigt> stress = cell_stress(solid, u, step);
    for (std::size_t k = 0; k < stress.size(); ++k)
      if (const double size = measure(stress[k]); size > largest.first) largest = {size, k};
    return largest;
  }
  const auto is_less = [](const Largest& a, const Largest& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::vector<Largest> of_chunk(parts.solid.chunks.size(), {-1.0, 0});
  parallel_for(of_chunk.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = parts.solid.chunks[c];
    const Block& block = parts.block(chunk);
    if (!parts.looks_at(c)) return;
    std::vector<Voigt> stress(at(chunk.cells));
    parts.mean_stress(chunk, block, u, step, stress.front().data());
    for (std::size_t k = 0; k < stress.size(); ++k)
      of_chunk[c] = std::max(of_chunk[c], {measure(stress[k]), at(block.first + chunk.first) + k}, is_less);
  });
  parts.gather_by_chunk(std::span(of_chunk), &Largest::first, &Largest::second);
  return of_chunk.empty() ? Largest{-1.0, 0} : *std::max_element(of_chunk.begin(), of_chunk.end(), is_less);
}

std::vector<double> cell_history(const Solid& solid, std::string_view variable, std::span<const double> history,
                                 OverPoints over) {
  const Solid::Parts& parts = solid.parts();
  const auto position = [&](const Block& block) {
    const std::vector<std::string>& names = block.history_names;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), variable) - names.begin());
  };
  const auto has_it = [&](const Block& block) { return position(block) < block.history_names.size(); };
  if (std::none_of(parts.solid.blocks.begin(), parts.solid.blocks.end(), has_it)) return {};
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
  std::vector<double> means = means_of(parts.solid);
  const std::vector<double> of_patches = means_of(parts.patches.cells);
  for (std::size_t k = 0; k < means.size(); ++k) parts.add_mean_of_patches(k, 1, of_patches, &means[k]);
  return means;
}

std::vector<double> cell_masses(const Solid& solid) {
  const Solid::Parts& parts = solid.parts();
  std::vector<double> masses(solid.cells().size());
  const auto add_up = [&](std::size_t c, std::span<const double> m) { masses[c] = sum_of(m); };
  parts.solid.for_each_lumped_mass([&](std::size_t c, const Block&, std::span<const double> m) { add_up(c, m); });
  parts.solid.for_each_rigid_batch([&](std::size_t first, const Block& block, const CellBatches& batch) {
    block.for_each_lumped_mass(batch, [&](std::size_t lane, std::span<const double> m) { add_up(first + lane, m); });
  });
  return masses;
}

Index first_inverted_cell(const Solid& solid, std::span<const double> u, std::span<const std::uint8_t> alive) {
  std::vector<double> f(solid.dof_count(), 0.0);
  for (std::size_t k = 0; k < solid.cells().size(); ++k) {
    if (!alive.empty() && alive[k] == 0) continue;
    const std::array<Index, 1> one{static_cast<Index>(k)};
    solid.add_internal_force_of(one, u, f);
    bool is_finite = true;
    for (const Index n : solid.cells().nodes_of(k))
      for (std::size_t c = 0; c < 3; ++c) is_finite = is_finite && std::isfinite(f[3 * at(n) + c]);
    if (!is_finite) return one[0];
  }
  return -1;
}

bool has_hourglass(const Solid& solid) {
  const Solid::Parts& parts = solid.parts();
  return parts.solid.have_modes() || !parts.patches.empty();
}

double strain_energy(const Solid& solid, std::span<const double> u) {
  std::vector<double> f(solid.dof_count());
  return solid.evaluate(u, {}, f, {}).strain;
}

double energy_at_rest(const Solid& solid, std::size_t cell, std::span<const Vec3> u) {
  const SolidCells& cells = solid.parts().solid;
  const Block& block = cells.block_of(cell);
  const Index in_block = static_cast<Index>(cell) - block.first, lanes = block.stages.lanes;
  const CellBatches batch = cells.batches(block, in_block / lanes * lanes, 1);
  return 0.5 * stiffness_product(batch, block.kernels, block.law(), in_block % lanes, u);
}

double square_integral(const Solid& solid, std::size_t cell, std::span<const double> f) {
  const SolidCells& cells = solid.parts().solid;
  const Block& block = cells.block_of(cell);
  const NodeMatrix M = block.mass(cells.coordinates_of(cell), block.thickness, 1.0);
  double sum = 0.0;
  for (std::size_t a = 0; a < f.size(); ++a)
    for (std::size_t b = 0; b < f.size(); ++b) sum += M[f.size() * a + b] * f[a] * f[b];
  return sum;
}

}  // namespace carom
