#include "mesh_fixture.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "math/vec3.hpp"
#include "mesh/structured_block.hpp"

namespace carom::test {

namespace {

/// Appends values as words or as bytes.
class Output {
 public:
  explicit Output(GmshEncoding encoding) : encoding_(encoding) {}
  void line(const std::string& text) { bytes_ += text + "\n"; }
  void integer(std::int64_t value) { put(static_cast<std::int32_t>(value)); }
  void size(std::size_t value) { put(static_cast<std::uint64_t>(value)); }
  void real(double value) { put(value); }
  void end_record() {
    if (encoding_ == GmshEncoding::text) bytes_ += "\n";
  }
  bool binary() const { return encoding_ != GmshEncoding::text; }
  std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void put(T value) {
    if (!binary()) {
      bytes_ += fmt::format("{} ", value);
      return;
    }
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if ((encoding_ == GmshEncoding::big_endian) != (std::endian::native == std::endian::big))
      std::reverse(raw.begin(), raw.end());
    bytes_.append(raw.data(), raw.size());
  }
  GmshEncoding encoding_;
  std::string bytes_;
};

struct Cell {
  CellType type;
  std::int64_t number;
  std::vector<std::int64_t> nodes;
};

/// The cells that are in exactly these groups; the place in the list (from 1) is the tag or entity.
using Families = std::vector<std::pair<std::set<std::string>, std::vector<Cell>>>;

const std::map<CellType, int> kNumbers{{CellType::point1, 15}, {CellType::line2, 1},  {CellType::quad4, 3},
                                       {CellType::tria3, 2},   {CellType::tetra4, 4}, {CellType::hexa8, 5},
                                       {CellType::penta6, 6},  {CellType::pyra5, 7}};

std::array<Families, 4> families_by_dimension(const Mesh& mesh) {
  std::map<CellRef, std::set<std::string>> groups;
  for (const auto& [name, cells] : mesh.cell_groups)
    for (const CellRef& cell : cells) groups[cell].insert(name);
  std::map<Index, std::set<std::string>> node_groups;
  for (const auto& [name, nodes] : mesh.node_groups)
    for (const Index node : nodes) node_groups[node].insert(name);
  std::array<std::map<std::set<std::string>, std::vector<Cell>>, 4> sorted;
  std::int64_t largest = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    const auto n = static_cast<std::size_t>(node_count(block.type));
    for (std::size_t c = 0; c < block.size(); ++c) {
      Cell cell{block.type, block.file_numbers[c], {}};
      for (std::size_t i = 0; i < n; ++i)
        cell.nodes.push_back(mesh.node_numbers[static_cast<std::size_t>(block.connectivity[c * n + i])]);
      sorted[static_cast<std::size_t>(dimension(block.type))][groups[{static_cast<Index>(b), static_cast<Index>(c)}]]
          .push_back(cell);
      largest = std::max(largest, cell.number);
    }
  }
  for (const auto& [node, names] : node_groups)
    sorted[0][names].push_back({CellType::point1, ++largest, {mesh.node_numbers[static_cast<std::size_t>(node)]}});
  std::array<Families, 4> result;
  for (std::size_t d = 0; d < 4; ++d) result[d].assign(sorted[d].begin(), sorted[d].end());
  return result;
}

/// 2.2: one name per family; 4.1: one per group. Returns (dimension, name) -> tag.
std::map<std::pair<std::size_t, std::string>, std::size_t> write_names(Output& out, GmshVersion version,
                                                                       const std::array<Families, 4>& families) {
  std::map<std::pair<std::size_t, std::string>, std::size_t> tags;
  for (std::size_t d = 0; d < 4; ++d)
    for (const auto& [names, cells] : families[d]) {
      if (version == GmshVersion::v2_2 && !names.empty())
        tags.emplace(std::pair{d, fmt::format("{}", fmt::join(names, "+"))}, tags.size() + 1);
      if (version == GmshVersion::v4_1)
        for (const std::string& name : names) tags.emplace(std::pair{d, name}, tags.size() + 1);
    }
  out.line("$PhysicalNames");
  out.line(std::to_string(tags.size()));
  for (const auto& [key, tag] : tags) out.line(fmt::format("{} {} \"{}\"", key.first, tag, key.second));
  out.line("$EndPhysicalNames");
  return tags;
}

using Tags = std::map<std::pair<std::size_t, std::string>, std::size_t>;

void write_2_2(Output& out, const Mesh& mesh, const std::array<Families, 4>& families, const Tags& tags) {
  out.line("$Nodes");
  out.line(std::to_string(mesh.node_count()));
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    out.integer(mesh.node_numbers[i]);
    for (const double x : mesh.coordinates[i]) out.real(x);
    out.end_record();
  }
  out.line(out.binary() ? "\n$EndNodes" : "$EndNodes");
  std::size_t total = 0;
  for (const Families& list : families)
    for (const auto& [names, cells] : list) total += cells.size();
  out.line("$Elements");
  out.line(std::to_string(total));
  for (std::size_t d = 0; d < 4; ++d)
    for (const auto& [names, cells] : families[d]) {
      const auto tag = names.empty() ? 0 : tags.at({d, fmt::format("{}", fmt::join(names, "+"))});
      for (const Cell& cell : cells) {
        if (out.binary()) {
          for (const int value : {kNumbers.at(cell.type), 1, 2}) out.integer(value);
          out.integer(cell.number);
        } else {
          out.integer(cell.number);
          for (const int value : {kNumbers.at(cell.type), 2}) out.integer(value);
        }
        out.integer(static_cast<std::int64_t>(tag));
        out.integer(7);  // elementary tag
        for (const std::int64_t node : cell.nodes) out.integer(node);
        out.end_record();
      }
    }
  out.line(out.binary() ? "\n$EndElements" : "$EndElements");
}

