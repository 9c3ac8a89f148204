// Frequency bounds of cells for the mass that a scheme takes.
#include "schemes/driven_cells.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "schemes_fixture.hpp"
#include "solid/stability.hpp"

namespace carom::schemes_driven_cells_test {
namespace {

using namespace test;

// omega^2 = k / m: a quarter of the mass at the nodes of the head gives four times the bound of the cells there.
TEST(CellBounds, AreThoseOfTheMassOfTheScheme) {
  const Problem p(one_part(block_mesh({1, 1, 3}, 0.0)), MassKind::lumped);
  const std::vector<double> plain = cell_frequency_bounds(p.solid);
  EXPECT_EQ(cell_bounds(p.system), plain);
  std::vector<double> masses = p.mass.node_diagonal();
  for (const Index n : p.model.mesh->nodes_of("ZMAX")) masses[static_cast<std::size_t>(n)] /= 4.0;
  const Mass light(masses);
  const std::vector<double> bounds = cell_bounds({*p.model.mesh, p.solid, light, p.contact, p.supports});
  ASSERT_EQ(bounds.size(), 3U);
  EXPECT_EQ(bounds[0], plain[0]);
  EXPECT_EQ(bounds[1], plain[1]);
  EXPECT_NEAR(bounds[2], 4.0 * plain[2], 1e-12 * plain[2]);
}

}  // namespace
}  // namespace carom::schemes_driven_cells_test
