// Runs that begin where others have ended.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "advise/check_summary.hpp"
#include "output/checkpoint_file.hpp"
#include "output/found_checkpoint.hpp"
#include "output/results_folder.hpp"
#include "output/summary.hpp"
#include "run_fixture.hpp"

namespace carom::run_initial_state_test {
namespace {

namespace fs = std::filesystem;
using namespace test;

/// Cases in one temporary folder, each with results in a folder of its name.
class Cases {
 public:
  Cases() {
    static int count = 0;
    folder_ = fs::temp_directory_path() / fmt::format("carom_initial_state_{}_{}", ::getpid(), count++);
    fs::create_directories(folder_);
  }
  ~Cases() { fs::remove_all(folder_); }
  Cases(const Cases&) = delete;
  Cases& operator=(const Cases&) = delete;

  fs::path results(const std::string& name) const { return folder_ / name; }
  std::string result(const std::string& name, const std::string& file) const { return read_text(results(name) / file); }
  std::string file_of(const std::string& name, const std::string& text) const {
    const fs::path file = folder_ / (name + ".toml");
    std::ofstream(file) << text;
    return file.string();
  }
  /// `stop`: after the first step.
  ExitCode run(const std::string& name, const std::string& text, bool stop = false) const {
    return run_into(name, file_of(name, text), stop);
  }
  ExitCode run_into(const std::string& name, const std::string& file, bool stop) const {
    return run_case(file, options(name), std::atomic<bool>{stop});
  }
  ExitCode resume(const std::string& name, bool stop) const {
    return resume_case(options(name), std::nullopt, std::atomic<bool>{stop});
  }
  /// What refuses a run of it, without the path of the folder; "" where nothing does.
  std::string refusal(const std::string& text, const std::string& name = "refused") const {
    try {
      run(name, text);
    } catch (const CaseError& e) {
      std::string message = e.what();
      const std::string path = folder_.string() + "/";
      for (std::size_t at = message.find(path); at != std::string::npos; at = message.find(path))
        message.erase(at, path.size());
      return message;
    }
    return {};
  }

 private:
  RunOptions options(const std::string& name) const {
    RunOptions options;
    options.folder = results(name).string();
    options.threads = 1;
    options.progress = ProgressMode::quiet;
    return options;
  }

  fs::path folder_;
};

struct Kinematics {
  std::vector<double> q, v;
};

Kinematics last_state(const fs::path& folder) {
  Kinematics state;
  read_checkpoint(find_checkpoint(folder.string()).path, [&](Archive& archive) {
    archive("march.state.q", state.q);
    archive("march.state.v", state.v);
  });
  return state;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], tolerance) << i;
}

/// The balance of every row, against the energy there was or came in.
void expect_closed_books(const std::string& energy) {
  double scale = largest(column(energy, "external_work"));
  for (const char* term : {"kinetic", "strain", "contact_stored"})
    scale = std::max(scale, column(energy, term).front());
  EXPECT_LT(largest(column(energy, "imbalance")), 1e-10 * scale);
}

/// A block in the middle of nothing, 1 x 1 x 3, of a law with its numbers; `rest` goes on with sections.
std::string block(const std::string& law, const std::string& rest) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 3.0]
divisions = [2, 2, 6]
groups = {{ cells = "BODY", zmin = "FOOT", zmax = "HEAD" }}
[materials.soft]
{}
[[part]]
name = "body"
cells = "BODY"
material = "soft"
{})",
                     law, rest);
}

const std::string elastic = "law = \"linear_elastic\"\nE = 2.0\nnu = 0.3\nrho = 1.5";
const std::string yielding = "law = \"j2\"\nE = 2.0\nnu = 0.3\nrho = 1.5\nyield_stress = 0.02\nhardening_modulus = 0.2";

std::string from(const std::string& folder) {
  return fmt::format("[initial_state]\nfrom = \"{}\"\n", folder);
}