void write_entities(Output& out, const std::array<Families, 4>& families, const Tags& tags) {
  out.line("$Entities");
  for (const Families& list : families) out.size(list.size());
  out.end_record();
  for (std::size_t d = 0; d < 4; ++d)
    for (std::size_t e = 0; e < families[d].size(); ++e) {
      out.integer(static_cast<std::int64_t>(e) + 1);
      for (int i = 0; i < (d == 0 ? 3 : 6); ++i) out.real(0.5);
      out.size(families[d][e].first.size());
      for (const std::string& name : families[d][e].first) out.integer(static_cast<std::int64_t>(tags.at({d, name})));
      if (d > 0) {
        out.size(1);
        out.integer(-1);
      }
      out.end_record();
    }
  out.line(out.binary() ? "\n$EndEntities" : "$EndEntities");
}

void write_4_1(Output& out, const Mesh& mesh, const std::array<Families, 4>& families, const Tags& tags) {
  write_entities(out, families, tags);
  const std::size_t n = mesh.node_count();
  out.line("$Nodes");
  for (const std::size_t value : {std::size_t{1}, n, std::size_t{1}, n}) out.size(value);
  out.end_record();
  for (const int value : {3, 1, 0}) out.integer(value);
  out.size(n);
  out.end_record();
  for (const std::int64_t number : mesh.node_numbers) {
    out.size(static_cast<std::size_t>(number));
    out.end_record();
  }
  for (const Vec3& x : mesh.coordinates) {
    for (const double component : x) out.real(component);
    out.end_record();
  }
  out.line(out.binary() ? "\n$EndNodes" : "$EndNodes");
  std::size_t blocks = 0, total = 0;
  for (const Families& list : families)
    for (const auto& [names, cells] : list) {
      ++blocks;
      total += cells.size();
    }
  out.line("$Elements");
  for (const std::size_t value : {blocks, total, std::size_t{1}, total}) out.size(value);
  out.end_record();
  for (std::size_t d = 0; d < 4; ++d)
    for (std::size_t e = 0; e < families[d].size(); ++e) {
      const std::vector<Cell>& cells = families[d][e].second;
      out.integer(static_cast<std::int64_t>(d));
      out.integer(static_cast<std::int64_t>(e) + 1);
      out.integer(kNumbers.at(cells[0].type));
      out.size(cells.size());
      out.end_record();
      for (const Cell& cell : cells) {
        out.size(static_cast<std::size_t>(cell.number));
        for (const std::int64_t node : cell.nodes) out.size(static_cast<std::size_t>(node));
        out.end_record();
      }
    }
  out.line(out.binary() ? "\n$EndElements" : "$EndElements");
}

}  // namespace

