// The case format, declared once: parsing, checks, defaults, documentation and JSON Schema all come from it.
#pragma once

#include "casefile/case.hpp"
#include "casefile/section.hpp"

namespace carom {

/// Every section and key of a case file.
const Section<Case>& case_schema();

// The sections that are declared in files of their own.
Section<CaseMesh> mesh_section();
Section<CaseSupport> support_section();
Section<CaseLoad> load_section();
Section<CaseContact> contact_section();
Section<CaseFunction> function_section();

}  // namespace carom
