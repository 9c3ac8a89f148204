// The folder that holds everything one run leaves behind (docs/results.md).
#pragma once

#include <string>
#include <vector>

namespace carom {

/// Files and folders of it that others name: the case as it is run, and what is kept of the run that its initial state
/// is from (that run's resolved case and checkpoint, in places of the same names).
inline constexpr const char* resolved_case_file = "case.resolved.toml";
inline constexpr const char* kept_state_folder = "initial_state";
/// A mesh that was given in memory. A later run does not remove it, since it may be the mesh of that run.
inline constexpr const char* given_mesh_file = "case.mesh.msh";

/// Creates `path` (and parents) and `path`/fields, and removes the files that an earlier run left there: only names
/// that carom writes, nothing else is touched. Throws OutputError when the folder cannot be made or written to.
void prepare_results_folder(const std::string& path);

/// Makes the folder ready for a run that goes on: removes what is written at the end of a run, and the frames (paths
/// relative to the folder) that are not among those to keep. Throws OutputError.
void continue_results_folder(const std::string& path, const std::vector<std::string>& frames);

/// Of a checkpoint within the folder.
std::string checkpoint_file(long long step);
/// The checkpoints of a folder, relative to it, the latest first.
std::vector<std::string> checkpoint_files(const std::string& path);

}  // namespace carom
