#include "mesh/deck_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/terminal_text.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/skin.hpp"

namespace carom {

namespace {

std::uint64_t key_of_cell(const CellRef& cell) {
  return (static_cast<std::uint64_t>(cell.block) << 32U) | static_cast<std::uint64_t>(cell.cell);
}

}  // namespace

bool deforms(const DeckElement& element) {
  return element.type->kind == DeckElementType::Kind::cell && !element.type->section.empty();
}

std::size_t block_of(Mesh& mesh, CellType type) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    if (mesh.blocks[b].type == type) return b;
  mesh.blocks.push_back({type, {}, {}});
  return mesh.blocks.size() - 1;
}

CellRef DeckFaces::face(const CellRef& cell, std::size_t number, std::int64_t& last) {
  const std::uint64_t key = key_of_cell(cell) * 8 + number;
  if (const auto found = made_.find(key); found != made_.end()) return found->second;
  const CellFace& face = cell_faces(mesh_.blocks[at(cell.block)].type)[number];
  const std::size_t block = block_of(mesh_, face.type);
  const std::span<const Index> nodes = mesh_.blocks[at(cell.block)].nodes(cell.cell);
  CellBlock& to = mesh_.blocks[block];
  const CellRef made{static_cast<Index>(block), static_cast<Index>(to.size())};
  for (const LocalNode local : face.nodes()) to.connectivity.push_back(nodes[local]);
  to.file_numbers.push_back(++last);
  made_.emplace(key, made);
  return made;
}

/// The cell, which is a face itself, with the order of its nodes by which its normal looks to the side that is named:
/// SPOS (and where none is named) that of the right-hand rule for triangles and quadrilaterals, and for lines that a
/// quarter turn counter-clockwise from the first node to the second, which is not that of Facet; SNEG the other one.
CellRef DeckFaces::side(const CellRef& cell, bool is_negative, std::int64_t& last) {
  const CellType type = mesh_.blocks[at(cell.block)].type;
  const bool is_turned = is_negative != (type == CellType::line2);
  const std::uint64_t key = key_of_cell(cell);
  const auto [found, is_new] = is_turned_.try_emplace(key, is_turned);
  CellBlock& block = mesh_.blocks[at(cell.block)];
  const auto n = static_cast<std::size_t>(node_count(type));
  const std::vector<Index> nodes(block.nodes(cell.cell).begin(), block.nodes(cell.cell).end());
  if (is_new && is_turned) std::reverse_copy(nodes.begin(), nodes.end(), &block.connectivity[n * at(cell.cell)]);
  if (is_new || found->second == is_turned) return cell;
  const auto [other, is_first] = made_.try_emplace(key * 8 + 7);  // cells have six faces at most
  if (!is_first) return other->second;
  other->second = {cell.block, static_cast<Index>(block.size())};
  block.connectivity.insert(block.connectivity.end(), nodes.rbegin(), nodes.rend());
  block.file_numbers.push_back(++last);
  return other->second;
}

const std::vector<std::uint32_t>& DeckFaces::outer(const CellRef& cell) {
  if (!knows_outer_) {
    for (const OuterFacet& facet : outer_facets(mesh_)) {
      std::vector<std::uint32_t>& faces = outer_[key_of_cell(facet.cell)];
      const auto number = static_cast<std::uint32_t>(facet.face);
      if (faces.empty() || faces.back() != number) faces.push_back(number);  // a quadratic face has several facets
    }
    knows_outer_ = true;
  }
  return outer_[key_of_cell(cell)];
}

std::vector<CellRef> DeckFaces::between(const std::vector<Index>& nodes, std::int64_t& last) {
  std::vector<char> is_given(mesh_.node_count(), 0);
  for (const Index n : nodes) is_given[at(n)] = 1;
  std::vector<CellRef> faces;
  for (const DeckElement& element : elements_) {
    if (!deforms(element)) continue;
    for (const std::uint32_t number : outer(element.cell)) {
      const CellBlock& block = mesh_.blocks[at(element.cell.block)];
      const std::span<const LocalNode> own = cell_faces(block.type)[number].nodes();
      const std::span<const Index> all = block.nodes(element.cell.cell);
      if (std::all_of(own.begin(), own.end(), [&](LocalNode n) { return is_given[at(all[n])] != 0; }))
        faces.push_back(face(element.cell, number, last));
    }
  }
  return faces;
}

