// Damaged meshes and files that are none: each gets an error that says where, what and how to mend it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "mesh/hdf5_tree.hpp"
#include "mesh/med_mesh.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh_fixture.hpp"

namespace carom::mesh_malformed_test {
namespace {

using test::GmshEncoding;
using test::GmshVersion;

/// The message of the error that `read` throws.
template <class Read>
std::string message_of(const Read& read) {
  try {
    read();
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

std::string message_of_bytes(const std::string& bytes) {
  return message_of([&] { read_mesh(bytes, "bad.msh"); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t found = text.find(from);
  EXPECT_NE(found, std::string::npos) << from;
  return found == std::string::npos ? text : text.replace(found, from.size(), to);
}

/// A good file; every case below spoils one thing. Line numbers are counted here.
const std::string kGood =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"                                                          // 1-3
    "$PhysicalNames\n1\n3 1 \"BODY\"\n$EndPhysicalNames\n"                                            // 4-7
    "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n"  // 8-18
    "$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n";                                        // 19-22

const std::string kGood4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"                                         // 1-3
    "$Entities\n0 0 0 1\n1 0 0 0 1 1 1 1 1 0\n$EndEntities\n"                        // 4-7
    "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"  // 8-19
    "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";                        // 20-24

struct Spoiled {
  const char* what;
  std::string bytes;
  const char* message;  ///< the whole message after "bad.msh"
};

const std::vector<Spoiled> spoiled_texts{
    {"version", replaced(kGood, "2.2 0", "4.0 0"),
     ":2: $MeshFormat: found Gmsh format '4.0'; expected format 2.0 to 2.2, or 4.1. Save the mesh in one of them (gmsh "
     "-save -format msh41 or msh22)."},
    {"file type", replaced(kGood, "2.2 0", "2.2 2"),
     ":2: $MeshFormat: found file type 2; expected 0 for text or 1 for binary"},
    {"data size", replaced(kGood, "2.2 0 8", "2.2 0 4"),
     ":2: $MeshFormat: found data size 4; expected 8. Save the mesh on a 64-bit system."},
    {"format 1", "$NOD\n1\n1 0 0 0\n$ENDNOD\n",
     ":1: $NOD: found Gmsh format 1; expected format 2.0 to 2.2, or 4.1. Save the mesh in one of them."},
    {"no header", kGood.substr(kGood.find("$Nodes")),
     ":1: $Nodes: found '$Nodes'; expected $MeshFormat. A Gmsh file begins with the section $MeshFormat."},
    {"no nodes", replaced(replaced(kGood, "$Nodes", "$Other"), "$EndNodes", "$EndOther"),
     ":19: $Elements: found $Elements without $Nodes before; expected $Nodes, then $Elements. Save the mesh with its "
     "nodes."},
    {"no cells", kGood.substr(0, kGood.find("$Elements")),
     ":19: found no section $Elements; expected $Elements. Save the mesh with its cells."},
    {"nothing but a header", kGood.substr(0, kGood.find("$Physical")),
     ":4: found no section $Nodes; expected $Nodes. Save the mesh, not only the geometry."},
    {"zero cells", replaced(kGood, "1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n", "0\n"),
     ": found a mesh without cells; expected at least one cell. Save the mesh after meshing, with all its cells."},
    {"cut off early in the nodes", kGood.substr(0, kGood.find("1 1 1\n")),
     ":9: $Nodes: found 8 nodes declared with 51 bytes left in the file; expected at most 6. The count is wrong or "
     "the file cut off; write or copy it again."},
    {"cut off late in the nodes",
     replaced(kGood.substr(0, kGood.find("8 0 1 1")), "1 0 0 0", "1 0.0000000000000000 0 0"),
     ":17: $Nodes: found the end of the file; expected a node number. The file seems cut off; write or copy it "
     "again."},
    {"cut off before the end of a section", kGood.substr(0, kGood.find("$EndElements")),
     ":22: $Elements: found the end of the file; expected $EndElements. The file seems cut off; write or copy it "
     "again."},
    {"unknown section without end", kGood + "$NodeData\n1 2 3\n",
     ":23: $NodeData: found $NodeData without its end; expected $EndNodeData. The file seems cut off; write or copy "
     "it again."},
    {"word between sections", replaced(kGood, "$Elements", "hello\n$Elements"),
     ":19: found 'hello'; expected the beginning of a section, such as $Nodes. Remove what stands between the "
     "sections, or compare the counts with the lines of the section before."},
    {"10 GB of nodes", replaced(kGood, "$Nodes\n8", "$Nodes\n312500000"),
     ":9: $Nodes: found 312500000 nodes declared with 126 bytes left in the file; expected at most 15. The count is "
     "wrong or the file cut off; write or copy it again."},
    {"10 GB of cells", replaced(kGood, "$Elements\n1\n", "$Elements\n312500000\n"),
     ":20: $Elements: found 312500000 cells declared with 40 bytes left in the file; expected at most 5. The count "
     "is wrong or the file cut off; write or copy it again."},
    {"negative count", replaced(kGood, "$Nodes\n8", "$Nodes\n-8"),
     ":9: $Nodes: found -8 nodes; expected a count that is not negative. The file is damaged; write it again."},
    {"count too small", replaced(kGood, "$Nodes\n8", "$Nodes\n7"),
     ":17: $Nodes: found '8'; expected $EndNodes. Compare the count at the beginning of the section with what "
     "follows."},
    {"count too large", replaced(kGood, "$Nodes\n8", "$Nodes\n9"),
     ":18: $Nodes: found '$EndNodes'; expected a node number, an integer"},
    {"number that is none", replaced(kGood, "3 1 1 0", "3 1 one 0"),
     ":12: $Nodes: found 'one'; expected a coordinate, a number"},
    {"count beyond 64 bits", replaced(kGood, "$Nodes\n8", "$Nodes\n99999999999999999999"),
     ":9: $Nodes: found '99999999999999999999'; expected the number of nodes, an integer"},
    {"NaN", replaced(kGood, "3 1 1 0", "3 1 nan 0"),
     ":12: $Nodes: found node 3 at (1, nan, 0); expected finite coordinates. Write the mesh again; a coordinate "
     "overflowed or was never set."},
    {"overflow", replaced(kGood, "3 1 1 0", "3 1 1e999 0"),
     ":12: $Nodes: found node 3 at (1, inf, 0); expected finite coordinates. Write the mesh again; a coordinate "
     "overflowed or was never set."},
    {"node twice", replaced(kGood, "3 1 1 0", "2 1 1 0"),
     ":12: $Nodes: found node number 2 a second time; expected every node number once. Renumber the nodes, for "
     "instance by saving the mesh again from Gmsh."},
    {"node zero", replaced(kGood, "3 1 1 0", "0 1 1 0"),
     ":12: $Nodes: found node number 0; expected a positive number. Number the nodes from 1."},
    {"short line", replaced(kGood, "3 1 1 0", "3 1 1"),
     ":12: $Nodes: found the end of the line; expected a coordinate. A value is missing on this line."},
    {"long line", replaced(kGood, "3 1 1 0", "3 1 1 0 7"),
     ":12: $Nodes: found '7'; expected the end of the line. Compare the number of values with the type and the "
     "counts before."},
    {"node that is not there", replaced(kGood, "6 7 8\n", "6 7 9\n"),
     ":21: $Elements: found node 9 in cell 1; expected the number of a node in $Nodes. Save the mesh again with all "
     "its nodes, or correct the cell."},
    {"cell type of order 3", replaced(kGood, "1 5 2 1 1", "1 92 2 1 1"),
     ":21: $Elements: found 1 cell of type 92 (HEXA64); expected types 1 to 12 or 15 to 19 (points; lines, triangles, "
     "quadrangles, tetrahedra, pyramids, pentahedra and hexahedra of order 1 and 2). Mesh with order 1 or 2 "
     "(Mesh.ElementOrder)."},
    {"too few nodes in a cell", replaced(kGood, "5 6 7 8\n", "5 6 7\n"),
     ":21: $Elements: found the end of the line; expected a node number. A value is missing on this line."},
    {"tags without end", replaced(kGood, "1 5 2 1", "1 5 2000000000 1"),
     ":21: $Elements: found 2000000000 tags declared with 34 bytes left in the file; expected at most 17. The count "
     "is wrong or the file cut off; write or copy it again."},
    {"folded cell", replaced(kGood, "1 2 3 4 5 6 7 8\n", "1 2 3 4 5 7 6 8\n"),
     ": cell 1 (HEXA8): found Jacobians of both signs at the corners (from -1 to 1), at (0.5, 0.5, 0.5); expected a "
     "cell with volume, not folded, over distinct nodes. Mesh the place again, or write the node order of this cell "
     "anew."},
    {"repeated node", replaced(kGood, "6 7 8\n", "6 7 7\n"),
     ": cell 1 (HEXA8): found a node that occurs twice in the cell, at (0.625, 0.5, 0.5); expected a cell with "
     "volume, not folded, over distinct nodes. Mesh the place again, or write the node order of this cell anew."},
    {"name without quotes", replaced(kGood, "\"BODY\"", "BODY"),
     ":6: $PhysicalNames: found 'BODY'; expected a physical name in double quotes"},
    {"dimension of a name", replaced(kGood, "3 1 \"BODY\"", "4 1 \"BODY\""),
     ":6: $PhysicalNames: found dimension 4; expected 0 to 3"},
    {"second list of nodes", kGood.substr(0, kGood.find("$Elements")) + kGood.substr(kGood.find("$Nodes")),
     ":20: $Nodes: found a second list of nodes; expected one. Remove one of the two $Nodes sections."},
    {"second list of cells", kGood + kGood.substr(kGood.find("$Elements")),
     ":23: $Elements: found a second list of cells; expected one. Remove one of the two $Elements sections."},
    {"4.1: dimension", replaced(kGood4, "\n3 1 4 1\n", "\n7 1 4 1\n"),
     ":22: $Elements: found an entity of dimension 7; expected 0 to 3. The file is damaged; write it again."},
    {"4.1: cells on the wrong entity", replaced(kGood4, "\n3 1 4 1\n", "\n2 1 4 1\n"),
     ":22: $Elements: found TETRA4 on an entity of dimension 2; expected cells of the dimension of their entity. The "
     "file is damaged; write it again."},
    {"4.1: more nodes in the block", replaced(kGood4, "3 1 0 4\n", "3 1 0 5\n"),
     ":10: $Nodes: found 5 nodes in an entity block with 4 left; expected a sum over the blocks equal to the total. "
     "Correct the counts, or write the file again."},
    {"4.1: fewer cells in the blocks", replaced(kGood4, "$Elements\n1 1", "$Elements\n1 2"),
     ":23: $Elements: found 1 cells fewer in the blocks than declared; expected a sum over the blocks equal to the "
     "total. Correct the counts, or write the file again."},
    {"4.1: entities without end", replaced(kGood4, "$Entities\n0 0 0 1", "$Entities\n0 0 0 100000000"),
     ":5: $Entities: found 100000000 entities declared with 148 bytes left in the file; expected at most 14. The "
     "count is wrong or the file cut off; write or copy it again."},
    {"4.1: partitioned", replaced(kGood4, "$Entities", "$PartitionedEntities"),
     ":4: $PartitionedEntities: found a partitioned mesh; expected an unpartitioned one. Save the mesh without "
     "partitions."}};

TEST(MeshMalformed, TheFilesAreGoodBeforeTheyAreSpoiled) {
  EXPECT_EQ(read_mesh(kGood, "good.msh").block(CellType::hexa8)->size(), 1u);
  EXPECT_EQ(read_mesh(kGood4, "good.msh").block(CellType::tetra4)->size(), 1u);
}

TEST(MeshMalformed, TextFilesNameTheLine) {
  for (const Spoiled& spoiled : spoiled_texts)
    EXPECT_EQ(message_of_bytes(spoiled.bytes), std::string("bad.msh") + spoiled.message) << spoiled.what;
}

// Cells that are not read are counted, so that the user sees whether they are the mesh or a few left over.
TEST(MeshMalformed, CellsOfUnknownTypeAreCounted) {
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
  const std::string two = message_of_bytes(
      head + "$Elements\n4\n1 2 2 0 1 1 2 3\n2 13 2 0 1 1 2 3\n3 2 2 0 1 1 2 3\n4 13 2 0 1 1 2 3\n$EndElements\n");
  EXPECT_NE(two.find(":13: $Elements: found 2 cells of type 13 (PENTA18); expected types 1 to 12"), std::string::npos)
      << two;
  EXPECT_NE(two.find("Mesh.SecondOrderIncomplete = 1"), std::string::npos) << two;
  const std::string block = message_of_bytes(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
      "$Elements\n1 5 1 5\n3 1 29 5\n$EndElements\n");
  EXPECT_NE(block.find("found 5 cells of type 29 (TETRA20)"), std::string::npos) << block;
}

TEST(MeshMalformed, BytesThatAreNoMesh) {
  const std::string known =
      "; expected a mesh file: Gmsh 2.2 or 4.1 (.msh), MED 2.2 to 4 (.med), Abaqus or CalculiX "
      "(.inp). Export the mesh in one "
      "of these formats.";
  EXPECT_EQ(message_of_bytes(""), "bad.msh: found an empty file" + known);
  EXPECT_EQ(message_of_bytes(" \n\n"), "bad.msh: found an empty file" + known);
  EXPECT_EQ(message_of_bytes("*\n1, 0, 0, 0\n"), "bad.msh: found a file that begins with '*'" + known);
  EXPECT_EQ(message_of_bytes(std::string("\x7f"
                                         "ELF\0\0",
                                         6)),
            "bad.msh: found a file that begins with '\\x7fELF\\x00\\x00'" + known);
}

TEST(MeshMalformed, PathsThatAreNoFile) {
  EXPECT_EQ(message_of([] { read_mesh(std::string("/nowhere/beam.msh")); }),
            "/nowhere/beam.msh: found no readable file (No such file or directory); expected a mesh file: Gmsh 2.2 or "
            "4.1 (.msh), MED 2.2 to 4 (.med), Abaqus or CalculiX (.inp). Check the path; it is relative to the folder "
            "of the case file.");
  const std::string folder = CAROM_SOURCE_DIR "/cases";
  EXPECT_EQ(message_of([&] { read_mesh(folder); }),
            folder +
                ": found a folder; expected a mesh file: Gmsh 2.2 or 4.1 (.msh), MED 2.2 to 4 (.med), Abaqus or "
                "CalculiX (.inp). Name the file "
                "inside it.");
  EXPECT_EQ(message_of([] { read_mesh(std::string("/dev/null")); }),
            "/dev/null: found something that is not a regular file; expected a mesh file: Gmsh 2.2 or 4.1 (.msh), MED "
            "2.2 to 4 (.med), Abaqus or CalculiX (.inp)");
}

TEST(MeshMalformed, BinaryFlaggedAsTextAndTheReverse) {
  const Mesh mesh = test::sample_block();
  const std::string advice =
      "These are binary data; the second number of the header must be 1 for a binary file and 0 for text.";
  const std::string binary = test::gmsh_file(mesh, GmshVersion::v4_1, GmshEncoding::little_endian);
  EXPECT_EQ(message_of_bytes(replaced(binary, "4.1 1 8", "4.1 0 8")),
            "bad.msh:3: $MeshFormat: found '\\x01\\x00\\x00\\x00'; expected $EndMeshFormat. " + advice);
  const std::string old = replaced(test::gmsh_file(mesh, GmshVersion::v2_2, GmshEncoding::little_endian),
                                   std::string("2.2 1 8\n\1\0\0\0\n", 13), "2.2 0 8\n");
  const std::string message = message_of_bytes(old);
  EXPECT_NE(message.find("$Nodes: found '\\x"), std::string::npos) << message;
  EXPECT_NE(message.find(advice), std::string::npos) << message;
  EXPECT_EQ(
      message_of_bytes(replaced(kGood, "2.2 0 8", "2.2 1 8")),
      "bad.msh:3: $MeshFormat: found '$End'; expected the integer 1 in binary, because the header says binary (1). "
      "If the file is text, write 0 as the second number of the header.");
}

TEST(MeshMalformed, BinaryFilesNameTheByte) {
  const Mesh mesh = test::sample_block();
  const std::string good = test::gmsh_file(mesh, GmshVersion::v4_1, GmshEncoding::little_endian);
  const std::size_t nodes = good.find("$Nodes\n") + 7;
  EXPECT_EQ(message_of_bytes(good.substr(0, nodes + 100)),
            fmt::format("bad.msh: $Nodes, byte {}: found 60 nodes declared with 84 bytes left in the file; expected at "
                        "most 2. The count is wrong or the file cut off; write or copy it again.",
                        nodes + 8));
  std::string huge = good;
  huge.replace(nodes + 8, 8, std::string("\0\0\0\0\0\0\0\x10", 8));
  EXPECT_NE(message_of_bytes(huge).find("found 1152921504606846976 nodes declared with"), std::string::npos);
  std::string negative = good;
  negative.replace(nodes + 8, 8, std::string(8, '\xff'));
  EXPECT_NE(message_of_bytes(negative).find("found -1 nodes; expected a count that is not negative"),
            std::string::npos);

  const std::string old = test::gmsh_file(mesh, GmshVersion::v2_2, GmshEncoding::big_endian);
  const std::size_t cells = old.find("$Elements\n");
  const std::size_t data = old.find('\n', cells + 10) + 1;
  std::string type = old;
  type[data + 3] = 99;
  EXPECT_NE(message_of_bytes(type).find(fmt::format("$Elements, byte {}: found 1 cell of type 99", data)),
            std::string::npos);
  std::string block = old;
  block[data + 7] = 0;
  EXPECT_NE(message_of_bytes(block).find("found 0 cells in a block with"), std::string::npos);
  EXPECT_NE(message_of_bytes(old.substr(0, old.size() - 40)).find("The file seems cut off"), std::string::npos);
}

/// The message for a MED tree spoiled by `spoil`.
template <class Spoil>
std::string message_of_tree(const Spoil& spoil) {
  const std::string bytes = test::bytes_of(CAROM_SOURCE_DIR "/cases/sdnv100/meshes/sdnv100a.med");
  static const Hdf5Tree good = read_hdf5_tree(bytes, "good.med", [](const std::string&) { return true; });
  Hdf5Tree tree = good;
  spoil(tree);
  return message_of([&] { med_mesh(tree, "bad.med"); });
}

const std::string kStep = "/ENS_MAA/000000bf/-0000000000000000001-0000000000000000001";

std::vector<std::int64_t>& integers(Hdf5Tree& tree, const std::string& path) {
  return std::get<std::vector<std::int64_t>>(tree.data_sets.at(kStep + path).values);
}

TEST(MeshMalformed, MedTreesNameThePath) {
  EXPECT_EQ(message_of_tree([](Hdf5Tree&) {}), "no error");
  EXPECT_EQ(message_of_tree([](Hdf5Tree& t) { t.groups.erase("/INFOS_GENERALES"); }),
            "bad.med: /INFOS_GENERALES: found an HDF5 file without this group; expected a MED file. Export the mesh as "
            "MED (Salome, Code_Aster) or as Gmsh 2.2 or 4.1.");
  EXPECT_EQ(
      message_of_tree([](Hdf5Tree& t) { t.attributes["/INFOS_GENERALES@MAJ"] = 1; }),
      "bad.med: /INFOS_GENERALES: found MED 1.3; expected MED 2.2 to 4. Convert the file by the program medimport "
      "of the MED library (medimport OLD.med NEW.med), or write it again by a newer Salome.");
  EXPECT_EQ(
      message_of_tree([](Hdf5Tree& t) { t.groups.insert("/ENS_MAA/other"); }),
      "bad.med: /ENS_MAA: found 2 meshes (000000bf, other); expected one mesh. Write the mesh that is wanted alone "
      "into a file.");
  EXPECT_EQ(
      message_of_tree([](Hdf5Tree& t) { t.attributes["/ENS_MAA/000000bf@TYP"] = 1; }),
      "bad.med: /ENS_MAA/000000bf: found a structured mesh; expected an unstructured one. Convert it to cells with "
      "nodes.");
  EXPECT_EQ(message_of_tree([](Hdf5Tree& t) { t.attributes["/ENS_MAA/000000bf@ESP"] = 4; }),
            "bad.med: /ENS_MAA/000000bf: found space dimension 4; expected 1, 2 or 3");
  EXPECT_EQ(
      message_of_tree([](Hdf5Tree& t) { t.data_sets.erase(kStep + "/NOE/COO"); }),
      "bad.med: " + kStep + "/NOE/COO: found nothing; expected this data set. Write the mesh again as MED 3 or 4.");
  EXPECT_EQ(message_of_tree([](Hdf5Tree& t) { integers(t, "/MAI/HE8/NOD")[3] = 103; }),
            "bad.med: " + kStep +
                "/MAI/HE8/NOD: found node 103 in cell 129; expected 1 to 102. The file is damaged; "
                "write it again.");
  EXPECT_EQ(
      message_of_tree([](Hdf5Tree& t) { integers(t, "/MAI/HE8/NOD").pop_back(); }),
      "bad.med: " + kStep + "/MAI/HE8/NOD: found 191 node numbers; expected 8 for each of at most 2147483647 cells");
  EXPECT_EQ(message_of_tree([](Hdf5Tree& t) { integers(t, "/MAI/HE8/FAM")[0] = -77; }),
            "bad.med: " + kStep +
                "/MAI/HE8/FAM: found family -77; expected a family below /FAS. The file is damaged; "
                "write it again.");
  EXPECT_EQ(message_of_tree([](Hdf5Tree& t) { integers(t, "/NOE/FAM").push_back(0); }),
            "bad.med: " + kStep +
                "/NOE/FAM: found 103 values; expected 102, one for each entity. The file is damaged; "
                "write it again.");
  EXPECT_EQ(message_of_tree([](Hdf5Tree& t) { t.groups.insert(kStep + "/MAI/POG"); }),
            "bad.med: " + kStep +
                "/MAI/POG: found cell type POG; expected PO1, SE2, SE3, TR3, TR6, QU4, QU8, QU9, TE4, "
                "T10, PY5, P13, PE6, P15, HE8, H20 or H27. Mesh with cells of these types.");
}

TEST(MeshMalformed, HdfFilesThatAreDamaged) {
  const std::string good = test::bytes_of(CAROM_SOURCE_DIR "/cases/sdnv100/meshes/sdnv100a.med");
  const std::string advice =
      "; expected a whole HDF5 file. The file is damaged or not what it seems; write or copy it "
      "again.";
  EXPECT_EQ(message_of([&] { read_mesh(good.substr(0, good.size() / 2), "bad.med"); }),
            "bad.med: HDF5: found bytes that libhdf5 cannot open" + advice);
  EXPECT_EQ(message_of([&] { read_mesh(good.substr(0, 8), "bad.med"); }),
            "bad.med: HDF5: found bytes that libhdf5 cannot open" + advice);
}

// libhdf5 may crash on a damaged file, in a process of its own: no line of that file is wrong.
TEST(MeshMalformed, BytesThatLibhdf5CrashesOnAreSaidOfTheWholeFile) {
  const std::string bytes = test::bytes_of(CAROM_SOURCE_DIR "/cases/sdnv100/meshes/sdnv100a.med");
  try {
    read_hdf5_tree(bytes, "bad.med", [](const std::string&) -> bool { std::abort(); });
    FAIL() << "they were read";
  } catch (const CaseError& error) {
    EXPECT_TRUE(error.found().starts_with("bytes that libhdf5 cannot read")) << error.found();
    EXPECT_EQ(error.where().file, "bad.med");
    EXPECT_EQ(error.where().line, 0);
    EXPECT_EQ(error.where().column, 0);
  }
}

}  // namespace
}  // namespace carom::mesh_malformed_test
