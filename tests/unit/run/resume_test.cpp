// Runs that are stopped and go on leave what an undisturbed run leaves, byte for byte.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "base/checksum.hpp"
#include "model/compatibility.hpp"
#include "output/checkpoint_file.hpp"
#include "output/found_checkpoint.hpp"
#include "output/results_folder.hpp"
#include "output/results_lock.hpp"
#include "output/summary.hpp"
#include "report/report.hpp"
#include "run_fixture.hpp"

namespace carom::run_resume_test {
namespace {

namespace fs = std::filesystem;
using namespace test;

/// A case in a folder, and runs of it into others.
class Runs {
 public:
  explicit Runs(const std::string& text) {
    static int count = 0;
    folder_ = fs::temp_directory_path() / fmt::format("carom_resume_{}_{}", ::getpid(), count++);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "case.toml") << text;
  }
  ~Runs() { fs::remove_all(folder_); }
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  fs::path results(const std::string& name) const { return folder_ / name; }
  RunOptions options(const std::string& name, int threads) const {
    RunOptions options;
    options.folder = results(name).string();
    options.threads = threads;
    options.progress = ProgressMode::quiet;
    return options;
  }
  /// `stop`: after the first step.
  ExitCode run(const std::string& name, bool stop = false, int threads = 1) const {
    return run_case((folder_ / "case.toml").string(), options(name, threads), std::atomic<bool>{stop});
  }
  ExitCode resume(const std::string& name, bool stop = false, int threads = 1,
                  std::optional<double> end = std::nullopt) const {
    return resume_case(options(name, threads), end, std::atomic<bool>{stop});
  }
  /// Stops after every `each`-th step, goes on with one and two threads by turns.
  ExitCode run_in_pieces(const std::string& name) const {
    ExitCode code = run(name, true);
    for (int i = 0; i < 1000 && is_stopped(name); ++i) code = resume(name, true, 1 + i % 2);
    return code;
  }
  bool is_stopped(const std::string& name) const {
    return read_summary((results(name) / "summary.json").string()).outcome == Outcome::stopped;
  }
  std::string refusal(const std::string& name, std::optional<double> end = std::nullopt) const {
    try {
      resume(name, false, 1, end);
    } catch (const std::exception& e) {
      return e.what();
    }
    return {};
  }

 private:
  fs::path folder_;
};

/// Takes out of a folder what may differ: costs, and the number of threads. The page follows from the files.
void leave_costs_out(const fs::path& folder) {
  const std::string file = (folder / "summary.json").string();
  Summary summary = read_summary(file);
  summary.cost = {};
  summary.program.threads = 1;
  write_summary(file, summary);
  write_report(folder.string());
}

std::set<std::string> files_of(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().parent_path().filename() != "checkpoints")
      files.insert(fs::relative(entry.path(), folder).string());
  return files;
}

/// Every file, and the last checkpoint, which holds all of the run's memory.
void expect_equal_folders(const fs::path& a, const fs::path& b) {
  leave_costs_out(a);
  leave_costs_out(b);
  const std::set<std::string> files = files_of(a);
  EXPECT_EQ(files, files_of(b));
  EXPECT_TRUE(files.contains("energy.csv") && files.contains("summary.json") && files.contains("report.html"));
  for (const std::string& file : files) EXPECT_TRUE(read_text(a / file) == read_text(b / file)) << file << " differs";
  const std::string last = checkpoint_files(a.string()).at(0);
  EXPECT_EQ(checkpoint_files(b.string()).at(0), last);
  EXPECT_TRUE(read_text(a / last) == read_text(b / last)) << "the last checkpoints differ";
}

/// A block is pressed down and dragged aside, on another one or on a plane, with friction.
std::string pressed(const std::string& law, bool on_plane, const std::string& rest, const std::string& yielding = "") {
  const std::string lower = R"([[mesh.block]]
origin = [-0.5, -0.5, -1.0]
size = [3.0, 3.0, 1.0]
divisions = [2, 2, 1]
groups = { cells = "LOWER", zmax = "TOP", zmin = "GROUND" }
[[part]]
name = "lower"
cells = "LOWER"
material = "soft"
[[support]]
nodes = "GROUND"
blocked = ["x", "y", "z"]
)";
  return R"(units = "SI"
