// For the tests of the mesh folder: meshes in a form that does not depend on local numbering, and a writer of Gmsh
// files written from the format's description alone.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace carom::test {

/// A mesh by file numbers; two meshes with equal forms differ in local numbering only.
struct ByFileNumbers {
  std::map<std::int64_t, Vec3> nodes;
  std::map<std::string, std::map<std::int64_t, std::vector<std::int64_t>>> cells;  ///< type, cell, nodes
  std::map<std::string, std::set<std::int64_t>> node_groups;
  std::map<std::string, std::set<std::pair<std::string, std::int64_t>>> cell_groups;
  friend bool operator==(const ByFileNumbers&, const ByFileNumbers&) = default;
};

/// POINT1 cells are left out: Gmsh files need them to name nodes.
ByFileNumbers by_file_numbers(const Mesh& mesh);

enum class GmshVersion : std::uint8_t { v2_2, v4_1 };
enum class GmshEncoding : std::uint8_t { text, little_endian, big_endian };

/// Bytes of a Gmsh file of this mesh (linear cells only): 2.2 with names such as "A+B" for cells in several groups,
/// 4.1 with several physical tags per entity.
std::string gmsh_file(const Mesh& mesh, GmshVersion version, GmshEncoding encoding);

/// A block of 3 x 2 x 4 cells with two named points on one node and a group of faces besides.
Mesh sample_block();

/// The bytes of a file; fails the test when it cannot be read.
std::string bytes_of(const std::string& path);

/// Volume of a solid by its linear corners: HEXA8, HEXA20 (six tetrahedra, exact for flat faces).
double hexa_volume(const Mesh& mesh, const CellBlock& block, std::size_t cell);

}  // namespace carom::test
