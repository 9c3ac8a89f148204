#include "translate/rigid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "deck/keyword_table.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// The faces or the solid cells of an ELSET.
void add_elements(const Translation& t, const Statement& s, DeckRigidBody& body) {
  const DeckKeyword& keyword = *s.keyword;
  const std::string set = keyword.required("ELSET"), cells = key_of(t.mesh.names.element_sets, t.scope(s), set);
  if (cells.empty()) keyword.fail("ELSET=" + set, "the name of a set of cells");
  body.name = cells;
  body.side = rigid_side_of(t.scope(s), set);
  const std::vector<DeckNames::Cells>& all = t.mesh.names.element_sets.at(cells);
  const bool is_solid = !all.empty() && all.front().type->section == "solid";
  if (is_solid) body.group = all.size() == 1 ? all.front().group : cells;
  for (const DeckNames::Cells& each : all) {
    if (each.type->section != (is_solid ? "solid" : ""))
      keyword.fail(fmt::format("{}, elements of type {}", set, each.type->name),
                   is_solid ? "solids alone" : "solids, R3D3, R3D4, or other faces",
                   is_solid ? "Make a *RIGID BODY of each, or of the solids alone."
                            : "Plane and axisymmetric cells deform: R2D2 and RAX2 are their rigid bodies.");
    const std::vector<CellRef>& refs = t.mesh.mesh.cell_groups.at(each.group);
    body.cells.insert(refs.begin(), refs.end());
    if (each.type->name == "RAX2") body.space = DeckRigidBody::Space::ring;
    if (each.type->name == "R2D2") body.space = DeckRigidBody::Space::plane;
  }
}

/// The faces of an analytical surface: lines are rings where the deck has axisymmetric cells.
void add_analytical(const Translation& t, const Statement& s, DeckRigidBody& body) {
  const std::string name = s.keyword->required("ANALYTICAL SURFACE");
  body.side = key_of(t.mesh.names.surfaces, t.scope(s), name);
  if (body.side.empty()) s.keyword->fail("ANALYTICAL SURFACE=" + name, "the NAME of a *SURFACE");
  body.name = body.side;
  const std::vector<CellRef>& refs = t.mesh.mesh.cell_groups.at(t.mesh.names.surfaces.at(body.side).group);
  body.cells.insert(refs.begin(), refs.end());
  if (refs.empty() || t.mesh.mesh.blocks[at(refs.front().block)].type != CellType::line2) return;
  body.space = DeckRigidBody::Space::plane;
  for (const auto& [set, list] : t.mesh.names.element_sets)
    for (const DeckNames::Cells& cells : list)
      if (cells.type->section == "axisymmetric") body.space = DeckRigidBody::Space::ring;
}

/// The node that a parameter names, and its key among the node sets.
std::pair<Index, std::string> node_of(const Translation& t, const Statement& s, const char* parameter) {
  const std::string node = s.keyword->required(parameter);
  const std::string group = key_of(t.mesh.names.node_sets, t.scope(s), node);
  const std::vector<Index> nodes =
      group.empty() ? std::vector<Index>{} : t.mesh.mesh.nodes_of(t.mesh.names.node_sets.at(group));
  if (nodes.size() != 1)
    s.keyword->fail(fmt::format("{}={}", parameter, node), "the number of a node, or a set of one");
  return {nodes.front(), group};
}

void add_reference(const Translation& t, const Statement& s, DeckRigidBody& body) {
  std::tie(body.reference, body.node) = node_of(t, s, "REF NODE");
  body.centre = t.mesh.mesh.coordinates[at(body.reference)];
  if (s.keyword->has("ROT NODE")) body.turning = node_of(t, s, "ROT NODE").first;
}

constexpr std::array node_parameters{"TIE NSET", "PIN NSET", "NSET"};

