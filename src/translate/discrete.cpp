// *INITIAL CONDITIONS, *MASS, *ROTARY INERTIA and *SPRING.
#include <fmt/format.h>

#include <algorithm>

#include "math/vec3.hpp"
#include "translate/rigid.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// Velocities of one group, component by component.
struct GroupVelocity {
  std::string group;
  Vec3 velocity{};
  std::array<bool, 3> given{};
  Location where;
};

void read_velocity(Translation& t, const Statement& s, DeckCursor& at, std::vector<GroupVelocity>& all) {
  const std::string target(at.field());
  const std::string group = t.node_group(at, s, target);
  std::int64_t dof = at.integer("the degree of freedom");
  const double value = at.real("the velocity");
  auto [bodies, has_others] = referred_to(t, group);
  if (DeckRigidBody* const body = turned_by(t, group); body != nullptr && dof >= 1 && dof <= 3) {
    bodies = {body};
    has_others = false;
    dof += 3;
  }
  if (dof < 1 || dof > (bodies.empty() ? 3 : 6))
    at.fail(fmt::format("degree of freedom {}", dof), bodies.empty() ? "1, 2 or 3" : "1 to 6");
  for (DeckRigidBody* body : bodies) {
    std::optional<Vec3>& of = dof > 3 ? body->initial_rotation : body->initial_velocity;
    if (!of) of = Vec3{};
    (*of)[carom::at((dof - 1) % 3)] = value;
  }
  if (!has_others || dof > 3) return;
  auto found = std::find_if(all.begin(), all.end(), [&](const GroupVelocity& v) { return v.group == group; });
  if (found == all.end()) found = all.insert(all.end(), {group, {}, {}, at.where()});
  found->velocity[carom::at(dof - 1)] = value;
  found->given[carom::at(dof - 1)] = true;
}

void read_velocities(Translation& t, const Statement& s, std::vector<GroupVelocity>& all) {
  for (DeckCursor at(*s.keyword); at.next_line();) t.errors.attempt([&] { read_velocity(t, s, at, all); });
}

/// A later section of the case replaces the whole velocity of a node: components of sets that overlap cannot be told
/// one after the other.
void refuse_mixed(const Translation& t, const std::vector<GroupVelocity>& all) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (all[i].given == all[j].given) continue;
      const std::vector<Index> a = t.mesh.mesh.nodes_of(all[i].group), b = t.mesh.mesh.nodes_of(all[j].group);
      std::vector<Index> sorted_a = a, sorted_b = b, both;
      std::sort(sorted_a.begin(), sorted_a.end());
      std::sort(sorted_b.begin(), sorted_b.end());
      std::set_intersection(sorted_a.begin(), sorted_a.end(), sorted_b.begin(), sorted_b.end(),
                            std::back_inserter(both));
      if (!both.empty())
        throw CaseError(
            all[i].where, "*INITIAL CONDITIONS",
            fmt::format("other components for {} than for {}, which share nodes", all[i].group, all[j].group),
            "all components of a node in one set", "Give the same components for both sets.");
    }
}

/// The bodies of the reference nodes of a node set, or of a set of cells.
Referred rigid_of(Translation& t, const std::string& nodes, const std::string& cells) {
  if (cells.empty()) return referred_to(t, nodes);
  DeckRigidBody* const body = body_of_cells(t, cells);
  return body == nullptr ? Referred{} : Referred{{body}, false};
}

/// Node or cell set, angular velocity, velocity; then two points of the axis.
void translate_rotation(Translation& t, const Statement& s) {
  for (DeckCursor at(*s.keyword); at.next_line();) {
    const std::string target(at.field());
    const std::string cells = key_of(t.mesh.names.element_sets, t.scope(s), target);
    TableMaker initial(at.where());
    const std::string group = cells.empty() ? t.node_group(at, s, target) : cells;
    const double speed = at.real("the angular velocity");
    Vec3 velocity{}, a{}, b{};
    for (double& c : velocity) c = at.real_or(0.0, "a velocity");
    if (!at.next_line()) at.fail("no axis", "a second line with two points");
    for (double& c : a) c = at.real_or(0.0, "a coordinate");
    for (double& c : b) c = at.real_or(0.0, "a coordinate");
    const Vec3 axis = subtract(b, a);
    if (norm(axis) == 0.0) at.fail("an axis from a point to itself", "two points");
    const Vec3 omega = scaled(normalized(axis), speed);
    const auto [bodies, has_others] = rigid_of(t, group, cells);
    for (DeckRigidBody* body : bodies) {
      body->initial_velocity = add(velocity, cross(omega, subtract(body->centre, a)));
      body->initial_rotation = omega;
    }
    if (!has_others) continue;
    initial.text("nodes", group).vector("velocity", velocity).vector("angular_velocity", omega).vector("centre", a);
    t.append("initial", initial.node());
  }
}

/// They are looked up by the materials.
void check_temperatures(Translation& t, const Statement& s) {
  for (DeckCursor at(*s.keyword); at.next_line();)
    t.errors.attempt([&] {
      const std::string target(at.field());
      t.node_group(at, s, target);
      at.real("the temperature");
    });
  t.findings.note(s.keyword->where,
                  "temperatures choose values of tables and begin Johnson and Cook's law, and strain nothing");
}

