// Stiffness of contact, chosen from the materials and the cells behind it.
#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// Chooses the stiffnesses of contact laws that have none, one value per contact, and returns what was chosen, in one
/// sentence each. A facet of a contact surface has the stiffness of the cell behind it in compression,
///   eps = M / h   (stress per length),
/// M the modulus of uniaxial strain (p-wave modulus; plane stress: E / (1 - nu^2); bars: E) of the cell's material, h
/// the cell's extent normal to the facet: the mean distance from it of the corners that are not on it, which is volume
/// / area for cells of constant section, and the height of a tetrahedron (all its mass hangs on what is at that depth);
/// half of it in a quadratic cell, whose layer of nodes is half as thick. A side of a contact has the mean of its
/// facets, weighted by their measures; of a pair only facets count that look at the other side (FacingFacets):
///   - against an obstacle: eps_N = eps of the body, so that the penetration is the shortening of one cell under the
///     contact pressure p, p / M of its height. At M / h central differences keep 0.91 of their stable step in one
///     dimension, and peaks stay near the exact ones; 10 M / h has peaks many times too high;
///   - two sides: eps_N = 2 / (1 / M_1 + 1 / M_2) / min(h_1, h_2), the moduli in series over the finer cell: M / h for
///     equal bodies, at most 2 M of the softer side over h however stiff the other one is. The finer mesh tells how
///     small the region is that is pressed: the springs give as much as that at most. The stable step keeps 0.79.
/// In models with parts of finite strain the springs harden (RowLaw) below 0.75 % of the smallest cell at the
/// contact: what crushes the cells behind by 10, 50 or 300 % of M sinks in by 2.4, 3.7 or 6.3 % of a cell, not by the
/// same 10, 50 or 300 %. Explicit steps follow the slope, and pay for it there and then alone; small-strain bodies,
/// which no such load suits, keep one slope and the step that goes with it. Interfaces have the one or two sides that
/// parts hold. Times ContactLaw::stiffness_factor. With RowMeasure::per_node also times the mean measure of the nodes
/// on the skin of the mesh (facets whose nodes are all on the list; where there are none, those with any node on it).
/// An absent eps_T becomes eps_N where mu > 0, given or chosen: a gap and a slip then cost the same. All is linear in
/// the modulus and inverse in the length, so no unit system matters. Discrete stops have their own stiffness. Throws
/// std::invalid_argument naming the contact where no cell of a part is behind it.
std::vector<std::string> choose_stiffness(Model& model);

/// Chooses the stiffness of ties, where a scheme ties by springs: 1000 times the stiffness of a pair, as no explicit
/// step has to follow them, so that what they give way by is a thousandth of what the cells beside them do.
std::vector<std::string> choose_tie_stiffness(Model& model);

/// Chooses the stiffness of ties that tear: 10 times the stiffness of a pair, so that an intact one gives way by a
/// tenth of what the cells beside it do; more where softening would else be steeper than a fifth of that:
///   k >= 5 S^2 / G  for each strength S with its energy G.
std::vector<std::string> choose_cohesive_stiffness(Model& model);

}  // namespace carom
