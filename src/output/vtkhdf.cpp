#include "output/vtkhdf.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/errors.hpp"
#include "output/file_writer.hpp"
#include "output/hdf5_handle.hpp"

namespace carom {

namespace {

using hdf5::File, hdf5::Group, hdf5::Plist, hdf5::Space, hdf5::Set, hdf5::Attribute, hdf5::Type, hdf5::file_access;

constexpr const char* kRoot = "/VTKHDF";
constexpr std::array<const char*, 2> kFieldGroups{"PointData", "CellData"};

/// Of NumberType, in its order.
hid_t hdf5_type(NumberType type) {
  const std::array<hid_t, 5> types{H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_NATIVE_INT32, H5T_NATIVE_INT64,
                                   H5T_NATIVE_UINT8};
  return types[static_cast<std::size_t>(type)];
}

template <class T>
NumberType number_type() {
  return static_cast<NumberType>(decltype(FrameField::values)(std::vector<T>{}).index());
}

/// A file that is being written.
class Output {
 public:
  explicit Output(std::string path) : path_(std::move(path)), temporary_(path_ + ".tmp") {
    { const FileWriter probe(path_); }  // says why, where a file cannot be made there
    const Plist access = file_access(), create(H5Pcreate(H5P_FILE_CREATE));
    // Headers of HDF5 1.10 make a frame of a small model a third smaller. Without times equal values make equal files.
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
    H5Pset_obj_track_times(create, false);
    H5Pset_obj_track_times(groups_, false);
    file_.emplace(H5Fcreate(temporary_.c_str(), H5F_ACC_TRUNC, create, access));
    H5Pset_link_creation_order(groups_, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    root_.emplace(H5Gcreate2(*file_, kRoot, H5P_DEFAULT, groups_, H5P_DEFAULT));
    check(*root_ >= 0);
    for (const char* group : kFieldGroups)
      check(Group(H5Gcreate2(*root_, group, H5P_DEFAULT, groups_, H5P_DEFAULT)) >= 0);
    describe();
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    root_.reset();
    file_.reset();
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  template <class T>
  void array(const std::string& name, const std::vector<T>& values, int components = 1) {
    array(name, number_type<T>(), values.data(), values.size(), components);
  }
  /// components: 1 is a plain list.
  void array(const std::string& name, NumberType type, const void* values, std::size_t count, int components) {
    const auto width = static_cast<hsize_t>(components);
    const std::array<hsize_t, 2> extent{count / width, width};
    const int rank = components > 1 ? 2 : 1;
    const Space space(H5Screate_simple(rank, extent.data(), nullptr));
    const Plist create(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_obj_track_times(create, false);
    constexpr hsize_t in_piece = 65536, not_worth_it = 256;
    if (count > not_worth_it) {
      const std::array<hsize_t, 2> piece{std::min(extent[0], in_piece / width), width};
      constexpr unsigned fastest = 1;
      H5Pset_chunk(create, rank, piece.data());
      H5Pset_shuffle(create);
      H5Pset_deflate(create, fastest);
    }
    const Set set(H5Dcreate2(*root_, name.c_str(), hdf5_type(type), space, H5P_DEFAULT, create, H5P_DEFAULT));
    check(set >= 0 && (count == 0 || H5Dwrite(set, hdf5_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0));
  }
  void fields(const char* group, const std::vector<FrameField>& fields) {
    for (const FrameField& field : fields)
      std::visit([&](const auto& values) { array(fmt::format("{}/{}", group, field.name), values, field.components); },
                 field.values);
  }
  /// An array of a file beside this one, in the same place.
  void link(const std::string& file, const VtkHdfArray& array) {
    const std::string there = fmt::format("{}/{}", kRoot, array.path());
    check(H5Lcreate_external(file.c_str(), there.c_str(), *root_, array.path().c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0);
  }
  void commit() {
    root_.reset();
    check(file_->release() >= 0);
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw OutputError(path_, std::strerror(errno));
    temporary_.clear();
  }

 private:
  void check(bool is_done) const {
    if (!is_done) throw OutputError(path_, "HDF5 could not write it: is the disk full?");
  }
  /// What the file is.
  void describe() const {
    constexpr std::array<int, 2> version{1, 0};
    constexpr std::string_view kind = "UnstructuredGrid";
    const hsize_t two = 2;
    const Space pair(H5Screate_simple(1, &two, nullptr)), one(H5Screate(H5S_SCALAR));
    const Type text(H5Tcopy(H5T_C_S1));
    H5Tset_size(text, kind.size());
    const Attribute number(H5Acreate2(*root_, "Version", H5T_NATIVE_INT, pair, H5P_DEFAULT, H5P_DEFAULT));
    const Attribute type(H5Acreate2(*root_, "Type", text, one, H5P_DEFAULT, H5P_DEFAULT));
    check(number >= 0 && H5Awrite(number, H5T_NATIVE_INT, version.data()) >= 0);
    check(type >= 0 && H5Awrite(type, text, kind.data()) >= 0);
  }

  std::string path_, temporary_;
  const Plist groups_{H5Pcreate(H5P_GROUP_CREATE)};
  std::optional<File> file_;
  std::optional<Group> root_;
};

/// XDMF's numbers of types (xdmf.org, "XDMF Model and Format", Topology), by VTK's.
Index xdmf_cell(std::uint8_t vtk) {
  switch (vtk) {
    case 3:
      return 2;  // line
    case 5:
      return 4;  // triangle
    case 9:
      return 5;  // quadrilateral
    case 10:
      return 6;  // tetrahedron
    case 14:
      return 7;  // pyramid
    case 13:
      return 8;  // wedge
    case 12:
      return 9;  // hexahedron
    case 21:
      return 34;  // and those of second order
    case 28:
      return 35;
    case 22:
      return 36;
    case 23:
      return 37;
    case 24:
      return 38;
    case 27:
      return 39;
    case 26:
      return 40;
    case 25:
      return 48;
    case 29:
      return 50;
    default:
      throw std::logic_error(fmt::format("cells of VTK's type {} have no number in XDMF", vtk));
  }
}

std::vector<Index> mixed(const FrameCells& cells) {
  std::vector<Index> list;
  list.reserve(cells.connectivity.size() + cells.types.size());
  constexpr std::uint8_t vtk_line = 3;
  auto from = cells.connectivity.begin();
  for (std::size_t k = 0; k < cells.types.size(); ++k) {
    const auto end = cells.connectivity.begin() + cells.ends[k];
    list.push_back(xdmf_cell(cells.types[k]));
    if (cells.types[k] == vtk_line) list.push_back(static_cast<Index>(end - from));
    list.insert(list.end(), from, end);
    from = end;
  }
  return list;
}

void write_mesh_file(const std::string& path, const FrameMesh& mesh) {
  const QuietHdf5 quiet;
  Output file(path);
  const auto number = [&](const char* name, std::size_t value) {
    file.array(name, std::vector<std::int64_t>{static_cast<std::int64_t>(value)});
  };
  number("NumberOfPoints", mesh.points.size());
  number("NumberOfCells", mesh.cells.types.size());
  number("NumberOfConnectivityIds", mesh.cells.connectivity.size());
  file.array("Points", NumberType::float64, mesh.points.data(), 3 * mesh.points.size(), 3);
  file.array("Connectivity", mesh.cells.connectivity);
  std::vector<Index> offsets{0};
  offsets.insert(offsets.end(), mesh.cells.ends.begin(), mesh.cells.ends.end());
  file.array("Offsets", offsets);
  file.array("Types", mesh.cells.types);
  file.array(mixed_topology, mixed(mesh.cells));
  file.fields("PointData", mesh.of_points);
  file.fields("CellData", mesh.of_cells);
  file.commit();
}

class VtkHdfWriter : public FrameWriter {
 public:
  /// The mesh is written at once, and needed no more.
  VtkHdfWriter(std::string folder, std::string_view body, const FrameMesh& mesh)
      : folder_(std::move(folder)), mesh_file_(fmt::format("{}.vtkhdf", body)) {
    const std::string path = fmt::format("{}/fields/{}", folder_, mesh_file_);
    write_mesh_file(path, mesh);
    of_mesh_ = vtkhdf_arrays(path);
  }

  void write(const std::string& file, const FieldFrame& frame) override {
    const QuietHdf5 quiet;
    Output out(folder_ + "/" + file);
    for (const VtkHdfArray& array : of_mesh_) out.link(mesh_file_, array);
    out.fields("PointData", frame.points);
    out.fields("CellData", frame.cells);
    out.commit();
  }

 private:
  std::string folder_, mesh_file_;
  std::vector<VtkHdfArray> of_mesh_;
};

[[noreturn]] void refuse(const std::string& path, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}; carom reads the frames that it writes", path, what));
}

File open_frame(const std::string& path) {
  const Plist access = file_access();
  return File(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access));
}

herr_t add_name(hid_t /*group*/, const char* name, const H5L_info_t* /*info*/, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::string> names_in(hid_t file, const std::string& group) {
  std::vector<std::string> names;
  const Group in(H5Gopen2(file, group.c_str(), H5P_DEFAULT));
  if (in >= 0) H5Literate(in, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, add_name, &names);
  return names;
}

/// The file that a link names; "" where an array is no link.
std::string linked_file(hid_t file, const std::string& path) {
  H5L_info_t info;
  if (H5Lget_info(file, path.c_str(), &info, H5P_DEFAULT) < 0 || info.type != H5L_TYPE_EXTERNAL) return {};
  std::string value(info.u.val_size, '\0');
  const char *name = nullptr, *place = nullptr;
  if (H5Lget_val(file, path.c_str(), value.data(), value.size(), H5P_DEFAULT) < 0 ||
      H5Lunpack_elink_val(value.data(), value.size(), nullptr, &name, &place) < 0)
    return {};
  return name;
}

/// Throws where there is no array of a known kind, or nothing at the end of a link.
VtkHdfArray array_at(hid_t file, VtkHdfArray array, const std::string& path) {
  const std::string place = fmt::format("{}/{}", kRoot, array.path());
  array.file = linked_file(file, place);
  const Set set(H5Dopen2(file, place.c_str(), H5P_DEFAULT));
  const Space space(set >= 0 ? H5Dget_space(set) : -1);
  const Type type(set >= 0 ? H5Dget_type(set) : -1);
  std::array<hsize_t, 2> extent{0, 1};
  const int rank = space >= 0 ? H5Sget_simple_extent_ndims(space) : -1;
  if (type < 0 || rank < 1 || rank > 2 || H5Sget_simple_extent_dims(space, extent.data(), nullptr) < 0)
    refuse(path, fmt::format("array \"{}\" is not there", array.path()));
  array.entries = extent[0];
  array.components = static_cast<int>(extent[1]);
  for (const NumberType known :
       {NumberType::float64, NumberType::float32, NumberType::int32, NumberType::int64, NumberType::uint8}) {
    array.type = known;
    if (H5Tequal(type, hdf5_type(known)) > 0) return array;
  }
  refuse(path, fmt::format("array \"{}\" is not understood", array.path()));
}

}  // namespace

std::unique_ptr<FrameWriter> make_vtkhdf_writer(
    const std::string& folder, std::string_view body,
    FrameMesh mesh) {  // NOLINT(performance-unnecessary-value-param): others keep it
  return std::make_unique<VtkHdfWriter>(folder, body, mesh);
}

std::vector<VtkHdfArray> vtkhdf_arrays(const std::string& path) {
  const QuietHdf5 quiet;
  const File file = open_frame(path);
  if (file < 0) refuse(path, "HDF5 cannot open it");
  std::vector<VtkHdfArray> arrays;
  for (const std::string& name : names_in(file, kRoot))
    if (std::find(kFieldGroups.begin(), kFieldGroups.end(), name) == kFieldGroups.end())
      arrays.push_back(array_at(file, {"", name}, path));
  for (const char* group : kFieldGroups)
    for (const std::string& name : names_in(file, fmt::format("{}/{}", kRoot, group)))
      arrays.push_back(array_at(file, {group, name}, path));
  return arrays;
}

std::vector<std::byte> read_vtkhdf(const std::string& path, const VtkHdfArray& array) {
  const QuietHdf5 quiet;
  const File file = open_frame(path);
  const Set set(file >= 0 ? H5Dopen2(file, fmt::format("{}/{}", kRoot, array.path()).c_str(), H5P_DEFAULT) : -1);
  const hid_t type = hdf5_type(array.type);
  std::vector<std::byte> bytes(array.entries * static_cast<std::size_t>(array.components) * H5Tget_size(type));
  const Space space(set >= 0 ? H5Dget_space(set) : -1);
  const bool fits = space >= 0 && H5Sget_simple_extent_npoints(space) ==
                                      static_cast<hssize_t>(array.entries) * static_cast<hssize_t>(array.components);
  if (!fits || (!bytes.empty() && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0))
    refuse(path, fmt::format("array \"{}\" cannot be read", array.path()));
  return bytes;
}

}  // namespace carom
