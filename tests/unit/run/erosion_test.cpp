// Cells that go within a run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include "advise/check_summary.hpp"
#include "parallel/threads.hpp"
#include "run/run.hpp"
#include "run_fixture.hpp"
#include "solid/cell_values.hpp"

namespace carom::run_erosion_test {
namespace {

using namespace test;

/// A bar of 9 x 2 x 2 cells in three parts: "left", the fifth layer "slice", "right".
std::string three_parts() {
  constexpr int n = 9;
  const auto node = [](int i, int j, int k) { return 1 + i + (n + 1) * (j + 3 * k); };
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n3 1 \"LEFT\"\n3 2 \"SLICE\"\n3 3 \"RIGHT\"\n"
       << "$EndPhysicalNames\n$Nodes\n"
       << 9 * (n + 1) << "\n";
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i <= n; ++i) text << node(i, j, k) << " " << i << " " << j << " " << k << "\n";
  text << "$EndNodes\n$Elements\n" << 4 * n << "\n";
  int cell = 0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < n; ++i) {
        const int group = i < 4 ? 1 : i == 4 ? 2 : 3;
        text << ++cell << " 5 2 " << group << " " << group;
        for (const int up : {0, 1})
          text << " " << node(i, j, k + up) << " " << node(i + 1, j, k + up) << " " << node(i + 1, j + 1, k + up) << " "
               << node(i, j + 1, k + up);
        text << "\n";
      }
  return text.str() + "$EndElements\n";
}

/// The bar flies, turns and stretches; its slice goes at t = 2.
class CutBar {
 public:
  /// later: the stages after the first.
  explicit CutBar(const std::string& scheme = "central_differences", const std::string& later = "") {
    static int count = 0;
    mesh_ = std::filesystem::temp_directory_path() /
            ("carom_cut_" + std::to_string(getpid()) + "_" + std::to_string(count++) + ".msh");
    std::ofstream(mesh_) << three_parts();
    std::string text = "units = \"SI\"\n[mesh]\nfile = \"" + mesh_.string() +
                       "\"\n[materials.soft]\nlaw = \"neo_hookean\"\nE = 2.0\nnu = 0.3\nrho = 1.5\n";
    for (const std::string part : {"left", "slice", "right"}) {
      std::string group = part;
      for (char& c : group) c = static_cast<char>(std::toupper(c));
      text += "[[part]]\nname = \"" + part + "\"\ncells = \"" + group + "\"\nmaterial = \"soft\"\n";
    }
    text +=
        "[[initial]]\npart = \"left\"\nvelocity = [-0.02, 0.0, 0.01]\n"
        "[[initial]]\npart = \"right\"\nvelocity = [0.03, 0.02, 0.0]\n"
        "[[erosion]]\npart = \"slice\"\ntime = 2.0\n[scheme]\nkind = \"" +
        scheme + "\"\n[time]\nend = 8.0\n" + later;
    simulation_ = std::make_unique<Simulation>(parse_case(text, "case.toml"));
  }
  ~CutBar() { std::filesystem::remove(mesh_); }
  CutBar(const CutBar&) = delete;
  CutBar& operator=(const CutBar&) = delete;

  const Simulation& simulation() const { return *simulation_; }
  /// Momentum of the nodes on one side of the slice.
  Vec3 momentum(const State& state, bool right) const {
    Vec3 sum{};
    const std::vector<double>& mass = simulation_->mass().node_diagonal();
    for (std::size_t n = 0; n < mass.size(); ++n) {
      if ((simulation_->mesh().coordinates[n][0] > 4.5) != right) continue;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += mass[n] * state.v[3 * n + c];
    }
    return sum;
  }

 private:
  std::filesystem::path mesh_;
  std::unique_ptr<Simulation> simulation_;
};

class ErosionUnder : public testing::TestWithParam<const char*> {};

