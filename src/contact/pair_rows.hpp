// Rows of pairs of deformable surfaces.
#pragma once

#include <memory>

#include "contact/row_maker.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

/// Makes the row maker of a pair of deformable surfaces.
///
/// Nodes against facets (node_to_surface; the ends of bars against facets whatever the method is): one slot per slave
/// node, by increasing node; its measure is the node's share of the slave surface (nodal_measures). The row stands
/// where SurfaceSearch finds the node on the master, within the larger mean facet size h of both surfaces and as deep
/// as that; with `self` half_thickness deep, with limit h. With the facets f that it meets (one, or several beside
/// edges, of weights w_f that add up to 1) the slave node has the block (grad g, t_1, t_2), master node a the sum over
/// f of
///   (grad_a g, -w_f N_a t_1, -w_f N_a t_2) + w_f g_f (0, t_1 . a^alpha, t_2 . a^alpha) N_a,alpha n_f
/// with a^alpha the dual base of the facet's tangents: the tangential motion is that of the node relative to the
/// turning facet's projected point, and tangential forces act on both sides at one point, so that no moment is left
/// across a gap (Wriggers, Computational Contact Mechanics, 2nd ed., section 4.1). Only beside edges, where the normal
/// is within 6 degrees of the facet's plane, is the term left out; those rows are open. In two dimensions it concerns
/// the tangent in the plane.
///
/// two_pass: the same in both directions, slots of the master nodes after those of the slave nodes. Here and with
/// `self`, where both sides' nodes are slaves, every row has half of the law's stiffness.
///
/// surface_to_surface: see mean_rows in face_rows.hpp. faces: face_rows there and nodes of sharp edges, in both
/// directions (springs; sharp_nodes.hpp); mean_rows and nodes of both sides with an allowance (other enforcements).
///
/// Whatever the method, the sharp edges of solids have rows with edges, in slots after these: see edge_rows.hpp.
///
/// Ends of bars against ends of bars: fixed rows. Every end has the nearest master end that points against it, in the
/// reference configuration; the normal is that end's outward direction there, the measure the area of the section.
///
/// Throws std::invalid_argument naming the contact when the master consists of the ends of bars and the slave does not.
std::unique_ptr<RowMaker> pair_rows(const Model& model, const PairContact& contact, Index source);

/// Rows by springs against a rigid master, whose faces have no cells and may be of any size: those of `faces` one way,
/// from the slave alone, which sees all of the overlaps, and whole; nodes of sharp edges of both sides, which stand for
/// no more than a facet of the slave; and edges with edges.
std::unique_ptr<RowMaker> rigid_pair_rows(const Model& model, const PairContact& contact, Index source);

}  // namespace carom
