#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "linalg/cholesky.hpp"
#include "linalg/dense.hpp"
#include "linalg_problems.hpp"
#include "parallel/threads.hpp"

namespace carom::linalg_cholesky_test {
namespace {

std::string message_of(const CsrMatrix& A) {
  try {
    const Cholesky factors(A);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Cholesky, EqualsDenseLuOnRandomMatrices) {
  for (const Index n : {1, 2, 5, 40, 150}) {
    const auto size = static_cast<std::size_t>(n);
    const std::vector<double> A = test::random_spd(size, 10u + static_cast<unsigned>(n));
    std::vector<double> x = test::random_vector(size, 11), reference = x;
    Cholesky(test::sparse(A, n)).solve(x);
    DenseLu(A, n).solve(reference);
    // Both are backward stable: n eps kappa with kappa <= 1 + n^2, |x| <= 1 because the eigenvalues are above 1.
    EXPECT_LT(test::largest_difference(x, reference), n * 2.3e-16 * (1.0 + n * n)) << "n = " << n;
  }
}

TEST(Cholesky, SolvesSeveralColumnsAtOnceAndInTurn) {
  const Index m = 15;
  const std::size_t n = 3375;
  const CsrMatrix A = test::laplacian(m);
  const Cholesky factors(A);
  const int columns = 5;
  const std::vector<double> exact = test::random_vector(columns * n, 12);
  std::vector<double> b(columns * n);
  const auto column = [n](auto& v, int c) { return std::span(v).subspan(static_cast<std::size_t>(c) * n, n); };
  for (int c = 0; c < columns; ++c) A.apply(column(exact, c), column(b, c));
  std::vector<double> together = b, in_turn = b;
  factors.solve(together, columns);
  for (int c = 0; c < columns; ++c) factors.solve(column(in_turn, c));
  // eps kappa |x| with |x| <= 1, times 30 for the length of the sums.
  const double kappa = test::largest_laplacian_eigenvalue(m) / test::smallest_laplacian_eigenvalue(m);
  EXPECT_LT(test::largest_difference(together, exact), 30 * 2.3e-16 * kappa);
  EXPECT_LT(test::largest_difference(in_turn, exact), 30 * 2.3e-16 * kappa);
}

TEST(Cholesky, ReadsTheLowerTriangleOnly) {
  const CsrMatrix A = test::sparse({4, 99, 2, 5}, 2);
  std::vector<double> b{6, 7};  // (4 2; 2 5) (1, 1)
  Cholesky(A).solve(b);
  EXPECT_NEAR(b[0], 1.0, 1e-15);
  EXPECT_NEAR(b[1], 1.0, 1e-15);
}

TEST(Cholesky, NestedDissectionKeepsTheFactorSmall) {
  const CsrMatrix A = test::laplacian(20);
  const Cholesky factors(A);
  // In the natural order the band fills: about m^5 = 3.2e6 entries. Nested dissection fills O(m^4) (George and Liu,
  // Computer Solution of Large Sparse Positive Definite Systems, 1981, chapter 8); below half shows that it is on.
  EXPECT_LT(factors.factor_entries(), 1.6e6);
  EXPECT_GT(factors.factor_entries(), static_cast<double>(A.value.size()) / 2);
  EXPECT_GE(factors.factor_bytes(), 8 * factors.factor_entries());
}

TEST(Cholesky, NamesTheRowOfAnIndefiniteMatrix) {
  std::vector<double> dense(25, 0.0);
  for (std::size_t i = 0; i < 5; ++i) dense[i * 6] = i == 3 ? -1.0 : 1.0;
  EXPECT_EQ(message_of(test::sparse(dense, 5)),
            "Cholesky factorisation: the matrix is not positive definite (pivot of row 3)");
}

TEST(Cholesky, RefusesSingularMatrixAndEntriesThatAreNotFinite) {
  EXPECT_NE(message_of(test::sparse({1, -1, -1, 1}, 2)).find("not positive definite"), std::string::npos);
  CsrMatrix A = test::sparse({1, 2, 2, 9}, 2);
  A.value[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message_of(A), "Cholesky factorisation: entry (1, 0) is not finite");
}

TEST(Cholesky, EmptyMatrixIsSolvedByDoingNothing) {
  CsrMatrix A;
  A.row_begin = {0};
  std::vector<double> b;
  Cholesky(A).solve(b);
  EXPECT_EQ(Cholesky(A).factor_entries(), 0.0);
}

TEST(Cholesky, MovedFactorsStillSolve) {
  Cholesky first(test::sparse({4, 0, 0, 2}, 2));
  Cholesky factors(std::move(first));
  std::vector<double> b{4, 4};
  factors.solve(b);
  EXPECT_NEAR(b[0], 1.0, 1e-15);
  EXPECT_NEAR(b[1], 2.0, 1e-15);
}

TEST(Cholesky, SameBitsForAnyThreadCount) {
  const CsrMatrix A = test::laplacian(14);
  const std::vector<double> b = test::random_vector(2744, 13);
  set_threads(1);
  std::vector<double> one = b;
  Cholesky(A).solve(one);
  for (const int threads : {2, 4}) {
    set_threads(threads);
    std::vector<double> x = b;
    Cholesky(A).solve(x);
    EXPECT_EQ(x, one) << threads << " threads";
  }
  set_threads(0);
}

}  // namespace
}  // namespace carom::linalg_cholesky_test