std::string stepping(const std::string& scheme, double end, double step = 0.05) {
  return fmt::format("[scheme]\nkind = \"{}\"\n[time]\nend = {}\nstep = {}\n", scheme, end, step);
}

const std::string torn = R"([[initial]]
nodes = "all"
velocity_field = ["0.02 * y", "0", "0.03 * (1 + x) * z"]
)";

class OfALaw : public testing::TestWithParam<const std::string*> {};

// Central differences carry nothing beside displacements, velocities and what the points remember. The acceleration is
// made anew from the same forces, so that the two ways differ by rounding: a few ulp of the stresses in each of 40
// steps, of displacements that are sums of them.
TEST_P(OfALaw, GoesOnAsIfItHadNotEnded) {
  const Cases cases;
  const std::string scheme = "central_differences";
  cases.run("whole", block(*GetParam(), torn + stepping(scheme, 4.0)));
  cases.run("first", block(*GetParam(), torn + stepping(scheme, 2.0)));
  cases.run("second", block(*GetParam(), from("first") + stepping(scheme, 2.0)));
  const Kinematics whole = last_state(cases.results("whole")), second = last_state(cases.results("second"));
  EXPECT_GT(largest(whole.q), 0.01);
  expect_near(second.q, whole.q, 1e-13 * largest(whole.q));
  expect_near(second.v, whole.v, 1e-12 * largest(whole.v));  // accelerations times 1 / step of rounding

  const std::string before = cases.result("first", "energy.csv"), after = cases.result("second", "energy.csv");
  expect_closed_books(after);
  const double all = last_row(before).at("kinetic") + last_row(before).at("strain");
  for (const char* term : {"kinetic", "strain", "plastic"})
    EXPECT_NEAR(column(after, term).front(), last_row(before).at(term), 1e-13 * all) << term;
  EXPECT_EQ(last_row(before).at("plastic") > 0.0, GetParam() == &yielding);
  EXPECT_EQ(column(after, "time").front(), 0.0);  // a clock of its own
}

INSTANTIATE_TEST_SUITE_P(InitialState, OfALaw, testing::Values(&elastic, &yielding));

/// One cell without lateral strain on a fixed foot, pulled by a pressure of -0.1.
std::string cell(const std::string& rest) {
  return R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 2.0]
divisions = [1, 1, 1]
groups = { cells = "BODY", zmin = "FOOT", zmax = "HEAD" }
[materials.soft]
law = "linear_elastic"
E = 4.0
nu = 0.0
rho = 1.0
[[part]]
name = "body"
cells = "BODY"
material = "soft"
[[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
[[probe]]
name = "head"
group = "HEAD"
quantities = ["displacement"]
)" + rest;
}
const std::string pull = "[[load]]\npressure = -0.1\ngroup = \"HEAD\"\n";

// The end of a bar of one cell is an oscillator: half of the mass on the stiffness EA/L. Central differences let it
// swing as u_0 cos(n theta), sin(theta / 2) = omega dt / 2 (Hughes, The Finite Element Method, 9.3).
TEST(InitialState, ABarThatIsLetGoSwings) {
  const Cases cases;
  cases.run("pulled", cell(pull + stepping("statics", 1.0, 1.0)));
  cases.run("free", cell(from("pulled") + stepping("central_differences", 20.0, 0.25)));
  const double stretch = 0.1 * 2.0 / 4.0, omega = std::sqrt(2.0 * 4.0) / 2.0;
  const double theta = 2.0 * std::asin(0.5 * omega * 0.25);
  const std::vector<double> z = column(cases.result("free", "probes.csv"), "head.displacement_z");
  ASSERT_EQ(z.size(), 81U);
  for (std::size_t n = 0; n < z.size(); ++n)
    ASSERT_NEAR(z[n], stretch * std::cos(static_cast<double>(n) * theta), 1e-12 * stretch) << n;
  const std::string energy = cases.result("free", "energy.csv");
  EXPECT_NEAR(column(energy, "strain").front(), 0.5 * 0.1 * stretch, 1e-13);  // half of force times way
  expect_closed_books(energy);
}

