#include "mesh/hdf5_visitor.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh/isolated_process.hpp"

namespace carom {

namespace {

/// An HDF5 identifier that is closed at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it stands for the id

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// What is wrong with an object of the file.
struct Damage {
  std::string path, found, expected;
};

class Visitor {
 public:
  Visitor(const std::function<bool(const std::string&)>& wanted, std::uint64_t file_size, int fd)
      : wanted_(wanted), file_size_(file_size), fd_(fd) {}

  void group(hid_t parent, const std::string& name, const std::string& path) {
    constexpr int kDeepest = 16;  // MED needs 8; a loop of links goes on for ever
    constexpr int kMostObjects = 2'000'000;
    if (++depth_ > kDeepest || ++objects_ > kMostObjects)
      throw Damage{path, "groups nested or linked without end", "a tree"};
    const Handle here(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose);
    if (here < 0) throw Damage{path, "a group that cannot be opened", "a group"};
    record(Hdf5Record::group);
    text(path);
    attributes(here, path);
    for (const std::string& child : children(here, path)) object(here, child, (path == "/" ? "/" : path + "/") + child);
    --depth_;
  }

  void end() {
    record(Hdf5Record::end);
    flush();
  }

  void failure(const Damage& damage) {
    record(Hdf5Record::failure);
    text(damage.path);
    text(damage.found);
    text(damage.expected);
    flush();
  }

 private:
  static std::vector<std::string> children(hid_t group, const std::string& path) {
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5L_info_t* info, void* list) -> herr_t {
      if (info->type == H5L_TYPE_HARD) static_cast<std::vector<std::string>*>(list)->emplace_back(name);
      return 0;
    };
    hsize_t index = 0;
    if (H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, &index, add, &names) < 0)
      throw Damage{path, "a group whose entries cannot be listed", "a group"};
    std::sort(names.begin(), names.end());
    return names;
  }

  void object(hid_t parent, const std::string& name, const std::string& path) {
    if (!wanted_(path)) return;
    const Handle id(H5Oopen(parent, name.c_str(), H5P_DEFAULT), H5Oclose);
    if (id < 0) throw Damage{path, "an object that cannot be opened", "a group or a data set"};
    const H5I_type_t type = H5Iget_type(id);
    if (type == H5I_GROUP) group(parent, name, path);
    if (type == H5I_DATASET) data_set(id, path);
  }

