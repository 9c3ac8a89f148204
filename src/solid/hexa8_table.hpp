// All kernels of HEXA8 over one number type.
#pragma once

#include "material/law_table.hpp"
#include "solid/hexa8_finite.hpp"
#include "solid/hexa8_small.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

template <class Real>
static constexpr KernelTable make_kernels() {
  return {lanes<Real>, hexa8_small::kernels<Real>(), hexa8_finite::kernels<Real>(), make_law_table<Real>()};
}

}  // namespace carom
