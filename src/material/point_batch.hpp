// The buffer where element and material meet: quadrature points of a batch of cells.
#pragma once

namespace carom {

/// Points of one batch, structure of arrays: component c of point p, lane l stands at [(6 p + c) lanes + l] in strain
/// and stress, at [p lanes + l] in energy. Voigt order xx, yy, zz, xy, yz, zx; shear strains are 2 eps_ij. Strain and
/// stress are small strain and Cauchy stress, or Green-Lagrange strain and second Piola-Kirchhoff stress: the
/// kinematics belong to the element. The law fills stress (force per area) and, unless the pointer is null, the stored
/// energy density; laws under zero lateral stress also write the lateral strains that follow from it.
struct PointBatch {
  int points = 0;
  double* strain = nullptr;
  double* stress = nullptr;
  double* energy = nullptr;
};

/// Changes of stress with changes of strain at given strains; layout as in PointBatch.
struct TangentBatch {
  int points = 0;
  const double* strain = nullptr;
  const double* strain_change = nullptr;
  double* stress_change = nullptr;
};

/// The update and the tangent of one law for one lane count; parameters points to what that law expects. They do not
/// allocate.
using BatchUpdate = void (*)(const void* parameters, const PointBatch& batch);
using BatchTangent = void (*)(const void* parameters, const TangentBatch& batch);

/// A law without its parameters.
struct LawKernels {
  BatchUpdate update = nullptr;
  BatchTangent tangent = nullptr;
};

/// A material law as the kernels see it. The tangent is symmetric: every law has a stored energy.
struct BatchLaw {
  BatchUpdate update = nullptr;
  BatchTangent tangent = nullptr;
  const void* parameters = nullptr;
};

}  // namespace carom
