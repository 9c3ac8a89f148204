// All kernels of HEXA8 over one number type.
#pragma once

#include "material/linear_elastic_update.hpp"
#include "material/neo_hookean_update.hpp"
#include "solid/hexa8_finite.hpp"
#include "solid/hexa8_small.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

template <class Real>
static constexpr KernelTable make_kernels() {
  return {lanes<Real>,
          hexa8_small::kernels<Real>(),
          hexa8_finite::kernels<Real>(),
          {linear_elastic_update<Real>, linear_elastic_tangent<Real>},
          {neo_hookean_update<Real>, neo_hookean_tangent<Real>}};
}

}  // namespace carom
