#include "build/digests.hpp"

#include <span>
#include <string>
#include <vector>

#include "base/checksum.hpp"

namespace carom {

namespace {

template <class T>
void add_to(std::uint64_t& sum, const std::vector<T>& values) {
  const std::size_t count = values.size();
  sum = checksum_of_bytes(&count, sizeof count, sum);
  sum = checksum_of_bytes(values.data(), count * sizeof(T), sum);
}

void add_to(std::uint64_t& sum, const std::string& text) {
  sum = checksum_of_bytes(text.c_str(), text.size() + 1, sum);
}

}  // namespace

std::uint64_t mesh_digest(const Mesh& mesh) {
  std::uint64_t sum = 0;
  add_to(sum, mesh.coordinates);
  add_to(sum, mesh.node_numbers);
  for (const CellBlock& block : mesh.blocks) {
    add_to(sum, std::string(name(block.type)));
    add_to(sum, block.connectivity);
    add_to(sum, block.file_numbers);
  }
  for (const std::string& group : mesh.group_names()) {
    add_to(sum, group);
    add_to(sum, mesh.nodes_of(group));
  }
  for (const auto& [group, cells] : mesh.cell_groups) {
    add_to(sum, group);
    add_to(sum, cells);
  }
  return sum;
}

std::uint64_t bodies_digest(const Model& model, std::size_t nodes) {
  const std::vector<Vec3>& x = model.mesh->coordinates;
  std::uint64_t sum = 0;
  add_to(sum, std::vector<Vec3>(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(nodes)));
  for (const Part& part : model.parts) {
    add_to(sum, std::string(name(part.type)));
    const CellBlock& block = *model.mesh->block(part.type);
    for (const Index cell : part.cells)
      sum = checksum_of_bytes(block.nodes(cell).data(), block.nodes(cell).size_bytes(), sum);
  }
  return sum;
}

}  // namespace carom
