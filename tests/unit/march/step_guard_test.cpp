// The length of steps: cuts, halvings, the stable step; contact that closes within a step.
#include "march/step_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "march/step_control.hpp"
#include "run_fixture.hpp"

namespace carom::run_step_guard_test {
namespace {

using namespace test;

std::vector<double> lengths_to_end(StepControl& control) {
  std::vector<double> lengths;
  while (!control.at_end()) {
    lengths.push_back(control.dt());
    control.accept();
  }
  return lengths;
}

TEST(StepControl, ComesBackToTheGridAfterACut) {
  StepControl control(0.0, 1.0, 3, StepControl::Halving::allowed);
  EXPECT_TRUE(control.cut(0.75));
  EXPECT_EQ(control.t_end_of_step(), 0.75);
  // A rest of less than half of a step is joined to the next one, and the two are halved.
  EXPECT_EQ(lengths_to_end(control), (std::vector<double>{0.75, 0.625, 0.625, 1.0}));
}

TEST(StepControl, GrowsAgainAfterAnEvent) {
  StepControl control(0.0, 1.0, 3, StepControl::Halving::allowed);
  EXPECT_TRUE(control.cut(0.375));
  control.accept();
  control.refine(0.25);
  // To the quarters by an eighth; after four steps, at 1.25, no half may begin, one step later it may.
  EXPECT_EQ(lengths_to_end(control), (std::vector<double>{0.125, 0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5}));
}

TEST(StepControl, CutsNoShorterThanItsSmallestStep) {
  StepControl control(0.0, 1.0, 1, StepControl::Halving::allowed);
  while (control.cut(0.01)) continue;
  EXPECT_EQ(control.dt(), 1.0 / 65536);
}

TEST(StepControl, FollowsALimitByEighthsOfAnOctave) {
  StepControl control(0.0, 1.0, 4, StepControl::Halving::forbidden);
  EXPECT_TRUE(control.limit(0.95));
  EXPECT_NEAR(control.dt(), std::exp2(-1.0 / 8.0), 2e-5);  // two parts of 2^16
  EXPECT_TRUE(control.limit(0.5));
  EXPECT_NEAR(control.dt(), 0.5, 2e-5);
  for (int eighths = 7; eighths >= 0; --eighths) {  // back by one at a time
    EXPECT_TRUE(control.limit(10.0));
    EXPECT_NEAR(control.dt(), std::exp2(-eighths / 8.0), 2e-5);
  }
  EXPECT_FALSE(control.limit(1e-6));
}

TEST(StepControl, ReachesTheEndBySimilarStepsUnderALimit) {
  StepControl control(0.0, 1.0, 4, StepControl::Halving::forbidden);
  EXPECT_TRUE(control.limit(0.95));
  const std::vector<double> lengths = lengths_to_end(control);
  double sum = 0.0;
  for (const double length : lengths) {
    sum += length;
    EXPECT_LE(length, 0.95);
    EXPECT_GE(length, 0.4);
  }
  EXPECT_EQ(sum, 4.0);
}

/// The impact bar (cases/impact_bar/rigid_wall.toml) with another scheme, at a step of five crossings of a cell that
/// does not end at the touch, t = 0.5.
constexpr double long_step = 0.0171, touch = 0.5;

std::string bar_case(const std::string& scheme, double stiffness, const std::string& time) {
  std::string text = read_text(std::string(CAROM_SOURCE_DIR) + "/cases/impact_bar/rigid_wall.toml");
  text = text.substr(0, text.find("[exact]"));
  const std::size_t from = text.find("[scheme]"), to = text.find("[output]");
  text.replace(from, to - from, scheme + "\n[time]\nend = 1.4877\nstep = 0.0171\n" + time + "\n");
  if (stiffness > 0.0) text.insert(text.find("[scheme]"), "stiffness = " + std::to_string(stiffness) + "\n");
  return text;
}

struct Touch {
  double time = 0.0;    ///< the last end of a step before the wall pushes
  double energy = 0.0;  ///< after the impact over before
  double imbalance = 0.0;
  std::size_t steps = 0;
};

Touch hit(const std::string& text) {
  const TemporaryCase one(text);
  EXPECT_NE(one.run(), ExitCode::run_failed) << one.result("summary.json");
  const std::string contact = one.result("contact.csv"), energy = one.result("energy.csv");
  const std::vector<double> time = column(contact, "time"), force = column(contact, "wall.force_z"),
                            kinetic = column(energy, "kinetic"), strain = column(energy, "strain"),
                            imbalance = column(energy, "imbalance");
  Touch out{.steps = time.size() - 1};
  const auto first = std::find_if(force.begin(), force.end(), [](double f) { return f > 0.0; });
  EXPECT_NE(first, force.end());
  out.time = time[static_cast<std::size_t>(first - force.begin()) - 1];
  // Steps that end at the touch, by less than the tolerance into the wall, push already.
  if (time[static_cast<std::size_t>(first - force.begin())] - touch < 0.2 * long_step)
    out.time = time[static_cast<std::size_t>(first - force.begin())];
  out.energy = (kinetic.back() + strain.back()) / kinetic.front();
  for (const double e : imbalance) out.imbalance = std::max(out.imbalance, std::abs(e) / kinetic.front());
  return out;
}

struct EventCase {
  const char* scheme;
  double stiffness;
};

// With a tolerance of 0.2 a step ends within 0.2 steps of the touch, where it was 0.24 too early and 0.76 too late; the
// energy error of the impact falls to less than half.
TEST(ContactEvents, ImplicitStepsEndAtTheTouch) {
  for (const EventCase& one :
       {EventCase{"[scheme]\nkind = \"newmark\"\n", 9000.0}, EventCase{"[scheme]\nkind = \"moreau_jean\"\n", 0.0},
        EventCase{"[scheme]\nkind = \"contact_stabilized_newmark\"\n", 0.0},
        EventCase{"[scheme]\nkind = \"nonsmooth_generalized_alpha\"\nrho_inf = 1.0\n", 0.0}}) {
    SCOPED_TRACE(one.scheme);
    const Touch plain = hit(bar_case(one.scheme, one.stiffness, "")),
                cut = hit(bar_case(one.scheme, one.stiffness, "event_tolerance = 0.2"));
    EXPECT_GT(std::abs(plain.time - touch), 0.23 * long_step);
    EXPECT_LT(std::abs(cut.time - touch), 0.2 * long_step);
    EXPECT_GT(1.0 - plain.energy, 0.01);
    EXPECT_LT(std::abs(1.0 - cut.energy), 0.55 * (1.0 - plain.energy));
    EXPECT_LT(cut.imbalance, 1e-10);
    EXPECT_LT(cut.steps, plain.steps + 25);  // the steps have grown again
    EXPECT_GT(cut.steps, plain.steps);
  }
}

TEST(ContactEvents, AreRefusedWhereTheCaseFixesTheStep) {
  const std::string text = bar_case("[scheme]\nkind = \"moreau_jean\"\n", 0.0, "fixed = true\nevent_tolerance = 0.2");
  try {
    parse_case(text, "case.toml");
    ADD_FAILURE() << "was read";
  } catch (const CaseError& error) {
    EXPECT_EQ(error.key(), "time.event_tolerance");
  }
}

struct Shot {
  double gap, speed;
  std::string contact, scheme, time;
};

/// A block above a plate that is a tenth as thick as wide and held at its nodes; unit wave speed in both.
std::string projectile_case(const Shot& shot) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 0.1]
divisions = [8, 8, 1]
groups = {{ cells = "PLATE", zmax = "TOP" }}
[[mesh.block]]
origin = [0.33, 0.37, {}]
size = [0.125, 0.125, 0.25]
divisions = [1, 1, 1]
groups = {{ cells = "BLOCK", zmin = "NOSE" }}
[materials.unit]
law = "linear_elastic"
E = 1.0
nu = 0.0
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
nodes = "PLATE"
blocked = ["x", "y", "z"]
[[initial]]
part = "block"
velocity = [0.0, 0.0, {}]
[[contact]]
name = "hit"
kind = "pair"
group = "NOSE"
master = "TOP"
method = "node_to_surface"
{}
[scheme]
{}
[time]
{}
[[probe]]
name = "nose"
group = "NOSE"
quantities = ["displacement"]
)",
                     0.1 + shot.gap, -shot.speed, shot.contact, shot.scheme, shot.time);
}