// Each half is free from the cut on: its momentum stays, to the rounding of the sums over some hundred steps. What the
// slice has stored is what the ledger has in `eroded`; the balance of powers is closed at every step.
TEST_P(ErosionUnder, ABarThatIsCutFliesOnInTwo) {
  const CutBar bar(GetParam());
  March march(bar.simulation());
  march.start();
  Vec3 left{}, right{};
  double in_slice = 0.0;
  std::vector<Index> slice;
  for (Index k = 16; k < 20; ++k) slice.push_back(k);
  for (const Index k : slice)
    ASSERT_EQ(bar.simulation().model().part_of(bar.simulation().solid().cells()[static_cast<std::size_t>(k)])->name,
              "slice");
  while (!march.at_end()) {
    const bool was_whole = march.state().topology == nullptr;
    march.step();
    ASSERT_FALSE(march.has_failed()) << march.message();
    EXPECT_LE(std::abs(march.ledger().imbalance()), 1e-13);
    const State& state = march.state();
    if (was_whole && state.topology != nullptr) {
      left = bar.momentum(state, false);
      right = bar.momentum(state, true);
      std::vector<double> f(state.q.size(), 0.0);
      SolidEnergies energies;
      bar.simulation().solid().add_internal_force_of(slice, state.q, f, {}, &energies);
      in_slice = energies.strain + energies.hourglass;
      EXPECT_NEAR(march.ledger().now().eroded, in_slice, 1e-13);
    }
    if (state.topology == nullptr) continue;
    EXPECT_GE(state.t, 2.0);
    EXPECT_LE(norm(subtract(bar.momentum(state, false), left)), 1e-13);
    EXPECT_LE(norm(subtract(bar.momentum(state, true), right)), 1e-13);
  }
  EXPECT_GT(in_slice, 1e-5);
  EXPECT_NEAR(march.ledger().now().eroded, in_slice, 1e-13);
  EXPECT_GT(left[0], -0.02 * 1.5 * 18.0);
}

INSTANTIATE_TEST_SUITE_P(Schemes, ErosionUnder,
                         testing::Values("central_differences", "hulbert_chung", "noh_bathe", "tchamwa_wielgosz"),
                         [](const auto& scheme) { return std::string(scheme.param); });

/// A rigid ball through a plate of one unit, which yields.
std::string pierced(const std::string& scheme = "central_differences", const std::string& enforcement = "penalty") {
  return R"(units = "SI"
[[mesh.block]]
origin = [-2.0, -2.0, 0.0]
size = [4.0, 4.0, 1.0]
divisions = [8, 8, 3]
groups = { cells = "PLATE" }
[materials.soft]
law = "j2"
E = 70.0
nu = 0.3
rho = 2.7
yield_stress = 0.2
hardening_modulus = 0.2
[[part]]
name = "plate"
cells = "PLATE"
material = "soft"
[[erosion]]
part = "plate"
plastic_strain = 0.3
distortion = 0.1
[[contact]]
name = "ball"
kind = "sphere"
group = "PLATE"
friction = 0.2
centre = [0.05, 0.03, 2.01]
radius = 1.0
mass = 20.0
velocity = [0.0, 0.0, -0.6]
[scheme]
kind = ")" +
         scheme + "\"\nenforcement = \"" + enforcement + "\"\n[time]\nend = 4.0\n";
}

/// The same by damage, under pressure and tension.
std::string pierced_by_damage() {
  return replaced(replaced(pierced(), "plastic_strain = 0.3", "damage = 1.0"), "hardening_modulus = 0.2\n",
                  "hardening_modulus = 0.2\ndamage = { D1 = 0.1, D2 = 0.3, D3 = -1.5, D4 = 0.05, reference_rate = 0.01 "
                  "}\n");
}

// A share of a volume at rest: with one and more, cells would go that nothing has crushed.
TEST(Erosion, TakesADistortionBelowOneOnly) {
  EXPECT_NO_THROW(parse_case(replaced(pierced(), "distortion = 0.1", "distortion = 0.9"), "case.toml"));
  for (const char* share : {"1.0", "1.5"}) {
    try {
      parse_case(replaced(pierced(), "distortion = 0.1", std::string("distortion = ") + share), "case.toml");
      ADD_FAILURE() << "no error with " << share;
    } catch (const CaseError& e) {
      EXPECT_EQ(e.key(), "erosion[0].distortion") << e.what();
    }
  }
}

std::vector<double> rows_of(const carom::Run& run) {
  std::vector<double> all;
  for (const Recorder::KeptTable& table : run.watched().recorder.kept())
    all.insert(all.end(), table.values.begin(), table.values.end());
  return all;
}

std::size_t gone(const State& state) {
  return static_cast<std::size_t>(std::ranges::count(state.alive(), 0));
}

