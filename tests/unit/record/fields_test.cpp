// The fields of a run: strain, von Mises stress, parts, and obstacles as a body of their own.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "math/voigt.hpp"
#include "record/frame_plan.hpp"
#include "record/obstacle_bodies.hpp"
#include "run_fixture.hpp"
#include "solid/cell_strain.hpp"
#include "solid/cell_values.hpp"
#include "solid/point_history.hpp"
#include "view/frame_file.hpp"

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
    ASSERT_EQ(strain.size(), simulation.solid().cells().size());
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
  const std::vector<FrameEntry> frames = read_frames(in.results().string());
  ASSERT_EQ(frames.size(), 3U);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_EQ(frames[f].obstacles, fmt::format("fields/obstacles_{:06}.vtkhdf", f));
    const FrameFile obstacles((in.results() / frames[f].obstacles).string());
    EXPECT_NE(obstacles.point_field("displacement"), nullptr);
    EXPECT_EQ(obstacles.cells(), 1U + 24U * 48U);  // the plane's quadrangle, and 24 x 48 of the sphere
  }
  const FrameFile bodies((in.results() / "fields/step_000002.vtkhdf").string());
  for (const char* field : {"von_mises", "strain", "part"}) EXPECT_NE(bodies.cell_field(field), nullptr) << field;
}

TEST(Fields, ObstaclesAtRestAreWrittenOnce) {
  std::string text = test::case_of_block(thrown_at_a_plane);
  text.replace(text.find("velocity = [0.0, 0.0, -0.5]\n"), 28, "");
  const TemporaryCase in(text);
  in.run();
  EXPECT_TRUE(std::filesystem::exists(in.results() / "fields/obstacles_000000.vtkhdf"));
  EXPECT_FALSE(std::filesystem::exists(in.results() / "fields/obstacles_000001.vtkhdf"));
}

// Uniaxial strain e: the trial stress 2 G e exceeds sigma_y by 3 G alpha (radial return without hardening), E = 2 and
// nu = 0.3; to round-off. Laws that do not yield remember nothing.
TEST(Fields, PlasticStrainOfAUniaxialStrain) {
  constexpr double G = 2.0 / 2.6, e = 0.01, yield_stress = 4e-3,
                   H[3][3] = {{e, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  const std::string law = "j2_small_strain\"\nyield_stress = 4e-3 # \"";
  const Simulation simulation(parse_case(resting(law), "case.toml"));
  const Solid& solid = simulation.solid();
  const std::vector<double> u = linear_motion(simulation.mesh(), H), begin = initial_history(solid);
  std::vector<double> f(u.size()), end(begin.size());
  solid.evaluate(u, {0.0, begin}, f, end);
  const std::vector<double> alpha = cell_history(solid, "equivalent_plastic_strain", end);
  ASSERT_EQ(alpha.size(), solid.cells().size());
  for (const double of_cell : alpha) EXPECT_NEAR(of_cell, (2.0 * G * e - yield_stress) / (3.0 * G), 1e-15);
  EXPECT_TRUE(cell_history(solid, "temperature_rise", end).empty());
}

// Only bodies that yield have a plastic strain to show.
TEST(Fields, PlasticStrainOfBodiesThatYield) {
  std::string text = test::case_of_block(thrown_at_a_plane);
  const TemporaryCase elastic(text);
  elastic.run();
  const auto plastic_strain = [](const TemporaryCase& in) {
    return FrameFile((in.results() / "fields/step_000002.vtkhdf").string()).cell_field("equivalent_plastic_strain") !=
           nullptr;
  };
  EXPECT_FALSE(plastic_strain(elastic));
  text.replace(text.find("\"linear_elastic\""), 16, "\"j2_small_strain\"\nyield_stress = 1.0e3");
  const TemporaryCase yielding(text);
  yielding.run();
  EXPECT_TRUE(plastic_strain(yielding));
}

/// Two parts side by side, the cells of one of which go in the middle of the run.
constexpr const char* one_part_goes = R"(units = "SI"
[[mesh.block]]
size = [2.0, 1.0, 1.0]
divisions = [2, 1, 1]
groups = { cells = "GOES" }
[[mesh.block]]
origin = [3.0, 0.0, 0.0]
size = [3.0, 1.0, 1.0]
divisions = [3, 1, 1]
groups = { cells = "STAYS" }
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "stays"
cells = "STAYS"
material = "soft"
[[part]]
name = "goes"
cells = "GOES"
material = "soft"
[[erosion]]
part = "goes"
time = 0.3
[scheme]
kind = "central_differences"
[time]
end = 0.6
step = 0.1
[output]
fields_every = 1
)";

// Cells stand part after part in the files. The cells go at the end of the third step.
TEST(Fields, CellsThatHaveGoneAreHidden) {
  const TemporaryCase one(one_part_goes);
  one.run();
  for (const auto& [step, hidden] : {std::pair{0, 0.0}, {2, 0.0}, {4, 32.0}, {6, 32.0}}) {
    const FrameFile frame((one.results() / fmt::format("fields/step_{:06}.vtkhdf", step)).string());
    const StoredArray* found = frame.cell_field("vtkGhostType");
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->type, StoredArray::Type::uint8);
    ASSERT_EQ(found->entries(), 5U);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(found->at(k), k < 3 ? 0.0 : hidden) << step << " " << k;
  }
  const TemporaryCase other(test::replaced(one_part_goes, "[[erosion]]\npart = \"goes\"\ntime = 0.3\n", ""));
  other.run();
  const FrameFile frame((other.results() / "fields/step_000006.vtkhdf").string());
  EXPECT_EQ(frame.cell_field("vtkGhostType"), nullptr);
}

