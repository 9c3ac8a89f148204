#include "view/packed_arrays.hpp"

#include <zlib.h>

#include <array>
#include <cassert>
#include <stdexcept>
#include <string_view>

namespace carom {

namespace {

std::string base64(std::span<const unsigned char> bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const auto byte = [&](std::size_t k) { return k < left ? static_cast<unsigned>(bytes[i + k]) : 0U; };
    const unsigned group = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? letters[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

/// Small for small differences of either sign, modulo 2^(8 bytes).
std::uint32_t folded(std::uint32_t difference, int bytes) {
  const int unused = 32 - 8 * bytes;
  const auto d = static_cast<std::int32_t>(difference << unused) >> unused;
  return (static_cast<std::uint32_t>(d) << 1U) ^ static_cast<std::uint32_t>(d >> 31);
}

}  // namespace

std::string base64_deflated(std::string_view bytes) {
  std::vector<unsigned char> out(compressBound(bytes.size()));
  uLongf size = out.size();
  constexpr int level = 6;
  const auto* const from = reinterpret_cast<const Bytef*>(bytes.data());  // NOLINT: zlib's bytes
  if (compress2(out.data(), &size, from, bytes.size(), level) != Z_OK)
    throw std::runtime_error("zlib ran out of memory");
  return base64(std::span(out).first(size));
}

void PackedArrays::add(std::span<const std::uint32_t> numbers, int bytes) {
  std::vector<std::uint32_t> differences(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    differences[i] = folded(numbers[i] - (i == 0 ? 0U : numbers[i - 1]), bytes);
  append(differences, bytes);
}

void PackedArrays::add(std::span<const std::uint32_t> numbers, int bytes, std::span<const std::uint32_t> earlier) {
  assert(earlier.size() == numbers.size());
  std::vector<std::uint32_t> differences(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) differences[i] = folded(numbers[i] - earlier[i], bytes);
  append(differences, bytes);
}

void PackedArrays::append(std::span<const std::uint32_t> folded, int bytes) {
  for (int b = 0; b < bytes; ++b)
    for (const std::uint32_t value : folded) bytes_ += static_cast<char>(value >> static_cast<unsigned>(8 * b) & 255U);
}

}  // namespace carom
