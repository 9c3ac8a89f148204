// How far off runs may be, judged by other runs alone.
#pragma once

#include <string>
#include <vector>

#include "compare/measure.hpp"

namespace carom::compare {

/// What the runs of a comparison say of each other's errors.
struct Claims {
  double spread = 0.0;      ///< relative L2 difference between enforcements on the finest cells; NaN: one alone
  std::string spread_text;  ///< between which runs; "" where there is none
  std::vector<std::string> missing;  ///< what no run can be judged without, and which option gives it
};

/// Fills Result::claimed and Result::basis of every run that passed its verdict. No run is judged by one that shares
/// its mesh, its step or, where there is contact, its enforcement:
/// - on the finest cells by its own change with the cells. With D the difference to the next coarser run of the same
///   choice, r the ratio of cells and p the order, s D / (r^p - 1) (Roache, Journal of Fluids Engineering 116, 1994):
///   of three meshes or more p is the observed order, from 1/2, as curves that jump have it, to 1, and s = 1.25; where
///   the changes do not fall p = 1/2 and s = 3; of two meshes p = 1 and s = 3;
/// - on coarser cells by its difference to a run on the finest that shares nothing with it, and what that one claims.
/// No claim is below the spread of the enforcements: the largest over two of them of the smallest difference between
/// runs of either on the finest cells; nor, on those, below the smallest difference to any other enforcement. Where
/// a run is named, it takes the place of those that judge, and its own claim counts where it has one.
Claims claim_errors(std::vector<Result>& results, const std::string& quantity);

}  // namespace carom::compare
