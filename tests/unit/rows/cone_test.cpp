// The complementarity solver against closed forms, brute force and its own conditions.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "linalg/dense.hpp"
#include "rows/cone_solver.hpp"

namespace carom::contact_cone_test {
namespace {

/// A problem with its W also as a dense matrix of 3 n x 3 n numbers.
struct ConeProblem {
  Delassus W;
  std::vector<double> dense;
  std::vector<Vec3> b;
  std::vector<double> mu;

  std::size_t size() const { return b.size(); }
  double at(std::size_t i, std::size_t a, std::size_t j, std::size_t c) const {
    return dense[(3 * i + a) * 3 * size() + 3 * j + c];
  }
};

ConeProblem make_problem(std::vector<double> dense, std::vector<Vec3> b, std::vector<double> mu) {
  ConeProblem p{{}, std::move(dense), std::move(b), std::move(mu)};
  const std::size_t n = p.size();
  p.W.begin.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    p.W.rows.push_back(i);
    for (std::size_t j = 0; j < n; ++j) {
      FrameBlock block{};
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t c = 0; c < 3; ++c) block[3 * a + c] = p.at(i, a, j, c);
      }
      p.W.column.push_back(j);
      p.W.block.push_back(block);
    }
    p.W.begin.push_back(p.W.column.size());
  }
  return p;
}

/// W = C C^T with 3 n rows and `rank` columns of normal numbers, plus `regular` on the diagonal; b is normal, W of the
/// row i being scaled by spread^(+-1).
ConeProblem random_problem(std::size_t n, std::size_t rank, double regular, double mu, unsigned seed,
                           double spread = 1.0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const std::size_t m = 3 * n;
  std::vector<double> C(m * rank), W(m * m, 0.0);
  for (double& c : C) c = normal(generator);
  for (std::size_t i = 0; i < m; ++i) {
    const double factor = std::pow(spread, static_cast<double>(i / 3 % 3) - 1.0);
    for (std::size_t k = 0; k < rank; ++k) C[i * rank + k] *= factor;
  }
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      for (std::size_t k = 0; k < rank; ++k) W[i * m + j] += C[i * rank + k] * C[j * rank + k];
    }
  }
  for (std::size_t i = 0; i < m; ++i) W[i * m + i] += regular;
  std::vector<Vec3> b(n);
  for (Vec3& v : b) v = {normal(generator), normal(generator), normal(generator)};
  return make_problem(std::move(W), std::move(b), std::vector<double>(n, mu));
}

std::vector<Vec3> motions(const ConeProblem& p, const std::vector<Vec3>& r) {
  std::vector<Vec3> w = p.b;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t j = 0; j < p.size(); ++j) {
        for (std::size_t c = 0; c < 3; ++c) w[i][a] += p.at(i, a, j, c) * r[j][c];
      }
    }
  }
  return w;
}

/// Largest violation of the conditions as they are written in the contract, relative to the largest force and motion:
/// signs, complementarity, the cone, maximum dissipation (r_T . w_T = -mu r_n |w_T|, which says both stick and slip).
double violation(const ConeProblem& p, const std::vector<Vec3>& r) {
  const std::vector<Vec3> w = motions(p, r);
  double force = 1e-300, motion = 1e-300, worst = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    force = std::max(force, std::abs(r[i][0]));
    motion = std::max({motion, std::abs(p.b[i][0]), std::hypot(p.b[i][1], p.b[i][2]), p.at(i, 0, i, 0) * r[i][0]});
  }
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double r_T = std::hypot(r[i][1], r[i][2]), w_T = std::hypot(w[i][1], w[i][2]);
    worst = std::max({worst, -r[i][0] / force, -w[i][0] / motion, std::abs(r[i][0] * w[i][0]) / force / motion});
    worst = std::max(worst, (r_T - p.mu[i] * r[i][0]) / force);
    if (p.mu[i] == 0.0) continue;
    const double power = r[i][1] * w[i][1] + r[i][2] * w[i][2];
    worst = std::max(worst, std::abs(power + p.mu[i] * r[i][0] * w_T) / force / motion);
  }
  return worst;
}

