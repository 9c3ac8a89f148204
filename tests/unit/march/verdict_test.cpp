// What the verdict judges errors by, and what it leaves out.
#include "march/verdict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>

#include "advise/lint.hpp"
#include "contact/row_maker.hpp"
#include "march/body_scales.hpp"
#include "march/penetration_watch.hpp"
#include "march/rotation_watch.hpp"
#include "mesh/structured_block.hpp"
#include "output/summary.hpp"
#include "run_fixture.hpp"

namespace carom::run_verdict_test {
namespace {

using namespace test;

const VerdictItem& item(const std::vector<VerdictItem>& items, const std::string& name) {
  for (const VerdictItem& one : items) {
    if (one.name == name) return one;
  }
  ADD_FAILURE() << "no item " << name;
  return items.front();
}

// Of 4913 cells the trace is estimated, which at 17496 dofs is good to some hundredths.
TEST(RestEnergy, OfManyCellsIsNearThatOfTheTrace) {
  StructuredBlock cube;
  cube.size = {1.0, 1.0, 1.0};
  cube.divisions = {17, 17, 17};
  cube.cells_group = "CUBE";
  Model model;
  model.mesh = std::make_shared<const Mesh>(make_structured_blocks({cube}));
  Part part{.name = "cube", .cells = {}, .material = LinearElastic{2.1e11, 0.3, 7800.0}};
  part.cells.resize(model.mesh->block(CellType::hexa8)->size());
  std::iota(part.cells.begin(), part.cells.end(), 0);
  model.parts.push_back(part);
  const Solid solid(model);
  const std::vector<double> diagonal = solid.tangent_diagonal(std::vector<double>(solid.dof_count(), 0.0));
  const double exact = 0.5e-20 * std::accumulate(diagonal.begin(), diagonal.end(), 0.0);
  EXPECT_NEAR(rest_energy(solid, 1.0), exact, 0.1 * exact);
}

LedgerIncrement with(double EnergyTerms::*term, double value) {
  LedgerIncrement step;
  step.energy.*term = value;
  return step;
}

// 1e-30 of energy that comes from nowhere: as much as a body at rest has been supplied with, and nothing, relative to
// what rounding of its positions stores.
TEST(Verdict, HasAScaleForBodiesAtRest) {
  for (const double rest : {0.0, 1e-18}) {
    EnergyLedger ledger({}, {}, 1.0);
    RunMonitor monitor(ledger, {.mass = 1.0, .rest_energy = rest}, {});
    LedgerIncrement noise = with(&EnergyTerms::strain, 2e-30);
    noise.energy.external_work = 1e-30;
    noise.impulse.linear = {1e-20, 0.0, 0.0};
    ledger.add(noise, {});
    monitor.update();
    const auto items = monitor.items({});
    EXPECT_EQ(item(items, "energy balance").pass, rest > 0.0);
    EXPECT_EQ(item(items, "linear momentum").pass, rest > 0.0);
    EXPECT_EQ(monitor.alarm(0.05).empty(), rest > 0.0);
  }
}

// Half of the work of a load that comes at once is `algorithmic` in statics; the same in a dynamic stage counts.
TEST(Verdict, LeavesOutThePathOfStaticStages) {
  EnergyLedger ledger({}, {}, 1.0);
  RunMonitor monitor(ledger, {.mass = 1.0}, {.reversible = 1.0, .is_static = true});
  LedgerIncrement load = with(&EnergyTerms::external_work, 2.0);
  load.energy.strain = 0.75;
  load.energy.algorithmic = 1.0;
  load.energy.quadrature = 0.25;
  ledger.add(load, {});
  monitor.update();
  EXPECT_TRUE(item(monitor.items({}), "algorithmic dissipation").pass);
  EXPECT_TRUE(item(monitor.items({}), "quadrature").pass);
  EXPECT_EQ(item(monitor.items({}), "algorithmic dissipation").value, 0.0);
  monitor.begin_stage({.reversible = 1.0, .is_static = false});
  LedgerIncrement loss = with(&EnergyTerms::strain, -0.5);
  loss.energy.algorithmic = 0.5;
  ledger.add(loss, {});
  monitor.update();
  EXPECT_EQ(item(monitor.items({}), "algorithmic dissipation").value, 0.25);  // 0.5 of 2
  EXPECT_FALSE(item(monitor.items({}), "algorithmic dissipation").pass);
}

// Multipliers that push bodies apart which began in each other: their work is all the energy that there is.
TEST(Verdict, KnowsTheWorkOfContactInStaticStages) {
  EnergyLedger ledger({}, {}, 1.0);
  RunMonitor monitor(ledger, {.mass = 1.0, .rest_energy = 1e-9}, {.reversible = 1.0, .is_static = true});
  LedgerIncrement fit = with(&EnergyTerms::strain, 2.0);
  fit.energy.impact = -2.0 + 1e-11;
  ledger.add(fit, {});
  monitor.update();
  EXPECT_EQ(monitor.alarm(0.05), "");
  EXPECT_TRUE(item(monitor.items({}), "energy balance").pass);
  EXPECT_NEAR(monitor.scale(), 2.0, 1e-10);
  monitor.begin_stage({.reversible = 1.0, .is_static = false});
  ledger.add(fit, {});  // what contact gives in dynamics is made
  monitor.update();
  EXPECT_NE(monitor.alarm(0.05), "");
}

// Loads that are put on at once: the scheme lends five times the work that they have done in two steps, out of what
// accelerations hold from the beginning on (a beam of HEXA20 by HHT at 300 times the stable step stopped for it).
TEST(Verdict, KnowsWhatAccelerationsMayLend) {
  for (const double of_accelerations : {0.0, 10.0}) {
    EnergyLedger ledger({}, {}, 1.0);
    RunMonitor monitor(ledger, {.mass = 1.0}, {.reversible = 1.0, .of_accelerations = of_accelerations});
    for (int step = 0; step < 2; ++step) {
      LedgerIncrement lent = with(&EnergyTerms::external_work, 0.1);
      lent.energy.kinetic = 0.6;
      lent.energy.algorithmic = -0.5;
      ledger.add(lent, {});
      monitor.update();
    }
    EXPECT_EQ(monitor.alarm(0.05).empty(), of_accelerations > 0.0);
  }
}

// What rounding has left is no more than the limit of the scale: statics that carry bodies on before anything is
// loaded.
TEST(Verdict, ComparesWithWhatRoundingLeaves) {
  for (const double rounding : {0.0, 2e-10}) {
    EnergyLedger ledger({}, {}, 1.0);
    RunMonitor monitor(ledger, {.mass = 1.0}, {.reversible = 1.0, .is_static = true});
    ledger.add(with(&EnergyTerms::support_work, 1e-10), {});
    monitor.update(0.0, rounding);
    EXPECT_EQ(monitor.alarm(0.05).empty(), rounding > 0.0);
    EXPECT_EQ(item(monitor.items({}), "energy balance").pass, rounding > 0.0);
  }
}

// 1 of energy at the start. Gains are judged apart from losses: 0.6 % is too much, whatever dissipates beside it.
TEST(Verdict, JudgesGainsApartFromLosses) {
  const auto gained = [](std::initializer_list<LedgerIncrement> steps, const RunMonitor::StageKind& stage,
                         double still_lent = 0.0) {
    EnergyTerms start;
    start.kinetic = 1.0;
    EnergyLedger ledger(start, {}, 1.0);
    RunMonitor monitor(ledger, {.mass = 1.0}, stage);
    for (const LedgerIncrement& step : steps) {
      ledger.add(step, {});
      monitor.update();
    }
    return item(monitor.items({.lent = still_lent}), "energy gained");
  };
  const RunMonitor::StageKind implicit{.reversible = 1.0}, steps_of_its_own{.reversible = 2.0, .is_explicit = true};
  const LedgerIncrement made = with(&EnergyTerms::quadrature, -0.006), lost = with(&EnergyTerms::algorithmic, 0.02),
                        lent = with(&EnergyTerms::algorithmic, -0.3), back = with(&EnergyTerms::algorithmic, 0.3),
                        thrown = with(&EnergyTerms::impact, -0.006), taken = with(&EnergyTerms::quadrature, 0.04);
  for (const auto& stage : {implicit, steps_of_its_own}) {
    EXPECT_FALSE(gained({made, lost}, stage).pass);
    EXPECT_TRUE(gained({taken, made}, stage).pass);  // what closing has taken, opening gives back
    EXPECT_TRUE(gained({lent, back}, stage).pass);
    EXPECT_FALSE(gained({thrown}, stage).pass);
  }
  EXPECT_FALSE(gained({lent}, steps_of_its_own).pass);  // and keeps it
  EXPECT_FALSE(gained({lent}, steps_of_its_own, 0.27).pass);
  EXPECT_TRUE(gained({lent}, steps_of_its_own, 0.29).pass);  // all but 1 %, for 2 % that steps that change may keep
  EXPECT_TRUE(gained({lent}, steps_of_its_own, 0.3).pass);
  EXPECT_TRUE(gained({thrown, made, made}, {.is_static = true}).pass);
  // Implicit steps must not keep more than the limit, 0.5 %, unless it is the other side of the jump at a touch.
  const LedgerIncrement given = with(&EnergyTerms::algorithmic, -0.09), at_touch = with(&EnergyTerms::impact, 0.09),
                        little = with(&EnergyTerms::algorithmic, -0.0049);
  EXPECT_FALSE(gained({given}, implicit).pass);
  EXPECT_NEAR(gained({given}, implicit).value, 0.09, 1e-15);
  EXPECT_FALSE(gained({given}, implicit, 0.08).pass);
  EXPECT_TRUE(gained({given}, implicit, 0.086).pass);
  EXPECT_TRUE(gained({little}, implicit).pass);
  EXPECT_TRUE(gained({given, at_touch}, implicit).pass);
  EXPECT_TRUE(gained({given}, {.is_static = true}).pass);
  EXPECT_FALSE(gained({lost, thrown}, steps_of_its_own).pass);
  EXPECT_TRUE(gained({lost, thrown}, implicit).pass);  // both sides of the jump of velocities at a touch
}

/// A cube of edge 2 on a plane, shortened by `strain` towards it and turned with it by `angle` about x; each node of
/// its foot is behind the plane by `depth` cells.
VerdictItem penetration(double depth, double strain, double angle = 0.0) {
  StructuredBlock block;
  block.size = {2.0, 2.0, 2.0};
  block.cells_group = "BODY";
  Model model;
  model.mesh = std::make_shared<const Mesh>(make_structured_blocks({block}));
  model.parts.push_back({.name = "body", .cells = {0}, .material = StVenantKirchhoff{{1.0, 0.0, 1.0}}});
  model.contacts.emplace_back(ObstacleContact{});
  const Vec3 n{0.0, -std::sin(angle), std::cos(angle)}, t{0.0, std::cos(angle), std::sin(angle)};
  std::vector<double> u;
  ConstraintRows rows;
  for (std::size_t i = 0; i < model.mesh->node_count(); ++i) {
    const Vec3& X = model.mesh->coordinates[i];
    const double z = (1.0 - strain) * X[2];
    u.insert(u.end(), {0.0, X[1] * t[1] + z * n[1] - X[1], X[1] * t[2] + z * n[2] - X[2]});
    if (X[2] > 0.0) continue;
    rows.add_row(0.0, n, X, 1.0, {}, 0);
    rows.add_node(static_cast<Index>(i), 1.0);
    finish_row(rows, u, static_cast<Index>(rows.size()) - 1);
    rows.gap.back() -= 2.0 * depth;
  }
  ContactResponse response;
  response.status.assign(rows.size(), RowStatus::stick);
  response.rows = std::make_shared<const ConstraintRows>(std::move(rows));
  PenetrationWatch watch(model);
  watch.look(response, u);
  return watch.item();
}

// 5 %, half of the shortening, 25 %: not what the spring says of the pressure. A turn changes nothing.
TEST(Verdict, AllowsPenetrationByWhatTheCellsAreShortenedBy) {
  EXPECT_TRUE(penetration(0.04, 0.0).pass);
  EXPECT_FALSE(penetration(0.06, 0.0).pass);
  EXPECT_EQ(penetration(0.06, 0.08).limit, 0.05);
  for (const double angle : {0.0, 0.4, 2.0}) EXPECT_NEAR(penetration(0.06, 0.2, angle).limit, 0.1, 1e-14);
  EXPECT_TRUE(penetration(0.09, 0.2).pass);
  EXPECT_FALSE(penetration(0.11, 0.2).pass);
  EXPECT_EQ(penetration(0.3, 0.9).limit, 0.25);
  EXPECT_FALSE(penetration(0.3, 0.9).pass);
  EXPECT_EQ(penetration(0.3, -0.5).limit, 0.05);  // longer
}

const std::string statics = R"([scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)";

std::string pressed(double pressure, const std::string& time_function = "") {
  return case_of_block("[[load]]\npressure = " + std::to_string(pressure) + "\ngroup = \"HEAD\"\n" + time_function +
                       "[[contact]]\nname = \"floor\"\nkind = \"plane\"\ngroup = \"FOOT\"\npoint = [0.0, 0.0, 0.0]\n"
                       "normal = [0.0, 0.0, 1.0]\n" +
                       statics);
}

// The whole load in one step, on a body that only the floor holds.
TEST(Verdict, PassesOneStaticStep) {
  const TemporaryCase one(pressed(1e-3));
  EXPECT_EQ(one.run(), ExitCode::good);
  EXPECT_NE(one.result("summary.json").find("\"steps\": 1,"), std::string::npos);
}

TEST(Lint, HasNoCourantNumberForStatics) {
  const Case given = parse_case(pressed(1e-3), "case.toml");
  const Simulation simulation(given);
  ASSERT_GT(simulation.dt() * std::sqrt(2.0 / 1.5), 0.0);
  for (const std::string& warning : lint_warnings(simulation))
    EXPECT_EQ(warning.find("Courant"), std::string::npos) << warning;
}

/// The head moves sideways by `share` of the height in one step: the angle of shear, half of it rotation.
std::string sheared(double share, const std::string& guards) {
  return case_of_block(
      "[[support]]\nnodes = \"FOOT\"\nblocked = [\"x\", \"y\", \"z\"]\n[[support]]\nnodes = \"BODY\"\nblocked = "
      "[\"z\"]\n[[support]]\nnodes = \"HEAD\"\ndisplacement = { x = " +
      std::to_string(share * 3.0) +
      ", function = \"ramp\" }\n[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]\n" + guards + statics);
}

// 3 %: 0.86 degrees of rotation, 5 %: about 1.5, 25 %: about 7.
TEST(Guards, WarnOfRotationAndStopIt) {
  for (const auto& [share, warns, stops] : {std::tuple(0.03, false, false), {0.05, true, false}, {0.25, false, true}}) {
    SCOPED_TRACE(share);
    const TemporaryCase one(sheared(share, ""));
    EXPECT_EQ(one.run() == ExitCode::run_failed, stops);
    const std::string summary = one.result("summary.json");
    EXPECT_EQ(summary.find("which its small-strain law takes for a stress of about") != std::string::npos,
              warns || stops);
    EXPECT_EQ(summary.find("rotation_stop in [guards]") != std::string::npos, stops);
    EXPECT_EQ(summary.find("rotation_warning in [guards]") != std::string::npos, warns);
  }
}

TEST(Guards, OfRotationHaveKeys) {
  const TemporaryCase patient(sheared(0.25, "[guards]\nrotation_warning = 10.0\nrotation_stop = 20.0\n")),
      strict(sheared(0.03, "[guards]\nrotation_warning = 0.1\nrotation_stop = 0.5\n"));
  EXPECT_NE(patient.run(), ExitCode::run_failed);
  EXPECT_EQ(patient.result("summary.json").find("has turned by"), std::string::npos);
  EXPECT_EQ(strict.run(), ExitCode::run_failed);
  EXPECT_THROW(parse_case(sheared(0.03, "[guards]\nrotation_stop = 0.5\n"), "case.toml"), CaseError);
}

// A unit cell of E = 2, nu = 0.3 that turns by 0.1: 1 - cos(0.1) = 0.0049958.
TEST(Guards, NameTheStressOfARotation) {
  const LinearElastic material{{2.0, 0.3, 1.0}};
  EXPECT_NEAR(stress_of_rotation(material, Section::bar, 0.1), 2.0 * 0.0049958, 2e-7);
  EXPECT_NEAR(stress_of_rotation(material, Section::solid, 0.1), 2.0 * 0.0049958 / (1.3 * 0.4), 4e-7);
}

/// A mass that meets a stiff spring in the middle of a long step: it is thrown back with 3.2 % more than it had.
std::string thrown(const std::string& guards) {
  return R"(units = "SI"
[[mesh.block]]
kind = "bar"
origin = [-1.0, 0.0, 0.0]
end = [0.0, 0.0, 0.0]
divisions = 1
groups = { cells = "SPRING", start = "ANCHOR", end = "MASS" }
[materials.spring]
law = "linear_elastic"
E = 1.0
nu = 0.0
rho = 2.0
[[part]]
name = "spring"
cells = "SPRING"
material = "spring"
section = "bar"
area = 1.0
[[support]]
nodes = "ANCHOR"
blocked = ["x", "y", "z"]
[[support]]
nodes = "MASS"
blocked = ["y", "z"]
[[initial]]
nodes = "MASS"
velocity = [1.0, 0.0, 0.0]
[[contact]]
name = "c"
kind = "stop"
group = "MASS"
normal = [-1.0, 0.0, 0.0]
gap = 0.01
stiffness = 1e4
[scheme]
kind = "central_differences"
mass = "lumped"
[time]
end = 0.2
step = 0.0149
)" + guards;
}

TEST(Guards, OfEnergyHaveAKey) {
  const TemporaryCase strict(thrown("[guards]\nenergy_growth = 0.01\n")), patient(thrown(""));
  EXPECT_EQ(strict.run(), ExitCode::run_failed);
  EXPECT_NE(strict.result("summary.json").find("energy_growth in [guards]"), std::string::npos);
  EXPECT_EQ(patient.run(), ExitCode::verdict_failed);  // to the end, where the verdict says what it thinks of it
  EXPECT_NE(patient.result("summary.json").find(" (not "), std::string::npos) << patient.result("summary.json");
}

// Four corners of a cube that nothing shortens, so that all have the same limit: the item is of the deepest.
TEST(Verdict, NamesThePenetrationThatIsDeepestForItsLimit) {
  StructuredBlock block;
  block.size = {2.0, 2.0, 2.0};
  block.cells_group = "BODY";
  Model model;
  model.mesh = std::make_shared<const Mesh>(make_structured_blocks({block}));
  model.parts.push_back({.name = "body", .cells = {0}, .material = StVenantKirchhoff{{1.0, 0.0, 1.0}}});
  model.contacts.emplace_back(ObstacleContact{});
  const std::vector<double> u(3 * model.mesh->node_count(), 0.0);
  ConstraintRows rows;
  const std::vector<double> depths{0.1, 0.06, 0.08, 0.06};
  for (std::size_t i = 0; i < depths.size(); ++i) {
    rows.add_row(0.0, {0, 0, 1}, model.mesh->coordinates[i], 1.0, {}, 0);
    rows.add_node(static_cast<Index>(i), 1.0);
    finish_row(rows, u, static_cast<Index>(i));
    rows.gap.back() -= 2.0 * depths[i];  // cells of length 2
  }
  ContactResponse response;
  response.status.assign(rows.size(), RowStatus::stick);
  response.rows = std::make_shared<const ConstraintRows>(std::move(rows));
  PenetrationWatch watch(model);
  watch.look(response, u);
  EXPECT_NEAR(watch.item().value, 0.1, 1e-15);
}

/// The summary of a body that turns a little, of a law and by a scheme.
Summary summary_of_turning(const std::string& law, const std::string& scheme) {
  const TemporaryCase one(replaced(
      case_of_block("[[initial]]\npart = \"body\"\nvelocity = [0.01, 0.0, 0.0]\nangular_velocity = [0.0, 0.01, "
                    "0.0]\ncentre = [1.0, 1.0, 1.5]\n[scheme]\nkind = \"" +
                    scheme + "\"\n[time]\nend = 0.2\nstep = 0.1\n"),
      "linear_elastic", law));
  EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  return read_summary((one.results() / "summary.json").string());
}

// Round-off where the angular momentum is kept: by linear bodies, and by energy-momentum schemes
// (model/compatibility.hpp); the order of the scheme elsewhere.
TEST(Verdict, HoldsAngularMomentumToRoundOffWhereItIsKept) {
  const auto limit = [](const std::string& law, const std::string& scheme) {
    return item(summary_of_turning(law, scheme).verdict, "angular momentum").limit;
  };
  EXPECT_EQ(limit("linear_elastic", "newmark"), 1e-9);
  EXPECT_EQ(limit("neo_hookean", "energy_momentum"), 1e-9);
  EXPECT_EQ(limit("neo_hookean", "newmark"), 1e-2);
}

TEST(Summary, HasTheSixEnergiesOfCodeAster) {
  std::vector<std::string> names;
  for (const NamedValue& term : summary_of_turning("linear_elastic", "newmark").code_aster) names.push_back(term.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"ENER_CIN", "ENER_TOT", "TRAV_EXT", "TRAV_AMOR", "TRAV_LIAI", "DISS_SCH"}));
}

