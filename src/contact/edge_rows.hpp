// Rows of sharp edges against edges.
#pragma once

#include <memory>

#include "contact/row_maker.hpp"
#include "contact/smooth_surface.hpp"

namespace carom {

/// One row per pair of segments of edges (feature_edges.hpp) of the two surfaces that cross, with the gap, the frame
/// and the blocks of edge_pair.hpp; with `self` every pair once. Its measure is the smaller of both shares of area, its
/// law the contact's own: there is one pass only. Segments that share a node, or of which two facets do, make no pair.
/// h is the larger mean facet size of both surfaces.
///
/// Sharp edges, which turn by more than 5 degrees and which no surface is smooth across (smooth: of the contact, null
/// where it is seen as facets), meet all edges of the other surface but notches: so a ridge is seen by a face that it
/// crosses between two nodes. What counts depends on what holds the rows (see rule_of in
/// meeting_edges.cpp):
///   springs      rows to a gap of h / 4, and behind each other to the least of 3 h / 4 and half of either body's
///                thickness; of those deeper than h / 4 what was behind already. Two sharp edges meet as borders of
///                faces where the contact's rows stand at nodes (rows of overlaps see such faces by themselves).
///                Where cells have gone they have come from the front, since edges that were inside of a body lie
///                behind others at once;
///   impulses     rows to a gap of h, and to the same depth; the factor is no part of the motion;
///   increments   the same, of pairs that have come from the front, as what closes a gap throws out what came deep;
///   multipliers  sharp edges, of more than 30 degrees here, meet those of the other surface where both stick out, and
///                have come from the front: rows of edges that lie nearly flat would depend on those of the faces.
///                A pair that sticks out far enough when the step begins has its row to the end of the step.
/// The diagonals of flat quadrilaterals are edges, too, folds, which sharp edges meet where both stick out: so a ridge
/// is seen by a facet that bends under it. Multipliers of implicit steps meet none.
///
/// From the front come those that
/// - are less than h / 500 deep, or were less deep at the beginning of the step: so those count that have come from the
///   front, at any speed;
/// - are less than h / 20 deep and made no pair there, as their factor was zero: it grows from nothing; or
/// - were behind each other there, or segments were that go on with them along their edges (not round a corner).
/// What is deep for other reasons, having come in sideways, makes no row until it has been in front.
/// Where there is no history, as of what stands still at the start, they count to a depth of h; where one edge alone
/// sticks out, to half of either body's thickness.
///
/// A fixed number of slots per sharp segment (of more pairs the deepest). A pair that was behind at the beginning of
/// the step keeps its slot; the others follow by increasing segment of the second surface. ConstraintRows::facet is
/// that segment.
///
/// Null where there are no two edges to meet: in two dimensions, of bars, and of surfaces without edges.
std::unique_ptr<RowMaker> edge_rows(const Model& model, const PairContact& contact, Index source,
                                    const SmoothSides* smooth);

}  // namespace carom
