#include "linalg/csr_matrix.hpp"

#include <gtest/gtest.h>

#include "linalg_problems.hpp"
#include "parallel/threads.hpp"

namespace carom::linalg_csr_matrix_test {
namespace {

TEST(CsrMatrix, ProductEqualsDenseProduct) {
  const std::size_t n = 83;
  std::vector<double> dense = test::random_vector(n * n, 1);
  for (std::size_t k = 0; k < dense.size(); ++k)
    if (k % 3 != 0) dense[k] = 0.0;
  const std::vector<double> x = test::random_vector(n, 2);
  std::vector<double> y(n);
  test::sparse(dense, n).apply(x, y);
  // Same terms in the same order, adding the zeros changes nothing: equal to the rounding of fused multiply-adds.
  EXPECT_LT(test::largest_difference(y, test::product(dense, x)), 83 * 2.3e-16);
}

TEST(CsrMatrix, DiagonalIsZeroWhereNoneIsStored) {
  const CsrMatrix A = test::sparse({2, 1, 0, 1, 0, 3, 0, 3, -4}, 3);
  EXPECT_EQ(A.diagonal(), (std::vector<double>{2, 0, -4}));
}

TEST(CsrMatrix, RowsWithoutEntriesGiveZero) {
  const CsrMatrix A = test::sparse({0, 0, 0, 5}, 2);
  std::vector<double> y{7, 7};
  A.apply(std::vector<double>{1, 2}, y);
  EXPECT_EQ(y, (std::vector<double>{0, 10}));
}

TEST(CsrMatrix, SameBitsForAnyThreadCount) {
  const CsrMatrix A = test::laplacian(20);
  const std::vector<double> x = test::random_vector(8000, 3);
  std::vector<double> one(8000), y(8000);
  set_threads(1);
  A.apply(x, one);
  for (const int threads : {2, 4}) {
    set_threads(threads);
    A.apply(x, y);
    EXPECT_EQ(y, one) << threads << " threads";
  }
  set_threads(0);
}

}  // namespace
}  // namespace carom::linalg_csr_matrix_test
