#include "report_sample.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "output/csv.hpp"
#include "output/results_folder.hpp"
#include "output/summary.hpp"
#include "output/units.hpp"

namespace carom {

namespace {

// A bar of steel that hits a rigid wall at 100 m/s with a gap of 2 mm: wave speed, impedance and times of the textbook
// solution (contact lasts two wave transits).
constexpr double kLength = 0.02, kArea = 1e-4, kModulus = 2e11, kDensity = 8000.0, kSpeed = 100.0, kGap = 2e-3;
const double kWaveSpeed = std::sqrt(kModulus / kDensity);
const double kTouch = kGap / kSpeed;
const double kRelease = kTouch + 2.0 * kLength / kWaveSpeed;
constexpr double kEnd = 5e-5;

double wall_force(double t) {
  return t > kTouch && t < kRelease ? kDensity * kWaveSpeed * kSpeed * kArea : 0.0;
}

double face_displacement(double t) {
  if (t < kTouch) return kGap - kSpeed * t;
  return t < kRelease ? 0.0 : kSpeed * (t - kRelease);
}

double face_velocity(double t) {
  if (t < kTouch) return -kSpeed;
  return t < kRelease ? 0.0 : kSpeed;
}

/// Oscillation of a numerical solution behind a jump.
double ringing(double t, double jump) {
  return t < jump ? 0.0 : 0.25 * std::exp(-(t - jump) / 2e-6) * std::cos(2.0 * std::numbers::pi * (t - jump) / 6e-7);
}

double kinetic(double t) {
  const double all = 0.5 * kDensity * kLength * kArea * kSpeed * kSpeed;
  if (t <= kTouch || t >= kRelease) return all;
  return all * std::abs(1.0 - (t - kTouch) * kWaveSpeed / kLength);
}

void write_tables(const std::filesystem::path& folder, int rows) {
  const std::vector<std::string> units{units_comment(units_of("SI"))};
  CsvFile energy((folder / "energy.csv").string(),
                 {"time",           "step",      "dt",         "iterations",    "kinetic",      "strain",
                  "contact_stored", "friction",  "damping",    "external_work", "support_work", "algorithmic",
                  "quadrature",     "imbalance", "ENER_CIN",   "ENER_TOT",      "TRAV_EXT",     "TRAV_AMOR",
                  "TRAV_LIAI",      "DISS_SCH",  "momentum_z", "momentum_error"},
                 units);
  const std::vector<std::string> places{"time", "B.displacement_x", "B.displacement_z", "B.velocity_z", "B.stress_zz"};
  CsvFile probes((folder / "probes.csv").string(), places, {units[0], "B: node 1, CFC 1000 on stress"});
  CsvFile contact((folder / "contact.csv").string(),
                  {"time", "wall.force_x", "wall.force_z", "wall.impulse_z", "wall.penetration", "wall.closed"}, units);
  CsvFile exact((folder / "exact.csv").string(), {"time", "B.displacement_z", "B.velocity_z", "wall.force_z"}, units);
  const double all = kinetic(0.0);
  double impulse = 0.0;
  for (int i = 0; i < rows; ++i) {
    const double t = kEnd * i / (rows - 1);
    const double noise = ringing(t, kTouch) + ringing(t, kRelease);
    const double force = wall_force(t) * (1.0 + noise);
    impulse += force * kEnd / (rows - 1);
    energy.append(std::vector<double>{t,
                                      double(i),
                                      kEnd / (rows - 1),
                                      12.0 + i % 5,
                                      kinetic(t),
                                      all - kinetic(t),
                                      0.0,
                                      0.0,
                                      0.0,
                                      0.0,
                                      0.0,
                                      1e-13 * all * std::sin(1e6 * t),
                                      1e-4 * all * noise,
                                      1e-14 * all * std::cos(3e6 * t),
                                      kinetic(t) - all,
                                      all - kinetic(t),
                                      0.0,
                                      0.0,
                                      1e-4 * all * noise,
                                      1e-13 * all,
                                      kDensity * kLength * kArea * face_velocity(t),
                                      1e-14});
    probes.append(
        std::vector<double>{t, 1e-19 * i, face_displacement(t), face_velocity(t) + kSpeed * noise, -force / kArea});
    contact.append(std::vector<double>{t, 0.0, force, impulse, force / 1e13, force > 0.0 ? 1.0 : 0.0});
    exact.append(std::vector<double>{t, face_displacement(t), face_velocity(t), wall_force(t)});
  }
  energy.close();
  probes.close();
  contact.close();
  exact.close();
}

Summary sample_summary(int rows) {
  Summary s;
  s.program = {"0.1.0", "GCC 12.2.0", "v3", 2};
  s.case_info = {"cases/bar/case.toml", kHostileTitle, "SI"};
  s.mesh = {88, 21, {{"ENCASTR", 4, 1}, {"SYMX", 44, 20}, {"BAR", 84, 20}}, 0.022};
  s.parts = {{"bar", kDensity * kLength * kArea, {0, 0, -kSpeed}, {0, 0, 0.98 * kSpeed}}};
  s.stress = {4.1e8, 2.2e-5, "bar", 7, {0.005, 1e-19, 0.001}, 201};
  s.probes = {{"B", "node 1", {0.0, 0.0, 0.02}}};
  s.scheme = {"Newmark beta 0.25 gamma 0.5", "CHOLMOD", kEnd / (rows - 1), kEnd / (rows - 1), rows - 1, kEnd, kEnd};
  s.scheme.stages = {{"statics", 0.0, 1e-5}, {"Newmark beta 0.25 gamma 0.5", 1e-5, kEnd}};
  s.cost = {0.0834, 0.151, {{"setup", 0.012}, {"steps", 0.061}, {"output", 0.01}}, 23500000};
  s.ledger = {{"kinetic", 80.0},    {"strain", 1.3e-9},     {"contact_stored", 0.0}, {"friction", 0.0},
              {"damping", 0.0},     {"external_work", 0.0}, {"support_work", 0.0},   {"algorithmic", -2.1e-12},
              {"quadrature", 2e-3}, {"imbalance", 3.1e-13}};
  s.code_aster = {{"ENER_CIN", -1.3e-9}, {"ENER_TOT", 1.3e-9},  {"TRAV_EXT", 0.0},
                  {"TRAV_AMOR", 0.0},    {"TRAV_LIAI", 2.0e-3}, {"DISS_SCH", -2.1e-12}};
  s.linear_momentum = {{0, 0, -1.6}, {0, 0, 1.6}, {0, 0, 3.2}, 3.4e-14};
  s.angular_momentum = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 1.2e-15};
  s.checks = {{"B.displacement_z", "displacement_z", "B", 2.4e-5, 1.234567891e-4, 1.234567e-4, 8.91e-11, 1e-6,
               ToleranceKind::relative, true, "independent 1-D computation"},
              {"B.velocity_z", "velocity_z", "B", 4e-5, 101.2, 100.0, 1.2, 1e-3, ToleranceKind::relative, false,
               "exact solution of the bar"},
              {"energy.ENER_CIN", "ENER_CIN", "", 5e-5, -1.3e-9, 0.0, -1.3e-9, 1e-6, ToleranceKind::absolute, true,
               "no energy is lost"}};
  s.verdict = {
      {"energy balance", 3.9e-15, 1e-10, true, "largest imbalance over the run, relative to the initial energy"},
      {"quadrature", 1.0e-4, 1e-2, true, "largest work of contact that no stored energy explains"},
      {"momentum balance", 3.4e-14, 1e-8, true, "largest difference between momentum and impulse"},
      {"checks", 1, 0, false, "number of checks that did not pass"}};
  s.outcome = Outcome::failed;
  s.message = "1 of 3 checks did not pass: B.velocity_z at t = 4e-05.";
  return s;
}

}  // namespace

void write_sample_results(const std::filesystem::path& folder, int rows) {
  prepare_results_folder(folder.string());
  write_tables(folder, rows);
  write_summary((folder / "summary.json").string(), sample_summary(rows));
  std::ofstream(folder / "case.resolved.toml") << "title = '''" << kHostileTitle << "'''\nunits = \"SI\"\n\n[mesh]\n"
                                               << "file = \"bar.msh\"\n\n[materials.steel]\nE = 2e11\nnu = 0.0\n";
}

}  // namespace carom
