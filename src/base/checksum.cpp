#include "base/checksum.hpp"

#include <array>
#include <cstddef>

namespace carom {

namespace {

constexpr std::size_t slices = 16;
/// [k][byte]: what the byte leaves after k more bytes.
using Tables = std::array<std::array<std::uint64_t, 256>, slices>;

constexpr Tables make_tables() {
  constexpr std::uint64_t reflected = 0xC96C5795D7870F42U;  // of 0x42F0E1EBA9EA3693, ECMA-182, annex B
  Tables tables{};
  for (std::uint64_t byte = 0; byte < 256; ++byte) {
    std::uint64_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest & 1U) != 0 ? (rest >> 1U) ^ reflected : rest >> 1U;
    tables[0][byte] = rest;
  }
  for (std::size_t k = 1; k < slices; ++k)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint64_t before = tables[k - 1][byte];
      tables[k][byte] = tables[0][before & 0xFFU] ^ (before >> 8U);
    }
  return tables;
}

constexpr Tables tables = make_tables();

}  // namespace

/// Sixteen bytes at a time (Kounavis and Berry, IEEE Transactions on Computers 57, 2008).
std::uint64_t checksum_of_bytes(const void* data, std::size_t bytes, std::uint64_t before) {
  const auto* next = static_cast<const unsigned char*>(data);
  std::uint64_t rest = ~before;
  for (; bytes >= slices; bytes -= slices, next += slices) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < slices; ++i) {
      const std::uint64_t carried = i < 8 ? rest >> (8 * i) : 0;
      sum ^= tables[slices - 1 - i][(carried ^ next[i]) & 0xFFU];
    }
    rest = sum;
  }
  for (std::size_t i = 0; i < bytes; ++i) rest = tables[0][(rest ^ next[i]) & 0xFFU] ^ (rest >> 8U);
  return ~rest;
}

}  // namespace carom
