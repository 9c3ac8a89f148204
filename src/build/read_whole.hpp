// A case or deck as the user gives it, and everything that is wrong with it in one message.
#pragma once

#include <string>
#include <vector>

#include "translate/translate_deck.hpp"

namespace carom {

/// As read_case_or_deck. Where the case is wrong, the message also names the groups that its mesh does not have; where
/// a deck has things that are not carried over, it also says what would still be wrong when they are accepted.
ReadCase read_whole(const std::string& path, const std::vector<std::string>& accepted);

}  // namespace carom
