#include "compare/curve_colours.hpp"

#include <algorithm>
#include <string>

namespace carom::compare {

namespace {

/// The number of each of the names in the order in which they come.
std::vector<std::size_t> numbered(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  std::vector<std::size_t> numbers;
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    numbers.push_back(static_cast<std::size_t>(found - known.begin()));
    if (found == known.end()) known.push_back(name);
  }
  return numbers;
}

}  // namespace

std::vector<std::size_t> curve_colours(const std::vector<Result>& results) {
  std::vector<std::string> schemes, enforcements, labels;
  for (const Result& r : results) {
    schemes.push_back(r.variant.scheme);
    enforcements.push_back(r.variant.enforcement);
    labels.push_back(r.variant.label);
  }
  for (const auto* names : {&schemes, &enforcements}) {
    const std::vector<std::size_t> numbers = numbered(*names);
    if (std::any_of(numbers.begin(), numbers.end(), [](std::size_t n) { return n > 0; })) return numbers;
  }
  return numbered(labels);
}

}  // namespace carom::compare
