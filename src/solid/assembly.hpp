// Sparse matrices from cell matrices.
#pragma once

#include <span>

#include "linalg/csr_matrix.hpp"
#include "solid/blocks.hpp"

namespace carom {

/// Empty matrix (zero values) whose entries are the pairs of nodes that share a solid cell or one of the links.
CsrMatrix node_graph(std::span<const SolidCells* const> solids, std::span<const std::vector<Index>> links = {});

/// The same graph with 3 x 3 entries per pair of nodes; row 3 n + i is component i of node n.
CsrMatrix dof_graph(const CsrMatrix& nodes);

/// Adds to the diagonal entry, which rows without entries are given.
void add_diagonal(CsrMatrix& matrix, Index row, double value);

/// Gives a row without entries its diagonal entry.
void append_diagonal(CsrMatrix& matrix, Index row, double value);

/// Position in `matrix` of the entry (row, column), which must exist.
std::size_t entry(const CsrMatrix& matrix, Index row, Index column);

}  // namespace carom
