// The Delassus operator against products of dense matrices.
#include "rows/delassus.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "linalg/dense.hpp"
#include "math/vec3.hpp"

namespace carom::contact_delassus_test {
namespace {

constexpr std::size_t node_count = 12, dof_count = 3 * node_count;

/// Rows on random nodes (some twice in a row), with random blocks; every third without friction.
ConstraintRows random_rows(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<Index> any_node(0, node_count - 1);
  ConstraintRows rows;
  for (std::size_t r = 0; r < count; ++r) {
    rows.add_row(0.1, normalized(Vec3{normal(generator), normal(generator), normal(generator)}), {}, 1.0,
                 {.mu = r % 3 == 0 ? 0.0 : 0.4}, 0);
    for (int k = 0; k < 3; ++k) {
      RowBlock block;
      for (Vec3& v : block) v = {normal(generator), normal(generator), normal(generator)};
      rows.add_block(any_node(generator), block);
    }
  }
  return rows;
}

/// G^T as columns: 3 dof vectors per chosen row, zero for tangential components without friction.
std::vector<std::vector<double>> columns_of(const ConstraintRows& rows, const std::vector<std::size_t>& chosen) {
  std::vector<std::vector<double>> columns;
  for (const std::size_t r : chosen) {
    for (std::size_t c = 0; c < 3; ++c) {
      columns.emplace_back(dof_count, 0.0);
      Vec3 unit{};
      unit[c] = c == 0 || rows.law[r].mu > 0.0 ? 1.0 : 0.0;
      rows.scatter(r, unit, columns.back());
    }
  }
  return columns;
}

/// The block of W at (i, j), zero where none is stored.
FrameBlock block_at(const Delassus& W, std::size_t i, std::size_t j) {
  FrameBlock found{};
  W.each(i, [&](std::size_t column, std::size_t entry) {
    if (column == j) found = W.block_at(entry);
  });
  return found;
}

void expect_blocks(const Delassus& W, const std::vector<std::vector<double>>& G,
                   const std::vector<std::vector<double>>& inverse_G) {
  for (std::size_t i = 0; i < W.size(); ++i) {
    for (std::size_t j = 0; j < W.size(); ++j) {
      const FrameBlock block = block_at(W, i, j);
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t c = 0; c < 3; ++c) {
          double expected = 0.0;
          for (std::size_t d = 0; d < dof_count; ++d) expected += G[3 * i + a][d] * inverse_G[3 * j + c][d];
          EXPECT_NEAR(block[3 * a + c], expected, 1e-12) << i << " " << j;  // sums of some ten numbers near 1
        }
      }
    }
  }
}

std::vector<double> inverse_masses(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0.5, 2.0);
  std::vector<double> inverse(dof_count);
  for (double& m : inverse) m = uniform(generator);
  inverse[4] = inverse[17] = 0.0;  // fixed
  return inverse;
}

TEST(Delassus, OfALumpedMassIsTheProductOfMatrices) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const ConstraintRows rows = random_rows(20, seed);
    const std::vector<std::size_t> chosen{19, 0, 3, 7, 8, 11, 4, 5};
    const std::vector<double> inverse = inverse_masses(seed);
    const Delassus W = make_delassus(rows, chosen, inverse);
    const auto G = columns_of(rows, chosen);
    auto inverse_G = G;
    for (auto& column : inverse_G) {
      for (std::size_t d = 0; d < dof_count; ++d) column[d] *= inverse[d];
    }
    EXPECT_EQ(W.rows, chosen);
    expect_blocks(W, G, inverse_G);
  }
}

TEST(Delassus, OfALumpedMassStoresOnlyRowsThatShareNodesSortedWithTheDiagonal) {
  ConstraintRows rows;
  for (Index n = 0; n < 6; ++n) {
    rows.add_row(0.0, {0, 0, 1}, {}, 1.0, {.mu = 0.3}, 0);
    rows.add_node(2 * n, 1.0);
    rows.add_node(2 * (n / 2) + 1, -0.5);  // shared by rows 0 and 1, 2 and 3, 4 and 5
    if (n == 5) rows.add_node(0, 0.25);    // and of row 0
  }
  const Delassus W = make_delassus(rows, {5, 4, 3, 2, 1, 0}, std::vector<double>(dof_count, 1.0));
  EXPECT_EQ(W.begin, (std::vector<std::size_t>{0, 3, 5, 7, 9, 11, 14}));
  EXPECT_EQ(W.column, (std::vector<std::size_t>{0, 1, 5, 0, 1, 2, 3, 2, 3, 4, 5, 0, 4, 5}));
}

