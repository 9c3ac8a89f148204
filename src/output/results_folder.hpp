// The folder that holds everything one run leaves behind (docs/results.md).
#pragma once

#include <string>

namespace carom {

/// Creates `path` (and parents) and `path`/fields, and removes the files that an earlier run left there: only names
/// that carom writes, nothing else is touched. Throws OutputError when the folder cannot be made or written to.
void prepare_results_folder(const std::string& path);

}  // namespace carom
