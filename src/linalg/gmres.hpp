// Generalised minimal residuals for an operator given as a function.
#pragma once

#include <functional>
#include <span>

#include "linalg/conjugate_gradients.hpp"

namespace carom {

/// Overwrites v by B v, B near to the inverse of the operator.
using Preconditioner = std::function<void(std::span<double> v)>;

/// GMRES with the preconditioner on the right (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 1986; Saad, Iterative
/// Methods for Sparse Linear Systems, 2nd ed., algorithm 9.5), from x = 0 until |b - A x|_2 <= relative |b|_2, at most
/// ten times that by what rounding has made of it. False when it is not there after `most` iterations, or not a digit
/// nearer after half of them. Same bits for any thread count.
bool gmres(const LinearOperator& A, const Preconditioner& precondition, std::span<const double> b, std::span<double> x,
           double relative, int most);

}  // namespace carom
