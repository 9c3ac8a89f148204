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

/// A line for each error, and how many there are.
std::string joined(const std::vector<CaseError>& all) {
  constexpr std::size_t most = 50;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) text += fmt::format("{}\n", all[i].what());
  if (all.size() > most) text += fmt::format("and {} more\n", all.size() - most);
  return text + fmt::format("{} errors", all.size());
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

CaseError::CaseError(std::vector<CaseError> all)
    : std::runtime_error(joined(all)),
      where_(all.front().where_),
      key_(all.front().key_),
      found_(all.front().found_),
      expected_(all.front().expected_),
      suggestion_(all.front().suggestion_),
      all_(std::make_shared<const std::vector<CaseError>>(std::move(all))) {}

const std::vector<CaseError>& CaseError::all() const {
  static const std::vector<CaseError> none;
  return all_ == nullptr ? none : *all_;
}

void CaseErrors::add(const CaseError& error) {
  for (const CaseError& each : error.all()) add(each);
  const auto is_same = [&](const CaseError& other) { return std::string_view(other.what()) == error.what(); };
  if (!error.all().empty() || std::any_of(errors_.begin(), errors_.end(), is_same)) return;
  const auto is_behind = [&](const CaseError& other) {
    return other.where().file == error.where().file && other.where().line > error.where().line;
  };
  errors_.insert(std::find_if(errors_.begin(), errors_.end(), is_behind), error);
}

void CaseErrors::check() const {
  if (errors_.empty()) return;
  if (errors_.size() == 1) throw CaseError(errors_.front());
  throw CaseError(errors_);
}

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
