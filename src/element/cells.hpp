// The classes of the kinds of cells (element/cell_list.hpp).
#pragma once

#include "element/cell_list.hpp"
#include "element/cell_operators.hpp"
#include "element/composite_tetra.hpp"
#include "element/hexa8_one_point.hpp"
#include "element/shapes/hexa20.hpp"
#include "element/shapes/hexa27.hpp"
#include "element/shapes/hexa8.hpp"
#include "element/shapes/penta15.hpp"
#include "element/shapes/penta6.hpp"
#include "element/shapes/pyra13.hpp"
#include "element/shapes/pyra5.hpp"
#include "element/shapes/quad4.hpp"
#include "element/shapes/quad8.hpp"
#include "element/shapes/tetra4.hpp"
#include "element/shapes/tria3.hpp"
#include "element/shapes/tria6.hpp"
#include "element/stabilised.hpp"

namespace carom {

using Tetra4Cell = Isoparametric<Tetra4, Frame::solid>;
using Quad4PlaneCell = Isoparametric<Quad4, Frame::plane>;
using Quad4PlaneOnePointCell = MeanGradientCell<Quad4PlaneCell>;
using Quad4PlaneStabilisedCell = Quad4Stabilised<Quad4PlaneOnePointCell>;
using Quad4RingCell = Isoparametric<Quad4, Frame::axisymmetric>;
using Quad4RingOnePointCell = MeanGradientCell<Quad4RingCell>;
using Quad4RingStabilisedCell = Quad4Stabilised<Quad4RingOnePointCell>;
using Tria3PlaneCell = Isoparametric<Tria3, Frame::plane>;
using Tria3RingCell = Isoparametric<Tria3, Frame::axisymmetric>;
using Penta6Cell = Isoparametric<Penta6, Frame::solid>;
using Pyra5Cell = Isoparametric<Pyra5, Frame::solid>;
using Penta15Cell = Isoparametric<Penta15, Frame::solid>;
using Pyra13Cell = Isoparametric<Pyra13, Frame::solid>;
using Hexa20Cell = Isoparametric<Hexa20, Frame::solid>;
using Hexa20ReducedCell = Isoparametric<ReducedHexa20, Frame::solid>;
using Hexa27Cell = Isoparametric<Hexa27, Frame::solid>;
using Quad8PlaneCell = Isoparametric<Quad8, Frame::plane>;
using Quad8PlaneReducedCell = Isoparametric<ReducedQuad8, Frame::plane>;
using Quad8RingCell = Isoparametric<Quad8, Frame::axisymmetric>;
using Quad8RingReducedCell = Isoparametric<ReducedQuad8, Frame::axisymmetric>;
using Tria6PlaneCell = Isoparametric<Tria6, Frame::plane>;
using Tria6RingCell = Isoparametric<Tria6OfRing, Frame::axisymmetric>;

}  // namespace carom
