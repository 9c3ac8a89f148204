#include "run/build_mesh.hpp"

#include <algorithm>
#include <filesystem>

#include "base/errors.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/structured_block.hpp"

namespace carom {

namespace {

Mesh bodies(const Case& given) {
  if (!given.mesh.file->empty()) {
    const std::filesystem::path file = *given.mesh.file;
    const auto folder = std::filesystem::path(given.file).parent_path();
    const std::filesystem::path path = file.is_absolute() ? file : folder / file;
    if (!std::filesystem::is_regular_file(path)) {
      throw CaseError(given.mesh.file.where, "mesh.file", "\"" + *given.mesh.file + "\", and no file " + path.string(),
                      "a mesh file (.msh, .med)", "The path is relative to the folder of the case file.");
    }
    return read_mesh(path.string());
  }
  return make_structured_blocks(given.mesh.blocks);
}

}  // namespace

bool is_moving(const CaseContact& contact) {
  return contact.velocity.has_value() || contact.mass.has_value();
}

std::size_t moving_obstacles(const Case& given) {
  return static_cast<std::size_t>(std::count_if(given.contacts.begin(), given.contacts.end(), is_moving));
}

Mesh build_mesh(const Case& given) {
  Mesh mesh = bodies(given);
  std::int64_t last = 0;
  for (const std::int64_t number : mesh.node_numbers) last = std::max(last, number);
  for (const CaseContact& contact : given.contacts) {
    if (!is_moving(contact)) continue;
    mesh.coordinates.push_back(*contact.kind == CaseContact::Kind::sphere ? contact.centre : contact.point);
    mesh.node_numbers.push_back(++last);
  }
  return mesh;
}

}  // namespace carom
