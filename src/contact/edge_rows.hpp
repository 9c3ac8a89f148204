// Rows of sharp edges against sharp edges.
#pragma once

#include <memory>

#include "contact/row_maker.hpp"

namespace carom {

/// One row per pair of segments of sharp edges (feature_edges.hpp) of the two surfaces that cross, with the gap, the
/// frame and the blocks of edge_pair.hpp; with `self` every pair once, the lower number first. Its measure is the
/// smaller of both shares of area, its law the contact's own: there is one pass only. The factor moves with the pair
/// where the contact has springs (ContactLaw::eps_N), and is held where it has none. Segments that share a node, or of
/// which two facets do, make no pair.
///
/// With h the larger mean facet size of both surfaces rows are made to a gap of h. Behind each other edges count that
/// - are less than h / 500 deep, or were less deep at the beginning of the step: so those count that have come from the
///   front, at any speed;
/// - are less than h / 20 deep and made no pair there, as their factor was zero: it grows from nothing; or
/// - were behind each other there, or segments next to them were.
/// What is deep for other reasons, having come in sideways, makes no row until it has been in front.
/// Where there is no history, as of what stands still at the start, they count to a depth of h.
///
/// Four slots per segment of the first surface (of more pairs the deepest). A pair that was behind at the beginning of
/// the step keeps its slot; the others follow by increasing segment of the second surface. ConstraintRows::facet is
/// that segment.
///
/// Null where there are no two sharp edges to meet: in two dimensions, of bars, and of smooth surfaces.
std::unique_ptr<RowMaker> edge_rows(const Model& model, const PairContact& contact, Index source);

}  // namespace carom
