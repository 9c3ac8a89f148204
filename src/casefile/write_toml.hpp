// A tree of values to TOML text.
#pragma once

#include <functional>
#include <string>

#include "casefile/document.hpp"

namespace carom {

/// TOML text of a root table. Tables of the root and lists of tables get sections of their own, everything below an
/// entry of a list is written inline.
std::string write_toml(const Node& root);

/// The same with lines of comment before each section: what `comment` gives of it, line end included, or "".
using SectionComment = std::function<std::string(const Node& section)>;
std::string write_toml(const Node& root, const SectionComment& comment);

/// One value on one line, tables inline.
std::string toml_value(const Node& node);

}  // namespace carom
