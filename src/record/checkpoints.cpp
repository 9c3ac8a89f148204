#include "record/checkpoints.hpp"

#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "output/results_folder.hpp"

namespace carom {

Checkpoints::Checkpoints(std::string folder, const CaseOutput& when, CheckpointInfo origin)
    : folder_(std::move(folder)),
      every_steps_(when.checkpoint_every),
      every_(when.checkpoint_minutes > 0.0 ? 60.0 * when.checkpoint_minutes : std::numeric_limits<double>::infinity()),
      origin_(std::move(origin)) {}

bool Checkpoints::is_due(long long step) const {
  return (every_steps_ > 0 && step % every_steps_ == 0) || Clock::now() - last_ >= every_;
}

void Checkpoints::write(long long step, double time, const CheckpointContents& contents) {
  constexpr std::size_t kept = 2;
  const std::filesystem::path path = std::filesystem::path(folder_) / checkpoint_file(step);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) throw OutputError(path.parent_path().string(), error.message());
  CheckpointInfo info = origin_;
  info.step = step;
  info.time = time;
  write_checkpoint(path.string(), info, contents);
  const std::vector<std::string> all = checkpoint_files(folder_);
  for (std::size_t i = kept; i < all.size(); ++i)
    std::filesystem::remove(std::filesystem::path(folder_) / all[i], error);
  last_ = Clock::now();
}

}  // namespace carom
