// Fill-reducing order of a sparse symmetric matrix.
#pragma once

#include <vector>

#include "linalg/csr_matrix.hpp"

namespace carom {

/// Order of elimination (0-based: entry k is the row that comes k-th) by METIS' nested dissection of the pattern
/// (Karypis and Kumar, SIAM J. Sci. Comput. 20, 1998), through CHOLMOD. Reads the lower triangle. The same on every
/// call and for any number of threads. Throws std::runtime_error when memory runs out.
std::vector<Index> nested_dissection(const CsrMatrix& A);

}  // namespace carom
