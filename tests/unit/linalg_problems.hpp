// Matrices with known properties, shared by the linear algebra tests.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "linalg/csr_matrix.hpp"

namespace carom::test {

/// Rows of a dense n x n matrix as CSR, zeros left out.
inline CsrMatrix sparse(const std::vector<double>& dense, Index n) {
  CsrMatrix A;
  A.size = n;
  A.row_begin = {0};
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double a = dense[static_cast<std::size_t>(i) * static_cast<std::size_t>(n) + static_cast<std::size_t>(j)];
      if (a == 0.0) continue;
      A.column.push_back(j);
      A.value.push_back(a);
    }
    A.row_begin.push_back(static_cast<std::int64_t>(A.value.size()));
  }
  return A;
}

/// Seven-point Laplacian of an m x m x m grid with zero values outside: 6 on the diagonal, -1 beside it. Its
/// eigenvalues are the sums over the three directions of 4 sin^2(k pi / (2 (m + 1))), k = 1 ... m (LeVeque, Finite
/// Difference Methods for Ordinary and Partial Differential Equations, 2007, section 2.10 and 3.4).
inline CsrMatrix laplacian(Index m) {
  CsrMatrix A;
  A.size = m * m * m;
  A.row_begin = {0};
  const auto add = [&A](bool inside, Index column, double value) {
    if (!inside) return;
    A.column.push_back(column);
    A.value.push_back(value);
  };
  for (Index k = 0; k < m; ++k)
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i < m; ++i) {
        const Index row = (k * m + j) * m + i;
        add(k > 0, row - m * m, -1.0);
        add(j > 0, row - m, -1.0);
        add(i > 0, row - 1, -1.0);
        add(true, row, 6.0);
        add(i < m - 1, row + 1, -1.0);
        add(j < m - 1, row + m, -1.0);
        add(k < m - 1, row + m * m, -1.0);
        A.row_begin.push_back(static_cast<std::int64_t>(A.value.size()));
      }
  return A;
}

/// Extreme eigenvalues of laplacian(m), by the formula above with k = 1 and k = m.
inline double smallest_laplacian_eigenvalue(Index m) {
  return 12.0 * std::pow(std::sin(std::numbers::pi / (2.0 * (m + 1.0))), 2);
}
inline double largest_laplacian_eigenvalue(Index m) {
  return 12.0 * std::pow(std::sin(m * std::numbers::pi / (2.0 * (m + 1.0))), 2);
}

/// Uniform numbers in [-1, 1).
inline std::vector<double> random_vector(std::size_t n, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> v(n);
  for (double& x : v) x = uniform(engine);
  return v;
}

/// Dense symmetric positive definite G G^T + I with random G; its eigenvalues lie in [1, 1 + n^2].
inline std::vector<double> random_spd(std::size_t n, unsigned seed) {
  const std::vector<double> G = random_vector(n * n, seed);
  std::vector<double> A(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) A[i * n + j] += G[i * n + k] * G[j * n + k];
      if (i == j) A[i * n + j] += 1.0;
    }
  return A;
}

/// A x for a dense matrix, row by row.
inline std::vector<double> product(const std::vector<double>& A, const std::vector<double>& x) {
  const std::size_t n = x.size();
  std::vector<double> y(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) y[i] += A[i * n + j] * x[j];
  return y;
}

/// Largest |a_i - b_i|
inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = a.size() == b.size() ? 0.0 : HUGE_VAL;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    const double difference = std::abs(a[i] - b[i]);
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

}  // namespace carom::test
