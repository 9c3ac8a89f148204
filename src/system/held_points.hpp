// Which points of the levels of multigrid each rank holds.
#pragma once

#include "linalg/block_matrix.hpp"
#include "parallel/holding.hpp"

namespace carom {

/// Of the coarse points, a rank holds its own, those of the rows of A that are its own, and those that its own fine
/// points are interpolated from; all ranks hold those that what all of them hold is interpolated from, such as contact.
/// Where every rank holds all fine points it holds all coarse ones.
Holding held_coarse_points(const Holding& fine, const Interpolation& P, const BlockMatrix& A);

/// The fine points that a rank restricts to its own coarse ones.
Holding restricted_points(const Holding& fine, const Interpolation& P);

}  // namespace carom