ConeProblem one_row(const std::vector<double>& W, const Vec3& b, double mu) {
  return make_problem(W, {b}, {mu});
}

const std::vector<double> unit{1, 0, 0, 0, 1, 0, 0, 0, 1};

TEST(Cone, OneRowOpensSticksAndSlipsAsInClosedForm) {
  std::vector<Vec3> r;
  EXPECT_TRUE(
      solve_cone(one_row(unit, {0.5, 1.0, 0.0}, 0.3).W, std::vector<Vec3>{{0.5, 1.0, 0.0}}, std::vector<double>{0.3}, r)
          .converged);
  EXPECT_EQ(r[0], (Vec3{0, 0, 0}));
  // W = diag(4, 1, 1), b = (-2, 0.1, -0.1): r_n = 1/2, stick needs |r_T| = 0.1414 <= 0.3 x 0.5.
  const std::vector<double> W{4, 0, 0, 0, 1, 0, 0, 0, 1};
  const ConeProblem stick = one_row(W, {-2.0, 0.1, -0.1}, 0.3);
  solve_cone(stick.W, stick.b, stick.mu, r);
  EXPECT_DOUBLE_EQ(r[0][0], 0.5);
  EXPECT_DOUBLE_EQ(r[0][1], -0.1);
  EXPECT_DOUBLE_EQ(r[0][2], 0.1);
}

TEST(Cone, OneRowSlipsAgainstItsMotionInAnyDirection) {
  const std::vector<double> W{4, 0, 0, 0, 1, 0, 0, 0, 1};
  for (int k = 0; k < 48; ++k) {
    const double angle = 0.13 + k * 3.14159265358979 / 24;
    const ConeProblem p = one_row(W, {-2.0, 3 * std::cos(angle), 3 * std::sin(angle)}, 0.3);
    std::vector<Vec3> r;
    const ConeResult result = solve_cone(p.W, p.b, p.mu, r);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.iterations, 1);
    EXPECT_DOUBLE_EQ(r[0][0], 0.5);
    EXPECT_NEAR(r[0][1], -0.15 * std::cos(angle), 1e-15);  // round-off of one cosine
    EXPECT_NEAR(r[0][2], -0.15 * std::sin(angle), 1e-15);
  }
}

TEST(Cone, TiesBetweenOpenStickAndSlip) {
  std::vector<Vec3> r;
  for (const Vec3& b : {Vec3{0, 1, 0}, Vec3{-1, 0.3, 0}, Vec3{-1, 0.3 * 0.6, 0.3 * 0.8}, Vec3{0, 0, 0}, Vec3{-1, 0, 0},
                        Vec3{-1e-8, 0, 1}}) {
    const ConeProblem p = one_row(unit, b, 0.3);
    EXPECT_TRUE(solve_cone(p.W, p.b, p.mu, r).converged);
    const double r_n = std::max(0.0, -b[0]), slip = std::min(1.0, 0.3 * r_n / std::max(1e-310, std::hypot(b[1], b[2])));
    EXPECT_EQ(r[0][0], r_n);
    EXPECT_NEAR(r[0][1], -slip * b[1], 1e-15);
    EXPECT_NEAR(r[0][2], -slip * b[2], 1e-15);
  }
}

TEST(Cone, OneRowWithCouplingBetweenNormalAndTangents) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    for (const double mu : {0.3, 1.0, 2.0}) {
      const ConeProblem p = random_problem(1, 3, 0.01, mu, seed);
      std::vector<Vec3> r;
      const ConeResult result = solve_cone(p.W, p.b, p.mu, r);
      EXPECT_TRUE(result.converged) << seed << " " << mu << " " << result.error;
      EXPECT_LE(violation(p, r), 1e-11) << seed << " " << mu;
    }
  }
}

