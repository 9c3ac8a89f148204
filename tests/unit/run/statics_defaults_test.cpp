// Statics that names no enforcement.
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "run_fixture.hpp"

namespace carom::run_statics_defaults_test {
namespace {

using namespace test;

/// Two cubes of 0.1, E = 210e9, one on the other, free to widen, the top pressed down by 0.2 mm.
std::string cubes(int lower, int upper, const std::string& contact, const std::string& scheme = "") {
  std::string text = "units = \"SI\"\n";
  const auto add = [&](int n, double z, char name) {
    text += fmt::format(R"([[mesh.block]]
origin = [0.0, 0.0, {0}]
size = [0.1, 0.1, 0.1]
divisions = [{1}, {1}, {1}]
groups = {{ cells = "B{2}", zmin = "F{2}", zmax = "T{2}", xmin = "X{2}", ymin = "Y{2}" }}
[[part]]
name = "part {2}"
cells = "B{2}"
material = "steel"
[[support]]
nodes = "X{2}"
symmetry = "x"
[[support]]
nodes = "Y{2}"
symmetry = "y"
)",
                        z, n, name);
  };
  add(lower, 0.0, '0');
  add(upper, 0.1, '1');
  return text + R"([materials.steel]
law = "linear_elastic"
E = 210e9
nu = 0.3
rho = 7800.0
[[support]]
nodes = "F0"
symmetry = "z"
[[support]]
nodes = "T1"
displacement = { z = -2e-4, function = "ramp" }
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[[contact]]
name = "faces"
kind = "pair"
group = "F1"
master = "T0"
)" + contact +
         "[scheme]\nkind = \"statics\"\n" + scheme + "[time]\nend = 1.0\nstep = 1.0\n";
}

/// Greatest von Mises stress at the end.
double greatest_stress(const TemporaryCase& given) {
  return nlohmann::json::parse(given.result("summary.json"))["stress"]["value"];
}

// Uniaxial stress: E u / (2 L), times the area. The multipliers have settled when an update changes them by 1e-6.
TEST(StaticsByDefault, BearsTheForceOfTheStroke) {
  const double stress = 210e9 * 2e-4 / 0.2;
  for (const int upper : {2, 3}) {
    const TemporaryCase given(cubes(2, upper, ""));
    ASSERT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
    EXPECT_NEAR(last_row(given.result("contact.csv")).at("faces.force_z"), stress * 0.01, 1e-6 * stress * 0.01);
    EXPECT_NEAR(greatest_stress(given), stress, 1e-5 * stress);  // at single points
  }
}

// A rubber cube whose foot stands on a rigid plane is pressed by a twentieth: exact multipliers hold the same rows.
TEST(StaticsByDefault, IsThatOfMultipliersOnAPlane) {
  const auto force = [](const std::string& enforcement) {
    const TemporaryCase given(R"(units = "SI"
[[mesh.block]]
size = [0.1, 0.1, 0.1]
divisions = [4, 4, 4]
[materials.rubber]
law = "neo_hookean"
E = 1e7
nu = 0.45
rho = 1000.0
[[part]]
name = "cube"
cells = "BLOCK"
material = "rubber"
[[support]]
nodes = "ZMAX"
displacement = { x = 0.0, y = 0.0, z = -0.005, function = "ramp" }
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[[contact]]
name = "plane"
kind = "plane"
group = "ZMIN"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = 0.2
[scheme]
kind = "statics"
)" + enforcement + "[time]\nend = 1.0\nstep = 0.5\n");
    EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
    return last_row(given.result("contact.csv")).at("plane.force_z");
  };
  const double exact = force("enforcement = \"lagrange\"\n");
  EXPECT_NEAR(force(""), exact, 1e-5 * exact);
  EXPECT_LT(force("enforcement = \"penalty\"\n"), 0.97 * exact);  // what the default is for
}

