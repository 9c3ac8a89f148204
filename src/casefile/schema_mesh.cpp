#include <algorithm>

#include "casefile/case_schema.hpp"
#include "casefile/section_rules.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

/// Names of the groups of a block; stored in the block itself.
Section<StructuredBlock> groups_section() {
  Section<StructuredBlock> s("Names of the groups of the block; an empty name gives no group.");
  s.key("cells", &StructuredBlock::cells_group, "Group of all cells.");
  constexpr std::array faces{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    s.key_by(
        faces[i], [i](auto& block) -> auto& { return block.face_groups[i]; },
        std::string("Group of the faces and nodes at ") + faces[i] + ".");
  }
  s.finish = [](StructuredBlock& block, const Node& node, const ReadContext& at) {
    if (!block.cells_group.empty()) return;
    throw CaseError(find(node, "cells")->where, at.at("cells").path, "\"\"", "the name of a group of cells");
  };
  return s;
}

void add_groups(Section<StructuredBlock>& s) {
  const Section<StructuredBlock> groups = groups_section();
  Section<StructuredBlock>::Handlers handlers;
  handlers.read = [groups](StructuredBlock& block, const Node& node, const ReadContext& at) {
    groups.read(block, node, at);
  };
  handlers.write = [groups](const StructuredBlock& block, const Node& root) { return groups.write(block, &root); };
  s.add({"groups",
         Shape::section,
         groups.description.doc,
         {},
         {},
         std::make_shared<const SectionDescription>(groups.description)},
        handlers);
}

void add_points(Section<StructuredBlock>& s) {
  const KeyDescription key{"points",
                           Shape::named_vectors,
                           "Groups of one node each: the node nearest to the point, which must lie within 1e-6 of the "
                           "block's diagonal.",
                           {.unit = Dimension::length},
                           {},
                           {}};
  KeyDescription point = key;
  point.shape = Shape::vector;
  Section<StructuredBlock>::Handlers handlers;
  handlers.read = [key, point](StructuredBlock& block, const Node& node, const ReadContext& at) {
    for (const Member& m : members_of(node, key, at).members) {
      StructuredBlock::Point& to = block.points.emplace_back();
      to.name = m.key;
      to.where = m.where;
      check_name({m.key, m.where}, at.at(m.key).path);
      decode(m.value, point, at.at(m.key), to.position);
    }
  };
  handlers.write = [](const StructuredBlock& block, const Node&) -> std::optional<Node> {
    Table points;
    for (const StructuredBlock::Point& p : block.points)
      points.members.push_back({p.name, {}, *encode(p.position, {})});
    if (points.members.empty()) return std::nullopt;
    return Node{points, {}};
  };
  s.add(key, handlers);
}

Section<StructuredBlock> block_section() {
  Section<StructuredBlock> s(
      "A box of HEXA8 cells along the axes. Boxes that touch share no nodes; groups of the same name are united.");
  s.key("origin", &StructuredBlock::origin, "Corner with the smallest coordinates.", {.unit = Dimension::length});
  s.key("size", &StructuredBlock::size, "Lengths of the edges.",
        {.unit = Dimension::length, .range = greater_than(0.0), .need = Need::required});
  s.key("divisions", &StructuredBlock::divisions, "Number of cells along each edge.",
        {.range = at_least(1.0), .need = Need::required});
  add_groups(s);
  add_points(s);
  return s;
}

}  // namespace

Section<CaseMesh> mesh_section() {
  Section<CaseMesh> s("Where the mesh comes from: a file, or structured blocks.");
  s.key("file", &CaseMesh::file, "Gmsh (.msh) or MED (.med) file, relative to the folder of the case file.");
  s.tables("block", &CaseMesh::blocks, block_section());
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"file", "block"}}};
  s.finish = [](CaseMesh& mesh, const Node& node, const ReadContext& at) {
    if (!mesh.file->empty() || !mesh.blocks.empty()) return;
    const bool has_file = find(node, "file") != nullptr;
    throw CaseError(has_file ? mesh.file.where : mesh.where, at.at(has_file ? "file" : "block").path,
                    has_file ? "\"\"" : "no block",
                    has_file ? "the name of a mesh file" : "at least one [[mesh.block]]");
  };
  return s;
}

}  // namespace carom
