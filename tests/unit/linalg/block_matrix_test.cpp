#include "linalg/block_matrix.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace carom::linalg_block_matrix_test {
namespace {

// The two ways to write a matrix undo each other. Five points with a row of 1 to 3 blocks each, all entries different.
TEST(BlockMatrix, ByUnknownsAndBackIsTheSame) {
  BlockMatrix A = BlockMatrix::with_graph({{0, 1}, {0, 1, 4}, {2}, {3, 4}, {1, 3, 4}});
  for (std::size_t k = 0; k < A.value.size(); ++k) A.value[k] = static_cast<double>(k + 1);
  const CsrMatrix rows = by_unknowns(A);
  EXPECT_EQ(rows.size, 15);
  EXPECT_EQ(rows.value.size(), 11U * 9U);
  const BlockMatrix back = by_points(rows);
  EXPECT_EQ(back.points(), 5U);
  EXPECT_EQ(back.row_begin, A.row_begin);
  EXPECT_EQ(back.column, A.column);
  EXPECT_EQ(back.value, A.value);
}

}  // namespace
}  // namespace carom::linalg_block_matrix_test
