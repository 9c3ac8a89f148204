// From the case and its mesh to the model.
#pragma once

#include <memory>

#include "casefile/case.hpp"
#include "model/model.hpp"

namespace carom {

/// Resolves every group of the case. Throws CaseError where a group does not exist or holds the wrong things, and for
/// cells that belong to two parts.
Model build_model(const Case& given, std::shared_ptr<const Mesh> mesh);

}  // namespace carom
