// How cells take the deformation of their points.
#pragma once

namespace carom {

/// full: the points of the shape as they are. mean_dilatation: with a volume change that is the cell's mean, or linear
/// in cells of second order (B-bar, F-bar), against locking of nearly incompressible materials. one_point: one point of
/// mean gradients and a stiffness of the hourglass modes, which flows where the law does (kernels/hourglass_flow.hpp).
/// stabilised: one point, and the modes as enhanced assumed strains leave them, in one flow with the point
/// (element/stabilised.hpp). nodal: linear tetrahedra and triangles with one point for each node, of the mean gradients
/// of its cells, in one flow with what these differ by (solid/node_patches.hpp). reduced: two points a direction of
/// cells of second order, which leave some modes of a single cell without a stiffness.
enum class Formulation : unsigned char { full, mean_dilatation, one_point, stabilised, reduced, nodal };

}  // namespace carom