class RandomCone : public testing::TestWithParam<double> {};

TEST_P(RandomCone, FulfilsTheConditionsOnRandomRows) {
  const double mu = GetParam();
  for (const std::size_t n : {1UL, 2UL, 3UL, 5UL, 8UL, 13UL, 21UL, 34UL, 60UL}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      const ConeProblem p = random_problem(n, 3 * n + 3, 0.1, mu, 100 * static_cast<unsigned>(n) + seed);
      std::vector<Vec3> r;
      const ConeResult result = solve_cone(p.W, p.b, p.mu, r);
      EXPECT_TRUE(result.converged) << n << " rows, seed " << seed << ": " << result.error;
      EXPECT_LE(violation(p, r), 1e-10) << n << " rows, seed " << seed;  // 1e-12 x a condition of about 1e2
    }
  }
}

TEST_P(RandomCone, RowsOfVeryDifferentMass) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const ConeProblem p = random_problem(12, 40, 0.0, GetParam(), seed, 30.0);
    std::vector<Vec3> r;
    const ConeResult result = solve_cone(p.W, p.b, p.mu, r);
    EXPECT_TRUE(result.converged) << seed << ": " << result.error;
  }
}

TEST_P(RandomCone, RedundantRows) {
  for (const std::size_t n : {2UL, 4UL, 9UL, 20UL}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      ConeProblem p = random_problem(n, 6, 0.0, GetParam(), seed);  // a rigid body: rank 6
      // b in the range of W, shifted so that free motion fulfils the conditions: b = W x + a common closing motion
      std::vector<Vec3> x(n);
      std::mt19937 generator(seed + 7);
      std::normal_distribution<double> normal;
      for (Vec3& v : x) v = {-std::abs(normal(generator)), normal(generator), normal(generator)};
      p.b.assign(n, Vec3{});
      p.b = motions(p, x);
      std::vector<Vec3> r;
      const ConeResult result = solve_cone(p.W, p.b, p.mu, r);
      EXPECT_TRUE(result.converged) << n << " rows, seed " << seed << ": " << result.error;
      EXPECT_LE(violation(p, r), 1e-9) << n << " rows, seed " << seed;
    }
  }
}

TEST_P(RandomCone, ScalesWithItsUnits) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const ConeProblem p = random_problem(7, 24, 0.1, GetParam(), seed);
    std::vector<Vec3> r;
    ASSERT_TRUE(solve_cone(p.W, p.b, p.mu, r).converged);
    double largest = 0.0;
    for (const Vec3& v : r) largest = std::max(largest, v[0]);
    for (const double unit_W : {1e-12, 1e12}) {
      for (const double unit_b : {1e-12, 1.0, 1e12}) {
        ConeProblem q = p;
        for (FrameBlock& block : q.W.block) {
          for (double& value : block) value *= unit_W;
        }
        for (Vec3& v : q.b) {
          for (double& value : v) value *= unit_b;
        }
        std::vector<Vec3> s;
        ASSERT_TRUE(solve_cone(q.W, q.b, q.mu, s).converged);
        for (std::size_t i = 0; i < r.size(); ++i) {
          for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(s[i][a] * unit_W / unit_b, r[i][a], 1e-10 * largest);
        }
      }
    }
  }
}

TEST_P(RandomCone, StartsFromTheSolution) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const ConeProblem p = random_problem(15, 50, 0.1, GetParam(), seed);
    std::vector<Vec3> r;
    ASSERT_TRUE(solve_cone(p.W, p.b, p.mu, r).converged);
    const std::vector<Vec3> before = r;
    EXPECT_EQ(solve_cone(p.W, p.b, p.mu, r).iterations, 0);
    EXPECT_EQ(r, before);
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, RandomCone, testing::Values(0.0, 0.3, 1.0));