/// Pressed by 0.05 onto a plane that is a spring.
const std::string pressed = R"([[load]]
pressure = 0.05
group = "HEAD"
[[support]]
nodes = "all"
blocked = ["x", "y"]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
stiffness = 10.0
)";

// What presses on a spring of contact still does: the overlap and its energy are there at the start, and nothing moves.
TEST(InitialState, WhatRestsOnContactStaysThere) {
  const Cases cases;
  cases.run("pressed", block(yielding, pressed + stepping("statics", 1.0, 0.25)));
  cases.run("resting", block(yielding, from("pressed") + pressed + stepping("newmark", 2.0, 0.25)));
  const Kinematics before = last_state(cases.results("pressed")), after = last_state(cases.results("resting"));
  EXPECT_GT(largest(before.q), 0.05);
  expect_near(after.q, before.q, 1e-8 * largest(before.q));  // statics is solved to such residuals
  const std::string energy = cases.result("resting", "energy.csv");
  // 1/2 p^2 A / eps_N
  EXPECT_NEAR(column(energy, "contact_stored").front(), 0.5 * 0.05 * 0.05 / 10.0, 1e-9);
  EXPECT_GT(column(energy, "plastic").front(), 0.0);
  expect_closed_books(energy);
  const std::vector<std::string> notes = read_summary((cases.results("resting") / "summary.json").string()).notes;
  const auto has = [&](const std::string& what) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(has("initial state: that of \"pressed\" at t = 1, step 4; displacements up to"));
  EXPECT_TRUE(has("kept as prestress"));
}

TEST(InitialState, OverlapsAreRefusedWhereTheCaseSaysSoAndWhereTheyAreDeep) {
  const Cases cases;
  cases.run("pressed", block(elastic, pressed + stepping("statics", 1.0, 0.5)));
  const std::string message = cases.refusal(
      block(elastic, from("pressed") + pressed + "initial_penetration = \"refuse\"\n" + stepping("newmark", 1.0)));
  EXPECT_NE(message.find("rows of \"floor\" that penetrate at the start, the worst by 0.005"), std::string::npos)
      << message;
  // Penalties leave no overlap of half a cell; somebody has put the plane into the body.
  std::string deep = pressed;
  deep.replace(deep.find("point = [0.0, 0.0, 0.0]"), 23, "point = [0.0, 0.0, 0.2]");
  const std::string refused = cases.refusal(block(elastic, from("pressed") + deep + stepping("newmark", 1.0)));
  EXPECT_NE(refused.find("(0.41 of a cell)"), std::string::npos) << refused;
  EXPECT_NE(refused.find("of at most a quarter of a cell. Is the normal turned the wrong way"), std::string::npos)
      << refused;
}

// A compressed explicit body steps by the cells that it has, not by those of the mesh.
TEST(InitialState, StepsBeginWithThatOfTheDeformedBody) {
  const Cases cases;
  const std::string finite = "law = \"neo_hookean\"\nE = 2.0\nnu = 0.3\nrho = 1.5";
  const std::string held = R"([[support]]
nodes = "all"
blocked = ["x", "y"]
[[support]]
nodes = "FOOT"
blocked = ["z"]
[[support]]
nodes = "HEAD"
displacement = { z = -1.2, function = "ramp" }
[functions.ramp]
)";
  cases.run("pressed", block(finite, held + "time = [0.0, 1.0]\nvalue = [0.0, 1.0]\n" + stepping("statics", 1.0, 0.1)));
  const std::string on =
      held + "time = [0.0]\nvalue = [1.0]\n[scheme]\nkind = \"central_differences\"\n[time]\nend = 3.0\n";
  cases.run("on", block(finite, from("pressed") + on));
  const std::vector<double> dt = column(cases.result("on", "energy.csv"), "dt");
  const Simulation simulation(read_case(cases.file_of("again", block(finite, from("pressed") + on))));
  EXPECT_LT(dt.at(1), 0.9 * simulation.dt());
  EXPECT_NEAR(dt.at(2), dt.at(1), 1e-12);  // and that step holds
}

