#include "run/build_mesh.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/errors.hpp"
#include "casefile/document.hpp"
#include "math/vec3.hpp"
#include "mesh/linear_cells.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/split_cells.hpp"
#include "mesh/structured_block.hpp"
#include "run/attached.hpp"
#include "run/rigid_bodies.hpp"

namespace carom {

namespace {

Mesh bodies(const Case& given) {
  if (given.mesh.text) return read_mesh(*given.mesh.text, *given.mesh.file);
  if (!given.mesh.file->empty()) {
    const std::filesystem::path file = *given.mesh.file;
    const auto folder = std::filesystem::path(given.file).parent_path();
    const std::filesystem::path path = file.is_absolute() ? file : folder / file;
    if (!std::filesystem::is_regular_file(path)) {
      const bool has_escapes =
          std::any_of(file.native().begin(), file.native().end(), [](unsigned char c) { return c < 0x20; });
      throw CaseError(given.mesh.file.where, "mesh.file",
                      toml_string(*given.mesh.file) + ", and no file " + toml_string(path.string()),
                      "a mesh file (.msh, .med, .inp)",
                      has_escapes ? "A backslash in quotes begins a special character: write paths with /."
                                  : "The path is relative to the folder of the case file.");
    }
    return read_mesh(path.string());
  }
  return make_structured_blocks(given.mesh.blocks);
}

/// Of the box around all nodes.
double half_diagonal(const Mesh& mesh) {
  Vec3 size{};
  for (std::size_t c = 0; c < 3 && !mesh.coordinates.empty(); ++c) {
    const auto [least, most] = std::ranges::minmax(mesh.coordinates, {}, [c](const Vec3& X) { return X[c]; });
    size[c] = most[c] - least[c];
  }
  return 0.5 * norm(size);
}

}  // namespace

Mesh build_mesh(const Case& given) {
  Mesh mesh = bodies(given);
  if (given.mesh.order == CaseMesh::Order::linear) mesh = linear_cells(std::move(mesh));
  for (int i = 0; i < given.mesh.refine; ++i) mesh = split_cells(std::move(mesh));
  std::int64_t last = 0;
  for (const std::int64_t number : mesh.node_numbers) last = std::max(last, number);
  const auto append = [&](const std::vector<Vec3>& positions) {
    for (const Vec3& x : positions) {
      mesh.coordinates.push_back(x);
      mesh.node_numbers.push_back(++last);
    }
  };
  append(ground_positions(given, mesh));
  const double size = half_diagonal(mesh);
  for (const CaseContact& contact : given.contacts) append(carrier_positions(contact, size));
  return mesh;
}

std::size_t given_nodes(const Case& given, const Mesh& mesh) {
  return mesh.node_count() - ground_positions(given, mesh).size() - carrier_nodes(given);
}

}  // namespace carom
