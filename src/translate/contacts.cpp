// *CONTACT PAIR, general contact and *TIE.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "deck/keyword_table.hpp"
#include "translate/rigid.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// What a *SURFACE INTERACTION says.
struct Interaction {
  const DeckKeyword* keyword = nullptr;
  std::optional<double> stiffness, tangential_stiffness;
  std::vector<double> depths, pressures;  ///< of a table, beyond its point without pressure
  const DeckKeyword* table = nullptr;
  double friction = 0.0;
};

/// Pairs of pressure and overclosure, the first without pressure.
void read_pressures(const DeckKeyword& keyword, Interaction& to) {
  to.table = &keyword;
  DeckCursor at(keyword);
  bool is_first = true;
  for (; at.next_line(); is_first = false) {
    const double pressure = at.real("the pressure"), overclosure = at.real("the overclosure");
    if (!is_first) {
      to.pressures.push_back(pressure);
      to.depths.push_back(overclosure);
    } else if (pressure != 0.0 || overclosure != 0.0) {
      at.fail(fmt::format("pressure {:g} at overclosure {:g} in the first line", pressure, overclosure),
              "0, 0: contact begins where the surfaces touch. Clearance that carries pressure is not computed: move "
              "one of the surfaces by it.");
    }
  }
  if (to.depths.empty())
    keyword.fail("no points", "lines of pressure, overclosure: 0, 0 and at least one more with larger ones");
}

void read_behavior(Translation& t, const DeckKeyword& keyword, Interaction& to) {
  const std::string* given = keyword.parameter("PRESSURE-OVERCLOSURE");
  const std::string kind = given == nullptr ? "HARD" : upper_case(*given);
  if (kind == "HARD") return;
  DeckCursor at(keyword);
  if (kind == "LINEAR") {
    if (!at.next_line()) keyword.fail("no data", "the slope of pressure over overclosure");
    const double slope = at.real("the slope");
    if (!(slope > 0.0)) at.fail(fmt::format("slope {:g}", slope), "a positive one");
    to.stiffness = slope;
    return;
  }
  if (kind == "TABULAR") return read_pressures(keyword, to);
  if (kind == "TIED")
    return t.findings.refuse(keyword, keyword.where, "PRESSURE-OVERCLOSURE=TIED",
                             "The surfaces would slide and part: write *TIE.");
  t.findings.refuse(keyword, keyword.where, "PRESSURE-OVERCLOSURE=" + kind,
                    "Contact would have the stiffness that Carom chooses from the material and the cells.");
}

void read_friction(Translation& t, const DeckKeyword& keyword, Interaction& to) {
  DeckCursor at(keyword);
  if (!at.next_line()) return;
  to.friction = at.real("the coefficient of friction");
  const double stick = at.real_or(0.0, "the stiffness of sticking");
  if (stick > 0.0) to.tangential_stiffness = stick;
  if (at.next_line())
    t.findings.refuse(keyword, at.where(), "friction that depends on slip or pressure", "The first line would hold.");
}

std::map<std::string, Interaction> interactions_of(Translation& t) {
  std::map<std::string, Interaction> all;
  Interaction* last = nullptr;
  for (const Statement& s : t.statements.list) {
    const DeckKeyword& keyword = *s.keyword;
    if (keyword.name == "SURFACE INTERACTION") {
      const auto [place, is_new] = all.try_emplace(keyword.required("NAME"));
      last = &place->second;
      if (!is_new)
        t.errors.attempt([&] {
          keyword.fail("the interaction " + keyword.required("NAME") + " a second time",
                       "one *SURFACE INTERACTION of a name");
        });
      last->keyword = &keyword;
    }
    if (keyword.name != "SURFACE BEHAVIOR" && keyword.name != "FRICTION") continue;
    if (last == nullptr) keyword.fail("*" + keyword.name + " of no interaction", "*SURFACE INTERACTION before it");
    t.errors.attempt([&] {
      if (keyword.name == "FRICTION")
        read_friction(t, keyword, *last);
      else
        read_behavior(t, keyword, *last);
    });
  }
  return all;
}

