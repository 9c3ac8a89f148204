// A deck as a case file and a mesh beside it.
#pragma once

#include <string>
#include <vector>

namespace carom {

struct ConvertedDeck {
  std::string case_file, mesh_file;
  std::vector<std::string> notes;
};

/// Writes the case to `case_file` (.toml) and its mesh beside it as Gmsh 2.2 (.msh); comments say which line of the
/// deck a section comes from, and what is not as in the deck. Existing files are not replaced. Throws CaseError,
/// OutputError.
ConvertedDeck convert_deck(const std::string& deck, const std::string& case_file,
                           const std::vector<std::string>& accepted);

}  // namespace carom
