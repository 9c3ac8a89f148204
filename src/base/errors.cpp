#include "base/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace carom {

std::string to_string(const Location& where) {
  if (where.line == 0) return where.file;
  if (where.column == 0) return fmt::format("{}:{}", where.file, where.line);
  return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

namespace {

/// A text that somebody gave, as long as it may stand in a message.
std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 500, kept = 200;
  if (text.size() <= longest) return text;
  std::size_t end = kept;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // within a character of UTF-8
  return fmt::format("{} ... ({} characters)", text.substr(0, end), text.size());
}

std::string case_message(const Location& where, const std::string& key, const std::string& found,
                         const std::string& expected, const std::string& suggestion) {
  std::string text = to_string(where);
  if (!text.empty()) text += ": ";
  if (!key.empty()) text += shortened(key) + ": ";
  text += "found " + shortened(found);
  if (!expected.empty()) text += "; expected " + expected;
  if (!suggestion.empty()) text += ". " + suggestion;
  return text;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
    }
  }
  return row.back();
}

}  // namespace

CaseError::CaseError(Location where, std::string key, std::string found, std::string expected, std::string suggestion)
    : std::runtime_error(case_message(where, key, found, expected, suggestion)),
      where_(std::move(where)),
      key_(std::move(key)),
      found_(std::move(found)),
      expected_(std::move(expected)),
      suggestion_(std::move(suggestion)) {}

RunError::RunError(int step, double time, const std::string& message)
    : std::runtime_error(fmt::format("step {}, t = {:.6g}: {}", step, time, message)), step_(step), time_(time) {}

OutputError::OutputError(const std::string& path, const std::string& reason)
    : std::runtime_error(fmt::format("cannot write {}: {}", path, reason)), path_(path) {}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  const std::size_t limit = std::max<std::size_t>(1, word.size() / 3);
  std::string best;
  std::size_t best_distance = limit + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace carom