  /// Scalar integer attributes.
  void attributes(hid_t group, const std::string& path) {
    std::vector<std::string> names;
    const auto add = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
      static_cast<std::vector<std::string>*>(list)->emplace_back(name);
      return 0;
    };
    hsize_t index = 0;
    if (H5Aiterate2(group, H5_INDEX_NAME, H5_ITER_INC, &index, add, &names) < 0)
      throw Damage{path, "attributes that cannot be listed", "attributes"};
    for (const std::string& name : names) {
      const Handle id(H5Aopen(group, name.c_str(), H5P_DEFAULT), H5Aclose);
      if (id < 0) throw Damage{path + "@" + name, "an attribute that cannot be opened", "an attribute"};
      const Handle type(H5Aget_type(id), H5Tclose), space(H5Aget_space(id), H5Sclose);
      if (H5Tget_class(type) != H5T_INTEGER || H5Sget_simple_extent_npoints(space) != 1) continue;
      std::int64_t value = 0;
      if (H5Aread(id, H5T_NATIVE_INT64, &value) < 0)
        throw Damage{path + "@" + name, "an attribute that cannot be read", "an integer"};
      record(Hdf5Record::attribute);
      text(path + "@" + name);
      bytes(&value, sizeof value);
    }
  }

  /// Refuses what lies outside the file or claims more values than the file can hold.
  void check_storage(hid_t set, const std::string& path, std::uint64_t bytes_declared) const {
    constexpr std::uint64_t kBestCompression = 1032;  // deflate cannot do better
    const Handle properties(H5Dget_create_plist(set), H5Pclose);
    const H5D_layout_t layout = H5Pget_layout(properties);
    if ((layout != H5D_CONTIGUOUS && layout != H5D_COMPACT && layout != H5D_CHUNKED) ||
        H5Pget_external_count(properties) != 0)
      throw Damage{path, "data outside this file", "data inside it"};
    const std::uint64_t stored = std::min<std::uint64_t>(H5Dget_storage_size(set), file_size_);
    if (bytes_declared > (layout == H5D_CHUNKED ? kBestCompression * stored : stored))
      throw Damage{path, fmt::format("{} bytes declared, {} stored", bytes_declared, stored), "as many as are stored"};
  }

  void data_set(hid_t set, const std::string& path) {
    const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
    std::vector<std::uint64_t> extents = extents_of(space, path);
    std::uint64_t count = 1;
    for (const std::uint64_t extent : extents) {
      if (extent != 0 && count > (std::uint64_t{1} << 40) / extent)
        throw Damage{path, fmt::format("{} values and more", count), "a size that the file can hold"};
      count *= extent;
    }
    const std::uint64_t value_size = H5Tget_size(type);
    check_storage(set, path, count * value_size);
    switch (H5Tget_class(type)) {
      case H5T_INTEGER:
        return values<std::int64_t>(set, path, Hdf5Record::integers, H5T_NATIVE_INT64, extents, count);
      case H5T_FLOAT:
        return values<double>(set, path, Hdf5Record::reals, H5T_NATIVE_DOUBLE, extents, count);
      case H5T_ARRAY:
        return character_array(set, type, path, extents, count);
      case H5T_STRING:
        if (H5Tis_variable_str(type) == 0) {
          extents.push_back(value_size);
          return characters(set, type, path, extents, count * value_size);
        }
        [[fallthrough]];
      default:
        throw Damage{path, "values of another kind", "integers, reals or texts of fixed length"};
    }
  }

  static std::vector<std::uint64_t> extents_of(hid_t space, const std::string& path) {
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 0 || rank > H5S_MAX_RANK) throw Damage{path, "a data set without extents", "a data set"};
    std::array<hsize_t, H5S_MAX_RANK> sizes{};
    if (H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0)
      throw Damage{path, "a data set without extents", "a data set"};
    return {sizes.begin(), sizes.begin() + rank};
  }

  /// An array of one-byte integers per entry, as MED writes names.
  void character_array(hid_t set, hid_t type, const std::string& path, std::vector<std::uint64_t> extents,
                       std::uint64_t count) {
    const Handle base(H5Tget_super(type), H5Tclose);
    hsize_t length = 0;
    if (H5Tget_class(base) != H5T_INTEGER || H5Tget_size(base) != 1 || H5Tget_array_ndims(type) != 1 ||
        H5Tget_array_dims2(type, &length) != 1)
      throw Damage{path, "arrays of another kind", "arrays of characters"};
    extents.push_back(length);
    characters(set, type, path, extents, count * length);
  }

  /// Reads in the file's own type, one byte per character, and writes integers.
  void characters(hid_t set, hid_t type, const std::string& path, const std::vector<std::uint64_t>& extents,
                  std::uint64_t count) {
    std::vector<unsigned char> letters(count);
    if (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, letters.data()) < 0)
      throw Damage{path, "a data set that cannot be read", "a data set"};
    write_values(path, Hdf5Record::integers, extents, std::vector<std::int64_t>(letters.begin(), letters.end()));
  }

  template <class T>
  void values(hid_t set, const std::string& path, Hdf5Record tag, hid_t memory_type,
              const std::vector<std::uint64_t>& extents, std::uint64_t count) {
    std::vector<T> data(count);
    if (count > 0 && H5Dread(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
      throw Damage{path, "a data set that cannot be read", "a data set"};
    write_values(path, tag, extents, data);
  }

  template <class T>
  void write_values(const std::string& path, Hdf5Record tag, const std::vector<std::uint64_t>& extents,
                    const std::vector<T>& data) {
    record(tag);
    text(path);
    const auto rank = static_cast<std::uint8_t>(extents.size());
    bytes(&rank, 1);
    bytes(extents.data(), extents.size() * sizeof(std::uint64_t));
    bytes(data.data(), data.size() * sizeof(T));
  }

  void record(Hdf5Record tag) { bytes(&tag, 1); }
  void text(const std::string& value) {
    const std::uint64_t size = value.size();
    bytes(&size, sizeof size);
    bytes(value.data(), value.size());
  }
  void bytes(const void* data, std::size_t size) {
    constexpr std::size_t kBuffer = 1 << 16;
    if (size > 0) buffer_.append(static_cast<const char*>(data), size);
    if (buffer_.size() >= kBuffer) flush();
  }
  void flush() {
    write_all(fd_, buffer_.data(), buffer_.size());
    buffer_.clear();
  }

  const std::function<bool(const std::string&)>& wanted_;
  std::uint64_t file_size_;
  int fd_;
  int depth_ = 0, objects_ = 0;
  std::string buffer_;
};

}  // namespace

void visit_hdf5(std::string_view bytes, const std::function<bool(const std::string& path)>& wanted, int fd) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Visitor visitor(wanted, bytes.size(), fd);
  try {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    constexpr std::size_t kIncrement = 1 << 16;
    H5Pset_fapl_core(access, kIncrement, false);
    H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size());  // libhdf5 copies it
    const Handle file(H5Fopen("image", H5F_ACC_RDONLY, access), H5Fclose);
    if (file < 0) throw Damage{"HDF5", "bytes that libhdf5 cannot open", "a whole HDF5 file"};
    visitor.group(file, "/", "/");
    visitor.end();
  } catch (const Damage& damage) {
    visitor.failure(damage);
  }
}

}  // namespace carom