bool DeckFaces::bars_alone_between(const std::vector<Index>& nodes) const {
  std::vector<char> is_given(mesh_.node_count(), 0);
  for (const Index n : nodes) is_given[at(n)] = 1;
  bool has_bars = false;
  for (const DeckElement& element : elements_) {
    if (!deforms(element)) continue;
    const std::span<const Index> own = mesh_.blocks[at(element.cell.block)].nodes(element.cell.cell);
    const bool is_between = std::all_of(own.begin(), own.end(), [&](Index n) { return is_given[at(n)] != 0; });
    if (is_between && element.type->section != "bar") return false;
    has_bars = has_bars || is_between;
  }
  return has_bars;
}

bool DeckFaces::looks_at_bodies(const std::vector<Index>& elements) const {
  const auto nodes_of = [&](const DeckElement& element) {
    return mesh_.blocks[at(element.cell.block)].nodes(element.cell.cell);
  };
  Vec3 middle{};
  double count = 0.0;
  for (const DeckElement& element : elements_) {
    if (!deforms(element)) continue;
    for (const Index n : nodes_of(element)) middle = add(middle, mesh_.coordinates[at(n)]), count += 1.0;
  }
  middle = scaled(middle, count > 0.0 ? 1.0 / count : 0.0);
  double nearest = std::numeric_limits<double>::infinity(), side = 0.0;
  for (const Index e : elements) {
    const std::span<const Index> nodes = nodes_of(elements_[at(e)]);
    const auto x = [&](std::size_t n) { return mesh_.coordinates[at(nodes[n])]; };
    Vec3 centre{};
    for (std::size_t n = 0; n < nodes.size(); ++n) centre = add(centre, x(n));
    centre = scaled(centre, 1.0 / static_cast<double>(nodes.size()));
    const Vec3 along = subtract(x(1), x(0));
    const Vec3 normal = nodes.size() == 2 ? Vec3{-along[1], along[0], 0.0} : cross(along, subtract(x(2), x(0)));
    const Vec3 there = subtract(middle, centre);
    if (norm(there) >= nearest) continue;
    nearest = norm(there);
    side = dot(normal, there);
  }
  return side >= 0.0;
}

void DeckFaces::append(const std::vector<Index>& elements, const std::string& label, const DeckCursor& at,
                       std::vector<CellRef>& to, std::int64_t& last) {
  const bool is_side = label == "SPOS" || label == "SNEG";
  if (!label.empty() && !is_side && (label.size() != 2 || label[0] != 'S' || label[1] < '1' || label[1] > '6'))
    at.fail(printable(label), "S1 to S6, SPOS, SNEG or nothing", "Faces are numbered as Abaqus does (docs/decks.md).");
  for (const Index e : elements) {
    const DeckElement& element = elements_[carom::at(e)];
    if (element.type->kind == DeckElementType::Kind::unknown) continue;
    const bool is_surface = element.type->kind == DeckElementType::Kind::cell && element.type->section.empty();
    if (element.type->kind != DeckElementType::Kind::cell)
      at.fail(fmt::format("a face of element {}, a {}", element.number, element.type->name),
              "elements that have faces");
    if (is_side && !is_surface)
      at.fail(fmt::format("{} of element {}, a {}", label, element.number, element.type->name), "a face, S1 to S6");
    if (is_side || (label.empty() && is_surface)) {
      to.push_back(side(element.cell, label == "SNEG", last));
      continue;
    }
    if (label.empty()) {
      for (const std::uint32_t number : outer(element.cell)) to.push_back(face(element.cell, number, last));
      continue;
    }
    const auto number = static_cast<std::size_t>(label[1] - '1');
    if (number >= cell_faces(element.type->type).size())
      at.fail(fmt::format("{} of element {}, a {}", label, element.number, element.type->name),
              fmt::format("one of its {} faces", cell_faces(element.type->type).size()));
    to.push_back(face(element.cell, number, last));
  }
}

}  // namespace carom
