// The compliance of nodes against the Delassus operator by columns for each row.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "enforcement/node_compliance.hpp"
#include "linalg/dense.hpp"
#include "math/vec3.hpp"

namespace carom::schemes_node_compliance_test {
namespace {

constexpr std::size_t node_count = 24, dof_count = 3 * node_count;

/// Rows on three random nodes each (some twice in a row), with random blocks; every third without friction.
ConstraintRows random_rows(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<Index> any_node(0, node_count - 1);
  ConstraintRows rows;
  for (std::size_t r = 0; r < count; ++r) {
    const Vec3 direction{normal(generator), normal(generator), normal(generator)};
    rows.add_row(0.1, normalized(direction), {}, 1.0, {.mu = r % 3 == 0 ? 0.0 : 0.4}, 0);
    for (int k = 0; k < 3; ++k) {
      RowBlock block;
      for (Vec3& v : block) v = {normal(generator), normal(generator), normal(generator)};
      rows.add_block(any_node(generator), block);
    }
  }
  return rows;
}

/// 1 + (small random symmetric): positive definite, condition number below 3.
std::vector<double> random_operator(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-0.5 / dof_count, 0.5 / dof_count);
  std::vector<double> A(dof_count * dof_count, 0.0);
  for (std::size_t i = 0; i < dof_count; ++i) {
    for (std::size_t j = 0; j <= i; ++j) A[i * dof_count + j] = A[j * dof_count + i] = uniform(generator) + (i == j);
  }
  return A;
}

struct CountingInverse {
  DenseLu factors;
  int columns = 0;

  explicit CountingInverse(unsigned seed) : factors(random_operator(seed), static_cast<int>(dof_count)) {}
  InverseOperator as_operator() {
    return {[this](std::span<double> b, int count) {
      columns += count;
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        factors.solve(b.subspan(k * dof_count, dof_count));
      }
    }};
  }
};

void expect_delassus(const NodeCompliance& nodes, const ConstraintRows& rows, const std::vector<std::size_t>& chosen,
                     const InverseOperator& inverse) {
  std::vector<std::size_t> components;
  for (const std::size_t r : chosen) components.push_back(rows.law[r].mu > 0.0 ? 3 : 1);
  const Delassus of_nodes = nodes.compliance(rows, chosen, components);
  const Delassus W = make_delassus(rows, chosen, dof_count, inverse);
  ASSERT_EQ(of_nodes.entries(), W.entries());
  for (std::size_t k = 0; k < W.entries(); ++k) {
    for (std::size_t e = 0; e < 9; ++e)
      EXPECT_NEAR(of_nodes.block_at(k)[e], W.block_at(k)[e], 1e-12);  // sums of some ten numbers
  }
}

TEST(NodeCompliance, EqualsTheDelassusOperatorOfAnyRows) {
  CountingInverse inverse(1), oracle(1);
  NodeCompliance nodes(node_count);
  for (unsigned seed = 1; seed <= 4; ++seed) {  // rows that move: others at every iterate
    const ConstraintRows rows = random_rows(4, seed);
    const std::vector<std::size_t> chosen{2, 0, 3};
    ASSERT_TRUE(nodes.extend(rows, chosen, dof_count, inverse.as_operator()));
    expect_delassus(nodes, rows, chosen, oracle.as_operator());
  }
  EXPECT_LE(inverse.columns, static_cast<int>(dof_count));
}

TEST(NodeCompliance, SolvesForANodeOnceUntilTheOperatorChanges) {
  CountingInverse inverse(2), other(3), oracle(3);
  NodeCompliance nodes(node_count);
  const ConstraintRows rows = random_rows(40, 7);  // that all nodes take part is a matter of the seed: checked
  std::vector<std::size_t> all(40);
  for (std::size_t r = 0; r < all.size(); ++r) all[r] = r;
  ASSERT_TRUE(nodes.extend(rows, all, dof_count, inverse.as_operator()));
  EXPECT_EQ(inverse.columns, static_cast<int>(dof_count));
  ASSERT_TRUE(nodes.extend(random_rows(5, 8), {all.data(), 5}, dof_count, inverse.as_operator()));
  EXPECT_EQ(inverse.columns, static_cast<int>(dof_count));
  nodes.forget();
  ASSERT_TRUE(nodes.extend(rows, all, dof_count, other.as_operator()));
  expect_delassus(nodes, rows, all, oracle.as_operator());
}

TEST(NodeCompliance, RefusesMoreNodesThanItMayTake) {
  CountingInverse inverse(4);
  NodeCompliance nodes(3);
  const ConstraintRows rows = random_rows(10, 9);
  const std::vector<std::size_t> all{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_FALSE(nodes.extend(rows, all, dof_count, inverse.as_operator()));
  EXPECT_EQ(inverse.columns, 0);
  EXPECT_TRUE(nodes.extend(rows, {all.data(), 1}, dof_count, inverse.as_operator()));
}

}  // namespace
}  // namespace carom::schemes_node_compliance_test
