#include "compare/variant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "casefile/read_case.hpp"
#include "casefile/read_toml.hpp"
#include "casefile/write_toml.hpp"
#include "compare/edit.hpp"
#include "compare/element_step.hpp"

namespace carom::compare {

namespace {

/// The message without the place in a text that the user has not written.
std::string reason(const CaseError& error) {
  return CaseError({}, error.key(), error.found(), error.expected(), error.suggestion()).what();
}

std::string text_at(const Node& root, std::string_view path) {
  const Node* node = find(root, path);
  const auto* text = node == nullptr ? nullptr : std::get_if<std::string>(&node->value);
  return text == nullptr ? "" : *text;
}

/// A case tree on its way to one that is accepted.
class Draft {
 public:
  explicit Draft(const Base& base)
      : root_(base.root), file_((std::filesystem::path(base.file).parent_path() / "case.toml").string()) {}

  Node& root() { return root_; }
  const std::string& text() const { return text_; }
  std::vector<std::string>& notes() { return notes_; }

  void set_scheme(const std::string& key, const std::string& word) {
    for (std::string& path : compare::set_scheme(root_, key, word)) keep_.push_back(std::move(path));
  }
  void set_step(double step) {
    set_key(root_, "time", "step", {step, {}});
    keep_.emplace_back("time.step");
  }
  void set_stiffness(const Node& value);

  /// Leaves out the keys that the changed case does not take, and reads it. Throws CaseError when it is refused for
  /// another reason.
  Case accept();

 private:
  bool may_leave_out(const std::string& path) const;

  Node root_;
  std::string file_;  ///< in the folder from which the case names its files
  std::string text_;
  std::vector<std::string> keep_;  ///< paths that were asked for
  std::vector<std::string> notes_;
};

void Draft::set_stiffness(const Node& value) {
  List& contacts = std::get<List>(find_at(root_, "contact")->value);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::string path = fmt::format("contact[{}].stiffness", i);
    erase_at(root_, path);
    std::get<Table>(contacts[i].value).members.push_back({"stiffness", {}, value});
    keep_.push_back(path);
  }
}

bool Draft::may_leave_out(const std::string& path) const {
  constexpr std::array<std::string_view, 4> sections{"scheme.", "time.", "solver.", "contact["};
  return std::any_of(sections.begin(), sections.end(), [&path](auto s) { return path.starts_with(s); }) &&
         std::find(keep_.begin(), keep_.end(), path) == keep_.end();
}

Case Draft::accept() {
  std::map<std::string, CaseError> left_out;
  for (;;) {
    try {
      text_ = write_toml(root_);
      return parse_case(text_, file_);
    } catch (const CaseError& error) {
      const auto before = left_out.find(error.key());
      if (before != left_out.end()) throw CaseError(before->second);  // it is needed after all
      if (!may_leave_out(error.key()) || !erase_at(root_, error.key())) throw;
      left_out.emplace(error.key(), error);
      notes_.push_back(fmt::format("{} does not apply", error.key()));
    }
  }
}

/// The largest step of at most `wanted` that divides `end`.
double dividing_step(double wanted, double end) {
  return end / std::max(1.0, std::ceil(end / wanted * (1.0 - 1e-9)));
}

std::string folder_name(std::size_t number, const std::string& label) {
  constexpr std::size_t longest = 100;
  std::string name = fmt::format("{:02}_", number + 1);
  for (const char c : label) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-';
    if (plain || name.back() != '_') name += plain ? c : '_';
  }
  return name.substr(0, longest);
}

/// The choice's cells and refinement.
void set_mesh(Node& root, const Choice& choice) {
  if (choice.cells) set_cells(root, *choice.cells);
  if (choice.refine) set_key(root, "mesh", "refine", {std::int64_t{*choice.refine}, {}});
}

