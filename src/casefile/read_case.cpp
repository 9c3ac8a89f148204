#include "casefile/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "casefile/case_schema.hpp"
#include "casefile/cross_references.hpp"
#include "casefile/read_toml.hpp"
#include "deck/deck.hpp"
#include "deck/foreign.hpp"

namespace carom {

namespace {

/// The unit system for messages, known before anything is read; a wrong one is reported when its turn comes.
UnitSystem message_units(const Node& root) {
  const Node* units = find(root, "units");
  const auto* text = units != nullptr ? std::get_if<std::string>(&units->value) : nullptr;
  for (const UnitSystem system : unit_systems) {
    if (text != nullptr && *text == name(system)) return system;
  }
  return UnitSystem::si;
}

constexpr const char* utf8 = "a case file (.toml) in UTF-8";

/// Position of the first byte that is not UTF-8 (RFC 3629, but for overlong forms and surrogates, which TOML's reader
/// finds), or npos.
std::size_t first_foreign_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const std::size_t length = c < 0x80                  ? 1
                               : (c >= 0xc2 && c < 0xe0) ? 2
                               : (c & 0xf0U) == 0xe0     ? 3
                               : (c >= 0xf0 && c < 0xf5) ? 4
                                                         : 0;
    if (length == 0 || i + length > text.size()) return i;
    for (std::size_t k = 1; k < length; ++k)
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0U) != 0x80) return i;
    i += length;
  }
  return std::string_view::npos;
}

void refuse_other_encodings(std::string_view text, const std::string& path) {
  const std::string remedy = "Open it in the editor and save it as UTF-8.";
  const bool is_marked = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
  const auto is_zero = [&](std::size_t i) { return i < text.size() && text[i] == '\0'; };
  const bool is_wide = (is_zero(0) && is_zero(2)) || (is_zero(1) && is_zero(3));
  if (is_marked || is_wide) throw CaseError({path, 0, 0}, "", "a text in UTF-16", utf8, remedy);
  if (text.find('\0') != std::string_view::npos) return;  // no text at all: the reader says where
  const std::size_t foreign = first_foreign_byte(text);
  if (foreign == std::string_view::npos) return;
  const std::string_view before = text.substr(0, foreign);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t begin = before.rfind('\n') + 1;  // npos + 1 is 0
  throw CaseError({path, static_cast<int>(line), static_cast<int>(foreign - begin) + 1}, "",
                  fmt::format("the byte 0x{:02x}, which is not UTF-8 (is this Latin-1?)",
                              static_cast<unsigned char>(text[foreign])),
                  utf8, remedy);
}

}  // namespace

Case parse_case(std::string_view text, const std::string& name) {
  return case_of(read_toml(text, name), name);
}

Case case_of(const Node& root, const std::string& name) {
  CaseErrors errors;
  Case result = case_of(root, name, errors);
  errors.check();
  return result;
}

Case case_of(const Node& root, const std::string& name, CaseErrors& errors) {
  Case result;
  result.file = name;
  case_schema().read(result, root, {root, message_units(root), "", name, case_schema().description, errors});
  check_names(result, errors);
  if (!errors.empty()) return result;
  choose_enforcement(result);
  choose_weights(result);
  errors.attempt([&] { find_falls(result); });
  check_references(result, errors);
  if (!errors.empty()) return result;
  choose_methods(result);
  return result;
}

Case read_case(const std::string& path) {
  CaseErrors errors;
  Case result = read_case(path, errors);
  errors.check();
  return result;
}

Case read_case(const std::string& path, CaseErrors& errors) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw CaseError({path, 0, 0}, "", "no such file", "a case file (.toml)");
  if (!std::filesystem::is_regular_file(status)) {
    throw CaseError({path, 0, 0}, "", "something that is not a file", "a case file (.toml)");
  }
  constexpr std::uintmax_t most_bytes = 64U << 20U;
  if (std::filesystem::file_size(path, error) > most_bytes) {
    throw CaseError({path, 0, 0}, "", "a file of more than 64 MiB", "a case file (.toml)", "Is this the mesh?");
  }
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw CaseError({path, 0, 0}, "", "a file that cannot be read", "a case file (.toml)");
  if (text.starts_with("$MeshFormat") || text.starts_with("\x89HDF")) {
    throw CaseError({path, 0, 0}, "", "a mesh file", "a case file (.toml)",
                    "`carom mesh` describes it; a case names it in [mesh] as file = \"...\".");
  }
  refuse_foreign(text, path);
  if (looks_like_deck(text)) {
    throw CaseError({path, 0, 0}, "", "a deck of Abaqus or CalculiX", "a case file (.toml)",
                    "`carom convert` makes a case of it; `carom run` and `carom check` also take it as it is.");
  }
  refuse_other_encodings(text, path);
  return case_of(read_toml(text, path), path, errors);
}

}  // namespace carom
