// The case format, declared once: parsing, checks, defaults, documentation and JSON Schema all come from it.
#pragma once

#include <string>
#include <vector>

#include "casefile/case.hpp"
#include "casefile/section.hpp"

namespace carom {

/// Every section and key of a case file.
const SectionSchema<Case>& case_schema();

/// The names of components.
inline const std::vector<std::string> kAxes{"x", "y", "z"};

// The sections that are declared in files of their own.
SectionSchema<CaseMesh> mesh_section();
SectionSchema<CaseMaterial> material_section();
SectionSchema<CaseSupport> support_section();
SectionSchema<CaseLoad> load_section();
SectionSchema<CaseInitialState> initial_state_section();
SectionSchema<CaseInitial> initial_section();
SectionSchema<CaseInitial> stage_initial_section();
SectionSchema<CasePointMass> point_mass_section();
SectionSchema<CaseErosion> erosion_section();
SectionSchema<CaseRigidPart> rigid_body_section();
SectionSchema<CaseSpring> spring_section();
SectionSchema<CaseEquation> equation_section();
SectionSchema<CaseContact> contact_section();
SectionSchema<CaseFunction> function_section();
SectionSchema<CaseScheme> scheme_section();
SectionSchema<CaseTime> time_section();
SectionSchema<CaseStage> stage_section();
SectionSchema<CaseSolver> solver_section();
SectionSchema<CaseExact> exact_section();

}  // namespace carom
