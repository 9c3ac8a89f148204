#include "output/found_checkpoint.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "base/errors.hpp"
#include "output/results_folder.hpp"

namespace carom {

FoundCheckpoint find_checkpoint(const std::string& folder) {
  std::string reasons;
  for (const std::string& file : checkpoint_files(folder)) {
    const std::string path = (std::filesystem::path(folder) / file).string();
    try {
      return {path, verify_checkpoint(path), reasons};
    } catch (const CheckpointError& e) {
      reasons += fmt::format("{}{}", reasons.empty() ? "" : "; ", e.what());
    }
  }
  if (!reasons.empty()) throw CheckpointError(folder, "no checkpoint can be used: " + reasons);
  throw CheckpointError(
      folder,
      "there is no checkpoint in it (checkpoints/step_<number>.h5); carom run begins anew. When they are "
      "written is said in [output]: checkpoint_minutes, checkpoint_every");
}

void remove_later(const std::string& folder, const FoundCheckpoint& found) {
  for (const std::string& file : checkpoint_files(folder)) {
    const std::filesystem::path path = std::filesystem::path(folder) / file;
    if (path == found.path) return;
    std::error_code error;
    std::filesystem::remove(path, error);
    if (error) throw OutputError(path.string(), error.message());
  }
}

void refuse_others(const FoundCheckpoint& found, const CheckpointInfo& own) {
  const CheckpointInfo& its = found.info;
  const auto refuse = [&](const std::string& reason) { throw CheckpointError(found.path, reason); };
  if (its.version != own.version || its.compiler != own.compiler) {
    refuse(fmt::format(
        "it is of carom {} ({}) and this is carom {} ({}), whose results may differ in their last digits; go on "
        "with that one, or run anew",
        its.version, its.compiler, own.version, own.compiler));
  }
  if (its.case_digest != own.case_digest)
    refuse("it is of another case: case.resolved.toml has been changed since; put it back, or run anew");
  if (its.mesh_digest != own.mesh_digest)
    refuse("it is of another mesh: the mesh file has been changed since; put it back, or run anew");
}

}  // namespace carom
