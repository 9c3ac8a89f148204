#include "report/csv_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>

namespace carom {

namespace {

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> names;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    names.emplace_back(line.substr(begin, comma - begin));
    if (comma == std::string_view::npos) return names;
    begin = comma + 1;
  }
}

/// Exactly row.size() numbers separated by commas and nothing else.
bool parse_row(std::string_view line, std::vector<double>& row) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto [next, error] = std::from_chars(at, end, row[i]);
    if (error != std::errc()) return false;
    const bool last = i + 1 == row.size();
    if (last) return next == end;
    if (next == end || *next != ',') return false;
    at = next + 1;
  }
  return line.empty();
}

}  // namespace

const std::vector<double>* CsvTable::column(std::string_view name) const {
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c] == name) return &values[c];
  }
  return nullptr;
}

std::optional<CsvTable> read_csv(const std::string& path, std::string_view first) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  CsvTable table;
  std::vector<double> row;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const bool cut = stream.eof();  // the last line has no end
    if (line.starts_with("#")) {
      const std::size_t text = line.find_first_not_of(' ', 1);
      table.comments.push_back(text == std::string::npos ? "" : line.substr(text));
      if (auto units = parse_units_comment(table.comments.back())) table.units = units;
    } else if (table.columns.empty()) {
      table.columns = split(line);
      table.values.resize(table.columns.size());
      row.resize(table.columns.size());
      if (cut || table.columns.front() != first) {
        table.damage = fmt::format("line {} is not a line of column names beginning with {}", number, first);
        return table;
      }
    } else if (cut || !parse_row(line, row)) {
      table.damage = fmt::format("line {} is not a whole row; it and what follows were left out", number);
      return table;
    } else {
      for (std::size_t c = 0; c < row.size(); ++c) table.values[c].push_back(row[c]);
    }
  }
  if (table.columns.empty()) table.damage = "the file is empty";
  return table;
}

}  // namespace carom
