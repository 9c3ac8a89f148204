// The complementarity solver on the rows of two passes: redundant, and contradicting each other by a little.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "rows/cone_solver.hpp"

namespace carom::contact_cone_two_pass_test {
namespace {

/// Rows of two square faces of n x n nodes each, every node of one against the facets of the other: W = G M^-1 G^T.
struct TwoFaces {
  Delassus W;
  std::vector<Vec3> b;
  std::vector<double> mu;
};

/// Shape functions of n equally spaced nodes at x in 0 ... 1.
std::vector<double> hats(double x, std::size_t n) {
  std::vector<double> s(n, 0.0);
  const double t = x * static_cast<double>(n - 1);
  const auto i = std::min(n - 2, static_cast<std::size_t>(t));
  s[i + 1] = t - static_cast<double>(i);
  s[i] = 1.0 - s[i + 1];
  return s;
}

/// tilt: angles between the frames of the rows. contradiction: random part of b, which need not be in the range of W.
/// The faces meet at unit speed, at a slant of about 45 degrees.
TwoFaces two_faces(unsigned seed, double mu, double tilt, double contradiction) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  const std::array<std::size_t, 2> per_side{2 + generator() % 3, 2 + generator() % 3};
  const std::size_t first = per_side[0] * per_side[0], nodes = first + per_side[1] * per_side[1], dofs = 3 * nodes;
  const double mass_ratio = std::pow(10.0, normal(generator));
  std::vector<double> v(dofs), G(3 * nodes * dofs, 0.0);
  for (std::size_t i = 0; i < dofs; ++i)
    v[i] = 0.1 * normal(generator) + (i < 3 * first ? (i % 3 == 0 ? -1.0 : 0.7) : 0);
  for (std::size_t row = 0; row < nodes; ++row) {
    const std::size_t side = row < first ? 0 : 1, local = row - side * first, m = per_side[side],
                      o = per_side[1 - side];
    const double a = tilt * normal(generator), c = tilt * normal(generator);
    const std::array<Vec3, 3> frame{Vec3{1, a, c}, Vec3{-a, 1, 0}, Vec3{-c, 0, side == 0 ? 1.0 : -1.0}};
    const auto add_node = [&](std::size_t node, double weight) {
      for (std::size_t k = 0; k < 9; ++k)
        G[(3 * row + k / 3) * dofs + 3 * node + k % 3] += weight * frame[k / 3][k % 3];
    };
    const double sign = side == 0 ? 1.0 : -1.0, last = static_cast<double>(m - 1);
    const std::vector<double> s = hats(static_cast<double>(local / m) / last, o),
                              t = hats(static_cast<double>(local % m) / last, o);
    add_node(row, sign);
    for (std::size_t k = 0; k < o * o; ++k) add_node((1 - side) * first + k, -sign * s[k / o] * t[k % o]);
  }
  TwoFaces out;
  out.mu.assign(nodes, mu);
  out.b.resize(nodes);
  out.W.begin.push_back(0);
  for (std::size_t i = 0; i < nodes; ++i) {
    out.W.rows.push_back(i);
    for (std::size_t j = 0; j < nodes; ++j) {
      FrameBlock block{};
      for (std::size_t k = 0; k < 9; ++k) {
        const double *g = &G[(3 * i + k / 3) * dofs], *h = &G[(3 * j + k % 3) * dofs];
        for (std::size_t d = 0; d < dofs; ++d) block[k] += g[d] * h[d] * (d < 3 * first ? 1.0 : mass_ratio);
      }
      out.W.column.push_back(j);
      out.W.block.push_back(mu > 0.0 ? block : FrameBlock{block[0]});
    }
    out.W.begin.push_back(out.W.column.size());
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t d = 0; d < dofs; ++d) out.b[i][a] += G[(3 * i + a) * dofs + d] * v[d];
      out.b[i][a] += contradiction * normal(generator);
    }
  }
  return out;
}

/// Largest violation of Signorini's and Coulomb's conditions as motions, over the largest |b| (which is about 1): of
/// signs and complementarity, and of w_T against the friction force.
double violation(const TwoFaces& p, const std::vector<Vec3>& r) {
  std::vector<Vec3> w(r.size());
  p.W.apply(r, w);
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      w[i][a] += p.b[i][a];
      largest = std::max(largest, std::abs(p.b[i][a]));
    }
    EXPECT_GE(r[i][0], 0.0);
    worst = std::max({worst, -w[i][0], std::min(w[i][0], p.W.block[p.W.begin[i] + i][0] * r[i][0])});
    if (p.mu[i] == 0.0) continue;
    const double compliance = p.W.block[p.W.begin[i] + i][4], limit = p.mu[i] * r[i][0];
    const double t_1 = r[i][1] - w[i][1] / compliance, t_2 = r[i][2] - w[i][2] / compliance;
    const double keep = std::min(1.0, limit / std::max(1e-300, std::hypot(t_1, t_2)));
    worst = std::max(worst, compliance * std::hypot(r[i][1] - keep * t_1, r[i][2] - keep * t_2));
  }
  return worst / largest;
}

class TwoPassCone : public testing::TestWithParam<double> {};

