#include "compare/curve_colours.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace carom::compare::compare_curve_colours_test {
namespace {

std::vector<Result> results_of(const std::vector<std::vector<std::string>>& variants) {
  std::vector<Result> results(variants.size());
  for (std::size_t i = 0; i < variants.size(); ++i) {
    results[i].variant.scheme = variants[i][0];
    results[i].variant.enforcement = variants[i][1];
    results[i].variant.label = variants[i][2];
  }
  return results;
}

using Colours = std::vector<std::size_t>;

TEST(CurveColours, AreThoseOfSchemes) {
  EXPECT_EQ(curve_colours(results_of(
                {{"newmark", "penalty", "a"}, {"central_differences", "penalty", "b"}, {"newmark", "lagrange", "c"}})),
            (Colours{0, 1, 0}));
}

TEST(CurveColours, AreThoseOfWhatDiffersElse) {
  EXPECT_EQ(curve_colours(results_of({{"newmark", "penalty", "a"}, {"newmark", "lagrange", "b"}})), (Colours{0, 1}));
  EXPECT_EQ(curve_colours(results_of({{"newmark", "penalty", "10 cells"}, {"newmark", "penalty", "20 cells"}})),
            (Colours{0, 1}));
  EXPECT_TRUE(curve_colours({}).empty());
}

}  // namespace
}  // namespace carom::compare::compare_curve_colours_test