// A block pressed onto soft springs by its head: a stroke of statics that the springs take a part of is doubted. With
// inertia the penetration is judged by the cells alone.
TEST(Stroke, IsDoubtedInStaticsAlone) {
  const auto is_doubted = [](const std::string& scheme) {
    const TemporaryCase one(case_of_block(
        "[[support]]\nnodes = \"HEAD\"\nblocked = [\"x\", \"y\"]\n[[support]]\nnodes = \"HEAD\"\n"
        "displacement = { z = -0.1, function = \"ramp\" }\n[functions.ramp]\ntime = [0.0, 10.0]\nvalue = [0.0, 1.0]\n"
        "[[contact]]\nname = \"floor\"\nkind = \"plane\"\ngroup = \"FOOT\"\npoint = [0.0, 0.0, 0.0]\n"
        "normal = [0.0, 0.0, 1.0]\nstiffness = 1.0\n[scheme]\nkind = \"" +
        scheme + "\"\nenforcement = \"penalty\"\n[time]\nend = 10.0\nstep = 1.0\n"));
    one.run();
    const std::vector<std::string> doubts = read_summary((one.results() / "summary.json").string()).doubts;
    return std::any_of(doubts.begin(), doubts.end(),
                       [](const std::string& doubt) { return doubt.starts_with("springs of contact take"); });
  };
  EXPECT_TRUE(is_doubted("statics"));
  EXPECT_FALSE(is_doubted("newmark"));
}