void add_interaction(Translation& t, const Interaction& of, bool is_rigid, TableMaker& to) {
  if (of.stiffness) to.number("stiffness", *of.stiffness);
  if (of.table != nullptr && !is_rigid)
    t.findings.refuse(*of.table, of.table->where, "PRESSURE-OVERCLOSURE=TABULAR between bodies that deform",
                      "Rigid surfaces take tables. Contact would have the stiffness that Carom chooses from the "
                      "material and the cells.");
  else if (of.table != nullptr)
    to.add("depths", numbers_node(of.depths, of.table->where))
        .add("pressures", numbers_node(of.pressures, of.table->where));
  if (of.friction != 0.0) to.number("friction", of.friction);
  if (of.friction != 0.0 && of.tangential_stiffness) to.number("tangential_stiffness", *of.tangential_stiffness);
}

const Interaction& interaction(const std::map<std::string, Interaction>& all, const std::string& name,
                               const DeckCursor& at) {
  const auto found = all.find(name);
  if (found == all.end()) at.fail("the unknown interaction " + name, "the NAME of a *SURFACE INTERACTION");
  return found->second;
}

/// What is not as the deck has it of a surface that is met.
void note_shape(Translation& t, const Location& where, const DeckNames::Surface& surface) {
  if (surface.is_side_chosen)
    t.findings.note(where,
                    surface.group + " names no side: it is met from that where the bodies are, from there alone");
  if (surface.roundness > 0.0)
    t.findings.note(where, fmt::format("{} is made of flat faces, whose middles are up to {:.3g} inside of its arcs",
                                       surface.group, surface.roundness));
}

std::string faces_of(Translation& t, const Statement& s, const DeckCursor& at, const std::string& name) {
  const std::string key = key_of(t.mesh.names.surfaces, t.scope(s), name);
  if (key.empty()) at.fail("\"" + name + "\"", "the NAME of a *SURFACE");
  const DeckNames::Surface& surface = t.mesh.names.surfaces.at(key);
  if (surface.faces.empty())
    at.fail(name + ", a surface of nodes that make no face", "nodes with all those of a face, or TYPE=ELEMENT",
            "Carom's contact needs the faces of both sides.");
  note_shape(t, at.where(), surface);
  if (surface.kind == DeckNames::SurfaceKind::nodes)
    t.findings.note(at.where(),
                    name + " is a surface of nodes: the faces between them touch, or bars with their sides");
  return surface.faces;
}

std::string method_of(Translation& t, const DeckKeyword& pair) {
  const std::string* type = pair.parameter("TYPE");
  if (type == nullptr) return "two_pass";
  const std::string name = without_blanks(*type);
  if (name == "SURFACETOSURFACE") return "surface_to_surface";
  if (name == "NODETOSURFACE") return "node_to_surface";
  if (name == "MASSLESS" || name == "MORTAR" || name == "LINMORTAR" || name == "PGLINMORTAR") {
    t.findings.refuse(pair, pair.where, "TYPE=" + *type,
                      name == "MASSLESS"
                          ? "Nodes in contact would keep their mass, and contact be enforced as Carom does."
                          : "Contact would be that of faces with faces, as Carom does it.");
    return name == "MASSLESS" ? "two_pass" : "surface_to_surface";
  }
  pair.fail("TYPE=" + *type, "NODE TO SURFACE or SURFACE TO SURFACE");
}

/// ADJUST=0 takes overlaps as touching; a distance or a set also closes gaps.
void refuse_closing(Translation& t, const DeckKeyword& pair) {
  const std::string* adjust = pair.parameter("ADJUST");
  if (adjust == nullptr) return;
  const auto distance = as_real(*adjust);
  if (!distance || *distance != 0.0)
    t.findings.refuse(pair, pair.where, "ADJUST=" + *adjust, "Gaps at the start would stay open.");
}

