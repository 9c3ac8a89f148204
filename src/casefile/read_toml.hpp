// TOML text to a tree of values.
#pragma once

#include <string>
#include <string_view>

#include "casefile/document.hpp"

namespace carom {

/// The root table of a TOML text. Throws CaseError where the text is not TOML.
Node read_toml(std::string_view text, const std::string& name);

}  // namespace carom
