// The compliance of nodes against the Delassus operator by columns for each row.
#include "enforcement/node_compliance.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "random_rows.hpp"

namespace carom::schemes_node_compliance_test {
namespace {

using test::CountingInverse, test::random_rows;

constexpr std::size_t node_count = test::random_node_count, dof_count = test::random_dof_count;

void expect_delassus(const NodeCompliance& nodes, const ConstraintRows& rows, const std::vector<std::size_t>& chosen,
                     const InverseOperator& inverse) {
  const Delassus of_nodes = nodes.compliance(rows, chosen, test::component_counts(rows, chosen));
  EXPECT_LE(test::delassus_error(of_nodes, rows, chosen, inverse), 1e-12);  // sums of some ten numbers
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
