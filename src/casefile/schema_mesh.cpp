#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "casefile/case_schema.hpp"
#include "casefile/section_rules.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

const std::vector<std::string> hexa{"hexa"}, quad{"quad"}, bar{"bar"};

/// Names of the groups of a block; stored in the block itself. `sides` names the entries of `names` in their order.
template <std::size_t n>
SectionSchema<StructuredBlock> groups_section(const std::string& doc, const std::vector<std::string>& sides,
                                              std::array<std::string, n> StructuredBlock::*names,
                                              const std::string& what) {
  SectionSchema<StructuredBlock> s("Names of the groups of " + doc + "; an empty name gives no group.");
  s.key("cells", &StructuredBlock::cells_group, "Group of all cells.");
  for (std::size_t i = 0; i < sides.size(); ++i) {
    s.key_by(
        sides[i], [ names, i ](auto& block) -> auto& { return (block.*names)[i]; },
        fmt::format("{} {}.", what, sides[i]));
  }
  s.finish = [](StructuredBlock& block, const Node& node, const ReadContext& at) {
    if (!block.cells_group.empty()) return;
    throw CaseError(find(node, "cells")->where, at.at("cells").path, "\"\"", "the name of a group of cells");
  };
  return s;
}

void add_groups(SectionSchema<StructuredBlock>& s, const SectionSchema<StructuredBlock>& groups,
                const std::vector<std::string>& kinds) {
  SectionSchema<StructuredBlock>::Handlers handlers;
  handlers.read = [groups](StructuredBlock& block, const Node& node, const ReadContext& at) {
    groups.read(block, node, at);
  };
  handlers.write = [groups](const StructuredBlock& block, const Node& root) { return groups.write(block, &root); };
  s.add({"groups",
         Shape::section,
         groups.description.doc,
         {.kinds = kinds},
         {},
         std::make_shared<const SectionDescription>(groups.description)},
        handlers);
}

/// A key whose value is given in the form T and stored in the first entries of a member, for blocks that have fewer
/// directions than the member has entries.
template <class T, class Member>
void add_first(SectionSchema<StructuredBlock>& s, const KeyDescription& key, Member StructuredBlock::*member) {
  SectionSchema<StructuredBlock>::Handlers handlers;
  handlers.read = [key, member](StructuredBlock& block, const Node& node, const ReadContext& at) {
    T value{};
    decode(node, key, at, value);
    std::copy(value.begin(), value.end(), (block.*member).begin());
  };
  handlers.write = [key, member](const StructuredBlock& block, const Node&) {
    T value{};
    std::copy_n((block.*member).begin(), value.size(), value.begin());
    return encode(value, key.options);
  };
  s.add(key, handlers);
}

void add_points(SectionSchema<StructuredBlock>& s) {
  const KeyDescription key{"points",
                           Shape::named_vectors,
                           "Groups of one node each: the node nearest to the point, which must lie within 1e-6 of the "
                           "block's diagonal.",
                           {.unit = Dimension::length},
                           {},
                           {}};
  KeyDescription point = key;
  point.shape = Shape::vector;
  SectionSchema<StructuredBlock>::Handlers handlers;
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

void add_extent(SectionSchema<StructuredBlock>& s) {
  const auto length = [](const std::vector<std::string>& kinds) {
    return KeyOptions{.unit = Dimension::length, .range = greater_than(0.0), .kinds = kinds, .need = Need::required};
  };
  const auto count = [](const std::vector<std::string>& kinds) {
    return KeyOptions{.range = at_least(1.0), .kinds = kinds, .need = Need::required};
  };
  s.key("size", &StructuredBlock::size, "Lengths of the edges.", length(hexa));
  add_first<std::array<double, 2>>(s, {"size", Shape::pair, "Lengths of the edges.", length(quad), {}, {}},
                                   &StructuredBlock::size);
  s.key("end", &StructuredBlock::end, "The other end.",
        {.unit = Dimension::length, .kinds = bar, .need = Need::required});
  s.key("divisions", &StructuredBlock::divisions, "Number of cells along each edge.", count(hexa));
  add_first<std::array<int, 2>>(
      s, {"divisions", Shape::integer_pair, "Number of cells along each edge.", count(quad), {}, {}},
      &StructuredBlock::divisions);
  s.key_by(
      "divisions", [](auto& block) -> auto& { return block.divisions[0]; }, "Number of cells.", count(bar));
}

SectionSchema<StructuredBlock> block_section() {
  SectionSchema<StructuredBlock> s(
      "Regular cells: a box of HEXA8 along the axes, a rectangle of QUAD4 in a plane z = const, or a line of LINE2 in "
      "any direction. Blocks that touch share no nodes, and none with a mesh file; groups of the same name of several "
      "blocks "
      "are united, those of a file have other names.");
  s.description.selector = "kind";
  s.key("kind", &StructuredBlock::kind, "Box, rectangle or line.", {.choices = {"hexa", "quad", "bar"}});
  s.description.default_kind = "hexa";
  s.key("origin", &StructuredBlock::origin, "Corner with the smallest coordinates; of a bar, one end.",
        {.unit = Dimension::length});
  add_extent(s);
  const std::vector<std::string> sides{"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
  add_groups(s, groups_section("a box", sides, &StructuredBlock::face_groups, "Group of the faces and nodes at"), hexa);
  add_groups(s,
             groups_section("a rectangle", {sides.begin(), sides.begin() + 4}, &StructuredBlock::face_groups,
                            "Group of the edges and nodes at"),
             quad);
  add_groups(s, groups_section("a bar", {"start", "end"}, &StructuredBlock::end_groups, "Group of the node at its"),
             bar);
  add_points(s);
  return s;
}

}  // namespace

SectionSchema<CaseMesh> mesh_section() {
  SectionSchema<CaseMesh> s("Where the mesh comes from: a file, structured blocks, or both.");
  s.key("file", &CaseMesh::file,
        "Gmsh (.msh), MED (.med), Abaqus or CalculiX (.inp) file, relative to the folder of the case file.");
  s.tables("block", &CaseMesh::blocks, block_section());
  s.key("order", &CaseMesh::order,
        "linear: cells of second order are taken by their corners (HEXA20 as HEXA8, TETRA10 as TETRA4, ...), and nodes "
        "in the middle of cells are dropped.",
        {.choices = {"as_written", "linear"}});
  s.key("refine", &CaseMesh::refine,
        "How often every cell is cut in halves along each direction (HEXA8, PENTA6 and TETRA4 into 8, QUAD4 and TRIA3 "
        "into "
        "4, LINE2 into 2); groups are inherited; new nodes lie on the old faces, so that curved surfaces stay faceted.",
        {.range = {Bound{0.0, Bound::Side::closed}, Bound{6.0, Bound::Side::closed}}});
  s.key("unused", &CaseMesh::unused,
        "What is done about cells that belong to no part, no interface, no rigid surface, and are no piece of the "
        "boundary of other cells.",
        {.choices = {"refuse", "ignore"}});
  s.description.alternatives = {{Alternatives::Count::at_least_one, {"file", "block"}}};
  s.finish = [](CaseMesh& mesh, const Node& node, const ReadContext& at) {
    const bool has_file = find(node, "file") != nullptr;
    if (has_file ? !mesh.file->empty() : !mesh.blocks.empty()) return;
    throw CaseError(has_file ? mesh.file.where : mesh.where, at.at(has_file ? "file" : "block").path,
                    has_file ? "\"\"" : "no block",
                    has_file ? "the name of a mesh file" : "at least one [[mesh.block]]");
  };
  return s;
}

}  // namespace carom