/// What a pair has besides its surfaces.
struct OfPair {
  const DeckKeyword* keyword = nullptr;
  const Interaction* interaction = nullptr;
  std::string method;              ///< "" Carom's own
  bool is_offset = false;          ///< overlaps at the start count as touching
  bool takes_rigid_first = false;  ///< in either order: the rigid surface is the master
};

void add_pair(Translation& t, const DeckCursor& at, const Statement& s, std::string slave, std::string master,
              const OfPair& of) {
  const bool is_self = master.empty() || upper_case(master) == upper_case(slave);
  std::string group = faces_of(t, s, at, slave), other = is_self ? group : faces_of(t, s, at, master);
  if (of.takes_rigid_first && body_of_cells(t, group) != nullptr && body_of_cells(t, other) == nullptr) {
    std::swap(slave, master);
    std::swap(group, other);
  }
  if (body_of_cells(t, group) != nullptr)
    at.fail(slave + ", the surface of a rigid body", "the deformable one first", "Name the rigid surface second.");
  TableMaker contact(at.where());
  contact.text("name", is_self ? upper_case(slave) + " self" : upper_case(slave) + " on " + upper_case(master));
  DeckRigidBody* body = body_of_cells(t, other);
  if (body != nullptr) {
    contact.text("kind", "surface").text("group", group).text("surface", other);
    add_rigid_motion(t, *body, contact);
  } else {
    contact.text("kind", is_self ? "self" : "pair").text("group", group);
    if (!is_self) contact.text("master", other);
    if (!of.method.empty()) contact.text("method", of.method);
  }
  contact.text("initial_penetration", of.is_offset ? "offset" : "prestress");
  if (of.interaction != nullptr)
    add_interaction(t, *of.interaction, body != nullptr, contact);
  else
    t.findings.note(of.keyword->where, "no INTERACTION: without friction, the stiffness is chosen");
  t.append("contact", contact.node());
}

void translate_pairs(Translation& t, const std::map<std::string, Interaction>& all, const Statement& s) {
  const DeckKeyword& keyword = *s.keyword;
  refuse_closing(t, keyword);
  const std::string method = method_of(t, keyword);
  for (DeckCursor at(keyword); at.next_line();)
    t.errors.attempt([&] {
      const std::string slave(at.field()), master(at.field());
      at.end_line("the slave and the master");
      const bool has_interaction = keyword.has("INTERACTION");
      add_pair(t, at, s, slave, master,
               {&keyword, has_interaction ? &interaction(all, keyword.required("INTERACTION"), at) : nullptr, method,
                keyword.has("ADJUST") || t.is_explicit_abaqus(), t.is_explicit_abaqus()});
    });
}

/// A line of *CONTACT PROPERTY ASSIGNMENT; without surfaces it is for all.
struct Assignment {
  const DeckKeyword* keyword = nullptr;
  std::string first, second;
  const Interaction* interaction = nullptr;
  DeckCursor at;

  bool is_for_all() const { return first.empty() && second.empty(); }
  bool is_for(const std::string& a, const std::string& b) const {
    return is_for_all() || (first == a && second == b) || (first == b && second == a);
  }
};

std::vector<Assignment> assignments_of(Translation& t, const std::map<std::string, Interaction>& all) {
  std::vector<Assignment> assignments;
  for (std::size_t i = 0; i < t.statements.list.size(); ++i) {
    const DeckKeyword& keyword = *t.statements.list[i].keyword;
    if (keyword.name != "CONTACT PROPERTY ASSIGNMENT") continue;
    if (t.steps.size() > 1 && i > t.steps[1].begin) {
      t.findings.refuse(keyword, keyword.where, "an interaction that begins with a later step",
                        "That of the first would hold for the whole run.");
      continue;
    }
    for (DeckCursor at(keyword); at.next_line();) {
      const std::string first = upper_case(at.field()), second = upper_case(at.field());
      assignments.push_back(
          {&keyword, first, second.empty() ? first : second, &interaction(all, upper_case(at.field()), at), at});
    }
  }
  return assignments;
}

