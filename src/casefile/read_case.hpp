// Reading a case file.
#pragma once

#include <string>
#include <string_view>

#include "casefile/case.hpp"
#include "casefile/document.hpp"

namespace carom {

/// Reads and checks the case at `path`. All that can be checked without the mesh is checked: keys, types, ranges,
/// alternatives, and names that refer to other sections. Throws CaseError with file, line, column and dotted key.
Case read_case(const std::string& path);
/// The same, with what is wrong added to `errors`: then what could be read of the case. Throws only where nothing
/// could.
Case read_case(const std::string& path, CaseErrors& errors);

/// The same for a text in memory; `name` stands for the file in messages and in Case::file.
Case parse_case(std::string_view text, const std::string& name);

/// The same for a tree of values, whatever it was written in; their places are those of the messages.
Case case_of(const Node& root, const std::string& name);
Case case_of(const Node& root, const std::string& name, CaseErrors& errors);

}  // namespace carom
