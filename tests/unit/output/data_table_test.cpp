// Tables in the formats that they are printed in.
#include "output/data_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace carom::output_data_table_test {
namespace {

const DataTable sample{"Forces", {{"who"}, {"force [N]", true}}, {{"a|b", "-1.5e-09"}, {"µ", "12"}}};

// Columns are as wide as their widest cell, counted in characters; numbers stand at the right, no line ends in blanks.
TEST(DataTable, IsAlignedForTheTerminal) {
  EXPECT_EQ(format_table(sample, "text"),
            "Forces\n"
            "who  force [N]\n"
            "a|b   -1.5e-09\n"
            "µ           12\n");
  EXPECT_EQ(format_table({"", {{"who"}, {"how"}}, {{"a", "well"}, {"b", ""}}}, "text"), "who  how\na    well\nb\n");
}

// GitHub Flavored Markdown, section 4.10: a row of delimiters, a colon behind for what stands at the right, pipes of
// the text behind a backslash.
TEST(DataTable, IsATableOfMarkdown) {
  EXPECT_EQ(format_table(sample, "markdown"),
            "**Forces**\n\n"
            "| who | force \\[N\\] |\n"
            "|---|---:|\n"
            "| a\\|b | -1.5e-09 |\n"
            "| µ | 12 |\n");
}

// RFC 4180.
TEST(DataTable, IsQuotedAsCsv) {
  EXPECT_EQ(format_table({"x", {{"a"}, {"b"}}, {{"1,5", "say \"no\""}, {"two\nlines", ""}}}, "csv"),
            "a,b\n\"1,5\",\"say \"\"no\"\"\"\n\"two\nlines\",\n");
}

TEST(DataTable, IsATabularOfLatex) {
  EXPECT_EQ(format_table(sample, "latex"),
            "% Forces\n"
            "\\begin{tabular}{lr}\n"
            "\\hline\n"
            "who & force {[}N] \\\\\n"
            "\\hline\n"
            "a$|$b & $-$1.5$\\cdot 10^{-9}$ \\\\\n"
            "$\\mu$ & 12 \\\\\n"
            "\\hline\n"
            "\\end{tabular}\n");
}

/// What LaTeX would stumble over in a row of a tabular: braces that do not close, formulas that do not end, another
/// number of columns, a command character in the text, or bytes beyond ASCII that Carom itself has written. "":
/// nothing.
std::string trouble_in(const std::string& row, int columns) {
  int depth = 0, ends = 0;
  bool is_formula = false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const char c = row[i];
    if (c == '\\') {
      ++i;
      if (i < row.size() && std::string("{}$&#%_\\").find(row[i]) != std::string::npos) continue;
      if (i < row.size() && std::isalpha(static_cast<unsigned char>(row[i])) != 0) continue;
      return fmt::format("a lone backslash at {}", i);
    }
    if (c == '{') ++depth;
    if (c == '}' && --depth < 0) return fmt::format("a brace too many at {}", i);
    if (c == '$') is_formula = !is_formula;
    if (c == '&') ++ends;
    if ((c == '^' || c == '_') && !is_formula) return fmt::format("a \"{}\" outside of a formula at {}", c, i);
    if (c == '#' || c == '%' || c == '~' || static_cast<unsigned char>(c) >= 128)
      return fmt::format("what LaTeX does not take at {}", i);
  }
  if (depth != 0) return "a brace that is not closed";
  if (is_formula) return "a formula that does not end";
  return ends == columns - 1 ? "" : fmt::format("{} columns", ends + 1);
}

TEST(DataTable, HasNoTextThatLatexStumblesOver) {
  const std::vector<std::string> texts{
      "100 % of A&B",       "x_1^2 ~ #3",           "C:\\runs\\{a}", "$5 < 6 > 4", "[0.0, 1.0]", "*",
      "10⁻¹² kg m²/s³ · 3", "± 5 – 6 − 7 ≤ 8 µm …", "1 ✓",           "2 ✗",        "1e5",        "1.5E5 a1e5 e5 1e",
      "-1e-300 (-2 %)"};
  for (const std::string& text : texts) {
    const std::string table = format_table({"", {{"name"}, {text}}, {{text, text}}}, "latex");
    std::vector<std::string> rows;
    for (std::size_t begin = 0, end = 0; (end = table.find(" \\\\\n", begin)) != std::string::npos; begin = end + 4) {
      const std::size_t line = table.rfind('\n', end) + 1;
      rows.push_back(table.substr(line, end - line));
    }
    ASSERT_EQ(rows.size(), 2U) << table;
    for (const std::string& row : rows) EXPECT_EQ(trouble_in(row, 2), "") << row;
  }
}

// Powers of ten are those of numbers only.
TEST(DataTable, LeavesWordsWithAnE) {
  const auto cell = [](const std::string& text) {
    const std::string table = format_table({"", {{text}}, {}}, "latex");
    const std::size_t begin = table.find("\\hline\n") + 7;
    return table.substr(begin, table.find(" \\\\", begin) - begin);
  };
  EXPECT_EQ(cell("1e5"), "1$\\cdot 10^{5}$");
  EXPECT_EQ(cell("2.5e+06 N"), "2.5$\\cdot 10^{6}$ N");
  for (const char* word : {"a1e5", "e5", "1e", "1ex", "run-2"}) EXPECT_EQ(cell(word), word);
}

TEST(DataTable, HasTheFormatOfTheTerminalFirst) {
  EXPECT_EQ(table_formats(), (std::vector<std::string>{"text", "markdown", "latex", "csv"}));
  EXPECT_EQ(format_table(sample, ""), format_table(sample, "text"));
}

}  // namespace
}  // namespace carom::output_data_table_test
