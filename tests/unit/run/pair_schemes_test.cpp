// Pairs by schemes with exact contact, far from the origin; what the augmented Lagrangian takes for settled.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "run_fixture.hpp"

namespace carom::run_pair_schemes_test {
namespace {

using namespace test;

/// A block of 3^3 cells falls on one of 4 x 4 x 3, held at its foot, 100 m from the origin.
std::string two_blocks(const std::string& contact, const std::string& scheme = "kind = \"modified_mass\"\n[time]") {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
origin = [80.0, 60.0, -40.0]
size = [0.08, 0.08, 0.06]
divisions = [4, 4, 3]
groups = {{ cells = "LOWER", zmax = "TOP", zmin = "GROUND" }}
[[mesh.block]]
origin = [80.013, 60.007, -39.93999]
size = [0.05, 0.05, 0.05]
divisions = [3, 3, 3]
groups = {{ cells = "UPPER", zmin = "FACE" }}
[materials.rubber]
law = "neo_hookean"
E = 2e9
nu = 0.3
rho = 1200.0
[[part]]
name = "lower"
cells = "LOWER"
material = "rubber"
[[part]]
name = "upper"
cells = "UPPER"
material = "rubber"
[[support]]
nodes = "GROUND"
blocked = ["x", "y", "z"]
[[initial]]
part = "upper"
velocity = [0.5, 0.0, -5.0]
[[contact]]
name = "touch"
kind = "pair"
group = "FACE"
master = "TOP"
{}
[scheme]
{}
end = 2.5e-4
[output]
fields = []
)",
                     contact, scheme);
}

// The impulse of two passes by central differences is the measure, 5 % for meshes of three and four cells.
TEST(Faces, MeetByEverySchemeThatTakesPenalty) {
  for (const double mu : {0.0, 0.3}) {
    const auto impulse = [&](const char* method, const std::string& scheme) {
      const TemporaryCase given(two_blocks(fmt::format("method = \"{}\"\nfriction = {}", method, mu), scheme));
      EXPECT_EQ(given.run(), ExitCode::good) << method << " " << scheme << ", mu = " << mu;
      return last_row(given.result("contact.csv"))["touch.impulse_z"];
    };
    const double known = impulse("two_pass", "kind = \"central_differences\"\n[time]");
    EXPECT_GT(std::abs(known), 0.0);
    for (const SchemeTraits& scheme : scheme_table) {
      if (!takes(scheme.kind, EnforcementKind::penalty) || scheme.kind == SchemeKind::statics) continue;
      std::string text = fmt::format("kind = \"{}\"\nenforcement = \"penalty\"\n[time]", scheme.name);
      if (!is_explicit(scheme.kind)) text += "\nstep = 2e-6";
      EXPECT_NEAR(impulse("faces", text), known, 0.05 * std::abs(known)) << scheme.name << ", mu = " << mu;
    }
  }
}

// Impulses act on what is closed. What a row was behind when it closed was left, and what opened for a step could close
// again deeper: 0.5 to 0.8 of v h, h being the step. Rows that move let bodies close and no more. What is left is the
// change of the rows within a step, strains of v / c = 0.004 of v h: bound at 0.01.
TEST(Impulses, LetBodiesThatMoveCloseAndNoMore) {
  for (const double mu : {0.0, 0.3}) {
    for (const char* scheme : {"kind = \"cd_lagrange\"\n[time]", "kind = \"moreau_jean\"\n[time]\nstep = 2e-6",
                               "kind = \"nonsmooth_generalized_alpha\"\n[time]\nstep = 2e-6"}) {
      const TemporaryCase given(two_blocks(fmt::format("friction = {}", mu), scheme));
      EXPECT_EQ(given.run(), ExitCode::good) << scheme << ", mu = " << mu;
      const std::vector<double> time = column(given.result("contact.csv"), "time"),
                                depth = column(given.result("contact.csv"), "touch.penetration");
      EXPECT_LT(*std::max_element(depth.begin(), depth.end()), 0.01 * 5.0 * (time[2] - time[1]))
          << scheme << ", mu = " << mu;
    }
  }
}

// Gaps far from the origin are known to the rounding of coordinates, 1e-14 m here; asked for less, the contact nodes
// found no equilibrium. The blocks have parted at the end, so that the impulse is the change of momentum, which the
// three methods see alike: 5 % for meshes of three and four cells.
TEST(ModifiedMass, MeetsPairsFarFromTheOriginByEveryMethod) {
  for (const double mu : {0.0, 0.3}) {
    std::vector<double> impulses;
    for (const char* method : {"node_to_surface", "two_pass", "surface_to_surface"}) {
      const TemporaryCase given(two_blocks(fmt::format("method = \"{}\"\nfriction = {}", method, mu)));
      EXPECT_EQ(given.run(), ExitCode::good) << method << ", mu = " << mu;
      impulses.push_back(last_row(given.result("contact.csv"))["touch.impulse_z"]);
    }
    const auto [least, most] = std::minmax_element(impulses.begin(), impulses.end());
    EXPECT_GT(*least, 0.0);
    EXPECT_LT(*most, 1.05 * *least) << "mu = " << mu;
  }
}