TEST(InitialState, VelocitiesBeginWithInertiaAndMayBeReplaced) {
  const Cases cases;
  const std::string two = R"([[mesh.block]]
origin = [5.0, 0.0, 0.0]
size = [1.0, 1.0, 1.0]
divisions = [1, 1, 1]
groups = { cells = "OTHER" }
[[part]]
name = "other"
cells = "OTHER"
material = "soft"
[[probe]]
name = "body"
group = "BODY"
quantities = ["velocity", "displacement"]
[[probe]]
name = "other"
group = "OTHER"
quantities = ["velocity", "displacement"]
)";
  const std::string fly = "[[initial]]\nnodes = \"all\"\nvelocity = [0.5, 0.0, 0.25]\n";
  cases.run("flight", block(elastic, two + fly + stepping("newmark", 1.0, 0.25)));
  const std::string other = "[[initial]]\npart = \"other\"\nvelocity = [0.0, 2.0, 0.0]\n";
  const std::string stage = "[[stage]]\nkind = \"newmark\"\nend = 2.0\nstep = 0.25\n";
  cases.run("on", block(elastic, from("flight") + two + other + stepping("statics", 1.0, 0.5) + stage));
  const std::string probes = cases.result("on", "probes.csv");
  const std::vector<double> x = column(probes, "body.displacement_x");
  EXPECT_NEAR(x.at(0), 0.5, 1e-12);
  EXPECT_NEAR(x.at(2), 0.5, 1e-12);  // held while there is no inertia
  EXPECT_NEAR(x.back(), 1.0, 1e-12);
  EXPECT_NEAR(last_row(probes).at("body.velocity_z"), 0.25, 1e-12);
  EXPECT_NEAR(last_row(probes).at("other.velocity_y"), 2.0, 1e-12);
  EXPECT_NEAR(last_row(probes).at("other.velocity_x"), 0.0, 1e-12);
  EXPECT_NEAR(column(probes, "other.velocity_y").at(2), 0.0, 1e-12);
  // Where nothing has inertia, nothing has velocities: the strained body finds its rest, and is not held in flight.
  cases.run("strained", block(elastic, torn + stepping("newmark", 1.0, 0.25)));
  cases.run("rest", block(elastic, from("strained") + stepping("statics", 1.0, 1.0)));
  const std::string energy = cases.result("rest", "energy.csv");
  EXPECT_LT(column(energy, "strain").back(), 1e-12 * column(energy, "strain").front());
}

// The nodes that springs and obstacles hang on are of the case: the state of the bodies passes them by.
TEST(InitialState, SpringsAndObstaclesAreThoseOfTheCase) {
  const Cases cases;
  const std::string spring = "[[spring]]\nnodes = \"FOOT\"\nstiffness = [0.5, 0.5, 0.5]\n";
  cases.run("hung", block(elastic, spring + torn + stepping("newmark", 1.0, 0.25)));
  const std::string tool = R"([[contact]]
name = "tool"
kind = "sphere"
group = "HEAD"
centre = [0.5, 0.5, 9.0]
radius = 1.0
velocity = [0.0, 0.0, -2.0]
)";
  cases.run("hit", block(elastic, from("hung") + tool + stepping("newmark", 1.0, 0.25)), true);
  const Kinematics before = last_state(cases.results("hung"));
  EXPECT_EQ(before.q.size(), 3U * (63 + 9));
  const Simulation simulation(
      read_case(cases.file_of("again", block(elastic, from("hung") + tool + stepping("newmark", 1.0, 0.25)))));
  const State start = simulation.initial_state();
  ASSERT_EQ(start.q.size(), 3U * (63 + 1));
  for (std::size_t i = 0; i < 3U * 63; ++i) ASSERT_EQ(start.q[i], before.q[i]);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(start.q[3 * 63 + c], 0.0);
  EXPECT_EQ(start.v.back(), -2.0);
  EXPECT_NE(simulation.notes().at(0).find("obstacles that move begin where this case puts them"), std::string::npos);
}

