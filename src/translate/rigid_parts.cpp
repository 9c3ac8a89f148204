// Rigid bodies of cells and of nodes as [[rigid_body]], and what they begin with.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "math/vec3.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

std::size_t count_held(const DeckRigidBody& body, std::size_t first, std::size_t end) {
  return at(std::count_if(body.motion.begin() + static_cast<std::ptrdiff_t>(first),
                          body.motion.begin() + static_cast<std::ptrdiff_t>(end),
                          [](const auto& motion) { return motion.has_value(); }));
}

/// A support of all nodes of a body along one axis also holds the turns about the two others, of two axes all turns.
void refuse_other_hinges(const DeckRigidBody& body) {
  std::string held;
  for (std::size_t c = 0; c < body.motion.size(); ++c) {
    if (!body.motion[c]) continue;
    held += fmt::format("{}{}", held.empty() ? "" : ", ", c + 1);
    if (c >= 3 && body.motion[c]->velocity != 0.0)
      throw CaseError(body.motion[c]->where, "*BOUNDARY", "a turn that is imposed on a rigid body of cells or nodes",
                      "a turn that is held or free", "A rigid surface of R3D3 and R3D4 is turned as imposed.");
  }
  const std::size_t along = count_held(body, 0, 3), about = count_held(body, 3, 6);
  if (along == 0 && about == 0) return;
  if (along >= 2 && about == 3) return;
  if (along == 1 && about == 2)
    for (std::size_t c = 0; c < 3; ++c)
      if (body.motion[c] && !body.motion[c + 3]) return;
  body.keyword->fail(fmt::format("a reference node with degrees of freedom {} imposed", held),
                     "none, or two or three of 1 to 3 with all of 4 to 6, or 1 with 5 and 6, 2 with 4 and 6, 3 with 4 "
                     "and 5",
                     "Supports act on all nodes of the body: along an axis they also hold the turns about the others.");
}

/// The parts whose cells are those of the body. Throws CaseError where a part has others too, or no part has some.
std::vector<std::string> parts_of(const Translation& t, const DeckRigidBody& body) {
  const auto numbers_of = [&](const std::vector<CellRef>& cells) {
    constexpr std::size_t most = 5;
    std::string text;
    for (std::size_t k = 0; k < std::min(cells.size(), most); ++k)
      text += fmt::format("{}{}", k == 0 ? "" : ", ",
                          t.mesh.mesh.blocks[at(cells[k].block)].file_numbers[at(cells[k].cell)]);
    return text + (cells.size() > most ? fmt::format(" and {} more", cells.size() - most) : "");
  };
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
                                     numbers_of(others), body.name));
    names.push_back(text("name"));
    held.insert(cells.begin(), cells.end());
  }
  std::vector<CellRef> loose;
  std::ranges::set_difference(body.cells, held, std::back_inserter(loose));
  if (!loose.empty())
    body.keyword->fail(fmt::format("elements {} of {} without a section", numbers_of(loose), body.name),
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
  if (count_held(body, 0, 6) == 6) return false;
  const bool turns = count_held(body, 3, 6) < 3;
  if (!body.mass || (turns && !body.inertia)) {
    const char* lacks = body.mass ? "*ROTARY INERTIA" : turns ? "*MASS and *ROTARY INERTIA" : "*MASS";
    t.findings.refuse(*body.keyword, body.keyword->where,
                      fmt::format("the reference node of {} moves freely and has no {}", body.name, lacks),
                      "Its nodes would not move together. A rigid body needs a mass and an inertia of its own.");
    return false;
  }
  section.number("mass", *body.mass).vector("centre_of_mass", body.centre);
  section.vector("inertia", body.inertia ? body.inertia->moments : any_inertia(t, body));
  if (body.inertia && body.inertia->products != Vec3{}) section.vector("products_of_inertia", body.inertia->products);
  return true;
}

void add_rigid_part(Translation& t, const DeckRigidBody& body) {
  refuse_other_hinges(body);
  TableMaker section(body.keyword->where);
  section.text("name", body.name);
  if (body.is_of_nodes()) {
    if (!add_given_inertia(t, body, section)) return add_initial(t, body);
  } else {
    section.add("parts", texts_node(parts_of(t, body), body.keyword->where));
    refuse_added_mass(t, body);
  }
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
