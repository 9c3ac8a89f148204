#include "mesh/read_gmsh.hpp"

#include <fmt/format.h>

#include <bit>

#include "mesh/finish_mesh.hpp"
#include "mesh/gmsh_sections.hpp"

namespace carom {

namespace {

/// 2.0 and 2.1 are read as 2.2: they differ in what tags after the first mean, which is not read.
enum class Version : std::uint8_t { v2_2, v4_1 };
enum class Flavour : std::uint8_t { text, little_endian, big_endian };

struct Header {
  Version version;
  std::string written;  ///< "2.2"
  Flavour flavour;
};

std::string read_version(GmshCursor& at) {
  const std::string version(at.word("the version of the format"));
  if (version == "2") return "2.0";
  if (version == "2.0" || version == "2.1" || version == "2.2" || version == "4.1") return version;
  at.fail("Gmsh format " + printable(version), "format 2.0 to 2.2, or 4.1",
          "Save the mesh in one of them (gmsh -save -format msh41 or msh22).");
}

Flavour binary_flavour(GmshCursor& at) {
  at.next_line();
  const std::string_view one = at.raw(4, "the integer 1 in binary");
  if (one == std::string_view("\1\0\0\0", 4)) return Flavour::little_endian;
  if (one == std::string_view("\0\0\0\1", 4)) return Flavour::big_endian;
  at.fail(printable(one), "the integer 1 in binary, because the header says binary (1)",
          "If the file is text, write 0 as the second number of the header.");
}

Header read_header(GmshCursor& at) {
  const std::string section = at.next_section();
  if (section == "$NOD") at.fail("Gmsh format 1", "format 2.0 to 2.2, or 4.1", "Save the mesh in one of them.");
  if (section != "$MeshFormat")
    at.fail(section.empty() ? "an empty file" : printable(section), "$MeshFormat",
            "A Gmsh file begins with the section $MeshFormat.");
  at.next_record();
  const std::string version = read_version(at);
  Header header{version == "4.1" ? Version::v4_1 : Version::v2_2, version, Flavour::text};
  const std::int64_t type = at.integer("the file type");
  if (type != 0 && type != 1) at.fail(fmt::format("file type {}", type), "0 for text or 1 for binary");
  const std::int64_t size = at.integer("the data size");
  if (size != 8) at.fail(fmt::format("data size {}", size), "8", "Save the mesh on a 64-bit system.");
  at.end_record();
  if (type == 1) header.flavour = binary_flavour(at);
  at.end_section();
  if (type == 1) at.locate_by_offset();
  return header;
}

/// Format 2.0 names a tag for all dimensions.
void read_physical_names(GmshCursor& at, bool has_dimensions, GmshMesh& mesh) {
  at.next_record();
  const std::int64_t count = at.integer("the number of physical names");
  check_declared(at, count, has_dimensions ? 6 : 4, "physical names");  // 0 1 ""
  at.end_record();
  for (std::int64_t i = 0; i < count; ++i) {
    at.next_record();
    const std::int64_t dimension = has_dimensions ? at.integer("a dimension") : GmshMesh::any_dimension;
    if ((has_dimensions && dimension < 0) || dimension > 3) at.fail(fmt::format("dimension {}", dimension), "0 to 3");
    const std::int64_t tag = at.integer("a physical tag");
    mesh.name_physical(static_cast<int>(dimension), tag, at.quoted("a physical name"));
    at.end_record();
  }
}

void require_nodes(const GmshCursor& at, const GmshMesh& mesh) {
  if (!mesh.has_nodes())
    at.fail("$Elements without $Nodes before", "$Nodes, then $Elements", "Save the mesh with its nodes.");
}

template <class Stream>
void read_section(const std::string& section, const Header& header, Stream& in, GmshEntities& entities,
                  GmshMesh& mesh) {
  const Version version = header.version;
  if (section == "$PhysicalNames")
    read_physical_names(in.cursor(), header.written != "2.0", mesh);
  else if (section == "$Nodes" && version == Version::v2_2)
    read_nodes_2(in, mesh);
  else if (section == "$Nodes")
    read_nodes_4(in, mesh);
  else if (section == "$Entities" && version == Version::v4_1)
    entities = read_entities_4(in);
  else if (section == "$Elements") {
    require_nodes(in.cursor(), mesh);
    if (version == Version::v2_2)
      read_elements_2(in, mesh);
    else
      read_elements_4(in, entities, mesh);
  } else if (section == "$PartitionedEntities") {
    in.cursor().fail("a partitioned mesh", "an unpartitioned one", "Save the mesh without partitions.");
  } else {
    in.cursor().skip_section();  // fields, periodicity and the like
    return;
  }
  in.cursor().end_section();
}

template <class Stream>
void read_sections(const Header& header, Stream in, GmshMesh& mesh) {
  GmshEntities entities;
  bool has_cells = false;
  for (std::string section = in.cursor().next_section(); !section.empty(); section = in.cursor().next_section()) {
    if (section == "$Elements" && has_cells)
      in.cursor().fail("a second list of cells", "one", "Remove one of the two $Elements sections.");
    has_cells = has_cells || section == "$Elements";
    read_section(section, header, in, entities, mesh);
  }
  if (!mesh.has_nodes()) in.cursor().fail("no section $Nodes", "$Nodes", "Save the mesh, not only the geometry.");
  if (!has_cells) in.cursor().fail("no section $Elements", "$Elements", "Save the mesh with its cells.");
}

}  // namespace

Mesh read_gmsh(std::string_view bytes, const std::string& source) {
  GmshCursor at(bytes, source);
  const Header header = read_header(at);
  GmshMesh collected;
  if (header.flavour == Flavour::text)
    read_sections(header, GmshText(at), collected);
  else
    read_sections(header,
                  GmshBinary(at, header.flavour == Flavour::little_endian ? std::endian::little : std::endian::big),
                  collected);
  if (header.version == Version::v2_2) collected.merge_repeated_cells();
  Mesh mesh = collected.take();
  mesh.report.source = source;
  mesh.report.format = fmt::format("Gmsh {} {}", header.written, header.flavour == Flavour::text ? "text" : "binary");
  return finished(std::move(mesh));
}

}  // namespace carom
