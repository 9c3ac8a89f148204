#include "output/pvd.hpp"

#include <fmt/format.h>

#include <iterator>

#include "output/file_writer.hpp"
#include "output/xml.hpp"

namespace carom {

namespace {

std::string collection(const std::vector<PvdFrame>& frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
  const auto add = [&text](double time, int part, const std::string& file) {
    fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" group=\"\" part=\"{}\" file=\"{}\"/>\n", time,
                   part, xml_escape(file));
  };
  for (const PvdFrame& frame : frames) {
    add(frame.time, 0, frame.file);
    if (!frame.obstacles.empty()) add(frame.time, 1, frame.obstacles);
  }
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace

std::string frame_file(int step) {
  return fmt::format("fields/step_{:06}.vtu", step);
}

PvdCollection::PvdCollection(std::string path, std::vector<PvdFrame> frames)
    : path_(std::move(path)), frames_(std::move(frames)) {
  write_file(path_, collection(frames_));
}

void PvdCollection::add(double time, const std::string& file, const std::string& obstacles) {
  frames_.push_back({time, file, obstacles});
  write_file(path_, collection(frames_));
}

}  // namespace carom
