// What strikes in the numbers of a comparison and does not explain itself.
#pragma once

#include <string>
#include <vector>

#include "compare/measure.hpp"

namespace carom::compare {

/// What is said about variants.
struct Remark {
  std::string variants;  ///< labels, separated by semicolons
  std::string text;
};

/// Runs whose curves are the same, to 1e-6 of the quantity that variants are ranked by or to the bit, and why: what
/// they have in common, and which of their choices changes nothing.
std::vector<Remark> equal_runs(const std::vector<Result>& results, const std::string& quantity);

/// Series along cells and step whose error grows with the last refinement, or falls with less than half of the order
/// that it fell with at first.
std::vector<Remark> worsening_orders(const std::vector<Result>& results, const std::string& quantity);

}  // namespace carom::compare