TEST(InitialState, IsToldByTheCheck) {
  const Cases cases;
  cases.run("first", block(yielding, torn + stepping("central_differences", 2.0)), true);
  const Simulation simulation(
      read_case(cases.file_of("on", block(yielding, from("first") + stepping("newmark", 1.0)))));
  const std::string& note = simulation.notes().at(0);
  for (const char* part : {"that of \"first\" at t = 0.05, step 1;", "displacements up to", " m,", "strain energy",
                           "velocities up to", "that run has not come to its end, t = 2"})
    EXPECT_NE(note.find(part), std::string::npos) << note;
  EXPECT_EQ(check_summary(simulation).find("kinetic energy 0 J"), std::string::npos);
}

// In pieces, and without the folder that the state is from: to the last bit.
TEST(InitialState, RunsThatBeginWithItCanBeResumed) {
  const Cases cases;
  cases.run("pressed", block(yielding, pressed + stepping("statics", 1.0, 0.5)));
  const std::string on = block(yielding, from("pressed") + pressed + torn + stepping("statics", 0.5, 0.25) +
                                             "[[stage]]\nkind = \"newmark\"\nend = 1.5\nstep = 0.25\n");
  const std::string file = cases.file_of("on", on);
  ASSERT_NE(cases.run_into("whole", file, false), ExitCode::run_failed) << cases.result("whole", "summary.json");
  cases.run_into("pieces", file, true);
  fs::remove_all(cases.results("pressed"));
  int pieces = 1;
  const auto outcome = [&] { return read_summary((cases.results("pieces") / "summary.json").string()).outcome; };
  for (; outcome() == Outcome::stopped && pieces < 100; ++pieces) cases.resume("pieces", true);
  EXPECT_GE(pieces, 6);
  for (const char* table : {"energy.csv", "contact.csv", "case.resolved.toml"})
    EXPECT_TRUE(cases.result("whole", table) == cases.result("pieces", table)) << table;
  const std::string last = checkpoint_files(cases.results("whole").string()).at(0);
  EXPECT_TRUE(cases.result("whole", last) == cases.result("pieces", last));
  // The copy is part of the folder: without it the run cannot go on, and the next run there removes it.
  EXPECT_TRUE(fs::exists(cases.results("pieces") / "initial_state" / "case.resolved.toml"));
  cases.run("pieces", block(elastic, torn + stepping("newmark", 0.5, 0.25)));
  EXPECT_FALSE(fs::exists(cases.results("pieces") / "initial_state"));
}

