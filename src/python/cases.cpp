// Cases: read, turned into dicts and back, examined.
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "advise/check_summary.hpp"
#include "build/read_whole.hpp"
#include "casefile/read_case.hpp"
#include "casefile/read_toml.hpp"
#include "casefile/resolved_case.hpp"
#include "math/called_function.hpp"
#include "python/callables.hpp"
#include "python/compute.hpp"
#include "python/prepared_case.hpp"
#include "python/tree.hpp"

namespace carom::python {

namespace {

/// The tree as it is written where the file is a text of TOML, else as it is meant. Read as a case first, so that
/// everything that is wrong in it is said with its place.
py::tuple read(const std::string& path, const std::vector<std::string>& accept) {
  ReadCase read = read_whole(path, accept);
  auto source = std::make_shared<Source>();
  source->notes = std::move(read.notes);
  if (std::filesystem::path(path).extension() == ".toml") {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    source->root = read_toml(text, path);
  } else {
    source->root = resolved_tree(read.given);
  }
  return py::make_tuple(to_python(source->root), source);
}

/// The end of the last stage of a case.
double end_of(const Case& given) {
  return given.stages.empty() ? *given.time.end : *given.stages.back().time.end;
}

std::shared_ptr<PreparedCase> prepare(const py::dict& tree, const std::shared_ptr<Source>& source,
                                      const std::string& file, const std::map<std::string, py::object>& functions,
                                      const std::map<std::string, py::object>& frictions,
                                      const std::optional<std::string>& mesh) {
  const Node root = from_python(tree, source ? &source->root : nullptr, file, "");
  auto prepared = std::make_shared<PreparedCase>();
  prepared->given = case_of(root, file);
  if (source) prepared->notes = source->notes;
  for (CaseFunction& function : prepared->given.functions) {
    const auto given = functions.find(function.name);
    if (given == functions.end()) continue;
    function.function.called =
        std::make_shared<const CalledFunction>(called(function.name, given->second), end_of(prepared->given));
  }
  for (CaseContact& contact : prepared->given.contacts)
    if (const auto given = frictions.find(*contact.name); given != frictions.end())
      contact.law()->called_friction =
          std::make_shared<const FrictionLaw>(called_friction(given->first, given->second));
  if (mesh) prepared->given.mesh.text = std::make_shared<const std::string>(*mesh);
  return prepared;
}

py::tuple check(const PreparedCase& prepared, const std::string& folder) {
  const std::shared_ptr<const Simulation> simulation = build(prepared, 0);
  Examination found;
  {
    const py::gil_scoped_release release;
    const Computing computing(0);
    // Functions of Python may remember their calls, so that nothing is rehearsed with them.
    const bool calls = std::ranges::any_of(prepared.given.functions,
                                           [](const CaseFunction& each) { return each.function.called != nullptr; }) ||
                       std::ranges::any_of(prepared.given.contacts, [](const CaseContact& each) {
                         return each.law() != nullptr && each.law()->called_friction;
                       });
    found = with_errors_of_callables([&] { return examine(*simulation, folder, calls ? 0.0 : usual_rehearsal); });
    found.notes.insert(found.notes.begin(), prepared.notes.begin(), prepared.notes.end());
  }
  return py::make_tuple(found.text(), found.warnings, found.notes);
}

}  // namespace

std::shared_ptr<const Simulation> build(const PreparedCase& prepared, int threads) {
  const py::gil_scoped_release release;
  const Computing computing(threads);
  return with_errors_of_callables([&] { return std::make_shared<const Simulation>(prepared.given); });
}

void bind_cases(py::module_& module) {
  const py::class_<Source, std::shared_ptr<Source>> source(module, "Source",
                                                           "Where the values of a case were written.");
  py::class_<PreparedCase, std::shared_ptr<PreparedCase>>(module, "PreparedCase", "A case that has been checked.")
      .def_property_readonly(
          "end", [](const PreparedCase& x) { return end_of(x.given); }, "Time at which the last stage ends.")
      .def_property_readonly(
          "resolved", [](const PreparedCase& x) { return resolved_toml(x.given); },
          "The case as a text of TOML with all defaults.");
  module.def("read", &read, py::arg("path"), py::arg("accept"),
             "Tree of dicts and lists of a case file, and its Source.");
  module.def("prepare", &prepare, py::arg("tree"), py::arg("source"), py::arg("file"), py::arg("functions"),
             py::arg("frictions"), py::arg("mesh"), "Checks a tree and makes a case of it.");
  module.def("check", &check, py::arg("case"), py::arg("folder"), "Text of `carom check`, warnings, notes.");
}

}  // namespace carom::python
