#include "base/page_memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

namespace carom {

void release_pages(std::span<double> values) {
  static const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  auto* const begin = reinterpret_cast<std::byte*>(values.data());
  const std::size_t bytes = values.size_bytes();
  const std::size_t ahead = std::min(bytes, (page - reinterpret_cast<std::uintptr_t>(begin) % page) % page);
  const std::size_t whole = (bytes - ahead) / page * page;
  // What the system takes back of memory of its own making (malloc, new) it gives as zeros the next time.
  const bool is_given_back = whole > 0 && madvise(begin + ahead, whole, MADV_DONTNEED) == 0;
  const std::size_t first = ahead / sizeof(double), last = is_given_back ? first + whole / sizeof(double) : first;
  std::ranges::fill(values.first(first), 0.0);
  std::ranges::fill(values.subspan(last), 0.0);
}

std::vector<double> unwritten_zeros(std::size_t n) {
  constexpr std::size_t piece = 1U << 17U;  // 1 MB, which takes memory for a moment: vectors write their zeros
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
