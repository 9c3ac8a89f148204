// The buffer where element and material meet: quadrature points of a batch of cells.
#pragma once

namespace carom {

/// Points of one batch, structure of arrays: component c of point p, lane l stands at [(6 p + c) lanes + l] in strain
/// and stress, at [p lanes + l] in energy. Voigt order xx, yy, zz, xy, yz, zx; shear strains are 2 eps_ij.
/// The law fills stress (force per area) and, unless the pointer is null, the stored energy density.
struct PointBatch {
  int points = 0;
  const double* strain = nullptr;
  double* stress = nullptr;
  double* energy = nullptr;
};

/// The update of one law for one lane count; parameters points to what that law expects. Does not allocate.
using BatchUpdate = void (*)(const void* parameters, const PointBatch& batch);

}  // namespace carom
