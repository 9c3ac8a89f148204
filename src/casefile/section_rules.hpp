// Rules between the keys of one section.
#pragma once

#include "casefile/values.hpp"

namespace carom {

/// Names become columns of .csv files: no commas, quotes or control characters, and not empty.
void check_name(const Located<std::string>& name, const std::string& path);

/// The place of a key that may not be written: its own, or that of the section.
Location place_of(const Node& section, const std::string& key);

/// A direction is not 0, and is normalised; a unit vector is left as it is.
void check_direction(Located<Vec3>& direction, const std::string& path);

/// As many values as times, in increasing order, no time more than twice.
void check_function(CaseFunction& function, const Node& node, const ReadContext& at);

/// A section force needs a group and a side, and nothing else takes a side.
void check_probe(CaseProbe& probe, const Node& node, const ReadContext& at);

/// A reference of 0 has no relative tolerance.
void check_check(CaseCheck& check, const Node& node, const ReadContext& at);

}  // namespace carom
