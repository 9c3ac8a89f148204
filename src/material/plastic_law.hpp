// Von Mises plasticity: what its kernels take.
#pragma once

#include "material/isotropic_elastic.hpp"

namespace carom {

/// A von Mises body of isotropic elasticity. Its Yield gives the yield stress as a function of a few variables of the
/// point, of which the first is the equivalent plastic strain alpha, all 0 at rest, over a number type:
///   variables                              how many, at most most_plastic_variables
///   begin(variables)                       what is asked for at the beginning of a step: `stress`, that of slow flow,
///                                          and what `flow` needs of it
///   flow(begin, three_G, trial, dt, end)   the radial return (RadialReturn) of a step of length dt
///   plastic_work(variables)                all of it per volume since the start
template <class Yield>
struct PlasticLaw {
  LameParameters lame;
  double elastic_limit = 0.0;  ///< equivalent stress below which nothing yields, whatever went before
  Yield yield;
};

inline constexpr int most_plastic_variables = 3;

}  // namespace carom
