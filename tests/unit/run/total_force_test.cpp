// A force on a group in all: who has which share, and what it does.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "advise/check_summary.hpp"
#include "cell_meshes.hpp"
#include "mesh/structured_block.hpp"
#include "mesh/write_gmsh.hpp"
#include "output/summary.hpp"
#include "run_fixture.hpp"
#include "solid/loads.hpp"

namespace carom::run_total_force_test {
namespace {

using namespace test;

constexpr double force = 3.0;

/// A bar along its longest edge, from 0 to 2, pulled at its far end in statics; `mesh` has its groups, `held` what else
/// holds it.
std::string pulled(const std::string& mesh, const std::string& part, const std::string& vector, const std::string& held,
                   const std::string& group = "END") {
  return fmt::format(R"(units = "SI"
{}
[materials.soft]
law = "linear_elastic"
E = 1.0e4
nu = 0.3
rho = 1.0
[[part]]
name = "bar"
cells = "BAR"
material = "soft"
{}
{}
[[load]]
total_force = {}
group = "{}"
function = "ramp"
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)",
                     mesh, part, held, vector, group);
}

std::string symmetry(const std::string& axes) {
  std::string text;
  for (const char axis : axes)
    text +=
        fmt::format("[[support]]\nnodes = \"{}MIN\"\nsymmetry = \"{}\"\n", static_cast<char>(std::toupper(axis)), axis);
  return text;
}

/// Runs it, and says its largest von Mises stress: over an end of uneven faces it is that of every cell only where the
/// traction is uniform.
double stress_of(const std::string& text) {
  const TemporaryCase given(text);
  EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
  return parse_summary(given.result("summary.json")).stress.value;
}

const std::string block = R"([[mesh.block]]
size = [2.0, 1.0, 0.5]
divisions = [3, 3, 2]
groups = { cells = "BAR", xmax = "END", xmin = "XMIN", ymin = "YMIN", zmin = "ZMIN" }
)";

// F / A, closed form.
TEST(TotalForce, PullsABarWithAUniformStress) {
  const std::string along_x = fmt::format("[{}, 0.0, 0.0]", force);
  EXPECT_NEAR(stress_of(pulled(block, "", along_x, symmetry("xyz"))), force / 0.5, 1e-9 * force);
  EXPECT_NEAR(stress_of(pulled(block, "formulation = \"full\"", along_x, symmetry("xyz"))), force / 0.5, 1e-9 * force);
  for (const CellType type :
       {CellType::hexa20, CellType::hexa27, CellType::tetra4, CellType::tetra10, CellType::penta15}) {
    StructuredBlock of_bar;
    of_bar.size = {2.0, 1.0, 0.5};
    of_bar.divisions = {2, 2, 1};
    of_bar.cells_group = "BAR";
    of_bar.face_groups[1] = "END";
    const std::string path = fmt::format("{}total_force_{}_{}.msh", testing::TempDir(), ::getpid(), name(type));
    std::ofstream(path) << gmsh_text(with_cells(make_structured_blocks({of_bar}), type));
    const std::string mesh = fmt::format("[mesh]\nfile = \"{}\"\n", path);
    EXPECT_NEAR(stress_of(pulled(mesh, "", along_x, symmetry("xyz"))), force / 0.5, 1e-9 * force) << name(type);
    std::filesystem::remove(path);
  }
}

// The whole circumference: of a cylinder of radius 1, F / pi.
TEST(TotalForce, OfAxisymmetricPartsIsThatOfTheWholeRing) {
  const std::string mesh = R"([[mesh.block]]
kind = "quad"
size = [1.0, 2.0]
divisions = [3, 4]
groups = { cells = "BAR", ymax = "END", ymin = "YMIN" }
)";
  const double stress =
      stress_of(pulled(mesh, "section = \"axisymmetric\"", fmt::format("[0.0, {}, 0.0]", force), symmetry("y")));
  EXPECT_NEAR(stress, force / std::numbers::pi, 1e-9 * force);
}

/// The nodal forces of a case, and their sum.
std::pair<LoadVector, Vec3> load_of(const std::string& text) {
  const Simulation simulation(parse_case(text, "case.toml"));
  LoadVector load = make_loads(simulation.model()).front();
  Vec3 sum{};
  for (const Vec3& f : load.force)
    for (std::size_t i = 0; i < 3; ++i) sum[i] += f[i];
  return {load, sum};
}

// Rounding of some ten numbers.
TEST(TotalForce, IsTheSumOfItsShares) {
  constexpr double rounding = 1e-15 * force;
  const std::string vector = fmt::format("[{}, 0.0, {}]", force, -2.0 * force);
  for (const char* group : {"END", "BAR", "all"}) {  // of faces by area, of cells by mass
    const Vec3 sum = load_of(pulled(block, "", vector, symmetry("xyz"), group)).second;
    EXPECT_NEAR(sum[0], force, rounding) << group;
    EXPECT_EQ(sum[1], 0.0) << group;
    EXPECT_NEAR(sum[2], -2.0 * force, 2.0 * rounding) << group;
  }
}

// Of four bars of equal lengths the nodes at the ends have an eighth each, those between them a fourth.
TEST(TotalForce, IsSharedAlongBarsByTheirLengths) {
  const std::string mesh = R"([[mesh.block]]
kind = "bar"
end = [2.0, 0.0, 0.0]
divisions = 4
groups = { cells = "BAR", start = "XMIN" }
)";
  const std::string held = "[[support]]\nnodes = \"all\"\nblocked = [\"y\", \"z\"]\n" + symmetry("x");
  const LoadVector load = load_of(pulled(mesh, "section = \"bar\"\narea = 0.1", "[8.0, 0.0, 0.0]", held, "BAR")).first;
  ASSERT_EQ(load.force.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(load.force[k][0], k % 4 == 0 ? 1.0 : 2.0, 1e-14);
}

TEST(TotalForce, IsSaidByCheck) {
  const Simulation simulation(parse_case(pulled(block, "", "[3.0, 0.0, -1.5]", symmetry("xyz")), "case.toml"));
  const std::string text = examine(simulation, "", 0.0).text();
  EXPECT_NE(text.find("\n  load      on \"END\": (3, 0, -1.5) N in all, times \"ramp\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("note: load on \"END\": 12 nodes share the total force by their areas\n"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace carom::run_total_force_test
