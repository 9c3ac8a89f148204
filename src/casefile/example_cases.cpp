#include "casefile/example_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>
#include <system_error>

#include "base/errors.hpp"
#include "casefile/read_toml.hpp"
#include "output/file_writer.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

/// A folder of examples, and what their names begin with.
struct Shelf {
  std::string_view folder, prefix;
};
constexpr std::array<Shelf, 3> kShelves{
    {{"cases", ""}, {"examples/gallery", "gallery/"}, {"examples/tutorial", "tutorial/"}}};

std::map<std::string, fs::path> files_by_name(const fs::path& examples) {
  std::map<std::string, fs::path> found;
  for (const Shelf& shelf : kShelves) {
    const fs::path folder = examples / shelf.folder;
    if (!fs::is_directory(folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") continue;
      const fs::path name = entry.path().lexically_relative(folder).replace_extension();
      found.emplace(std::string(shelf.prefix) + name.generic_string(), entry.path());
    }
  }
  return found;
}

/// A line for each folder of names.
std::string by_folders(const std::vector<std::string>& names) {
  std::string text, folder;
  for (const std::string& name : names) {
    const std::size_t slash = name.rfind('/') + 1;
    const bool is_next = name.substr(0, slash) != folder || text.empty();
    folder = name.substr(0, slash);
    text += is_next ? "\n  " + name : ", " + name.substr(slash);
  }
  return text;
}

std::string content_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void require_empty(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error))
    throw CaseError({folder.string()}, "", "a file", "a folder that is new or empty");
  if (!fs::is_empty(folder, error))
    throw CaseError({folder.string()}, "", "a folder that is not empty", "one that is new or empty",
                    "Nothing is overwritten: choose another name.");
}

/// The text with the first such string of a line, counted from 1, replaced.
std::string with_string(std::string text, int line, const std::string& from, const std::string& to) {
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) begin = text.find('\n', begin) + 1;
  return text.replace(text.find(from, begin), from.size(), to);
}

}  // namespace

std::string examples_folder(const std::string& program) {
  std::error_code error;
  const fs::path beside = fs::weakly_canonical(program, error).parent_path();
  const std::array<fs::path, 2> places{beside / "../share/carom", beside / "../.."};
  for (const fs::path& place : places)
    if (fs::is_directory(place / kShelves[0].folder, error)) return place.lexically_normal().string();
  const std::string there = places[0].lexically_normal().string();
  throw CaseError(
      {there}, "", "no examples beside the program", "a folder \"cases\" there, as an installation makes it",
      fmt::format("Has the program been copied out of its folder? Start it where it was installed or built, or "
                  "copy \"cases\" and \"examples\" of the sources into {}.",
                  there));
}

std::vector<std::string> example_names(const std::string& examples) {
  std::vector<std::string> names;
  for (const auto& [name, file] : files_by_name(examples)) names.push_back(name);
  return names;
}

BegunCase begin_case(const std::string& examples, const std::string& like, const std::string& folder) {
  const std::map<std::string, fs::path> files = files_by_name(examples);
  const auto found = files.find(like);
  if (found == files.end()) {
    const std::vector<std::string> names = example_names(examples);
    const std::string near = nearest(like, names);
    throw CaseError({}, "--like", like.empty() ? "no case to begin with" : toml_string(like),
                    "one of" + by_folders(names), near.empty() ? "" : fmt::format("Did you mean {}?", near));
  }
  const fs::path own = (fs::path(folder) / "").parent_path();  // without a slash at its end
  require_empty(own);
  std::string text = content_of(found->second);
  const fs::path name = fs::absolute(own).lexically_normal().filename();
  BegunCase begun{(own / name).string() + ".toml", "", ""};
  const Node root = read_toml(text, found->second.string());
  fs::path source;
  if (const Node* file = find(root, "mesh.file")) {
    const std::string given = std::get<std::string>(file->value);
    const fs::path mesh = found->second.parent_path() / given;
    source = fs::exists(mesh) ? mesh : fs::path(mesh).replace_extension(".geo");
    begun.other_file = (own / source.filename()).string();
    if (source != mesh)
      begun.command = fmt::format("gmsh -3 {} -o {}", begun.other_file, (own / mesh.filename()).string());
    text = with_string(text, file->where.line, toml_string(given), toml_string(mesh.filename().string()));
  }
  std::error_code error;
  fs::create_directories(own, error);
  if (error) throw OutputError(own.string(), error.message());
  write_file(begun.case_file, text);
  if (!source.empty()) write_file(begun.other_file, content_of(source));
  return begun;
}

}  // namespace carom
