// The tree of a case between C++ and Python's dicts and lists.
#pragma once

#include <string>

#include "casefile/document.hpp"
#include "python/bindings.hpp"

namespace carom::python {

/// Dicts, lists, numbers, texts.
py::object to_python(const Node& node);

/// A tree of dicts, lists (tuples, arrays), numbers and texts. What has the value that stands in `source` (nullptr:
/// there is none) has its place, else the file alone. Throws CaseError at `path` for anything else.
Node from_python(const py::handle& value, const Node* source, const std::string& file, const std::string& path);

}  // namespace carom::python
