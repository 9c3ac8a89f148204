#include "base/checksum.hpp"

#include <array>

namespace carom {

namespace {

constexpr std::array<std::uint64_t, 256> make_table() {
  constexpr std::uint64_t reflected = 0xC96C5795D7870F42U;  // of 0x42F0E1EBA9EA3693, ECMA-182, annex B
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t byte = 0; byte < 256; ++byte) {
    std::uint64_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest & 1U) != 0 ? (rest >> 1U) ^ reflected : rest >> 1U;
    table[byte] = rest;
  }
  return table;
}

}  // namespace

std::uint64_t checksum_of_bytes(const void* data, std::size_t bytes, std::uint64_t before) {
  static constexpr std::array<std::uint64_t, 256> table = make_table();
  const auto* next = static_cast<const unsigned char*>(data);
  std::uint64_t rest = ~before;
  for (std::size_t i = 0; i < bytes; ++i) rest = table[(rest ^ next[i]) & 0xFFU] ^ (rest >> 8U);
  return ~rest;
}

}  // namespace carom
