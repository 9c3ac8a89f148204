// A case as Python has put it together, ready to be built.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "build/simulation.hpp"
#include "casefile/document.hpp"
#include "python/bindings.hpp"

namespace carom::python {

/// The tree a case was read from, for the places of errors.
struct Source {
  Node root;
  std::vector<std::string> notes;  ///< of the translation of a deck
};

/// Immutable.
struct PreparedCase {
  Case given;
  std::vector<std::string> notes;  ///< of reading it
};

/// With the lock of the interpreter let go of meanwhile. Throws CaseError.
std::shared_ptr<const Simulation> build(const PreparedCase& prepared, int threads);

}  // namespace carom::python