TEST(InitialState, IsRefusedWhereThereIsNone) {
  const Cases cases;
  const auto says = [&](const std::string& folder, const std::string& what) {
    const std::string message = cases.refusal(block(elastic, from(folder) + stepping("newmark", 1.0)));
    EXPECT_NE(message.find(what), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with("refused.toml:16:8: initial_state.from: found \"")) << message;
  };
  says("nowhere", "\"nowhere\", and no folder \"nowhere\"; expected the results folder of a run");
  cases.file_of("text", "");
  says("text.toml", "which is a file");
  fs::create_directories(cases.results("empty"));
  says("empty", "a folder without a checkpoint (checkpoints/step_<number>.h5)");
  cases.run("run", block(elastic, "[output]\ncheckpoint_every = 5\n" + torn + stepping("newmark", 1.0)));
  EXPECT_EQ(cases.refusal(block(elastic, from("run") + stepping("newmark", 1.0))), "");
  const auto with = [&](const std::string& name, const auto& change) {
    fs::copy(cases.results("run"), cases.results(name), fs::copy_options::recursive);
    change(cases.results(name));
  };
  with("damaged", [](const fs::path& w) { fs::resize_file(w / checkpoint_files(w.string()).at(0), 3000); });
  says("damaged", "whose last checkpoint cannot be used: damaged/checkpoints/step_000020.h5: it is cut off");
  with("cut", [](const fs::path& w) {
    for (const std::string& file : checkpoint_files(w.string())) fs::resize_file(w / file, 3000);
  });
  says("cut", "no checkpoint can be used");
  with("edited", [](const fs::path& w) { std::ofstream(w / "case.resolved.toml", std::ios::app) << "\n"; });
  says("edited", "case.resolved.toml has been changed since the run");
  with("without", [](const fs::path& w) { fs::remove(w / "case.resolved.toml"); });
  says("without", "case.resolved.toml is missing");
  with("bare", [](const fs::path& w) {
    const std::string file = find_checkpoint(w.string()).path;
    write_checkpoint(file, verify_checkpoint(file), [](Archive&) {});
  });
  says("bare", "it has no values of \"march.state.q\"");
  const std::string again = block(elastic, from("run") + stepping("newmark", 1.0));
  const std::string own = "which is, or is in, the results folder of this run";
  EXPECT_NE(cases.refusal(again, "run").find(own), std::string::npos);
  EXPECT_NE(cases.refusal(block(elastic, from("./other/../run/") + stepping("newmark", 1.0)), "run").find(own),
            std::string::npos);
  EXPECT_TRUE(fs::exists(cases.results("run") / "summary.json"));  // nothing has been removed
}

TEST(InitialState, IsRefusedForOtherBodies) {
  const Cases cases;
  cases.run("run", block(yielding, torn + stepping("central_differences", 1.0)));
  const std::string rest = from("run") + stepping("central_differences", 1.0);
  const std::string good = block(yielding, rest);
  EXPECT_EQ(cases.refusal(good), "");
  const auto with = [&](const std::string& old, const std::string& by) {
    std::string text = good;
    text.replace(text.find(old), old.size(), by);
    return text;
  };
  const auto says = [&](const std::string& text, const std::string& what) {
    const std::string message = cases.refusal(text);
    EXPECT_NE(message.find(what), std::string::npos) << message << "\nand not\n" << what;
  };
  says(with("hardening_modulus = 0.2", "hardening_modulus = 0.3"),
       "refused.toml:6:1: materials.soft.hardening_modulus: found 0.3; expected 0.2, as in "
       "\"run/case.resolved.toml\"");
  says(with(yielding, elastic), "materials.soft.law: found \"linear_elastic\"; expected \"j2\", as in");
  says(with("material = \"soft\"", "material = \"soft\"\nformulation = \"one_point\""),
       "refused.toml:13:1: part[0].formulation: found \"one_point\"; expected nothing, as in");
  says(with("name = \"body\"", "name = \"piece\""), "part[0].name: found \"piece\"; expected \"body\"");
  says(with("units = \"SI\"", "units = \"mm-t-s\""), "units: found \"mm-t-s\"; expected \"SI\"");
  says(with("[2, 2, 6]", "[2, 2, 7]"),
       "the state of another mesh: this case has 72 nodes; expected the mesh of that "
       "run, 63 nodes");
  says(with("[1.0, 1.0, 3.0]", "[1.0, 1.0, 3.1]"), "the state of another mesh: nodes stand elsewhere");
  says(with("[2, 2, 6]", "[2, 6, 2]"), "the state of another mesh: nodes stand elsewhere");
  const std::string other =
      "[[mesh.block]]\norigin = [5.0, 0.0, 0.0]\nsize = [1.0, 1.0, 1.0]\ndivisions = [1, 1, 1]\n"
      "groups = { cells = \"OTHER\" }\n[[part]]\nname = \"other\"\ncells = \"OTHER\"\n"
      "material = \"soft\"\n";
  says(block(yielding, other + rest), "part: found 2 parts; expected 1, as in");
  says(block(yielding, rest + "[[initial]]\nnodes = \"all\"\ndisplacement = [0.0, 0.0, 1.0]\n"),
       "initial[0].displacement: found a displacement beside [initial_state]; expected velocities alone");
}