[[mesh.block]]
origin = [0.0, 0.0, 0.01]
size = [1.0, 1.0, 2.0]
divisions = [1, 1, 2]
groups = { cells = "BODY", zmin = "FOOT", zmax = "HEAD" }
)" + (on_plane ? "" : lower) +
         fmt::format(R"([materials.soft]
law = "{}"
E = 2.0
nu = 0.3
rho = 1.5
{}
[[part]]
name = "body"
cells = "BODY"
material = "soft"
[[support]]
nodes = "HEAD"
velocity = {{ x = 0.05, z = -0.1 }}
[[contact]]
name = "touch"
{}
group = "FOOT"
friction = 0.3
[[probe]]
name = "foot"
group = "FOOT"
quantities = ["displacement", "velocity", "acceleration", "section_force", "local_acceleration", "contact_slip"]
side = [0.0, 0.0, 1.0]
[guards]
rotation_stop = 90.0
energy_growth = 10.0
[output]
fields_every = 3
curves_every = 2
)",
                     law, yielding,
                     on_plane ? "kind = \"plane\"\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]"
                              : "kind = \"pair\"\nmaster = \"TOP\"") +
         rest;
}

std::string stepping(SchemeKind scheme, EnforcementKind enforcement) {
  std::string text = fmt::format("[scheme]\nkind = \"{}\"\nenforcement = \"{}\"\n[time]\nend = {}\n",
                                 traits(scheme).name, name(enforcement), is_explicit(scheme) ? 3.0 : 1.6);
  if (!is_explicit(scheme)) text += "step = 0.2\n";
  return text;
}

struct Pair {
  SchemeKind scheme;
  EnforcementKind enforcement;
};
void PrintTo(const Pair& pair, std::ostream* out) {
  *out << traits(pair.scheme).name << " " << name(pair.enforcement);
}

std::vector<Pair> allowed_pairs() {
  std::vector<Pair> pairs;
  for (const SchemeTraits& scheme : scheme_table)
    for (std::size_t e = 0; e < enforcement_count; ++e)
      if (scheme.takes[e]) pairs.push_back({scheme.kind, static_cast<EnforcementKind>(e)});
  return pairs;
}

void expect_same_in_pieces(const std::string& text) {
  const Runs runs(text);
  const ExitCode code = runs.run("whole");
  ASSERT_NE(code, ExitCode::run_failed) << read_text(runs.results("whole") / "summary.json");
  EXPECT_EQ(runs.run_in_pieces("pieces"), code);
  const Summary summary = read_summary((runs.results("pieces") / "summary.json").string());
  EXPECT_GE(summary.scheme.steps, 4);
  EXPECT_GT(last_row(read_text(runs.results("pieces") / "contact.csv")).at("touch.closings"), 0.0);
  expect_equal_folders(runs.results("whole"), runs.results("pieces"));
}

class EveryPair : public testing::TestWithParam<Pair> {};

TEST_P(EveryPair, GoesOnFromEveryStepOnAPlane) {
  expect_same_in_pieces(pressed("linear_elastic", true, stepping(GetParam().scheme, GetParam().enforcement)));
}

/// The same on a roller that turns faster and faster, while its axis goes down a little.
std::string pressed_on_roller(const std::string& law, const std::string& rest) {
  return replaced(pressed(law, true, rest), "kind = \"plane\"\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]",
                  R"(kind = "cylinder"
point = [0.5, 0.0, -20.0]
axis = [0.0, 1.0, 0.0]
radius = 20.0
velocity = [0.0, 0.0, -0.01]
angular_velocity = [0.0, 0.05, 0.0]
angular_function = "faster")") +
         R"([functions.faster]
time = [0.0, 1.0, 4.0]
value = [0.0, 0.3, 1.0]
)";
}

TEST_P(EveryPair, GoesOnFromEveryStepOnARoller) {
  expect_same_in_pieces(pressed_on_roller("linear_elastic", stepping(GetParam().scheme, GetParam().enforcement)));
}

