// A tree of values to TOML text.
#pragma once

#include <string>

#include "casefile/document.hpp"

namespace carom {

/// TOML text of a root table. Tables of the root and lists of tables get sections of their own, everything below an
/// entry of a list is written inline.
std::string write_toml(const Node& root);

/// One value on one line, tables inline.
std::string toml_value(const Node& node);

}  // namespace carom
