// Rows that few others act on, solved by iterations and sparse factors, against the same rows with a dense W, solved by
// dense factors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "math/vec3.hpp"
#include "rows/cone_solver.hpp"

namespace carom::contact_cone_sparse_test {
namespace {

/// Rows of a face of n x n nodes of mass 1 on facets of one of m x m nodes of mass 2, their normals turned at random by
/// some 3e-3; with both, rows of the second over the first too, which say little new.
struct Faces {
  ConstraintRows rows;
  std::vector<double> inverse;  ///< of the mass
  std::vector<Vec3> b;          ///< the faces meet at a speed of about 1, slanting where there is friction

  Faces(std::size_t n, std::size_t m, double mu, bool both, unsigned seed) : generator_(seed) {
    add_side(n, 0, m, n * n, 1.0, mu);
    if (both) add_side(m, n * n, n, 0, -1.0, mu);
    inverse.assign(3 * (n * n + m * m), 0.5);
    std::fill_n(inverse.begin(), 3 * n * n, 1.0);
    std::vector<double> v(inverse.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double of_body = i >= 3 * n * n ? 0.0 : i % 3 == 2 ? -1.0 : 0.2;
      v[i] = of_body + 0.5 * normal_(generator_);
    }
    for (std::size_t r = 0; r < rows.size(); ++r) b.push_back(rows.relative(r, v));
  }

  Delassus sparse() const {
    std::vector<std::size_t> all;
    for (std::size_t r = 0; r < rows.size(); ++r) all.push_back(r);
    return make_delassus(rows, all, inverse);
  }

 private:
  void add_side(std::size_t n, std::size_t first, std::size_t m, std::size_t other, double sign, double mu) {
    for (std::size_t k = 0; k < n * n; ++k) {
      const Vec3 up{3e-3 * normal_(generator_), 3e-3 * normal_(generator_), sign};
      rows.add_row(0.0, normalized(up), {}, 1.0, {.mu = mu}, static_cast<Index>(rows.size()));
      rows.add_node(static_cast<Index>(first + k), 1.0);
      const double cells = static_cast<double>(m - 1) / static_cast<double>(n - 1);
      // A little inside, so that no node lies on another's.
      const double x = 0.01 + 0.97 * cells * static_cast<double>(k / n),
                   y = 0.01 + 0.98 * cells * static_cast<double>(k % n);
      const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
      const double s = x - static_cast<double>(i), t = y - static_cast<double>(j);
      const std::size_t corner = other + i * m + j;
      rows.add_node(static_cast<Index>(corner), -(1.0 - s) * (1.0 - t));
      rows.add_node(static_cast<Index>(corner + m), -s * (1.0 - t));
      rows.add_node(static_cast<Index>(corner + 1), -(1.0 - s) * t);
      rows.add_node(static_cast<Index>(corner + m + 1), -s * t);
    }
  }

  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
};

/// The same W with all its entries.
Delassus filled(const Delassus& W) {
  Delassus out = Delassus::dense(W.rows, W.normal.empty());
  for (std::size_t i = 0; i < W.size(); ++i)
    W.each(i, [&](std::size_t j, std::size_t entry) { out.add(i * W.size() + j, W.block_at(entry)); });
  return out;
}

double largest(const std::vector<Vec3>& vectors) {
  double most = 0.0;
  for (const Vec3& v : vectors) most = std::max(most, norm(v));
  return most;
}

std::vector<Vec3> difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(subtract(a[i], b[i]));
  return out;
}

class SparseCone : public testing::TestWithParam<double> {};

// 441 rows, each beside some 25 others. W is regular (its eigenvalues are 1 at least, the inverse mass of the nodes):
// forces that miss their motions by 1e-13 of the largest miss those of the dense W by a few times that.
TEST_P(SparseCone, IndependentRowsAreThoseOfTheDenseOne) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Faces faces(21, 19, GetParam(), false, seed);
    const Delassus W = faces.sparse(), dense = filled(W);
    ASSERT_LT(W.entries(), dense.entries() / 10);
    std::vector<Vec3> r, wanted;
    const std::vector<double> mu(W.size(), GetParam());
    const ConeResult result = solve_cone(W, faces.b, mu, r, 1e-13),
                     of_dense = solve_cone(dense, faces.b, mu, wanted, 1e-13);
    EXPECT_TRUE(result.converged && of_dense.converged) << result.error << " " << of_dense.error;
    EXPECT_LT(largest(difference(r, wanted)), 1e-12 * largest(wanted)) << seed;
    EXPECT_GT(std::ranges::count_if(r, [](const Vec3& f) { return f[0] > 0.0; }), 300);
  }
}

