#include "output/pvd.hpp"

#include <fmt/format.h>

#include <iterator>

#include "output/file_writer.hpp"
#include "output/xml.hpp"

namespace carom {

namespace {

std::string collection(const std::vector<std::pair<double, std::string>>& frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto& [time, file] : frames) {
    fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", time,
                   xml_escape(file));
  }
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace

std::string frame_file(int step) {
  return fmt::format("fields/step_{:06}.vtu", step);
}

PvdCollection::PvdCollection(std::string path) : path_(std::move(path)) {
  write_file(path_, collection(frames_));
}

void PvdCollection::add(double time, const std::string& file) {
  frames_.emplace_back(time, file);
  write_file(path_, collection(frames_));
}

}  // namespace carom
