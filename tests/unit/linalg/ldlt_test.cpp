#include "linalg/ldlt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "linalg/cholesky.hpp"
#include "linalg/dense.hpp"
#include "linalg/nested_dissection.hpp"
#include "linalg_problems.hpp"
#include "parallel/threads.hpp"

namespace carom::linalg_ldlt_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

std::string message_of(const CsrMatrix& A) {
  try {
    Ldlt().factorize(A);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

/// Q diag(d) Q with the Householder reflection Q = 1 - 2 v v^T / v.v: symmetric, with the eigenvalues d.
std::vector<double> with_eigenvalues(const std::vector<double>& d, unsigned seed) {
  const std::size_t n = d.size();
  const std::vector<double> v = test::random_vector(n, seed);
  double vv = 0.0;
  for (const double x : v) vv += x * x;
  const auto q = [&](std::size_t i, std::size_t j) { return (i == j ? 1.0 : 0.0) - 2.0 * v[i] * v[j] / vv; };
  std::vector<double> A(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k < n; ++k) A[i * n + j] += q(i, k) * d[k] * q(k, j);
      A[j * n + i] = A[i * n + j];
    }
  return A;
}

/// Eigenvalues of both signs with moduli in [1, 10], every third one negative.
std::vector<double> indefinite_spectrum(std::size_t n) {
  std::vector<double> d(n);
  for (std::size_t i = 0; i < n; ++i) {
    d[i] = (i % 3 == 2 ? -1.0 : 1.0) * (1.0 + 9.0 * static_cast<double>(i) / static_cast<double>(n));
  }
  return d;
}

/// (K B^T; B 0) with the Laplacian of an m x m x m grid and a row of B for each node of the plane k = 0, weights 1 and
/// 1/2 on it and the node above: what contact rows make of a stiffness matrix.
CsrMatrix saddle_point(Index m) {
  const CsrMatrix K = test::laplacian(m);
  CsrMatrix A;
  const Index n = K.size, rows = m * m;
  A.size = n + rows;
  A.row_begin = {0};
  const auto add = [&A](Index j, double a) {
    A.column.push_back(j);
    A.value.push_back(a);
  };
  for (Index i = 0; i < n; ++i) {
    for (std::int64_t k = K.row_begin[static_cast<std::size_t>(i)]; k < K.row_begin[static_cast<std::size_t>(i) + 1];
         ++k)
      add(K.column[static_cast<std::size_t>(k)], K.value[static_cast<std::size_t>(k)]);
    if (i < 2 * rows) add(n + i % rows, i < rows ? 1.0 : 0.5);
    A.row_begin.push_back(static_cast<std::int64_t>(A.value.size()));
  }
  for (Index r = 0; r < rows; ++r) {
    add(r, 1.0);
    add(r + rows, 0.5);
    A.row_begin.push_back(static_cast<std::int64_t>(A.value.size()));
  }
  return A;
}

std::vector<double> dense_of(const CsrMatrix& A) {
  const auto n = static_cast<std::size_t>(A.size);
  std::vector<double> dense(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (auto k = static_cast<std::size_t>(A.row_begin[i]); k < static_cast<std::size_t>(A.row_begin[i + 1]); ++k)
      dense[i * n + static_cast<std::size_t>(A.column[k])] = A.value[k];
  return dense;
}

TEST(Ldlt, EqualsDenseLuOnRandomIndefiniteMatrices) {
  for (const Index n : {1, 2, 5, 40, 150}) {
    const auto size = static_cast<std::size_t>(n);
    const std::vector<double> A = with_eigenvalues(indefinite_spectrum(size), 20u + static_cast<unsigned>(n));
    std::vector<double> x = test::random_vector(size, 21), reference = x;
    Ldlt factors;
    factors.factorize(test::sparse(A, n));
    factors.solve(x);
    DenseLu(A, n).solve(reference);
    // Both are backward stable: n eps kappa with kappa <= 10, |x| <= n^(1/2); 30 for the growth of the pivots.
    EXPECT_LT(test::largest_difference(x, reference), 30 * n * eps * 10) << "n = " << n;
  }
}

TEST(Ldlt, CountsNegativeEigenvalues) {
  for (const Index n : {1, 3, 40, 151}) {
    Ldlt factors;
    factors.factorize(test::sparse(with_eigenvalues(indefinite_spectrum(static_cast<std::size_t>(n)), 5), n));
    EXPECT_EQ(factors.negative_eigenvalues(), n / 3);  // indefinite_spectrum: i = 2, 5, 8, ...
  }
}

// A matrix that no pivot on the diagonal can factor.
TEST(Ldlt, TakesTwoByTwoPivotsWhereTheDiagonalIsZero) {
  Ldlt factors;
  factors.factorize(test::sparse({0, 2, 2, 0}, 2));
  std::vector<double> b{6, 4};
  factors.solve(b);
  EXPECT_NEAR(b[0], 2.0, 1e-15);
  EXPECT_NEAR(b[1], 3.0, 1e-15);
  EXPECT_EQ(factors.negative_eigenvalues(), 1);
}

TEST(Ldlt, SolvesSaddlePoints) {
  const CsrMatrix A = saddle_point(6);
  const auto n = static_cast<std::size_t>(A.size);
  std::vector<double> x = test::random_vector(2 * n, 22), reference = x;
  Ldlt factors;
  factors.factorize(A);
  factors.solve(x, 2);
  const DenseLu dense(dense_of(A), A.size);
  dense.solve(std::span(reference).first(n));
  dense.solve(std::span(reference).subspan(n));
  // n eps kappa: K has a condition number below 4 (6 + 1)^2 / pi^2 = 20, its Schur complement another such factor.
  EXPECT_LT(test::largest_difference(x, reference), 252 * eps * 400);
  // A saddle point with B of full rank has as many negative eigenvalues as rows of B (Benzi, Golub and Liesen, Acta
  // Numerica 14, 2005, section 3.1).
  EXPECT_EQ(factors.negative_eigenvalues(), 36);
}

TEST(Ldlt, AgreesWithCholeskyOnADefiniteMatrix) {
  const Index m = 12;
  const CsrMatrix A = test::laplacian(m);
  std::vector<double> x = test::random_vector(1728, 23), reference = x;
  Ldlt factors;
  factors.factorize(A);
  factors.solve(x);
  Cholesky(A).solve(reference);
  const double kappa = test::largest_laplacian_eigenvalue(m) / test::smallest_laplacian_eigenvalue(m);
  EXPECT_LT(test::largest_difference(x, reference), 30 * eps * kappa);  // 30 for the length of the sums
  EXPECT_EQ(factors.negative_eigenvalues(), 0);
}

TEST(Ldlt, RefusesSingularMatrices) {
  const auto refuses = [](const CsrMatrix& A) {
    return message_of(A).find("LDL^T factorisation: the matrix is singular") == 0;
  };
  std::vector<double> d = indefinite_spectrum(60);
  d[10] = 0.0;
  EXPECT_TRUE(refuses(test::sparse(with_eigenvalues(d, 8), 60)));
  EXPECT_TRUE(refuses(test::sparse({1, -1, -1, 1}, 2)));
  EXPECT_TRUE(refuses(test::sparse({1, 0, 0, 0}, 2)));  // an empty row
  d[10] = 1e-9;                                         // ill conditioned, not singular: kappa 1e10
  EXPECT_EQ(message_of(test::sparse(with_eigenvalues(d, 8), 60)), "no error");
}

TEST(Ldlt, RefusesEntriesThatAreNotFinite) {
  CsrMatrix A = test::sparse({1, 2, 2, 9}, 2);
  A.value[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of(A), "LDL^T factorisation: entry (1, 0) is not finite");
}

TEST(Ldlt, AnalysesAPatternOnceAndGoesOnAfterAFailure) {
  CsrMatrix A = test::sparse({1, 2, 2, 1}, 2);
  Ldlt factors;
  factors.factorize(A);
  A.value = {1, 1, 1, 1};
  EXPECT_THROW(factors.factorize(A), std::runtime_error);
  A.value = {0, 4, 4, 0};
  factors.factorize(A);
  EXPECT_EQ(factors.analyses(), 1);
  std::vector<double> b{4, 8};
  factors.solve(b);
  EXPECT_NEAR(b[0], 2.0, 1e-15);
  EXPECT_NEAR(b[1], 1.0, 1e-15);
  factors.factorize(test::laplacian(4));  // another pattern
  EXPECT_EQ(factors.analyses(), 2);
  std::vector<double> x(64, 1.0), y(64);
  test::laplacian(4).apply(x, y);
  factors.solve(y);
  EXPECT_LT(test::largest_difference(x, y), 30 * eps * 10);  // kappa of 4 x 4 x 4 is 9.5
}

TEST(Ldlt, AnalysesAnotherPatternOfTheSameSize) {
  Ldlt factors;
  factors.factorize(test::sparse({2, 1, 0, 1, 2, 0, 0, 0, 2}, 3));
  factors.factorize(
      test::sparse({2, 1, 0, 1, 0, 1, 0, 1, 2}, 3));  // as many entries in the same columns, in other rows
  EXPECT_EQ(factors.analyses(), 2);
  std::vector<double> b{3, 3, 5};
  factors.solve(b);
  const std::vector<double> x{1, 1, 2};
  EXPECT_LT(test::largest_difference(x, b), 30 * eps * 2);  // eigenvalues 2 and 1 +- 3^(1/2): kappa is 3.7
}

TEST(Ldlt, ReadsTheLowerTriangleOnly) {
  Ldlt factors;
  factors.factorize(test::sparse({4, 99, 2, -5}, 2));
  std::vector<double> b{6, -3};  // (4 2; 2 -5) (1, 1)
  factors.solve(b);
  EXPECT_NEAR(b[0], 1.0, 1e-15);
  EXPECT_NEAR(b[1], 1.0, 1e-15);
}

TEST(Ldlt, EmptyMatrixIsSolvedByDoingNothing) {
  CsrMatrix A;
  A.row_begin = {0};
  Ldlt factors;
  factors.factorize(A);
  std::vector<double> b;
  factors.solve(b);
  EXPECT_EQ(factors.factor_entries(), 0.0);
}

// Several objects live at once, are moved and end in any order.
TEST(Ldlt, ObjectsDoNotDisturbEachOther) {
  Ldlt first, second;
  first.factorize(test::sparse({4, 0, 0, 2}, 2));
  second.factorize(test::sparse({-1, 0, 0, -2}, 2));
  Ldlt moved(std::move(first));
  {
    Ldlt third;
    third.factorize(test::laplacian(3));
  }
  std::vector<double> a{4, 4}, b{1, 2};
  moved.solve(a);
  second.solve(b);
  EXPECT_EQ(a, (std::vector<double>{1, 2}));
  EXPECT_EQ(b, (std::vector<double>{-1, -1}));
}

TEST(Ldlt, SameBitsForAnyThreadCount) {
  const CsrMatrix A = saddle_point(12);
  const std::vector<double> b = test::random_vector(static_cast<std::size_t>(A.size), 13);
  std::vector<double> one;
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    Ldlt factors;
    factors.factorize(A);
    std::vector<double> x = b;
    factors.solve(x);
    if (threads == 1) one = x;
    EXPECT_EQ(x, one) << threads << " threads";
  }
  set_threads(0);
}

TEST(Ldlt, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  message_of(test::sparse({1, -1, -1, 1}, 2));
  message_of(saddle_point(4));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(NestedDissection, IsAPermutationThatKeepsTheFactorSmall) {
  const CsrMatrix A = test::laplacian(20);
  std::vector<bool> seen(8000, false);
  for (const Index i : nested_dissection(A)) seen.at(static_cast<std::size_t>(i)) = true;
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 8000);
  Ldlt factors;
  factors.factorize(A);
  EXPECT_LT(factors.factor_entries(), 1.6e6);  // as for Cholesky: half of the band
}

}  // namespace
}  // namespace carom::linalg_ldlt_test