/// A Gmsh file of regular cells of HEXA8, one body after the other: B0 of 2 x 2 x 1 below z = 0, and a cube B1 of 1
/// that stands on its edge in the middle; cells of both are divided by n.
std::string edge_on_block(int n) {
  std::vector<std::string> nodes, cells;
  const auto add = [&](const std::string& body, const std::array<int, 3>& cut, const auto& place) {
    const std::size_t first = nodes.size() + 1;
    const auto node = [&](int i, int j, int k) {
      return first + static_cast<std::size_t>(i + (cut[0] + 1) * (j + (cut[1] + 1) * k));
    };
    for (int k = 0; k <= cut[2]; ++k)
      for (int j = 0; j <= cut[1]; ++j)
        for (int i = 0; i <= cut[0]; ++i) {
          const Vec3 x = place(Vec3{1.0 * i / cut[0], 1.0 * j / cut[1], 1.0 * k / cut[2]});
          nodes.push_back(fmt::format("{} {} {} {}", nodes.size() + 1, x[0], x[1], x[2]));
        }
    for (int k = 0; k < cut[2]; ++k)
      for (int j = 0; j < cut[1]; ++j)
        for (int i = 0; i < cut[0]; ++i)
          cells.push_back(fmt::format("5 2 {0} {0} {1} {2} {3} {4} {5} {6} {7} {8}", body == "B0" ? 1 : 2,
                                      node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                                      node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                                      node(i, j + 1, k + 1)));
    const auto side = [&](int tag, int k) {
      for (int j = 0; j < cut[1]; ++j)
        for (int i = 0; i < cut[0]; ++i)
          cells.push_back(fmt::format("3 2 {0} {0} {1} {2} {3} {4}", tag, node(i, j, k), node(i + 1, j, k),
                                      node(i + 1, j + 1, k), node(i, j + 1, k)));
    };
    side(body == "B0" ? 3 : 5, 0);
    side(body == "B0" ? 4 : 6, cut[2]);
  };
  add("B0", {5 * n, 5 * n, 3 * n}, [](const Vec3& s) { return Vec3{2.0 * s[0] - 1.0, 2.0 * s[1] - 1.0, s[2] - 1.0}; });
  add("B1", {3 * n, 3 * n, 3 * n}, [](const Vec3& s) {
    const double root = std::sqrt(0.5);
    return Vec3{s[0] - 0.4, root * (s[1] - s[2]), root * (s[1] + s[2])};
  });
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n3 1 \"B0\"\n3 2 \"B1\"\n2 3 \"LOW\"\n"
      "2 4 \"HIGH\"\n2 5 \"FOOT\"\n2 6 \"TOP\"\n$EndPhysicalNames\n";
  text += fmt::format("$Nodes\n{}\n{}\n$EndNodes\n", nodes.size(), fmt::join(nodes, "\n"));
  text += fmt::format("$Elements\n{}\n", cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) text += fmt::format("{} {}\n", i + 1, cells[i]);
  return text + "$EndElements\n";
}

/// The force along z when the cube's upper face, of those beside the edge, is moved down by 0.03.
double force_on_edge(int n, const std::string& contact, const std::string& scheme) {
  const TemporaryCase given(R"(units = "SI"
[mesh]
file = "edge.msh"
unused = "ignore"
[materials.m]
law = "linear_elastic"
E = 1e6
nu = 0.3
rho = 1000.0
[[part]]
name = "block"
cells = "B0"
material = "m"
[[part]]
name = "cube"
cells = "B1"
material = "m"
[[support]]
nodes = "LOW"
blocked = ["x", "y", "z"]
[[support]]
nodes = "TOP"
blocked = ["x", "y"]
displacement = { z = -0.03, function = "ramp" }
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[[contact]]
name = "edge"
)" + contact + "[scheme]\nkind = \"statics\"\n" +
                            scheme + "[time]\nend = 1.0\nstep = 0.5\n");
  std::ofstream(given.results().parent_path() / "edge.msh") << edge_on_block(n);
  EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
  for (const auto& [name, value] : last_row(given.result("contact.csv")))
    if (name.starts_with("edge.") && name.ends_with("force_z")) return std::abs(value);
  ADD_FAILURE() << "no force";
  return 0.0;
}

