#pragma once

#include <algorithm>
#include <vector>

#include "parallel/threads.hpp"

namespace carom {

inline constexpr std::size_t reduction_block = 2048;

template <class Term>
double parallel_sum(std::size_t n, const Term& term) {
  const auto sum_range = [&term](std::size_t begin, std::size_t end) {
    double s = 0.0;
    for (std::size_t i = begin; i < end; ++i) s += term(i);
    return s;
  };
  if (n <= reduction_block) return sum_range(0, n);
  std::vector<double> partial((n + reduction_block - 1) / reduction_block);
  parallel_for(n, reduction_block,
               [&](std::size_t b, std::size_t e) { partial[b / reduction_block] = sum_range(b, e); });
  double s = 0.0;
  for (const double p : partial) s += p;
  return s;
}

template <std::size_t N, class Add>
std::array<double, N> parallel_sums(std::size_t n, const Add& add) {
  const auto sum_range = [&add](std::size_t begin, std::size_t end) {
    std::array<double, N> s{};
    for (std::size_t i = begin; i < end; ++i) add(i, s);
    return s;
  };
  if (n <= reduction_block) return sum_range(0, n);
  std::vector<std::array<double, N>> partial((n + reduction_block - 1) / reduction_block);
  parallel_for(n, reduction_block,
               [&](std::size_t b, std::size_t e) { partial[b / reduction_block] = sum_range(b, e); });
  std::array<double, N> s{};
  for (const auto& p : partial) {
    for (std::size_t k = 0; k < N; ++k) s[k] += p[k];
  }
  return s;
}

template <class Term>
double parallel_max(std::size_t n, double lowest, const Term& term) {
  std::vector<double> partial((n + reduction_block - 1) / reduction_block, lowest);
  parallel_for(n, reduction_block, [&](std::size_t b, std::size_t e) {
    for (std::size_t i = b; i < e; ++i) partial[b / reduction_block] = std::max(partial[b / reduction_block], term(i));
  });
  for (const double p : partial) lowest = std::max(lowest, p);
  return lowest;
}

}  // namespace carom
