// Walks through an HDF5 file with libhdf5 and writes what it finds as records.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace carom {

/// The stream is a sequence of records in native byte order: a tag of one byte, then
///   group      path
///   attribute  path@name, int64
///   integers   path, rank (uint8), extents (uint64 each), values (int64 each)
///   reals      path, rank, extents, values (double each)
///   failure    path, found, expected; nothing follows
///   end        nothing follows
/// where a text is its length (uint64) and its bytes.
enum class Hdf5Record : char { group = 'G', attribute = 'A', integers = 'I', reals = 'R', failure = 'F', end = 'Z' };

/// Writes the records of all groups and data sets that are wanted, depth first in the order of names, to fd.
/// May crash or hang on damaged files: call it in a child process (isolated_process.hpp).
void visit_hdf5(std::string_view bytes, const std::function<bool(const std::string& path)>& wanted, int fd);

}  // namespace carom
