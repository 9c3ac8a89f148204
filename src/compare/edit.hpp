// Changes of a case as a tree of values, before it is read as a case.
#pragma once

#include <string>
#include <string_view>

#include "casefile/document.hpp"

namespace carom::compare {

/// The node at a path such as `scheme.kind` or `contact[0].stiffness`, or nullptr.
Node* find_at(Node& root, std::string_view path);

/// Gives `section.key` of the root a value; makes the section when it is absent.
void set_key(Node& root, const std::string& section, const std::string& key, Node value);

/// Removes what stands at the path; false when nothing does.
bool erase_at(Node& root, std::string_view path);

/// The value that a word of the command line stands for: a TOML value, or the word itself as a text.
Node value_of(const std::string& word);

/// NAME[:KEY=VALUE]...: sets scheme.<key> to NAME and the other keys of [scheme]; keys that are not named stay. Returns
/// the paths that were set. Throws CaseError for a part without KEY=.
std::vector<std::string> set_scheme(Node& root, const std::string& key, const std::string& word);

/// The number at the path, which must be there.
double number_at(Node& root, std::string_view path);

/// Cuts every [[mesh.block]] into `cells` along its longest edge and as many times more or fewer along the others, at
/// least 1; an edge of one cell stays one cell. Throws CaseError when the mesh comes from a file.
void set_cells(Node& root, int cells);

/// Divisions along the longest edge of the first block, or 0 when the mesh comes from a file.
int cells_of(const Node& root);

}  // namespace carom::compare