// An edge that comes down within the facets of a coarse block does not sink in: cells that interpolate displacements
// and rows that hold fewer places bear no less than finer ones do. Exact multipliers hold the same rows.
TEST(StaticsByDefault, HoldsAnEdgeOnACoarseBlock) {
  const std::string pair = "kind = \"pair\"\ngroup = \"FOOT\"\nmaster = \"HIGH\"\n";
  const double coarse = force_on_edge(1, pair, "");
  EXPECT_GT(coarse, force_on_edge(2, pair, ""));
  EXPECT_NEAR(force_on_edge(1, pair, "enforcement = \"lagrange\"\n"), coarse, 1e-4 * coarse);
  // With `all` the means stand on both sides instead of one: other rows of the same bodies, whose forces are 1 % apart
  // on this mesh. Rows of means without guards made no force at all there.
  EXPECT_NEAR(force_on_edge(1, "kind = \"all\"\n", ""), coarse, 0.02 * coarse);
}

struct Chosen {
  EnforcementKind enforcement;
  PairMethod method;
};

Chosen chosen(const std::string& text) {
  const Case given = parse_case(text, "case.toml");
  return {**given.scheme.enforcement, **given.contacts.at(0).surfaces()->method};
}

TEST(StaticsByDefault, TakesTheAugmentedLagrangianWhereNothingAsksForSprings) {
  const auto of = [](const std::string& contact, const std::string& scheme = "") {
    return chosen(cubes(2, 2, contact, scheme));
  };
  EXPECT_EQ(of("").enforcement, EnforcementKind::augmented_lagrangian);
  EXPECT_EQ(of("").method, PairMethod::faces);
  EXPECT_EQ(of("", "penetration = 1e-5\n").enforcement, EnforcementKind::augmented_lagrangian);
  EXPECT_EQ(of("stiffness = 1e14\n").enforcement, EnforcementKind::penalty);
  EXPECT_EQ(of("stiffness = 1e14\n").method, PairMethod::faces);
  EXPECT_EQ(of("", "enforcement = \"penalty\"\n").enforcement, EnforcementKind::penalty);
  EXPECT_EQ(of("smooth = true\n").method, PairMethod::two_pass);
  EXPECT_EQ(of("smooth = true\n").enforcement, EnforcementKind::penalty);
  const Chosen lagrange = of("", "enforcement = \"lagrange\"\n");
  EXPECT_EQ(lagrange.method, PairMethod::faces);
  const std::string all = replaced(cubes(2, 2, ""), R"(kind = "pair"
group = "F1"
master = "T0"
)",
                                   "kind = \"all\"\n");
  EXPECT_EQ(chosen(all).method, PairMethod::faces);
  const Chosen staged = chosen(cubes(2, 2, "") + R"([[stage]]
kind = "newmark"
end = 2.0
step = 1e-3
)");
  EXPECT_EQ(staged.enforcement, EnforcementKind::penalty);
  EXPECT_EQ(staged.method, PairMethod::faces);
  const std::string impulses = "[[stage]]\nkind = \"cd_lagrange\"\nend = 2.0\n";
  EXPECT_EQ(chosen(cubes(2, 2, "") + impulses).enforcement, EnforcementKind::augmented_lagrangian);
}

