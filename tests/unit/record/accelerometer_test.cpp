// Accelerations along axes that turn with a body.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vec3.hpp"
#include "record/turning_axes.hpp"
#include "run_fixture.hpp"

namespace carom::run_accelerometer_test {
namespace {

using namespace test;

/// A brick of 1 x 2 x 3 about the origin that flies along x and turns about z at 2 radians per second, for a turn and a
/// half; the scheme damps its vibrations, and what it is made of hardly gives way. Probes stand half a length from the
/// axis in front, and one length beside it.
std::string spinning(const std::string& more) {
  return R"(units = "SI"
[[mesh.block]]
origin = [-0.5, -1.0, -1.5]
size = [1.0, 2.0, 3.0]
divisions = [2, 2, 3]
groups = { cells = "BRICK", xmax = "FRONT" }
[materials.hard]
law = "neo_hookean"
E = 2.0e5
nu = 0.3
rho = 2.0
[[part]]
name = "brick"
cells = "BRICK"
material = "hard"
[[initial]]
part = "brick"
velocity = [0.7, 0.0, 0.0]
angular_velocity = [0.0, 0.0, 2.0]
centre = [0.0, 0.0, 0.0]
[scheme]
kind = "bathe"
[time]
end = 4.7
step = 0.02
[[probe]]
name = "front"
point = [0.5, 0.0, -0.5]
quantities = ["acceleration", "local_acceleration"]
[[probe]]
name = "beside"
point = [0.0, 1.0, 0.5]
quantities = ["local_acceleration"]
[[probe]]
name = "face"
group = "FRONT"
quantities = ["local_acceleration"]
)" + more;
}

// A point at the distance r from the axis is pulled towards the axis with w^2 r, which along turning axes stays the
// same; so does the mean of a face, whose middle is at 0.5. The scheme errs by (w dt)^2 = 1.6e-3 of it; what it is made
// of stretches by rho w^2 L^2 / E = 1e-4, and its vibrations have gone after 2 (with half of the step the error is a
// quarter).
TEST(Accelerometer, OfASpinningBodyReadsTheSpinSquaredTimesTheRadius) {
  for (const char* more : {"", "[[rigid_body]]\nname = \"brick\"\nparts = [\"brick\"]\n"}) {
    SCOPED_TRACE(more);
    const TemporaryCase in(spinning(more));
    ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
    Columns rows = test::read_csv(in.result("probes.csv"));
    double largest = 0.0;
    for (std::size_t i = 0; i < rows["time"].size(); ++i) {
      if (rows["time"][i] < 2.0) continue;
      constexpr double tolerance = 1.6e-3 * 4.0 * 0.5;
      EXPECT_NEAR(rows["front.local_acceleration_x"][i], -4.0 * 0.5, tolerance);
      EXPECT_NEAR(rows["front.local_acceleration_y"][i], 0.0, tolerance);
      EXPECT_NEAR(rows["front.local_acceleration_z"][i], 0.0, tolerance);
      EXPECT_NEAR(rows["beside.local_acceleration_x"][i], 0.0, tolerance);
      EXPECT_NEAR(rows["beside.local_acceleration_y"][i], -4.0 * 1.0, 2.0 * tolerance);
      EXPECT_NEAR(rows["face.local_acceleration_x"][i], -4.0 * 0.5, tolerance);
      largest = std::max(largest, rows["front.acceleration_x"][i]);
    }
    EXPECT_GT(largest, 1.9);  // along axes that stay it comes to the other sign: the body has turned over
  }
}

/// Columns of the turn by an angle about the axis n of length 1 (Rodrigues).
Columns3 turn(const Vec3& n, double angle) {
  Columns3 R{};
  for (std::size_t c = 0; c < 3; ++c) {
    Vec3 e{};
    e[c] = 1.0;
    R[c] = add(add(scaled(e, std::cos(angle)), scaled(cross(n, e), std::sin(angle))),
               scaled(n, dot(n, e) * (1.0 - std::cos(angle))));
  }
  return R;
}

/// Displacements x = R (U X) + a shift.
std::vector<double> moved(const Mesh& mesh, const Columns3& R, const Vec3& stretch, double shear) {
  std::vector<double> u;
  for (const Vec3& X : mesh.coordinates) {
    const Vec3 y{stretch[0] * X[0] + shear * X[1], shear * X[0] + stretch[1] * X[1], stretch[2] * X[2]};
    const Vec3 x = add(add(scaled(R[0], y[0]), scaled(R[1], y[1])), scaled(R[2], y[2]));
    for (std::size_t c = 0; c < 3; ++c) u.push_back(x[c] - X[c] + 3.0);
  }
  return u;
}

void expect_axes(const std::string& text, const Columns3& R, const Vec3& stretch, double shear) {
  const Simulation simulation(parse_case(text, "case.toml"));
  const TurningAxes axes(simulation.given().probes.at(0), std::vector<Index>{0}, simulation);
  const Columns3 found = axes.at(moved(simulation.mesh(), R, stretch, shear), {});
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(norm(subtract(found[c], R[c])), 1e-13) << text;  // rounding
}

const std::string probe = R"([scheme]
kind = "newmark"
[time]
end = 1.0
step = 0.5
[[probe]]
name = "p"
node = 1
quantities = ["local_acceleration"]
)";

