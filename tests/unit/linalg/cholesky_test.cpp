#include "linalg/cholesky.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>

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

// Columns on one face of a cube: the products of their halves are entries of the inverse, and a half has the supernodes
// on the way to the root alone.
TEST(Cholesky, HalvesOfSparseColumnsGiveTheInverseOnThem) {
  const Index m = 15;
  const std::size_t n = 3375, face = 225;
  const Cholesky factors(test::laplacian(m));
  SparseColumns B;
  for (std::size_t i = 0; i < face; ++i) {
    B.add_entry(static_cast<Index>(i), 1.0);
    if (i % 2 == 0) B.add_entry(static_cast<Index>(n - 1 - i), -0.5);
    B.end_column();
  }
  B.end_column();  // an empty column is zero
  const std::vector<HalfPanel> panels = factors.half_solve(B);
  std::vector<double> C((face + 1) * (face + 1), 0.0), block;
  std::size_t kept = 0, columns = 0;
  for (const HalfPanel& a : panels) {
    kept += a.value.size();
    columns += a.column.size();
    for (const HalfPanel& b : panels) {
      block.assign(a.column.size() * b.column.size(), 0.0);
      add_product(a, b, b.column.size(), block);
      for (std::size_t i = 0; i < a.column.size(); ++i)
        for (std::size_t j = 0; j < b.column.size(); ++j)
          C[a.column[i] * (face + 1) + b.column[j]] = block[i * b.column.size() + j];
    }
  }
  EXPECT_EQ(columns, face);
  EXPECT_LT(kept, face * n / 2);
  // eps kappa of entries of the inverse, at most 1 / smallest eigenvalue, times 30 for the length of the sums.
  const double smallest = test::smallest_laplacian_eigenvalue(m);
  const double bound = 30 * 2.3e-16 * test::largest_laplacian_eigenvalue(m) / (smallest * smallest);
  for (const std::size_t j : {std::size_t{0}, std::size_t{7}, std::size_t{112}, face}) {
    std::vector<double> x(n, 0.0);
    for (std::size_t e = B.begin[j]; e < B.begin[j + 1]; ++e) x[static_cast<std::size_t>(B.row[e])] += B.value[e];
    factors.solve(x);
    for (std::size_t i = 0; i <= face; ++i) {
      double expected = 0.0;
      for (std::size_t e = B.begin[i]; e < B.begin[i + 1]; ++e)
        expected += B.value[e] * x[static_cast<std::size_t>(B.row[e])];
      EXPECT_NEAR(C[i * (face + 1) + j], expected, bound);
    }
  }
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

TEST(Cholesky, FactorsOtherMatricesInTheSamePlace) {
  const CsrMatrix A = test::laplacian(9);  // 729 rows: ordered by threes
  CsrMatrix stiffer = A, other = test::laplacian(10);
  for (double& entry : stiffer.value) entry *= 4.0;
  Cholesky factors(A);
  for (const CsrMatrix* next :
       std::initializer_list<const CsrMatrix*>{&stiffer, &other, &A}) {  // the same pattern, another one, and back
    std::vector<double> x = test::random_vector(static_cast<std::size_t>(next->size), 17), anew = x;
    factors.factorize(*next);
    factors.solve(x);
    Cholesky(*next).solve(anew);
    EXPECT_EQ(x, anew);
  }
  // What cannot be factored leaves nothing behind that the next matrix would meet.
  CsrMatrix indefinite = A;
  for (double& entry : indefinite.value) entry = -entry;
  EXPECT_THROW(factors.factorize(indefinite), NotPositiveDefinite);
  std::vector<double> x = test::random_vector(729, 17), anew = x;
  factors.factorize(A);
  factors.solve(x);
  Cholesky(A).solve(anew);
  EXPECT_EQ(x, anew);
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
