// Rows of the faces of a pair: penetration integrated over the overlaps of facets.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "contact/face_points.hpp"
#include "contact/row_maker.hpp"

namespace carom {

/// One slot per node A of the first surface, by increasing node. At the points q of the overlaps of its facets with
/// those of the other surface (clipping.hpp), clipped once more where the gap changes sign, let
///   g_q  the gap from the slave's point x_s along the normal n_s at its facet's centre to the master's point x_m,
///   s_q  = t^2 (3 - 2 t), t = (c - c_0) / (1 - c_0), c = - n_s . n_m of the two facets' centres, c_0 = 0.2: how much
///          they face each other; pairs of a lesser c do not count,
///   w_q  the area (length times thickness, or 2 pi X) in the reference configuration,
///   N^_A the shape functions of the facet, N_a those of the face of the cell that it is a piece of (ParentFace).
/// With D_A the node's share of its surface (nodal_measures), f(d) and e(d) the force and energy of the contact's
/// spring over its stiffness (RowLaw) the row's depth is the mean
///   d_A: e(d_A) = sum_q w_q N^_A e(<- s_q g_q>) / D_A,  gap = - d_A,
/// the mean square where springs do not harden, and its normal blocks are the gradient of that, the turning of n_s and
/// n_m included, at held weights. A spring eps D_A of every row then is the potential sum_q w_q eps e(<- s g>) itself,
/// since the N^_A add up to 1: uniform pressure gives the consistent nodal forces of both sides, between meshes that
/// match or not, of first and second order (cells' own N_a), and a face that is met somewhere between its nodes is met
/// there. Force and moment of every row are in balance. The limit of friction is mu times sum_q w_q N^_A eps f(<- s g>)
/// (RowLaw::mu is smaller than the contact's by the quotient of that and eps D_A f(d_A)), and it acts at the points of
/// the pressure.
/// Where nothing penetrates, a row within reach is open by the least of s g, over the area that is covered.
///
/// The springs of the points stand against more than the row's own direction: append_stiffness has the parts of the
/// weights 1, x, y and z about each node, orthogonal to that.
///
/// What comes under a facet from the side, deeper than 0.02 facet sizes, does not count there: it is the faces at the
/// side that meet. An overlap that deep counts if it was in front at the beginning of the step, or if a corner of the
/// slave facet was then behind the same facet or one that goes on with it, unless it is ten times as deep as it is
/// wide; in space and at a border of the master, deeper than its width times the larger of 1 and twice the tangent of
/// the angle between the facets. Without a history, at the start, all that is so wide counts, and slivers where the
/// master goes on beside them, but not the far side of a thin part (half_thickness). Points that deep do not count
/// where they stand outside of the other body: the way inward from there enters it, through a facet that shows its
/// back, before it reaches the master. Ends of overlaps at borders of the other surface, where the depth is not zero,
/// move with that: the integral changes by w e(-g~) times the way of the border over the slave, which is part of the
/// gradient (the transport theorem), so that the force is that of the potential there, too. law: that of one pass.
/// (Segments: Puso and Laursen, Comput. Methods Appl. Mech. Engrg. 193, 2004.)
std::unique_ptr<RowMaker> face_rows(const Model& model, const Surface& slave, const Surface& master, bool self,
                                    const ContactLaw& law, Index source);

/// Says which nodes have rows; empty: all have.
using FaceNodes = std::function<bool(Index)>;

/// Makes such rows from points that another finder gives.
std::unique_ptr<RowMaker> face_rows(std::span<const Vec3> X, const Surface& slave,
                                    std::unique_ptr<FacePointFinder> finder, const FaceNodes& has_row,
                                    const ContactLaw& law, Index source);

/// Rows of mean gaps over the same overlaps, which multipliers can hold: one slot per node A of the slave, by
/// increasing node. Points have the gap g along the slave facet's normal where facets face each other within 60
/// degrees, open or not (s = 1), and with D_A = sum_q w N^_A the row has the measure D_A, the gap sum_q w N^_A g_q /
/// D_A and its complete gradient at held weights. Uniform multipliers per area give the consistent nodal forces of both
/// sides, of first and second order, since the N^_A add up to 1: the flat patch test holds between any meshes. Less
/// than 1e-9 of a node's measure has no row, nor has less than a fiftieth that is deeper than a hundredth of the facet
/// size: the depth of a sliver beside a border, which comes in from the side. Which overlaps behind a master facet
/// count is as above. (Puso and Laursen, Comput. Methods Appl. Mech. Engrg. 193, 2004, sections 3 to 5; lumped to one
/// row per node by D_A.) law: that of the contact, halved with `self`.
std::unique_ptr<RowMaker> mean_rows(const Model& model, const Surface& slave, const Surface& master, bool self,
                                    const ContactLaw& law, Index source);

}  // namespace carom
