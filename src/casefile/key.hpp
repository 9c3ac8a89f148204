// What is declared about one key and one section of the case format; no knowledge of where values are stored.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/units.hpp"
#include "casefile/document.hpp"
#include "math/interval.hpp"

namespace carom {

/// The form of a value. Where the key has choices, text is one of them and texts a list of them.
enum class Shape : std::uint8_t {
  boolean,
  integer,
  number,
  text,
  vector,         ///< [x, y, z]
  pair,           ///< [x, y]
  integers,       ///< [nx, ny, nz]
  integer_pair,   ///< [nx, ny]
  numbers,        ///< list of numbers
  pairs,          ///< list of [x, y]
  texts,          ///< list of texts
  formulas,       ///< ["...", "...", "..."], of x, y and z
  named_vectors,  ///< { NAME = [x, y, z], ... }
  section,        ///< [key] or key = { ... }
  sections,       ///< [[key]]
  named_sections  ///< [key.NAME]
};

struct Bound {
  double value = 0.0;
  enum class Side : std::uint8_t { open, closed } side = Side::open;

  bool operator==(const Bound&) const = default;
};

/// Allowed numbers; for lists and vectors each entry. All numbers must be finite, whatever the range.
struct Range {
  std::optional<Bound> low{}, high{};

  bool contains(double number) const;
  bool operator==(const Range&) const = default;
};

Range range_of(const Interval& interval);
Range greater_than(double low);
Range at_least(double low);
Range between_open(double low, double high);

/// The optional part of a declaration.
struct KeyOptions {
  Dimension unit = Dimension::none;
  Range range{};
  std::vector<std::string> choices{};  ///< for an enumeration in the order of its enumerators
  std::string others{};                ///< in words, which other texts may stand beside the choices; "": none
  std::vector<std::string> kinds{};    ///< values of the section's selector for which the key is taken; empty: all
  enum class Need : std::uint8_t { optional, required } need = Need::optional;
  std::vector<std::string> required_for{};  ///< kinds for which an otherwise optional key is required
  std::vector<std::string> aliases{};       ///< other names that people try; only to suggest the key
  std::string default_phrase{};             ///< the default in words, where it is not one value
  std::string remedy{};                     ///< what helps where a value is not taken

  bool operator==(const KeyOptions&) const = default;
};

struct SectionDescription;

struct KeyDescription {
  std::string key;
  Shape shape{};
  std::string doc;
  KeyOptions options;
  std::optional<Node> default_value;
  std::shared_ptr<const SectionDescription> section;  ///< for the section shapes
};

/// Keys of which exactly one, or at least one, must be given.
struct Alternatives {
  enum class Count : std::uint8_t { exactly_one, at_least_one } count{};
  std::vector<std::string> keys;
};

struct SectionDescription {
  std::string doc;
  /// The key whose value decides which other keys are taken: of this section, or a dotted path from the root; "": none.
  std::string selector;
  std::string default_kind;  ///< value of the selector when it is absent
  std::vector<Alternatives> alternatives;
  std::string opened_by;  ///< a key with which the section takes others than are known here; "": none
  std::vector<KeyDescription> keys;
};

/// True when a section of this kind takes the key.
bool applies(const KeyDescription& key, const std::string& kind);
/// True when a section of this kind must have the key.
bool required(const KeyDescription& key, const std::string& kind);

/// `> 0`, `> -1 and < 0.5`, or "" for any.
std::string range_text(const Range& range);
/// What the key takes, for messages: "a number > 0 in MPa".
std::string expected_text(const KeyDescription& key, UnitSystem units);
/// "a", "b", "c"
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace carom
