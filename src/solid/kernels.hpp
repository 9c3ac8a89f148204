// The batch kernels of the HEXA8 solid, compiled once per instruction set.
#pragma once

#include "base/types.hpp"
#include "material/point_batch.hpp"

namespace carom {

/// Cells of one material, `lanes` of them per batch. offset[(8 b + a) lanes + l] is 3 x the node number of local node a
/// of cell b lanes + l. The last batch is filled up by repeating its last cell; such lanes are never written back.
struct CellBatches {
  const double* x = nullptr;  ///< coordinates, 3 per node
  const Index* offset = nullptr;
  Index cells = 0;
};

/// A material law as the kernels see it.
struct BatchLaw {
  BatchUpdate update = nullptr;
  const void* parameters = nullptr;
};

/// The kernels of one instruction set. None of them allocates.
struct KernelTable {
  int lanes = 1;
  /// f += integral of B^T sigma(B u) over the cells, dof vectors of 3 per node.
  void (*add_internal_force)(const CellBatches&, const BatchLaw&, const double* u, double* f) = nullptr;
  /// Sum over the cells of the integral of the stored energy density.
  double (*strain_energy)(const CellBatches&, const BatchLaw&, const double* u) = nullptr;
  /// stress[6 cell + c] = volume mean of the stress.
  void (*mean_stress)(const CellBatches&, const BatchLaw&, const double* u, double* stress) = nullptr;
  BatchUpdate linear_elastic = nullptr;
};

const KernelTable& kernels_reference();
const KernelTable& kernels_v2();
const KernelTable& kernels_v3();
const KernelTable& kernels_v4();

}  // namespace carom
