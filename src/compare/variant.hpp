// The cases that a comparison runs: the user's case with a few keys changed.
#pragma once

#include <string>
#include <vector>

#include "casefile/document.hpp"
#include "compare/matrix.hpp"

namespace carom::compare {

/// The case that is varied.
struct Base {
  std::string file;
  Node root;       ///< as the user wrote it, so that defaults follow the scheme
  double end{};    ///< time.end
  int cells = 0;   ///< along the longest edge of the first block; 0 for mesh files
  int refine = 0;  ///< mesh.refine
  std::string title{}, units{};
  bool has_inertia = false;  ///< in one of its stages
};

/// What those want who give results folders instead of a case.
inline constexpr const char* two_runs_remedy =
    "the results folders of two runs are laid over each other by `carom report A B`";

/// Checks the case, whose files are looked for beside `file`. Throws CaseError.
Base base_of(Node root, const std::string& file);
/// Reads it as well.
Base read_base(const std::string& file);

/// One case of the matrix.
struct Variant {
  std::string name;                 ///< folder and first column of the tables, e.g. "02_newmark_n50"
  std::string label;                ///< what is varied, e.g. "newmark, 50 cells"
  Choice choice, varied;            ///< without what does not apply (see notes); varied: and what all have in common
  std::string scheme, enforcement;  ///< as in the case or the choice; the enforcement that the scheme takes
  int cells = 0;              ///< along the longest edge; of mesh files relative to the file's, 0 where none is refined
  double element_step = 0.0;  ///< of its mesh
  bool has_inertia = false;
  std::string case_text;           ///< TOML
  std::string refusal;             ///< why it is not allowed; "" when it is
  std::vector<std::string> notes;  ///< keys that were left out or chosen
};

/// The variants of all combinations, in their order; combinations that come to the same case are kept once. Statics is
/// refused where the case or another variant has inertia: it has neither waves nor an impact to compare.
///
/// Changes: `scheme` and `enforcement` set these keys of [scheme] (edit.hpp, set_scheme); `stiffness` is set in every
/// [[contact]], and left out with a note where the enforcement uses none; `cells`: set_cells; `courant` sets time.step
/// to the largest step that divides the end and does not exceed courant x element_step. Without `courant` steps that
/// the case gives are scaled as element_step; a scheme that needs one where the case has none gets Courant number 1.
/// Keys of [scheme], [time], [solver] and [[contact]] that the changed case does not take any more are left out with a
/// note. Of a case with [[stage]]s, `stiffness` and `cells` alone can be varied. Fields are not written (output.fields
/// = []), so that times are those of the computation.
///
/// Mesh files are named as seen from `folder`/<name>. A combination that the reader refuses has its reason in
/// `refusal`.
std::vector<Variant> make_variants(const Base& base, const Options& options, const std::string& folder);

}  // namespace carom::compare
