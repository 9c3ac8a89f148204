// The manual's page of decks, as far as the code knows it.
#pragma once

#include <string>

namespace carom {

/// Markdown page of what is understood of decks (docs/decks.md): the keywords and element types of the code's tables.
std::string decks_markdown();

}  // namespace carom