TEST(InitialState, IsRefusedWhereASupportBeginsElsewhere) {
  const Cases cases;
  const auto held = [](double z) {
    return fmt::format(
        "[[support]]\nnodes = \"FOOT\"\nblocked = [\"x\", \"y\", \"z\"]\n[[support]]\nnodes = \"HEAD\"\n"
        "displacement = {{ z = {} }}\n",
        z);
  };
  cases.run("run", block(elastic, held(0.1) + stepping("statics", 1.0, 1.0)));
  EXPECT_EQ(cases.refusal(block(elastic, from("run") + held(0.1) + stepping("newmark", 1.0))), "");
  // 1e-12 of the diagonal of 1 x 1 x 3 is 3.3e-12.
  EXPECT_EQ(cases.refusal(block(elastic, from("run") + held(0.1 + 3e-12) + stepping("newmark", 1.0))), "");
  const std::string message = cases.refusal(block(elastic, from("run") + held(0.1 + 4e-12) + stepping("newmark", 1.0)));
  EXPECT_NE(
      message.find("support[1].displacement: found 0.100000000004 along z at t = 0, where the initial state has node"),
      std::string::npos)
      << message;
  EXPECT_NE(message.find("at 0.1; expected a displacement that begins where the state is"), std::string::npos);
}

// What points remember is laid out by the program.
TEST(InitialState, OfYieldingBodiesIsOfOneVersion) {
  const Cases cases;
  for (const std::string* law : {&elastic, &yielding}) {
    cases.run("run", block(*law, torn + stepping("central_differences", 1.0)));
    const std::string file = find_checkpoint(cases.results("run").string()).path;
    Kinematics state;
    std::vector<double> points;
    EnergyTerms energies;
    const auto contents = [&](Archive& archive) {
      archive("march.state.q", state.q);
      archive("march.state.v", state.v);
      archive("march.state.points", points);
      archive("march.state.forces.stored", energies);
    };
    CheckpointInfo info = verify_checkpoint(file);
    read_checkpoint(file, contents);
    info.version = "0.0.0";
    write_checkpoint(file, info, contents);
    const std::string message = cases.refusal(block(*law, from("run") + stepping("central_differences", 1.0)));
    const bool is_named = message.find("a state of carom 0.0.0, whose points remember") != std::string::npos;
    EXPECT_EQ(is_named, law == &yielding) << message;
  }
}

/// An instruction set for the kernels, until it goes.
class WithIsa {
 public:
  explicit WithIsa(const char* name) { ::setenv("CAROM_ISA", name, 1); }
  ~WithIsa() { ::unsetenv("CAROM_ISA"); }
  WithIsa(const WithIsa&) = delete;
  WithIsa& operator=(const WithIsa&) = delete;
};

// What points remember stands cell by cell in a checkpoint: another instruction set begins with the same stresses, in
// other places of its batches. The runs differ by the rounding of some hundred steps.
TEST(InitialState, OfYieldingBodiesIsTakenByAnotherInstructionSet) {
  if (std::getenv("CAROM_ISA") != nullptr || chosen_isa() == Isa::reference) GTEST_SKIP() << "there is no choice";
  const Cases cases;
  {
    const WithIsa reference("reference");
    cases.run("yielding", block(yielding, torn + stepping("central_differences", 1.0)));
    cases.run("as before", block(yielding, from("yielding") + stepping("central_differences", 1.0)));
  }
  cases.run("now", block(yielding, from("yielding") + stepping("central_differences", 1.0)));
  const auto before = last_row(read_text(cases.results("as before") / "energy.csv")),
             now = last_row(read_text(cases.results("now") / "energy.csv"));
  EXPECT_GT(before.at("plastic"), 0.0);
  for (const char* name : {"kinetic", "strain", "plastic"})
    EXPECT_NEAR(now.at(name), before.at(name), 1e-10 * before.at("plastic")) << name;
}

}  // namespace
}  // namespace carom::run_initial_state_test
