// What users ran into: each test is a case that once ended wrong.
#include <gtest/gtest.h>

#include <cmath>

#include "run_fixture.hpp"

namespace carom::run_regressions_test {
namespace {

using namespace test;

/// The rows of a CSV text as {column: value} of the last one whose time is at most t.
double value_at(const std::string& csv, const std::string& name, double t) {
  std::istringstream lines(csv);
  std::string line, cell;
  std::vector<std::string> names;
  double value = std::nan("");
  while (std::getline(lines, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    for (std::istringstream row(line); std::getline(row, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    if (std::stod(cells[0]) > t) break;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (names[i] == name) value = std::stod(cells[i]);
    }
  }
  return value;
}

const char* const newmark = R"(
[scheme]
kind = "newmark"
beta = 0.28
gamma = 0.55
[time]
end = 4.0
step = 0.02
)";
const char* const central_differences = R"(
[scheme]
kind = "central_differences"
[time]
end = 4.0
)";

const char* const functions = R"(
[functions.late]
kind = "step"
time = 1.0
before = 0.0
after = 1.0
[functions.pulse]
time = [0.0, 0.5, 1.0]
value = [0.0, 1.0, 0.0]
)";

/// Runs the block under `section`; returns the summary where the run has failed, or "".
std::string failure(const std::string& section, const char* scheme) {
  const TemporaryCase one(case_of_block(functions + section + scheme));
  return one.run() == ExitCode::run_failed ? section + one.result("summary.json") : "";
}

// In the first step the scheme holds a good part of the energy itself; that is not growth.
TEST(RunRegressions, LoadsMayBeginAtRest) {
  for (const char* scheme : {newmark, central_differences}) {
    EXPECT_EQ(failure(R"(
[[load]]
force = [0.0, 0.001, 0.0]
group = "HEAD"
function = "late"
)",
                      scheme),
              "");
    EXPECT_EQ(failure(R"(
[[load]]
pressure = 0.01
group = "HEAD"
function = "pulse"
)",
                      scheme),
              "");
  }
}

TEST(RunRegressions, MotionsMayBeginAtRest) {
  for (const char* scheme : {newmark, central_differences}) {
    EXPECT_EQ(failure(R"(
[[support]]
nodes = "HEAD"
velocity = { z = -0.01, function = "late" }
)",
                      scheme),
              "");
    EXPECT_EQ(failure(R"(
[[support]]
nodes = "HEAD"
acceleration = { z = -0.01 }
)",
                      scheme),
              "");
  }
}

// A plane at no distance: central differences hold the contact's energy for a step.
TEST(RunRegressions, AnImpactMayBeginInTheFirstStep) {
  for (const char* scheme : {newmark, central_differences}) {
    const TemporaryCase one(case_of_block(R"(
[[initial]]
part = "body"
velocity = [0.0, 0.0, -0.01]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
stiffness = 2.0
)" + std::string(scheme)));
    EXPECT_NE(one.run(), ExitCode::run_failed) << one.result("summary.json");
  }
}

// Rows that move are checked against 1e-12 of the energy, shared out over 200 steps: forces that missed their cone by
// 1e-10 never met that.
TEST(RunRegressions, SlidingSurfacesOnMultipliersSettle) {
  for (const char* friction : {"0.0", "0.2"}) {
    const TemporaryCase one(R"(title = "A block slides over a plate on multipliers"
[[mesh.block]]
size = [6.0, 4.0, 1.0]
divisions = [6, 4, 1]
groups = { cells = "PLATE", zmin = "GROUND", zmax = "TABLE" }
[[mesh.block]]
origin = [0.63, 0.71, 1.0]
size = [2.0, 2.0, 2.0]
divisions = [2, 2, 2]
groups = { cells = "BLOCK", zmin = "FOOT", zmax = "TOP" }
[materials.unit]
law = "linear_elastic"
E = 1000.0
nu = 0.3
rho = 1.0
[[part]]
name = "plate"
cells = "PLATE"
material = "unit"
[[part]]
name = "block"
cells = "BLOCK"
material = "unit"
[[support]]
nodes = "GROUND"
blocked = ["x", "y", "z"]
[[initial]]
part = "block"
velocity = [0.5, 0.0, -0.1]
[[load]]
group = "TOP"
pressure = 0.5
[[contact]]
name = "table"
kind = "pair"
group = "FOOT"
master = "TABLE"
method = "node_to_surface"
friction = )" + std::string(friction) +
                            R"(
[scheme]
kind = "hht"
alpha = -0.2
enforcement = "lagrange"
[time]
end = 4.0
step = 0.02
fixed = true
)");
    EXPECT_EQ(one.run(), ExitCode::good) << friction << one.result("summary.json");
  }
}