/// PIN NSET, TIE NSET and CalculiX' NSET are the same to nodes that do not turn. Without elements they are the body.
void add_nodes(const Translation& t, const Statement& s, DeckRigidBody& body) {
  const DeckKeyword& keyword = *s.keyword;
  for (const char* const key : node_parameters) {
    const std::string* set = keyword.parameter(key);
    if (set == nullptr) continue;
    const std::string found = key_of(t.mesh.names.node_sets, t.scope(s), *set);
    if (found.empty()) keyword.fail(fmt::format("{}={}", key, *set), "the name of a node set");
    if (!body.joined.empty())
      keyword.fail(fmt::format("{} beside another set of nodes", key), "one of them", "Join both sets in one *NSET.");
    if (!body.cells.empty() && body.is_obstacle())
      keyword.fail(fmt::format("{} beside faces", key), "faces or an analytical surface alone",
                   "Bodies of solids hold nodes of others: give the faces cells behind them.");
    body.joined = t.mesh.names.node_sets.at(found);
    if (body.name.empty()) body.name = found;
  }
  if (body.is_of_nodes()) body.group = body.joined;
}

/// Abaqus may move the reference node to the centre of mass, where it stands anyway of a surface, whose mass it has.
void check_position(const Translation& t, const DeckKeyword& keyword, const DeckRigidBody& body) {
  const std::string* given = keyword.parameter("POSITION");
  const std::string position = given == nullptr ? "INPUT" : without_blanks(*given);
  if (position == "INPUT" || (position == "CENTEROFMASS" && body.is_obstacle())) return;
  if (position != "CENTEROFMASS") keyword.fail("POSITION=" + *given, "INPUT or CENTER OF MASS");
  t.findings.refuse(keyword, keyword.where, "POSITION=CENTER OF MASS",
                    "Forces and velocities of the reference node would act where the deck has it.");
}

DeckRigidBody read_rigid_body(const Translation& t, const Statement& s) {
  DeckRigidBody body;
  body.keyword = s.keyword;
  if (s.keyword->has("ANALYTICAL SURFACE"))
    add_analytical(t, s, body);
  else if (s.keyword->has("ELSET") ||
           std::ranges::none_of(node_parameters, [&](const char* key) { return s.keyword->has(key); }))
    add_elements(t, s, body);
  add_nodes(t, s, body);
  add_reference(t, s, body);
  check_position(t, *s.keyword, body);
  return body;
}

/// *KINEMATIC lists the degrees of freedom that it holds, all without lines: nodes of solids have the first three.
void check_kinematic(const DeckKeyword& keyword) {
  std::array<bool, 3> held{};
  bool has_lines = false;
  for (DeckCursor at(keyword); at.next_line();) {
    has_lines = true;
    const std::int64_t first = at.integer("the first degree of freedom");
    const std::int64_t last = at.at_end() ? first : at.integer("the last degree of freedom");
    for (std::int64_t dof = first; dof <= last && dof <= 3; ++dof)
      if (dof >= 1) held[carom::at(dof - 1)] = true;
  }
  if (has_lines && !std::ranges::all_of(held, [](bool is_held) { return is_held; }))
    keyword.fail("some degrees of freedom alone", "1 to 3, or all",
                 "Nodes that slide along the reference node's body are not joined: write *EQUATION.");
}

/// The nodes of the surface move with the reference node.
DeckRigidBody read_coupling(const Translation& t, const Statement& s, const DeckKeyword& kinematic) {
  const std::string surface = s.keyword->required("SURFACE");
  DeckRigidBody body;
  body.keyword = s.keyword;
  body.name = key_of(t.mesh.names.surfaces, t.scope(s), surface);
  if (body.name.empty()) s.keyword->fail("SURFACE=" + surface, "the NAME of a *SURFACE");
  body.group = body.joined = t.mesh.names.surfaces.at(body.name).group;
  check_kinematic(kinematic);
  add_reference(t, s, body);
  return body;
}

/// The components of a body's motion in its space.
struct Components {
  std::vector<std::size_t> along, about;
};

Components components_of(DeckRigidBody::Space space) {
  switch (space) {
    case DeckRigidBody::Space::plane:
      return {{0, 1}, {5}};
    case DeckRigidBody::Space::ring:
      return {{1}, {}};
    case DeckRigidBody::Space::solid:
      break;
  }
  return {{0, 1, 2}, {3, 4, 5}};
}

std::size_t count_imposed(const DeckRigidBody& body, const std::vector<std::size_t>& components) {
  return at(
      std::count_if(components.begin(), components.end(), [&](std::size_t c) { return body.motion[c].has_value(); }));
}

