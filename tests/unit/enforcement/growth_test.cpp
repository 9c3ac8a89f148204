// What has grown in another order comes back to the bits that a growth stands for.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "enforcement/node_compliance.hpp"
#include "math/vec3.hpp"
#include "system/row_compliance.hpp"

namespace carom::schemes_growth_test {
namespace {

constexpr std::size_t node_count = 40, dof_count = 3 * node_count;

/// Rows on three nodes each, with random blocks and friction.
std::shared_ptr<const ConstraintRows> random_rows(unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<Index> any_node(0, node_count - 1);
  ConstraintRows rows;
  for (std::size_t r = 0; r < 30; ++r) {
    rows.add_row(0.1, {0.0, 0.0, 1.0}, {}, 1.0, {.mu = 0.4}, 0);
    for (int k = 0; k < 3; ++k) {
      RowBlock block;
      for (Vec3& v : block) v = {normal(generator), normal(generator), normal(generator)};
      rows.add_block(any_node(generator), block);
    }
  }
  return std::make_shared<const ConstraintRows>(rows);
}

/// An inverse whose rounding shows: what it gives depends on how many columns it is asked for at once, and on which of
/// them a column is, and it is not symmetric.
void rough_inverse(std::span<double> b, int columns) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) {
    const std::span<double> x = b.subspan(k * dof_count, dof_count);
    const double sum = 1e-3 * (columns + static_cast<double>(k)) * x[0];
    for (std::size_t i = 1; i < dof_count; ++i) x[i] += 0.1 * x[i - 1] + sum;
    x[0] += 1e-2 * static_cast<double>(k);
  }
}

const std::vector<std::size_t> first{3, 1}, second{7, 3, 12}, third{20, 21, 5, 9}, components{3, 3, 3, 3};

Delassus compliance_of(const NodeCompliance& nodes, const ConstraintRows& rows) {
  return nodes.compliance(rows, second, std::span(components).first(second.size()));
}

TEST(Growth, OfNodesGivesTheSameBits) {
  const auto rows = random_rows(1);
  NodeCompliance a(node_count), made_anew(node_count), longer(node_count), other(node_count);
  for (const auto& set : {first, second}) ASSERT_TRUE(a.extend(*rows, set, dof_count, {rough_inverse}));
  for (const auto& set : {first, second, third}) ASSERT_TRUE(longer.extend(*rows, set, dof_count, {rough_inverse}));
  for (const auto& set : {third, second, first}) ASSERT_TRUE(other.extend(*rows, set, dof_count, {rough_inverse}));
  EXPECT_NE(compliance_of(other, *rows), compliance_of(a, *rows));  // else the test would say nothing
  const Growth wanted = a.growth();
  EXPECT_FALSE(a.grow_as(wanted, dof_count, {rough_inverse}));
  for (NodeCompliance* nodes : {&made_anew, &longer, &other}) {
    EXPECT_TRUE(nodes->grow_as(wanted, dof_count, {rough_inverse}));
    EXPECT_EQ(nodes->growth(), wanted);
    EXPECT_EQ(compliance_of(*nodes, *rows), compliance_of(a, *rows));
    ASSERT_TRUE(nodes->extend(*rows, third, dof_count, {rough_inverse}));
  }
  ASSERT_TRUE(a.extend(*rows, third, dof_count, {rough_inverse}));
  EXPECT_EQ(made_anew.growth(), a.growth());
  EXPECT_EQ(longer.compliance(*rows, third, components), a.compliance(*rows, third, components));
}

Delassus blocks_of(RowCompliance& rows, const std::vector<std::size_t>& chosen) {
  return rows.compliance(chosen, std::span(components).first(chosen.size()), {rough_inverse});
}

TEST(Growth, OfRowsGivesTheSameBits) {
  const auto rows = random_rows(2);
  // Columns are kept: of all rows, and of the first ones only.
  for (const std::size_t column_entries : {std::size_t{1} << 20, 10 * dof_count}) {
    RowCompliance a(dof_count, column_entries), made_anew(a), longer(a), other(a);
    for (RowCompliance* one : {&a, &made_anew, &longer, &other}) one->use(rows);
    for (const auto& set : {first, second}) blocks_of(a, set);
    for (const auto& set : {first, second, third}) blocks_of(longer, set);
    for (const auto& set : {third, second, first}) blocks_of(other, set);
    const Delassus wanted_blocks = blocks_of(a, second);
    EXPECT_NE(blocks_of(other, second), wanted_blocks);  // else the test would say nothing
    const Growth wanted = a.growth();
    EXPECT_FALSE(a.grow_as(wanted, {rough_inverse}));
    for (RowCompliance* one : {&made_anew, &longer, &other}) {
      EXPECT_TRUE(one->grow_as(wanted, {rough_inverse}));
      EXPECT_EQ(one->growth(), wanted);
      EXPECT_EQ(one->has_columns(), a.has_columns());
      EXPECT_EQ(blocks_of(*one, second), wanted_blocks);
      if (!a.has_columns()) continue;
      std::vector<double> x(dof_count, 0.0), y = x;
      const std::vector<Vec3> force{{1.0, 2.0, 3.0}, {-1.0, 0.5, 0.0}};
      a.add_columns(first, force, x);
      one->add_columns(first, force, y);
      EXPECT_EQ(x, y);
    }
    const Delassus after = blocks_of(a, third);
    for (RowCompliance* one : {&made_anew, &longer, &other}) EXPECT_EQ(blocks_of(*one, third), after);
  }
}

}  // namespace
}  // namespace carom::schemes_growth_test
