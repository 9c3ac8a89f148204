// parts.csv against closed forms, and its sums against the ledger.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "run_fixture.hpp"

namespace carom::record_part_curves_test {
namespace {

using namespace test;

enum class Cells : std::uint8_t { hexa, tetra };

/// A bar of 2 x 2 x 4 unit cubes (Gmsh 2.2), whose halves LOW and HIGH share the nodes at z = 2; faces FOOT and HEAD of
/// hexahedra. Tetrahedra: six to a cube, along the ways over its edges from corner to corner (H. W. Kuhn, 1960).
std::string mesh_of_bar(Cells type) {
  std::string nodes, cells;
  int node = 0, cell = 0;
  const auto number = [](int i, int j, int k) { return 1 + i + 3 * (j + 3 * k); };
  for (int k = 0; k <= 4; ++k)
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= 2; ++i) nodes += fmt::format("{} {} {} {}\n", ++node, i, j, k);
  const auto add_face = [&](int i, int j, int k, int group) {
    cells += fmt::format("{} 3 2 {} {} {} {} {} {}\n", ++cell, group, group, number(i, j, k), number(i + 1, j, k),
                         number(i + 1, j + 1, k), number(i, j + 1, k));
  };
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      if (type == Cells::tetra) {
        for (int k = 0; k < 4; ++k) {
          std::array<int, 3> way{0, 1, 2};
          do {
            std::array<int, 3> at{i, j, k};
            cells += fmt::format("{} 4 2 {} {} {}", ++cell, k < 2 ? 1 : 2, k < 2 ? 1 : 2, number(i, j, k));
            for (const int axis : way) {
              ++at.at(static_cast<std::size_t>(axis));
              cells += fmt::format(" {}", number(at[0], at[1], at[2]));
            }
            cells += "\n";
          } while (std::next_permutation(way.begin(), way.end()));
        }
        continue;
      }
      add_face(i, j, 0, 3);
      add_face(i, j, 4, 4);
      for (int k = 0; k < 4; ++k)
        cells +=
            fmt::format("{} 5 2 {} {} {} {} {} {} {} {} {} {}\n", ++cell, k < 2 ? 1 : 2, k < 2 ? 1 : 2, number(i, j, k),
                        number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k), number(i, j, k + 1),
                        number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1));
    }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n3 1 \"LOW\"\n3 2 \"HIGH\"\n2 3 \"FOOT\"\n2 4 \"HEAD\"\n"
      "$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      node, nodes, cell, cells);
}

/// Both parts: a law of its own, and what else their sections say.
std::string bar(const std::string& low, const std::string& high, const std::string& of_parts, const std::string& rest) {
  return fmt::format(R"(units = "SI"
[mesh]
file = "bar.msh"
[materials.low]
nu = 0.0
rho = 1.5
{}
[materials.high]
nu = 0.0
rho = 3.0
{}
[[part]]
name = "low"
cells = "LOW"
material = "low"
{}
[[part]]
name = "high"
cells = "HIGH"
material = "high"
{}
{}
)",
                     low, high, of_parts, of_parts, rest);
}

struct Tables {
  Columns parts, energy;
};

Tables run_bar(const std::string& text, Cells type = Cells::hexa) {
  const TemporaryCase in(text);
  std::ofstream(in.results().parent_path() / "bar.msh") << mesh_of_bar(type);
  EXPECT_EQ(in.run(), ExitCode::good) << text << in.result("summary.json");
  return {read_csv(in.result("parts.csv")), read_csv(in.result("energy.csv"))};
}