TEST_P(EveryPair, GoesOnFromEveryStepBetweenFiniteBodies) {
  std::string text = pressed("neo_hookean", false, stepping(GetParam().scheme, GetParam().enforcement));
  const std::string fast = "z = -0.1";  // statics with multipliers finds no equilibrium below 0.94 of the height
  text.replace(text.find(fast), fast.size(), "z = -0.08");
  expect_same_in_pieces(text);
}

INSTANTIATE_TEST_SUITE_P(Resume, EveryPair, testing::ValuesIn(allowed_pairs()), [](const auto& one) {
  return fmt::format("{}_{}", traits(one.param.scheme).name, name(one.param.enforcement));
});

const std::string penalty_steps = stepping(SchemeKind::newmark, EnforcementKind::penalty);

TEST(Resume, KeepsWhatPlasticBodiesRemember) {
  const std::vector<Pair> pairs{{SchemeKind::newmark, EnforcementKind::penalty},
                                {SchemeKind::central_differences, EnforcementKind::impulse}};
  for (const Pair& pair : pairs) {
    SCOPED_TRACE(testing::PrintToString(pair));
    const Runs runs(
        pressed("j2", false, stepping(pair.scheme, pair.enforcement), "yield_stress = 0.02\nhardening_modulus = 0.1"));
    const ExitCode code = runs.run("whole");
    ASSERT_NE(code, ExitCode::run_failed) << read_text(runs.results("whole") / "summary.json");
    EXPECT_EQ(runs.run_in_pieces("pieces"), code);
    // They yield: most of the work that is done on them is neither stored nor motion.
    const std::map<std::string, double> energy = last_row(read_text(runs.results("pieces") / "energy.csv"));
    EXPECT_GT(energy.at("plastic") + energy.at("quadrature"), energy.at("strain"));
    expect_equal_folders(runs.results("whole"), runs.results("pieces"));
  }
}

// Corners resist from 0.99 of their volume on, so that explicit steps become shorter on the way.
TEST(Resume, KeepsTheStepsOfDistortionControl) {
  const Runs runs(
      replaced(pressed("neo_hookean", false, stepping(SchemeKind::central_differences, EnforcementKind::penalty)),
               "cells = \"BODY\"\n", "cells = \"BODY\"\ndistortion_control = 0.99\n"));
  const ExitCode code = runs.run("whole");
  ASSERT_NE(code, ExitCode::run_failed) << read_text(runs.results("whole") / "summary.json");
  EXPECT_EQ(runs.run_in_pieces("pieces"), code);
  EXPECT_GT(last_row(read_text(runs.results("pieces") / "energy.csv")).at("distortion"), 0.0);
  expect_equal_folders(runs.results("whole"), runs.results("pieces"));
}

// Two blocks that part, by a tie that is half torn as the run is stopped, beside an equation.
TEST(Resume, KeepsWhatTiesAndEquationsRemember) {
  const std::string blocks = R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [1, 2, 2]
groups = { cells = "LEFT", xmax = "LFACE", xmin = "START" }
[[mesh.block]]
origin = [1.0, 0.0, 0.0]
size = [1.0, 1.0, 1.0]
divisions = [1, 3, 3]
groups = { cells = "RIGHT", xmin = "RFACE", xmax = "END" }
points = { CORNER = [2.0, 1.0, 1.0] }
[materials.any]
law = "neo_hookean"
E = 1.0
nu = 0.3
rho = 1.0
[[part]]
name = "left"
cells = "LEFT"
material = "any"
[[part]]
name = "right"
cells = "RIGHT"
material = "any"
[[initial]]
part = "right"
velocity = [0.02, 0.01, 0.0]
[[equation]]
terms = [{ nodes = "START", dof = "x", coefficient = 1.0 }, { nodes = "CORNER", dof = "z", coefficient = -0.3 }]
[[contact]]
name = "glue"
kind = "tie"
group = "RFACE"
master = "LFACE"
normal_strength = 5e-3
normal_fracture_energy = 5e-5
friction = 0.3
)";
  for (const Pair& pair : {Pair{SchemeKind::newmark, EnforcementKind::penalty},
                           Pair{SchemeKind::central_differences, EnforcementKind::penalty},
                           Pair{SchemeKind::moreau_jean, EnforcementKind::impulse}}) {
    SCOPED_TRACE(testing::PrintToString(pair));
    const Runs runs(blocks + stepping(pair.scheme, pair.enforcement));
    const ExitCode code = runs.run("whole");
    ASSERT_NE(code, ExitCode::run_failed) << read_text(runs.results("whole") / "summary.json");
    EXPECT_EQ(runs.run_in_pieces("pieces"), code);
    EXPECT_GT(last_row(read_text(runs.results("pieces") / "energy.csv")).at("fracture"), 0.0);
    expect_equal_folders(runs.results("whole"), runs.results("pieces"));
  }
}