ByFileNumbers by_file_numbers(const Mesh& mesh) {
  ByFileNumbers form;
  for (std::size_t i = 0; i < mesh.node_count(); ++i) form.nodes[mesh.node_numbers[i]] = mesh.coordinates[i];
  for (const CellBlock& block : mesh.blocks) {
    if (block.type == CellType::point1) continue;
    const auto n = static_cast<std::size_t>(node_count(block.type));
    for (std::size_t c = 0; c < block.size(); ++c) {
      auto& nodes = form.cells[std::string(name(block.type))][block.file_numbers[c]];
      for (std::size_t i = 0; i < n; ++i)
        nodes.push_back(mesh.node_numbers[static_cast<std::size_t>(block.connectivity[c * n + i])]);
    }
  }
  for (const auto& [group, nodes] : mesh.node_groups)
    for (const Index node : nodes) form.node_groups[group].insert(mesh.node_numbers[static_cast<std::size_t>(node)]);
  for (const auto& [group, cells] : mesh.cell_groups)
    for (const CellRef& ref : cells) {
      const CellBlock& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
      form.cell_groups[group].emplace(name(block.type), block.file_numbers[static_cast<std::size_t>(ref.cell)]);
    }
  return form;
}

std::string gmsh_file(const Mesh& mesh, GmshVersion version, GmshEncoding encoding) {
  Output out(encoding);
  out.line("$MeshFormat");
  out.line(fmt::format("{} {} 8", version == GmshVersion::v2_2 ? "2.2" : "4.1", out.binary() ? 1 : 0));
  if (out.binary()) {
    out.integer(1);
    out.line("");
  }
  out.line("$EndMeshFormat");
  const std::array<Families, 4> families = families_by_dimension(mesh);
  const Tags tags = write_names(out, version, families);
  if (version == GmshVersion::v2_2)
    write_2_2(out, mesh, families, tags);
  else
    write_4_1(out, mesh, families, tags);
  return out.take();
}

Mesh sample_block() {
  StructuredBlock block;
  block.origin = {0.1, -0.2, 0.3};
  block.size = {0.3, 0.2, 0.8};
  block.divisions = {3, 2, 4};
  block.points = {{"A", {0.1, -0.2, 0.3}, {}}, {"ORIGIN", {0.1, -0.2, 0.3}, {}}, {"B", {0.4, 0.0, 1.1}, {}}};
  return make_structured_blocks({block});
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

double hexa_volume(const Mesh& mesh, const CellBlock& block, std::size_t cell) {
  constexpr std::array<std::array<std::size_t, 4>, 6> kTetrahedra{
      {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};
  const auto n = static_cast<std::size_t>(node_count(block.type));
  const auto x = [&](std::size_t i) {
    return mesh.coordinates[static_cast<std::size_t>(block.connectivity[cell * n + i])];
  };
  double volume = 0;
  for (const auto& t : kTetrahedra)
    volume += dot(cross(subtract(x(t[1]), x(t[0])), subtract(x(t[2]), x(t[0]))), subtract(x(t[3]), x(t[0]))) / 6;
  return volume;
}

}  // namespace carom::test
