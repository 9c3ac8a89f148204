#include "linalg/dense.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "linalg_problems.hpp"

namespace carom::linalg_dense_test {
namespace {

TEST(DenseLu, SolvesRandomUnsymmetricSystems) {
  for (const int n : {1, 2, 7, 60}) {
    const auto size = static_cast<std::size_t>(n);
    const std::vector<double> A = test::random_vector(size * size, 20u + static_cast<unsigned>(n));
    const std::vector<double> b = test::random_vector(size, 21);
    std::vector<double> x = b;
    DenseLu(A, n).solve(x);
    double largest = 0.0;
    for (const double value : x) largest = std::max(largest, std::abs(value));
    // Backward stability: |A x - b| <= 3 n^2 growth eps |A| |x| (Higham, Accuracy and Stability, theorem 9.5), entries
    // of A at most 1; the growth of partial pivoting on random matrices is about n^(2/3), at most 16 here.
    EXPECT_LT(test::largest_difference(test::product(A, x), b), 3.0 * n * n * 16 * 1.2e-16 * n * largest) << n;
  }
}

TEST(DenseLu, TakesRowsNotColumns) {
  std::vector<double> b{5, 6};
  DenseLu({1, 2, 0, 3}, 2).solve(b);  // x + 2 y = 5, 3 y = 6
  EXPECT_EQ(b, (std::vector<double>{1, 2}));
}

TEST(DenseLu, PivotsOnAZeroDiagonal) {
  std::vector<double> b{2, 3};
  DenseLu({0, 1, 1, 0}, 2).solve(b);
  EXPECT_EQ(b, (std::vector<double>{3, 2}));
}

TEST(DenseLu, RefusesSingularMatrices) {
  EXPECT_THROW(DenseLu({1, 2, 2, 4}, 2), std::runtime_error);
  EXPECT_THROW(DenseLu({0}, 1), std::runtime_error);
  // Rows equal up to rounding: exact elimination leaves a pivot of one unit in the last place.
  EXPECT_THROW(DenseLu({1, 1, 1, 1 + 2.2e-16}, 2), std::runtime_error);
  EXPECT_THROW(DenseLu({1, NAN, 2, 4}, 2), std::runtime_error);
}

TEST(SymmetricEigen, GivesOrthonormalVectorsByIncreasingValues) {
  constexpr int n = 7;
  std::vector<double> A = test::random_vector(std::size_t{n} * n, 33);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) A[n * i + j] = A[n * j + i];
  const SymmetricEigen eigen = symmetric_eigen(A, n);
  EXPECT_TRUE(std::is_sorted(eigen.values.begin(), eigen.values.end()));
  for (std::size_t k = 0; k < n; ++k) {
    const std::vector<double> v(eigen.vectors.begin() + static_cast<std::ptrdiff_t>(n * k),
                                eigen.vectors.begin() + static_cast<std::ptrdiff_t>(n * (k + 1)));
    std::vector<double> expected = v;
    for (double& component : expected) component *= eigen.values[k];
    EXPECT_LT(test::largest_difference(test::product(A, v), expected), 1e-14);  // entries of A below 1: n eps |A|
    for (std::size_t l = 0; l < n; ++l) {
      double product = 0.0;
      for (std::size_t i = 0; i < n; ++i) product += v[i] * eigen.vectors[n * l + i];
      EXPECT_NEAR(product, k == l ? 1.0 : 0.0, 1e-14);
    }
  }
}

TEST(SymmetricEigen, RefusesWhatIsNotFinite) {
  EXPECT_THROW(symmetric_eigen({NAN, 0, 0, 1}, 2), std::runtime_error);
}

}  // namespace
}  // namespace carom::linalg_dense_test
