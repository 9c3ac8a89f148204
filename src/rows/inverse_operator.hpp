// The inverse of an operator, as two functions.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "linalg/half_solution.hpp"

namespace carom {

/// A^-1. The result is zero on fixed dofs, whatever the right-hand side has there.
struct InverseOperator {
  /// Overwrites the dof vectors b (columns of them, stored one after the other) by A^-1 b.
  std::function<void(std::span<double> b, int columns)> solve;
  /// Gives Y for sparse dof vectors B, with B^T A^-1 B = Y^T Y; empty where A has no factors L L^T.
  std::function<std::vector<HalfPanel>(const SparseColumns& B)> half{};
};

}  // namespace carom