[[noreturn]] void fail_at(const DeckRigidBody::Motion& motion, const std::string& found, const std::string& expected,
                          const std::string& suggestion) {
  throw CaseError(motion.where, "*BOUNDARY", found, expected, suggestion);
}

/// In the plane and around an axis there are no other motions.
void refuse_leaving_space(const DeckRigidBody& body, const Components& components) {
  for (std::size_t c = 0; c < body.motion.size(); ++c) {
    const std::vector<std::size_t>& own = c < 3 ? components.along : components.about;
    if (!body.motion[c] || body.motion[c]->velocity == 0.0 || std::find(own.begin(), own.end(), c) != own.end())
      continue;
    const bool is_ring = body.space == DeckRigidBody::Space::ring;
    fail_at(*body.motion[c],
            fmt::format("a motion of degree of freedom {} of a rigid body {}", c + 1,
                        is_ring ? "around an axis" : "in the plane"),
            is_ring ? "2 alone" : "1, 2 or 6",
            is_ring ? "What moves otherwise is no ring: model it in three dimensions."
                    : "Plane cells have no displacement along z.");
  }
}

/// About one axis alone a body turns by its moment about that.
bool has_one_axis(const DeckRigidBody& body) {
  return body.count_imposed(3, 6) == 2;
}

/// Of the components that the space of a body has.
void add_guide(const DeckRigidBody& body, TableMaker& section, const std::vector<std::size_t>& along,
               const std::vector<std::size_t>& about) {
  const auto held_of = [&](const std::vector<std::size_t>& components) {
    std::vector<std::string> axes;
    for (const std::size_t c : components)
      if (body.motion[c]) axes.emplace_back(1, "xyz"[c % 3]);
    return axes;
  };
  const auto where_of = [&](const std::vector<std::size_t>& components) {
    return body.motion[*std::ranges::find_if(components, [&](std::size_t c) { return body.motion[c].has_value(); })]
        ->where;
  };
  const std::vector<std::string> places = held_of(along), turns = held_of(about);
  if (turns.size() == 1 && about.size() == 3)
    body.keyword->fail(
        "a rigid body that *BOUNDARY holds about " + turns[0] + " alone",
        "turns that are held about no axis, about two, or about all",
        "What turns about two axes and not about the third has no axis of its own: hold it about another "
        "one, too.");
  if (!places.empty()) section.add("blocked", texts_node(places, where_of(along)));
  if (!turns.empty()) section.add("blocked_turns", texts_node(turns, where_of(about)));
}

/// A motion that is imposed: its vector times the function.
struct Imposed {
  Vec3 vector{};
  std::string function;  ///< "" constant 1
  Location where;
};

/// From the components `first` to first + 2, which have one function where they are not 0.
Imposed imposed(const DeckRigidBody& body, std::size_t first) {
  Imposed all;
  const DeckRigidBody::Motion* before = nullptr;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& own = body.motion[first + c];
    if (!own || own->velocity == 0.0) continue;
    if (before != nullptr && own->function != before->function)
      fail_at(*own, first == 0 ? "a motion with an amplitude for each axis" : "a turn with an amplitude for each axis",
              "one amplitude for all",
              first == 0 ? "Carom's obstacles move along a straight line."
                         : "Carom's obstacles turn about an axis of fixed direction.");
    before = &*own;
    all.vector[c] = own->velocity;
    all.function = own->function;
    all.where = own->where;
  }
  return all;
}

/// The name of a function that is 1 at all times.
std::string constant_function(Translation& t, const Location& where) {
  const std::string name = "constant";
  const Node* functions = t.root.find("functions");
  if (functions == nullptr || find(*functions, name) == nullptr) {
    TableMaker table(where);
    table.add("time", numbers_node({0.0, 1.0}, where)).add("value", numbers_node({1.0, 1.0}, where));
    t.define("functions", name, table.node());
  }
  return name;
}

