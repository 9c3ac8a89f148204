// Laws from libraries: the rows of their laws, made at run time.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "material/law.hpp"

struct carom_law;

namespace carom {

/// A library with laws (material/carom_law.h), once loaded: it stays to the end of the process.
struct LawLibrary {
  std::string version;   ///< what it says of itself
  std::string checksum;  ///< of its file, 16 hexadecimal digits
  std::vector<Law> laws;

  /// The row of this name; nullptr when there is none.
  const Law* find(std::string_view name) const;
};

/// A library that cannot be used.
struct LawLibraryError : std::runtime_error {
  LawLibraryError(const std::string& found, std::string expected_)
      : std::runtime_error(found), expected(std::move(expected_)) {}
  std::string expected;
};

/// The library in a file, with the checksum of the file as it was when it was loaded. Throws LawLibraryError where it
/// is no library, is made for another interface, or one of its laws is not whole.
const LawLibrary& load_laws(const std::string& path);

}  // namespace carom
