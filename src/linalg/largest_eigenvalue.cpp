#include "linalg/largest_eigenvalue.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "linalg/lapack.hpp"

namespace carom {

namespace {

struct RitzPair {
  double value = 0.0;
  std::vector<double> vector;  ///< unit eigenvector of the tridiagonal matrix
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
  if (info != 0) vector.back() = 1.0;
  return {eigenvalues[0], vector};
}

/// Uniform pseudo-random number in [-1, 1) from the position alone (splitmix64, Steele, Lea and Flood 2014).
double random_entry(std::uint64_t i) {
  std::uint64_t z = (i + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-52 - 1.0;
}

std::vector<double> random_vector(const Entries& entries) {
  std::vector<double> v = entries.zeros();
  entries.each([&](std::size_t i) { v[i] = random_entry(i); });
  return v;
}

/// The three-term recurrence in the inner product of M: v_k are M-orthonormal.
class Lanczos {
 public:
  Lanczos(const Pencil& pencil, const Entries& entries, std::vector<double> start)
      : pencil_(pencil),
        entries_(entries),
        v_(std::move(start)),
        v_old_(entries.zeros()),
        w_(entries.zeros()),
        Kv_(entries.zeros()) {
    beta_ = normalise(v_);
  }

  bool is_finished() const { return beta_ == 0.0; }

  /// One more iteration; the estimate so far.
  EigenvalueEstimate iterate() {
    if (!diagonal_.empty()) off_diagonal_.push_back(beta_);
    pencil_.K(v_, Kv_);
    const double alpha = entries_.dot(v_, Kv_);
    diagonal_.push_back(alpha);
    pencil_.M_inverse(Kv_, w_);
    const double beta_before = diagonal_.size() > 1 ? beta_ : 0.0;
    entries_.each([&](std::size_t i) { w_[i] -= alpha * v_[i] + beta_before * v_old_[i]; });
    std::swap(v_old_, v_);
    std::swap(v_, w_);
    beta_ = normalise(v_);
    const int k = static_cast<int>(diagonal_.size());
    if (!std::isfinite(alpha) || !std::isfinite(beta_)) {
      beta_ = 0.0;
      return {alpha, alpha, k};
    }
    const RitzPair ritz = largest_ritz_pair(diagonal_, off_diagonal_);
    return {ritz.value, ritz.value + beta_ * std::abs(ritz.vector.back()), k};
  }

 private:
  /// v /= |v|_M; returns |v|_M. Kv is over.
  double normalise(std::vector<double>& v) {
    std::vector<double>& Mv = Kv_;
    pencil_.M(v, Mv);
    const double length = std::sqrt(entries_.dot(v, Mv));
    if (length > 0.0) entries_.each([&](std::size_t i) { v[i] /= length; });
    return length;
  }

  const Pencil& pencil_;
  const Entries& entries_;
  std::vector<double> v_, v_old_, w_, Kv_, diagonal_, off_diagonal_;
  double beta_ = 0.0;
};

/// A vector without components on what M_inverse leaves out.
std::vector<double> start_vector(const Pencil& pencil, const Entries& entries) {
  std::vector<double> v = entries.zeros();
  pencil.M_inverse(random_vector(entries), v);
  return v;
}

}  // namespace

EigenvalueEstimate largest_eigenvalue(const Pencil& pencil, const Entries& entries, double tolerance,
                                      int max_iterations, int least_iterations) {
  EigenvalueEstimate estimate;
  if (entries.count() == 0) return estimate;
  Lanczos lanczos(pencil, entries, start_vector(pencil, entries));
  while (!lanczos.is_finished() && estimate.iterations < max_iterations) {
    estimate = lanczos.iterate();
    const bool is_near = estimate.upper - estimate.value <= tolerance * std::abs(estimate.value);
    if (is_near && estimate.iterations >= least_iterations) break;
  }
  return estimate;
}

EigenvalueEstimate largest_eigenvalue(const LinearOperator& A, const Entries& entries, double tolerance,
                                      int max_iterations, int least_iterations) {
  const LinearOperator identity = [](std::span<const double> x, std::span<double> y) {
    std::copy(x.begin(), x.end(), y.begin());
  };
  return largest_eigenvalue({A, identity, identity}, entries, tolerance, max_iterations, least_iterations);
}

}  // namespace carom
