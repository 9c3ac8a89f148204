#include "view/frame_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "mesh/cell_topology.hpp"
#include "output/vtkhdf.hpp"

namespace carom {

namespace {

using Type = StoredArray::Type;

struct TypeName {
  std::string_view vtk;
  Type type;
  std::size_t bytes;
};
constexpr std::array<TypeName, 5> kTypes{{{"Float32", Type::float32, 4},
                                          {"Float64", Type::float64, 8},
                                          {"Int32", Type::int32, 4},
                                          {"Int64", Type::int64, 8},
                                          {"UInt8", Type::uint8, 1}}};

std::size_t size_of(Type type) {
  return std::find_if(kTypes.begin(), kTypes.end(), [type](const TypeName& t) { return t.type == type; })->bytes;
}

template <class T>
T read_as(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// The value of an attribute of the element in this line; "" where it has none.
std::string_view attribute(std::string_view line, std::string_view name) {
  const std::string begin = fmt::format(" {}=\"", name);
  const std::size_t at = line.find(begin);
  if (at == std::string_view::npos) return {};
  line.remove_prefix(at + begin.size());
  return line.substr(0, line.find('"'));
}

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(const std::string& path, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}; carom reads the frames that it writes", path, what));
}

/// The array that a line of the header describes; its bytes stand in the appended section.
StoredArray array_of(std::string_view line, std::span<const std::byte> appended, const std::string& path) {
  const std::string name(attribute(line, "Name"));
  const std::string_view vtk = attribute(line, "type");
  const auto* const type =
      std::find_if(kTypes.begin(), kTypes.end(), [vtk](const TypeName& t) { return t.vtk == vtk; });
  const auto components = number<int>(attribute(line, "NumberOfComponents"));
  const auto offset = number<std::size_t>(attribute(line, "offset"));
  if (type == kTypes.end() || !components || *components < 1 || !offset)
    refuse(path, fmt::format("array \"{}\" is not understood", name));
  constexpr std::size_t head = sizeof(std::uint64_t);
  const bool has_head = *offset <= appended.size() && appended.size() - *offset >= head;
  const std::uint64_t bytes = has_head ? read_as<std::uint64_t>(appended.data() + *offset) : 0;
  if (!has_head || bytes > appended.size() - *offset - head)
    refuse(path, fmt::format("it is cut short in array \"{}\"", name));
  return {name, *components, type->type, appended.subspan(*offset + head, bytes)};
}

/// By VTK's number, the cell type and where each of its nodes stands in VTK's order.
struct FromVtk {
  CellType type{};
  std::vector<std::size_t> place;
};

std::optional<FromVtk> from_vtk(std::uint8_t number) {
  for (std::size_t t = 0; t < cell_traits.size(); ++t) {
    const auto type = static_cast<CellType>(t);
    const VtkCellType vtk = vtk_cell_type(type);
    if (vtk.number != number) continue;
    FromVtk found{type, std::vector<std::size_t>(static_cast<std::size_t>(node_count(type)))};
    for (std::size_t a = 0; a < found.place.size(); ++a) found.place[vtk.order.empty() ? a : vtk.order[a]] = a;
    return found;
  }
  return std::nullopt;
}

const StoredArray* find(std::span<const StoredArray> arrays, std::string_view name) {
  const auto found = std::find_if(arrays.begin(), arrays.end(), [name](const auto& a) { return a.name == name; });
  return found == arrays.end() ? nullptr : &*found;
}

}  // namespace

StoredArray::StoredArray(std::string its_name, int width, Type its_type, std::span<const std::byte> bytes)
    : name(std::move(its_name)),
      components(width),
      type(its_type),
      entries_(bytes.size() / (size_of(type) * static_cast<std::size_t>(components))),
      bytes_(bytes) {}

StoredArray::StoredArray(std::string its_name, int width, Type its_type, std::size_t entries,
                         std::function<std::vector<std::byte>()> read)
    : name(std::move(its_name)), components(width), type(its_type), entries_(entries), read_(std::move(read)) {}

std::span<const std::byte> StoredArray::bytes() const {
  if (!read_) return bytes_;
  if (!kept_.is_there) {
    kept_.bytes = read_();
    kept_.is_there = true;
  }
  return kept_.bytes;
}

double StoredArray::at(std::size_t entry, std::size_t component) const {
  const std::byte* from = bytes().data() + (entry * static_cast<std::size_t>(components) + component) * size_of(type);
  switch (type) {
    case Type::float32:
      return static_cast<double>(read_as<float>(from));
    case Type::float64:
      return read_as<double>(from);
    case Type::int32:
      return read_as<std::int32_t>(from);
    case Type::int64:
      return static_cast<double>(read_as<std::int64_t>(from));
    case Type::uint8:
      return read_as<std::uint8_t>(from);
  }
  return 0.0;
}

FrameFile::FrameFile(const std::string& path) : path_(path) {
  path.ends_with(xdmf_format().end) ? read_hdf5() : read_vtu();
  const auto all_have = [](std::span<const StoredArray> arrays, std::size_t entries) {
    return std::all_of(arrays.begin(), arrays.end(), [&](const StoredArray& a) { return a.entries() == entries; });
  };
  const bool is_whole = structure_.size() == 4 && structure_[0].entries() == points_ && structure_[0].components == 3 &&
                        (structure_[2].entries() == cells_ || structure_[2].entries() == cells_ + 1) &&
                        structure_[3].entries() == cells_;
  if (!is_whole || !all_have(point_fields_, points_) || !all_have(cell_fields_, cells_))
    refuse(path, "its arrays do not have as many entries as it has points and cells");
}

void FrameFile::read_hdf5() {
  structure_.resize(4);
  constexpr std::array<std::string_view, 4> structure{"Points", "Connectivity", "Offsets", "Types"};
  for (const VtkHdfArray& found : vtkhdf_arrays(path_)) {
    StoredArray array(found.name, found.components, found.type, found.entries,
                      [path = path_, found] { return read_vtkhdf(path, found); });
    const auto* const place = std::find(structure.begin(), structure.end(), found.name);
    if (found.group == "PointData")
      point_fields_.push_back(std::move(array));
    else if (found.group == "CellData")
      cell_fields_.push_back(std::move(array));
    else if (place != structure.end())
      structure_[static_cast<std::size_t>(place - structure.begin())] = std::move(array);
  }
  points_ = structure_[0].entries();
  cells_ = structure_[3].entries();
}

void FrameFile::read_vtu() {
  const std::string& path = path_;
  file_.emplace(path);
  const std::span<const std::byte> bytes = file_->bytes();
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());  // NOLINT: bytes as text
  constexpr std::string_view begin = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t end = all.find(begin);
  if (end == std::string_view::npos) refuse(path, "it has no appended raw data");
  const std::string_view header = all.substr(0, end);
  const std::span<const std::byte> appended = bytes.subspan(end + begin.size());
  std::vector<StoredArray>* section = nullptr;
  for (std::size_t at = 0; at < header.size();) {
    const std::size_t stop = std::min(header.find('\n', at), header.size());
    const std::string_view line = header.substr(at, stop - at);
    at = stop + 1;
    if (line.starts_with("<VTKFile") && attribute(line, "header_type") != "UInt64")
      refuse(path, "its arrays have no UInt64 headers");
    if (line.starts_with("<Piece")) {
      points_ = number<std::size_t>(attribute(line, "NumberOfPoints")).value_or(0);
      cells_ = number<std::size_t>(attribute(line, "NumberOfCells")).value_or(0);
    }
    if (line == "<PointData>") section = &point_fields_;
    if (line == "<CellData>") section = &cell_fields_;
    if (line == "<Points>") section = &structure_;
    if (line.starts_with("<DataArray") && section != nullptr) section->push_back(array_of(line, appended, path));
  }
}

