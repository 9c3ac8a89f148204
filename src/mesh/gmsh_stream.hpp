// The same sequence of values from the text and from the binary flavour of a Gmsh file.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "mesh/gmsh_cursor.hpp"

namespace carom {

/// How many values one item of a list has at least, to compare a declared count with the bytes that are left.
struct GmshLayout {
  std::size_t integers = 0, sizes = 0, reals = 0;
};

/// Throws CaseError when `count` is negative or its items cannot fit into the rest of the file.
inline void check_declared(const GmshCursor& at, std::int64_t count, std::size_t bytes_each, std::string_view items) {
  if (count < 0)
    at.fail(fmt::format("{} {}", count, items), "a count that is not negative", "The file is damaged; write it again.");
  if (static_cast<std::uint64_t>(count) > at.remaining() / std::max<std::size_t>(bytes_each, 1))
    at.fail(fmt::format("{} {} declared with {} bytes left in the file", count, items, at.remaining()),
            fmt::format("at most {}", at.remaining() / std::max<std::size_t>(bytes_each, 1)),
            "The count is wrong or the file cut off; write or copy it again.");
}

/// Values as words of text, one record per line.
class GmshText {
 public:
  explicit GmshText(GmshCursor& at) : at_(at) {}

  GmshCursor& cursor() { return at_; }
  void begin_data() {}
  void next_record() { at_.next_record(); }
  void end_record() { at_.end_record(); }
  std::int64_t integer(std::string_view what) { return at_.integer(what); }
  std::int64_t size(std::string_view what) { return at_.integer(what); }
  double real(std::string_view what) { return at_.real(what); }
  void check_count(std::int64_t count, const GmshLayout& each, std::string_view items) const {
    check_declared(at_, count, 2 * (each.integers + each.sizes + each.reals), items);
  }

 private:
  GmshCursor& at_;
};

/// Values as 4-byte integers, 8-byte sizes and 8-byte reals, in the file's byte order.
class GmshBinary {
 public:
  GmshBinary(GmshCursor& at, std::endian order) : at_(at), order_(order) {}

  GmshCursor& cursor() { return at_; }
  void begin_data() { at_.next_line(); }
  void next_record() {}
  void end_record() {}
  std::int64_t integer(std::string_view what) { return value<std::int32_t>(what); }
  std::int64_t size(std::string_view what) { return value<std::int64_t>(what); }
  double real(std::string_view what) { return value<double>(what); }
  void check_count(std::int64_t count, const GmshLayout& each, std::string_view items) const {
    check_declared(at_, count, 4 * each.integers + 8 * (each.sizes + each.reals), items);
  }

 private:
  template <class T>
  T value(std::string_view what) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), at_.raw(sizeof(T), what).data(), sizeof(T));
    if (order_ != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  GmshCursor& at_;
  std::endian order_;
};

}  // namespace carom
