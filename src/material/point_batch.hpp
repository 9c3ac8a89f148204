// The buffer where element and material meet: quadrature points of a batch of cells.
#pragma once

// Internal linkage of functions: see math/pack.hpp.
namespace carom {

/// Points of one batch, structure of arrays: component c of n of point p, lane l stands at [(n p + c) lanes + l]; n is
/// 6 for strain and stress, the law's number of history variables for history and new_history, 1 for the rest. Voigt
/// order xx, yy, zz, xy, yz, zx; shear strains are 2 eps_ij. Strain and stress are small strain and Cauchy stress, or
/// Green-Lagrange strain and second Piola-Kirchhoff stress: the kinematics belong to the element. The law fills stress
/// (force per area) and, where the pointer is not null, the rest; laws under zero lateral stress also write the lateral
/// strains that follow from it. The history is that at the beginning of the step of length dt, and its end may not
/// stand in the same place; a null history is that of the body at rest.
struct PointBatch {
  int points = 0;
  double* strain = nullptr;
  double* stress = nullptr;
  double* energy = nullptr;  ///< stored energy density, per reference volume
  double dt = 0.0;
  const double* history = nullptr;
  double* new_history = nullptr;
  double* dissipation = nullptr;   ///< dissipated energy density since the start, a function of the history at the end
  double* wave_modulus = nullptr;  ///< at least the largest rho c^2 of elastic waves, c in current lengths per time and
                                   ///< rho per reference volume; zero lateral stress makes them slower still
  /// Laws with a history fill yield_stress and share, those that never yield by leave_modes_elastic().
  double* yield_stress = nullptr;  ///< equivalent stress of slow flow at the beginning of the step
  /// Cells whose hourglass modes flow with their point: the square by which these raise the equivalent trial stress,
  /// and the share of the trial deviator that is left, which is the modes' too.
  const double* mode_square = nullptr;
  double* share = nullptr;
  /// The history is that at the end of the step already: nothing flows any more, and the stress is the step's.
  bool is_over = false;
};

/// Changes of stress with changes of strain at given strains and history at the beginning of the step; layout as in
/// PointBatch.
struct TangentBatch {
  int points = 0;
  const double* strain = nullptr;
  const double* strain_change = nullptr;
  double* stress_change = nullptr;
  double dt = 0.0;
  const double* history = nullptr;
  /// As in PointBatch, and half the change of it. What comes back: the changes of the modes' forces are `share` times
  /// those of the trial ones and `along` times the trial ones.
  const double* mode_square = nullptr;
  const double* half_change = nullptr;
  double* share = nullptr;
  double* along = nullptr;
};

inline constexpr double never_yields = 1e150;  // its square is a number

static inline void fill_all(double* values, int count, double value) {
  for (int i = 0; values != nullptr && i < count; ++i) values[i] = value;
}

/// What a law with a history that never yields says of hourglass modes. count: points times lanes.
static inline void leave_modes_elastic(const PointBatch& batch, int count) {
  fill_all(batch.yield_stress, count, never_yields);
  fill_all(batch.share, count, 1.0);
}
static inline void leave_modes_elastic(const TangentBatch& batch, int count) {
  fill_all(batch.share, count, 1.0);
  fill_all(batch.along, count, 0.0);
}

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
