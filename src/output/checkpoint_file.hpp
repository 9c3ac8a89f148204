// A checkpoint on disk: values by name in an HDF5 file, behind a header that says what it is of and guards every byte
// (docs/resume.md).
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

#include "base/archive.hpp"

namespace carom {

/// A file that is no checkpoint, or none that can be used; the message names the file and the reason.
class CheckpointError : public std::runtime_error {
 public:
  CheckpointError(const std::string& path, const std::string& reason) : std::runtime_error(path + ": " + reason) {}
};

/// What a checkpoint is of.
struct CheckpointInfo {
  std::string version, compiler;  ///< of the program
  std::string isa;                ///< instruction set of the kernels
  std::uint64_t case_digest = 0, mesh_digest = 0;
  std::uint64_t bodies_digest = 0;  ///< of the nodes of the mesh as it is given and of the cells of the parts
  long long nodes = 0;              ///< number of the former
  long long step = 0;
  double time = 0.0;
};

using CheckpointContents = std::function<void(Archive&)>;

/// Writes the values that `contents` names. The file is on the disk, whole, before it gets its name. Throws
/// OutputError.
void write_checkpoint(const std::string& path, const CheckpointInfo& info, const CheckpointContents& contents);

/// Looks at every byte. Throws CheckpointError for what is not a whole checkpoint of this format.
CheckpointInfo verify_checkpoint(const std::string& path);

/// Puts the values of a file that has been verified where `contents` wants them. Throws CheckpointError where they are
/// not there or of other sizes.
void read_checkpoint(const std::string& path, const CheckpointContents& contents);

}  // namespace carom