const std::string aligned_bars = R"(units = "SI"
[[mesh.block]]
size = [0.04, 0.04, 0.2]
divisions = [1, 1, 20]
groups = { cells = "LOWER", xmin = "LS", xmax = "LS", ymin = "LS", ymax = "LS", zmin = "LS", zmax = "LS" }
[[mesh.block]]
origin = [0.0, 0.0, 0.20001]
size = [0.04, 0.04, 0.2]
divisions = [3, 3, 20]
groups = { cells = "UPPER", xmin = "US", xmax = "US", ymin = "US", ymax = "US", zmin = "US", zmax = "US" }
[materials.rubber]
law = "linear_elastic"
E = 2e9
nu = 0.0
rho = 1200.0
[[part]]
name = "lower"
cells = "LOWER"
material = "rubber"
[[part]]
name = "upper"
cells = "UPPER"
material = "rubber"
[[initial]]
part = "upper"
velocity = [0.0, 0.0, -2.0]
[[contact]]
name = "touch"
kind = "pair"
group = "US"
master = "LS"
method = "surface_to_surface"
[scheme]
kind = "generalized_alpha"
[time]
end = 3e-4
step = 4e-6
[output]
fields = []
)";

// The sides of two bars in line share the rim of the faces that touch. Once its nodes were behind, the sides took the
// far side of the other bar for something that they were in, and threw the bars apart in the second step. Until the
// wave is back from the free ends, 310 us, the faces press with Z v / 2, Z = sqrt(E rho), from the touch at 5 us on: an
// impulse of A Z v / 2 (t - 5 us). The front takes 8 us through a cell and as long through the springs: 5 % of 295 us.
TEST(SurfaceToSurface, DoesNotTakeTheSidesOfAlignedBarsForDeep) {
  const TemporaryCase given(aligned_bars);
  EXPECT_EQ(given.run(), ExitCode::good);
  const double impulse = last_row(given.result("contact.csv"))["touch.impulse_z"];
  const double exact = 0.04 * 0.04 * std::sqrt(2e9 * 1200.0) * 1.0 * (3e-4 - 5e-6);
  EXPECT_NEAR(impulse, exact, 0.05 * exact);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

// The sides of bars in line never meet: they keep their mass. When they gave it away, bars of two cells across were
// refused, since what was left of them could turn about its axis without inertia, and of bars of three cells 5/9 of
// the mass went from the skin to the inside: the impulse of a bar of half the length was 7 % too small. The same
// impulse as above, of which the front through a cell, 8 us, is 3 %.
TEST(ModifiedMass, TakesItFromFacesThatCanTouchWhereWholeSkinsAreInThePair) {
  for (const char* across : {"[2, 2, 20]", "[3, 3, 20]"}) {
    std::string text = replaced(replaced(aligned_bars, "[1, 1, 20]", across), "[3, 3, 20]", across);
    text = replaced(replaced(text, "kind = \"generalized_alpha\"", "kind = \"modified_mass\""), "step = 4e-6\n", "");
    const TemporaryCase given(text);
    EXPECT_EQ(given.run(), ExitCode::good) << across;
    const double impulse = last_row(given.result("contact.csv"))["touch.impulse_z"];
    const double exact = 0.04 * 0.04 * std::sqrt(2e9 * 1200.0) * 1.0 * (3e-4 - 5e-6);
    EXPECT_NEAR(impulse, exact, 0.03 * exact) << across;
  }
}

/// A bar of ten cells at a five-hundredth of the wave's speed onto a rigid plane.
std::string bar_on_plane(double sideways, double friction, const std::string& enforcement) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
origin = [0.0, 0.0, 1e-6]
size = [0.1, 0.1, 1.0]
divisions = [1, 1, 10]
groups = {{ cells = "BAR", zmin = "FOOT" }}
[materials.steel]
law = "linear_elastic"
E = 2e11
nu = 0.0
rho = 8000.0
[[part]]
name = "bar"
cells = "BAR"
material = "steel"
[[initial]]
part = "bar"
velocity = [{}, 0.0, -10.0]
[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = {}
[scheme]
kind = "newmark"
beta = 0.5
gamma = 0.6
enforcement = "{}"
[time]
end = 3e-4
step = 1e-5
fixed = true
[output]
fields = []
)",
                     sideways, friction, enforcement);
}

// A penetration of a thousandth of a cell, the default tolerance, is half of what this impact shortens a cell by. The
// peak of the force, and the force at every step, are to be right to 1 % of the peak, by exact multipliers.
TEST(AugmentedLagrangian, PressesAsMultipliersDoAtItsDefaultTolerance) {
  for (const auto& [sideways, friction] : {std::pair{0.0, 0.0}, {0.5, 0.3}, {5.0, 0.3}}) {
    SCOPED_TRACE(fmt::format("sideways {}, friction {}", sideways, friction));
    std::vector<std::vector<double>> forces, tangential;
    for (const char* enforcement : {"lagrange", "augmented_lagrangian"}) {
      const TemporaryCase given(bar_on_plane(sideways, friction, enforcement));
      given.run();
      forces.push_back(column(given.result("contact.csv"), "wall.force_z"));
      tangential.push_back(column(given.result("contact.csv"), "wall.force_x"));
    }
    ASSERT_EQ(forces[0].size(), forces[1].size());
    const double peak = *std::max_element(forces[0].begin(), forces[0].end());
    EXPECT_GT(peak, 0.0);
    for (std::size_t i = 0; i < forces[0].size(); ++i) {
      EXPECT_NEAR(forces[1][i], forces[0][i], 0.01 * peak) << "row " << i;
      EXPECT_NEAR(tangential[1][i], tangential[0][i], 0.01 * peak) << "row " << i;
    }
  }
}

}  // namespace
}  // namespace carom::run_pair_schemes_test
