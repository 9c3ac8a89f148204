// Bounds of eigenvalues of the matrices of a batch of cells, over a number type.
#pragma once

#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp. Entry (r, s) of a matrix of n rows stands at [(n r + s) lanes].
namespace carom {

/// |A| in the largest absolute row sum.
template <class Real>
static Real largest_row_sum(int n, const double* A) {
  Real largest{};
  for (int r = 0; r < n; ++r) {
    Real sum{};
    for (int s = 0; s < n; ++s) {
      const Real entry = load<Real>(A + (n * r + s) * lanes<Real>);
      sum += entry < 0.0 ? -entry : entry;
    }
    largest = sum > largest ? sum : largest;
  }
  return largest;
}

/// square = A A, three columns at a time; n is a multiple of 3.
template <class Real>
static void square_matrix(int n, const double* A, double* square) {
  constexpr int columns = 3;
  for (int r = 0; r < n; ++r) {
    for (int s = 0; s < n; s += columns) {
      Real sum[columns] = {};
      for (int k = 0; k < n; ++k) {
        const Real left = load<Real>(A + (n * r + k) * lanes<Real>);
        for (int j = 0; j < columns; ++j) sum[j] += left * load<Real>(A + (n * k + s + j) * lanes<Real>);
      }
      for (int j = 0; j < columns; ++j) store(square + (n * r + s + j) * lanes<Real>, sum[j]);
    }
  }
}

/// bound[lane] = |A^8|^(1/8) of matrices of n rows, n a multiple of 3. Any power bounds the spectral radius (Gelfand;
/// the first is Gershgorin's bound); the eighth is at most n^(1/16) times too large, 1.22 for HEXA8. Overwrites A and
/// work, which is as large.
template <class Real>
static void power_bound(int n, double* A, double* work, double* bound) {
  const Real gershgorin = largest_row_sum<Real>(n, A), scale = gershgorin > 0.0 ? gershgorin : Real{} + 1.0;
  for (int k = 0; k < n * n; ++k)  // no power of it overflows
    store(A + k * lanes<Real>, Real(load<Real>(A + k * lanes<Real>) / scale));
  square_matrix<Real>(n, A, work);
  square_matrix<Real>(n, work, A);
  square_matrix<Real>(n, A, work);
  const Real second = square_root(largest_row_sum<Real>(n, work)), fourth = square_root(second);
  store(bound, Real(gershgorin * square_root(fourth)));
}

}  // namespace carom
