// Anderson's acceleration of linear iterations.
#include "schemes/anderson_mixing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace carom::schemes_anderson_mixing_test {
namespace {

// y <- y + (1 - factor) (1 - y), mode by mode: the error of each mode is multiplied by its factor, two of them above 1.
// Three modes are gone after three differences: the fifth iterate is the solution to round-off.
TEST(AndersonMixing, SolvesForTheModesThatDiverge) {
  const std::array<double, 6> factor{1.5, -1.2, 0.9, 0.9, 1.5, -1.2};
  std::array<double, 6> y{}, f{};
  AndersonMixing mixing;
  for (int iteration = 0; iteration < 5; ++iteration) {
    for (std::size_t i = 0; i < y.size(); ++i) f[i] = (1.0 - factor[i]) * (1.0 - y[i]);
    mixing.advance(y, f);
  }
  for (const double value : y) EXPECT_NEAR(value, 1.0, 1e-12);
}

// Corrections that fall by a factor of ten are taken as they are.
TEST(AndersonMixing, LeavesQuickIterationsAlone) {
  std::array<double, 2> y{}, f{};
  AndersonMixing mixing;
  double plain = 0.0;
  for (const double step : {1.0, 0.05, 1e-4}) {
    f.fill(step);
    plain += step;
    mixing.advance(y, f);
    EXPECT_EQ(y[0], plain);
  }
}

}  // namespace
}  // namespace carom::schemes_anderson_mixing_test