void add_led_body(Translation& t, const DeckRigidBody& body, const Components& components, TableMaker& contact) {
  const Imposed travel = imposed(body, 0), turn = imposed(body, 3);
  if (travel.vector != Vec3{}) {
    contact.vector("velocity", travel.vector);
    if (!travel.function.empty()) contact.text("function", travel.function);
  }
  const std::size_t held = count_imposed(body, components.about);
  if (body.inertia && held < components.about.size())
    t.findings.refuse(*body.inertia->keyword, body.keyword->where,
                      "a rigid body without a *MASS that is held in its place and not in its turns",
                      "It would turn only as *BOUNDARY says; with a *MASS it turns by its inertia.");
  if (turn.vector == Vec3{}) return t.findings.note(body.keyword->where, "the rigid body does not turn");
  contact.add("angular_velocity", vector_node(turn.vector, turn.where));
  contact.add("centre_of_rotation", vector_node(body.centre, turn.where));
  // Without a function of its own the rotation would have that of the travel.
  if (!turn.function.empty())
    contact.add("angular_function", text_node(turn.function, turn.where));
  else if (!travel.function.empty())
    contact.add("angular_function", text_node(constant_function(t, turn.where), turn.where));
  if (held < components.about.size())
    t.findings.note(body.keyword->where, "the rigid body turns only as *BOUNDARY says");
}

/// In the plane nothing feels the moments about x and y.
Vec3 moments_of(const DeckRigidBody& body) {
  const Vec3& given = body.inertia->moments;
  return body.space == DeckRigidBody::Space::plane ? Vec3{given[2], given[2], given[2]} : moments_in_guide(body);
}

void add_free_body(Translation& t, DeckRigidBody& body, const Components& components, TableMaker& contact) {
  const DeckKeyword& keyword = *body.keyword;
  if (body.contacts > 1)
    keyword.fail("a free rigid body in several contacts", "one contact", "A free body belongs to one contact.");
  const Imposed turn = imposed(body, 3);
  if (turn.vector != Vec3{})
    throw CaseError(turn.where, "*BOUNDARY", "a turn that is imposed on a rigid body that moves freely",
                    "a body that is held or moved along all axes, or turns freely too",
                    "Impose its degrees of freedom 1 to 3, or give it a *ROTARY INERTIA.");
  contact.number("mass", *body.mass);
  if (body.initial_velocity) contact.vector("velocity", *body.initial_velocity);
  const bool turns = body.inertia && count_imposed(body, components.about) < components.about.size();
  add_guide(body, contact, components.along, turns ? components.about : std::vector<std::size_t>{});
  if (!turns) {
    if (body.initial_rotation)
      keyword.fail("an angular velocity of a rigid body that does not turn",
                   "a *ROTARY INERTIA of its reference node, which *BOUNDARY does not hold");
    return t.findings.note(keyword.where, "the rigid body does not turn");
  }
  const Location& where = body.inertia->keyword->where;
  contact.add("inertia", vector_node(moments_of(body), where));
  if (body.space == DeckRigidBody::Space::solid && !has_one_axis(body) && body.inertia->products != Vec3{})
    contact.add("products_of_inertia", vector_node(body.inertia->products, where));
  contact.add("centre_of_mass", vector_node(body.centre, where));
  if (body.initial_rotation) contact.vector("angular_velocity", *body.initial_rotation);
}

bool is_of_cells(const Translation& t, Index node) {
  return std::ranges::any_of(t.body_cells(), [&](const CellRef& cell) {
    return std::ranges::count(t.mesh.mesh.blocks[at(cell.block)].nodes(cell.cell), node) != 0;
  });
}

}  // namespace

std::vector<DeckRigidBody> rigid_bodies_of(const Translation& t) {
  std::vector<DeckRigidBody> bodies;
  const auto add = [&](DeckRigidBody body) {
    const auto same =
        std::ranges::find_if(bodies, [&](const DeckRigidBody& other) { return other.reference == body.reference; });
    if (same == bodies.end()) return bodies.push_back(std::move(body));
    if (!body.is_of_nodes() || same->is_obstacle() || !same->joined.empty())
      body.keyword->fail("the reference node of " + same->name + " for " + body.name, "a reference node for each body",
                         "Bodies of solids may hold the nodes of one *COUPLING.");
    same->joined = body.joined;
  };
  const std::vector<Statement>& list = t.statements.list;
  for (const Statement& statement : list)
    if (statement.keyword->name == "RIGID BODY") t.errors.attempt([&] { add(read_rigid_body(t, statement)); });
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].keyword->name != "COUPLING") continue;
    const DeckKeyword* behind = i + 1 < list.size() ? list[i + 1].keyword : nullptr;
    if (behind != nullptr && behind->name == "DISTRIBUTING") continue;
    t.errors.attempt([&] {
      if (behind == nullptr || behind->name != "KINEMATIC")
        list[i].keyword->fail("*COUPLING alone", "*KINEMATIC or *DISTRIBUTING behind it");
      add(read_coupling(t, list[i], *behind));
    });
  }
  return bodies;
}