// 8 to 32 rows, of which a third or more say nothing new. The bound is what is asked for (1e-12) where the rows agree,
// times the ratio of forces x compliance to b (below 1e2).
TEST_P(TwoPassCone, RedundantRowsThatAgree) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const TwoFaces p = two_faces(seed, GetParam(), 0.0, 0.0);
    std::vector<Vec3> r;
    const ConeResult result = solve_cone(p.W, p.b, p.mu, r, 1e-12, 1e-10);
    EXPECT_TRUE(result.converged) << seed << ": " << result.error;
    EXPECT_LE(violation(p, r), 1e-8) << seed;
  }
}

// Contradictions from round-off to the size of discretisation errors. 1e-5 of the motion is what the explicit schemes
// ask for.
TEST_P(TwoPassCone, RedundantRowsThatContradictEachOther) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const double size = std::pow(10.0, -15.0 + 0.3 * seed);
    const TwoFaces p = two_faces(1000 + seed, GetParam(), size, size);
    std::vector<Vec3> r;
    const ConeResult result = solve_cone(p.W, p.b, p.mu, r, 1e-12, 1e-5);
    EXPECT_TRUE(result.converged) << seed << ", contradiction " << size << ": " << result.error;
    EXPECT_LE(violation(p, r), 1e-3) << seed;  // 1e-5 of forces x compliance, which are up to 1e2 of b
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, TwoPassCone, testing::Values(0.0, 0.1, 0.3, 0.8));

/// W of n x n motions that act on each other over a distance of 2, and as many rows: each motion seen from both sides,
/// the guards, and a mean about it. As on faces of second order, the means of every other one (the corners) have
/// negative parts of its neighbours. The guards admit up to 0.01 of the approach, so that nothing fits exactly.
TwoFaces guarded_means(std::size_t n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> slack(0.0, 0.01);
  const std::size_t motions = n * n, rows = 3 * motions;
  std::vector<double> G(rows * motions, 0.0), GC(rows * motions, 0.0);
  TwoFaces out;
  out.b.resize(rows);
  out.mu.assign(rows, 0.0);
  const auto distance = [n](std::size_t i, std::size_t j) {
    const auto away = [](std::size_t a, std::size_t b) { return static_cast<double>(a) - static_cast<double>(b); };
    return std::hypot(away(i / n, j / n), away(i % n, j % n));
  };
  std::vector<double> compliance;
  for (std::size_t i = 0; i < motions * motions; ++i)
    compliance.push_back(std::exp(-0.5 * distance(i / motions, i % motions)));
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t i = row % motions;
    const bool is_mean = row >= 2 * motions;
    for (std::size_t j = 0; j < motions; ++j) {
      double& part = G[row * motions + j];
      if (i == j) part = 1.0;
      if (is_mean && distance(i, j) == 1.0) part = (i / n + i % n) % 2 == 0 ? -0.2 : 0.2;
      out.b[row][0] -= part;
    }
    if (!is_mean) out.b[row][0] += slack(generator);
    for (std::size_t k = 0; k < motions; ++k) {
      const double part = G[row * motions + k];
      if (part == 0.0) continue;
      for (std::size_t j = 0; j < motions; ++j) GC[row * motions + j] += part * compliance[k * motions + j];
    }
  }
  out.W.begin.push_back(0);
  for (std::size_t row = 0; row < rows; ++row) {
    out.W.rows.push_back(row);
    for (std::size_t other = 0; other < rows; ++other) {
      double sum = 0.0;
      for (std::size_t k = 0; k < motions; ++k) sum += GC[row * motions + k] * G[other * motions + k];
      out.W.column.push_back(other);
      out.W.block.push_back(FrameBlock{sum});
    }
    out.W.begin.push_back(out.W.column.size());
  }
  return out;
}

// Three rows for each motion: block pivoting alone changes their sides for ever. More systems than rows would be no
// better than adding row by row.
TEST(TwoPassConeMeans, ThreeRowsForEachMotionAreSolvedInFewerSystemsThanRows) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const TwoFaces p = guarded_means(8, seed);
    std::vector<Vec3> r;
    const ConeResult result = solve_cone(p.W, p.b, p.mu, r, 1e-14, 1e-10);
    EXPECT_TRUE(result.converged) << seed << ": " << result.error;
    EXPECT_LE(result.iterations, static_cast<int>(p.b.size())) << seed;
    EXPECT_LE(violation(p, r), 1e-9) << seed;  // 1e-10 of forces x compliance, which are up to ten times b
  }
}

// A motion of the size of its own rounding is no motion.
TEST(TwoPassConeRounding, ViolationsWithinTheRoundingOfTheMotionAreAccepted) {
  TwoFaces p = two_faces(7, 0.3, 0.0, 1e-3);
  for (Vec3& b : p.b) {
    for (double& value : b) value *= 1e-15;
  }
  std::vector<Vec3> r;
  EXPECT_TRUE(solve_cone(p.W, p.b, p.mu, r, 1e-12, 0.0, 1e-15).converged);
}

}  // namespace
}  // namespace carom::contact_cone_two_pass_test
