// The one door to threads and to reductions. Results do not depend on the number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace carom {

/// Sets the number of threads used from here on (0: all cores that the process may use, or its part of them where
/// other ranks may use them). Returns the number chosen.
int set_threads(int count);
int thread_count();

/// Sets the number of threads of the calling thread for a while, in a process that has other work: what it was comes
/// back at the end.
class ThreadScope {
 public:
  explicit ThreadScope(int count);
  ~ThreadScope();
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;

 private:
  int count_, dynamic_ = 0, levels_ = 0;
};

/// Ends the threads that wait for the next loop of the calling thread.
void release_threads();

/// Part k of a loop, with what it works on.
using LoopPart = void (*)(const void* body, std::size_t k);
/// Calls part(body, k) for every k in [0, count), each thread a contiguous share of them; does not allocate. By OpenMP
/// (loops_openmp.cpp), or by the threads of the standard library (loops_std.cpp, CAROM_STD_THREADS), whose
/// synchronisation the thread sanitizer understands.
void run_parts(std::size_t count, LoopPart part, const void* body);

/// Calls body(begin, end) on contiguous ranges that cover [0, n), in any order and at the same time. The ranges have
/// `grain` entries (the last may be shorter) whatever the number of threads.
template <class Body>
void parallel_for(std::size_t n, std::size_t grain, const Body& body) {
  const auto range = [n, grain, &body](std::size_t k) {
    const std::size_t begin = k * grain;
    body(begin, begin + grain < n ? begin + grain : n);
  };
  const std::size_t count = (n + grain - 1) / grain;
  if (count == 0) return;
  if (count == 1) return range(0);
  run_parts(
      count, [](const void* context, std::size_t k) { (*static_cast<decltype(&range)>(context))(k); }, &range);
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
double sum_of(std::span<const double> values);
/// Largest |value|, 0 of none.
double largest_of(std::span<const double> values);
/// True where every value is 0.
bool is_zero(std::span<const double> values);
/// True where every value is a finite number.
bool is_finite(std::span<const double> values);

}  // namespace carom

#include "parallel/threads_impl.hpp"
