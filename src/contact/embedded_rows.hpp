// Rows of nodes that follow rigid bodies, as rows of these bodies.
#pragma once

#include "model/embedding.hpp"
#include "rows/constraint_rows.hpp"

namespace carom {

/// Gives what the rows see of followers to the nodes that these follow: a block B at a follower becomes the blocks
/// N_a B. Gaps at zero displacement stay, since the motion of a follower is the sum of N_a times that of the others. A
/// row between two faces of one body says nothing and is left out.
void embed(const Embedding& embedding, ConstraintRows& rows);

}  // namespace carom
