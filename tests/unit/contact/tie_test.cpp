// Bonds: the rows of ties, what they see of motions, what they refuse, and their forces in the solvers.
#include <gtest/gtest.h>

#include <stdexcept>

#include "contact/stiffness.hpp"
#include "model/wave_modulus.hpp"
#include "rows/admissible.hpp"
#include "rows/cone_solver.hpp"
#include "tie_fixture.hpp"

namespace carom::contact_tie_test {
namespace {

using namespace test;

TieContact& tie_of(Model& model) {
  return std::get<TieContact>(model.contacts.front());
}

/// u of the affine motion A X + b.
std::vector<double> affine(const Mesh& mesh, const std::array<Vec3, 3>& A, const Vec3& b) {
  std::vector<double> u;
  for (const Vec3& X : mesh.coordinates)
    for (std::size_t c = 0; c < 3; ++c) u.push_back(dot(A[c], X) + b[c]);
  return u;
}

constexpr std::array<Vec3, 3> any_gradient{{{0.7, -2.0, 0.3}, {1.1, 0.4, -0.9}, {-0.2, 0.8, 1.7}}};
constexpr double round_off = 1e-14;  // some ten terms below 10

std::string refusal(const Model& model) {
  try {
    const ContactGeometry contact(model);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(TieRows, SeeNothingOfAffineMotions) {
  // 0.04 is 4 % of the master's facets, of size 1.
  for (const double gap : {0.0, 1e-7, 0.04, -0.04}) {
    const Model model = tied_blocks(gap);
    const ContactGeometry contact(model);
    ASSERT_EQ(contact.bonds().size(), 16U);
    EXPECT_TRUE(contact.is_fixed());
    EXPECT_LT(parting(contact, affine(*model.mesh, any_gradient, {3.0, -1.0, 2.0})), 10 * round_off) << gap;
    // and of others they do
    EXPECT_GT(parting(contact, random_vector(3 * model.mesh->node_count(), 3)), 0.1);
  }
}

TEST(TieRows, FromFacetsAloneWhereTheSurfacesMeet) {
  const Model model = tied_blocks();
  const ContactGeometry contact(model);
  const ConstraintRows& bonds = contact.bonds();
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    EXPECT_EQ(bonds.begin[r + 1] - bonds.begin[r], 5);  // the node and those of one facet
    EXPECT_NEAR(bonds.normal[r][0], 1.0, round_off);    // outward of the master
    EXPECT_EQ(bonds.gap[r], 0.0);
  }
  double area = 0.0;
  for (const double measure : bonds.measure) area += measure;
  EXPECT_NEAR(area, 4.0, 1e-12);
}

TEST(TieRows, OfMeansSeeNothingOfAffineMotions) {
  for (const double gap : {0.0, 1e-7, 0.04, -0.04}) {
    Model model = tied_blocks(gap);
    tie_of(model).method = TieMethod::surface_to_surface;
    const ContactGeometry contact(model);
    ASSERT_EQ(contact.bonds().size(), 16U);
    EXPECT_LT(parting(contact, affine(*model.mesh, any_gradient, {3.0, -1.0, 2.0})), 10 * round_off) << gap;
    EXPECT_GT(parting(contact, random_vector(3 * model.mesh->node_count(), 3)), 0.1);
  }
}

TEST(TieRows, TakeADistanceInThePlaceOfATolerance) {
  Model model = tied_blocks(0.3);
  tie_of(model).distance = 0.29;
  EXPECT_NE(refusal(model).find("16 of 16 slave nodes are farther from the master than 0.29,"), std::string::npos);
  tie_of(model).distance = 0.31;
  EXPECT_EQ(ContactGeometry(model).bonds().size(), 16U);
}

// What a force of a row does has no resultant and no moment, wherever the node stands off its facet.
TEST(TieRows, ForcesBalance) {
  const Model model = tied_blocks(0.04);
  const ContactGeometry contact(model);
  const ConstraintRows& bonds = contact.bonds();
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    Vec3 sum{}, moment{};
    bonds.for_each_share(r, {1.0, -2.0, 0.5}, [&](Index n, const Vec3& share) {
      sum = add(sum, share);
      moment = add(moment, cross(model.mesh->coordinates[static_cast<std::size_t>(n)], share));
    });
    EXPECT_LT(norm(sum), round_off);
    EXPECT_LT(norm(moment), 10 * round_off);
  }
}

TEST(TieRows, RefuseNodesThatAreFarAway) {
  const std::string message = refusal(tied_blocks(0.06));
  EXPECT_NE(message.find("contact \"glue\": 16 of 16 slave nodes are farther from the master than 0.05 facet sizes"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("by 0.06"), std::string::npos) << message;
  EXPECT_EQ(refusal(tied_blocks(0.04)), "");
}

/// The slave stands 1 over to the side: 4 of its rows of 4 nodes are at y = 1, 5/3, 7/3 and 3, of which 2 are off.
Model half_off() {
  Model model = tied_blocks();
  Mesh mesh = *model.mesh;
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    if (n >= 27) mesh.coordinates[n][1] += 1.0;  // the second block
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  return model;
}

TEST(TieRows, LeaveNodesThatAreFarAwayIfAsked) {
  Model model = half_off();
  EXPECT_NE(refusal(model).find("8 of 16 slave nodes"), std::string::npos);
  tie_of(model).far = FarNodes::leave;
  const ContactGeometry contact(model);
  EXPECT_EQ(contact.bonds().size(), 8U);
  ASSERT_EQ(contact.notes().size(), 1U);
  EXPECT_NE(contact.notes()[0].find("8 nodes tied; left free: 8 of 16"), std::string::npos) << contact.notes()[0];
  Model none = tied_blocks(0.5);
  tie_of(none).far = FarNodes::leave;
  EXPECT_NE(refusal(none).find("16 of 16"), std::string::npos);  // a tie that ties nothing
}

TEST(TieRows, AreNoPenetrations) {
  const Model model = tied_blocks(-0.04);
  const ContactGeometry contact(model);
  const std::vector<double> u = random_vector(3 * model.mesh->node_count(), 3);
  EXPECT_TRUE(contact.initial_penetrations(u).empty());
}

// 1000 times what a pair would have: M = 1.25 of E = 1 and nu = 0.25 over cells of 1 and of 2/3: see stiffness.hpp.
TEST(TieStiffness, IsAThousandTimesThatOfPairs) {
  Model model = tied_blocks(0.0, 2, 0.0);
  tie_of(model).law.eps_N.reset();
  EXPECT_TRUE(choose_stiffness(model).empty());
  EXPECT_FALSE(tie_of(model).law.eps_N.has_value());
  EXPECT_EQ(choose_tie_stiffness(model).size(), 1U);
  const double M = wave_modulus(model.parts[0]);
  EXPECT_NEAR(*tie_of(model).law.eps_N, 1000.0 * M, 1e-9 * 1000.0 * M);
}

TEST(Admissible, ConesAndBonds) {
  const Admissible line{AdmissibleSet::cone, 0.0}, cone{AdmissibleSet::cone, 0.5}, bond{AdmissibleSet::bond, 0.0};
  EXPECT_EQ(line.components(), 1U);
  EXPECT_EQ(cone.components(), 3U);
  EXPECT_EQ(bond.components(), 3U);
  EXPECT_TRUE(cone.opens());
  EXPECT_FALSE(bond.opens());
  EXPECT_LT(norm(subtract(cone.project({2.0, 3.0, 4.0}), {2.0, 0.6, 0.8})), 1e-15);
  EXPECT_EQ(cone.project({-2.0, 3.0, 4.0}), (Vec3{0.0, 0.0, 0.0}));
  EXPECT_EQ(bond.project({-2.0, 3.0, 4.0}), (Vec3{-2.0, 3.0, 4.0}));
  EXPECT_EQ(bond.status({0.0, 0.0, 0.0}), RowStatus::stick);
  EXPECT_EQ(cone.status({0.0, 0.0, 0.0}), RowStatus::open);
  EXPECT_EQ(cone.status({1.0, 0.5, 0.0}), RowStatus::slip);
  EXPECT_FALSE(cone.violates({1.0, 9.0, 9.0}, 0.1));
  EXPECT_TRUE(cone.violates({-1.0, 0.0, 0.0}, 0.1));
  EXPECT_TRUE(bond.violates({0.0, 0.0, 0.2}, 0.1));
  EXPECT_FALSE(bond.violates({0.05, 0.0, -0.05}, 0.1));
}

/// W = C C^T + 1/10, as blocks.
Delassus random_delassus(std::size_t n, unsigned seed) {
  const std::size_t m = 3 * n;
  const std::vector<double> C = random_vector(m * m, seed);
  Delassus W;
  W.begin.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    W.rows.push_back(i);
    for (std::size_t j = 0; j < n; ++j) {
      FrameBlock& block = W.block.emplace_back();
      W.column.push_back(j);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t c = 0; c < 3; ++c) {
          for (std::size_t k = 0; k < m; ++k) block[3 * a + c] += C[(3 * i + a) * m + k] * C[(3 * j + c) * m + k];
          if (i == j && a == c) block[3 * a + c] += 0.1;
        }
    }
    W.begin.push_back(W.column.size());
  }
  return W;
}

// The conditions themselves: bonds do not move, cones are complementary.
TEST(SolveCone, BondsBesideCones) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const std::size_t n = 6;
    const Delassus W = random_delassus(n, seed);
    const std::vector<double> given = random_vector(3 * n, 100 + seed);
    std::vector<Vec3> b(n), r, w(n);
    std::vector<Admissible> sets;
    for (std::size_t i = 0; i < n; ++i) {
      b[i] = {given[3 * i], given[3 * i + 1], given[3 * i + 2]};
      sets.push_back(i % 2 == 0 ? Admissible{AdmissibleSet::bond, 0.0}
                                : Admissible{AdmissibleSet::cone, i == 1 ? 0.0 : 0.3});
    }
    const ConeResult result = solve_cone(W, b, sets, r);
    ASSERT_TRUE(result.converged) << result.error;
    W.apply(r, w);
    for (std::size_t i = 0; i < n; ++i) {
      w[i] = add(w[i], b[i]);
      if (sets[i].is_bond()) {
        EXPECT_LT(norm(w[i]), 1e-10);
        continue;
      }
      // The error counts against the largest motion that a force makes, some ten.
      EXPECT_GT(w[i][0], -1e-10);
      EXPECT_GE(r[i][0], 0.0);
      EXPECT_LT(std::abs(w[i][0] * r[i][0]), 1e-9);
      EXPECT_LE(std::hypot(r[i][1], r[i][2]), sets[i].mu * r[i][0] * (1.0 + 1e-9) + 1e-12);
    }
  }
}

// Two bonds that say the same have many answers, one motion; a component that nothing moves has no force.
TEST(SolveCone, BondsThatAreRedundantOrHeld) {
  Delassus W;
  W.rows = {0, 1};
  W.begin = {0, 2, 4};
  W.column = {0, 1, 0, 1};
  W.block.assign(4, FrameBlock{2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0});
  const std::vector<Vec3> b(2, Vec3{1.0, -3.0, 0.0});
  const std::vector<Admissible> sets(2, {AdmissibleSet::bond, 0.0});
  std::vector<Vec3> r, w(2);
  ASSERT_TRUE(solve_cone(W, b, sets, r).converged);
  W.apply(r, w);
  EXPECT_NEAR(w[0][0], -1.0, 1e-11);
  EXPECT_NEAR(w[1][1], 3.0, 1e-11);
  EXPECT_EQ(r[0][2], 0.0);
}

}  // namespace
}  // namespace carom::contact_tie_test
