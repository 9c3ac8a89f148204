// Resultants of contact between the parts of one surface, in whole runs.
#include <array>
#include <cmath>

#include "run_fixture.hpp"

namespace carom::run_contact_resultants_test {
namespace {

using test::TemporaryCase;

constexpr const char* materials = R"(
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
)";

/// Three unit cells in a row, 0.1 apart; the outer ones fly towards the middle one.
std::string three_cubes(const std::string& contacts) {
  std::string text = "units = \"SI\"\n";
  const std::array<std::string, 3> names{"a", "b", "c"};
  for (int i = 0; i < 3; ++i) {
    const std::string name = names[static_cast<std::size_t>(i)];
    text += "[[mesh.block]]\norigin = [" + std::to_string(1.1 * i) + ", 0.0, 0.0]\nsize = [1.0, 1.0, 1.0]\n" +
            "divisions = [1, 1, 1]\ngroups = { cells = \"" + name + "\", xmin = \"" + name + "_low\", xmax = \"" +
            name + "_high\" }\n";
  }
  text += materials;
  for (const std::string& name : names) {
    text += "[[part]]\nname = \"" + name + "\"\ncells = \"" + name + "\"\nmaterial = \"soft\"\n";
    text += "[[probe]]\nname = \"mean " + name + "\"\ngroup = \"" + name + "\"\nquantities = [\"velocity\"]\n";
  }
  return text + R"([[initial]]
part = "a"
velocity = [0.2, 0.0, 0.0]
[[initial]]
part = "c"
velocity = [-0.1, 0.0, 0.0]
[scheme]
kind = "central_differences"
[time]
end = 2.0
step = 0.05
[output]
fields = []
)" + contacts;
}

/// Each cube has one cell, so that its eight lumped masses are equal and its momentum is 1.5 times the mean velocity.
/// The impulses between the parts, summed for each, are its change of momentum: to the round-off of some hundred steps.
TEST(ContactResultants, OfAllGiveTheForceBetweenEachPairOfParts) {
  const TemporaryCase in(three_cubes("[[contact]]\nname = \"k\"\nkind = \"all\"\nstiffness = 4.0\n"));
  in.run();
  const auto contact = test::last_row(in.result("contact.csv"));
  const auto probes = test::read_csv(in.result("probes.csv"));
  const auto gained = [&](const char* name) {
    const std::vector<double>& v = probes.at(std::string("mean ") + name + ".velocity_x");
    return 1.5 * (v.back() - v.front());
  };
  const double b_on_a = contact.at("k.b_on_a.impulse_x"), c_on_b = contact.at("k.c_on_b.impulse_x");
  EXPECT_LT(b_on_a, -0.05);  // it was met
  EXPECT_LT(c_on_b, -0.05);
  EXPECT_NEAR(b_on_a, gained("a"), 1e-13);
  EXPECT_NEAR(c_on_b - b_on_a, gained("b"), 1e-13);
  EXPECT_NEAR(-c_on_b, gained("c"), 1e-13);
  EXPECT_EQ(contact.at("k.c_on_a.impulse_x"), 0.0);  // they never meet
  EXPECT_FALSE(contact.contains("k.force_x"));       // which would be the sum of both sides
  EXPECT_TRUE(contact.contains("k.penetration"));
}

// `all` is the pairs in two passes: a corner stands for a quarter of its three faces there, so for three times the
// stiffness.
TEST(ContactResultants, OfAllAreThoseOfThePair) {
  const TemporaryCase all(
      three_cubes("[[contact]]\nname = \"k\"\nkind = \"all\"\nmethod = \"two_pass\"\nstiffness = 4.0\n"));
  const TemporaryCase pairs(three_cubes(R"(
[[contact]]
name = "ab"
kind = "pair"
method = "two_pass"
group = "a_high"
master = "b_low"
stiffness = 12.0
moment_point = [0.0, 0.3, 0.0]
[[contact]]
name = "bc"
kind = "pair"
method = "two_pass"
group = "b_high"
master = "c_low"
stiffness = 12.0
)"));
  all.run();
  pairs.run();
  const std::string of_all = all.result("contact.csv"), of_pairs = pairs.result("contact.csv");
  const auto one = test::column(of_all, "k.b_on_a.force_x"), other = test::column(of_pairs, "ab.force_x");
  ASSERT_EQ(one.size(), other.size());
  double largest = 0.0;
  for (const double f : other) largest = std::max(largest, std::abs(f));
  EXPECT_GT(largest, 0.1);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], 1e-12 * largest);
}