TEST(Delassus, OfSolvesIsTheProductOfMatricesInBatchesOfAnySize) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  std::vector<double> A(dof_count * dof_count, 0.0), C(dof_count * dof_count);
  for (double& c : C) c = normal(generator);
  for (std::size_t i = 0; i < dof_count; ++i) {
    for (std::size_t j = 0; j < dof_count; ++j) {
      for (std::size_t k = 0; k < dof_count; ++k) A[i * dof_count + j] += C[i * dof_count + k] * C[j * dof_count + k];
    }
    A[i * dof_count + i] += 10.0;
  }
  const DenseLu lu(A, static_cast<int>(dof_count));
  int most = 0, total = 0;
  const auto solve = [&](std::span<double> b, int columns) {
    EXPECT_EQ(b.size(), dof_count * static_cast<std::size_t>(columns));
    most = std::max(most, columns);
    total += columns;
    for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) lu.solve(b.subspan(k * dof_count, dof_count));
  };
  const ConstraintRows rows = random_rows(40, 3);
  std::vector<std::size_t> chosen;
  for (std::size_t r = 0; r < 40; ++r) chosen.push_back(39 - r);
  const Delassus W = make_delassus(rows, chosen, dof_count, {solve});
  EXPECT_EQ(most, 32);
  EXPECT_EQ(total, 14 + 3 * 26);  // rows without and with friction
  const auto G = columns_of(rows, chosen);
  auto inverse_G = G;
  for (std::vector<double>& column : inverse_G) lu.solve(column);
  expect_blocks(W, G, inverse_G);
  for (std::size_t i = 0; i < 40; ++i) {
    for (std::size_t j = 0; j < 40; ++j) {
      for (std::size_t e = 0; e < 9; ++e)
        EXPECT_EQ(block_at(W, i, j)[e], block_at(W, j, i)[e % 3 * 3 + e / 3]) << "not symmetric";
    }
  }
}

TEST(Delassus, AppliedIsTheMotionOfTheRowsUnderTheirForces) {
  const ConstraintRows rows = random_rows(15, 2);
  std::vector<std::size_t> chosen;
  for (std::size_t r = 0; r < 15; ++r) chosen.push_back(r);
  const std::vector<double> inverse = inverse_masses(1);
  const Delassus W = make_delassus(rows, chosen, inverse);
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  std::vector<Vec3> r(15), w(15);
  std::vector<double> f(dof_count, 0.0);
  for (std::size_t i = 0; i < 15; ++i) {
    r[i] = {normal(generator), 0.0, 0.0};
    if (rows.law[i].mu > 0.0) r[i][1] = r[i][2] = normal(generator);
    rows.scatter(i, r[i], f);
  }
  for (std::size_t d = 0; d < dof_count; ++d) f[d] *= inverse[d];
  W.apply(r, w);
  for (std::size_t i = 0; i < 15; ++i) {
    const Vec3 expected = rows.relative(i, f);
    for (std::size_t a = 0; a < (rows.law[i].mu > 0.0 ? 3U : 1U); ++a) EXPECT_NEAR(w[i][a], expected[a], 1e-12);
  }
}

TEST(Delassus, OfNoRowsIsEmpty) {
  const Delassus W = make_delassus(random_rows(3, 1), {}, std::vector<double>(dof_count, 1.0));
  EXPECT_EQ(W.size(), 0U);
  EXPECT_EQ(make_delassus(random_rows(3, 1), {}, dof_count, {[](std::span<double>, int) { FAIL(); }}).size(), 0U);
}

}  // namespace
}  // namespace carom::contact_delassus_test