Referred referred_to(Translation& t, const std::string& node_group) {
  if (t.rigid_bodies.empty()) return {};
  Referred referred{{}, false};
  for (const Index node : t.mesh.mesh.nodes_of(node_group)) {
    const auto found = std::ranges::find(t.rigid_bodies, node, &DeckRigidBody::reference);
    if (found == t.rigid_bodies.end())
      referred.has_others = true;
    else
      referred.bodies.push_back(&*found);
  }
  if (referred.has_others)
    std::erase_if(referred.bodies, [&](const DeckRigidBody* body) { return is_of_cells(t, body->reference); });
  return referred;
}

DeckRigidBody* turned_by(Translation& t, const std::string& node_group) {
  const auto turns = [](const DeckRigidBody& body) { return body.turning >= 0; };
  if (std::ranges::none_of(t.rigid_bodies, turns)) return nullptr;
  const std::vector<Index> nodes = t.mesh.mesh.nodes_of(node_group);
  if (nodes.size() != 1) return nullptr;
  const auto found = std::ranges::find(t.rigid_bodies, nodes.front(), &DeckRigidBody::turning);
  return found == t.rigid_bodies.end() ? nullptr : &*found;
}

DeckRigidBody* body_of_cells(Translation& t, const std::string& cell_group) {
  const auto cells = t.mesh.mesh.cell_groups.find(cell_group);
  if (cells == t.mesh.mesh.cell_groups.end()) return nullptr;
  const auto found = std::find_if(t.rigid_bodies.begin(), t.rigid_bodies.end(), [&](const DeckRigidBody& body) {
    return std::all_of(cells->second.begin(), cells->second.end(),
                       [&](const CellRef& cell) { return body.cells.count(cell) != 0; });
  });
  return found == t.rigid_bodies.end() ? nullptr : &*found;
}

void add_guide(const DeckRigidBody& body, TableMaker& section) {
  const Components all = components_of(DeckRigidBody::Space::solid);
  add_guide(body, section, all.along, all.about);
  if (body.count_imposed(0, 3) > 0) section.vector("blocked_at", body.centre);
}

Vec3 moments_in_guide(const DeckRigidBody& body) {
  const Vec3& given = body.inertia->moments;
  if (!has_one_axis(body)) return given;
  for (std::size_t c = 0; c < 3; ++c)
    if (!body.motion[c + 3]) return {given[c], given[c], given[c]};
  return given;
}

void add_rigid_motion(Translation& t, DeckRigidBody& body, TableMaker& contact) {
  ++body.contacts;
  const Components components = components_of(body.space);
  refuse_leaving_space(body, components);
  const std::size_t held = count_imposed(body, components.along), all = components.along.size();
  const bool rests = std::ranges::all_of(
      components.along, [&](std::size_t c) { return !body.motion[c] || body.motion[c]->velocity == 0.0; });
  const bool turns_freely = body.inertia && count_imposed(body, components.about) < components.about.size() &&
                            imposed(body, 3).vector == Vec3{};
  if (body.mass && rests && (held < all || turns_freely)) return add_free_body(t, body, components, contact);
  if (held == all) return add_led_body(t, body, components, contact);
  if (body.mass)
    body.keyword->fail(
        fmt::format("a reference node with a *MASS that is moved along some axes and free along {} of {}", all - held,
                    all),
        "all axes imposed, or those that are not free held",
        "*BOUNDARY gives the reference node a motion: impose the others, too, or let it be 0.");
  body.keyword->fail(
      fmt::format("a reference node without a *MASS that is held along {} of {} axes", held, all),
      "a *MASS, by which it moves along the others, or all of them imposed",
      "Give the reference node an element of TYPE=MASS with a *MASS, or impose the others by *BOUNDARY.");
}

}  // namespace carom
