#include "run/checkpoints.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "base/checksum.hpp"
#include "base/errors.hpp"
#include "output/results_folder.hpp"

namespace carom {

namespace {

template <class T>
void add_to(std::uint64_t& sum, const std::vector<T>& values) {
  const std::size_t count = values.size();
  sum = checksum_of_bytes(&count, sizeof count, sum);
  sum = checksum_of_bytes(values.data(), count * sizeof(T), sum);
}

void add_to(std::uint64_t& sum, const std::string& text) {
  sum = checksum_of_bytes(text.c_str(), text.size() + 1, sum);
}

}  // namespace

std::uint64_t mesh_digest(const Mesh& mesh) {
  std::uint64_t sum = 0;
  add_to(sum, mesh.coordinates);
  add_to(sum, mesh.node_numbers);
  for (const CellBlock& block : mesh.blocks) {
    add_to(sum, std::string(name(block.type)));
    add_to(sum, block.connectivity);
    add_to(sum, block.file_numbers);
  }
  for (const std::string& group : mesh.group_names()) {
    add_to(sum, group);
    add_to(sum, mesh.nodes_of(group));
  }
  for (const auto& [group, cells] : mesh.cell_groups) {
    add_to(sum, group);
    add_to(sum, cells);
  }
  return sum;
}

std::uint64_t bodies_digest(const Model& model, std::size_t nodes) {
  const std::vector<Vec3>& x = model.mesh->coordinates;
  std::uint64_t sum = 0;
  add_to(sum, std::vector<Vec3>(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(nodes)));
  for (const Part& part : model.parts) {
    add_to(sum, std::string(name(part.type)));
    const CellBlock& block = *model.mesh->block(part.type);
    for (const Index cell : part.cells)
      sum = checksum_of_bytes(block.nodes(cell).data(), block.nodes(cell).size_bytes(), sum);
  }
  return sum;
}

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
  if (its.isa != own.isa) {
    refuse(fmt::format(
        "it is of the instruction set {} and this run would take {}, whose results differ in their last digits; "
        "set the environment variable CAROM_ISA={} where the machine has it",
        its.isa, own.isa, its.isa));
  }
}

}  // namespace carom