// A block at 1 on a law that ends at a depth of 0.1: rho c v = 1.5 x 1.34 presses it deeper than the 0.5 there; a law
// that goes down to 10, which is three times its height, is not left.
TEST(LawDepth, IsDoubtedBeyondItsEnd) {
  const auto warnings = [](const std::string& law) {
    const TemporaryCase one(case_of_block(
        "[[initial]]\npart = \"body\"\nvelocity = [0.0, 0.0, -1.0]\n[[contact]]\nname = \"floor\"\nkind = \"plane\"\n"
        "group = \"FOOT\"\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]\n" +
        law + "[guards]\nrotation_stop = 90.0\n[scheme]\nkind = \"central_differences\"\n[time]\nend = 0.5\n"));
    one.run();
    std::vector<std::string> found = read_summary((one.results() / "summary.json").string()).warnings;
    std::erase_if(found, [](const std::string& w) { return w.find("was pressed to a depth of") == std::string::npos; });
    return found;
  };
  EXPECT_TRUE(warnings("depths = [0.1, 10.0]\npressures = [0.5, 50.0]\n").empty());
  const std::vector<std::string> beyond = warnings("depths = [0.1]\npressures = [0.5]\n");
  ASSERT_EQ(beyond.size(), 1U);
  EXPECT_NE(beyond[0].find("contact \"floor\" was pressed to a depth of"), std::string::npos) << beyond[0];
  EXPECT_NE(beyond[0].find("times the last of its `depths`, 0.1: beyond it the last slope was continued"),
            std::string::npos)
      << beyond[0];
}

}  // namespace
}  // namespace carom::run_verdict_test
