#include "output/checkpoint_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "base/checksum.hpp"
#include "base/errors.hpp"
#include "output/hdf5_handle.hpp"

namespace carom {

namespace {

constexpr int kFormat = 4;
constexpr std::size_t kHeaderBytes = 1024;  // HDF5's user block, in front of what HDF5 writes: a power of 2 from 512 on
constexpr std::string_view kTitle = "carom checkpoint, format ", kHeaderSum = "header ";

using Descriptor = Handle<int, ::close>;
using hdf5::File, hdf5::Plist, hdf5::Space, hdf5::Set, hdf5::Type, hdf5::file_access;

Type variable_string() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  return Type(type);
}

class Writer : public Archive {
 public:
  Writer(hid_t file, std::string path) : file_(file), path_(std::move(path)), create_(H5Pcreate(H5P_DATASET_CREATE)) {
    H5Pset_obj_track_times(create_, false);  // equal values make equal files
  }

 protected:
  bool comes_in() const override { return false; }
  std::size_t extent(const std::string& /*key*/, std::size_t now) override { return now; }
  void numbers(const std::string& key, std::span<double> values) override {
    write(key, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data());
  }
  void whole_numbers(const std::string& key, std::span<std::int64_t> values) override {
    write(key, H5T_STD_I64LE, H5T_NATIVE_INT64, values.size(), values.data());
  }
  void texts(const std::string& key, std::span<std::string> values) override {
    std::vector<const char*> pointers;
    for (const std::string& text : values) pointers.push_back(text.c_str());
    const Type type = variable_string();
    write(key, type, type, values.size(), pointers.data());
  }

 private:
  void write(const std::string& key, hid_t type, hid_t memory_type, std::size_t count, const void* values) {
    const hsize_t extent = count;
    const Space space(H5Screate_simple(1, &extent, nullptr));
    Set set(H5Dcreate2(file_, key.c_str(), type, space, H5P_DEFAULT, create_, H5P_DEFAULT));
    const bool is_written =
        set >= 0 && (count == 0 || H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    if (!is_written) throw OutputError(path_, fmt::format("HDF5 could not write \"{}\": is the disk full?", key));
  }

  hid_t file_;
  std::string path_;
  Plist create_;
};

class Reader : public Archive {
 public:
  Reader(hid_t file, std::string path) : file_(file), path_(std::move(path)) {}

 protected:
  bool comes_in() const override { return true; }
  std::size_t extent(const std::string& key, std::size_t /*now*/) override {
    const Set set(H5Dopen2(file_, key.c_str(), H5P_DEFAULT));
    return extent_of(set, key);
  }
  void numbers(const std::string& key, std::span<double> values) override {
    read(key, H5T_FLOAT, H5T_NATIVE_DOUBLE, values.size(), values.data());
  }
  void whole_numbers(const std::string& key, std::span<std::int64_t> values) override {
    read(key, H5T_INTEGER, H5T_NATIVE_INT64, values.size(), values.data());
  }
  void texts(const std::string& key, std::span<std::string> values) override {
    std::vector<char*> pointers(values.size(), nullptr);
    const Type type = variable_string();
    read(key, H5T_STRING, type, values.size(), pointers.data());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = pointers[i] != nullptr ? pointers[i] : "";
    for (char* pointer : pointers) H5free_memory(pointer);
  }

 private:
  std::size_t extent_of(const Set& set, const std::string& key) const {
    const Space space(set >= 0 ? H5Dget_space(set) : -1);
    hsize_t extent = 0;
    if (space < 0 || H5Sget_simple_extent_ndims(space) != 1 || H5Sget_simple_extent_dims(space, &extent, nullptr) < 0)
      throw CheckpointError(path_, fmt::format("it has no values of \"{}\"", key));
    return extent;
  }

