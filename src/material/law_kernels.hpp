// Laws with the parameters of a part, as the batch kernels take them.
#pragma once

#include <array>
#include <memory>

#include "material/law_list.hpp"
#include "material/point_batch.hpp"

namespace carom {

/// The kernels of the laws for one number type (material/law_table.hpp).
struct LawTable {
  std::array<LawKernels, law_count> laws;  ///< in the order of laws()
  LawKernels loaded;                       ///< those of libraries (material/loaded_update.hpp)
  LawKernels damaged;                      ///< any of those that yield, with damage (material/damaged_update.hpp)
  LawKernels lateral;                      ///< any of them under zero lateral stress (material/lateral_update.hpp)
};

/// A law with the parameters of a part.
struct PreparedLaw {
  LawKernels kernels;
  std::shared_ptr<const void> parameters;
  int history = 0;  ///< variables of a point, all 0 at rest

  BatchLaw batch() const { return {kernels.update, kernels.tangent, parameters.get()}; }
};

/// The material's law with no stress in the last `free_directions` of x, y, z: 0 in solids, plane strain and
/// axisymmetric bodies, 1 under plane stress, 2 in bars along x.
PreparedLaw prepare(const Material& material, int free_directions, const LawTable& table);

}  // namespace carom
