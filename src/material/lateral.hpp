// Laws under zero lateral stress, plane stress and bars: what belongs to no number type.
#pragma once

#include <memory>

#include "material/isotropic_elastic.hpp"
#include "material/point_batch.hpp"

namespace carom {

/// A law whose stress in the last `free_directions` (1: zz, plane stress; 2: yy and zz, a bar along x) vanishes: the
/// parameters of the kernels in material/lateral_update.hpp.
struct LateralLaw {
  LawKernels kernels;                  ///< of the law in three dimensions
  const void* parameters = nullptr;    ///< of the same
  std::shared_ptr<const void> holder;  ///< keeps them
  double (*lateral_strain)(const void* parameters, const double strain[6], int count) = nullptr;
  int free_directions = 1;
  int history = 0;            ///< variables of the law in three dimensions
  int total_history = 0;      ///< with the lateral strain, where it is iterated for
  double least_strain = 0.0;  ///< lateral strains are above it
};

/// The same isotropic strain in the last `count` directions that makes the stress there vanish, the other strains
/// given; parameters: const LameParameters*.
/// Hooke and St. Venant-Kirchhoff: e = -lambda tr(others) / (2 G + count lambda).
double lateral_strain_linear(const void* parameters, const double strain[6], int count);
/// Neo-Hookean: the root y = ln(1 + 2 e) of G (exp(y) - 1) + lambda/2 (ln D + count y) = 0, D the determinant of the
/// other part of C, by Newton's method (convex and increasing in y: it always converges).
double lateral_strain_neo_hookean(const void* parameters, const double strain[6], int count);

}  // namespace carom
