// The impact bar as a column of solids, as a strip of plane cells and as a chain of bars: one and the same discrete
// system with nu = 0 and guided sides, hence the same curves.
#include <gtest/gtest.h>

#include <cmath>

#include "run_fixture.hpp"

namespace carom::run_impact_bar_test {
namespace {

using namespace test;

struct Curves {
  Columns energy, contact, probes;
};

Curves run(const std::string& file) {
  const TemporaryCase one(read_text(std::string(CAROM_SOURCE_DIR) + "/cases/impact_bar/" + file));
  EXPECT_EQ(one.run(), ExitCode::good) << file;
  return {read_csv(one.result("energy.csv")), read_csv(one.result("contact.csv")), read_csv(one.result("probes.csv"))};
}

/// Largest difference over the curve, relative to the largest value of the reference.
double difference(const std::vector<double>& a, const std::vector<double>& reference) {
  EXPECT_EQ(a.size(), reference.size());
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), reference.size()); ++i) {
    worst = std::max(worst, std::abs(a[i] - reference[i]));
    largest = std::max(largest, std::abs(reference[i]));
  }
  EXPECT_GT(largest, 0.0);
  return worst / largest;
}

void expect_same(const Curves& found, char axis, const Curves& solid) {
  constexpr double tolerance = 1e-8;  // 1000 steps of round-off stay far below, a wrong share of a mass far above
  const auto along = [&](const std::string& name) { return name + axis; };
  for (const char* probe : {"A", "B"})
    for (const std::string quantity : {".displacement_", ".velocity_"})
      EXPECT_LE(difference(found.probes.at(along(probe + quantity)), solid.probes.at(probe + quantity + 'z')),
                tolerance)
          << probe << quantity;
  for (const std::string quantity : {"wall.force_", "wall.impulse_"})
    EXPECT_LE(difference(found.contact.at(along(quantity)), solid.contact.at(quantity + 'z')), tolerance) << quantity;
  EXPECT_LE(difference(found.contact.at("wall.penetration"), solid.contact.at("wall.penetration")), tolerance);
  for (const char* term : {"kinetic", "strain", "contact_stored"})
    EXPECT_LE(difference(found.energy.at(term), solid.energy.at(term)), tolerance) << term;
}

TEST(ImpactBar, IsTheSameAsColumnAsStripAndAsBars) {
  const Curves solid = run("central_differences.toml");
  EXPECT_EQ(solid.probes.at("time").size(), 1001U);
  expect_same(run("plane_strip.toml"), 'y', solid);
  expect_same(run("bars.toml"), 'z', solid);
}

}  // namespace
}  // namespace carom::run_impact_bar_test
