#include "mesh/read_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/errors.hpp"
#include "base/terminal_text.hpp"
#include "deck/deck.hpp"
#include "deck/foreign.hpp"
#include "mesh/deck_mesh.hpp"
#include "mesh/read_gmsh.hpp"
#include "mesh/read_med.hpp"

namespace carom {

namespace {

constexpr const char* kKnown = "a mesh file: Gmsh 2.2 or 4.1 (.msh), MED 2.2 to 4 (.med), Abaqus or CalculiX (.inp)";

std::string read_bytes(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw CaseError({path, 0, 0}, "", "a folder", kKnown, "Name the file inside it.");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw CaseError({path, 0, 0}, "", fmt::format("no readable file ({})", std::strerror(errno)), kKnown,
                    "Check the path; it is relative to the folder of the case file.");
  if (!std::filesystem::is_regular_file(path, error))
    throw CaseError({path, 0, 0}, "", "something that is not a regular file", kKnown);
  std::string bytes(static_cast<std::size_t>(std::filesystem::file_size(path)), '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw CaseError({path, 0, 0}, "", "a file that cannot be read to its end", kKnown);
  return bytes;
}

/// The first line that is not blank, or what there is of it.
std::string_view beginning(std::string_view bytes) {
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  return bytes.substr(begin, std::min(bytes.find('\n', begin), bytes.size()) - begin);
}

}  // namespace

Mesh read_mesh(std::string_view bytes, const std::string& source) {
  const std::string_view first = beginning(bytes);
  if (bytes.starts_with("\x89HDF\r\n\x1a\n")) return read_med(bytes, source);
  if (first.starts_with("$")) return read_gmsh(bytes, source);
  if (looks_like_deck(bytes)) return read_deck_mesh(std::string(bytes), source, read_included);
  if (!first.empty()) refuse_foreign(bytes, source);
  throw CaseError({source, 0, 0}, "", first.empty() ? "an empty file" : "a file that begins with " + printable(first),
                  kKnown,
                  source.ends_with(".toml") ? "`carom check` and `carom run` take cases."
                                            : "Export the mesh in one of these formats.");
}

Mesh read_mesh(const std::string& path) {
  return read_mesh(read_bytes(path), path);
}

}  // namespace carom
