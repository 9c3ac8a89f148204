// Steps and results do not depend on a velocity that all bodies and obstacles have in common; steps that are shortened
// are named.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "model/compatibility.hpp"
#include "run_fixture.hpp"

namespace carom::run_galilean_test {
namespace {

using namespace test;

constexpr const char* explicit_times = "[time]\nend = 1.2e-4\n";
constexpr const char* implicit_times = "[time]\nend = 1.2e-4\nstep = 4e-6\n";

std::string block(double x, double y, double z, const char* name, double v, const Vec3& u) {
  return fmt::format(R"([[mesh.block]]
origin = [{0}, {1}, {2}]
size = [0.1, 0.1, 0.1]
divisions = [3, 3, 3]
groups = {{ cells = "{3}", zmin = "{3}_FOOT", zmax = "{3}_HEAD" }}
[[part]]
name = "{3}"
cells = "{3}"
material = "steel"
[[initial]]
part = "{3}"
velocity = [{4}, {5}, {6}]
)",
                     x, y, z, name, u[0], u[1], u[2] + v);
}

constexpr const char* head = R"(units = "SI"
[materials.steel]
law = "linear_elastic"
E = 2.1e11
nu = 0.3
rho = 7800.0
[output]
fields = []
)";

/// A block that falls on a plane at 4 m/s, both with the velocity u.
std::string on_plane(const std::string& scheme, const char* time, const Vec3& u) {
  return head + block(0.0, 0.0, 1.1e-4, "A", -4.0, u) +
         fmt::format(
             "[[contact]]\nname = \"c\"\nkind = \"plane\"\ngroup = \"A_FOOT\"\npoint = [0.0, 0.0, 0.0]\n"
             "normal = [0.0, 0.0, 1.0]\nvelocity = [{}, {}, {}]\n",
             u[0], u[1], u[2]) +
         scheme + time;
}

/// A block that meets another one beside its middle.
std::string on_block(const std::string& scheme, const char* time, const Vec3& u) {
  return head + block(0.0, 0.0, 0.0, "B", 0.0, u) + block(0.02, 0.013, 0.1 + 1.1e-4, "A", -4.0, u) +
         "[[contact]]\nname = \"c\"\nkind = \"pair\"\ngroup = \"A_FOOT\"\nmaster = \"B_HEAD\"\n" + scheme + time;
}

struct Seen {
  std::vector<double> time, force, steps;
};

Seen see(const std::string& text) {
  const TemporaryCase one(text);
  EXPECT_NE(one.run(), ExitCode::run_failed) << one.result("summary.json");
  const Columns contact = read_csv(one.result("contact.csv"));
  return {contact.at("time"), contact.at("c.force_z"), column(one.result("energy.csv"), "step")};
}

/// The way of the common motion, 7 mm, is a thousand times the depth of the impact: its rounding is 1e-13 of the force,
/// which springs that open and close and the lag of the schemes make 1e-6 of. Implicit steps are solved to 1e-12 of the
/// energy, which the common velocity makes 240 times as large: the square root of both is the error of forces, and
/// twice that where a step has two solves (contact-stabilised Newmark's predictor and its step).
constexpr double of_explicit = 1e-6, of_implicit = 3.2e-5;

void expect_same(const Seen& rest, const Seen& moving, double tolerance) {
  ASSERT_EQ(rest.steps.back(), moving.steps.back());
  ASSERT_EQ(rest.time.size(), moving.time.size());
  const auto [least, most] = std::minmax_element(rest.force.begin(), rest.force.end());
  const double peak = std::max(-*least, *most);
  EXPECT_GT(peak, 1e3);
  for (std::size_t i = 0; i < rest.time.size(); ++i) {
    EXPECT_NEAR(rest.time[i], moving.time[i], 1e-9 * rest.time.back());
    ASSERT_NEAR(rest.force[i], moving.force[i], tolerance * peak) << i;
  }
}

