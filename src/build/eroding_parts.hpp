// Cells that go: what the case says of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "casefile/case.hpp"
#include "model/model.hpp"

namespace carom {

class Stage;

/// True when a part of this name is to erode.
bool erodes(const Case& given, const std::string& part);

/// Adds an [[erosion]] to the model, whose parts, contacts, loads and equations are complete. Throws CaseError
/// where a part has no plastic strain or no damage to go by, and where what is tied, joined by equations or under
/// pressure would go.
void add_erosion(const CaseErosion& given, Model& model);

/// Throws CaseError where a stage has a scheme in which cells cannot go.
void refuse_erosion(const Case& given, const Model& model, const std::vector<std::unique_ptr<Stage>>& stages);

}  // namespace carom
