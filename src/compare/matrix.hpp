// What a comparison varies, and every combination of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace carom::compare {

/// The values to be combined; an empty list leaves what the case says.
struct Options {
  std::vector<std::string> schemes;       ///< NAME or NAME:KEY=VALUE:... ("newmark:beta=0.25:gamma=0.5")
  std::vector<std::string> enforcements;  ///< written alike, the keys are those of [scheme]
  std::vector<std::string> stiffnesses;   ///< of every [[contact]]
  std::vector<int> cells;                 ///< divisions of each block along its longest edge
  std::vector<double> courants;           ///< step over element_step()
  std::vector<int> refinements{};         ///< how often every cell is cut in halves
  std::string reference{};                ///< text in the name of the run that the others are compared with; "": chosen
};

/// One combination; an empty member leaves what the case says.
struct Choice {
  std::optional<std::string> scheme, enforcement, stiffness;
  std::optional<int> cells;
  std::optional<double> courant;
  std::optional<int> refine{};

  bool operator==(const Choice&) const = default;
};

/// All combinations: refinement varies fastest, then Courant number, cells, stiffness, enforcement, scheme. Values that
/// are given twice are taken once. One empty choice when nothing is varied.
std::vector<Choice> combinations(const Options& options);

/// What all combinations have in common: the members of which one value is given.
Choice common_choice(const Options& options);

/// The choice without what it has in common with all others.
Choice varied(Choice choice, const Choice& common);

/// "newmark beta=0.25, 50 cells, Courant 0.8"; "" for an empty choice.
std::string label_of(const Choice& choice);

}  // namespace carom::compare
