#include "linalg/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "linalg_problems.hpp"
#include "parallel/threads.hpp"

namespace carom::linalg_conjugate_gradients_test {
namespace {

LinearOperator action(const CsrMatrix& A) {
  return [&A](std::span<const double> x, std::span<double> y) { A.apply(x, y); };
}

std::vector<double> inverse_diagonal(const CsrMatrix& A) {
  std::vector<double> d = A.diagonal();
  for (double& x : d) x = 1.0 / x;
  return d;
}

TEST(ConjugateGradients, MeetsKnownSolutionWithinTheIterationBound) {
  const Index m = 16;
  const CsrMatrix A = test::laplacian(m);
  const std::vector<double> exact = test::random_vector(4096, 4);
  std::vector<double> b(4096), x(4096, 0.0);
  A.apply(exact, b);
  const double relative = 1e-10;
  const CgResult result = ConjugateGradients().solve(action(A), inverse_diagonal(A), b, x, relative, 0.0, 1000);
  EXPECT_TRUE(result.converged);
  // |x - exact| <= |A^-1| |r| <= tolerance |b| / lambda_min; |b| comes from the vector itself.
  const double smallest = test::smallest_laplacian_eigenvalue(m);
  EXPECT_LE(test::largest_difference(x, exact), relative * std::sqrt(dot(b, b)) / smallest);
  // |e_k|_A <= 2 q^k |e_0|_A with q = (sqrt(kappa) - 1) / (sqrt(kappa) + 1) (Saad, 2nd ed., eq. 6.128); with
  // |r|_2 <= sqrt(lambda_max) |e|_A and |e_0|_A <= |b|_2 / sqrt(lambda_min): |r_k| <= 2 sqrt(kappa) q^k |b|.
  const double root = std::sqrt(test::largest_laplacian_eigenvalue(m) / smallest);
  const double bound = std::ceil(std::log(2.0 * root / relative) / std::log((root + 1.0) / (root - 1.0)));
  EXPECT_LE(result.iterations, bound);
  EXPECT_GT(result.iterations, 10);
}

TEST(ConjugateGradients, TrueResidualMeetsTheTolerance) {
  const CsrMatrix A = test::laplacian(12);
  const std::vector<double> b = test::random_vector(1728, 5);
  std::vector<double> x = test::random_vector(1728, 6), Ax(1728);
  const double absolute = 1e-9;
  ASSERT_TRUE(ConjugateGradients().solve(action(A), inverse_diagonal(A), b, x, 0.0, absolute, 1000).converged);
  A.apply(x, Ax);
  for (std::size_t i = 0; i < b.size(); ++i) Ax[i] -= b[i];
  // The recurrence drifts from the true residual by a few eps |A| |x| per iteration: below 1e-12 here.
  EXPECT_LE(std::sqrt(dot(Ax, Ax)), absolute + 1e-12);
}

TEST(ConjugateGradients, DiagonalMatrixNeedsOneIteration) {
  const CsrMatrix A = test::sparse({1, 0, 0, 0, 1e6, 0, 0, 0, 1e-6}, 3);
  std::vector<double> x(3, 0.0);
  const CgResult result =
      ConjugateGradients().solve(action(A), inverse_diagonal(A), std::vector<double>{1, 1, 1}, x, 1e-14, 0.0, 10);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 1);  // the preconditioned matrix is the identity
}

TEST(ConjugateGradients, ExactStartValueNeedsNoIteration) {
  const CsrMatrix A = test::sparse({2, 1, 1, 2}, 2);
  std::vector<double> x{1, 1};
  const CgResult result =
      ConjugateGradients().solve(action(A), inverse_diagonal(A), std::vector<double>{3, 3}, x, 1e-12, 0.0, 10);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(x, (std::vector<double>{1, 1}));
}

TEST(ConjugateGradients, SaysSoWhenItDoesNotConverge) {
  const CsrMatrix A = test::laplacian(10);
  const std::vector<double> b(1000, 1.0);
  std::vector<double> x(1000, 0.0);
  const CgResult few = ConjugateGradients().solve(action(A), inverse_diagonal(A), b, x, 1e-12, 0.0, 3);
  EXPECT_FALSE(few.converged);
  EXPECT_EQ(few.iterations, 3);
}

TEST(ConjugateGradients, BreaksDownOnIndefiniteMatrixAndOnNaN) {
  const CsrMatrix A = test::sparse({1, 2, 2, 1}, 2);  // eigenvalues 3 and -1
  std::vector<double> x(2, 0.0);
  const std::vector<double> ones{1, 1}, b{1, -1};
  EXPECT_FALSE(ConjugateGradients().solve(action(A), ones, b, x, 1e-12, 0.0, 10).converged);
  const std::vector<double> nan{1, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_FALSE(ConjugateGradients().solve(action(A), ones, nan, x, 1e-12, 0.0, 10).converged);
}

TEST(ConjugateGradients, SameBitsForAnyThreadCount) {
  const CsrMatrix A = test::laplacian(24);
  const std::vector<double> b = test::random_vector(13824, 7), d = inverse_diagonal(A);
  set_threads(1);
  std::vector<double> one(13824, 0.0);
  const CgResult reference = ConjugateGradients().solve(action(A), d, b, one, 1e-8, 0.0, 500);
  ASSERT_TRUE(reference.converged);
  for (const int threads : {2, 4}) {
    set_threads(threads);
    std::vector<double> x(13824, 0.0);
    const CgResult result = ConjugateGradients().solve(action(A), d, b, x, 1e-8, 0.0, 500);
    EXPECT_EQ(x, one) << threads << " threads";
    EXPECT_EQ(result.iterations, reference.iterations);
    EXPECT_EQ(result.residual, reference.residual);
  }
  set_threads(0);
}

}  // namespace
}  // namespace carom::linalg_conjugate_gradients_test
