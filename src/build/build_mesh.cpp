#include "build/build_mesh.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/errors.hpp"
#include "build/attached.hpp"
#include "build/rigid_bodies.hpp"
#include "build/rigid_parts.hpp"
#include "casefile/document.hpp"
#include "math/vec3.hpp"
#include "mesh/linear_cells.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/split_cells.hpp"
#include "mesh/structured_block.hpp"
#include "mesh/united.hpp"

namespace carom {

namespace {

Mesh mesh_of_file(const Case& given) {
  if (given.mesh.text) return read_mesh(*given.mesh.text, *given.mesh.file);
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

/// Groups of a file and of blocks have names of their own: what has both would seldom be meant.
void refuse_common_group(const CaseMesh& given, const Mesh& file, const Mesh& blocks) {
  const std::string name = common_group(file, blocks);
  if (name.empty()) return;
  throw CaseError(given.blocks.front().where, "mesh.block",
                  "group " + toml_string(name) + ", which " + toml_string(*given.file) + " has too",
                  "groups of other names than those of the file",
                  "Name it in the `groups` of the block (cells, xmin, ...); an empty name gives no group.");
}

Mesh bodies(const Case& given) {
  if (given.mesh.blocks.empty()) return mesh_of_file(given);
  Mesh blocks = make_structured_blocks(given.mesh.blocks);
  if (!given.mesh.text && given.mesh.file->empty()) return blocks;
  Mesh file = mesh_of_file(given);
  refuse_common_group(given.mesh, file, blocks);
  return united(std::move(file), blocks);
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

Mesh written_mesh(const Case& given) {
  Mesh mesh = bodies(given);
  if (given.mesh.order == CaseMesh::Order::linear) mesh = linear_cells(std::move(mesh));
  return mesh;
}

Mesh build_mesh(const Case& given) {
  Mesh mesh = written_mesh(given);
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
  append(rigid_positions(given, mesh));
  const double size = half_diagonal(mesh);
  for (const CaseContact& contact : given.contacts) append(carrier_positions(contact, size));
  return mesh;
}

std::size_t given_nodes(const Case& given, const Mesh& mesh) {
  return mesh.node_count() - ground_positions(given, mesh).size() - rigid_nodes(given) - carrier_nodes(given);
}

}  // namespace carom
