#include "output/data_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>

namespace carom {

namespace {

/// What a terminal shows of UTF-8: its bytes but those that continue a character.
std::size_t shown_width(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// One line of cells, each through `cell`.
template <class Cell>
std::string joined(const std::vector<std::string>& cells, std::string_view between, const Cell& cell) {
  std::string line;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (c > 0) line += between;
    line += cell(cells[c], c);
  }
  return line;
}

std::vector<std::string> titles_of(const DataTable& table) {
  std::vector<std::string> titles;
  for (const TableColumn& column : table.columns) titles.push_back(column.title);
  return titles;
}

std::string as_text(const DataTable& table) {
  const std::vector<std::string> titles = titles_of(table);
  std::vector<std::size_t> widths;
  for (const std::string& title : titles) widths.push_back(shown_width(title));
  for (const auto& row : table.rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], shown_width(row[c]));
  const auto line = [&](const std::vector<std::string>& cells) {
    const std::string text = joined(cells, "  ", [&](const std::string& cell, std::size_t c) {
      const std::string blanks(widths[c] - shown_width(cell), ' ');
      return table.columns[c].is_number ? blanks + cell : cell + blanks;
    });
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string text = (table.title.empty() ? "" : table.title + "\n") + line(titles);
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string markdown_cell(const std::string& text, std::size_t /*column*/) {
  std::string safe;
  for (const char c : text) {
    if (std::string_view("\\|`*_<>[]").find(c) != std::string_view::npos) safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string as_markdown(const DataTable& table) {
  const auto line = [](const std::vector<std::string>& cells) {
    return "| " + joined(cells, " | ", markdown_cell) + " |\n";
  };
  std::string text = (table.title.empty() ? "" : fmt::format("**{}**\n\n", table.title)) + line(titles_of(table)) + "|";
  for (const TableColumn& column : table.columns) text += column.is_number ? "---:|" : "---|";
  text += "\n";
  for (const auto& row : table.rows) text += line(row);
  return text;
}

struct Spelling {
  std::string_view written, latex;
};

/// What is a command to LaTeX, and what Carom writes beyond ASCII that a plain document does not know.
constexpr std::array<Spelling, 36> kSpellings{{{"\\", "\\textbackslash{}"},
                                               {"{", "\\{"},
                                               {"}", "\\}"},
                                               {"$", "\\$"},
                                               {"&", "\\&"},
                                               {"#", "\\#"},
                                               {"%", "\\%"},
                                               {"_", "\\_"},
                                               {"^", "\\textasciicircum{}"},
                                               {"~", "\\textasciitilde{}"},
                                               {"<", "$<$"},
                                               {">", "$>$"},
                                               {"|", "$|$"},
                                               {"[", "{[}"},  // would be an option of the row's end before it
                                               {"*", "{*}"},  // likewise
                                               {"…", "\\ldots{}"},
                                               {"\n", " "},
                                               {"–", "--"},
                                               {"−", "$-$"},
                                               {"±", "$\\pm$"},
                                               {"≤", "$\\le$"},
                                               {"·", "$\\cdot$"},
                                               {"µ", "$\\mu$"},
                                               {"✓", "passed"},
                                               {"✗", "failed"},
                                               {"⁻", "$^{-}$"},
                                               {"⁰", "$^0$"},
                                               {"¹", "$^1$"},
                                               {"²", "$^2$"},
                                               {"³", "$^3$"},
                                               {"⁴", "$^4$"},
                                               {"⁵", "$^5$"},
                                               {"⁶", "$^6$"},
                                               {"⁷", "$^7$"},
                                               {"⁸", "$^8$"},
                                               {"⁹", "$^9$"}}};

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// The exponent that begins at a position of "1.2e-09": how many characters it has, and the power; 0 where none does.
struct Exponent {
  std::size_t length = 0;
  int power = 0;
};
Exponent exponent_at(std::string_view text, std::size_t at) {
  if (at == 0 || text[at] != 'e' || !is_digit(text[at - 1])) return {};
  std::size_t begin = at - 1;  // of the number, which is no end of a word
  while (begin > 0 && (is_digit(text[begin - 1]) || text[begin - 1] == '.')) --begin;
  if (begin > 0 && std::isalpha(static_cast<unsigned char>(text[begin - 1])) != 0) return {};
  std::size_t end = at + 1;
  const bool is_signed = end < text.size() && (text[end] == '-' || text[end] == '+');
  if (is_signed) ++end;
  int power = 0;
  const std::size_t first = end;
  while (end < text.size() && is_digit(text[end]) && end < first + 3) power = 10 * power + (text[end++] - '0');
  if (end == first || (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end])) != 0)) return {};
  return {end - at, is_signed && text[at + 1] == '-' ? -power : power};
}

std::string latex_cell(const std::string& text, std::size_t /*column*/) {
  std::string latex;
  for (std::size_t i = 0; i < text.size();) {
    if (const Exponent exponent = exponent_at(text, i); exponent.length > 0) {
      latex += fmt::format("$\\cdot 10^{{{}}}$", exponent.power);
      i += exponent.length;
      continue;
    }
    if (text[i] == '-' && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '(') && i + 1 < text.size() &&
        is_digit(text[i + 1])) {
      latex += "$-$";
      ++i;
      continue;
    }
    const auto* const found = std::find_if(
        kSpellings.begin(), kSpellings.end(),
        [rest = std::string_view(text).substr(i)](const Spelling& s) { return rest.starts_with(s.written); });
    latex += found == kSpellings.end() ? std::string_view(&text[i], 1) : found->latex;
    i += found == kSpellings.end() ? 1 : found->written.size();
  }
  return latex;
}

std::string as_latex(const DataTable& table) {
  const auto line = [](const std::vector<std::string>& cells) { return joined(cells, " & ", latex_cell) + " \\\\\n"; };
  std::string text = table.title.empty() ? "" : fmt::format("% {}\n", table.title);
  text += "\\begin{tabular}{";
  for (const TableColumn& column : table.columns) text += column.is_number ? 'r' : 'l';
  text += "}\n\\hline\n" + line(titles_of(table)) + "\\hline\n";
  for (const auto& row : table.rows) text += line(row);
  return text + "\\hline\n\\end{tabular}\n";
}

std::string as_csv(const DataTable& table) {
  const auto line = [](const std::vector<std::string>& cells) {
    return joined(cells, ",", [](const std::string& cell, std::size_t) { return csv_field(cell); }) + "\n";
  };
  std::string text = line(titles_of(table));
  for (const auto& row : table.rows) text += line(row);
  return text;
}

struct Format {
  std::string_view name;
  std::string (*write)(const DataTable& table);
};
constexpr std::array<Format, 4> kFormats{
    {{"text", as_text}, {"markdown", as_markdown}, {"latex", as_latex}, {"csv", as_csv}}};

}  // namespace

std::vector<std::string> table_formats() {
  std::vector<std::string> names;
  for (const Format& format : kFormats) names.emplace_back(format.name);
  return names;
}

std::string format_table(const DataTable& table, std::string_view format) {
  const auto* const found =
      std::find_if(kFormats.begin(), kFormats.end(), [format](const Format& f) { return f.name == format; });
  return (found == kFormats.end() ? kFormats.begin() : found)->write(table);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace carom