struct Flight {
  double deepest = 0.0;  ///< lowest height of the nose above the plate
  double growth = 0.0;   ///< greatest mechanical energy over that of the start
  double shortest = 0.0, longest = 0.0;
};

Flight fly(const Shot& shot) {
  const TemporaryCase one(projectile_case(shot));
  one.run();
  const std::string energy = one.result("energy.csv");
  const std::vector<double> z = column(one.result("probes.csv"), "nose.displacement_z"),
                            kinetic = column(energy, "kinetic"), strain = column(energy, "strain"),
                            stored = column(energy, "contact_stored"), dt = column(energy, "dt");
  Flight out{.deepest = shot.gap + *std::min_element(z.begin(), z.end()),
             .shortest = *std::min_element(dt.begin() + 1, dt.end()),
             .longest = *std::max_element(dt.begin(), dt.end())};
  for (std::size_t i = 0; i < kinetic.size(); ++i)
    out.growth = std::max(out.growth, (kinetic[i] + strain[i] + stored[i]) / kinetic.front());
  EXPECT_EQ(one.result("summary.json").find("\"outcome\": \"error\""), std::string::npos) << one.result("summary.json");
  return out;
}

// Springs of a hundred times the stiffness of a cell of that area lower the stable step to a thirtieth, a third of the
// step that is a tenth of the free one. At three times the wave speed the block flies more than a facet, 0.125, between
// the last estimate before the impact, after step 20, and the impact in step 28, so that none of its rows is there. A
// spring is met within a step h with at most (omega h)^2 = (2 / 10)^2 = 4 % of the energy of its node.
TEST(FastProjectile, SpringsThatWereOutOfSightDoNotMakeTheStepUnstable) {
  const Flight flight =
      fly({0.91, 3.0, "stiffness = 12000.0", "kind = \"central_differences\"", "safety = 0.1\nend = 0.33"});
  EXPECT_GT(flight.deepest, -0.05);  // it bounces from the plate, half of whose thickness is 0.05
  EXPECT_LT(flight.growth, 1.04);
  EXPECT_LT(flight.shortest, 0.2 * flight.longest) << flight.longest;
}

