// The one door to threads and to reductions. Results do not depend on the number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace carom {

/// Sets the number of threads used from here on (0: all cores the process may use). Returns the number chosen.
int set_threads(int count);
int thread_count();

/// Calls body(begin, end) on contiguous ranges that cover [0, n), in any order and at the same time. The ranges have
/// `grain` entries (the last may be shorter) whatever the number of threads.
template <class Body>
void parallel_for(std::size_t n, std::size_t grain, const Body& body) {
  const auto chunks = static_cast<std::ptrdiff_t>((n + grain - 1) / grain);
#pragma omp parallel for schedule(static) if (chunks > 1)
  for (std::ptrdiff_t c = 0; c < chunks; ++c) {
    const std::size_t begin = static_cast<std::size_t>(c) * grain;
    body(begin, begin + grain < n ? begin + grain : n);
  }
}

/// A grain for loops over vectors: some microseconds a range.
inline constexpr std::size_t vector_grain = 4096;

/// Calls body(i) for every i in [0, n), in any order and at the same time.
template <class Body>
void parallel_each(std::size_t n, const Body& body) {
  parallel_for(n, vector_grain, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Sum of term(i) over [0, n), by blocks of fixed size added in a fixed order: the same bits for any thread count.
template <class Term>
double parallel_sum(std::size_t n, const Term& term);

/// N sums in one pass: add(i, sums) adds the terms of entry i. Same order of summation as parallel_sum.
template <std::size_t N, class Add>
std::array<double, N> parallel_sums(std::size_t n, const Add& add);

/// Largest term(i) over [0, n), or `lowest` when n == 0.
template <class Term>
double parallel_max(std::size_t n, double lowest, const Term& term);

/// a . b
double dot(std::span<const double> a, std::span<const double> b);

}  // namespace carom

#include "parallel/threads_impl.hpp"