void translate_initial(Translation& t) {
  std::vector<GroupVelocity> all;
  for (const Statement& s : t.statements.list) {
    if (s.keyword->name != "INITIAL CONDITIONS") continue;
    t.errors.attempt([&] {
      const std::string type = s.keyword->required("TYPE");
      if (type == "VELOCITY")
        read_velocities(t, s, all);
      else if (type == "ROTATING VELOCITY" || type == "ROTATINGVELOCITY")
        translate_rotation(t, s);
      else if (type == "TEMPERATURE")
        check_temperatures(t, s);
      else
        t.findings.refuse(*s.keyword, s.keyword->where, "TYPE=" + type, "The run would begin without.");
    });
  }
  refuse_mixed(t, all);
  for (const GroupVelocity& v : all) {
    TableMaker initial(v.where);
    t.append("initial", initial.text("nodes", v.group).vector("velocity", v.velocity).node());
  }
}

/// The bodies whose reference nodes are those of a set of elements at points; none where it has none of them.
std::vector<DeckRigidBody*> bodies_of_points(Translation& t, const DeckKeyword& keyword, const std::string& group) {
  Referred of = referred_to(t, group);
  if (of.has_others && !of.bodies.empty())
    keyword.fail("a set with reference nodes of rigid bodies and other nodes", "a set of each");
  return std::move(of.bodies);
}

void translate_mass(Translation& t, const Statement& s) {
  const std::string set = s.keyword->required("ELSET"), key = key_of(t.mesh.names.masses, t.scope(s), set);
  if (key.empty()) s.keyword->fail("ELSET=" + set, "a set of elements of TYPE=MASS");
  DeckCursor at(*s.keyword);
  if (!at.next_line()) s.keyword->fail("no data", "the mass");
  const double value = at.real("the mass");
  const std::vector<DeckRigidBody*> bodies = bodies_of_points(t, *s.keyword, t.mesh.names.masses.at(key));
  for (DeckRigidBody* body : bodies) {
    body->mass = body->mass.value_or(0.0) + value;
    body->mass_keyword = s.keyword;
  }
  if (!bodies.empty()) return;
  TableMaker mass(s.keyword->where);
  mass.text("nodes", t.mesh.names.masses.at(key)).number("mass", value);
  t.append("point_mass", mass.node());
}

void translate_inertia(Translation& t, const Statement& s) {
  const DeckKeyword& keyword = *s.keyword;
  const std::string set = keyword.required("ELSET"), key = key_of(t.mesh.names.inertias, t.scope(s), set);
  if (key.empty()) keyword.fail("ELSET=" + set, "a set of elements of TYPE=ROTARYI");
  DeckCursor at(keyword);
  if (!at.next_line()) keyword.fail("no data", "I11, I22, I33, I12, I13, I23");
  DeckRigidBody::Inertia inertia{&keyword, {}, {}};
  for (double& moment : inertia.moments) moment = at.real_or(0.0, "a moment of inertia");
  const double xy = at.real_or(0.0, "I12"), xz = at.real_or(0.0, "I13"), yz = at.real_or(0.0, "I23");
  inertia.products = {xy, yz, xz};
  at.end_line("I11, I22, I33, I12, I13, I23");
  if (t.scope(s).placement.turn)
    at.fail("an inertia in an instance that is turned", "one in an instance that is shifted alone",
            "Its axes turn with the instance: give the inertia in the assembly, about its axes.");
  const std::vector<DeckRigidBody*> bodies = bodies_of_points(t, keyword, t.mesh.names.inertias.at(key));
  for (DeckRigidBody* body : bodies) {
    const DeckRigidBody::Inertia before = body->inertia.value_or(DeckRigidBody::Inertia{});
    body->inertia = {&keyword, add(inertia.moments, before.moments), add(inertia.products, before.products)};
  }
  if (bodies.empty())
    t.findings.refuse(keyword, keyword.where, "an inertia of nodes that no *RIGID BODY refers to",
                      "It would be left out.");
}

void translate_spring(Translation& t, const Statement& s) {
  const std::string set = s.keyword->required("ELSET"), key = key_of(t.mesh.names.springs, t.scope(s), set);
  if (key.empty()) s.keyword->fail("ELSET=" + set, "a set of elements of TYPE=SPRINGA or SPRING1");
  const std::vector<DeckNames::Spring>& springs = t.mesh.names.springs.at(key);
  const bool is_grounded = springs.front().to.empty();
  DeckCursor at(*s.keyword);
  if (!at.next_line()) s.keyword->fail("no data", "the stiffness");
  const std::int64_t dof = is_grounded ? at.integer("the degree of freedom") : 0;
  if (is_grounded && (dof < 1 || dof > 3)) at.fail(fmt::format("degree of freedom {}", dof), "1, 2 or 3");
  if (is_grounded && !at.next_line()) at.fail("no stiffness", "a second line with the stiffness");
  const double stiffness = at.real("the stiffness");
  for (const DeckNames::Spring& spring : springs) {
    if (spring.to.empty() != is_grounded) s.keyword->fail("SPRINGA and SPRING1 in one set", "one type in a set");
    TableMaker table(s.keyword->where);
    table.text("nodes", spring.from);
    if (is_grounded) {
      Vec3 along{};
      along[carom::at(dof - 1)] = stiffness;
      table.vector("stiffness", along);
    } else {
      table.text("to", spring.to).number("axial", stiffness);
    }
    t.append("spring", table.node());
  }
}

}  // namespace

void translate_discrete(Translation& t) {
  static const std::map<std::string, void (*)(Translation&, const Statement&)> known{
      {"MASS", translate_mass}, {"ROTARY INERTIA", translate_inertia}, {"SPRING", translate_spring}};
  for (const Statement& s : t.statements.list)
    if (const auto found = known.find(s.keyword->name); found != known.end())
      t.errors.attempt([&] { found->second(t, s); });
  translate_initial(t);
}

}  // namespace carom
