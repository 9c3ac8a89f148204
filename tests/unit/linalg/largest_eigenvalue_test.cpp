#include "linalg/largest_eigenvalue.hpp"

#include <gtest/gtest.h>

#include "linalg_problems.hpp"
#include "parallel/threads.hpp"

namespace carom::linalg_largest_eigenvalue_test {
namespace {

LinearOperator action(const CsrMatrix& A) {
  return [&A](std::span<const double> x, std::span<double> y) { A.apply(x, y); };
}

/// y = tridiag(-1, 2, -1) x; largest eigenvalue 4 sin^2(n pi / (2 (n + 1))) (LeVeque 2007, section 2.10).
void second_difference(std::span<const double> x, std::span<double> y) {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) y[i] = 2 * x[i] - (i > 0 ? x[i - 1] : 0.0) - (i + 1 < n ? x[i + 1] : 0.0);
}

TEST(LargestEigenvalue, BracketsTheOneDimensionalLaplacian) {
  const int n = 200;
  const double exact = 4.0 * std::pow(std::sin(n * std::numbers::pi / (2.0 * (n + 1.0))), 2);
  for (const double tolerance : {1e-2, 1e-3, 1e-6}) {
    const EigenvalueEstimate estimate = largest_eigenvalue(second_difference, n, tolerance);
    EXPECT_LE(estimate.value, exact * (1 + 1e-14)) << tolerance;  // Rayleigh quotients are below; 1e-14: rounding
    EXPECT_GE(estimate.upper, exact * (1 - 1e-14)) << tolerance;
    EXPECT_LE(estimate.upper - estimate.value, tolerance * exact) << tolerance;
  }
}

TEST(LargestEigenvalue, BracketsTheThreeDimensionalLaplacian) {
  for (const Index m : {5, 12, 20}) {
    const CsrMatrix A = test::laplacian(m);
    const double exact = test::largest_laplacian_eigenvalue(m);
    const EigenvalueEstimate estimate = largest_eigenvalue(action(A), static_cast<std::size_t>(A.size));
    EXPECT_LE(estimate.value, exact * (1 + 1e-14)) << m;
    EXPECT_GE(estimate.upper, exact * (1 - 1e-14)) << m;
    EXPECT_LE(estimate.upper - estimate.value, 1e-3 * exact) << m;
    EXPECT_LT(estimate.iterations, 100) << m;
  }
}

TEST(LargestEigenvalue, ExactAfterAsManyIterationsAsDistinctEigenvalues) {
  const CsrMatrix A = test::sparse({3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 7, 0, 0, 0, 0, 1}, 4);
  const EigenvalueEstimate estimate = largest_eigenvalue(action(A), 4, 1e-12);
  EXPECT_NEAR(estimate.value, 7.0, 7e-14);
  EXPECT_EQ(estimate.iterations, 3);
}

TEST(LargestEigenvalue, ZeroAndOneByOneOperators) {
  const CsrMatrix zero = test::sparse({0, 0, 0, 0}, 2), five = test::sparse({5}, 1);
  EXPECT_EQ(largest_eigenvalue(action(zero), 2).value, 0.0);
  EXPECT_DOUBLE_EQ(largest_eigenvalue(action(five), 1).value, 5.0);
  EXPECT_EQ(largest_eigenvalue(action(zero), 0).iterations, 0);
}

TEST(LargestEigenvalue, StopsAtTheGivenNumberOfIterationsWithAnHonestBound) {
  const CsrMatrix A = test::laplacian(12);
  const EigenvalueEstimate estimate = largest_eigenvalue(action(A), 1728, 1e-15, 7);
  EXPECT_EQ(estimate.iterations, 7);
  EXPECT_GT(estimate.upper - estimate.value, 1e-15 * estimate.value);
}

TEST(LargestEigenvalue, SameBitsForAnyThreadCount) {
  const CsrMatrix A = test::laplacian(22);
  set_threads(1);
  const EigenvalueEstimate one = largest_eigenvalue(action(A), 10648);
  for (const int threads : {2, 4}) {
    set_threads(threads);
    const EigenvalueEstimate estimate = largest_eigenvalue(action(A), 10648);
    EXPECT_EQ(estimate.value, one.value) << threads << " threads";
    EXPECT_EQ(estimate.upper, one.upper);
    EXPECT_EQ(estimate.iterations, one.iterations);
  }
  set_threads(0);
}

}  // namespace
}  // namespace carom::linalg_largest_eigenvalue_test
