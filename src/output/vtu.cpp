#include "output/vtu.hpp"

#include <fmt/format.h>

#include <bit>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <vector>

#include "output/file_writer.hpp"
#include "output/xml.hpp"

namespace carom {

namespace {

static_assert(std::endian::native == std::endian::little, "raw appended data is written as little endian");
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// VTK's name of a type of numbers.
constexpr std::string_view vtk_type(double) {
  return "Float64";
}
constexpr std::string_view vtk_type(float) {
  return "Float32";
}
constexpr std::string_view vtk_type(Index) {
  return "Int32";
}
constexpr std::string_view vtk_type(std::int64_t) {
  return "Int64";
}
constexpr std::string_view vtk_type(std::uint8_t) {
  return "UInt8";
}

/// One array of the appended section: in the header with its offset, after it as a byte count and the bytes.
struct AppendedArray {
  const void* data;
  std::uint64_t bytes;
};

class VtuHeader {
 public:
  explicit VtuHeader(std::vector<AppendedArray>& arrays) : arrays_(arrays) {}

  void line(std::string_view text) { text_.append(text).push_back('\n'); }

  template <class T>
  void array(std::string_view name, int components, std::span<const T> values) {
    fmt::format_to(std::back_inserter(text_),
                   "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                   vtk_type(T{}), xml_escape(name), components, offset_);
    arrays_.push_back({values.data(), values.size_bytes()});
    offset_ += sizeof(std::uint64_t) + values.size_bytes();
  }

  void fields(std::string_view section, std::span<const FrameField> fixed, std::span<const FrameField> of_instant,
              [[maybe_unused]] std::size_t entries) {
    line(fmt::format("<{}>", section));
    for (const auto& fields : {fixed, of_instant}) {
      for (const FrameField& field : fields) {
        std::visit(
            [&]<class T>(const std::vector<T>& values) {
              assert(values.size() == entries * static_cast<std::size_t>(field.components));
              array(field.name, field.components, std::span<const T>(values));
            },
            field.values);
      }
    }
    line(fmt::format("</{}>", section));
  }

  const std::string& text() const { return text_; }

 private:
  std::vector<AppendedArray>& arrays_;
  std::string text_;
  std::uint64_t offset_ = 0;
};

}  // namespace

void write_vtu(const std::string& path, const FrameMesh& mesh, const FieldFrame& frame) {
  const std::span<const Vec3> points = mesh.points;
  const FrameCells& cells = mesh.cells;
  assert(cells.types.size() == cells.ends.size());
  const std::span<const double> coordinates(points.empty() ? nullptr : points.front().data(), 3 * points.size());

  std::vector<AppendedArray> arrays;
  VtuHeader header(arrays);
  header.line("<?xml version=\"1.0\"?>");
  header.line("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">");
  header.line("<UnstructuredGrid>");
  header.line(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", points.size(), cells.types.size()));
  header.fields("PointData", mesh.of_points, frame.points, points.size());
  header.fields("CellData", mesh.of_cells, frame.cells, cells.types.size());
  header.line("<Points>");
  header.array("Points", 3, coordinates);
  header.line("</Points>\n<Cells>");
  header.array("connectivity", 1, std::span<const Index>(cells.connectivity));
  header.array("offsets", 1, std::span<const Index>(cells.ends));
  header.array("types", 1, std::span<const std::uint8_t>(cells.types));
  header.line("</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">");

  FileWriter file(path);
  file.write(header.text());
  file.write("_");
  for (const AppendedArray& array : arrays) {
    file.write(&array.bytes, sizeof array.bytes);
    file.write(array.data, array.bytes);
  }
  file.write("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace carom
