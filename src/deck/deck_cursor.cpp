#include "deck/deck_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/terminal_text.hpp"

namespace carom {

namespace {

constexpr bool is_gap(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view without_gaps(std::string_view text) {
  while (!text.empty() && is_gap(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_gap(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<std::int64_t> as_integer(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return value;
  return std::nullopt;
}

std::optional<double> as_real(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error == std::errc{} && end == last) return std::isfinite(value) ? std::optional(value) : std::nullopt;
  if (error == std::errc::result_out_of_range && end == last) {
    value = std::strtod(std::string(text).c_str(), nullptr);  // 0 or infinity
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  if (error == std::errc{} && (*end == 'D' || *end == 'd')) {
    std::string with_e(text);
    with_e[static_cast<std::size_t>(end - text.data())] = 'e';
    return as_real(with_e);
  }
  return std::nullopt;
}

bool DeckCursor::next_line() {
  while (chunk_ < keyword_.data.size()) {
    const DeckChunk& chunk = keyword_.data[chunk_];
    if (position_ == 0) next_number_ = chunk.first_line, file_ = chunk.file;
    while (position_ < chunk.text.size()) {
      const char* const begin = chunk.text.data() + position_;
      const std::size_t left = chunk.text.size() - position_;
      const auto* const feed = static_cast<const char*>(std::memchr(begin, '\n', left));
      const std::size_t length = feed == nullptr ? left : static_cast<std::size_t>(feed - begin);
      position_ += feed == nullptr ? left : length + 1;
      line_ = {begin, length};
      line_number_ = next_number_++;
      const std::string_view content = line();
      rest_begin_ = 0;
      if (!content.empty() && !content.starts_with("**")) return true;
    }
    ++chunk_;
    position_ = 0;
  }
  return false;
}

std::string_view DeckCursor::line() const {
  return without_gaps(line_);
}

std::string_view DeckCursor::field() {
  if (at_end()) return {};
  const std::size_t comma = std::min(line_.find(',', rest_begin_), line_.size());
  std::string_view text = without_gaps(line_.substr(rest_begin_, comma - rest_begin_));
  rest_begin_ = comma + 1;
  // A comma at the end of a line begins no field.
  if (without_gaps(line_.substr(std::min(rest_begin_, line_.size()))).empty()) rest_begin_ = line_.size() + 1;
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

std::int64_t DeckCursor::integer(std::string_view what) {
  const std::string_view text = field();
  if (const auto value = as_integer(text)) return *value;
  fail(text.empty() ? "nothing" : printable(text), fmt::format("{}, an integer", what));
}

double DeckCursor::real(std::string_view what) {
  const std::string_view text = field();
  if (const auto value = as_real(text)) return *value;
  fail(text.empty() ? "nothing" : printable(text), fmt::format("{}, a finite number", what));
}

double DeckCursor::real_or(double otherwise, std::string_view what) {
  const std::string_view text = field();
  if (text.empty()) return otherwise;
  if (const auto value = as_real(text)) return *value;
  fail(printable(text), fmt::format("{}, a finite number", what));
}

void DeckCursor::end_line(std::string expected) {
  while (!at_end())
    if (const std::string_view text = field(); !text.empty())
      fail(printable(text) + " behind the others", std::move(expected));
}

Location DeckCursor::where() const {
  return file_ == nullptr ? keyword_.where : Location{*file_, line_number_, 0};
}

void DeckCursor::fail(std::string found, std::string expected, std::string suggestion) const {
  throw CaseError(where(), "*" + keyword_.name, std::move(found), std::move(expected), std::move(suggestion));
}

}  // namespace carom