// n frames take n times as much and cut a run into n - 1 pieces: 50 at most, and one at least.
TEST(Fields, FramesFitABudget) {
  EXPECT_EQ(intervals_within(2e9, 1e6), 50);
  EXPECT_EQ(intervals_within(2e9, 2e9 / 51.0), 50);
  EXPECT_EQ(intervals_within(2e9, 4e8), 4);
  EXPECT_EQ(intervals_within(2e9, 4.1e8), 3);
  EXPECT_EQ(intervals_within(2e9, 3e9), 1);
  EXPECT_EQ(intervals_within(-1.0, 3e9), 1);
  const Simulation small(parse_case(test::case_of_block(thrown_at_a_plane), "case.toml"));
  EXPECT_EQ(frame_note(small), "");
}

// By default frames come at equal times, however many steps lie between them; else by the steps that the case says.
// Times that are sums of steps may miss those of the frames by rounding.
TEST(Fields, FramesComeAtEqualTimesOrAfterSoManySteps) {
  const std::string text = test::case_of_block(thrown_at_a_plane);
  const auto every = [&](const char* steps) { return test::replaced(text, "fields_every = 1", steps); };
  const Simulation by_default(parse_case(every("fields_every = 0"), "case.toml"));
  const FrameClock clock(by_default);
  const long long between = frame_interval(by_default);
  const double dt = by_default.dt(), until = static_cast<double>(between) * dt;
  for (const long long cut : {1, 7}) {  // every step taken in so many
    EXPECT_EQ(clock.due(0, 0.0), 0);
    EXPECT_EQ(clock.due(cut * between - 1, until - dt / static_cast<double>(cut)), 0);
    EXPECT_EQ(clock.due(cut * between, until * (1.0 - 1e-15)), 1);
    EXPECT_EQ(clock.due(cut * by_default.steps(), by_default.end()), by_default.steps() / between);
  }
  const Simulation by_steps(parse_case(every("fields_every = 3"), "case.toml"));
  EXPECT_EQ(FrameClock(by_steps).due(2, by_steps.end()), 0);
  EXPECT_EQ(FrameClock(by_steps).due(3, 0.0), 1);
}

// A case may ask for VTK's files and for double precision; the values are those of the run's own state to round-off of
// the precision: 2^-24 of the value in single, none in double.
TEST(Fields, FormatAndPrecisionAreTheCase) {
  const std::string text =  // in touch from the start, so that there are stresses
      test::replaced(test::case_of_block(thrown_at_a_plane), "point = [0.0, 0.0, -1.0]", "point = [0.0, 0.0, 0.0]");
  const TemporaryCase as_default(text);
  as_default.run();
  const TemporaryCase in_double(text + "precision = \"double\"\nformat = \"vtu\"\n");
  in_double.run();
  EXPECT_FALSE(std::filesystem::exists(in_double.results() / "fields.xdmf"));
  EXPECT_FALSE(std::filesystem::exists(as_default.results() / "fields.pvd"));
  const FrameFile coarse((as_default.results() / "fields/step_000002.vtkhdf").string()),
      fine((in_double.results() / "fields/step_000002.vtu").string());
  ASSERT_EQ(coarse.points(), fine.points());
  const auto compare = [](const StoredArray* a, const StoredArray* b, const char* name) {
    ASSERT_TRUE(a != nullptr && b != nullptr) << name;
    EXPECT_EQ(a->type, NumberType::float32) << name;
    EXPECT_EQ(b->type, NumberType::float64) << name;
    double largest = 0.0;
    for (std::size_t i = 0; i < a->entries(); ++i)
      for (std::size_t c = 0; c < static_cast<std::size_t>(a->components); ++c) {
        EXPECT_EQ(a->at(i, c), static_cast<double>(static_cast<float>(b->at(i, c)))) << name;
        largest = std::max(largest, std::abs(b->at(i, c)));
      }
    EXPECT_GT(largest, 0.0) << name;
  };
  for (const char* name : {"displacement", "velocity"}) compare(coarse.point_field(name), fine.point_field(name), name);
  for (const char* name : {"stress", "strain", "von_mises"})
    compare(coarse.cell_field(name), fine.cell_field(name), name);
}

}  // namespace
}  // namespace carom::run_fields_test