/// A box in a guide that turns about one axis: guides are functions of the displacements alone.
TEST(Resume, KeepsBodiesInTheirGuides) {
  for (const Pair& pair : {Pair{SchemeKind::central_differences, EnforcementKind::penalty},
                           Pair{SchemeKind::newmark, EnforcementKind::augmented_lagrangian}})
    expect_same_in_pieces(replaced(pressed("linear_elastic", true, stepping(pair.scheme, pair.enforcement)),
                                   "kind = \"plane\"\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]",
                                   R"(kind = "box"
lower = [-0.4, -1.0, -1.0]
upper = [2.0, 2.0, 0.0]
mass = 3.0
inertia = [1.0, 1.0, 1.0]
blocked = ["y", "z"]
blocked_turns = ["x", "z"])"));
}

TEST(Resume, GoesOnThroughStages) {
  const Runs runs(pressed("neo_hookean", false, stepping(SchemeKind::statics, EnforcementKind::penalty) + R"([[stage]]
kind = "cd_lagrange"
end = 2.6
[[stage]]
kind = "generalized_alpha"
end = 4.0
step = 0.2
event_tolerance = 0.2
)"));
  const ExitCode code = runs.run("whole");
  EXPECT_EQ(runs.run_in_pieces("pieces"), code);
  EXPECT_EQ(read_summary((runs.results("whole") / "summary.json").string()).scheme.stages.size(), 3U);
  expect_equal_folders(runs.results("whole"), runs.results("pieces"));
}

/// As kill -9 leaves a folder: at some checkpoint, with more rows, frames and half-written files after it.
void forget_the_end(const fs::path& folder) {
  const std::vector<std::string> files = checkpoint_files(folder.string());
  ASSERT_EQ(files.size(), 2U);
  fs::remove(folder / files[0]);
  fs::remove(folder / "report.html");
  std::ofstream(folder / "energy.csv", std::ios::app) << "1.0,2";  // half a row
  std::ofstream(folder / "fields" / "step_999999.vtkhdf.tmp") << "half";
  std::ofstream(folder / "fields" / "mesh.vtkhdf.tmp") << "half";
  std::ofstream(folder / "fields.xdmf", std::ios::app) << "<Grid";  // of the next frame
  std::ofstream(folder / "fields" / "step_999998.vtkhdf") << "of a step that is made again";
  std::ofstream(folder / "checkpoints" / "step_999999.h5.tmp") << "half";
}

TEST(Resume, AfterAKillCutsOffWhatCameAfterTheCheckpoint) {
  for (const int every : {2, 3, 5}) {
    const Runs runs(pressed("linear_elastic", true, fmt::format("checkpoint_every = {}\n", every) + penalty_steps));
    const ExitCode code = runs.run("whole");
    fs::copy(runs.results("whole"), runs.results("killed"), fs::copy_options::recursive);
    forget_the_end(runs.results("killed"));
    EXPECT_EQ(runs.resume("killed"), code);
    expect_equal_folders(runs.results("whole"), runs.results("killed"));
    EXPECT_FALSE(fs::exists(runs.results("killed") / "checkpoints" / "step_999999.h5.tmp"));
  }
}

TEST(Resume, TakesTheOneBeforeWhereTheLastIsDamaged) {
  const Runs runs(pressed("linear_elastic", true, "checkpoint_every = 3\n" + penalty_steps));
  runs.run("whole");
  fs::copy(runs.results("whole"), runs.results("damaged"), fs::copy_options::recursive);
  const fs::path last = runs.results("damaged") / checkpoint_files(runs.results("damaged").string()).at(0);
  fs::resize_file(last, fs::file_size(last) - 1);
  EXPECT_NE(runs.resume("damaged"), ExitCode::run_failed);
  expect_equal_folders(runs.results("whole"), runs.results("damaged"));
}

TEST(Resume, FinishesWhatWasKilledBeforeItsReport) {
  const Runs runs(pressed("linear_elastic", true, penalty_steps));
  const ExitCode code = runs.run("whole");
  fs::copy(runs.results("whole"), runs.results("killed"), fs::copy_options::recursive);
  fs::remove(runs.results("killed") / "report.html");
  EXPECT_EQ(runs.resume("killed"), code);
  expect_equal_folders(runs.results("whole"), runs.results("killed"));
}

TEST(Resume, ProlongsARunThatHasEnded) {
  const Runs runs(pressed("neo_hookean", false, penalty_steps));
  runs.run("ended");
  EXPECT_NE(runs.resume("ended", false, 1, 2.4), ExitCode::run_failed);
  const Summary summary = read_summary((runs.results("ended") / "summary.json").string());
  EXPECT_EQ(summary.scheme.time_end, 2.4);
  EXPECT_NEAR(summary.scheme.time_reached, 2.4, 1e-12);
  EXPECT_EQ(summary.scheme.steps, 12);
  EXPECT_EQ(summary.scheme.dt_largest, 0.2);
  // Prolonged in pieces, and once more from there: the same.
  const Runs again(pressed("neo_hookean", false, penalty_steps));
  again.run("pieces");
  again.resume("pieces", true, 2, 2.4);
  EXPECT_TRUE(again.is_stopped("pieces"));
  for (int i = 0; i < 10 && again.is_stopped("pieces"); ++i) again.resume("pieces", true);
  const auto energy = [](const Runs& r, const char* folder) { return read_text(r.results(folder) / "energy.csv"); };
  EXPECT_EQ(energy(again, "pieces"), energy(runs, "ended"));
}

// Killed before its first checkpoint of its own, a prolonged run still knows of its later end.
TEST(Resume, KnowsOfALaterEndAtOnce) {
  const Runs runs(pressed("neo_hookean", false, penalty_steps));
  runs.run("killed");
  const fs::path last = find_checkpoint(runs.results("killed").string()).path;
  runs.resume("killed", true, 1, 2.4);
  for (const auto& file : fs::directory_iterator(last.parent_path()))
    if (file.path() != last) fs::remove(file);
  runs.resume("killed", false);
  EXPECT_EQ(read_summary((runs.results("killed") / "summary.json").string()).scheme.time_end, 2.4);
}

TEST(Resume, SaysWhyItCannot) {
  const Runs runs(pressed("linear_elastic", true, "checkpoint_every = 3\n" + penalty_steps));
  const auto says = [&](const std::string& folder, const std::string& what, std::optional<double> end = std::nullopt) {
    const std::string message = runs.refusal(folder, end);
    EXPECT_NE(message.find(what), std::string::npos) << "\"" << message << "\" and not \"" << what << "\"";
  };
  says("nowhere", "there is no such folder");
  fs::create_directories(runs.results("empty"));
  says("empty", "there is no checkpoint in it");
  runs.run("done");
  says("done", "the run has come to its end, t = 1.6");
  says("done", "an end at 1, and the run has come to 1.6 already", 1.0);
  {
    const ResultsLock lock(runs.results("done").string());
    says("done", "another run is writing there");
  }
  const std::string folder = runs.results("done").string();
  const auto with = [&](const std::string& name, const auto& change) {
    fs::remove_all(runs.results(name));
    fs::copy(runs.results("done"), runs.results(name), fs::copy_options::recursive);
    change(runs.results(name));
    return name;
  };
  const auto rewritten = [&](const std::string& name, const auto& change) {
    return with(name, [&](const fs::path& where) {
      for (const std::string& file : checkpoint_files(where.string())) {
        CheckpointInfo info = verify_checkpoint((where / file).string());
        change(info);
        write_checkpoint((where / file).string(), info, [](Archive&) {});
      }
    });
  };
  says(rewritten("version", [](CheckpointInfo& i) { i.version = "0.0.0"; }), "it is of carom 0.0.0");
  says(rewritten("compiler", [](CheckpointInfo& i) { i.compiler = "Other 1"; }), "(Other 1)");
  says(rewritten("mesh", [](CheckpointInfo& i) { ++i.mesh_digest; }), "it is of another mesh");
  says(rewritten("bare", [](CheckpointInfo&) {}), "it has no values of \"march.stage\"");
  says(with("case", [](const fs::path& w) { std::ofstream(w / "case.resolved.toml", std::ios::app) << "\n"; }),
       "it is of another case");
  says(with("without", [](const fs::path& w) { fs::remove(w / "case.resolved.toml"); }), "it is missing");
  const auto damaged = [](const fs::path& w) {
    for (const std::string& file : checkpoint_files(w.string())) fs::resize_file(w / file, 2000);
  };
  says(with("cut", damaged), "no checkpoint can be used");
  const std::string cut = with("table", [](const fs::path& w) { fs::resize_file(w / "energy.csv", 100); });
  const std::string before = read_text(runs.results(cut) / "contact.csv");
  says(cut, "it has been cut", 2.0);
  EXPECT_EQ(read_text(runs.results(cut) / "contact.csv"), before);  // nothing has been changed
  EXPECT_TRUE(fs::exists(runs.results(cut) / "summary.json"));
}

// What points and grids remember stands cell by cell in a checkpoint. Runs under one instruction set differ from those
// that change it by rounding; what a run says of it stands among its notes.
TEST(Resume, GoesOnUnderAnotherInstructionSet) {
  if (std::getenv("CAROM_ISA") != nullptr || chosen_isa() == Isa::reference) GTEST_SKIP() << "there is no choice";
  for (const char* scheme : {"central_differences", "generalized_alpha"}) {
    SCOPED_TRACE(scheme);
    const std::string scheme_text = std::string(scheme);
    const Runs runs(pressed("j2", false,
                            "[scheme]\nkind = \"" + scheme_text + "\"\n[time]\nend = 3.0\n" +
                                (scheme_text == "central_differences" ? "" : "step = 0.1\n"),
                            "yield_stress = 0.02\nhardening_modulus = 0.1"));
    ::setenv("CAROM_ISA", "reference", 1);
    runs.run("one");
    runs.run("two", true);
    for (int i = 0; i < 5; ++i) runs.resume("two", true);
    ::unsetenv("CAROM_ISA");
    runs.resume("two");
    const auto one = last_row(read_text(runs.results("one") / "energy.csv")),
               two = last_row(read_text(runs.results("two") / "energy.csv"));
    EXPECT_GT(one.at("plastic"), 1e-4);
    for (const char* name : {"kinetic", "strain", "plastic"})
      EXPECT_NEAR(two.at(name), one.at(name), 1e-9 * one.at("plastic")) << name;
    const std::vector<std::string> notes = read_summary((runs.results("two") / "summary.json").string()).notes;
    EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
      return note.find("after reference: the last digits") != std::string::npos;
    }));
  }
}

TEST(Resume, KeepsTheLastTwoCheckpoints) {
  const Runs runs(pressed("linear_elastic", true, "checkpoint_every = 1\n" + penalty_steps));
  runs.run("many");
  EXPECT_EQ(checkpoint_files(runs.results("many").string()),
            (std::vector<std::string>{"checkpoints/step_000008.h5", "checkpoints/step_000007.h5"}));
  // Another run into the folder begins without them.
  runs.run("many", true);
  EXPECT_EQ(checkpoint_files(runs.results("many").string()), std::vector<std::string>{"checkpoints/step_000001.h5"});
}

}  // namespace
}  // namespace carom::run_resume_test
