// Rigid bodies of cells and of nodes as [[rigid_body]], and what they begin with.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "math/vec3.hpp"
#include "translate/rigid.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// Turns are held or free, and so is what a guide holds.
void refuse_motions_in_guides(const DeckRigidBody& body) {
  for (std::size_t c = 0; c < body.motion.size(); ++c) {
    if (!body.motion[c] || body.motion[c]->velocity == 0.0) continue;
    if (c >= 3)
      throw CaseError(body.motion[c]->where, "*BOUNDARY", "a turn that is imposed on a rigid body of cells or nodes",
                      "a turn that is held or free", "A rigid surface of R3D3 and R3D4 is turned as imposed.");
    if (body.is_guided())
      throw CaseError(
          body.motion[c]->where, "*BOUNDARY",
          fmt::format("a motion along {} of a rigid body of cells or nodes that a guide holds besides", "xyz"[c]),
          "1 with 5 and 6, 2 with 4 and 6, 3 with 4 and 5, or two or three of 1 to 3 with all of 4 to 6",
          "Impose or hold these degrees of freedom of its reference node, or let it rest along this one.");
  }
}

/// The parts whose cells are those of the body. Throws CaseError where a part has others too, or no part has some.
std::vector<std::string> parts_of(const Translation& t, const DeckRigidBody& body) {
  std::vector<std::string> names;
  std::set<CellRef> held;
  const Node* parts = t.root.find("part");
  for (const Node& part : parts == nullptr ? List{} : std::get<List>(parts->value)) {
    const auto text = [&](const char* key) {
      return std::get<std::string>(std::get<Table>(part.value).find(key)->value);
    };
    const std::vector<CellRef>& cells = t.mesh.mesh.cell_groups.at(text("cells"));
    std::vector<CellRef> others;
    std::ranges::copy_if(cells, std::back_inserter(others), [&](const CellRef& c) { return body.cells.count(c) == 0; });
    if (others.size() == cells.size()) continue;
    if (!others.empty())
      body.keyword->fail(fmt::format("{} of the {} elements of the section of {} in {}", cells.size() - others.size(),
                                     cells.size(), text("cells"), body.name),
                         "all elements of a section, or none",
                         fmt::format("Elements {} of it are not in {}: give the rigid elements a section of their own.",
                                     t.numbers_of(others), body.name));
    names.push_back(text("name"));
    held.insert(cells.begin(), cells.end());
  }
  std::vector<CellRef> loose;
  std::ranges::set_difference(body.cells, held, std::back_inserter(loose));
  if (!loose.empty())
    body.keyword->fail(fmt::format("elements {} of {} without a section", t.numbers_of(loose), body.name),
                       "a *SOLID SECTION of all elements of the body", "Their material gives the body its mass.");
  return names;
}

bool is_of_a_part(const Translation& t, Index node) {
  const Node* parts = t.root.find("part");
  return std::ranges::any_of(parts == nullptr ? List{} : std::get<List>(parts->value), [&](const Node& part) {
    const Node* cells = std::get<Table>(part.value).find("cells");
    return std::ranges::count(t.mesh.mesh.nodes_of(std::get<std::string>(cells->value)), node) != 0;
  });
}

/// To a body of cells Abaqus adds what stands at its reference node.
void refuse_added_mass(Translation& t, const DeckRigidBody& body) {
  const char* const own = "The body would have the mass and the inertia of its cells alone.";
  if (body.mass) t.findings.refuse(*body.mass_keyword, body.mass_keyword->where, "a mass beside that of cells", own);
  if (body.inertia)
    t.findings.refuse(*body.inertia->keyword, body.inertia->keyword->where, "an inertia beside that of cells", own);
}

void add_initial(Translation& t, const DeckRigidBody& body) {
  if (!body.initial_velocity && !body.initial_rotation) return;
  TableMaker initial(body.keyword->where);
  initial.text("nodes", body.group).vector("velocity", body.initial_velocity.value_or(Vec3{}));
  if (body.initial_rotation) initial.vector("angular_velocity", *body.initial_rotation).vector("centre", body.centre);
  t.append("initial", initial.node());
}

/// A body that cannot turn may have any inertia; this one has that of a ring through its farthest node, or nearly.
Vec3 any_inertia(const Translation& t, const DeckRigidBody& body) {
  double reach = 0.0;
  for (const Index n : t.mesh.mesh.nodes_of(body.group))
    reach = std::max(reach, norm(subtract(t.mesh.mesh.coordinates[at(n)], body.centre)));
  const double moment = *body.mass * (reach > 0.0 ? reach * reach : 1.0);
  return {moment, moment, moment};
}

/// false: it is no body, since its supports say all.
bool add_given_inertia(Translation& t, const DeckRigidBody& body, TableMaker& section) {
  if (body.count_imposed(0, 6) == 6) return false;
  const bool turns = body.count_imposed(3, 6) < 3;
  if (!body.mass || (turns && !body.inertia)) {
    const char* lacks = body.mass ? "*ROTARY INERTIA" : turns ? "*MASS and *ROTARY INERTIA" : "*MASS";
    t.findings.refuse(*body.keyword, body.keyword->where,
                      fmt::format("the reference node of {} moves freely and has no {}", body.name, lacks),
                      "Its nodes would not move together. A rigid body needs a mass and an inertia of its own.");
    return false;
  }
  section.number("mass", *body.mass).vector("centre_of_mass", body.centre);
  section.vector("inertia", turns ? moments_in_guide(body) : any_inertia(t, body));
  if (turns && body.count_imposed(3, 6) < 2 && body.inertia->products != Vec3{})
    section.vector("products_of_inertia", body.inertia->products);
  return true;
}

void add_rigid_part(Translation& t, const DeckRigidBody& body) {
  refuse_motions_in_guides(body);
  TableMaker section(body.keyword->where);
  section.text("name", body.name);
  if (body.is_of_nodes()) {
    if (!add_given_inertia(t, body, section)) return add_initial(t, body);
  } else {
    section.add("parts", texts_node(parts_of(t, body), body.keyword->where));
    refuse_added_mass(t, body);
  }
  if (body.is_guided()) add_guide(body, section);
  if (!body.joined.empty()) section.text("nodes", body.joined);
  if (!is_of_a_part(t, body.reference)) section.text("points", t.mesh.names.node_sets.at(body.node));
  t.append("rigid_body", section.node());
  add_initial(t, body);
}

}  // namespace

void translate_rigid_parts(Translation& t) {
  for (const DeckRigidBody& body : t.rigid_bodies)
    if (!body.is_obstacle()) t.errors.attempt([&] { add_rigid_part(t, body); });
}

}  // namespace carom
