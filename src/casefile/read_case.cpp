#include "casefile/read_case.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "casefile/case_schema.hpp"
#include "casefile/cross_references.hpp"
#include "casefile/read_toml.hpp"

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

}  // namespace

Case parse_case(std::string_view text, const std::string& name) {
  const Node root = read_toml(text, name);
  Case result;
  result.file = name;
  case_schema().read(result, root, {root, message_units(root), "", case_schema().description});
  check_references(result);
  return result;
}

Case read_case(const std::string& path) {
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
  return parse_case(text, path);
}

}  // namespace carom
