#include "base/page_memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

namespace carom {

void release_pages(std::span<double> values) {
  static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(values.data());
  const std::uintptr_t end = begin + values.size_bytes();
  const std::uintptr_t first = (begin + page - 1) / page * page, last = end / page * page;
  const auto place_of = [&](std::uintptr_t address) {
    return values.begin() + static_cast<std::ptrdiff_t>((address - begin) / sizeof(double));
  };
  // What the system takes back of memory of its own making (malloc, new) it gives as zeros the next time.
  if (first >= last || madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED) != 0) {
    std::fill(values.begin(), values.end(), 0.0);
    return;
  }
  std::fill(values.begin(), place_of(first), 0.0);
  std::fill(place_of(last), values.end(), 0.0);
}

std::vector<double> unwritten_zeros(std::size_t n) {
  constexpr std::size_t piece = 1U << 17U;  // 1 MB: what is written in vain takes memory for a moment
  std::vector<double> zeros;
  zeros.reserve(n);
  while (zeros.size() < n) {
    const std::size_t begin = zeros.size();
    zeros.resize(std::min(n, begin + piece));
    release_pages(std::span(zeros).subspan(begin));
  }
  release_pages(zeros);  // and the pages between the pieces
  return zeros;
}

}  // namespace carom
