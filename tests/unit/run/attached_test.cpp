// Point masses and springs: closed forms in every scheme, statics, what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "run_fixture.hpp"

namespace carom::run_attached_test {
namespace {

using namespace test;

/// A bar along x of one cell, mass 3, with a point mass of 0.5 and a spring of 40 at each end: translating, it is an
/// oscillator of mass 4 and stiffness 80. Its own axial stiffness is E A / L = 100 times that.
std::string oscillator(const std::string& law, const std::string& scheme, const std::string& time,
                       const std::string& check) {
  return R"(units = "SI"
[[mesh.block]]
kind = "bar"
end = [2.0, 0.0, 0.0]
divisions = 1
groups = { cells = "BAR" }
[materials.m]
law = ")" +
         law + R"("
E = 8000.0
nu = 0.0
rho = 1.5
[[part]]
name = "bar"
cells = "BAR"
material = "m"
section = "bar"
area = 1.0
[[support]]
nodes = "BAR"
blocked = ["y", "z"]
[[point_mass]]
nodes = "BAR"
total = 1.0
[[spring]]
nodes = "BAR"
stiffness = [40.0, 0.0, 0.0]
[[initial]]
nodes = "all"
velocity = [0.3, 0.0, 0.0]
[output]
fields = []
[[probe]]
name = "bar"
group = "BAR"
quantities = ["displacement"]
[scheme]
kind = )" +
         scheme + "\n[time]\nend = 0.35\n" + time + check;
}

std::string check_of(double value, double tolerance) {
  return "[[check]]\nplace = \"bar\"\nquantity = \"displacement_x\"\nvalue = " + std::to_string(value) +
         "\ntolerance = " + std::to_string(tolerance) + "\n";
}

const double omega = std::sqrt(80.0 / 4.0);

TEST(Attached, OscillatorInEveryScheme) {
  const double u = 0.3 / omega * std::sin(omega * 0.35);  // closed form
  for (const SchemeTraits& rules : scheme_table) {
    if (rules.kind == SchemeKind::statics) continue;
    const std::string kind = "\"" + std::string(rules.name) + "\"";
    // First-order schemes and those that dissipate most: error of the order of omega dt = 0.0045; the others omega^2
    // dt^2 and less.
    const std::string time = is_explicit(rules.kind) ? "" : "step = 1e-3\n";
    for (const char* law : {"linear_elastic", "st_venant_kirchhoff"}) {
      if (rules.kind == SchemeKind::modified_mass) continue;  // needs a contact, which takes the mass away
      const TemporaryCase run(oscillator(law, kind, time, check_of(u, 5e-3)));
      EXPECT_EQ(run.run(), ExitCode::good) << kind << " " << law << "\n" << run.result("summary.json");
    }
  }
}

/// The springs decide the step: 4e6 on a mass of 2 at each end, omega^2 = 2e6 with both ends in phase; the bar's own
/// vibration adds 0.2 %. Without them it is 2 / sqrt(4000).
TEST(Attached, StiffSpringsShortenTheStableStep) {
  std::string text = oscillator("linear_elastic", "\"central_differences\"", "", "");
  text.replace(text.find("40.0"), 4, "4e6");
  const Simulation simulation(parse_case(text, "case.toml"));
  EXPECT_LE(simulation.stable().dt, 2.0 / std::sqrt(2e6));
  EXPECT_GE(simulation.stable().dt, 0.9 * 2.0 / std::sqrt(2e6));
}

/// Springs of 45 along z in all at the 9 nodes of the foot carry the weight of 18 (block) and 2 (point masses) at g =
/// 3e-4: the foot's mean displacement is -6e-3 / 45, whatever the block does.
std::string standing(const std::string& solver) {
  return case_of_block(R"([[point_mass]]
nodes = "HEAD"
total = 2.0
[[spring]]
nodes = "FOOT"
total_stiffness = [9.0, 18.0, 45.0]
[[load]]
gravity = [0.0, 0.0, -3e-4]
[[probe]]
name = "foot"
group = "FOOT"
quantities = ["displacement"]
[output]
fields = []
[[check]]
place = "foot"
quantity = "displacement_z"
value = -1.3333333333333333e-4
tolerance = 1e-9
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
[solver]
kind = ")" + solver + "\"\n");
}

TEST(Attached, SpringsCarryABodyInStatics) {
  for (const char* solver : {"cholmod", "mumps", "cg", "multigrid"}) {
    const TemporaryCase run(standing(solver));
    EXPECT_EQ(run.run(), ExitCode::good) << solver << "\n" << run.result("summary.json");
  }
}

/// Two bars with E A / L = 4 each, one behind the other 1 apart, and a spring of 2 between them, pulled by 8: the end
/// moves by 8 (1/4 + 1/2 + 1/4).
std::string two_bars(const std::string& spring) {
  return R"(units = "SI"
[[mesh.block]]
kind = "bar"
end = [1.0, 0.0, 0.0]
divisions = 1
groups = { cells = "A", start = "A0", end = "A1" }
[[mesh.block]]
kind = "bar"
origin = [2.0, 0.0, 0.0]
end = [3.0, 0.0, 0.0]
divisions = 1
groups = { cells = "B", start = "B0", end = "B1" }
[materials.m]
law = "linear_elastic"
E = 4.0
nu = 0.0
rho = 1.0
[[part]]
name = "bars"
cells = "all"
material = "m"
section = "bar"
area = 1.0
[[support]]
nodes = "all"
blocked = ["y", "z"]
[[support]]
nodes = "A0"
blocked = ["x"]
[[load]]
group = "B1"
force = [8.0, 0.0, 0.0]
)" + spring +
         R"([output]
fields = []
[[probe]]
name = "end"
group = "B1"
quantities = ["displacement"]
[[check]]
place = "end"
quantity = "displacement_x"
value = 8.0
tolerance = 1e-9
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)";
}

TEST(Attached, SpringsJoinBodies) {
  const TemporaryCase run(two_bars("[[spring]]\nnodes = \"A1\"\nto = \"B0\"\naxial = 2.0\n"));
  EXPECT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
}

TEST(Attached, RefusesWhatHasNoMeaning) {
  const auto message = [](const std::string& spring) { return std::string(case_error(two_bars(spring)).what()); };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(message("[[spring]]\nnodes = \"A1\"\nto = \"A1\"\naxial = 2.0\n"), "at one place"));
  EXPECT_TRUE(has(message("[[spring]]\nnodes = \"A1\"\nto = \"B\"\naxial = 2.0\n"), "2 nodes in \"B\" against 1"));
  EXPECT_TRUE(has(message("[[spring]]\nnodes = \"A\"\nto = \"B\"\naxial = 2.0\n"), "the nearest to two nodes"));
  EXPECT_THROW(parse_case(two_bars("[[spring]]\nnodes = \"A1\"\naxial = 2.0\n"), ""), CaseError);
  EXPECT_THROW(parse_case(two_bars("[[spring]]\nnodes = \"A1\"\nstiffness = [0, 0, 0]\n"), ""), CaseError);
  EXPECT_THROW(parse_case(two_bars("[[point_mass]]\nnodes = \"A1\"\nmass = 1\ntotal = 2\n"), ""), CaseError);
}

}  // namespace
}  // namespace carom::run_attached_test
