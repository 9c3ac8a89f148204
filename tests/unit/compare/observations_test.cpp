// What a comparison says of numbers that do not explain themselves.
#include "compare/observations.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace carom::compare::compare_observations_test {
namespace {

/// A run whose force is constant over three rows, with an error of it.
Result run(const std::string& enforcement, int cells, double force, double error) {
  Result r;
  r.variant.choice.enforcement = r.variant.varied.enforcement = r.variant.enforcement = enforcement;
  r.variant.choice.cells = r.variant.varied.cells = r.variant.cells = cells;
  r.variant.scheme = "newmark";
  r.variant.label = label_of(r.variant.varied);
  r.summary.emplace();
  r.summary->scheme.dt_largest = 1.0;
  r.curves.columns = {"time", "wall.force_z", "wall.penetration"};
  r.curves.values = {{0.0, 1.0, 2.0}, {force, force, force}, {0.0, 0.0, 0.0}};
  r.peak_force = force;
  r.quantities = {{"force", error, error}};
  r.is_judged = true;
  return r;
}

std::vector<std::string> texts(const std::vector<Remark>& remarks) {
  std::vector<std::string> all;
  for (const Remark& r : remarks) all.push_back(r.variants + ": " + r.text);
  return all;
}

TEST(CompareObservations, SayWhyTwoRunsAreEqual) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts(equal_runs({run("penalty", 10, 1.0, 0.1), run("lagrange", 10, 1.1, 0.1)}, "force")), Texts{});
  const Texts touching =
      texts(equal_runs({run("penalty", 10, 1.0, 0.1), run("lagrange", 10, 1.0 + 1e-9, 0.1)}, "force"));
  EXPECT_EQ(touching, (Texts{"penalty, 10 cells; lagrange, 10 cells: are equal throughout: they have the same mesh and "
                             "the same step, and the enforcement changes nothing here"}));
  const Texts apart = texts(equal_runs({run("penalty", 10, 0.0, 0.1), run("lagrange", 10, 0.0, 0.1)}, "force"));
  ASSERT_EQ(apart.size(), 1U);
  EXPECT_TRUE(apart[0].ends_with("the enforcement changes nothing here, since nothing touches")) << apart[0];
  Result failed = run("lagrange", 10, 1.0, 0.1);
  failed.failure = "not allowed";
  EXPECT_EQ(texts(equal_runs({run("penalty", 10, 1.0, 0.1), failed}, "force")), Texts{});
}

// Errors c h^p by hand: orders 1 and 1, then 1 and log2(0.05 / 0.045) = 0.15, then one that grows.
TEST(CompareObservations, SayWhereRefinementDoesNotHelp) {
  const auto of_three = [](double finest) {
    return texts(worsening_orders(
        {run("penalty", 10, 1.0, 0.1), run("penalty", 20, 1.0, 0.05), run("penalty", 40, 1.0, finest)}, "force"));
  };
  EXPECT_TRUE(of_three(0.025).empty());
  EXPECT_TRUE(of_three(0.03).empty());  // order 0.74 at last: still more than half of that at first
  const std::vector<std::string> falls = of_three(0.045), grows = of_three(0.06);
  ASSERT_EQ(falls.size(), 1U);
  EXPECT_NE(falls[0].find("the order of the error of the force falls from 1 (cells 10 to 20) to 0.15"),
            std::string::npos)
      << falls[0];
  ASSERT_EQ(grows.size(), 1U);
  EXPECT_NE(grows[0].find("the error of the force grows from cells 20 to 40, from 5 % to 6 %"), std::string::npos)
      << grows[0];
}

}  // namespace
}  // namespace carom::compare::compare_observations_test