/// Schemes of two sub-steps exert forces at the middle of a step, of which the rows of contact.csv say nothing: with
/// multipliers that come and go the trapezoidal rule over the ends missed up to 13 % of the impulse. The wall's impulse
/// is all that changes the momentum: to the round-off of a hundred steps.
TEST(ContactResultants, ImpulsesAreThoseThatTheSchemeExerts) {
  for (const char* scheme : {"kind = \"bathe\"\nenforcement = \"lagrange\"", "kind = \"bathe\"", "kind = \"noh_bathe\"",
                             "kind = \"noh_bathe\"\np = 0.6"}) {
    const TemporaryCase in(test::case_of_block(std::string(R"(
[[initial]]
part = "body"
velocity = [0.0, 0.0, -0.01]
[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, -0.001]
normal = [0.0, 0.0, 1.0]
[time]
end = 8.0
step = 0.08
[output]
fields = []
[scheme]
)") + scheme + "\n"));
    in.run();
    const auto impulse = test::column(in.result("contact.csv"), "wall.impulse_z");
    const auto momentum = test::column(in.result("energy.csv"), "momentum_z");
    ASSERT_EQ(impulse.size(), momentum.size());
    EXPECT_GT(impulse.back(), 0.2) << scheme;  // 12 m^3 of 1.5 kg/m^3 at 0.01 m/s: 0.18, and back
    for (std::size_t i = 0; i < impulse.size(); ++i)
      EXPECT_NEAR(impulse[i], momentum[i] - momentum[0], 1e-12) << scheme << ", row " << i;
  }
}

TEST(ContactResultants, ASurfaceOfOnePartHasNone) {
  const TemporaryCase in(test::case_of_block(R"(
[[contact]]
name = "k"
kind = "all"
stiffness = 1.0
[scheme]
kind = "central_differences"
[time]
end = 0.1
[output]
fields = []
)"));
  in.run();
  const auto columns = test::read_csv(in.result("contact.csv"));
  EXPECT_TRUE(columns.contains("k.penetration"));
  for (const auto& [name, values] : columns) EXPECT_EQ(name.find("force"), std::string::npos) << name;
}

TEST(ContactResultants, AChecksPlaceIsAPairOfParts) {
  const std::string contact = "[[contact]]\nname = \"k\"\nkind = \"all\"\nstiffness = 4.0\n";
  const std::string check =
      "[[check]]\nquantity = \"contact.impulse_x\"\nvalue = 0.0\ntolerance = 9.0\nabsolute = true\n";
  const TemporaryCase right(three_cubes(contact + check + "place = \"k.b_on_a\"\n"));
  right.run();
  EXPECT_NE(right.result("summary.json").find("k.b_on_a.impulse_x"), std::string::npos);
  const TemporaryCase wrong(three_cubes(contact + check + "place = \"k\"\n"));
  try {
    wrong.run();
    ADD_FAILURE() << "taken";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("\"k.b_on_a\" or \"k.c_on_a\" or \"k.c_on_b\""), std::string::npos)
        << e.what();
  }
}

/// Gmsh 2.2: A and B side by side on common nodes, C 0.1 above both.
constexpr const char* glued = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
3 1 "A"
3 2 "B"
3 3 "C"
$EndPhysicalNames
$Nodes
20
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 0 0 1
8 1 0 1
9 2 0 1
10 0 1 1
11 1 1 1
12 2 1 1
13 0 0 1.1
14 2 0 1.1
15 2 1 1.1
16 0 1 1.1
17 0 0 2.1
18 2 0 2.1
19 2 1 2.1
20 0 1 2.1
$EndNodes
$Elements
3
1 5 2 1 1 1 2 5 4 7 8 11 10
2 5 2 2 2 2 3 6 5 8 9 12 11
3 5 2 3 3 13 14 15 16 17 18 19 20
$EndElements
)";

// Nodes on the seam belong to two parts; what is counted to the one is not counted to the other. By symmetry both carry
// half, but for the seam's share.
TEST(ContactResultants, CountsNodesOfTwoPartsOnce) {
  std::string text = "units = \"SI\"\n[mesh]\nfile = \"glued.msh\"\n";
  text += materials;
  for (const char* name : {"A", "B", "C"})
    text += "[[part]]\nname = \"" + std::string(name) + "\"\ncells = \"" + name + "\"\nmaterial = \"soft\"\n";
  const TemporaryCase in(text + R"(
[[probe]]
name = "mean C"
group = "C"
quantities = ["velocity"]
[[initial]]
part = "C"
velocity = [0.0, 0.0, -0.2]
[[contact]]
name = "k"
kind = "all"
stiffness = 4.0
[scheme]
kind = "central_differences"
[time]
end = 2.0
step = 0.05
[output]
fields = []
)");
  std::ofstream(in.results().parent_path() / "glued.msh") << glued;
  in.run();
  const auto contact = test::last_row(in.result("contact.csv"));
  const auto v = test::column(in.result("probes.csv"), "mean C.velocity_z");
  const double on_a = contact.at("k.C_on_A.impulse_z"), on_b = contact.at("k.C_on_B.impulse_z");
  EXPECT_LT(on_a, 0.0);
  EXPECT_LT(on_b, 0.0);
  EXPECT_NEAR(on_a + on_b, -2.0 * 1.5 * (v.back() - v.front()), 1e-13);
}

}  // namespace
}  // namespace carom::run_contact_resultants_test