// Friction feeds vibrations of an elastic block, which Newmark's trapezoidal rule does not damp, until its nodes leave
// the ground and come back. What friction took in steps in which they left or came was in no book: 14 % of the energy,
// which hid what the springs made. v^2 / (2 mu g) is the way of a rigid block; to 0.5 %, since this one vibrates where
// it stops (with steps of a fifth: 0.33 % farther).
TEST(RunRegressions, ABlockThatSlidesOnSpringsUnderNewmarkKeepsItsBooks) {
  const TemporaryCase one(R"(title = "A block slides to rest"
units = "SI"
[[mesh.block]]
size = [0.1, 0.1, 0.1]
divisions = [2, 2, 2]
groups = { cells = "BLOCK", zmin = "FOOT" }
[materials.rubber]
law = "linear_elastic"
E = 1e8
nu = 0.3
rho = 1000.0
[[part]]
name = "block"
cells = "BLOCK"
material = "rubber"
[[initial]]
part = "block"
velocity = [1.0, 0.0, 0.0]
[[load]]
gravity = [0.0, 0.0, -9.81]
[[contact]]
name = "ground"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = 0.3
[scheme]
kind = "newmark"
enforcement = "penalty"
[time]
end = 0.4
step = 1e-3
[[probe]]
name = "block"
group = "BLOCK"
quantities = ["displacement"]
)");
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  const double way = 1.0 / (2.0 * 0.3 * 9.81), energy = 0.5;
  EXPECT_NEAR(value_at(one.result("probes.csv"), "block.displacement_x", 1.0), way, 0.005 * way);
  // a thousandth: the guard on steps lets the springs make 5e-4 of the largest energy of the vibrations
  EXPECT_NEAR(value_at(one.result("energy.csv"), "friction", 1.0), energy, 1e-3 * energy);
  EXPECT_NEAR(value_at(one.result("energy.csv"), "quadrature", 1.0), 0.0, 1e-3 * energy);
}

// Head and foot fly apart: the momenta of the halves cancel, so there is no momentum to compare an error with.
TEST(RunRegressions, MomentaThatCancelAreBalanced) {
  const TemporaryCase one(case_of_block(R"(
[[initial]]
nodes = "HEAD"
velocity = [0.0, 0.0, 0.1]
[[initial]]
nodes = "FOOT"
velocity = [0.0, 0.0, -0.1]
)" + std::string(newmark)));
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
}

TEST(RunRegressions, ChecksSeeEveryStepWhateverTheRows) {
  const std::string body = R"(
[[initial]]
nodes = "HEAD"
velocity = [0.0, 0.0, 0.1]
[[probe]]
name = "head"
group = "HEAD"
quantities = ["velocity"]
)" + std::string(newmark);
  const TemporaryCase every(case_of_block(body));
  every.run();
  const double reference = value_at(every.result("probes.csv"), "head.velocity_z", 1.24 + 1e-9);  // the 62nd step
  const TemporaryCase few(case_of_block(body + R"(
[output]
curves_every = 50
[[check]]
quantity = "velocity_z"
place = "head"
time = 1.24
tolerance = 1e-12
source = "the same run with a row for every step; the same numbers but for the printed digits"
value = )" + std::to_string(0.0) + "\nabsolute = true\n"));
  few.run();
  const std::string summary = few.result("summary.json");
  const std::size_t at = summary.find("\"value\": ", summary.find("\"checks\""));
  ASSERT_NE(at, std::string::npos) << summary;
  EXPECT_EQ(std::stod(summary.substr(at + 9)), reference);
}

TEST(RunRegressions, FilteredCurvesReachTheEndWhereTheRowsAreNotEquidistant) {
  const TemporaryCase one(case_of_block(R"(
[[initial]]
nodes = "HEAD"
velocity = [0.0, 0.0, 0.1]
[[probe]]
name = "a"
group = "HEAD"
quantities = ["velocity"]
cfc = 0.1
[[probe]]
name = "a.b"
group = "FOOT"
quantities = ["velocity"]
[output]
curves_every = 30
)" + std::string(newmark)));
  one.run();
  const std::string filtered = one.result("probes_filtered.csv");
  EXPECT_DOUBLE_EQ(last_row(filtered)["time"], 4.0);              // rows at 0.6 k, and at the end
  EXPECT_EQ(filtered.find("a.b.velocity_z"), std::string::npos);  // another probe, which asks for no filter
}

TEST(RunRegressions, BlockedNodesStayWhereTheInitialStatePutsThem) {
  const TemporaryCase one(case_of_block(R"(
[[initial]]
part = "body"
displacement = [0.0, 0.0, 0.5]
[[support]]
nodes = "FOOT"
blocked = ["z"]
[[probe]]
name = "foot"
group = "FOOT"
quantities = ["displacement"]
[[check]]
quantity = "displacement_z"
place = "foot"
value = 0.5
tolerance = 1e-15
source = "nothing moves it"
[[check]]
quantity = "energy.strain"
value = 0.0
absolute = true
tolerance = 1e-15
source = "a uniform displacement strains nothing; round-off of stiffness 2 x (0.5 eps)^2"
)" + std::string(newmark)));
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
}

/// A second block of cells, BASE, that belongs to no part.
std::string with_base(const std::string& rest) {
  return R"(
[[mesh.block]]
origin = [0.0, 0.0, -2.0]
size = [2.0, 2.0, 1.0]
divisions = [2, 2, 1]
groups = { cells = "BASE", zmin = "BASE_FOOT", zmax = "BASE_HEAD" }
)" + rest +
         newmark;
}

// Newmark with gamma = 1/2 never forgot a kink of an imposed displacement: the accelerations grew without end.
TEST(RunRegressions, KinksOfDisplacementsDoNotRing) {
  const char* undamped = R"(
[scheme]
kind = "newmark"
[time]
end = 4.0
step = 0.02
)";
  const std::string support = R"(
[[support]]
nodes = "HEAD"
displacement = { z = -0.01, function = "pulse" }
)";
  EXPECT_EQ(failure(support, undamped), "");
  EXPECT_EQ(failure(support, newmark), "");
}

