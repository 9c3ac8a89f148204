// Statics that names no enforcement.
#include <cmath>
#include <nlohmann/json.hpp>

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

// Uniaxial stress: E u / (2 L), times the area. The multipliers are right to 0.3 % when they are taken for settled, in
// the worst case, and each update leaves a tenth.
TEST(StaticsByDefault, BearsTheForceOfTheStroke) {
  const double stress = 210e9 * 2e-4 / 0.2;
  for (const int upper : {2, 3}) {
    const TemporaryCase given(cubes(2, upper, ""));
    ASSERT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
    EXPECT_NEAR(last_row(given.result("contact.csv")).at("faces.force_z"), stress * 0.01, 1e-3 * stress * 0.01);
    EXPECT_NEAR(greatest_stress(given), stress, 1e-3 * stress);  // at single points
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
  EXPECT_NEAR(force(""), exact, 3e-3 * exact);
  EXPECT_LT(force("enforcement = \"penalty\"\n"), 0.97 * exact);  // what the default is for
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
  EXPECT_EQ(lagrange.method, PairMethod::two_pass);
  const std::string all = replaced(cubes(2, 2, ""), R"(kind = "pair"
group = "F1"
master = "T0"
)",
                                   "kind = \"all\"\n");
  EXPECT_EQ(chosen(all).method, PairMethod::surface_to_surface);
  const Chosen staged = chosen(cubes(2, 2, "") + R"([[stage]]
kind = "newmark"
end = 2.0
step = 1e-3
)");
  EXPECT_EQ(staged.enforcement, EnforcementKind::penalty);
  EXPECT_EQ(staged.method, PairMethod::two_pass);
}

// Shifts from both sides of one surface push each other up.
TEST(StaticsByDefault, RefusesFacesOfASurfaceThatTouchesItself) {
  const std::string all = replaced(cubes(2, 2, "method = \"faces\"\n"), R"(kind = "pair"
group = "F1"
master = "T0"
)",
                                   "kind = \"all\"\n");
  try {
    parse_case(all, "case.toml");
    ADD_FAILURE();
  } catch (const CaseError& e) {
    EXPECT_EQ(e.key(), "contact[0].method");
  }
}

}  // namespace
}  // namespace carom::run_statics_defaults_test