/// In every row. tolerance: round-off of sums in another order.
void expect_ledger(Tables& tables, const std::vector<std::string>& wanted) {
  static const std::array<std::array<std::string, 2>, 9> terms{{{"kinetic_energy", "kinetic"},
                                                                {"strain_energy", "strain"},
                                                                {"hourglass_energy", "hourglass"},
                                                                {"plastic_energy", "plastic"},
                                                                {"hourglass_loss", "hourglass_loss"},
                                                                {"viscous_loss", "viscous"},
                                                                {"momentum_x", "momentum_x"},
                                                                {"momentum_y", "momentum_y"},
                                                                {"momentum_z", "momentum_z"}}};
  const std::size_t rows = tables.energy["time"].size();
  ASSERT_GT(rows, 10U);
  const double scale = std::ranges::max(tables.energy["kinetic"]);
  for (const auto& [quantity, term] : terms) {
    const auto &low = tables.parts["low." + quantity], &high = tables.parts["high." + quantity];
    if (low.empty()) {  // left out: the case cannot have it
      EXPECT_EQ(std::ranges::count(tables.energy[term], 0.0), static_cast<std::ptrdiff_t>(rows)) << term;
      EXPECT_EQ(std::ranges::count(wanted, quantity), 0) << quantity;
      continue;
    }
    ASSERT_EQ(low.size(), rows);
    double least_of_largest = 0.0;
    for (std::size_t i = 0; i < rows; ++i) {
      EXPECT_NEAR(low[i] + high[i], tables.energy[term][i], 1e-13 * scale) << quantity << " in row " << i;
      least_of_largest = std::max(least_of_largest, std::min(std::abs(low[i]), std::abs(high[i])));
    }
    if (std::ranges::count(wanted, quantity) > 0) {
      EXPECT_GT(least_of_largest, 1e-6 * scale) << quantity;
    }
  }
}

constexpr const char* kFloor = R"([[initial]]
part = "low"
velocity_field = ["0.1 * x * z", "0", "-2"]
[[initial]]
part = "high"
velocity_field = ["0.1 * x * z", "0", "-2"]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
stiffness = 2.0e4
)";

// One-point cells that yield, with hourglass modes and bulk viscosity, lumped mass, both halves of one mesh.
TEST(PartCurves, AddUpToTheLedgerOfExplicitSteps) {
  Tables tables = run_bar(bar("law = \"j2\"\nE = 2.0e3\nyield_stress = 20.0\nhardening_modulus = 200.0",
                              "law = \"j2\"\nE = 4.0e3\nyield_stress = 25.0\nhardening_modulus = 300.0",
                              "quadratic_bulk_viscosity = 1.2\nlinear_bulk_viscosity = 0.06",
                              std::string(kFloor) + "[scheme]\nkind = \"central_differences\"\n[time]\nend = 0.3\n"));
  expect_ledger(tables, {"kinetic_energy", "strain_energy", "hourglass_energy", "plastic_energy", "viscous_loss",
                         "momentum_x", "momentum_z"});
}

// Cells that are integrated at the nodes, whose energies are those of patches.
TEST(PartCurves, AddUpToTheLedgerOfNodalParts) {
  Tables tables = run_bar(bar("law = \"j2\"\nE = 2.0e3\nyield_stress = 20.0\nhardening_modulus = 200.0",
                              "law = \"j2\"\nE = 4.0e3\nyield_stress = 25.0\nhardening_modulus = 300.0",
                              "formulation = \"nodal\"", R"([[initial]]
part = "low"
velocity_field = ["0", "0", "2 * z"]
[[initial]]
part = "high"
velocity_field = ["0", "0", "2 * z"]
[scheme]
kind = "central_differences"
[time]
end = 0.3
)"),
                          Cells::tetra);
  expect_ledger(tables, {"kinetic_energy", "strain_energy", "plastic_energy", "momentum_z"});
}

// Consistent mass, whose rows at the shared nodes reach into both parts, finite strain.
TEST(PartCurves, AddUpToTheLedgerOfImplicitSteps) {
  Tables tables = run_bar(bar("law = \"neo_hookean\"\nE = 2.0e3", "law = \"st_venant_kirchhoff\"\nE = 4.0e3", "",
                              std::string(kFloor) + "[scheme]\nkind = \"newmark\"\n[time]\nend = 0.1\nstep = 0.005\n"));
  expect_ledger(tables, {"kinetic_energy", "strain_energy", "momentum_z"});
}

