// Rows of nodes that follow rigid bodies.
#include "contact/embedded_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/vec3.hpp"
#include "model/turning_body.hpp"

namespace carom::contact_embedded_rows_test {
namespace {

// A row between a free node and a follower: what it does to the bodies, as a whole and about the origin, is what it did
// to the follower; the gap is the same at any motion of the body. Rows of one body with itself are gone.
TEST(EmbeddedRows, HaveTheForcesAndGapsOfTheirFollowers) {
  TurningBody body = make_turning_body(2.0, {0.1, 0.2, 0.3}, {1.0, 1.2, 1.5}, {0.1, 0.05, 0.02});
  std::vector<Vec3> X{{1.0, 0.0, 0.0}, {0.5, 0.6, 0.1}, {-0.4, 0.3, 0.9}};
  for (std::size_t a = 0; a < 4; ++a) {
    body.nodes[a] = static_cast<Index>(X.size());
    X.push_back(corner(body, a));
  }
  Embedding embedding;
  embedding.add(0, body, std::vector<Index>{1, 2}, X);
  ConstraintRows rows;
  const RowLaw law;
  const Vec3 n = normalized({0.3, -0.5, 0.8});
  rows.add_row(0.25, n, X[0], 1.0, law, 0);
  rows.add_node(0, 1.0);
  rows.add_node(1, -0.75);
  rows.add_node(2, -0.25);
  rows.behind.back() = 2;
  rows.add_row(0.5, n, X[0], 1.0, law, 0);
  rows.add_node(1, 1.0);
  rows.add_node(2, -1.0);
  rows.behind.back() = 1;
  rows.add_row(0.75, n, X[0], 2.0, law, 1);
  rows.add_node(2, 1.0);  // against an obstacle, which has no nodes
  std::vector<double> u(3 * X.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::sin(1.0 + 3.0 * static_cast<double>(i));
  embedding.spread(u);
  const double gap_0 = rows.gap_at(0, u), gap_2 = rows.gap_at(2, u);
  std::vector<double> f(u.size(), 0.0), g(u.size(), 0.0);
  const Vec3 s{2.0, 0.3, -0.4};
  rows.scatter(0, s, f);
  rows.scatter(2, s, f);
  embed(embedding, rows);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows.measure[1], 2.0);
  EXPECT_EQ(rows.slot[1], 2);
  EXPECT_EQ(rows.behind[0], 4);
  EXPECT_EQ(rows.behind[1], 0);
  EXPECT_NEAR(rows.gap_at(0, u), gap_0, 1e-14);
  EXPECT_NEAR(rows.gap_at(1, u), gap_2, 1e-14);
  rows.scatter(0, s, g);
  rows.scatter(1, s, g);
  Vec3 force{}, moment{};
  for (std::size_t k = 0; k < X.size(); ++k) {
    const Vec3 x = add(X[k], vector_at(u, k)), change = subtract(vector_at(g, k), vector_at(f, k));
    force = add(force, change);
    moment = add(moment, cross(x, change));
  }
  EXPECT_LE(norm(force), 1e-14);
  EXPECT_LE(norm(moment), 1e-13);
  EXPECT_EQ(vector_at(g, 1), (Vec3{}));
}

}  // namespace
}  // namespace carom::contact_embedded_rows_test