const Vec3 common{30.0, -20.0, 50.0};

TEST(Galilean, ImpactsOnAPlaneAreTheSame) {
  for (const SchemeTraits& scheme : scheme_table) {
    if (scheme.kind == SchemeKind::statics) continue;
    SCOPED_TRACE(scheme.name);
    const std::string kind = fmt::format("[scheme]\nkind = \"{}\"\n", scheme.name);
    const char* time = is_explicit(scheme.kind) ? explicit_times : implicit_times;
    expect_same(see(on_plane(kind, time, {})), see(on_plane(kind, time, common)),
                is_explicit(scheme.kind) ? of_explicit : of_implicit);
  }
}

TEST(Galilean, ImpactsOfBodiesAreTheSame) {
  for (const char* name : {"central_differences", "cd_lagrange", "hulbert_chung", "newmark", "moreau_jean"}) {
    SCOPED_TRACE(name);
    const std::string kind = fmt::format("[scheme]\nkind = \"{}\"\n", name);
    const bool has_step = std::string(name) == "newmark" || std::string(name) == "moreau_jean";
    const char* time = has_step ? implicit_times : explicit_times;
    expect_same(see(on_block(kind, time, {})), see(on_block(kind, time, common)), has_step ? of_implicit : of_explicit);
  }
}

// A common velocity along the plane alone: the plane stays where it is.
TEST(Galilean, SlidingAlongAPlaneChangesNoStep) {
  const std::string kind = "[scheme]\nkind = \"central_differences\"\n";
  const std::string sliding =
      replaced(on_plane(kind, explicit_times, {30.0, -20.0, 0.0}), "velocity = [30, -20, 0]\n[scheme]", "[scheme]");
  expect_same(see(on_plane(kind, explicit_times, {})), see(sliding), of_explicit);
}

// ---- what shortens steps

// All modes of a free linear body at once: the scheme lends much of their energy (Krenk), and takes it back; nothing is
// made. The steps were a third of those foretold.
TEST(ShortSteps, AreNotTakenByALinearBodyThatVibrates) {
  const std::string text = std::string(head) + R"toml([[mesh.block]]
size = [0.01, 0.01, 0.01]
divisions = [4, 4, 4]
groups = { cells = "A" }
[[part]]
name = "A"
cells = "A"
material = "steel"
[[initial]]
part = "A"
velocity_field = ["0.01*sin(7919*x+5077*y+3331*z)", "0.01*sin(6553*y+4099*z+2203*x)", "0.01*sin(8111*z+3571*x+991*y)"]
[scheme]
kind = "central_differences"
[time]
end = 3e-5
)toml";
  const Simulation simulation(parse_case(text, "case.toml"));
  const TemporaryCase one(text);
  EXPECT_NE(one.run(), ExitCode::run_failed);
  EXPECT_EQ(column(one.result("energy.csv"), "step").back(), static_cast<double>(simulation.steps()));
  EXPECT_EQ(one.result("summary.json").find("steps: shortened"), std::string::npos);
}

// One line for each reason, with the place and what helps.
TEST(ShortSteps, AreNamedInTheLog) {
  const TemporaryCase one(on_plane("[scheme]\nkind = \"central_differences\"\n", explicit_times, {}));
  EXPECT_EQ(one.run(), ExitCode::good);
  const std::string summary = one.result("summary.json");
  std::size_t lines = 0;
  for (std::size_t at = summary.find("steps: shortened"); at != std::string::npos;
       at = summary.find("steps: shortened", at + 1))
    ++lines;
  EXPECT_GE(lines, 1U) << summary;
  EXPECT_LE(lines, 2U) << summary;
  EXPECT_NE(summary.find("contact.stiffness"), std::string::npos);
  EXPECT_NE(summary.find("the shortest was step"), std::string::npos);
}

}  // namespace
}  // namespace carom::run_galilean_test
