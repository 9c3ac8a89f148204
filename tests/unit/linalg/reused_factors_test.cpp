#include "linalg/reused_factors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "linalg/nested_dissection.hpp"
#include "linalg_problems.hpp"

namespace {

using carom::ReusedFactors;

/// Entries that follow from the unknowns' numbers, 1 on the diagonal, the others together below it.
struct System {
  std::vector<std::size_t> unknowns;
  std::vector<double> matrix;

  explicit System(std::vector<std::size_t> names) : unknowns(std::move(names)) {
    const std::size_t n = unknowns.size();
    for (const std::size_t i : unknowns)
      for (const std::size_t j : unknowns)
        matrix.push_back(i == j ? 1.0 : std::sin(static_cast<double>(3 * i + 7 * j)) / static_cast<double>(n));
  }
  std::size_t size() const { return unknowns.size(); }
  void apply(std::span<const double> x, std::span<double> y) const {
    for (std::size_t i = 0; i < size(); ++i)
      y[i] = std::inner_product(x.begin(), x.end(), matrix.begin() + static_cast<std::ptrdiff_t>(i * size()), 0.0);
  }
  carom::LinearOperator function() const {
    return [this](std::span<const double> x, std::span<double> y) { apply(x, y); };
  }
};

std::vector<double> random_vector(std::size_t n) {
  std::mt19937 random(5);
  std::vector<double> x(n);
  for (double& entry : x) entry = std::uniform_real_distribution<>(-1.0, 1.0)(random);
  return x;
}

std::vector<std::size_t> names(std::size_t first, std::size_t count) {
  std::vector<std::size_t> out(count);
  std::iota(out.begin(), out.end(), first);
  return out;
}

double residual(const System& s, const std::vector<double>& x, const std::vector<double>& b) {
  std::vector<double> y(b.size());
  s.apply(x, y);
  double sum = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    sum += (y[i] - b[i]) * (y[i] - b[i]);
    scale += b[i] * b[i];
  }
  return std::sqrt(sum / scale);
}

TEST(ReusedFactors, SolveSystemsWithOtherUnknownsInAnyOrder) {
  const System first(names(0, 200));
  std::vector<double> b = random_vector(200), x(200);
  ReusedFactors factors;
  ASSERT_TRUE(factors.factor(first.unknowns, first.matrix, b, x));
  EXPECT_LT(residual(first, x, b), 1e-13);  // round-off

  std::vector<std::size_t> others = names(4, 200);  // four have gone, four are new
  std::swap(others.front(), others.back());
  const System second(others);
  for (const double wanted : {1e-6, 1e-12}) {
    ASSERT_TRUE(factors.solve(second.unknowns, second.function(), b, x, wanted));
    EXPECT_LE(residual(second, x, b), 1.01 * wanted);  // GMRES knows its residual to round-off here
  }
}

TEST(ReusedFactors, LeaveWhatIsTooDifferentToOthers) {
  const System first(names(0, 200));
  std::vector<double> b = random_vector(200), x(200);
  ReusedFactors factors;
  EXPECT_FALSE(factors.solve(first.unknowns, first.function(), b, x, 1e-6)) << "without factors";
  ASSERT_TRUE(factors.factor(first.unknowns, first.matrix, b, x));
  const System far(names(100, 200));
  EXPECT_FALSE(factors.solve(far.unknowns, far.function(), b, x, 1e-6));
  factors.forget();
  EXPECT_FALSE(factors.solve(first.unknowns, first.function(), b, x, 1e-6)) << "forgotten";
}

/// Redundant rows leave a system singular but for a little; from one little to another the factors change beyond what
/// GMRES can mend in double precision, which its own residual does not tell.
TEST(ReusedFactors, DoNotPassRoundingForASolution) {
  const System once(names(0, 100));
  const auto twice = [&](double little) {
    System s(names(0, 200));
    for (std::size_t i = 0; i < 200; ++i)
      for (std::size_t j = 0; j < 200; ++j)
        s.matrix[200 * i + j] = once.matrix[100 * (i / 2) + j / 2] + (i == j ? little : 0.0);
    return s;
  };
  const System first = twice(1e-12), second = twice(1e-13);
  std::vector<double> b = random_vector(200), x(200);
  for (std::size_t i = 0; i < 200; i += 2) b[i + 1] = b[i] * (1.0 + 1e-9);  // they contradict each other by a little
  ReusedFactors factors;
  ASSERT_TRUE(factors.factor(first.unknowns, first.matrix, b, x));
  constexpr double wanted = 1e-14;
  if (factors.solve(second.unknowns, second.function(), b, x, wanted)) {
    EXPECT_LE(residual(second, x, b), 11.0 * wanted);  // ten times what is asked, and rounding of the test's own sums
  }
}

TEST(ReusedFactors, AreNotThereForASingularMatrix) {
  std::vector<double> b = random_vector(100), x(100);
  ReusedFactors factors;
  EXPECT_FALSE(factors.factor(names(0, 100), std::vector<double>(100 * 100, 1.0), b, x));
  const System first(names(0, 100));
  EXPECT_FALSE(factors.solve(first.unknowns, first.function(), b, x, 1e-6));
}

/// Sparse factors stand where dense ones stood: Laplacians and a little that is not symmetric.
TEST(ReusedFactors, OfSparseMatricesSolveAsDenseOnesDo) {
  carom::CsrMatrix A = carom::test::laplacian(6);
  const auto n = static_cast<std::size_t>(A.size);
  System dense(names(0, n));
  std::fill(dense.matrix.begin(), dense.matrix.end(), 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (auto k = static_cast<std::size_t>(A.row_begin[i]); k < static_cast<std::size_t>(A.row_begin[i + 1]); ++k) {
      const auto j = static_cast<std::size_t>(A.column[k]);
      if (j > i) A.value[k] *= 0.5;
      dense.matrix[n * i + j] = A.value[k];
    }
  }
  const std::vector<double> b = random_vector(n);
  std::vector<double> x(n), wanted(n);
  ReusedFactors sparse_factors, dense_factors;
  ASSERT_TRUE(sparse_factors.factor(dense.unknowns, A, carom::nested_dissection(A), b, x));
  ASSERT_TRUE(dense_factors.factor(dense.unknowns, dense.matrix, b, wanted));
  // Round-off times the condition number, 20.
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i], wanted[i], 1e-13);
  System other = dense;
  for (std::size_t i = 0; i < 5; ++i) other.matrix[n * i + i] *= 2.0;
  ASSERT_TRUE(sparse_factors.solve(other.unknowns, other.function(), b, x, 1e-12));
  EXPECT_LE(residual(other, x, b), 1.01e-12);  // GMRES knows its residual to round-off here
}

TEST(ReusedFactors, AreNotThereForASingularSparseMatrix) {
  carom::CsrMatrix A = carom::test::laplacian(3);
  std::fill(A.value.begin(), A.value.end(), 1.0);
  for (std::size_t k = 0; k < A.value.size(); ++k)
    if (A.column[k] == 13) A.value[k] = 0.0;  // a column of zeros
  std::vector<double> b = random_vector(27), x(27);
  ReusedFactors factors;
  EXPECT_FALSE(factors.factor(names(0, 27), A, carom::nested_dissection(A), b, x));
  EXPECT_FALSE(factors.solve(names(0, 27), System(names(0, 27)).function(), b, x, 1e-6));
}

}  // namespace
