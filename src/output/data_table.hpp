// Tables as terminals, papers and spreadsheets have them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace carom {

struct TableColumn {
  std::string title;
  bool is_number = false;  ///< stands at the right
};

/// A table whose cells are texts with as many digits as are to be read; every row has a cell for each column.
struct DataTable {
  std::string title;
  std::vector<TableColumn> columns;
  std::vector<std::vector<std::string>> rows;
};

/// The names of the formats, the one for the terminal first: text, markdown, latex, csv.
std::vector<std::string> table_formats();

/// The table in one of these formats:
/// - text: columns of equal width below the title;
/// - markdown: a table with pipes (GitHub Flavored Markdown, section 4.10) below the title in bold;
/// - latex: a `tabular`, its title a comment, which needs no package; what LaTeX reads as commands is escaped, 1e-9
///   becomes a power of ten and what Carom writes beyond ASCII what LaTeX knows;
/// - csv: fields quoted where they must be (RFC 4180), without the title.
std::string format_table(const DataTable& table, std::string_view format);

/// An entry of a table as a field of CSV (RFC 4180).
std::string csv_field(const std::string& text);

}  // namespace carom
