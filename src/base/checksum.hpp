// A checksum that sees every small damage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace carom {

/// CRC-64/XZ (polynomial of ECMA-182, reflected): finds every error in up to 64 bits that follow each other, and any
/// other but for one in 2^64. Of bytes that follow those with the checksum `before`.
std::uint64_t checksum_of_bytes(const void* data, std::size_t bytes, std::uint64_t before = 0);
inline std::uint64_t checksum(std::string_view text, std::uint64_t before = 0) {
  return checksum_of_bytes(text.data(), text.size(), before);
}

}  // namespace carom
