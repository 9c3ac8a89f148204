#include "mesh/gmsh_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "base/errors.hpp"

namespace carom {

namespace {

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
constexpr bool is_space(char c) {
  return is_blank(c) || c == '\n';
}
constexpr bool is_printable(char c) {
  return c >= 32 && c < 127;
}

/// Text where binary data stand wants another advice than a wrong word.
std::string advice(std::string_view found, std::string otherwise) {
  if (std::all_of(found.begin(), found.end(), is_printable)) return otherwise;
  return "These are binary data; the second number of the header must be 1 for a binary file and 0 for text.";
}

}  // namespace

void GmshCursor::fail(std::string found, std::string expected, std::string suggestion) const {
  const auto place = std::min(failure_, bytes_.size());
  std::string key = section_;
  int line = 0;
  if (locates_by_offset_)
    key += fmt::format("{}byte {}", key.empty() ? "" : ", ", place);
  else
    line = 1 + static_cast<int>(std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(place), '\n'));
  throw CaseError({source_, line, 0}, std::move(key), std::move(found), std::move(expected), std::move(suggestion));
}

void GmshCursor::skip_blanks() {
  while (position_ < bytes_.size() && is_blank(bytes_[position_])) ++position_;
}

void GmshCursor::skip_space() {
  while (position_ < bytes_.size() && is_space(bytes_[position_])) ++position_;
}

std::string GmshCursor::next_section() {
  section_.clear();
  skip_space();
  failure_ = position_;
  if (position_ == bytes_.size()) return "";
  const std::string_view name = word("a section");
  if (name.size() < 2 || name[0] != '$' || name.substr(0, 4) == "$End")
    fail(printable(name), "the beginning of a section, such as $Nodes",
         "Remove what stands between the sections, or compare the counts with the lines of the section before.");
  section_ = name;
  return section_;
}

void GmshCursor::end_section() {
  skip_space();
  failure_ = position_;
  const std::string end = "$End" + section_.substr(1);
  if (position_ == bytes_.size()) fail("the end of the file", end, "The file seems cut off; write or copy it again.");
  const std::string_view found = word(end);
  if (found != end)
    fail(printable(found), end, advice(found, "Compare the count at the beginning of the section with what follows."));
}

void GmshCursor::skip_section() {
  const std::string end = "$End" + section_.substr(1);
  const std::size_t found = bytes_.find(end, position_);
  if (found == std::string_view::npos)
    fail(section_ + " without its end", end, "The file seems cut off; write or copy it again.");
  position_ = found + end.size();
}

void GmshCursor::next_record() {
  skip_space();
}

void GmshCursor::end_record() {
  skip_blanks();
  failure_ = position_;
  if (position_ == bytes_.size() || bytes_[position_] == '\n') return;
  const std::string_view rest = word("the end of the line");
  fail(printable(rest), "the end of the line", "Compare the number of values with the type and the counts before.");
}

std::string_view GmshCursor::word(std::string_view what) {
  skip_blanks();
  failure_ = position_;
  if (position_ == bytes_.size())
    fail("the end of the file", std::string(what), "The file seems cut off; write or copy it again.");
  if (bytes_[position_] == '\n') fail("the end of the line", std::string(what), "A value is missing on this line.");
  const std::size_t begin = position_;
  while (position_ < bytes_.size() && !is_space(bytes_[position_])) ++position_;
  return bytes_.substr(begin, position_ - begin);
}

std::int64_t GmshCursor::integer(std::string_view what) {
  const std::string_view text = word(what);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return value;
  fail(printable(text), fmt::format("{}, an integer", what), advice(text, ""));
}

double GmshCursor::real(std::string_view what) {
  const std::string_view text = word(what);
  double value = 0;
  const char* begin = text.data() + (text.starts_with("+") ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return value;
  if (error == std::errc::result_out_of_range && end == text.data() + text.size())
    return std::strtod(std::string(text).c_str(), nullptr);  // 0 or infinity
  fail(printable(text), fmt::format("{}, a number", what));
}

std::string GmshCursor::quoted(std::string_view what) {
  skip_blanks();
  failure_ = position_;
  const std::size_t line_end = std::min(bytes_.find('\n', position_), bytes_.size());
  const std::string_view rest = bytes_.substr(position_, line_end - position_);
  const std::size_t close = rest.find('"', 1);
  if (!rest.starts_with('"') || close == std::string_view::npos)
    fail(rest.empty() ? "the end of the line" : printable(rest), fmt::format("{} in double quotes", what));
  position_ += close + 1;
  return std::string(rest.substr(1, close - 1));
}

std::string_view GmshCursor::raw(std::size_t count, std::string_view what) {
  failure_ = position_;
  if (count > remaining())
    fail(fmt::format("the end of the file {} bytes on", remaining()), fmt::format("{} ({} bytes)", what, count),
         "The file seems cut off; write or copy it again.");
  position_ += count;
  return bytes_.substr(position_ - count, count);
}

void GmshCursor::next_line() {
  const std::size_t feed = bytes_.find('\n', position_);
  failure_ = position_;
  if (feed == std::string_view::npos)
    fail("the end of the file", "the data of " + section_, "The file seems cut off; write or copy it again.");
  position_ = feed + 1;
}

}  // namespace carom
