// In which keys cases differ.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// A resolved case and the folder it stands in, from which its files are seen.
struct CaseText {
  std::string folder, text;
};

/// A key to which cases give different values, such as "scheme.kind", "materials.steel.E" or "contact[wall].stiffness",
/// and its value in each as TOML, "–" where a case does not have it. Entries of lists go by their names, which are
/// unique, else by their numbers from 1.
struct KeyDifference {
  std::string key;
  std::vector<std::string> values;
};

/// The keys that are not the same in all cases, in the order of the first case that has them. Title and checks are left
/// out. A text that names a file beside the case is that file, wherever it is seen from. Throws CaseError where a text
/// is not TOML.
std::vector<KeyDifference> case_differences(const std::vector<CaseText>& cases);

}  // namespace carom