/// Element steps of the meshes, each built once.
class ElementSteps {
 public:
  double of(const Base& base, const Choice& choice) {
    const std::pair key(choice.cells.value_or(0), choice.refine.value_or(-1));
    const auto known = steps_.find(key);
    if (known != steps_.end()) return known->second;
    Node root = base.root;
    set_mesh(root, choice);
    Case read = parse_case(write_toml(root), base.file);
    return steps_.emplace(key, compare::element_step(read)).first->second;
  }

 private:
  std::map<std::pair<int, int>, double> steps_;  ///< by cells and refinement
};

/// Every step that the case gives, times the ratio, so that whole steps reach the end of each stage.
void scale_steps(Draft& draft, double ratio) {
  if (std::abs(ratio - 1.0) < 1e-9) return;  // round-off of cell lengths
  double begin = 0.0;
  for (std::size_t stage = 0;; ++stage) {
    const std::string section = stage == 0 ? "time" : fmt::format("stage[{}]", stage - 1);
    if (find_at(draft.root(), section) == nullptr) return;
    const double end = number_at(draft.root(), section + ".end");
    if (Node* step = find_at(draft.root(), section + ".step"))
      step->value = dividing_step(number_at(draft.root(), section + ".step") * ratio, end - begin);
    begin = end;
  }
}

/// Does the stiffness of contacts enter the computation?
bool uses_stiffness(const Case& given) {
  return !given.contacts.empty() && traits(**given.scheme.enforcement).takes_stiffness;
}

/// The case with the step that it has or that its scheme needs.
Case accept_with_step(Draft& draft, const Base& base, double element_step) {
  try {
    return draft.accept();
  } catch (const CaseError& error) {
    if (error.key() != "time.step" || find(draft.root(), "time.step") != nullptr) throw;
  }
  draft.set_step(dividing_step(element_step, base.end));
  draft.notes().emplace_back("time.step from Courant number 1");
  return draft.accept();
}

bool has_any_inertia(const Case& given) {
  return has_inertia(*given.scheme.kind) ||
         std::ranges::any_of(given.stages, [](const CaseStage& stage) { return has_inertia(*stage.scheme.kind); });
}

/// Statics beside what has inertia.
void refuse_statics(const Base& base, std::vector<Variant>& variants) {
  const auto moves = [](const Variant& v) { return v.refusal.empty() && v.has_inertia; };
  if (!base.has_inertia && std::ranges::none_of(variants, moves)) return;
  for (Variant& v : variants) {
    if (!v.refusal.empty() || v.has_inertia) continue;
    v.refusal = reason(CaseError({}, "scheme.kind", fmt::format("\"{}\" beside schemes that have inertia", v.scheme),
                                 "schemes that have it",
                                 "Statics has neither waves nor an impact: it is no reference for dynamics. Compare "
                                 "statics with statics."));
  }
}

void build(Variant& v, const Base& base, ElementSteps& steps) {
  Draft draft(base);
  if ((v.choice.scheme || v.choice.enforcement || v.choice.courant) && find(base.root, "stage") != nullptr) {
    throw CaseError({base.file}, "stage", "a case of several stages", "[scheme] and [time] alone",
                    "Of a case with stages, stiffness and cells can be varied.");
  }
  if ((v.choice.cells || v.choice.refine) && find(base.root, "initial_state") != nullptr) {
    throw CaseError({base.file}, "initial_state", "the state of one mesh, beside other cells", "the cells of that mesh",
                    "Of a case with an initial state, schemes, stiffness and steps can be varied.");
  }
  if (v.choice.scheme) draft.set_scheme("kind", *v.choice.scheme);
  if (v.choice.enforcement) draft.set_scheme("enforcement", *v.choice.enforcement);
  set_mesh(draft.root(), v.choice);
  v.element_step = steps.of(base, v.choice);
  if (v.choice.courant) {
    draft.set_step(dividing_step(*v.choice.courant * v.element_step, base.end));
  } else {
    scale_steps(draft, v.element_step / steps.of(base, {}));
  }
  set_key(draft.root(), "output", "fields", {List{}, {}});
  const Case accepted = accept_with_step(draft, base, v.element_step);
  v.enforcement = name(**accepted.scheme.enforcement);
  v.has_inertia = has_any_inertia(accepted);
  if (v.choice.stiffness && !uses_stiffness(accepted)) {
    v.choice.stiffness.reset();
    draft.notes().emplace_back("no contact takes a stiffness");
  } else if (v.choice.stiffness) {
    draft.set_stiffness(value_of(*v.choice.stiffness));
    draft.accept();
  }
  v.notes = draft.notes();
  v.case_text = draft.text();
}

