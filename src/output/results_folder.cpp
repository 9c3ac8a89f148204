#include "output/results_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/errors.hpp"
#include "output/file_writer.hpp"
#include "output/frame_format.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 16> kFiles{"shock_spectra.csv",
                                                  "probes_filtered.csv",
                                                  "contact_filtered.csv",
                                                  "summary.json",
                                                  "energy.csv",
                                                  "contact.csv",
                                                  "probes.csv",
                                                  "parts.csv",
                                                  "exact.csv",
                                                  "fields.pvd",
                                                  "mesh.txt",
                                                  resolved_case_file,
                                                  "report.html",
                                                  "watch.html",
                                                  "fields.xdmf",
                                                  "obstacles.xdmf"};

/// The digits of a name such as step_000010.vtu; "" where it has not this form.
std::string_view digits_of(std::string_view name, std::string_view begin, std::string_view end) {
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() <= begin.size() + end.size()) return {};
  name = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return name.find_first_not_of("0123456789") == std::string_view::npos ? name : std::string_view{};
}

/// As the recorder names them, or what an interrupted write of one left.
bool is_frame(std::string_view name) {
  if (name.ends_with(".tmp")) name.remove_suffix(4);
  const auto is_of = [name](const FrameFormat& format) {
    return !digits_of(name, "step_", format.end).empty() || !digits_of(name, "obstacles_", format.end).empty();
  };
  return std::ranges::any_of(frame_formats(), is_of);
}

/// The mesh that frames share, or what an interrupted write of it left.
bool is_mesh(std::string_view name) {
  if (name.ends_with(".tmp")) name.remove_suffix(4);
  return std::ranges::any_of(frame_formats(), [name](const FrameFormat& format) {
    return format.shares_mesh && (name == fmt::format("{}{}", bodies_mesh, format.end) ||
                                  name == fmt::format("{}{}", obstacles_mesh, format.end));
  });
}

constexpr std::string_view kCheckpoints = "checkpoints", kCheckpointEnd = ".h5";

bool is_checkpoint(std::string_view name) {
  if (name.ends_with(".tmp")) name.remove_suffix(4);
  const std::string_view step = digits_of(name, "step_", kCheckpointEnd);
  constexpr std::size_t most_digits = 18;  // of a long long
  return !step.empty() && step.size() <= most_digits;
}

void remove_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw OutputError(path.string(), "a folder has the name of a result file");
  fs::remove(path, error);
  if (error) throw OutputError(path.string(), error.message());
}

/// Removes the files of a folder, if there is one, whose name says so.
template <class Choose>
void remove_files(const fs::path& folder, const Choose& is_to_go) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (is_to_go(entry->path().filename().string())) remove_file(entry->path());
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
  remove_files(folder / "fields", [](const std::string& name) { return is_frame(name) || is_mesh(name); });
  remove_files(folder / kCheckpoints, is_checkpoint);
  const fs::path state = folder / kept_state_folder;
  remove_file(state / resolved_case_file);
  remove_files(state / kCheckpoints, is_checkpoint);
  fs::remove(state / kCheckpoints, error);  // where nothing else is in it
  fs::remove(state, error);
}

void continue_results_folder(const std::string& path, const std::vector<std::string>& frames) {
  const fs::path folder(path);
  for (const char* name :
       {"probes_filtered.csv", "contact_filtered.csv", "summary.json", "report.html", "watch.html"}) {
    remove_file(folder / name);
    remove_file(folder / (std::string(name) + ".tmp"));
  }
  remove_files(folder / "fields", [&](const std::string& name) {
    if (is_mesh(name)) return name.ends_with(".tmp");
    return is_frame(name) && std::find(frames.begin(), frames.end(), "fields/" + name) == frames.end();
  });
  remove_files(folder / kCheckpoints,
               [](const std::string& name) { return is_checkpoint(name) && name.ends_with(".tmp"); });
}

std::string checkpoint_file(long long step) {
  return fmt::format("{}/step_{:06}{}", kCheckpoints, step, kCheckpointEnd);
}

std::vector<std::string> checkpoint_files(const std::string& path) {
  std::vector<std::pair<long long, std::string>> found;
  std::error_code error;
  for (auto entry = fs::directory_iterator(fs::path(path) / kCheckpoints, error);
       !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (is_checkpoint(name) && name.ends_with(kCheckpointEnd))
      found.emplace_back(std::stoll(std::string(digits_of(name, "step_", kCheckpointEnd))),
                         fmt::format("{}/{}", kCheckpoints, name));
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<std::string> files;
  for (auto& [step, file] : found) files.push_back(std::move(file));
  return files;
}

}  // namespace carom
