// All kernels over one number type.
#pragma once

#include "element/cells.hpp"
#include "kernels/bulk_stages.hpp"
#include "kernels/cell_stages.hpp"
#include "kernels/hexa8_finite.hpp"
#include "kernels/hexa8_small.hpp"
#include "kernels/kernels.hpp"
#include "kernels/mean_dilatation.hpp"
#include "kernels/patch_stages.hpp"
#include "kernels/point_stages.hpp"
#include "kernels/power_bound.hpp"
#include "material/law_table.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

template <class Real>
static constexpr KernelTable make_kernels() {
#define CAROM_CELL_STAGES(cell) cell_stages<Real, cell##Cell>(),
  return {
      lanes<Real>,
      hexa8_small::kernels<Real>(),
      hexa8_finite::kernels<Real>(),
      {CAROM_CELLS(CAROM_CELL_STAGES)},
      {PatchStages<Real, Tetra4Cell>::stages(), PatchStages<Real, Tria3PlaneCell>::stages(),
       PatchStages<Real, Tria3RingCell>::stages()},
      small_stages::stages<Real>(),
      finite_stages::stages<Real>(),
      {small_dilatation::stages<Real, MeanVolume>(), small_dilatation::stages<Real, LinearVolume<Quad8>>(),
       small_dilatation::stages<Real, LinearVolume<Hexa20>>(), small_dilatation::stages<Real, LinearVolume<Penta15>>(),
       small_dilatation::stages<Real, LinearVolume<Pyra13>>()},
      {finite_dilatation::stages<Real, MeanVolume>(), finite_dilatation::stages<Real, LinearVolume<Quad8>>(),
       finite_dilatation::stages<Real, LinearVolume<Hexa20>>(),
       finite_dilatation::stages<Real, LinearVolume<Penta15>>(),
       finite_dilatation::stages<Real, LinearVolume<Pyra13>>()},
      small_bulk_stages<Real>(),
      finite_bulk_stages<Real>(),
      make_law_table<Real>(),
      power_bound<Real>};
#undef CAROM_CELL_STAGES
}

}  // namespace carom
