#include <fmt/format.h>

#include <array>
#include <limits>
#include <span>

#include "mesh/gmsh_sections.hpp"

namespace carom {

namespace {

/// Totals at the beginning of $Nodes and $Elements.
struct Totals {
  std::int64_t entity_blocks, items;
};

template <class Stream>
Totals read_totals(Stream& in, std::string_view items, const GmshLayout& each) {
  in.begin_data();
  in.next_record();
  const std::int64_t blocks = in.size("the number of entity blocks");
  in.check_count(blocks, {.integers = 3, .sizes = 1}, "entity blocks");
  const std::int64_t count = in.size(fmt::format("the number of {}", items));
  in.check_count(count, each, items);
  in.size("the smallest number");
  in.size("the largest number");
  in.end_record();
  return {blocks, count};
}

/// One entity of $Entities: `bounds` reals, physical tags and, above dimension 0, bounding entities.
template <class Stream>
std::vector<std::int64_t> read_entity(Stream& in, std::int64_t dimension) {
  const int bounds = dimension == 0 ? 3 : 6;
  for (int i = 0; i < bounds; ++i) in.real("a bound of the entity");
  const std::int64_t count = in.size("the number of physical tags");
  in.check_count(count, {.integers = 1}, "physical tags");
  std::vector<std::int64_t> physical(static_cast<std::size_t>(count));
  for (std::int64_t& tag : physical) tag = in.integer("a physical tag");
  if (dimension > 0) {
    const std::int64_t boundary = in.size("the number of bounding entities");
    in.check_count(boundary, {.integers = 1}, "bounding entities");
    for (std::int64_t i = 0; i < boundary; ++i) in.integer("a bounding entity");
  }
  return physical;
}

void check_dimension(const GmshCursor& at, std::int64_t dimension) {
  if (dimension < 0 || dimension > 3)
    at.fail(fmt::format("an entity of dimension {}", dimension), "0 to 3", "The file is damaged; write it again.");
}

void check_block(const GmshCursor& at, std::int64_t here, std::int64_t left, std::string_view items) {
  if (here < 0 || here > left)
    at.fail(fmt::format("{} {} in an entity block with {} left", here, items, left),
            "a sum over the blocks equal to the total", "Correct the counts, or write the file again.");
}

void check_all_read(const GmshCursor& at, std::int64_t left, std::string_view items) {
  if (left != 0)
    at.fail(fmt::format("{} {} fewer in the blocks than declared", left, items),
            "a sum over the blocks equal to the total", "Correct the counts, or write the file again.");
}

}  // namespace

template <class Stream>
GmshEntities read_entities_4(Stream& in) {
  GmshEntities entities;
  in.begin_data();
  in.next_record();
  std::array<std::int64_t, 4> counts{};
  for (std::int64_t& count : counts) {
    count = in.size("the number of entities");
    in.check_count(count, {.integers = 1, .sizes = 1, .reals = 3}, "entities");
  }
  in.end_record();
  for (std::int64_t dimension = 0; dimension < 4; ++dimension)
    for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      in.next_record();
      const std::int64_t tag = in.integer("an entity tag");
      entities[{dimension, tag}] = read_entity(in, dimension);
      in.end_record();
    }
  return entities;
}
template GmshEntities read_entities_4(GmshText&);
template GmshEntities read_entities_4(GmshBinary&);

template <class Stream>
void read_nodes_4(Stream& in, GmshMesh& mesh) {
  const Totals totals = read_totals(in, "nodes", {.sizes = 1, .reals = 3});
  mesh.begin_nodes(in.cursor(), totals.items);
  std::int64_t left = totals.items;
  std::vector<std::int64_t> numbers;
  for (std::int64_t b = 0; b < totals.entity_blocks; ++b) {
    in.next_record();
    const std::int64_t dimension = in.integer("the dimension of an entity");
    check_dimension(in.cursor(), dimension);
    in.integer("an entity tag");
    const std::int64_t parametric = in.integer("the parametric flag");
    const std::int64_t count = in.size("the number of nodes of the entity");
    in.end_record();
    check_block(in.cursor(), count, left, "nodes");
    left -= count;
    numbers.resize(static_cast<std::size_t>(count));
    for (std::int64_t& number : numbers) {
      in.next_record();
      number = in.size("a node number");
      in.end_record();
    }
    for (const std::int64_t number : numbers) {
      in.next_record();
      Vec3 x{};
      for (double& component : x) component = in.real("a coordinate");
      for (std::int64_t p = 0; parametric != 0 && p < dimension; ++p) in.real("a parametric coordinate");
      mesh.add_node(in.cursor(), number, x);
      in.end_record();
    }
  }
  check_all_read(in.cursor(), left, "nodes");
}
template void read_nodes_4(GmshText&, GmshMesh&);
template void read_nodes_4(GmshBinary&, GmshMesh&);

template <class Stream>
void read_elements_4(Stream& in, const GmshEntities& entities, GmshMesh& mesh) {
  const Totals totals = read_totals(in, "cells", {.sizes = 2});
  std::int64_t left = totals.items;
  std::array<std::int64_t, 27> nodes{};
  for (std::int64_t b = 0; b < totals.entity_blocks; ++b) {
    in.next_record();
    const std::int64_t dimension = in.integer("the dimension of an entity");
    check_dimension(in.cursor(), dimension);
    const auto entity = entities.find({dimension, in.integer("an entity tag")});
    const std::int64_t type_number = in.integer("a cell type");
    const GmshCursor at_type = in.cursor();
    const std::int64_t count = in.size("the number of cells of the entity");
    const GmshCellType& type = GmshMesh::cell_type(at_type, type_number, count);
    if (carom::dimension(type.type) != dimension)
      in.cursor().fail(fmt::format("{} on an entity of dimension {}", name(type.type), dimension),
                       "cells of the dimension of their entity", "The file is damaged; write it again.");
    in.end_record();
    check_block(in.cursor(), count, left, "cells");
    left -= count;
    const std::span<std::int64_t> used(nodes.data(), static_cast<std::size_t>(node_count(type.type)));
    for (std::int64_t i = 0; i < count; ++i) {
      in.next_record();
      const std::int64_t number = in.size("a cell number");
      for (std::int64_t& node : used) node = in.size("a node number");
      mesh.add_cell(in.cursor(), type, number, used,
                    entity == entities.end() ? std::span<const std::int64_t>{} : std::span(entity->second));
      in.end_record();
    }
  }
  check_all_read(in.cursor(), left, "cells");
}
template void read_elements_4(GmshText&, const GmshEntities&, GmshMesh&);
template void read_elements_4(GmshBinary&, const GmshEntities&, GmshMesh&);

}  // namespace carom
