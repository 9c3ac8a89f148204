// Loops over the entries of vectors, and their sums, as iterative solvers need them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "parallel/holding.hpp"
#include "parallel/threads.hpp"

namespace carom {

/// The entries of vectors that every rank has whole, or of those whose items ranks share out (three entries each):
/// what is asked for is then done for the items that this rank holds. Keeps no copy of the Holding.
class Entries {
 public:
  Entries(std::size_t count) : count_(count) {}  // NOLINT(google-explicit-constructor): a plain vector has just a size
  explicit Entries(const Holding& items) : count_(3 * items.size()), items_(&items) {}

  std::size_t count() const { return count_; }
  /// Calls body(i) for every entry, in any order and at the same time.
  template <class Body>
  void each(const Body& body) const {
    if (items_ == nullptr) return parallel_each(count_, body);
    items_->each_range([&](std::size_t begin, std::size_t end) {
      for (std::size_t i = 3 * begin; i < 3 * end; ++i) body(i);
    });
  }
  /// The sum of term(i) over all entries of all ranks, with the same bits for any number of ranks and threads; calls
  /// term for each entry of this one, so that it may change vectors on the way. All ranks call it.
  template <class Term>
  double sum(const Term& term) const;
  double dot(std::span<const double> a, std::span<const double> b) const {
    return sum([&](std::size_t i) { return a[i] * b[i]; });
  }
  /// Afterwards the vector is whole on every rank. All ranks call it.
  void complete(std::span<double> values) const {
    if (items_ != nullptr) items_->complete(values);
  }
  /// Holding::spoil.
  void spoil(std::span<double> values) const {
    if (items_ != nullptr) items_->spoil(values);
  }
  /// As many zeros as there are entries; where items are shared out they take memory once they are written to.
  std::vector<double> zeros() const {
    std::vector<double> values;
    if (items_ != nullptr)
      items_->resize(values);
    else
      values.resize(count_);
    return values;
  }

 private:
  std::size_t count_;
  const Holding* items_ = nullptr;
};

template <class Term>
double Entries::sum(const Term& term) const {
  if (items_ == nullptr) return parallel_sum(count_, term);
  items_->each_range_beside([&](std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) term(i);
  });
  const std::array<double, 3> sums = items_->sums<3>([&](std::size_t n, std::array<double, 3>& s) {
    for (std::size_t c = 0; c < 3; ++c) s[c] += term(3 * n + c);
  });
  return sums[0] + sums[1] + sums[2];
}

}  // namespace carom
