// The laws there are: one line each.
#pragma once

#include <cstddef>

#include "material/law.hpp"

/// For X(law): law_row() gives its row, defined in a source file of its own; law_kernels<Real>() its kernels, defined
/// in a header that material/law_table.hpp includes.
#define CAROM_LAWS(X)     \
  X(linear_elastic)       \
  X(st_venant_kirchhoff)  \
  X(neo_hookean)          \
  X(j2_small_strain)      \
  X(j2)                   \
  X(johnson_cook)         \
  X(j2_rate_small_strain) \
  X(j2_rate)              \
  X(swift_small_strain)

namespace carom {

#define CAROM_DECLARE_LAW(law) Law law##_row();
CAROM_LAWS(CAROM_DECLARE_LAW)
#undef CAROM_DECLARE_LAW

#define CAROM_LAW_PLACE(law) law,
enum class LawPlace : std::size_t { CAROM_LAWS(CAROM_LAW_PLACE) count };
#undef CAROM_LAW_PLACE
inline constexpr auto law_count = static_cast<std::size_t>(LawPlace::count);

}  // namespace carom
