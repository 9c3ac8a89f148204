// Cells that have gone: the others give what they give without them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "solid/cell_values.hpp"
#include "solid/point_history.hpp"
#include "solid/stability.hpp"
#include "solid_bodies.hpp"

namespace carom::solid_erosion_test {
namespace {

using namespace test;

/// Forces and energies of the same cells, added up in another order.
constexpr double round_off = 1e-13;

/// Every row of the element table whose cells have points of their own.
std::vector<Element> integrated() {
  std::vector<Element> rows;
  for (const Element& row : elements())
    if (row.formulation != Formulation::nodal) rows.push_back(row);
  return rows;
}

Material yielding(const char* law = "j2") {
  return {law, 1.5, {{"E", 2.0}, {"nu", 0.3}, {"yield_stress", 0.05}, {"hardening_modulus", 0.2}}};
}

class CellsThatGo : public testing::TestWithParam<Element> {};

/// The model with the cells of the mask alone.
Model living(Model model, const std::vector<std::uint8_t>& alive) {
  std::size_t k = 0;
  std::erase_if(model.parts[0].cells, [&](Index) { return alive[k++] == 0; });
  return model;
}

void expect_as_without_the_rest(const Element& element, const Material& material) {
  const Model model = body(distorted_mesh(element.type), element, material);
  const Solid solid(model);
  std::vector<std::uint8_t> alive(solid.cells().size(), 1);
  for (std::size_t k = 1; k < alive.size(); k += 2) alive[k] = 0;
  const Solid without(living(model, alive));
  std::vector<double> u = random_vector(solid.dof_count(), 5);
  for (double& component : u) component *= 0.5 * largest_move(element.type);
  for (std::size_t i = 2; i < u.size() && dimension(element.type) == 2; i += 3) u[i] = 0.0;

  std::vector<double> f(u.size()), g(u.size()), end(history_size(solid)), end_without(history_size(without));
  const PointStep step{.dt = 0.1, .history = {}, .alive = alive};
  const SolidEnergies energies = solid.evaluate(u, step, f, end);
  const SolidEnergies expected = without.evaluate(u, {.dt = 0.1, .history = {}}, g, end_without);
  EXPECT_LE(largest_difference(f, g), round_off);
  EXPECT_NEAR(energies.strain, expected.strain, round_off);
  EXPECT_NEAR(energies.plastic, expected.plastic, round_off);
  EXPECT_NEAR(energies.hourglass, expected.hourglass, round_off);

  const std::vector<double> x = random_vector(u.size(), 6);
  std::vector<double> y(u.size()), z(u.size());
  solid.tangent_action(u, x, y, step);
  without.tangent_action(u, x, z, {.dt = 0.1, .history = {}});
  EXPECT_LE(largest_difference(y, z), round_off);
  EXPECT_LE(
      largest_difference(solid.tangent_diagonal(u, step), without.tangent_diagonal(u, {.dt = 0.1, .history = {}})),
      round_off);
}

TEST_P(CellsThatGo, OfWhatIsThereForcesStiffnessAndEnergiesAreAsWithoutTheRest) {
  for (const char* law : {"j2", "j2_small_strain"}) expect_as_without_the_rest(GetParam(), yielding(law));
}

// Nodes that no cell holds any more go where they like: a cell that has gone may have any shape, and no number at all.
TEST_P(CellsThatGo, WhatHasGoneMayHaveAnyShape) {
  const Model model = body(distorted_mesh(GetParam().type), GetParam(), yielding());
  const Solid solid(model);
  std::vector<std::uint8_t> alive(solid.cells().size(), 0);
  std::vector<double> u(solid.dof_count(), std::numeric_limits<double>::quiet_NaN());
  alive[0] = 1;
  for (const Index n : solid.cells().nodes_of(0))
    for (std::size_t c = 0; c < 3; ++c) u[3 * static_cast<std::size_t>(n) + c] = 0.0;
  const PointStep step{.dt = 0.1, .history = {}, .alive = alive};
  std::vector<double> f(u.size()), end(history_size(solid));
  const SolidEnergies energies = solid.evaluate(u, step, f, end);
  EXPECT_EQ(energies.strain, 0.0);
  EXPECT_EQ(energies.plastic, 0.0);
  for (const double force : f) EXPECT_EQ(force, 0.0);
  for (const double value : end) EXPECT_EQ(value, 0.0);
  for (const auto& stress : cell_stress(solid, u, step))
    for (const double component : stress) EXPECT_EQ(component, 0.0);
  EXPECT_EQ(first_inverted_cell(solid, u, alive), -1);
  std::vector<double> growth(solid.cells().size());
  frequency_growth(solid, u, step, growth);
  for (const double of_cell : growth) EXPECT_TRUE(std::isfinite(of_cell));
}

std::string name_of_element(const testing::TestParamInfo<Element>& info) {
  return name_of(Body{info.param, yielding()});
}

INSTANTIATE_TEST_SUITE_P(Table, CellsThatGo, testing::ValuesIn(integrated()), name_of_element);

}  // namespace
}  // namespace carom::solid_erosion_test
