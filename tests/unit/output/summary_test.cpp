#include "output/summary.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "base/errors.hpp"
#include "output/units.hpp"

namespace carom::output_summary_test {
namespace {

namespace fs = std::filesystem;

std::string scratch() {
  return (fs::temp_directory_path() / fmt::format("carom_{}.json", ::getpid())).string();
}

/// Every field differs from its default, so a field that is dropped or swapped shows.
Summary sample() {
  Summary s;
  s.program = {"0.1.0", "GCC 12.2.0", "v4", 2};
  s.case_info = {"a/b \"c\".toml", "Bar <script>alert(1)</script> é", "SI"};
  s.mesh = {88, 21, {{"ENCASTR", 4, 1}, {"SYMX", 44, 20}}, 1.75, "0123456789abcdef"};
  s.parts = {{"bar", 0.5, {1, 2, 3}, {-1, -2, -3}}};
  s.stress = {4e8, 1e-4, "bar", 17, {0.5, 0.25, 0.125}, 201};
  s.probes = {{"B", "node 12", {0.1, 0.2, 0.3}}};
  s.shock = {{"B", "acceleration"}};
  double number = 0.0;
  for (const auto& [name, member] : shock_numbers) s.shock[0].*member = number += 1.5;
  s.scheme = {"Newmark beta 0.25 gamma 0.5",
              "CHOLMOD",
              1e-6,
              2e-6,
              150,
              3e-4,
              2.5e-4,
              0.25,
              0.0125,
              {"one", "two"},
              {{"statics", 0.0, 1e-4}, {"Newmark", 1e-4, 3e-4}}};
  s.cost = {0.11, 0.12, {{"setup", 0.02}, {"steps", 0.07}}, 12345678, 3, 40, 5000};
  s.ledger = {{"kinetic", 1.0 / 3.0}, {"strain", 2.5}};
  s.code_aster = {{"ENER_CIN", -1.0}, {"DISS_SCH", 4.5e-12}};
  s.linear_momentum = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 1e-13};
  s.angular_momentum = {{10, 20, 30}, {40, 50, 60}, {70, 80, 90}, 1e-12};
  s.checks = {{"B.displacement_z", "displacement_z", "B", 1e-4, 1.5, 1.25, 0.25, 0.1, ToleranceKind::absolute, true,
               "manual V5.03.100, table 3.2"}};
  s.verdict = {{"energy balance", 1e-12, 1e-10, true, "largest imbalance over the run"}};
  s.contacts = {"wall", "floor"};
  s.warnings = {"a warning", "another"};
  s.notes = {"a note"};
  s.outcome = Outcome::stopped;
  s.message = "stopped at t = 2.5e-4";
  return s;
}

TEST(Summary, EveryFieldComesBack) {
  const std::string path = scratch();
  const Summary a = sample();
  write_summary(path, a);
  const Summary b = read_summary(path);
  EXPECT_EQ(b.program.version, a.program.version);
  EXPECT_EQ(b.program.compiler, a.program.compiler);
  EXPECT_EQ(b.program.isa, a.program.isa);
  EXPECT_EQ(b.program.threads, a.program.threads);
  EXPECT_EQ(b.case_info.file, a.case_info.file);
  EXPECT_EQ(b.case_info.title, a.case_info.title);
  EXPECT_EQ(b.case_info.units, a.case_info.units);
  EXPECT_EQ(b.mesh.nodes, a.mesh.nodes);
  EXPECT_EQ(b.mesh.cells, a.mesh.cells);
  ASSERT_EQ(b.mesh.groups.size(), 2U);
  EXPECT_EQ(b.mesh.groups[1].name, "SYMX");
  EXPECT_EQ(b.mesh.groups[1].nodes, 44U);
  EXPECT_EQ(b.mesh.groups[1].cells, 20U);
  EXPECT_EQ(b.scheme.name, a.scheme.name);
  EXPECT_EQ(b.scheme.solver, a.scheme.solver);
  EXPECT_EQ(b.scheme.dt_smallest, a.scheme.dt_smallest);
  EXPECT_EQ(b.scheme.dt_largest, a.scheme.dt_largest);
  EXPECT_EQ(b.scheme.steps, a.scheme.steps);
  EXPECT_EQ(b.scheme.time_end, a.scheme.time_end);
  EXPECT_EQ(b.scheme.time_reached, a.scheme.time_reached);
  EXPECT_EQ(b.scheme.added_mass, a.scheme.added_mass);
  EXPECT_EQ(b.scheme.added_mass_share, a.scheme.added_mass_share);
  EXPECT_EQ(b.scheme.mass_notes, a.scheme.mass_notes);
  ASSERT_EQ(b.scheme.stages.size(), 2U);
  EXPECT_EQ(b.scheme.stages[1].name, "Newmark");
  EXPECT_EQ(b.scheme.stages[1].begin, 1e-4);
  EXPECT_EQ(b.scheme.stages[1].end, 3e-4);
  EXPECT_EQ(b.mesh.reach, a.mesh.reach);
  EXPECT_EQ(b.mesh.checksum, a.mesh.checksum);
  ASSERT_EQ(b.parts.size(), 1U);
  EXPECT_EQ(b.parts[0].name, "bar");
  EXPECT_EQ(b.parts[0].mass, 0.5);
  EXPECT_EQ(b.parts[0].velocity_begin, (Vec3{1, 2, 3}));
  EXPECT_EQ(b.parts[0].velocity_end, (Vec3{-1, -2, -3}));
  EXPECT_EQ(b.stress.value, 4e8);
  EXPECT_EQ(b.stress.time, 1e-4);
  EXPECT_EQ(b.stress.part, "bar");
  EXPECT_EQ(b.stress.cell, 17);
  EXPECT_EQ(b.stress.position, (Vec3{0.5, 0.25, 0.125}));
  EXPECT_EQ(b.stress.instants, 201);
  ASSERT_EQ(b.shock.size(), 1U);
  EXPECT_EQ(b.shock[0].probe, "B");
  EXPECT_EQ(b.shock[0].quantity, "acceleration");
  for (const auto& [name, member] : shock_numbers) EXPECT_EQ(b.shock[0].*member, a.shock[0].*member) << name;
  ASSERT_EQ(b.probes.size(), 1U);
  EXPECT_EQ(b.probes[0].name, "B");
  EXPECT_EQ(b.probes[0].place, "node 12");
  EXPECT_EQ(b.probes[0].position, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(b.contacts, a.contacts);
  EXPECT_EQ(b.warnings, a.warnings);
  EXPECT_EQ(b.notes, a.notes);
  EXPECT_EQ(b.outcome, a.outcome);
  EXPECT_EQ(b.message, a.message);
  fs::remove(path);
}

TEST(Summary, EveryNumberComesBack) {
  const std::string path = scratch();
  const Summary a = sample();
  write_summary(path, a);
  const Summary b = read_summary(path);
  EXPECT_EQ(b.cost.wall_seconds, a.cost.wall_seconds);
  EXPECT_EQ(b.cost.cpu_seconds, a.cost.cpu_seconds);
  ASSERT_EQ(b.cost.phases.size(), 2U);
  EXPECT_EQ(b.cost.phases[1].name, "steps");
  EXPECT_EQ(b.cost.phases[1].value, 0.07);
  EXPECT_EQ(b.cost.peak_memory_bytes, a.cost.peak_memory_bytes);
  EXPECT_EQ(b.cost.ranks, a.cost.ranks);
  EXPECT_EQ(b.cost.messages, a.cost.messages);
  EXPECT_EQ(b.cost.sent_bytes, a.cost.sent_bytes);
  ASSERT_EQ(b.ledger.size(), 2U);
  EXPECT_EQ(b.ledger[0].name, "kinetic");
  EXPECT_EQ(b.ledger[0].value, 1.0 / 3.0);
  ASSERT_EQ(b.code_aster.size(), 2U);
  EXPECT_EQ(b.code_aster[1].name, "DISS_SCH");
  EXPECT_EQ(b.linear_momentum.impulse, a.linear_momentum.impulse);
  EXPECT_EQ(b.linear_momentum.begin, a.linear_momentum.begin);
  EXPECT_EQ(b.linear_momentum.error, a.linear_momentum.error);
  EXPECT_EQ(b.angular_momentum.end, a.angular_momentum.end);
  ASSERT_EQ(b.checks.size(), 1U);
  EXPECT_EQ(b.checks[0].name, a.checks[0].name);
  EXPECT_EQ(b.checks[0].quantity, a.checks[0].quantity);
  EXPECT_EQ(b.checks[0].place, a.checks[0].place);
  EXPECT_EQ(b.checks[0].time, a.checks[0].time);
  EXPECT_EQ(b.checks[0].value, a.checks[0].value);
  EXPECT_EQ(b.checks[0].reference, a.checks[0].reference);
  EXPECT_EQ(b.checks[0].difference, a.checks[0].difference);
  EXPECT_EQ(b.checks[0].tolerance, a.checks[0].tolerance);
  EXPECT_EQ(b.checks[0].tolerance_kind, ToleranceKind::absolute);
  EXPECT_TRUE(b.checks[0].pass);
  EXPECT_EQ(b.checks[0].source, a.checks[0].source);
  ASSERT_EQ(b.verdict.size(), 1U);
  EXPECT_EQ(b.verdict[0].name, a.verdict[0].name);
  EXPECT_EQ(b.verdict[0].value, a.verdict[0].value);
  EXPECT_EQ(b.verdict[0].limit, a.verdict[0].limit);
  EXPECT_TRUE(b.verdict[0].pass);
  EXPECT_EQ(b.verdict[0].explanation, a.verdict[0].explanation);
  fs::remove(path);
}

TEST(Summary, NumbersThatAreNoneBecomeNull) {
  const std::string path = scratch();
  Summary a = sample();
  a.ledger = {{"kinetic", std::nan("")}, {"strain", std::numeric_limits<double>::infinity()}};
  write_summary(path, a);
  const Summary b = read_summary(path);
  EXPECT_TRUE(std::isnan(b.ledger.at(0).value));
  EXPECT_TRUE(std::isnan(b.ledger.at(1).value));
  fs::remove(path);
}

TEST(Summary, TextThatIsNotUtf8IsWritten) {
  const std::string path = scratch();
  Summary a = sample();
  a.case_info.title = "bar \xE9";  // Latin-1
  write_summary(path, a);
  EXPECT_EQ(read_summary(path).case_info.title, "bar \uFFFD");
  fs::remove(path);
}

TEST(Summary, DamagedFilesAreNamed) {
  const std::string path = scratch();
  EXPECT_THROW(read_summary(path), std::runtime_error);  // not there yet
  for (const char* text : {"", "{", "{}", "[1]", "{\"outcome\": \"splendid\", \"message\": \"\"}"}) {
    std::ofstream(path) << text;
    try {
      read_summary(path);
      FAIL() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find(path), 0U) << error.what();
    }
  }
  fs::remove(path);
}

TEST(Summary, UnwritablePathIsAnError) {
  EXPECT_THROW(write_summary("/proc/absent/summary.json", sample()), OutputError);
}

TEST(Units, CommentComesBack) {
  for (const char* label : {"SI", "mm-t-s", "mm-kg-ms"}) {
    const Units units = units_of(label);
    const auto parsed = parse_units_comment(units_comment(units));
    ASSERT_TRUE(parsed) << label;
    EXPECT_EQ(units_comment(*parsed), units_comment(units));
  }
  EXPECT_FALSE(parse_units_comment("filter: CFC 1000"));
  EXPECT_FALSE(parse_units_comment("units: m, s"));
}

TEST(Units, DerivedUnitsAreConsistent) {
  // force = mass length / time^2 with mm = 1e-3 m, t = 1e3 kg, ms = 1e-3 s: N in mm-t-s, kN in mm-kg-ms.
  EXPECT_EQ(units_comment(units_of("mm-t-s")), "units: mm, s, t, N, MPa, mJ");
  EXPECT_EQ(units_comment(units_of("mm-kg-ms")), "units: mm, ms, kg, kN, GPa, J");
}

TEST(Units, OfColumns) {
  const Units si = units_of("SI");
  EXPECT_EQ(unit_of_column(si, "time"), "s");
  EXPECT_EQ(unit_of_column(si, "B.displacement_z"), "m");
  EXPECT_EQ(unit_of_column(si, "B.acceleration_x"), "m/s²");
  EXPECT_EQ(unit_of_column(si, "B.stress_xz"), "Pa");
  EXPECT_EQ(unit_of_column(si, "S.section_force_z"), "N");
  EXPECT_EQ(unit_of_column(si, "wall.impulse_z"), "N s");
  EXPECT_EQ(unit_of_column(si, "a.b.velocity_y"), "m/s");
  EXPECT_EQ(unit_of_column(si, "contact_stored"), "J");
  EXPECT_EQ(unit_of_column(si, "TRAV_LIAI"), "J");
  EXPECT_EQ(unit_of_column(si, "momentum_x"), "kg m/s");
  EXPECT_EQ(unit_of_column(si, "angular_momentum_x"), "kg m²/s");
  EXPECT_EQ(unit_of_column(si, "momentum_error"), "kg m/s");
  EXPECT_EQ(unit_of_column(si, "wall.closed"), "");
  EXPECT_EQ(unit_of_column(units_of("unknown"), "B.velocity_z"), "");
  EXPECT_EQ(unit_of_column(si, "P.kinetic_energy"), "J");
  EXPECT_EQ(unit_of_column(si, "P.principal_stress_1"), "Pa");
  EXPECT_EQ(unit_of_column(si, "strain"), "J");  // of energy.csv
  EXPECT_EQ(unit_of_column(si, "P.strain_xx"), "");
  EXPECT_EQ(unit_of_field(si, "strain"), "");
  EXPECT_EQ(unit_of_field(si, "strain_rate"), "1/s");
}

}  // namespace
}  // namespace carom::output_summary_test