/// Names the variant in its report, and the files that it needs from its folder.
std::string finished(const Variant& v, const Base& base, const std::string& folder) {
  namespace fs = std::filesystem;
  Node root = read_toml(v.case_text, "case.toml");
  const std::string title = text_at(root, "title");
  const Node* old = find(root, "title");
  const std::string full = title.empty() ? v.label : title + ": " + v.label;
  if (old != nullptr) {
    find_at(root, "title")->value = full;
  } else {
    std::get<Table>(root.value).members.insert(std::get<Table>(root.value).members.begin(), {"title", {}, {full, {}}});
  }
  const auto see_from_there = [&](Node* named) {
    const auto* text = named == nullptr ? nullptr : std::get_if<std::string>(&named->value);
    if (text == nullptr || text->empty() || fs::path(*text).is_absolute()) return;
    const fs::path from_here = fs::path(base.file).parent_path() / *text;
    named->value = fs::proximate(from_here, fs::path(folder) / v.name).generic_string();
  };
  for (const char* key : {"mesh.file", "initial_state.from"}) see_from_there(find_at(root, key));
  if (Node* materials = find_at(root, "materials"))
    for (Member& m : std::get<Table>(materials->value).members) see_from_there(find_at(m.value, "library"));
  return write_toml(root);
}

}  // namespace

Base base_of(Node root, const std::string& file) {
  const Case read = case_of(root, file);
  const int cells = cells_of(root);
  return {file,
          std::move(root),
          *read.time.end,
          cells,
          read.mesh.refine,
          read.title.empty() ? file : read.title,
          std::string(name(read.units)),
          has_any_inertia(read)};
}

Base read_base(const std::string& file) {
  if (std::filesystem::is_directory(file))
    throw CaseError({file}, "", "a folder", "a case file (.toml), of which variants are run",
                    fmt::format("Of runs that are done, {}.", two_runs_remedy));
  read_case(file);  // says what is wrong with the file itself
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return base_of(read_toml(text, file), file);
}

std::vector<Variant> make_variants(const Base& base, const Options& options, const std::string& folder) {
  std::vector<Variant> variants;
  const Choice common = common_choice(options);
  ElementSteps steps;
  for (const Choice& choice : combinations(options)) {
    Variant v;
    v.choice = choice;
    v.enforcement = choice.enforcement.value_or("");
    try {
      build(v, base, steps);
    } catch (const CaseError& error) {
      v.refusal = reason(error);
    }
    const auto same = [&v](const Variant& other) { return other.choice == v.choice; };
    if (std::any_of(variants.begin(), variants.end(), same)) continue;
    v.varied = varied(v.choice, common);
    v.label = label_of(v.varied);
    if (v.label.empty()) v.label = "as the case says";
    v.name = folder_name(variants.size(), v.label);
    v.scheme = v.choice.scheme.value_or(text_at(base.root, "scheme.kind"));
    const int along = v.choice.cells.value_or(base.cells), halvings = v.choice.refine.value_or(base.refine);
    if (along > 0 || v.choice.refine) v.cells = std::max(1, along) * (1 << halvings);
    if (v.refusal.empty()) v.case_text = finished(v, base, folder);
    variants.push_back(std::move(v));
  }
  refuse_statics(base, variants);
  return variants;
}

}  // namespace carom::compare
