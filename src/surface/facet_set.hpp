// Some of the facets of a surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Facets per task of a thread that places them: some ten microseconds of work.
inline constexpr std::size_t facet_grain = 512;

/// A set of facets by their numbers, as flags and as a list.
class FacetSet {
 public:
  /// Of the facets below `count`, those with whose numbers `name_all` calls what it is given.
  template <class NameAll>
  void assign(std::size_t count, const NameAll& name_all) {
    is_in_.assign(count, 0);
    name_all([this](Index f) { is_in_[f] = 1; });
    numbers_.clear();
    for (std::size_t f = 0; f < count; ++f)
      if (is_in_[f] != 0) numbers_.push_back(static_cast<Index>(f));
  }

  bool contains(Index f) const { return is_in_[f] != 0; }
  /// Increasing.
  std::span<const Index> numbers() const { return numbers_; }

 private:
  std::vector<std::uint8_t> is_in_;
  std::vector<Index> numbers_;
};

}  // namespace carom
