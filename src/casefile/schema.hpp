// What is written from the declaration of the case format.
#pragma once

#include <functional>
#include <string>

namespace carom {

/// JSON Schema (draft 2020-12) of the case format.
std::string json_schema();

/// The text of the example of a section, by its name: "mesh.block", "materials.damage", "top" for the keys of no
/// section.
using ExampleOf = std::function<std::string(const std::string&)>;

/// Markdown documentation of the case format (docs/case_format.md), with the examples of all sections.
std::string case_documentation(const ExampleOf& example_of);

/// Markdown page of the schemes and the enforcements they take (docs/compatibility.md).
std::string compatibility_markdown();

/// Markdown page of the constitutive laws (docs/material_laws.md).
std::string laws_markdown();

}  // namespace carom