/// General contact of chosen surfaces: pairs, a surface alone with itself.
void translate_inclusions(Translation& t, const std::vector<Assignment>& assignments, const Statement& s) {
  bool has_lines = false;
  for (DeckCursor at(*s.keyword); at.next_line();) {
    has_lines = true;
    const std::string first(at.field()), second(at.field());
    at.end_line("two surfaces");
    if (first.empty()) at.fail("contact of all with chosen surfaces", "two surfaces in a line, or ALL EXTERIOR");
    const Interaction* of = nullptr;
    for (const Assignment& assignment : assignments)
      if (assignment.is_for(upper_case(first), upper_case(second.empty() ? first : second)))
        of = assignment.interaction;
    add_pair(t, at, s, first, second, {s.keyword, of, {}, true, true});
  }
  if (!has_lines) s.keyword->fail("no surfaces", "ALL EXTERIOR, or lines of two surfaces");
}

/// What *CONTACT EXCLUSIONS takes out of general contact of all: surfaces that touch nothing, by lines whose first name
/// is empty, and rigid bodies.
struct Exclusions {
  std::vector<std::string> groups;
  std::set<const DeckRigidBody*> bodies;
  Location where;
};

Exclusions exclusions_of(Translation& t) {
  Exclusions excluded;
  for (const Statement& s : t.statements.list) {
    if (s.keyword->name != "CONTACT EXCLUSIONS") continue;
    for (DeckCursor at(*s.keyword); at.next_line();) {
      const std::string first(at.field()), second(at.field());
      at.end_line("two surfaces");
      if (first.empty() && second.empty()) at.fail("no surface", "one or two");
      const auto body_of = [&](const std::string& name) {
        return name.empty() ? nullptr : body_of_cells(t, faces_of(t, s, at, name));
      };
      const DeckRigidBody *a = body_of(first), *b = body_of(second.empty() ? first : second);
      if (a != nullptr && b != nullptr)
        t.findings.note(at.where(), "rigid surfaces do not touch each other anyway");
      else if (first.empty() && b != nullptr)
        excluded.bodies.insert(b);
      else if (first.empty() && t.rigid_bodies.empty())
        excluded.groups.push_back(faces_of(t, s, at, second));
      else
        t.findings.refuse(
            *s.keyword, at.where(),
            first.empty()                                               ? second + " beside rigid bodies"
            : second.empty() || upper_case(second) == upper_case(first) ? first + " with itself"
                                                                        : first + " with " + second,
            "They would touch. A line with the second name alone takes a surface out altogether, where no "
            "rigid body is met.");
      excluded.where = at.where();
    }
  }
  return excluded;
}

void translate_general(Translation& t, const std::map<std::string, Interaction>& all, const Statement& s) {
  const DeckKeyword& inclusions = *s.keyword;
  const std::vector<Assignment> assignments = assignments_of(t, all);
  if (!inclusions.has("ALL EXTERIOR")) {
    for (const Statement& other : t.statements.list)
      if (other.keyword->name == "CONTACT EXCLUSIONS")
        t.findings.refuse(*other.keyword, other.keyword->where, "exclusions beside chosen surfaces",
                          "The pairs of *CONTACT INCLUSIONS would touch: leave out those that shall not.");
    return translate_inclusions(t, assignments, s);
  }
  Interaction of;
  for (const Assignment& assignment : assignments)
    if (assignment.is_for_all())
      of = *assignment.interaction;
    else
      t.findings.refuse(*assignment.keyword, assignment.at.where(), "an interaction of single surfaces",
                        "That of all surfaces would hold, or none where none is given.");
  TableMaker contact(inclusions.where);
  contact.text("name", "general contact").text("kind", "all").text("initial_penetration", "offset");
  const Exclusions excluded = exclusions_of(t);
  if (!excluded.groups.empty()) contact.add("exclude", texts_node(excluded.groups, excluded.where));
  add_interaction(t, of, false, contact);
  t.append("contact", contact.node());
  for (DeckRigidBody& body : t.rigid_bodies) {
    const auto side = t.mesh.names.surfaces.find(body.side);
    if (side == t.mesh.names.surfaces.end() || excluded.bodies.contains(&body)) continue;
    TableMaker rigid(body.keyword->where);
    rigid.text("name", "general contact on " + body.side).text("kind", "surface");
    rigid.text("group", t.mesh.names.surfaces.at(all_exterior).group).text("surface", side->second.group);
    add_rigid_motion(t, body, rigid);
    rigid.text("initial_penetration", "offset");
    add_interaction(t, of, true, rigid);
    t.append("contact", rigid.node());
    const std::vector<CellRef>& met = t.mesh.mesh.cell_groups.at(side->second.group);
    t.leaves_faces = t.leaves_faces || std::any_of(met.begin(), met.end(),
                                                   [&](const CellRef& cell) { return body.cells.count(cell) == 0; });
    note_shape(t, body.keyword->where, side->second);
    if (body.keyword->has("ELSET"))
      t.findings.note(body.keyword->where,
                      "general contact meets the rigid body from the side where the other bodies are");
  }
}

