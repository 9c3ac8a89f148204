// Frames as .vtu files, each with its mesh, and a collection (.pvd) that gives them their times.
#include <fmt/format.h>

#include "output/frame_format.hpp"
#include "output/vtu.hpp"
#include "output/xml.hpp"

namespace carom {

namespace {

class VtuWriter : public FrameWriter {
 public:
  VtuWriter(std::string folder, FrameMesh mesh) : folder_(std::move(folder)), mesh_(std::move(mesh)) {}
  void write(const std::string& file, const FieldFrame& frame) override {
    write_vtu(folder_ + "/" + file, mesh_, frame);
  }

 private:
  std::string folder_;
  FrameMesh mesh_;
};

std::string entry(const std::string& /*folder*/, const FrameEntry& frame) {
  const auto line = [&](int part, const std::string& file) {
    return fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", frame.time, part,
                       xml_escape(file));
  };
  return frame.obstacles.empty() ? line(0, frame.file) : line(0, frame.file) + line(1, frame.obstacles);
}

constexpr IndexFile kCollection{"fields.pvd",
                                "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
                                "byte_order=\"LittleEndian\">\n<Collection>\n",
                                "</Collection>\n</VTKFile>\n", entry};

}  // namespace

FrameFormat vtu_format() {
  return {.name = "vtu",
          .end = ".vtu",
          .indices = {&kCollection, 1},
          .shares_mesh = false,
          .make_writer = [](const std::string& folder, std::string_view /*body*/, FrameMesh mesh)
              -> std::unique_ptr<FrameWriter> { return std::make_unique<VtuWriter>(folder, std::move(mesh)); }};
}

}  // namespace carom
