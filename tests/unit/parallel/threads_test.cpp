#include "parallel/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace carom::parallel_threads_test {
namespace {

std::vector<double> random_vector(std::size_t n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> v(n);
  for (double& x : v) x = uniform(engine);
  return v;
}

TEST(Threads, RangesCoverEveryIndexOnce) {
  for (const std::size_t n : {0ul, 1ul, 7ul, 8ul, 9ul, 1000ul}) {
    std::vector<std::atomic<int>> hits(n);
    parallel_for(n, 8, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin % 8, 0u);
      EXPECT_LE(end - begin, 8u);
      for (std::size_t i = begin; i < end; ++i) ++hits[i];
    });
    for (const auto& h : hits) EXPECT_EQ(h.load(), 1);
  }
}

TEST(Threads, SumIsCloseToExtendedPrecision) {
  for (const std::size_t n : {0ul, 1ul, 2048ul, 2049ul, 100000ul}) {
    const std::vector<double> v = random_vector(n, 30);
    long double exact = 0.0L, magnitude = 0.0L;
    for (const double x : v) {
      exact += x;
      magnitude += std::abs(x);
    }
    const double sum = parallel_sum(n, [&](std::size_t i) { return v[i]; });
    // Blocked summation: |error| <= (block + blocks) eps sum |x| (Higham, Accuracy and Stability, section 4.2).
    const double terms = 2048.0 + static_cast<double>(n) / 2048.0;
    EXPECT_LE(std::abs(sum - static_cast<double>(exact)), terms * 1.2e-16 * static_cast<double>(magnitude)) << n;
  }
}

TEST(Threads, MaximumFindsTheLargestAndKeepsTheLowest) {
  std::vector<double> v = random_vector(50000, 31);
  v[49999] = 3.0;
  EXPECT_EQ(parallel_max(v.size(), -1e300, [&](std::size_t i) { return v[i]; }), 3.0);
  EXPECT_EQ(parallel_max(v.size(), 5.0, [&](std::size_t i) { return v[i]; }), 5.0);
  EXPECT_EQ(parallel_max(0, -7.0, [](std::size_t) { return 1.0; }), -7.0);
}

TEST(Threads, DotHasTheSameBitsForAnyThreadCount) {
  const std::vector<double> a = random_vector(77777, 32), b = random_vector(77777, 33);
  set_threads(1);
  const double one = dot(a, b);
  for (const int threads : {2, 4}) {
    EXPECT_EQ(set_threads(threads), threads);
    EXPECT_EQ(dot(a, b), one) << threads << " threads";
  }
  EXPECT_GE(set_threads(0), 1);
}

TEST(Threads, SumLargestAndZeroAreOfAllValues) {
  std::vector<double> v(50000, 0.0);
  EXPECT_TRUE(is_zero(v));
  EXPECT_EQ(largest_of(v), 0.0);
  EXPECT_TRUE(is_zero({}));
  v[49999] = -3.0;
  v[1] = 1.0;
  EXPECT_FALSE(is_zero(v));
  EXPECT_EQ(largest_of(v), 3.0);
  EXPECT_EQ(sum_of(v), -2.0);
  EXPECT_TRUE(is_finite(v));
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    v[30000] = wrong;
    EXPECT_FALSE(is_finite(v));
    EXPECT_FALSE(is_zero(v));
  }
}

}  // namespace
}  // namespace carom::parallel_threads_test
