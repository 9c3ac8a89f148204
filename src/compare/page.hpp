// The page of a comparison.
#pragma once

#include <string>

#include "compare/tables.hpp"

namespace carom::compare {

/// One HTML document that needs no network: recommendation with reasons, table of all variants with links to their
/// reports (`variants/<name>/report.html`), convergence and cost, histories of force, velocity and energy beside the
/// reference, and what was not run and why. `case_text` is the case that was varied.
std::string make_page(const Comparison& comparison, const std::string& case_text);

}  // namespace carom::compare