const StoredArray* FrameFile::point_field(std::string_view name) const {
  return find(point_fields_, name);
}

const StoredArray* FrameFile::cell_field(std::string_view name) const {
  return find(cell_fields_, name);
}

Mesh FrameFile::mesh() const {
  Mesh mesh;
  mesh.coordinates.resize(points_);
  {
    const StoredArray points = structure_[0];  // its bytes go with it
    for (std::size_t i = 0; i < points_; ++i)
      for (std::size_t c = 0; c < 3; ++c) mesh.coordinates[i][c] = points.at(i, c);
  }
  const StoredArray connectivity = structure_[1], ends = structure_[2], types = structure_[3];
  const std::size_t before = ends.entries() - cells_;
  std::array<int, 256> block_of{};  // by VTK's number, plus one
  std::vector<FromVtk> orders;
  std::size_t first = 0;
  for (std::size_t k = 0; k < cells_; ++k) {
    const auto number = static_cast<std::uint8_t>(types.at(k));
    const auto end = static_cast<std::size_t>(ends.at(before + k));
    if (block_of[number] == 0) {
      std::optional<FromVtk> order = from_vtk(number);
      if (!order) refuse(path_, fmt::format("cells of VTK's type {}", number));
      mesh.blocks.push_back({order->type, {}, {}});
      if (k == 0) {  // most meshes have cells of one type
        mesh.blocks.back().connectivity.reserve(connectivity.entries());
        mesh.blocks.back().file_numbers.reserve(cells_);
      }
      orders.push_back(std::move(*order));
      block_of[number] = static_cast<int>(orders.size());
    }
    const auto b = static_cast<std::size_t>(block_of[number] - 1);
    if (end > connectivity.entries() || end - first != orders[b].place.size())
      refuse(path_, fmt::format("cell {} does not have the nodes of its type", k));
    for (const std::size_t place : orders[b].place) {
      const double node = connectivity.at(first + place);
      if (!(node >= 0.0) || node >= static_cast<double>(points_))
        refuse(path_, fmt::format("node {} is missing", node));
      mesh.blocks[b].connectivity.push_back(static_cast<Index>(node));
    }
    mesh.blocks[b].file_numbers.push_back(static_cast<std::int64_t>(k));
    first = end;
  }
  return mesh;
}

