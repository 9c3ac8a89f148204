// The ways of exact ports to the compliance of their rows, against the Delassus operator by a solve for each column.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "enforcement/fixed_rows_compliance.hpp"
#include "enforcement/make_port_compliance.hpp"
#include "enforcement/moving_rows_compliance.hpp"
#include "enforcement/renewed_compliance.hpp"
#include "random_rows.hpp"
#include "schemes_fixture.hpp"

namespace carom::schemes_port_compliance_test {
namespace {

using test::CountingInverse;

constexpr std::size_t dof_count = test::random_dof_count;
constexpr double round_off = 1e-12;  // sums of some hundred numbers of size 1
const std::vector<std::size_t> chosen{2, 0, 3};

std::shared_ptr<const ConstraintRows> shared_rows(std::size_t count, unsigned seed) {
  return std::make_shared<const ConstraintRows>(test::random_rows(count, seed));
}

Delassus make(PortCompliance& compliance, const ConstraintRows& rows, CountingInverse& inverse) {
  return compliance.make(rows, chosen, test::component_counts(rows, chosen), inverse.as_operator());
}

/// Every way, and that by nodes where any node is one too many.
std::vector<std::unique_ptr<PortCompliance>> all_ways() {
  std::vector<std::unique_ptr<PortCompliance>> all;
  all.push_back(std::make_unique<FixedRowsCompliance>(dof_count));
  all.push_back(std::make_unique<RenewedCompliance>(dof_count));
  all.push_back(std::make_unique<MovingRowsCompliance>(dof_count));
  all.push_back(std::make_unique<MovingRowsCompliance>(dof_count, 0));
  return all;
}

TEST(PortCompliance, IsTheDelassusOperatorAndKnowsWhatItsForcesMove) {
  const auto rows = shared_rows(5, 1);
  const std::vector<Vec3> force{{1.0, -2.0, 3.0}, {0.5, 0.0, 0.0}, {-4.0, 0.0, 0.0}};  // rows 0 and 3: no friction
  std::vector<double> load(dof_count, 0.0);
  for (std::size_t i = 0; i < chosen.size(); ++i) rows->scatter(chosen[i], force[i], load);
  std::vector<double> moved = load;
  CountingInverse oracle(1);
  oracle.factors.solve(moved);
  std::size_t by_nodes = 0;
  for (const auto& one : all_ways()) {
    CountingInverse inverse(1);
    EXPECT_FALSE(one->use(rows, 1));
    EXPECT_LE(test::delassus_error(make(*one, *rows, inverse), *rows, chosen, oracle.as_operator()), round_off);
    std::vector<double> y(dof_count, 1.0);
    ASSERT_NE(one->knows_nodes(), one->knows_columns());
    by_nodes += one->knows_nodes() ? 1 : 0;
    if (one->knows_nodes())
      one->add_node_motion(load, y);
    else
      one->add_columns(chosen, force, y);
    for (std::size_t i = 0; i < dof_count; ++i) {
      // By nodes it is known on the nodes alone; those of the rows are where the load acts.
      const bool is_known = one->knows_columns() || load[i - i % 3] != 0.0;
      EXPECT_NEAR(y[i], is_known ? 1.0 + moved[i] : 1.0, 10.0 * round_off) << i;  // forces of size 10
    }
  }
  EXPECT_EQ(by_nodes, 1u);
}

TEST(PortCompliance, SolvesForWhatItDoesNotKeep) {
  const auto rows = shared_rows(5, 1), moved = shared_rows(5, 2);
  CountingInverse inverse(1), other(2), oracle(2);

  FixedRowsCompliance fixed(dof_count);
  fixed.use(rows, 1);
  make(fixed, *rows, inverse);
  EXPECT_EQ(inverse.columns, 5);  // components of the chosen rows
  EXPECT_TRUE(fixed.use(rows, 1));
  make(fixed, *rows, inverse);
  EXPECT_EQ(inverse.columns, 5);
  EXPECT_FALSE(fixed.use(rows, 2));
  EXPECT_LE(test::delassus_error(make(fixed, *rows, other), *rows, chosen, oracle.as_operator()), round_off);

  inverse.columns = 0;
  RenewedCompliance renewed(dof_count);
  for (int n = 1; n <= 3; ++n) {
    EXPECT_FALSE(renewed.use(rows, 1));
    make(renewed, *rows, inverse);
    EXPECT_EQ(inverse.columns, 5 * n);
  }

  inverse.columns = 0;
  MovingRowsCompliance moving(dof_count);
  std::vector<std::size_t> all(40);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto many = shared_rows(40, 7);  // that all nodes take part is a matter of the seed: checked
  moving.use(many, 1);
  moving.make(*many, all, test::component_counts(*many, all), inverse.as_operator());
  EXPECT_EQ(inverse.columns, static_cast<int>(dof_count));
  EXPECT_FALSE(moving.use(moved, 1));
  make(moving, *moved, inverse);
  EXPECT_EQ(inverse.columns, static_cast<int>(dof_count));
  EXPECT_FALSE(moving.use(moved, 2));
  EXPECT_LE(test::delassus_error(make(moving, *moved, other), *moved, chosen, oracle.as_operator()), round_off);
}

/// What a stage leaves after W of the chosen rows.
StageMemory left(PortCompliance& compliance, const std::shared_ptr<const ConstraintRows>& rows) {
  CountingInverse inverse(1);
  StageMemory memory;
  compliance.use(rows, 1);
  make(compliance, *rows, inverse);
  compliance.leave(memory, chosen);
  return memory;
}

TEST(PortCompliance, GoesOnFromWhatAStageHasLeft) {
  const auto rows = shared_rows(5, 1);
  const auto ways = all_ways(), fresh = all_ways();
  const std::vector<bool> leaves_something{true, false, true, false};  // in the order of all_ways()
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const StageMemory memory = left(*ways[k], rows);
    EXPECT_EQ(memory != StageMemory{}, leaves_something[k]);
    if (!leaves_something[k]) continue;
    CountingInverse inverse(1);
    std::vector<std::size_t> resumed;
    fresh[k]->use(rows, 1);
    EXPECT_TRUE(fresh[k]->go_on(memory, resumed, inverse.as_operator()));
    EXPECT_FALSE(fresh[k]->go_on(memory, resumed, inverse.as_operator()));
    StageMemory again;
    fresh[k]->leave(again, resumed);
    EXPECT_EQ(again, memory);
    const int columns = std::exchange(inverse.columns, 0);
    make(*fresh[k], *rows, inverse);
    EXPECT_GT(columns, 0);
    EXPECT_EQ(inverse.columns, 0);  // it was all there
  }
  // With the same columns, other rows chosen are something else.
  std::vector<std::size_t> others{1};
  CountingInverse inverse(1);
  EXPECT_TRUE(ways[0]->go_on(left(*ways[0], rows), others, inverse.as_operator()));
  EXPECT_EQ(others, chosen);
}

TEST(PortCompliance, IsChosenByTheBodiesAndTheirRows) {
  const Material neo_hookean = NeoHookean{test::unit_material};
  const auto chosen_for = [](const Material& material, const RigidShape& shape) {
    Model model = test::one_part(test::block_mesh({1, 1, 1}, 0.0), material);
    ObstacleContact obstacle = test::plane_below(model, 0.1, 1.0);
    obstacle.shape = shape;
    model.contacts.emplace_back(obstacle);
    const test::Problem problem(model);
    return make_port_compliance(problem.system);
  };
  const Plane plane{{0.0, 0.0, -0.1}, {0.0, 0.0, 1.0}};
  const Sphere sphere{{0.5, 0.5, -5.1}, 5.0};
  const auto fixed = chosen_for(test::unit_material, plane), moving = chosen_for(test::unit_material, sphere);
  const auto renewed = chosen_for(neo_hookean, plane), both = chosen_for(neo_hookean, sphere);
  EXPECT_NE(dynamic_cast<const FixedRowsCompliance*>(fixed.get()), nullptr);
  EXPECT_NE(dynamic_cast<const MovingRowsCompliance*>(moving.get()), nullptr);
  EXPECT_NE(dynamic_cast<const RenewedCompliance*>(renewed.get()), nullptr);
  EXPECT_NE(dynamic_cast<const RenewedCompliance*>(both.get()), nullptr);
}

}  // namespace
}  // namespace carom::schemes_port_compliance_test