// 365 rows on 365 nodes that contradict each other by the turn of their normals. Forces of redundant rows are not
// determined; without friction the motions that they make are (the least in the energy norm). 1e-5 of the motion is
// what explicit schemes ask for, 1e-12 what they wish.
TEST_P(SparseCone, RedundantRowsMoveAsThoseOfTheDenseOne) {
  const Faces faces(14, 13, GetParam(), true, 7);
  const Delassus W = faces.sparse(), dense = filled(W);
  std::vector<Vec3> r, wanted, w(W.size()), w_wanted(W.size());
  const std::vector<double> mu(W.size(), GetParam());
  const ConeResult result = solve_cone(W, faces.b, mu, r, 1e-12, 1e-5),
                   of_dense = solve_cone(dense, faces.b, mu, wanted, 1e-12, 1e-5);
  EXPECT_TRUE(result.converged && of_dense.converged) << result.error << " " << of_dense.error;
  if (GetParam() > 0.0) return;
  W.apply(r, w);
  dense.apply(wanted, w_wanted);
  EXPECT_LT(largest(difference(w, w_wanted)), 1e-5 * largest(w_wanted));
}

// 20,000 rows: iterations do not grow with their number.
TEST_P(SparseCone, TwentyThousandRowsTakeAsManyIterationsAsFew) {
  int few = 0;
  for (const std::size_t n : {std::size_t{21}, std::size_t{141}}) {
    const Faces faces(n, n - 2, GetParam(), false, 3);
    const Delassus W = faces.sparse();
    std::vector<Vec3> r;
    const ConeResult result = solve_cone(W, faces.b, std::vector<double>(W.size(), GetParam()), r, 1e-12);
    EXPECT_TRUE(result.converged) << result.error;
    if (few == 0) few = result.iterations;
    EXPECT_LE(result.iterations, 3 * few);
  }
}

INSTANTIATE_TEST_SUITE_P(Friction, SparseCone, testing::Values(0.0, 0.3));

TEST(DenseDelassus, SaysHowManyRowsAreTooManyBeforeItTakesTheMemory) {
  constexpr std::size_t without_friction = 16384, with_friction = 5461;  // 2 GiB of 8 and of 72 bytes
  Delassus::admit_dense(without_friction, false);
  Delassus::admit_dense(with_friction, true);
  for (const bool has_friction : {false, true}) {
    const std::size_t count = 1 + (has_friction ? with_friction : without_friction);
    try {
      Delassus::dense(std::vector<std::size_t>(count), has_friction);
      FAIL() << "nothing was thrown";
    } catch (const TooManyRows& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(std::to_string(count) + " rows in contact"), std::string::npos) << message;
      EXPECT_NE(message.find("cd_lagrange"), std::string::npos) << message;
    }
  }
}

TEST(DenseDelassus, OfSomeRowsAddsToASparseOne) {
  const Faces faces(4, 3, 0.3, false, 1);
  const Delassus W = faces.sparse();
  const std::vector<std::size_t> some{1, 7, 12};
  Delassus more = Delassus::dense(some, true);
  for (std::size_t k = 0; k < more.entries(); ++k) more.add(k, {1.0 + static_cast<double>(k), 0.5});
  const Delassus sum = sum_of(W, some, more);
  const Delassus of_W = filled(W), of_sum = filled(sum);
  for (std::size_t i = 0; i < W.size(); ++i) {
    for (std::size_t j = 0; j < W.size(); ++j) {
      FrameBlock wanted = of_W.block[i * W.size() + j];
      const auto p = std::ranges::find(some, i), q = std::ranges::find(some, j);
      if (p != some.end() && q != some.end()) {
        wanted[0] += 1.0 + static_cast<double>(3 * (p - some.begin()) + (q - some.begin()));
        wanted[1] += 0.5;
      }
      EXPECT_EQ(of_sum.block[i * W.size() + j], wanted);
    }
  }
}

}  // namespace
}  // namespace carom::contact_cone_sparse_test
