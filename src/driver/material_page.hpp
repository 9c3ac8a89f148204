// What the point driver leaves: a table and a page.
#pragma once

#include <string>

#include "casefile/case.hpp"
#include "driver/material_path.hpp"

namespace carom {

/// The part of this name, or the only one when the name is "". Throws CaseError.
const CasePart& part_named(const Case& given, const std::string& name);

/// Follows the path with the law and the section of the part, and writes <folder>/<part>.csv and .html. Returns what
/// the command prints: the files and the key figures. Throws CaseError where part and path do not go together.
std::string drive_material(const Case& given, const std::string& part, const PathRequest& request,
                           const std::string& folder);

}  // namespace carom