TEST(RunRegressions, LoadsThatWouldMoveNothingAreRefused) {
  const std::string message = case_error(case_of_block(with_base(R"(
[[load]]
force = [0.0, 0.0, 1.0]
group = "BASE_HEAD"
)")))
                                  .what();
  EXPECT_NE(message.find("of \"BASE_HEAD\", which belongs to no part"), std::string::npos) << message;
}

TEST(RunRegressions, PointsFindNodesOfParts) {
  const TemporaryCase one("mesh.unused = \"ignore\"\n" + case_of_block(with_base(R"(
[[initial]]
part = "body"
velocity = [0.0, 0.0, 0.25]
[[probe]]
name = "near"
point = [0.0, 0.0, -0.9]
quantities = ["velocity"]
[[check]]
quantity = "velocity_z"
place = "near"
value = 0.25
tolerance = 1e-12
source = "free flight; the nearest node of all, at z = -1, belongs to no part"
)")));
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
}

TEST(RunRegressions, KeysThatWouldDoNothingAreRefused) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      parse_case(text, "case.toml");
    } catch (const CaseError& e) {
      return e.what();
    }
    return "";
  };
  const std::string explicit_case = case_of_block(central_differences);
  EXPECT_NE(message(explicit_case + "[solver]\nkind = \"cg\"\n").find("solver.kind"), std::string::npos);
  EXPECT_NE(message(explicit_case + "step = 0.01\nsafety = 0.5\n").find("time.safety"), std::string::npos);
  EXPECT_EQ(message(explicit_case + "step = 0.01\n"), "");
}

TEST(RunRegressions, ChecksOfEnergiesTakeNoPlace) {
  const TemporaryCase one(case_of_block(R"(
[[probe]]
name = "head"
group = "HEAD"
quantities = ["velocity"]
[[check]]
quantity = "energy.kinetic"
place = "head"
value = 1.0
tolerance = 0.1
)" + std::string(newmark)));
  EXPECT_THROW(one.run(), CaseError);
}

TEST(RunRegressions, TheResolvedCaseRunsFromItsFolder) {
  const TemporaryCase one(read_text(std::string(CAROM_SOURCE_DIR) + "/cases/interface_friction/imposed_slide.toml"));
  const std::filesystem::path folder = one.results().parent_path();
  std::filesystem::copy_file(std::string(CAROM_SOURCE_DIR) + "/cases/interface_friction/block.msh",
                             folder / "block.msh");
  ASSERT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  const Case again = read_case((one.results() / "case.resolved.toml").string());
  EXPECT_EQ(Simulation(again).mesh().node_count(),
            Simulation(read_case((folder / "case.toml").string())).mesh().node_count());
}

// A lid under pressure on a block without a load of its own on a floor: the floor holds both.
TEST(RunRegressions, StaticsHoldsABodyThatOnlyPassesLoadsOn) {
  for (const char* enforcement : {"penalty", "augmented_lagrangian"}) {
    const TemporaryCase one(case_of_block(R"(
[[mesh.block]]
origin = [0.0, 0.0, 3.0]
size = [2.0, 2.0, 1.0]
divisions = [2, 2, 1]
groups = { cells = "LID", zmin = "UNDER", zmax = "TOP" }
[[part]]
name = "lid"
cells = "LID"
material = "soft"
[[load]]
group = "TOP"
pressure = 1e-3
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[[contact]]
name = "seam"
kind = "pair"
group = "UNDER"
master = "HEAD"
[scheme]
kind = "statics"
enforcement = ")" + std::string(enforcement) +
                                          "\"\n[time]\nend = 1.0\nstep = 1.0\n"));
    one.run();
    const std::string contact = one.result("contact.csv");
    for (const char* place : {"floor.force_z", "seam.force_z"}) {
      const std::vector<double> force = column(contact, place);
      ASSERT_FALSE(force.empty()) << enforcement << one.result("summary.json");
      EXPECT_NEAR(force.back(), 4e-3, 1e-10) << enforcement << " " << place;  // pressure x area; energy share 1e-12
    }
  }
}

}  // namespace
}  // namespace carom::run_regressions_test