/// A block of 60 x 60 x 50 mm pressed by 4 MPa that yields from 3 MPa on, all of it at once, with 1 % of the stiffness.
std::string yielding_block(const std::string& rest) {
  return R"(units = "SI"
[[mesh.block]]
origin = [0.02, 0.02, 0.05]
size = [0.06, 0.06, 0.05]
divisions = [2, 2, 2]
groups = { cells = "B", zmin = "B0", zmax = "B1" }
[materials.s]
law = "j2"
E = 2.0e9
nu = 0.3
rho = 2000.0
yield_stress = 3.0e6
hardening_modulus = 2.0e7
[[part]]
name = "b"
cells = "B"
material = "s"
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[[load]]
pressure = 4.0e6
group = "B1"
function = "ramp"
[scheme]
kind = "statics"
[time]
end = 1.0
step = 0.1
[[probe]]
name = "top"
group = "B1"
quantities = ["displacement"]
)" + rest;
}

// Where contact moves, differences of iterates whose points had begun to yield since led the next ones astray: no
// equilibrium at 3 MPa, however short the step. On a wider block that friction holds it to it becomes shorter by more
// than one with a foot that is held, and by less than one whose foot slides freely: there the strain is p / E +
// (p - yield stress) / H, less what its section gains.
TEST(StaticsByDefault, FindsTheEquilibriumOfABlockThatYieldsAllAtOnce) {
  const TemporaryCase held(yielding_block("[[support]]\nnodes = \"B0\"\nblocked = [\"x\", \"y\", \"z\"]\n"));
  const std::string on_a_block = R"([[mesh.block]]
size = [0.1, 0.1, 0.05]
divisions = [3, 3, 2]
groups = { cells = "A", zmin = "A0", zmax = "A1" }
[[part]]
name = "a"
cells = "A"
material = "s"
[[support]]
nodes = "A0"
blocked = ["x", "y", "z"]
[[contact]]
name = "c"
kind = "pair"
group = "B0"
master = "A1"
)";
  const TemporaryCase given(yielding_block(on_a_block + "friction = 0.4\n")), slides(yielding_block(on_a_block));
  ASSERT_EQ(held.run(), ExitCode::good) << held.result("summary.json");
  ASSERT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
  // Nothing holds it sideways: it stays where it is, in as many steps.
  ASSERT_EQ(slides.run(), ExitCode::good) << slides.result("summary.json");
  EXPECT_EQ(column(slides.result("probes.csv"), "time").size(), 11U);
  const std::string probes = given.result("probes.csv");
  // At most one of the ten steps was cut: whether a row's friction changes its state once more is a matter of rounding.
  EXPECT_LE(column(probes, "time").size(), 13U);
  const double alone = last_row(held.result("probes.csv")).at("top.displacement_z");
  const double sunk = last_row(probes).at("top.displacement_z");
  EXPECT_LT(sunk, alone);
  EXPECT_GT(sunk, -0.05 * (4.0e6 / 2.0e9 + 1.0e6 / 2.0e7));
}

// Mass that goes from the foot to the inside takes its weight along: the foot bore 3.9 to 6.0 N of 4.9 N as the stage
// with inertia began. Statics are solved to 1e-10 of the forces.
TEST(StaticsByDefault, WeighByTheMassOfTheStageWithInertia) {
  const TemporaryCase given(R"(units = "SI"
[[mesh.block]]
size = [0.1, 0.1, 0.05]
divisions = [3, 3, 2]
groups = { cells = "B", zmin = "FOOT" }
[materials.m]
law = "linear_elastic"
E = 1e7
nu = 0.3
rho = 1000.0
[[part]]
name = "b"
cells = "B"
material = "m"
[[load]]
gravity = [0.0, 0.0, -9.81]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = 0.5
[scheme]
kind = "statics"
[time]
end = 1.0
step = 0.5
[[stage]]
kind = "modified_mass"
end = 1.01
)");
  ASSERT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
  const std::string contact = given.result("contact.csv");
  const std::vector<double> time = column(contact, "time"), force = column(contact, "floor.force_z");
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < 1.0) continue;
    EXPECT_NEAR(force[i], 0.1 * 0.1 * 0.05 * 1000.0 * 9.81, 1e-6) << time[i];
  }
}

}  // namespace
}  // namespace carom::run_statics_defaults_test