/// A cube all of whose nodes are led: in a time of 1 its length along x grows by 1, its sides are held.
std::string led_cube() {
  return R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [1, 1, 1]
groups = { cells = "CUBE", xmin = "FOOT", xmax = "HEAD" }
[materials.soft]
law = "j2"
E = 200.0
nu = 0.3
rho = 1.0
yield_stress = 1.0
hardening_modulus = 10.0
damage = { D1 = 0.05, D2 = 0.3, D3 = -0.2, D4 = 0.05, reference_rate = 0.1 }
[[part]]
name = "cube"
cells = "CUBE"
material = "soft"
formulation = "full"
[[erosion]]
part = "cube"
damage = 1.0
[[support]]
nodes = "CUBE"
blocked = ["y", "z"]
[[support]]
nodes = "FOOT"
blocked = ["x"]
[[support]]
nodes = "HEAD"
displacement = { x = 1.0, function = "ramp" }
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
[scheme]
kind = "central_differences"
[time]
end = 0.5
step = 0.002
)";
}

// With e = ln(1 + t): alpha = (2 G e - yield) / (3 G + H), eta = K e / (yield + H alpha), and d D = d alpha / ([D1 + D2
// exp(D3 eta)] [1 + D4 ln(rate / reference_rate)]) summed over the steps. The cell goes in the step in which that is 1,
// with all that it has stored, s^2 / (6 G) of the equivalent stress s and K e^2 / 2, and spent.
TEST(RunErosion, ACellGoesInTheStepInWhichItsDamageIsOne) {
  constexpr double G = 200.0 / 2.6, K = 200.0 / 1.2, yield = 1.0, H = 10.0;
  const Simulation simulation(parse_case(led_cube(), "case.toml"));
  March march(simulation);
  march.start();
  double before = 0.0, damage = 0.0, held = 0.0;
  int with_growth = 0;
  while (damage < 1.0) {
    ASSERT_FALSE(march.at_end()) << damage;
    EXPECT_EQ(march.state().topology, nullptr);
    const double start = march.state().t;
    march.step();
    ASSERT_FALSE(march.has_failed()) << march.message();
    EXPECT_LE(std::abs(march.ledger().imbalance()), 1e-12);
    const double e = std::log1p(march.state().t), alpha = std::max(0.0, (2 * G * e - yield) / (3 * G + H));
    const double s = alpha > 0.0 ? yield + H * alpha : 2 * G * e, rate = (alpha - before) / (march.state().t - start);
    const double of_rate = 1.0 + 0.05 * std::log(std::max(1.0, rate / 0.1));
    damage += (alpha - before) / ((0.05 + 0.3 * std::exp(-0.2 * K * e / s)) * of_rate);
    held = s * s / (6 * G) + 0.5 * K * e * e + (yield + 0.5 * H * alpha) * alpha;
    if (alpha > before) ++with_growth;
    before = alpha;
    const std::vector<double> found =
        cell_history(simulation.solid(), damaged_by, march.state().points, OverPoints::largest);
    if (damage < 1.0) {
      EXPECT_NEAR(found.at(0), damage, 1e-10);  // some hundred sums, rates from differences of times
    }
  }
  EXPECT_GT(with_growth, 20);
  ASSERT_NE(march.state().topology, nullptr);
  EXPECT_EQ(gone(march.state()), 1U);
  EXPECT_NEAR(march.ledger().now().eroded, held, 1e-10);
}

// To the bit with one thread and with two, from snapshots before and between erosions, in this run and in another.
TEST(RunErosion, GoesOnToTheBit) {
  for (const std::string& text : {pierced(), pierced("central_differences", "impulse"), pierced_by_damage()}) {
    const Simulation simulation(parse_case(text, "case.toml"));
    set_threads(1);
    carom::Run run(simulation, "", {});
    run.keep_rows();
    run.begin();
    for (int i = 0; i < 3; ++i) run.step();
    const std::shared_ptr<const Snapshot> early = run.save();
    while (!run.is_over() && gone(run.march().state()) < 5) run.step();
    ASSERT_FALSE(run.is_over());
    const std::shared_ptr<const Snapshot> between = run.save();
    while (!run.is_over()) run.step();
    const std::vector<double> whole = rows_of(run);
    const std::size_t went = gone(run.march().state());
    EXPECT_GT(went, 8U);
    set_threads(2);
    for (const auto& snapshot : {between, early}) {
      run.restore(*snapshot);
      while (!run.is_over()) run.step();
      EXPECT_TRUE(rows_of(run) == whole);
      const Simulation again(parse_case(text, "case.toml"));
      carom::Run other(again, "", {});
      other.keep_rows();
      other.restore(*snapshot);
      while (!other.is_over()) other.step();
      EXPECT_TRUE(rows_of(other) == whole);
      EXPECT_EQ(gone(other.march().state()), went);
    }
    set_threads(0);
  }
}

