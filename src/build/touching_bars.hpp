// Bars of a contact's group, which touch with their sides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "build/groups.hpp"
#include "build/parts.hpp"
#include "casefile/case.hpp"

namespace carom {

/// The bars whose nodes are all in the group, in the order of the parts: of the given radius, or of that of a round bar
/// of the section's area. None, without a radius, where the group holds the ends of bars alone, which touch as points,
/// and where it has faces of cells. Throws CaseError for a radius where there are no bars, or faces beside them.
std::vector<BarSide> touching_bars(const Mesh& mesh, const Groups& groups, const Parts& parts,
                                   const Located<std::string>& group, const std::string& key,
                                   const std::optional<Located<double>>& radius);

}  // namespace carom