std::string plane_case(const std::string& section) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
kind = "quad"
size = [2.0, 1.0]
divisions = [2, 3]
groups = {{ cells = "SHEET" }}
[materials.soft]
law = "neo_hookean"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "sheet"
cells = "SHEET"
material = "soft"
section = "{}"
)",
                     section) +
         probe;
}

// x = R U X has the axes R by the polar decomposition, whatever the stretch U and the shift; in the plane with the
// normal for a third axis.
TEST(Accelerometer, AxesAreTheRotationOfTheCells) {
  expect_axes(case_of_block(probe), turn(normalized({1.0, 2.0, -0.5}), 2.5), {1.3, 0.8, 1.1}, 0.2);
  expect_axes(plane_case("plane_strain"), turn({0.0, 0.0, 1.0}, -2.0), {1.3, 0.8, 1.0}, 0.2);
}

// The nodes of a cell that has gone fly anywhere, and the axes are those of the cells that are there still.
TEST(Accelerometer, AxesAreThoseOfTheCellsThatAreThere) {
  const Simulation simulation(parse_case(case_of_block(probe), "case.toml"));
  const BodyCells& cells = simulation.solid().cells();
  const std::vector<Index> edge{cells.nodes_of(0)[0], cells.nodes_of(1)[1]};  // on a line through two cells
  const TurningAxes axes(simulation.given().probes.at(0), edge, simulation);
  const Columns3 R = turn(normalized({1.0, 2.0, -0.5}), 2.5);
  const std::vector<double> together = moved(simulation.mesh(), R, {1.3, 0.8, 1.1}, 0.2);
  std::vector<double> apart = together;
  const auto kept = cells.nodes_of(0);
  for (Index n = 0; n < static_cast<Index>(apart.size() / 3); ++n)
    if (std::find(kept.begin(), kept.end(), n) == kept.end()) apart[static_cast<std::size_t>(3 * n)] += 0.3 * n;
  std::vector<std::uint8_t> alive(cells.size(), 0);
  const auto error = [&](const std::vector<double>& u) {
    double largest = 0.0;
    const Columns3 found = axes.at(u, alive);
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, norm(subtract(found[c], R[c])));
    return largest;
  };
  EXPECT_LT(error(together), 1e-13);  // none is there: all of them say it, as long as they stay together
  EXPECT_GT(error(apart), 1e-3);
  alive[0] = 1;
  EXPECT_LT(error(apart), 1e-13);
}

TEST(Accelerometer, IsRefusedWhereNobodyKnowsHowABodyTurns) {
  const std::string bar = R"(units = "SI"
[[mesh.block]]
kind = "bar"
origin = [0.0, 0.0, 0.0]
end = [2.0, 1.0, 0.0]
divisions = 2
groups = { cells = "BAR" }
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.0
rho = 1.5
[[part]]
name = "bar"
cells = "BAR"
material = "soft"
section = "bar"
area = 0.1
)" + probe;
  const Simulation simulation(parse_case(bar, "case.toml"));
  try {
    const TurningAxes axes(simulation.given().probes.at(0), std::vector<Index>{0}, simulation);
    ADD_FAILURE() << "no error";
  } catch (const CaseError& e) {
    EXPECT_EQ(e.key(), "probe.quantities");
    EXPECT_NE(std::string(e.what()).find("cells lie on one line"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace carom::run_accelerometer_test