// What a part has lost is one line of the log, however many stages there are.
TEST(RunErosion, TheLogSaysOnceWhatHasGone) {
  const CutBar bar("central_differences", "[[stage]]\nkind = \"central_differences\"\nend = 9.0\n");
  March march(bar.simulation());
  march.start();
  while (!march.at_end() && !march.has_failed()) march.step();
  const std::vector<std::string> log = march.log();
  const auto lines = [&](const std::string& begin) {
    return std::ranges::count_if(log, [&](const std::string& line) { return line.starts_with(begin); });
  };
  EXPECT_EQ(lines("stage: "), 1);
  EXPECT_EQ(lines("erosion: "), 1);
  EXPECT_EQ(lines("erosion: 4 of the 4 cells of part \"slice\" have gone, from t = 2"), 1);
}

// In the state that a step ends with, contact sees the faces that its erosion has laid bare.
TEST(RunErosion, FacesBehindAreMetInTheSameStep) {
  const Simulation simulation(parse_case(pierced(), "case.toml"));
  March march(simulation);
  march.start();
  std::size_t before = 0;
  for (bool has_eroded = false; !march.at_end(); has_eroded = gone(march.state()) > before) {
    if (has_eroded) {
      const State& state = march.state();
      const auto rows = simulation.contact().rows_at(state.q, state.q, {state.contact, state.topology});
      EXPECT_EQ(state.forces.rows.rows->size(), rows->size());
      EXPECT_EQ(state.contact.size(), simulation.contact().slots(state.topology));
    }
    before = gone(march.state());
    march.step();
    ASSERT_FALSE(march.has_failed()) << march.message();
  }
  EXPECT_GT(before, 8U);
  const TemporaryCase as_a_case(pierced());
  EXPECT_EQ(as_a_case.run(), ExitCode::good) << as_a_case.result("summary.json");
}

/// What the message of the case's error finds fault with.
std::string found(const std::string& text) {
  return case_error(text).found();
}
bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(RunErosion, IsRefusedWhereCellsCannotGo) {
  const std::string implicit = replaced(pierced("newmark"), "end = 4.0", "end = 4.0\nstep = 0.1");
  EXPECT_TRUE(has(found(implicit), "newmark"));
  const std::string elastic = replaced(replaced(pierced(), "law = \"j2\"", "law = \"neo_hookean\""),
                                       "yield_stress = 0.2\nhardening_modulus = 0.2\n", "");
  EXPECT_TRUE(has(found(elastic), "does not yield"));
  const std::string whole = replaced(pierced(), "plastic_strain = 0.3", "damage = 1.0");
  EXPECT_EQ(case_error(whole).key(), "erosion.damage");
  EXPECT_TRUE(has(found(whole), "has none"));
  const std::string pressed = pierced() + R"([[load]]
group = "PLATE"
pressure = 0.01
)";
  EXPECT_TRUE(has(found(pressed), "under pressure"));
}

// A case that takes the state over has all of its cells.
TEST(RunErosion, AStateInWhichCellsHaveGoneIsNotTakenOver) {
  const TemporaryCase before(pierced());
  ASSERT_EQ(before.run(), ExitCode::good);
  const std::string after = pierced() + "[initial_state]\nfrom = \"" + before.results().string() + "\"\n";
  EXPECT_TRUE(has(found(after), "cells have gone"));
}

TEST(RunErosion, IsSaidBeforeTheRun) {
  const Simulation simulation(parse_case(pierced(), "case.toml"));
  EXPECT_TRUE(
      has(check_summary(simulation),
          "\"plate\": 192 cells may go, at a plastic strain of 0.3 or a corner's volume of 0.1 of that at rest"));
  const Simulation damaged(parse_case(pierced_by_damage(), "case.toml"));
  EXPECT_TRUE(has(check_summary(damaged), "192 cells may go, at a damage of 1 or a corner's"));
}

}  // namespace
}  // namespace carom::run_erosion_test
