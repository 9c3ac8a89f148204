// What the rows of laws with isotropic elasticity have in common.
#pragma once

#include "material/law.hpp"

namespace carom {

/// E and nu.
std::vector<LawParameter> isotropic_parameters();
IsotropicElastic isotropic_at_rest(const Material& material);
/// LameParameters
std::shared_ptr<const void> prepare_lame(const Material& material);

}  // namespace carom
