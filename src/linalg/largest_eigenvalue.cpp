#include "linalg/largest_eigenvalue.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "linalg/lapack.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

constexpr std::size_t vector_grain = 4096;

struct RitzPair {
  double value = 0.0;
  double last_component = 0.0;  ///< of the unit eigenvector of the tridiagonal matrix
};

/// Largest eigenpair of the symmetric tridiagonal matrix with the given diagonal and off-diagonal.
RitzPair largest_ritz_pair(std::vector<double> diagonal, std::vector<double> off_diagonal) {
  const int n = static_cast<int>(diagonal.size());
  const auto size = diagonal.size();
  std::vector<double> eigenvalues(size), vector(size), work(5 * size);
  std::vector<int> integer_work(5 * size), failed(size);
  off_diagonal.resize(size);
  const double unused = 0.0;
  int found = 0, info = 0;
  dstevx_("V", "I", &n, diagonal.data(), off_diagonal.data(), &unused, &unused, &n, &n, &unused, &found,
          eigenvalues.data(), vector.data(), &n, work.data(), integer_work.data(), failed.data(), &info);
  // A vector that did not converge only costs iterations: its last component is then taken as 1.
  return {eigenvalues[0], info == 0 ? std::abs(vector.back()) : 1.0};
}

/// Uniform pseudo-random number in [-1, 1) from the position alone (splitmix64, Steele, Lea and Flood 2014).
double random_entry(std::uint64_t i) {
  std::uint64_t z = (i + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-52 - 1.0;
}

/// v /= length
void divide(std::vector<double>& v, double length) {
  parallel_for(v.size(), vector_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) v[i] /= length;
  });
}

std::vector<double> start_vector(std::size_t n) {
  std::vector<double> v(n);
  parallel_for(n, vector_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) v[i] = random_entry(i);
  });
  divide(v, std::sqrt(dot(v, v)));
  return v;
}

}  // namespace

EigenvalueEstimate largest_eigenvalue(const LinearOperator& A, std::size_t n, double tolerance, int max_iterations) {
  EigenvalueEstimate estimate;
  if (n == 0) return estimate;
  std::vector<double> v = start_vector(n), v_old(n, 0.0), w(n), diagonal, off_diagonal;
  double beta = 0.0;
  while (estimate.iterations < max_iterations) {
    A(v, w);
    diagonal.push_back(dot(v, w));
    const double alpha = diagonal.back();
    beta = std::sqrt(parallel_sum(n, [&](std::size_t i) {
      w[i] -= alpha * v[i] + beta * v_old[i];
      return w[i] * w[i];
    }));
    ++estimate.iterations;
    if (!std::isfinite(alpha) || !std::isfinite(beta)) return {alpha + beta, alpha + beta, estimate.iterations};
    const RitzPair ritz = largest_ritz_pair(diagonal, off_diagonal);
    const double residual = beta * ritz.last_component;
    estimate.value = ritz.value;
    estimate.upper = ritz.value + residual;
    if (residual <= tolerance * std::abs(ritz.value) || beta == 0.0) break;
    off_diagonal.push_back(beta);
    divide(w, beta);
    std::swap(v_old, v);
    std::swap(v, w);
  }
  return estimate;
}

}  // namespace carom