namespace {

/// The grids of an index in XDMF; none where it is not there.
std::vector<std::pair<double, std::string>> read_xdmf(const std::string& path) {
  std::ifstream stream(path);
  std::vector<std::pair<double, std::string>> grids;
  std::string file;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("<Grid") && attribute(line, "GridType") == "Uniform") file = attribute(line, "Name");
    if (!line.starts_with("<Time")) continue;
    const auto time = number<double>(attribute(line, "Value"));
    if (!time || file.empty()) throw std::runtime_error(fmt::format("{}: \"{}\" is not understood", path, line));
    grids.emplace_back(*time, file);
  }
  return grids;
}

std::vector<FrameEntry> read_collection(const std::string& path) {
  std::ifstream stream(path);
  std::vector<FrameEntry> frames;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("<DataSet")) continue;
    const auto time = number<double>(attribute(line, "timestep"));
    const std::string file(attribute(line, "file"));
    if (!time || file.empty()) throw std::runtime_error(fmt::format("{}: \"{}\" is not understood", path, line));
    if (attribute(line, "part") == "0") {
      frames.push_back({*time, file, ""});
    } else if (!frames.empty()) {
      frames.back().obstacles = file;
    }
  }
  return frames;
}

}  // namespace

std::vector<FrameEntry> read_frames(const std::string& folder) {
  std::vector<FrameEntry> frames = read_collection(folder + "/fields.pvd");
  for (auto& [time, file] : read_xdmf(folder + "/fields.xdmf")) frames.push_back({time, std::move(file), ""});
  std::map<double, std::string> obstacles;
  for (auto& [time, file] : read_xdmf(folder + "/obstacles.xdmf")) obstacles[time] = std::move(file);
  for (FrameEntry& frame : frames)
    if (const auto found = obstacles.find(frame.time); found != obstacles.end()) frame.obstacles = found->second;
  return frames;
}

}  // namespace carom
