// Cases that come with the program, to begin one's own with.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// Where they stand: share/carom beside the bin of an installed program, the sources around a build. Throws CaseError
/// where they are at neither place.
std::string examples_folder(const std::string& program);

/// Their names, such as "taylor_bar/rigid_wall" of cases/ and "tutorial/phone" of examples/, sorted.
std::vector<std::string> example_names(const std::string& examples);

struct BegunCase {
  std::string case_file;
  std::string other_file;  ///< its mesh, or the script that makes it; "" where the case needs none
  std::string command;     ///< that makes the mesh from the script; "" where it is there
};

/// Writes the example of this name into a new folder, as <folder>/<end of folder>.toml, with its mesh beside it; where
/// that is made by a script of Gmsh, with the script. Throws CaseError for a name that is none, with all names, and for
/// a folder that is not empty; OutputError where it cannot be written.
BegunCase begin_case(const std::string& examples, const std::string& like, const std::string& folder);

}  // namespace carom
