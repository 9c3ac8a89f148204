// Rows of surface-to-surface contact, integrated on the overlaps of facets.
#pragma once

#include <memory>

#include "contact/row_maker.hpp"

namespace carom {

/// One slot per slave node A, by increasing node. Points q on the overlaps of the slave facets with master facets that
/// face them (clipping.hpp) have the slave facet's normal n_q at its centre and the gap g_q along it; the weight w is
/// that of the reference configuration: the current area times (reference area / current area) of the slave facet,
/// times thickness (plane) or 2 pi X (axisymmetric). With
///   D_A = sum_q w N_A,   g_A = sum_q w N_A g_q / D_A,   n_A = - sum_q w N_A n_q / |...|
/// the row has the measure D_A, the gap g_A, the frame (n_A, t_1, t_2) and the blocks
///   slave b:  sum_q w N_A N_b (-n_q, t_1, t_2) / D_A - (0, t_i . sum_q w N_A g_q a^alpha N_b,alpha) n_q / D_A
///   master c: sum_q w N_A N_c (n_q, -t_1, -t_2) / D_A
/// with a^alpha the dual base of the slave's tangents. At every point both sides' forces act on one line (normal), or
/// the slave facet is turned so that they do (tangential): forces and moments are in balance at every gap. (Puso and
/// Laursen, Comput. Methods Appl. Mech. Engrg. 193, 2004, sections 3 to 5; lumped to one row per node by D_A.) The
/// normal rows are the gradient of g_A where both surfaces are flat and parallel; otherwise they leave out how the
/// points slide and the normals turn, terms of the order of the gap and of the angle between the surfaces. Flat meshes
/// transfer uniform pressure exactly: sum_A D_A (row) gives the consistent nodal forces of both sides, covered parts of
/// facets included. Nodes of which less than 1e-6 is covered have no row.
///
/// With h the larger mean facet size of both surfaces: overlaps count to a gap of 1.5 h, and rows are made where one
/// comes within h. Behind a master facet they count to h, with `self` to half_thickness with limit h; deeper when they
/// were in front at the beginning of the step. Where a slave facet has several masters in line, the nearest counts.
/// law: that of the contact, halved with `self`.
std::unique_ptr<RowMaker> mortar_rows(const Model& model, const PairContact& contact, const ContactLaw& law,
                                      Index source);

}  // namespace carom
