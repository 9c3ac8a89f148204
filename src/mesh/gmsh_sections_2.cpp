#include <fmt/format.h>

#include <array>
#include <span>

#include "mesh/gmsh_sections.hpp"

namespace carom {

namespace {

/// The count is text in both flavours.
std::int64_t declared_count(GmshCursor& at, std::string_view items) {
  at.next_record();
  const std::int64_t count = at.integer(fmt::format("the number of {}", items));
  at.end_record();
  return count;
}

/// The tags of one cell; only the first, the physical tag, is kept.
template <class Stream>
std::int64_t physical_tag(Stream& in, std::int64_t count) {
  in.check_count(count, {.integers = 1}, "tags");
  std::int64_t physical = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t tag = in.integer("a tag");
    if (i == 0) physical = tag;
  }
  return physical;
}

template <class Stream>
void read_cell(Stream& in, GmshMesh& mesh, const GmshCellType& type, std::int64_t number, std::int64_t tag_count) {
  const std::int64_t physical = physical_tag(in, tag_count);
  std::array<std::int64_t, 27> nodes{};
  const std::span<std::int64_t> used(nodes.data(), static_cast<std::size_t>(node_count(type.type)));
  for (std::int64_t& node : used) node = in.integer("a node number");
  mesh.add_cell(in.cursor(), type, number, used, std::span(&physical, 1));
}

/// How many of the `left` cells on the lines from here on have this type.
std::int64_t count_type(GmshCursor at, std::int64_t type, std::int64_t left) {
  std::int64_t count = 1;
  while (--left > 0) {
    at.next_line();
    at.next_record();
    at.integer("a cell number");
    if (at.integer("a cell type") == type) ++count;
  }
  return count;
}

void check_cell_count(const GmshCursor& at, std::int64_t count, std::size_t bytes_each) {
  check_declared(at, count, bytes_each, "cells");
}

}  // namespace

template <class Stream>
void read_nodes_2(Stream& in, GmshMesh& mesh) {
  const std::int64_t count = declared_count(in.cursor(), "nodes");
  in.check_count(count, {.integers = 1, .reals = 3}, "nodes");
  mesh.begin_nodes(in.cursor(), count);
  in.begin_data();
  for (std::int64_t i = 0; i < count; ++i) {
    in.next_record();
    const std::int64_t number = in.integer("a node number");
    Vec3 x{};
    for (double& component : x) component = in.real("a coordinate");
    mesh.add_node(in.cursor(), number, x);
    in.end_record();
  }
}
template void read_nodes_2(GmshText&, GmshMesh&);
template void read_nodes_2(GmshBinary&, GmshMesh&);

void read_elements_2(GmshText& in, GmshMesh& mesh) {
  const std::int64_t count = declared_count(in.cursor(), "cells");
  check_cell_count(in.cursor(), count, 8);  // number, type, tag count and a node, a blank after each
  for (std::int64_t i = 0; i < count; ++i) {
    in.next_record();
    const std::int64_t number = in.integer("a cell number");
    const std::int64_t type_number = in.integer("a cell type");
    const bool is_known = gmsh_cell_type(type_number) != nullptr;
    const GmshCellType& type =
        GmshMesh::cell_type(in.cursor(), type_number, is_known ? 1 : count_type(in.cursor(), type_number, count - i));
    read_cell(in, mesh, type, number, in.integer("the number of tags"));
    in.end_record();
  }
}

void read_elements_2(GmshBinary& in, GmshMesh& mesh) {
  const std::int64_t count = declared_count(in.cursor(), "cells");
  check_cell_count(in.cursor(), count, 8);  // number and a node of 4 bytes
  in.begin_data();
  for (std::int64_t done = 0; done < count;) {
    const std::int64_t type_number = in.integer("a cell type");
    const GmshCursor at_type = in.cursor();
    const std::int64_t here = in.integer("the number of cells that follow");
    const GmshCellType& type = GmshMesh::cell_type(at_type, type_number, here);
    const std::int64_t tags = in.integer("the number of tags");
    if (here < 1 || here > count - done)
      in.cursor().fail(fmt::format("{} cells in a block with {} cells left", here, count - done),
                       "at least 1 and at most what is left", "The file is damaged; write it again.");
    for (std::int64_t i = 0; i < here; ++i) read_cell(in, mesh, type, in.integer("a cell number"), tags);
    done += here;
  }
}

}  // namespace carom
