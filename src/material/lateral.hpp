// Laws under zero lateral stress: plane stress and bars, from the laws in three dimensions.
#pragma once

#include "material/isotropic_elastic.hpp"
#include "material/point_batch.hpp"

namespace carom {

/// The same isotropic strain in the last `count` directions (1: zz, plane stress; 2: yy and zz, a bar along x) that
/// makes the stress there vanish, the other strains given.
/// Hooke and St. Venant-Kirchhoff: e = -lambda tr(others) / (2 G + count lambda).
double lateral_strain_linear(const LameParameters& lame, const double strain[6], int count);
/// Neo-Hookean: the root y = ln(1 + 2 e) of G (exp(y) - 1) + lambda/2 (ln D + count y) = 0, D the determinant of the
/// other part of C, by Newton's method (convex and increasing in y: it always converges).
double lateral_strain_neo_hookean(const LameParameters& lame, const double strain[6], int count);

/// The laws with their lateral stresses eliminated, over plain double; parameters: const LameParameters*.
LawKernels plane_stress_linear();
LawKernels plane_stress_neo_hookean();
LawKernels bar_linear();
LawKernels bar_neo_hookean();

}  // namespace carom
