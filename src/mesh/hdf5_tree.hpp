// Part of an HDF5 file as plain values: integer attributes and numeric data sets by path.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace carom {

/// Paths look like "/ENS_MAA/beam/NOE/COO"; an attribute NUM of the group /FAS/beam is "/FAS/beam@NUM".
struct Hdf5Tree {
  struct DataSet {
    std::vector<std::uint64_t> extents;  ///< slowest first; fixed arrays and strings add their length at the end
    std::variant<std::vector<std::int64_t>, std::vector<double>> values;
  };
  std::set<std::string> groups;
  std::map<std::string, std::int64_t> attributes;
  std::map<std::string, DataSet> data_sets;
};

/// Reads the bytes of an HDF5 file; `wanted(path)` says which groups to enter and which data sets to read.
/// libhdf5 crashes, hangs or takes all memory on some damaged files, so it runs in a child process with limits
/// (isolated_process.hpp), and every extent is compared with the size of the file before it is read.
/// Only contiguous, compact and chunked data sets of integers, reals and fixed strings inside the file are read.
/// Throws CaseError, naming `source` and the path, for everything else.
Hdf5Tree read_hdf5_tree(std::string_view bytes, const std::string& source,
                        const std::function<bool(const std::string& path)>& wanted);

/// The stream that the child process sends back. Throws CaseError when it is not whole.
Hdf5Tree decode_hdf5_tree(std::string_view stream, const std::string& source);

}  // namespace carom
