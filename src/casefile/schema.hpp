// What is written from the declaration of the case format.
#pragma once

#include <string>

namespace carom {

/// JSON Schema (draft 2020-12) of the case format.
std::string json_schema();

/// Markdown documentation of the case format (docs/case_format.md).
std::string case_documentation();

/// Markdown page of the schemes and the enforcements they take (docs/compatibility.md).
std::string compatibility_markdown();

/// Markdown page of the constitutive laws (docs/material_laws.md).
std::string laws_markdown();

}  // namespace carom
