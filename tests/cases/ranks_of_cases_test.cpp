// The same bits from any number of ranks: the explicit penalty cases of cases/, and blocks of many chunks.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "build/simulation.hpp"
#include "casefile/read_case.hpp"
#include "march/march.hpp"
#include "parallel/ranks.hpp"
#include "run/run.hpp"

namespace carom::ranks_of_cases_test {
namespace {

/// Where a run has come to after some steps.
struct Reached {
  State state;
  EnergyTerms energies;
  Momentum momentum;
  long long steps = 0;

  friend bool operator==(const Reached&, const Reached&) = default;
};

Reached reached(const Case& given, long long steps) {
  const Simulation simulation(given);
  March march(simulation);
  march.start();
  while (march.steps() < steps && !march.at_end() && !march.has_failed()) march.step();
  EXPECT_FALSE(march.has_failed()) << march.message();
  march.complete();
  return {march.state(), march.ledger().now(), march.ledger().momentum(), march.steps()};
}

/// What every rank has reached.
std::vector<Reached> on_ranks(std::size_t count, const Case& given, long long steps) {
  std::vector<Reached> all(count);
  run_on_ranks(count, [&] { all[ranks().own()] = reached(given, steps); });
  return all;
}

void expect_same_bits(const Case& given, long long steps) {
  const Reached alone = reached(given, steps);
  EXPECT_GT(alone.steps, 0);
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
    const std::vector<Reached> all = on_ranks(count, given, steps);
    for (std::size_t r = 0; r < count; ++r) EXPECT_TRUE(all[r] == alone) << "rank " << r << " of " << count;
  }
}

bool is_explicit_penalty(const Case& given) {
  const CaseScheme& scheme = given.scheme;
  return traits(scheme.kind.value).stepping == Stepping::explicit_steps && scheme.enforcement &&
         scheme.enforcement->value == EnforcementKind::penalty;
}

std::vector<std::string> explicit_cases() {
  std::vector<std::string> found;
  const std::filesystem::path folder = std::filesystem::path(CAROM_SOURCE_DIR) / "cases";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".toml" && is_explicit_penalty(read_case(entry.path().string())))
      found.push_back(std::filesystem::relative(entry.path(), folder).string());
  std::sort(found.begin(), found.end());
  return found;
}

class CaseOnRanks : public testing::TestWithParam<std::string> {};

TEST_P(CaseOnRanks, HasTheSameBits) {
  expect_same_bits(read_case(std::string(CAROM_SOURCE_DIR "/cases/") + GetParam()), 60);
}

/// 12,288 cells that yield, 24 chunks of 512, on a plane with friction.
constexpr std::string_view bar_of_many_chunks = R"(
[[mesh.block]]
origin = [0.0, 0.0, 0.0]
size = [0.016, 0.016, 0.048]
divisions = [16, 16, 48]
groups = { cells = "BAR", zmin = "FOOT" }

[materials.copper]
law = "j2"
E = 1.17e11
nu = 0.35
rho = 8930.0
yield_stress = 4.0e8
hardening_modulus = 1.0e8

[[part]]
name = "bar"
cells = "BAR"
material = "copper"

[[initial]]
part = "bar"
velocity = [20.0, 0.0, -227.0]

[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
friction = 0.3

[scheme]
kind = "central_differences"

[time]
end = 1e-5
)";

TEST(BarOnRanks, HasTheSameBitsWhereChunksAreOfSeveralRanks) {
  expect_same_bits(parse_case(std::string(bar_of_many_chunks), "bar.toml"), 20);
}

/// Two blocks of 2,300 nodes, one above the other and moved aside, with a spring; the upper one falls.
std::string two_blocks(const std::string& law, const std::string& scheme, const std::string& solver) {
  std::string text = R"(
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [10, 10, 18]
groups = { cells = "LOWER", zmin = "FOOT", zmax = "TOP" }
[[mesh.block]]
origin = [0.12, 0.07, 1.001]
size = [1.0, 1.0, 1.0]
divisions = [10, 10, 18]
groups = { cells = "UPPER", zmin = "SOLE", zmax = "HEAD" }
[materials.soft]
law = "LAW"
E = 1.0e6
nu = 0.3
rho = 1000.0
[[part]]
name = "lower"
cells = "LOWER"
material = "soft"
[[part]]
name = "upper"
cells = "UPPER"
material = "soft"
[[initial]]
part = "upper"
velocity = [0.3, 0.0, -1.0]
[[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
[[spring]]
nodes = "HEAD"
stiffness = [10.0, 10.0, 10.0]
[[contact]]
name = "between"
kind = "pair"
group = "SOLE"
master = "TOP"
friction = 0.2
[[load]]
group = "HEAD"
pressure = 1000.0
[scheme]
kind = "SCHEME"
[solver]
kind = "SOLVER"
[time]
end = 1.0
step = 2.0e-3
)";
  for (const auto& [key, value] :
       {std::pair<std::string, std::string>{"LAW", law}, {"SCHEME", scheme}, {"SOLVER", solver}})
    text.replace(text.find('"' + key + '"') + 1, key.size(), value);
  return text;
}

struct ImplicitRun {
  std::string law, scheme, solver;
  friend void PrintTo(const ImplicitRun& x, std::ostream* out) { *out << x.law << ' ' << x.scheme << ' ' << x.solver; }
};

class ImplicitOnRanks : public testing::TestWithParam<ImplicitRun> {};

TEST_P(ImplicitOnRanks, HasTheSameBits) {
  const ImplicitRun& p = GetParam();
  expect_same_bits(parse_case(two_blocks(p.law, p.scheme, p.solver), "blocks.toml"), 1);
}

INSTANTIATE_TEST_SUITE_P(Solvers, ImplicitOnRanks,
                         testing::Values(ImplicitRun{"linear_elastic", "hht", "cg"},
                                         ImplicitRun{"linear_elastic", "hht", "multigrid"},
                                         ImplicitRun{"neo_hookean", "energy_momentum", "cg"},
                                         ImplicitRun{"neo_hookean", "newmark", "multigrid"}),
                         [](const testing::TestParamInfo<ImplicitRun>& param) {
                           return param.param.law + "_" + param.param.scheme + "_" + param.param.solver;
                         });

/// What goes wrong on one rank alone.
class FailsOnOne : public Observer {
 public:
  void see(const StepView& view) override {
    if (view.step == 2 && ranks().own() == 1) throw std::runtime_error("only here");
  }
};

TEST(BarOnRanks, EndTogetherWhereOneOfThemFails) {
  const Case given = parse_case(std::string(bar_of_many_chunks), "bar.toml");
  const auto run_to_the_end = [&] {
    const Simulation simulation(given);
    FailsOnOne observer;
    carom::Run own(simulation, "", {});
    own.add(observer);
    own.begin();
    while (!own.is_over()) own.step();
  };
  try {
    run_on_ranks(3, run_to_the_end);
    ADD_FAILURE() << "the others have come to an end";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "the run could not go on: only here");
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, CaseOnRanks, testing::ValuesIn(explicit_cases()),
                         [](const testing::TestParamInfo<std::string>& param) {
                           std::string name = param.param;
                           std::ranges::replace_if(
                               name, [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace carom::ranks_of_cases_test
