// Rules between the keys of one section.
#pragma once

#include "casefile/values.hpp"

namespace carom {

/// Names become columns of .csv files: no commas, quotes or control characters, and not empty.
void check_name(const Located<std::string>& name, const std::string& path);

/// Friction needs both mu and a tangential stiffness; the normal is not 0, and is normalised.
void check_contact(CaseContact& contact, const Node& node, const ReadContext& at);

/// As many values as times, in increasing order, no time more than twice.
void check_function(CaseFunction& function, const Node& node, const ReadContext& at);

/// A section force needs a group and a side, and nothing else takes a side.
void check_probe(CaseProbe& probe, const Node& node, const ReadContext& at);

/// A reference of 0 has no relative tolerance.
void check_check(CaseCheck& check, const Node& node, const ReadContext& at);

}  // namespace carom
