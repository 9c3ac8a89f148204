// Rows of surface-to-surface contact, integrated on the overlaps of facets.
#pragma once

#include <memory>

#include "contact/row_maker.hpp"

namespace carom {

/// One slot per slave node A, by increasing node. Points q on the overlaps of the slave facets with master facets that
/// face them within 60 degrees (clipping.hpp) have the slave facet's normal n_q at its centre and the gap g_q along it;
/// the weight w is that of the reference configuration: the current area times (reference area / current area) of the
/// slave facet, times thickness (plane) or 2 pi X (axisymmetric). With the master's normal n_m under the point,
/// m = n_m / (n_m . n_q), which is n_q where the surfaces are parallel, and with
///   D_A = sum_q w N_A,   g_A = sum_q w N_A g_q / D_A,   n_A = - sum_q w N_A m / |...|
/// the row has the measure D_A, the gap g_A, the frame (n_A, t_1, t_2) and the blocks
///   slave b:  sum_q w N_A N_b (-m, t_1, t_2) / D_A + sum_q w N_A g_q ((m, -t_1, -t_2) . turn_b) n_q / D_A
///   master c: sum_q w N_A N_c (m, -t_1, -t_2) / D_A
/// with turn_b = a^alpha N_b,alpha at the slave facet's centre, a^alpha the dual base of its tangents: the slave's
/// normal turns by dn_q = - sum_b turn_b (n_q . du_b). The normal row is the gradient of g_A at points that stay where
/// they are on the slave, at every angle between the surfaces; what the rims of the overlaps add is left out. Forces
/// and moments of every row are in balance at every gap. (Puso and Laursen, Comput. Methods Appl. Mech. Engrg. 193,
/// 2004, sections 3 to 5; lumped to one row per node by D_A.) Flat meshes transfer uniform pressure exactly: sum_A D_A
/// (row) gives the consistent nodal forces of both sides, covered parts of facets included. Nodes of which less than
/// 1e-6 is covered have no row.
///
/// With h the larger mean facet size of both surfaces: overlaps count to a gap of 1.5 h, and rows are made where one
/// comes within h. Behind a master facet they count to h, with `self` to half_thickness with limit h; deeper when they
/// were in front at the beginning of the step, or a node of the slave facet was behind the master then. Where a slave
/// facet has several masters in line, the nearest counts. law: that of the contact, halved with `self`.
std::unique_ptr<RowMaker> mortar_rows(const Model& model, const PairContact& contact, const ContactLaw& law,
                                      Index source);

}  // namespace carom
