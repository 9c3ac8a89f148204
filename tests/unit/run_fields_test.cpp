// The fields of a run: strain, von Mises stress, parts, and obstacles as a body of their own.
#include <array>
#include <cmath>

#include "math/voigt.hpp"
#include "run/obstacle_bodies.hpp"
#include "run_fixture.hpp"
#include "solid/cell_strain.hpp"

namespace carom::run_fields_test {
namespace {

using test::TemporaryCase;

// Uniaxial stress s: s; pure shear t: sqrt(3) t (von Mises 1913); a hydrostatic state none.
TEST(Fields, VonMisesStress) {
  EXPECT_DOUBLE_EQ(von_mises({5.0, 0.0, 0.0, 0.0, 0.0, 0.0}), 5.0);
  EXPECT_DOUBLE_EQ(von_mises({0.0, 0.0, 0.0, 0.0, 2.0, 0.0}), 2.0 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(von_mises({3.0, 3.0, 3.0, 0.0, 0.0, 0.0}), 0.0);
}

/// u = H x on the nodes of the block.
std::vector<double> linear_motion(const Mesh& mesh, const double H[3][3]) {
  std::vector<double> u;
  for (const Vec3& x : mesh.coordinates)
    for (std::size_t i = 0; i < 3; ++i) u.push_back(H[i][0] * x[0] + H[i][1] * x[1] + H[i][2] * x[2]);
  return u;
}

std::string resting(const std::string& law) {
  std::string text = test::case_of_block("[scheme]\nkind = \"newmark\"\n[time]\nend = 1.0\nstep = 0.5\n");
  text.replace(text.find("linear_elastic"), 14, law);
  return text;
}

// A linear displacement has one strain: its symmetric gradient, or (F^T F - 1) / 2 with finite strain; to round-off.
TEST(Fields, StrainOfALinearDisplacement) {
  constexpr double H[3][3] = {{0.01, 0.04, 0.0}, {0.0, -0.02, 0.0}, {0.03, 0.0, 0.05}};
  for (const double finite : {0.0, 1.0}) {
    const Case given = parse_case(resting(finite > 0.0 ? "neo_hookean" : "linear_elastic"), "case.toml");
    const Simulation simulation(given);
    const auto strain = cell_strain(simulation.model(), linear_motion(simulation.mesh(), H));
    ASSERT_EQ(strain.size(), simulation.solid().cell_count());
    constexpr std::array<std::array<std::size_t, 2>, 6> voigt{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    for (const auto& of_cell : strain) {
      for (std::size_t c = 0; c < 6; ++c) {
        const auto [i, j] = voigt[c];
        double expected = 0.5 * (H[i][j] + H[j][i]);
        for (std::size_t k = 0; k < 3; ++k) expected += 0.5 * finite * H[k][i] * H[k][j];
        EXPECT_NEAR(of_cell[c], expected, 1e-15);
      }
    }
  }
}

constexpr const char* thrown_at_a_plane = R"(
[[initial]]
part = "body"
velocity = [0.0, 0.0, -0.1]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, -1.0]
normal = [0.0, 0.0, 1.0]
stiffness = 1.0
[[contact]]
name = "ram"
kind = "sphere"
group = "HEAD"
centre = [1.0, 1.0, 9.0]
radius = 2.0
velocity = [0.0, 0.0, -0.5]
stiffness = 1.0
[scheme]
kind = "newmark"
[time]
end = 1.0
step = 0.5
[output]
fields_every = 1
)";

TEST(Fields, ObstaclesAreABodyOfTheirOwn) {
  const TemporaryCase in(test::case_of_block(thrown_at_a_plane));
  in.run();
  const std::string pvd = in.result("fields.pvd");
  for (const char* frame : {"000000", "000001", "000002"}) {
    EXPECT_NE(pvd.find(std::string("part=\"1\" file=\"fields/obstacles_") + frame), std::string::npos) << pvd;
    const std::string vtu = in.result(std::string("fields/obstacles_") + frame + ".vtu");
    EXPECT_NE(vtu.find("Name=\"displacement\""), std::string::npos);
    // The plane's quadrangle, and 24 x 48 of the sphere.
    EXPECT_NE(vtu.find("NumberOfCells=\"" + std::to_string(1 + 24 * 48) + "\""), std::string::npos);
  }
  const std::string bodies = in.result("fields/step_000002.vtu");
  for (const char* field : {"von_mises", "strain", "part"})
    EXPECT_NE(bodies.find(std::string("Name=\"") + field + "\""), std::string::npos) << field;
}

TEST(Fields, ObstaclesAtRestAreWrittenOnce) {
  std::string text = test::case_of_block(thrown_at_a_plane);
  text.replace(text.find("velocity = [0.0, 0.0, -0.5]\n"), 28, "");
  const TemporaryCase in(text);
  in.run();
  EXPECT_TRUE(std::filesystem::exists(in.results() / "fields/obstacles_000000.vtu"));
  EXPECT_FALSE(std::filesystem::exists(in.results() / "fields/obstacles_000001.vtu"));
}

// Uniaxial strain e: the trial stress 2 G e exceeds sigma_y by 3 G alpha (radial return without hardening), E = 2 and
// nu = 0.3; to round-off. Laws that do not yield remember nothing.
TEST(Fields, PlasticStrainOfAUniaxialStrain) {
  constexpr double G = 2.0 / 2.6, e = 0.01, yield_stress = 4e-3,
                   H[3][3] = {{e, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  const std::string law = "j2_small_strain\"\nyield_stress = 4e-3 # \"";
  const Simulation simulation(parse_case(resting(law), "case.toml"));
  const Solid& solid = simulation.solid();
  const std::vector<double> u = linear_motion(simulation.mesh(), H), begin = solid.initial_history();
  std::vector<double> f(u.size()), end(begin.size());
  solid.evaluate(u, {0.0, begin}, f, end);
  const std::vector<double> alpha = solid.cell_history("equivalent_plastic_strain", end);
  ASSERT_EQ(alpha.size(), solid.cell_count());
  for (const double of_cell : alpha) EXPECT_NEAR(of_cell, (2.0 * G * e - yield_stress) / (3.0 * G), 1e-15);
  EXPECT_TRUE(solid.cell_history("temperature_rise", end).empty());
}

// Only bodies that yield have a plastic strain to show.
TEST(Fields, PlasticStrainOfBodiesThatYield) {
  std::string text = test::case_of_block(thrown_at_a_plane);
  const TemporaryCase elastic(text);
  elastic.run();
  EXPECT_EQ(elastic.result("fields/step_000002.vtu").find("equivalent_plastic_strain"), std::string::npos);
  text.replace(text.find("\"linear_elastic\""), 16, "\"j2_small_strain\"\nyield_stress = 1.0e3");
  const TemporaryCase yielding(text);
  yielding.run();
  EXPECT_NE(yielding.result("fields/step_000002.vtu").find("equivalent_plastic_strain"), std::string::npos);
}

}  // namespace
}  // namespace carom::run_fields_test
