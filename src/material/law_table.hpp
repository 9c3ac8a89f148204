// The kernels of all laws over one number type.
#pragma once

#include "material/damaged_update.hpp"
#include "material/lateral_update.hpp"
#include "material/law_kernels.hpp"
#include "material/law_list.hpp"
#include "material/linear_elastic_update.hpp"
#include "material/loaded_update.hpp"
#include "material/neo_hookean_update.hpp"
#include "material/plastic_finite_update.hpp"
#include "material/swift_small_strain_update.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

template <class Real>
static constexpr LawTable make_law_table() {
#define CAROM_LAW_KERNELS(law) law##_kernels<Real>(),
  return {{CAROM_LAWS(CAROM_LAW_KERNELS)}, loaded_kernels<Real>(), damaged_kernels<Real>(), lateral_kernels<Real>()};
#undef CAROM_LAW_KERNELS
}

}  // namespace carom
