#include "output/results_folder.hpp"

#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "base/errors.hpp"
#include "output/file_writer.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> kFiles{"probes_filtered.csv", "summary.json", "energy.csv", "contact.csv",
                                                  "probes.csv",          "exact.csv",    "fields.pvd", "mesh.txt",
                                                  "case.resolved.toml",  "report.html"};

/// step_<digits>.vtu or obstacles_<digits>.vtu, as the recorder names them, or what an interrupted write of one left.
bool is_frame(std::string_view name) {
  const std::string_view begin = name.starts_with("step_") ? "step_" : "obstacles_";
  if (!name.starts_with(begin)) return false;
  name.remove_prefix(begin.size());
  const std::size_t digits = name.find_first_not_of("0123456789");
  if (digits == 0 || digits == std::string_view::npos) return false;
  const std::string_view end = name.substr(digits);
  return end == ".vtu" || end == ".vtu.tmp";
}

void remove_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw OutputError(path.string(), "a folder has the name of a result file");
  fs::remove(path, error);
  if (error) throw OutputError(path.string(), error.message());
}

void remove_frames(const fs::path& folder) {
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (is_frame(entry->path().filename().string())) remove_file(entry->path());
  }
  if (error) throw OutputError(folder.string(), error.message());
}

}  // namespace

void prepare_results_folder(const std::string& path) {
  const fs::path folder(path);
  std::error_code error;
  fs::create_directories(folder / "fields", error);
  if (error) throw OutputError(path, error.message());
  FileWriter probe((folder / ".carom_write_test").string());  // removed again: never committed
  for (const std::string_view name : kFiles) {
    remove_file(folder / name);
    remove_file(folder / (std::string(name) + ".tmp"));
  }
  remove_frames(folder / "fields");
}

}  // namespace carom
