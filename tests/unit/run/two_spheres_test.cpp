// Two spheres that are mirror images press on each other as one of them presses on a rigid plane.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "run_fixture.hpp"

namespace carom::run_two_spheres_test {
namespace {

using namespace test;

struct Result {
  double force, stress;
};

/// The case with its mesh found from elsewhere; `contact` is added to its section of the contact.
Result run(const std::string& name, const std::string& mesh, const std::string& enforcement,
           const std::string& contact) {
  const std::string folder = std::string(CAROM_SOURCE_DIR) + "/cases/hertz/";
  std::string text = replaced(read_text(folder + name + ".toml"), mesh, folder + mesh);
  text = replaced(text, "enforcement = \"lagrange\"", "enforcement = \"" + enforcement + "\"");
  text = replaced(text, "\n[scheme]", contact + "\n[scheme]");
  if (enforcement == "penalty") text = text.substr(0, text.find("[[check]]"));  // the checks are those of exact contact
  const TemporaryCase one(text);
  EXPECT_EQ(one.run(), ExitCode::good) << name;
  return {last_row(one.result("contact.csv")).at("contact.force_y"),
          last_row(one.result("probes.csv")).at("pole.stress_yy")};
}

TEST(TwoSpheres, AreOneOnAWall) {
  const Result two = run("two_spheres", "two_half_8.msh", "lagrange", "");
  const Result wall = run("two_spheres_wall", "half_8.msh", "lagrange", "");
  EXPECT_NEAR(two.force, wall.force, 1e-8 * wall.force);
  EXPECT_NEAR(two.stress, wall.stress, 1e-8 * std::abs(wall.stress));
}

// Springs in series: half the stiffness between two bodies, as facets, which is how a wall sees them. A node that has
// penetrated stands on a facet that is turned against the axis, by which the two forces differ: in proportion to the
// penetration, 2e-7 at 2e16 and here a hundred times less.
TEST(TwoSpheres, HaveSpringsInSeries) {
  const Result two = run("two_spheres", "two_half_8.msh", "penalty", "stiffness = 1e18\nsmooth = false\n");
  const Result wall = run("two_spheres_wall", "half_8.msh", "penalty", "stiffness = 2e18\n");
  EXPECT_NEAR(two.force, wall.force, 1e-8 * wall.force);
  EXPECT_NEAR(two.stress, wall.stress, 1e-8 * std::abs(wall.stress));
}

}  // namespace
}  // namespace carom::run_two_spheres_test