void translate_ties(Translation& t, const Statement& s) {
  const DeckKeyword& keyword = *s.keyword;
  const std::string* given = keyword.parameter("POSITION TOLERANCE");
  double distance = 0.0;
  if (given != nullptr) distance = as_real(*given).value_or(-1.0);
  if (distance < 0.0) keyword.fail("POSITION TOLERANCE=" + *given, "a distance of 0 or more");
  for (DeckCursor at(keyword); at.next_line();) {
    const std::string slave(at.field()), master(at.field());
    at.end_line("the slave and the master");
    const std::string group = faces_of(t, s, at, slave), other = faces_of(t, s, at, master);
    for (const std::string& side : {group, other})
      if (body_of_cells(t, side) != nullptr)
        at.fail("a rigid body in a tie", "two deformable surfaces", "Let it push by *CONTACT PAIR instead.");
    TableMaker tie(at.where());
    tie.text("name", upper_case(slave) + " to " + upper_case(master)).text("kind", "tie").text("group", group);
    tie.text("master", other);
    if (keyword.has("TYPE")) tie.text("method", method_of(t, keyword));
    if (given != nullptr) tie.number("distance", distance).text("far", "leave");
    t.append("contact", tie.node());
  }
}

/// Rigid surfaces that no contact names do nothing.
void leave_unmet(Translation& t) {
  for (const DeckRigidBody& body : t.rigid_bodies) {
    if (!body.is_obstacle() || body.contacts > 0) continue;
    t.findings.note(body.keyword->where, "no contact meets the rigid surface " + body.name);
    t.leaves_faces = true;
  }
}

}  // namespace

void translate_contacts(Translation& t) {
  const std::map<std::string, Interaction> all = interactions_of(t);
  for (std::size_t i = 0; i < t.statements.list.size(); ++i) {
    const Statement& s = t.statements.list[i];
    const bool is_pair = s.keyword->name == "CONTACT PAIR", is_tie = s.keyword->name == "TIE";
    if (!is_pair && !is_tie && s.keyword->name != "CONTACT INCLUSIONS") continue;
    const std::string* op = s.keyword->parameter("OP");
    if (is_pair && op != nullptr && upper_case(*op) == "DELETE") {
      t.findings.refuse(*s.keyword, s.keyword->where, "contact that ends with a step", "It would stay.");
      continue;
    }
    if (t.steps.size() > 1 && i > t.steps[1].begin)
      t.findings.refuse(*s.keyword, s.keyword->where, "contact that begins with a later step",
                        "It would be there from the start.");
    t.errors.attempt([&] {
      if (is_tie)
        translate_ties(t, s);
      else if (is_pair)
        translate_pairs(t, all, s);
      else
        translate_general(t, all, s);
    });
  }
  if (t.errors.empty()) leave_unmet(t);
}

}  // namespace carom
