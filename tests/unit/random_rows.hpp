// Random rows, and a random operator to invert, for the tests of compliances.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "linalg/dense.hpp"
#include "math/vec3.hpp"
#include "rows/delassus.hpp"

namespace carom::test {

inline constexpr std::size_t random_node_count = 24, random_dof_count = 3 * random_node_count;

/// Rows on three random nodes each (some twice in a row), with random blocks; every third without friction.
inline ConstraintRows random_rows(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<Index> any_node(0, random_node_count - 1);
  ConstraintRows rows;
  for (std::size_t r = 0; r < count; ++r) {
    const Vec3 direction{normal(generator), normal(generator), normal(generator)};
    rows.add_row(0.1, normalized(direction), {}, 1.0, {.mu = r % 3 == 0 ? 0.0 : 0.4}, 0);
    for (int k = 0; k < 3; ++k) {
      RowBlock block;
      for (Vec3& v : block) v = {normal(generator), normal(generator), normal(generator)};
      rows.add_block(any_node(generator), block);
    }
  }
  return rows;
}

/// 1 + (small random symmetric): positive definite, condition number below 3.
inline std::vector<double> random_operator(unsigned seed) {
  constexpr std::size_t n = random_dof_count;
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-0.5 / n, 0.5 / n);
  std::vector<double> A(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) A[i * n + j] = A[j * n + i] = uniform(generator) + (i == j);
  }
  return A;
}

/// The inverse of random_operator(seed), and how many columns it has been asked for.
struct CountingInverse {
  DenseLu factors;
  int columns = 0;

  explicit CountingInverse(unsigned seed) : factors(random_operator(seed), static_cast<int>(random_dof_count)) {}
  InverseOperator as_operator() {
    return {[this](std::span<double> b, int count) {
      columns += count;
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        factors.solve(b.subspan(k * random_dof_count, random_dof_count));
      }
    }};
  }
};

/// How many components the rows have, the normal one or all three.
inline std::vector<std::size_t> component_counts(const ConstraintRows& rows, const std::vector<std::size_t>& chosen) {
  std::vector<std::size_t> counts;
  for (const std::size_t r : chosen) counts.push_back(rows.law[r].mu > 0.0 ? 3 : 1);
  return counts;
}

/// Largest difference of an entry of W and of the Delassus operator by a solve for each column.
inline double delassus_error(const Delassus& W, const ConstraintRows& rows, const std::vector<std::size_t>& chosen,
                             const InverseOperator& inverse) {
  const Delassus exact = make_delassus(rows, chosen, random_dof_count, inverse);
  if (W.rows != exact.rows || W.entries() != exact.entries()) return std::numeric_limits<double>::infinity();
  double error = 0.0;
  for (std::size_t k = 0; k < W.entries(); ++k) {
    for (std::size_t e = 0; e < 9; ++e) error = std::max(error, std::abs(W.block_at(k)[e] - exact.block_at(k)[e]));
  }
  return error;
}

}  // namespace carom::test
