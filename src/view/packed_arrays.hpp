// Whole numbers as a text that a page can hold and a browser decodes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace carom {

/// Bytes as base64 (RFC 4648, 4) after compression in zlib's format (RFC 1950), which browsers call "deflate".
std::string base64_deflated(std::string_view bytes);

/// Arrays of whole numbers one after the other, each as differences, small ones of either sign as small numbers
/// (2 d for d >= 0, -2 d - 1 for d < 0), the lowest bytes of all first, then the next ones: what is alike stands
/// together. view_data.js undoes it.
class PackedArrays {
 public:
  /// Differences to the number before. Precondition: numbers fit into `bytes` bytes.
  void add(std::span<const std::uint32_t> numbers, int bytes);
  /// Differences to an earlier array of the same length.
  void add(std::span<const std::uint32_t> numbers, int bytes, std::span<const std::uint32_t> earlier);

  std::size_t size() const { return bytes_.size(); }
  std::string text() const { return base64_deflated(bytes_); }

 private:
  void append(std::span<const std::uint32_t> folded, int bytes);

  std::string bytes_;
};

}  // namespace carom
