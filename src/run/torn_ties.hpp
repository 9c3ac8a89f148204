// Ties whose sides part as the run begins.
#pragma once

#include <span>

#include "casefile/case.hpp"
#include "contact/contact_geometry.hpp"

namespace carom {

/// CaseError where an initial displacement or velocity (dof vectors) parts what a tie keeps together: it would have to
/// be torn back before the first step, by energy that nobody asked for. Rounding apart: 1e-9 of the largest entry.
void refuse_torn_ties(const Case& given, const ContactGeometry& contact, std::span<const double> displacement,
                      std::span<const double> velocity);

}  // namespace carom