// At three times the wave speed a step is 0.13 long, through the whole plate and to 0.097 behind its face; the nose is
// stopped at the face. Impulses with restitution act behind it, so that the step is shortened; those without stop the
// nose before.
TEST(FastProjectile, IsNotLostBehindAThinPlate) {
  const char *scheme = "kind = \"cd_lagrange\"", *time = "safety = 0.4\nend = 0.4";
  const Flight thrown_back = fly({0.97, 3.0, "restitution = 0.1", scheme, time});
  EXPECT_GT(thrown_back.deepest, -0.05);  // half of the smallest cell
  EXPECT_LT(thrown_back.shortest, 0.6 * thrown_back.longest);
  EXPECT_GT(fly({0.97, 3.0, "", scheme, time}).deepest, -0.05);
}

// A limit that stays is no change of the step: after four steps it is doubled, at a multiple of the doubled one.
TEST(StepControl, GrowsAgainUnderALimitThatStays) {
  StepControl control(0.0, 1.0, 4, StepControl::Halving::allowed);
  EXPECT_TRUE(control.halve());
  std::vector<double> lengths;
  while (!control.at_end()) {
    EXPECT_TRUE(control.limit(1.0));
    lengths.push_back(control.dt());
    control.accept();
  }
  EXPECT_EQ(lengths, (std::vector<double>{0.5, 0.5, 0.5, 0.5, 1.0, 1.0}));
}

/// A block of finite strain between its foot and its head, which has been pressed together and carried away, so that
/// nothing of it is where it was in the mesh.
std::string pressed_block(const std::string& function, const std::string& rest) {
  return replaced(case_of_block(R"([[support]]
nodes = "all"
displacement = { x = 0.1, y = 0.1, function = "path" }
[[support]]
nodes = "FOOT"
displacement = { z = 0.1, function = "path" }
[[support]]
nodes = "HEAD"
displacement = { z = -1.15, function = "path" }
[functions.path]
)" + function + rest),
                  "linear_elastic", "neo_hookean");
}

// The first step of a stage that begins displaced is that of the deformed cells, 0.58 of their height.
TEST(StepGuard, BeginsWithTheStepOfBodiesThatHaveMovedAltogether) {
  const TemporaryCase pressed(pressed_block("time = [0.0, 1.0]\nvalue = [0.0, 1.0]\n",
                                            "[scheme]\nkind = \"statics\"\n[time]\nend = 1.0\nstep = 0.1\n"));
  EXPECT_EQ(pressed.run(), ExitCode::good) << pressed.result("summary.json");
  const std::string text = pressed_block("time = [0.0]\nvalue = [1.0]\n",
                                         "[initial_state]\nfrom = \"" + pressed.results().string() +
                                             "\"\n[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n");
  const TemporaryCase on(text);
  on.run();
  EXPECT_LT(column(on.result("energy.csv"), "dt").at(1), 0.9 * Simulation(parse_case(text, "case.toml")).dt());
}

/// The length of the first step of central differences after it has ended with a block of a fifth of its height, over
/// what it was; `control`: of its cells. `is_repeated`: whether it is made again.
double length_after_crushing(const std::string& control, bool& is_repeated) {
  const std::string text = case_of_block(control + "[scheme]\nkind = \"central_differences\"\n[time]\nend = 10.0\n");
  const Simulation simulation(parse_case(replaced(text, "linear_elastic", "neo_hookean"), "case.toml"));
  const Stage& stage = simulation.first();
  StepGuard guard(stage);
  const State begin = simulation.initial_state();
  State end = begin;
  for (std::size_t n = 0; n < simulation.mesh().node_count(); ++n)
    end.q[3 * n + 2] = -0.8 * simulation.mesh().coordinates[n][2];
  stage.make_scheme()->start(end, stage.dt());
  EXPECT_EQ(end.forces.stored.distortion > 0.0, !control.empty());
  const double before = guard.control().dt();
  is_repeated = guard.is_to_be_repeated(begin, end, {}, 1);
  return guard.control().dt() / before;
}

// Distortion control has been no part of the step in which it comes to act, whose length follows what stiffens by
// itself after it.
TEST(StepGuard, MakesAStepAgainThatWasTooLongForDistortionControl) {
  bool is_repeated = true;
  EXPECT_EQ(length_after_crushing("", is_repeated), 1.0);
  EXPECT_FALSE(is_repeated);
  EXPECT_LT(length_after_crushing("distortion_control = 0.3\n", is_repeated), std::exp2(-1.0 / 8.0));
  EXPECT_TRUE(is_repeated);
}

}  // namespace
}  // namespace carom::run_step_guard_test
