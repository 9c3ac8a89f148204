#include "translate/rigid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

RigidBody read_rigid_body(const Translation& t, const Statement& s) {
  const DeckKeyword& keyword = *s.keyword;
  const std::string set = keyword.required("ELSET"), node = keyword.required("REF NODE");
  const std::string cells = key_of(t.mesh.names.element_sets, t.scope(s), set);
  if (cells.empty()) keyword.fail("ELSET=" + set, "the name of a set of cells");
  const std::string group = key_of(t.mesh.names.node_sets, t.scope(s), node);
  const std::vector<Index> nodes =
      group.empty() ? std::vector<Index>{} : t.mesh.mesh.nodes_of(t.mesh.names.node_sets.at(group));
  if (nodes.size() != 1) keyword.fail("REF NODE=" + node, "the number of a node, or a set of one");
  RigidBody body;
  body.keyword = &keyword;
  body.reference = nodes.front();
  for (const DeckNames::Cells& each : t.mesh.names.element_sets.at(cells)) {
    if (!each.type->section.empty())
      keyword.fail(fmt::format("{}, elements of type {}", set, each.type->name), "R3D3, R3D4, or other faces",
                   "Carom's rigid bodies are surfaces; bodies made of cells deform.");
    const std::vector<CellRef>& refs = t.mesh.mesh.cell_groups.at(each.group);
    body.cells.insert(refs.begin(), refs.end());
  }
  return body;
}

}  // namespace

std::vector<RigidBody> rigid_bodies_of(const Translation& t) {
  std::vector<RigidBody> bodies;
  for (const Statement& s : t.statements.list)
    if (s.keyword->name == "RIGID BODY") bodies.push_back(read_rigid_body(t, s));
  return bodies;
}

RigidBody* referred_to(Translation& t, const std::string& node_group) {
  if (t.rigid_bodies.empty()) return nullptr;
  const std::vector<Index> nodes = t.mesh.mesh.nodes_of(node_group);
  const auto found = std::find_if(t.rigid_bodies.begin(), t.rigid_bodies.end(), [&](const RigidBody& body) {
    return nodes.size() == 1 && nodes.front() == body.reference;
  });
  return found == t.rigid_bodies.end() ? nullptr : &*found;
}

RigidBody* body_of_cells(Translation& t, const std::string& cell_group) {
  const auto cells = t.mesh.mesh.cell_groups.find(cell_group);
  if (cells == t.mesh.mesh.cell_groups.end()) return nullptr;
  const auto found = std::find_if(t.rigid_bodies.begin(), t.rigid_bodies.end(), [&](const RigidBody& body) {
    return std::all_of(cells->second.begin(), cells->second.end(),
                       [&](const CellRef& cell) { return body.cells.count(cell) != 0; });
  });
  return found == t.rigid_bodies.end() ? nullptr : &*found;
}

void add_rigid_motion(Translation& t, RigidBody& body, TableMaker& contact) {
  const DeckKeyword& keyword = *body.keyword;
  const auto imposed =
      std::count_if(body.motion.begin(), body.motion.end(), [](const auto& m) { return m.has_value(); });
  t.findings.note(keyword.where, "the rigid body does not turn");
  if (imposed == 0 && body.mass) {
    if (++body.contacts > 1)
      keyword.fail("a free rigid body in several contacts", "one contact", "A free body belongs to one contact.");
    contact.number("mass", *body.mass);
    if (body.initial_velocity) contact.vector("velocity", *body.initial_velocity);
    return;
  }
  if (imposed < 3)
    keyword.fail(fmt::format("a reference node that is held along {} of 3 axes", imposed),
                 "all three imposed, or none and a *MASS", "Say with *BOUNDARY what its reference node does.");
  Vec3 velocity{};
  std::string function;
  for (std::size_t c = 0; c < 3; ++c) {
    velocity[c] = body.motion[c]->velocity;
    if (velocity[c] == 0.0) continue;
    const std::string& own = body.motion[c]->function;
    if (!function.empty() && own != function)
      keyword.fail("a motion with an amplitude for each axis", "one amplitude for all");
    function = own;
  }
  if (velocity == Vec3{}) return;
  contact.vector("velocity", velocity);
  if (!function.empty()) contact.text("function", function);
}

}  // namespace carom
