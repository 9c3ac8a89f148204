// Frames as HDF5 files (vtkhdf.hpp), and an index in XDMF 3 (xdmf.org, "XDMF Model and Format") that gives them their
// times and names their arrays.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

#include "output/frame_format.hpp"
#include "output/vtkhdf.hpp"
#include "output/xml.hpp"

namespace carom {

namespace {

/// file: of the frame. Arrays of the mesh are named where they are: ParaView's reader follows no links.
std::string data_item(const VtkHdfArray& array, const std::string& file) {
  struct Kind {
    const char* name;
    int bytes;
  };
  constexpr std::array<Kind, 5> kinds{{{"Float", 8}, {"Float", 4}, {"Int", 4}, {"Int", 8}, {"UChar", 1}}};
  const Kind& kind = kinds[static_cast<std::size_t>(array.type)];
  const std::string width = array.components > 1 ? fmt::format(" {}", array.components) : "";
  const std::string place = array.file.empty() ? file : file.substr(0, file.rfind('/') + 1) + array.file;
  return fmt::format(
      "<DataItem Format=\"HDF\" NumberType=\"{}\" Precision=\"{}\" Dimensions=\"{}{}\">{}:/VTKHDF/{}</DataItem>",
      kind.name, kind.bytes, array.entries, width, xml_escape(place), xml_escape(array.path()));
}

/// The grid of one instant. A tensor is a matrix of one row, since XDMF has its components in another order than VTK.
std::string grid(const std::string& folder, double time, const std::string& file) {
  const std::vector<VtkHdfArray> arrays = vtkhdf_arrays(folder + "/" + file);
  const auto of_mesh = [&](std::string_view name) -> const VtkHdfArray& {
    const auto found = std::find_if(arrays.begin(), arrays.end(),
                                    [&](const VtkHdfArray& a) { return a.group.empty() && a.name == name; });
    if (found == arrays.end()) throw std::runtime_error(fmt::format("{}/{}: it has no {}", folder, file, name));
    return *found;
  };
  std::string text =
      fmt::format("<Grid Name=\"{}\" GridType=\"Uniform\">\n<Time Value=\"{}\"/>\n", xml_escape(file), time);
  fmt::format_to(std::back_inserter(text), "<Topology TopologyType=\"Mixed\" NumberOfElements=\"{}\">{}</Topology>\n",
                 of_mesh("Types").entries, data_item(of_mesh(mixed_topology), file));
  fmt::format_to(std::back_inserter(text), "<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                 data_item(of_mesh("Points"), file));
  for (const VtkHdfArray& array : arrays) {
    if (array.group.empty()) continue;
    const char* kind = array.components == 1 ? "Scalar" : array.components == 3 ? "Vector" : "Matrix";
    fmt::format_to(std::back_inserter(text),
                   "<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", xml_escape(array.name),
                   kind, array.group == "PointData" ? "Node" : "Cell", data_item(array, file));
  }
  return text + "</Grid>\n";
}

std::string bodies(const std::string& folder, const FrameEntry& frame) {
  return grid(folder, frame.time, frame.file);
}

std::string obstacles(const std::string& folder, const FrameEntry& frame) {
  return frame.obstacles.empty() ? "" : grid(folder, frame.time, frame.obstacles);
}

constexpr std::string_view kTail = "</Grid>\n</Domain>\n</Xdmf>\n";
constexpr std::array<IndexFile, 2> kIndices{
    {{"fields.xdmf",
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "<Grid Name=\"bodies\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      kTail, bodies},
     {"obstacles.xdmf",
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
      "<Grid Name=\"obstacles\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      kTail, obstacles}}};

}  // namespace

FrameFormat xdmf_format() {
  return {
      .name = "xdmf", .end = ".vtkhdf", .indices = kIndices, .shares_mesh = true, .make_writer = make_vtkhdf_writer};
}

}  // namespace carom
