// What is written is read back as it was.
#include "mesh/write_gmsh.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/structured_block.hpp"

namespace carom::mesh_write_gmsh_test {
namespace {

using Numbers = std::set<std::int64_t>;

std::map<std::string, Numbers> node_numbers(const Mesh& mesh) {
  std::map<std::string, Numbers> out;
  for (const std::string& group : mesh.group_names())
    for (const Index n : mesh.nodes_of(group)) out[group].insert(mesh.node_numbers[static_cast<std::size_t>(n)]);
  return out;
}

std::map<std::int64_t, Vec3> places(const Mesh& mesh) {
  std::map<std::int64_t, Vec3> out;
  for (std::size_t n = 0; n < mesh.node_count(); ++n) out[mesh.node_numbers[n]] = mesh.coordinates[n];
  return out;
}

/// The nodes of every cell, by their numbers, in their order.
std::map<std::int64_t, std::vector<std::int64_t>> cells(const Mesh& mesh, CellType type) {
  std::map<std::int64_t, std::vector<std::int64_t>> out;
  const CellBlock& block = *mesh.block(type);
  for (std::size_t k = 0; k < block.size(); ++k)
    for (const Index n : block.nodes(static_cast<Index>(k)))
      out[block.file_numbers[k]].push_back(mesh.node_numbers[static_cast<std::size_t>(n)]);
  return out;
}

TEST(WriteGmsh, BlockWithOverlappingGroups) {
  StructuredBlock block;
  block.size = {1.0, 1.0 / 3.0, 0.1};  // no short decimals
  block.divisions = {3, 2, 2};
  Mesh mesh = make_structured_blocks({block});
  mesh.node_groups["SOME"] = {0, 3, 5};
  mesh.node_groups["OTHERS"] = {3, 4};
  mesh.cell_groups["HALF"] = {{0, 1}, {0, 0}, {0, 1}};  // neither sorted nor unique
  const Mesh read = read_mesh(gmsh_text(mesh), "text");
  EXPECT_EQ(places(read), places(mesh));
  EXPECT_EQ(node_numbers(read), node_numbers(mesh));
  EXPECT_EQ(cells(read, CellType::hexa8), cells(mesh, CellType::hexa8));
  EXPECT_EQ(read.cell_groups.at("HALF").size(), 2U);
  EXPECT_EQ(read.cell_groups.at("BLOCK").size(), 12U);
}

/// The straight TETRA10 and HEXA20 of a block's corners: mid-side nodes between their ends, as cell_edges says.
TEST(WriteGmsh, QuadraticCellsKeepTheirOrder) {
  const std::map<CellType, std::vector<Vec3>> corners{
      {CellType::tetra10, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {CellType::hexa20, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}};
  for (const auto& [type, ends] : corners) {
    Mesh mesh;
    mesh.coordinates = ends;
    for (const auto& edge : cell_edges(type))
      mesh.coordinates.push_back(scaled(add(ends[edge[0]], ends[edge[1]]), 0.5));
    mesh.blocks.push_back({type, {}, {1}});
    for (std::size_t n = 0; n < mesh.node_count(); ++n) {
      mesh.node_numbers.push_back(static_cast<std::int64_t>(n) + 1);
      mesh.blocks[0].connectivity.push_back(static_cast<Index>(n));
    }
    ASSERT_EQ(mesh.node_count(), static_cast<std::size_t>(node_count(type)));
    EXPECT_EQ(cells(read_mesh(gmsh_text(mesh), "text"), type), cells(mesh, type)) << name(type);
  }
}

TEST(WriteGmsh, NamesThatTheFormatCannotHold) {
  StructuredBlock block;
  block.size = {1.0, 1.0, 1.0};
  const Mesh mesh = make_structured_blocks({block});
  for (const char* group : {"", "A+B", "\"", "A\nB"}) {
    Mesh named = mesh;
    named.node_groups[group] = {0};
    EXPECT_THROW(gmsh_text(named), CaseError) << group;
  }
}

}  // namespace
}  // namespace carom::mesh_write_gmsh_test