/// Normal forces of the frictionless problem by trying all sets of closed rows.
std::optional<std::vector<double>> brute_force(const ConeProblem& p) {
  const std::size_t n = p.size();
  for (std::uint32_t set = 0; set < (1U << n); ++set) {
    std::vector<std::size_t> closed;
    for (std::size_t i = 0; i < n; ++i) {
      if ((set >> i & 1U) != 0) closed.push_back(i);
    }
    std::vector<double> A, x;
    for (const std::size_t i : closed) {
      for (const std::size_t j : closed) A.push_back(p.at(i, 0, j, 0));
      x.push_back(-p.b[i][0]);
    }
    DenseLu(A, static_cast<int>(closed.size())).solve(x);
    std::vector<Vec3> r(n);
    for (std::size_t k = 0; k < closed.size(); ++k) r[closed[k]][0] = x[k];
    const std::vector<Vec3> w = motions(p, r);
    bool good = true;
    for (std::size_t i = 0; i < n; ++i) good = good && r[i][0] >= 0.0 && w[i][0] >= -1e-12;
    if (!good) continue;
    std::vector<double> result;
    for (const Vec3& v : r) result.push_back(v[0]);
    return result;
  }
  return std::nullopt;
}

TEST(Cone, FrictionlessRowsAgainstAllActiveSets) {
  for (std::size_t n = 1; n <= 8; ++n) {
    for (unsigned seed = 0; seed < 30; ++seed) {
      const ConeProblem p = random_problem(n, n, 0.05, 0.0, seed);
      const auto expected = brute_force(p);
      ASSERT_TRUE(expected);
      std::vector<Vec3> r;
      ASSERT_TRUE(solve_cone(p.W, p.b, p.mu, r).converged);
      const double largest = *std::ranges::max_element(*expected);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(r[i][0], (*expected)[i], 1e-9 * largest);  // condition 1e3
    }
  }
}

TEST(Cone, RigidBlockOnFourCornersSharesItsLoad) {
  // Vertical motion only, unit mass: W = 1 for every pair; all four corners close at speed 2.
  const std::size_t n = 4;
  std::vector<double> W(144, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) W[3 * i * 12 + 3 * j] = 1.0;
  }
  const ConeProblem p = make_problem(W, std::vector<Vec3>(n, {-2.0, 0.0, 0.0}), std::vector<double>(n, 0.0));
  std::vector<Vec3> r;
  EXPECT_TRUE(solve_cone(p.W, p.b, p.mu, r).converged);
  double sum = 0.0;
  for (const Vec3& v : r) sum += v[0];
  EXPECT_NEAR(sum, 2.0, 1e-12);
}

TEST(Cone, SaysThatNoForceCanOpenASqueezedBody) {
  // Two walls that close on one free mass from both sides: w = (-1 + t, -1 - t) for any t.
  std::vector<double> W(36, 0.0);
  W[0] = W[21] = 1.0;
  W[3] = W[18] = -1.0;
  const ConeProblem p = make_problem(W, {{-1, 0, 0}, {-1, 0, 0}}, {0.0, 0.0});
  std::vector<Vec3> r;
  EXPECT_FALSE(solve_cone(p.W, p.b, p.mu, r).converged);
  const ConeProblem stuck = make_problem(std::vector<double>(9, 0.0), {{-1, 0, 0}}, {0.3});
  EXPECT_FALSE(solve_cone(stuck.W, stuck.b, stuck.mu, r).converged);
  const ConeProblem away = make_problem(std::vector<double>(9, 0.0), {{1, 0, 0}}, {0.3});
  EXPECT_TRUE(solve_cone(away.W, away.b, away.mu, r).converged);
  const ConeProblem broken = make_problem(unit, {{std::nan(""), 0, 0}}, {0.3});
  EXPECT_FALSE(solve_cone(broken.W, broken.b, broken.mu, r).converged);
}