  void read(const std::string& key, H5T_class_t kind, hid_t memory_type, std::size_t count, void* values) const {
    const Set set(H5Dopen2(file_, key.c_str(), H5P_DEFAULT));
    const std::size_t found = extent_of(set, key);
    const Type type(H5Dget_type(set));
    if (found != count)
      throw CheckpointError(path_, fmt::format("it has {} values of \"{}\" and not {}", found, key, count));
    if (H5Tget_class(type) != kind) throw CheckpointError(path_, fmt::format("\"{}\" is of another type", key));
    if (count > 0 && H5Dread(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      throw CheckpointError(path_, fmt::format("HDF5 could not read \"{}\"", key));
  }

  hid_t file_;
  std::string path_;
};

struct Sum {
  std::uint64_t value = 0;
  std::size_t bytes = 0;
};

/// Of all bytes from the present place to the end.
Sum sum_of_rest(int descriptor, const std::string& path) {
  Sum sum;
  std::vector<char> buffer(std::size_t{1} << 20U);
  for (;;) {
    const ssize_t n = ::read(descriptor, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw CheckpointError(path, std::strerror(errno));
    if (n == 0) return sum;
    sum.value = checksum_of_bytes(buffer.data(), static_cast<std::size_t>(n), sum.value);
    sum.bytes += static_cast<std::size_t>(n);
  }
}

std::string header_of(const CheckpointInfo& info, const Sum& sum) {
  std::string text = fmt::format(
      "{}{}\nversion {}\ncompiler {}\nisa {}\ncase {:016x}\nmesh {:016x}\nbodies {:016x}\nnodes {}\nstep {}\ntime {}\n"
      "bytes {}\ndata {:016x}\n",
      kTitle, kFormat, info.version, info.compiler, info.isa, info.case_digest, info.mesh_digest, info.bodies_digest,
      info.nodes, info.step, info.time, sum.bytes, sum.value);
  text += fmt::format("{}{:016x}\n", kHeaderSum, checksum(text));
  text.resize(kHeaderBytes, '\n');
  return text;
}

/// The rest of the line that begins with `name` and a space.
std::string entry(const std::string& header, const std::string& name) {
  const std::size_t begin = header.find("\n" + name + " ");
  if (begin == std::string::npos) return {};
  const std::size_t first = begin + name.size() + 2;
  return header.substr(first, header.find('\n', first) - first);
}

/// Throws where the header is not as it was written.
void check_header(const std::string& header, const std::string& path) {
  if (header.size() < kHeaderBytes) throw CheckpointError(path, "it is cut off within its header");
  if (!header.starts_with(kTitle)) throw CheckpointError(path, "it is no checkpoint");
  const std::size_t last = header.rfind("\n" + std::string(kHeaderSum));
  const bool is_whole = last != std::string::npos &&
                        entry(header, "header") == fmt::format("{:016x}", checksum(header.substr(0, last + 1))) &&
                        header.find_first_not_of('\n', header.find('\n', last + 1)) == std::string::npos;
  if (!is_whole) throw CheckpointError(path, "its header is damaged (checksum)");
  const std::string format = header.substr(kTitle.size(), header.find('\n') - kTitle.size());
  if (format != std::to_string(kFormat))
    throw CheckpointError(path, fmt::format("it is of format {}; this program reads format {}", format, kFormat));
}

/// Puts the header in front and all of it onto the disk.
void seal(const std::string& path, const CheckpointInfo& info) {
  Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  if (file < 0 || ::lseek(file, kHeaderBytes, SEEK_SET) < 0) throw OutputError(path, std::strerror(errno));
  const std::string header = header_of(info, sum_of_rest(file, path));
  const bool is_written = ::pwrite(file, header.data(), header.size(), 0) == static_cast<ssize_t>(header.size());
  if (!is_written || ::fsync(file) != 0 || file.release() != 0) throw OutputError(path, std::strerror(errno));
}

void write_values(const std::string& path, const CheckpointContents& contents) {
  const QuietHdf5 quiet;
  const Plist create(H5Pcreate(H5P_FILE_CREATE)), access = file_access();
  H5Pset_userblock(create, kHeaderBytes);
  File file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, create, access));
  if (file < 0) throw OutputError(path, "cannot be made");
  Writer writer(file, path);
  contents(writer);
  if (file.release() < 0) throw OutputError(path, "HDF5 could not write it to its end: is the disk full?");
}

}  // namespace

void write_checkpoint(const std::string& path, const CheckpointInfo& info, const CheckpointContents& contents) {
  const std::string temporary = path + ".tmp";
  try {
    write_values(temporary, contents);
    seal(temporary, info);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0) throw OutputError(path, std::strerror(errno));
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const Descriptor directory(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory >= 0) ::fsync(directory);  // the name as well; not every file system can
}

CheckpointInfo verify_checkpoint(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file < 0) throw CheckpointError(path, std::strerror(errno));
  std::string header(kHeaderBytes, '\0');
  const ssize_t count = ::pread(file, header.data(), header.size(), 0);
  if (count < 0) throw CheckpointError(path, std::strerror(errno));
  header.resize(static_cast<std::size_t>(count));
  if (header.empty()) throw CheckpointError(path, "it is empty");
  check_header(header, path);
  ::lseek(file, kHeaderBytes, SEEK_SET);
  const Sum sum = sum_of_rest(file, path);
  const std::size_t bytes = std::stoull(entry(header, "bytes"));
  if (sum.bytes < bytes)
    throw CheckpointError(path, fmt::format("it is cut off: {} of {} bytes are there", sum.bytes, bytes));
  if (sum.bytes > bytes) throw CheckpointError(path, fmt::format("{} bytes have been added to it", sum.bytes - bytes));
  if (entry(header, "data") != fmt::format("{:016x}", sum.value))
    throw CheckpointError(path, "its values are damaged (checksum)");
  return {entry(header, "version"),
          entry(header, "compiler"),
          entry(header, "isa"),
          std::stoull(entry(header, "case"), nullptr, 16),
          std::stoull(entry(header, "mesh"), nullptr, 16),
          std::stoull(entry(header, "bodies"), nullptr, 16),
          std::stoll(entry(header, "nodes")),
          std::stoll(entry(header, "step")),
          std::stod(entry(header, "time"))};
}

void read_checkpoint(const std::string& path, const CheckpointContents& contents) {
  const QuietHdf5 quiet;
  const Plist access = file_access();
  const File file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access));
  if (file < 0) throw CheckpointError(path, "HDF5 cannot open it");
  Reader reader(file, path);
  try {
    contents(reader);
  } catch (const ArchiveError& e) {
    throw CheckpointError(path, e.what());
  }
}

}  // namespace carom
