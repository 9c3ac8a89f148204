// Which variant to take, and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/measure.hpp"

namespace carom::compare {

/// An error of at most this times the smallest is as good, and the cheaper variant is taken.
constexpr double as_good = 1.25;
/// Costs that differ by less are the same: processor times of one computation scatter by some ten percent.
constexpr double cheaper = 1.25;

/// A smallest error above this is no measure of a good choice: the curves differ by a quarter of what they are.
constexpr double largest_error = 0.25;
/// Nor is a difference to a run above `small_error` that does not fall on finer meshes: an order below this.
constexpr double small_error = 0.1, least_order = 0.2;

struct Recommendation {
  std::optional<std::size_t> result;  ///< position of the recommended variant
  std::string headline;
  std::vector<std::string> reasons;  ///< sentences with numbers
};

/// Among the variants that were compared and passed every item of their verdict: the one of the smallest
/// L2 error of `quantity`; or, if any takes `cheaper` times less processor time and has an error of at most `as_good`
/// times the smallest, the one of those that takes least. None where the smallest error is above `largest_error`, or
/// above `small_error` without falling with the cells.
Recommendation recommend(const std::vector<Result>& results, const std::string& quantity, ReferenceKind reference);

}  // namespace carom::compare
