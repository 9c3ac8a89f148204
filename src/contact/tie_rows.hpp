// Rows of ties: bonds between the nodes of one surface and the facets of another.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/row_maker.hpp"

namespace carom {

/// One bond per slave node that is within TieContact::tolerance times the size of its nearest master facet (square root
/// of its area, or its length), in the reference configuration (node_to_surface); the same at every displacement:
///   w = u_s - sum over a of W_a u_a,  sum of W_a = 1,  sum of W_a X_a = X_s.
/// W are the facet's shape functions at the nearest point. What the node is away from there is made up for by the least
/// change of weights over all nodes of the cell behind the facet that does so. So any motion that is affine in X, rigid
/// ones above all, leaves w at zero, and the forces of a row have neither resultant nor moment however far the bodies
/// turn. Nodes that belong to the facet need no row. The normal of a row is that of the facet, its measure the node's
/// share of the slave surface.
///
/// surface_to_surface: the rows of mean_rows instead, made in the reference configuration: w of row A is the mean
/// over the overlaps, with the weight N_A, of what the sides part by,
///   w = sum over b of S_b u_b - sum over a of W_a u_a,  both sums of weights 1,
/// made up in the same way for what the surfaces are apart. Uniform tractions pass exactly. Nodes are too far away of
/// which nothing is covered by the master, or which are farther than the tolerance in the mean.
///
/// Says in notes how many nodes were left free (FarNodes::leave). Throws std::invalid_argument naming the contact where
/// nodes are too far away (FarNodes::refuse), and where none is tied.
std::unique_ptr<RowMaker> tie_rows(const Model& model, const TieContact& contact, Index source,
                                   std::vector<std::string>& notes);
/// The nodes of the slave that are near enough to the master to be tied by node_to_surface, in increasing order.
std::vector<Index> nodes_near_master(std::span<const Vec3> X, const TieContact& contact);
/// The places of a tie that tears, as those of a cohesive zone; ConstraintRows::facet of mortar rows is that of the
/// master nearest to their place.
std::vector<CohesiveRow> cohesive_rows(const Model& model, const TieContact& contact, std::vector<std::string>& notes);

}  // namespace carom
