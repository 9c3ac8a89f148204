// Runs without a folder, and what is saved of them in memory.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "output/checkpoint_file.hpp"
#include "run/run.hpp"
#include "run_fixture.hpp"
#include "view/frame_file.hpp"

namespace carom::run_snapshot_test {
namespace {

using namespace test;

/// A block that falls onto a plane, in steps of one stage or of two.
std::string falling(const std::string& schemes, double speed = -0.1) {
  return case_of_block(R"(
[[initial]]
part = "body"
velocity = [0.0, 0.0, )" +
                       std::to_string(speed) + R"(]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, -0.02]
normal = [0.0, 0.0, 1.0]
measure = "area"
stiffness = 20.0
)" + schemes);
}

const std::string implicit = "[scheme]\nkind = \"newmark\"\n[time]\nend = 4.0\nstep = 0.1\n";
const std::string two_stages = R"([scheme]
kind = "central_differences"
[time]
end = 2.0
[[stage]]
kind = "newmark"
end = 4.0
step = 0.1
)";

/// All rows so far.
std::vector<double> rows_of(const Run& run) {
  std::vector<double> all;
  for (const Recorder::KeptTable& table : run.watched().recorder.kept())
    all.insert(all.end(), table.values.begin(), table.values.end());
  return all;
}

void step_to_end(Run& run) {
  while (!run.is_over()) run.step();
}

TEST(RunSnapshot, StepsAfterItAreTheSameInThisRunAndInAnother) {
  for (const std::string& schemes : {implicit, two_stages}) {
    const Simulation simulation(parse_case(falling(schemes), "case.toml"));
    carom::Run run(simulation, "", {});
    run.keep_rows();
    run.begin();
    for (int i = 0; i < 8; ++i) run.step();
    const std::shared_ptr<const Snapshot> early = run.save();
    step_to_end(run);
    const std::vector<double> whole = rows_of(run);
    const Summary summary = run.finish();
    EXPECT_EQ(summary.outcome, Outcome::good) << summary.message;
    run.restore(*early);  // from another stage back into the first
    EXPECT_EQ(run.march().steps(), 7);
    step_to_end(run);
    EXPECT_EQ(rows_of(run), whole);
    const Simulation again(parse_case(falling(schemes), "case.toml"));
    carom::Run other(again, "", {});
    other.keep_rows();
    other.restore(*early);
    step_to_end(other);
    EXPECT_EQ(rows_of(other), whole);
  }
}

TEST(RunSnapshot, OfAnotherCaseIsRefused) {
  const Simulation simulation(parse_case(falling(implicit), "case.toml"));
  carom::Run run(simulation, "", {});
  run.step();
  const Simulation faster(parse_case(falling(implicit, -0.2), "case.toml"));
  carom::Run other(faster, "", {});
  other.step();
  EXPECT_THROW(other.restore(*run.save()), CheckpointError);
  other.step();
  EXPECT_EQ(other.march().steps(), 1);
}

TEST(RunSnapshot, AFolderAtTheEndHoldsWhatOneFromTheStartHolds) {
  const TemporaryCase early(falling(implicit));
  EXPECT_EQ(early.run(), ExitCode::good);
  const TemporaryCase late("");
  const Simulation simulation(parse_case(falling(implicit), "case.toml"));
  carom::Run run(simulation, "", {});
  run.keep_rows();
  run.begin();
  step_to_end(run);
  run.begin_folder(late.results().string());
  run.finish();
  for (const char* table : {"energy.csv", "contact.csv", "probes.csv"})
    EXPECT_EQ(early.result(table), late.result(table));
  EXPECT_TRUE(std::filesystem::exists(late.results() / "report.html"));
}

TEST(RunSnapshot, AFunctionThatAProgramComputesIsRefusedWithoutIt) {
  const CaseError e = case_error(falling(
      implicit + "[functions.pulse]\nkind = \"called\"\n[[load]]\ngravity = [0.0, 0.0, 1.0]\nfunction = \"pulse\"\n"));
  EXPECT_EQ(e.key(), "functions.pulse");
}

// Back to the second frame: the first two stay, each with the obstacle as it stood then.
TEST(RunSnapshot, FramesThatStayKeepTheirObstacles) {
  const TemporaryCase folder("");
  std::string text = falling(implicit + "[output]\nfields_every = 1\n");
  text = replaced(text, "kind = \"plane\"\n", "kind = \"plane\"\nvelocity = [0.0, 0.0, -0.01]\n");
  const Simulation simulation(parse_case(text, "case.toml"));
  carom::Run run(simulation, folder.results().string(), {});
  run.begin();
  for (int i = 0; i < 2; ++i) run.step();  // the initial state, and a step
  const std::shared_ptr<const Snapshot> early = run.save();
  for (int i = 0; i < 2; ++i) run.step();
  run.restore(*early);
  const std::vector<FrameEntry> frames = read_frames(folder.results().string());
  ASSERT_EQ(frames.size(), 2U);
  for (const FrameEntry& frame : frames) {
    EXPECT_FALSE(frame.obstacles.empty()) << frame.file;
    EXPECT_TRUE(std::filesystem::exists(folder.results() / frame.obstacles)) << frame.obstacles;
  }
}

}  // namespace
}  // namespace carom::run_snapshot_test