TEST(Cone, PlaneRowsHaveNoThirdComponent) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    ConeProblem p = random_problem(9, 30, 0.1, 0.5, seed);
    for (FrameBlock& block : p.W.block) block[2] = block[5] = block[6] = block[7] = block[8] = 0.0;
    for (std::size_t i = 0; i < 27; ++i) {
      for (std::size_t j = 2; j < 27; j += 3) p.dense[i * 27 + j] = p.dense[j * 27 + i] = 0.0;
    }
    for (Vec3& v : p.b) v[2] = 0.0;
    std::vector<Vec3> r;
    const ConeResult result = solve_cone(p.W, p.b, p.mu, r);
    EXPECT_TRUE(result.converged) << seed << ": " << result.error;
    EXPECT_LE(violation(p, r), 1e-10);
    for (const Vec3& v : r) EXPECT_NEAR(v[2], 0.0, 1e-15 * (v[0] + 1.0));  // the direction of slip is rounded
  }
}

TEST(Cone, RowsWithAndWithoutFrictionTogether) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    ConeProblem p = random_problem(9, 30, 0.1, 0.5, seed);
    for (std::size_t i = 0; i < 9; i += 2) p.mu[i] = 0.0;
    std::vector<Vec3> r;
    EXPECT_TRUE(solve_cone(p.W, p.b, p.mu, r).converged);
    EXPECT_LE(violation(p, r), 1e-10);
  }
}

TEST(Cone, ManyIndependentRowsTakeOneSweep) {
  const std::size_t n = 2000;
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  Delassus W;
  W.begin.push_back(0);
  std::vector<Vec3> b;
  for (std::size_t i = 0; i < n; ++i) {
    W.rows.push_back(i);
    W.column.push_back(i);
    W.block.push_back({2, 0, 0, 0, 2, 0, 0, 0, 2});
    W.begin.push_back(i + 1);
    b.push_back({normal(generator), normal(generator), normal(generator)});
  }
  std::vector<Vec3> r;
  const ConeResult result = solve_cone(W, b, std::vector<double>(n, 0.4), r);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 1);
  for (std::size_t i = 0; i < n; ++i) EXPECT_DOUBLE_EQ(r[i][0], std::max(0.0, -b[i][0]) / 2);
}

/// Rows in a chain, each coupled to its two neighbours as by the shared nodes of a surface.
Delassus chain(std::size_t n) {
  Delassus W;
  W.begin.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    W.rows.push_back(i);
    for (std::size_t j = i == 0 ? 0 : i - 1; j < std::min(n, i + 2); ++j) {
      const double value = i == j ? 4.0 : 1.0;
      W.column.push_back(j);
      W.block.push_back({value, 0, 0, 0, value, 0, 0, 0, value});
    }
    W.begin.push_back(W.column.size());
  }
  return W;
}

TEST(Cone, LongChainsAreSolvedInLinearTime) {
  for (const double mu : {0.0, 0.4}) {
    const std::size_t n = 10000;
    const Delassus W = chain(n);
    std::mt19937 generator(5);
    std::normal_distribution<double> normal(-0.5);
    std::vector<Vec3> b, r;
    for (std::size_t i = 0; i < n; ++i) b.push_back({normal(generator), normal(generator), normal(generator)});
    const ConeResult result = solve_cone(W, b, std::vector<double>(n, mu), r);
    EXPECT_TRUE(result.converged) << result.error;
    EXPECT_LE(result.iterations, 60);  // independent of n
  }
}

// A row that gives way against its force: W is the compliance of an indefinite operator.
TEST(Cone, RefusesARowThatGivesWayAgainstItsForce) {
  const ConeProblem p = make_problem({-1, 0, 0, 0, 1, 0, 0, 0, 1}, {{-1, 0, 0}}, {0.0});
  std::vector<Vec3> r;
  const ConeResult result = solve_cone(p.W, p.b, p.mu, r, 1e-10);
  EXPECT_FALSE(result.converged);
  EXPECT_TRUE(std::isinf(result.error));
}

}  // namespace
}  // namespace carom::contact_cone_test