// Linear bodies, whose energy the ledger has from u.F / 2; cells that are made heavier.
TEST(PartCurves, AddUpToTheLedgerOfScaledMasses) {
  Tables tables = run_bar(
      bar("law = \"linear_elastic\"\nE = 2.0e3", "law = \"linear_elastic\"\nE = 4.0e3", "formulation = \"full\"",
          std::string(kFloor) + "[scheme]\nkind = \"central_differences\"\nmass_scaling_step = 0.03\n"
                                "mass_scaling_limit = 0.5\n[time]\nend = 0.6\n"));
  expect_ledger(tables, {"kinetic_energy", "strain_energy", "momentum_z"});
  // 8 cells of 1.5 at 2 m/s would be 24 J without the mass that was added.
  EXPECT_GT(tables.parts["low.kinetic_energy"].front(), 24.0 * (1.0 + 1e-3));
}

// m v^2 / 2 and m v of each half in free flight: the shared nodes are divided by the masses of the cells there.
TEST(PartCurves, OfFreeFlight) {
  Tables tables = run_bar(bar("law = \"linear_elastic\"\nE = 2.0e3", "law = \"linear_elastic\"\nE = 4.0e3", "",
                              R"([[initial]]
part = "low"
velocity = [1.0, 0.0, 3.0]
[[initial]]
part = "high"
velocity = [1.0, 0.0, 3.0]
[scheme]
kind = "central_differences"
[time]
end = 0.1
)"));
  const double m_low = 8.0 * 1.5, m_high = 8.0 * 3.0;
  EXPECT_NEAR(tables.parts["low.kinetic_energy"].back(), 0.5 * m_low * 10.0, 1e-11);
  EXPECT_NEAR(tables.parts["high.kinetic_energy"].back(), 0.5 * m_high * 10.0, 1e-11);
  EXPECT_NEAR(tables.parts["low.momentum_z"].back(), m_low * 3.0, 1e-11);
  EXPECT_NEAR(tables.parts["high.momentum_x"].back(), m_high * 1.0, 1e-11);
}

// A bar under its end's pressure p: p^2 V / (2 E) in each half, whatever the other's modulus (nu = 0).
TEST(PartCurves, OfABarUnderPressure) {
  Tables tables = run_bar(bar("law = \"linear_elastic\"\nE = 2.0e3", "law = \"linear_elastic\"\nE = 4.0e3", "",
                              R"([[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
[[load]]
group = "HEAD"
pressure = 20.0
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)"));
  EXPECT_NEAR(tables.parts["low.strain_energy"].back(), 20.0 * 20.0 * 8.0 / (2.0 * 2.0e3), 1e-10);
  EXPECT_NEAR(tables.parts["high.strain_energy"].back(), 20.0 * 20.0 * 8.0 / (2.0 * 4.0e3), 1e-10);
}

// Both halves are one rigid body: they share by mass what its four nodes have, 1/2 m v^2 and m v.
TEST(PartCurves, PartsOfOneRigidBodyShareByMass) {
  Tables tables = run_bar(bar("law = \"linear_elastic\"\nE = 2.0e3", "law = \"linear_elastic\"\nE = 4.0e3", "",
                              R"([[rigid_body]]
name = "both"
parts = ["low", "high"]
[[initial]]
part = "low"
velocity = [1.0, 0.0, 3.0]
[[initial]]
part = "high"
velocity = [1.0, 0.0, 3.0]
[scheme]
kind = "central_differences"
[time]
end = 0.1
)"));
  EXPECT_NEAR(tables.parts["low.kinetic_energy"].back(), 0.5 * 12.0 * 10.0, 1e-11);
  EXPECT_NEAR(tables.parts["high.momentum_z"].back(), 24.0 * 3.0, 1e-11);
  EXPECT_EQ(tables.parts["low.strain_energy"].back(), 0.0);
}

}  // namespace
}  // namespace carom::record_part_curves_test
