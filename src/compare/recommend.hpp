// Which variant to take, and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/claims.hpp"

namespace carom::compare {

/// An error of at most this times the smallest is as good, and the cheaper variant is taken.
constexpr double as_good = 1.25;
/// Costs that differ by less are the same: processor times of one computation scatter by some ten percent.
constexpr double cheaper = 1.25;

/// A smallest error above this is no measure of a good choice: the curves differ by a quarter of what they are.
constexpr double largest_error = 0.25;

struct Recommendation {
  std::optional<std::size_t> result;  ///< position of the recommended variant
  std::string headline;
  std::vector<std::string> reasons;  ///< sentences with numbers
};

/// Among the variants that passed every item of their verdict: the one of the smallest L2 error of `quantity`, against
/// the exact solution, or else of the smallest claim (claims.hpp); or, if any takes `cheaper` times less processor time
/// and has an error of at most `as_good` times the smallest, the one of those that takes least. None where nothing is
/// claimed, or the smallest is above `largest_error`.
Recommendation recommend(const std::vector<Result>& results, const std::string& quantity, ReferenceKind reference,
                         const Claims& claims);

}  // namespace carom::compare
