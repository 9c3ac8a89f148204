// The case as it will be run.
#pragma once

#include <string>

#include "casefile/case.hpp"
#include "casefile/document.hpp"

namespace carom {

/// The case as TOML with all defaults written out; reading it gives an equal case (locations apart). A mesh file keeps
/// the path the user wrote, relative to the folder of the original case file.
std::string resolved_toml(const Case& given);

/// The same as a tree.
Node resolved_tree(const Case& given);

}  // namespace carom
