#include "mesh/deck_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "base/terminal_text.hpp"
#include "deck/keyword_table.hpp"
#include "math/vec3.hpp"
#include "mesh/deck_analytic.hpp"
#include "mesh/deck_faces.hpp"
#include "mesh/deck_generated.hpp"
#include "mesh/deck_sets.hpp"
#include "mesh/finish_mesh.hpp"

namespace carom {

namespace {

constexpr std::int64_t highest_number = 2'000'000'000;

class DeckMeshReader {
 public:
  DeckMeshReader(const Statements& statements, const std::string& source, CaseErrors& errors)
      : statements_(statements),
        errors_(errors),
        faces_(mesh_, elements_),
        generator_(statements, mesh_, elements_, node_sets_, element_sets_) {
    mesh_.report.source = source;
    mesh_.report.format = "deck of Abaqus or CalculiX";
  }

  DeckMesh run() {
    refuse_made_elsewhere();
    expect_numbers();
    each({"NODE", "NGEN"}, [this](const Statement& s) { read_nodes(s); });
    if (is_whole_) each({"ELEMENT", "ELGEN"}, [this](const Statement& s) { read_elements(s); });
    next_number_ = element_offset_;
    if (is_whole_) {
      for (const Statement& s : statements_.list) attempt([&] { read_set(s); });
      each({"SURFACE"}, [this](const Statement& s) { read_surface(s); });
    }
    if (is_whole_) {
      make_element_groups();
      make_node_groups();
      each({"DLOAD"}, [this](const Statement& s) { make_loaded_faces(s); });
      attempt([&] { make_general_contact(); });
      name_surfaces();
    }
    for (const DeckNote& note : notes_) mesh_.report.notes.push_back(to_string(note.where) + ": " + note.text);
    note_others();
    return {std::move(mesh_), std::move(names_), is_whole_, std::move(notes_), std::move(read_)};
  }

 private:
  const DeckScope& scope(const Statement& s) const { return statements_.scopes[at(s.scope)]; }

  /// Scope after scope, so that numbers of instances count on from those of the deck itself.
  template <class Visit>
  void each(const std::set<std::string>& names, const Visit& visit) {
    for (std::size_t own = 0; own < statements_.scopes.size(); ++own) {
      node_offset_ = highest_node_, element_offset_ = highest_element_;
      if (own > 0) name_numbers(names, statements_.scopes[own].prefix);
      for (const Statement& s : statements_.list)
        if (at(s.scope) == own && names.count(s.keyword->name) != 0) attempt([&] { visit(s); });
    }
    node_offset_ = highest_node_, element_offset_ = highest_element_;
    if (statements_.scopes.size() > 1) name_numbers(names, "");
  }

  /// Those that follow are of the instance with this prefix.
  void name_numbers(const std::set<std::string>& keywords, const std::string& prefix) {
    const std::string instance = prefix.substr(0, prefix.find_last_of('.'));
    if (keywords.contains("NODE")) mesh_.node_instances.push_back({node_offset_, instance});
    if (keywords.contains("ELEMENT")) mesh_.cell_instances.push_back({element_offset_, instance});
  }

  /// What fails makes a mesh that is not whole.
  template <class Work>
  void attempt(const Work& work) {
    is_whole_ = errors_.attempt(work) && is_whole_;
  }

  void refuse_made_elsewhere() {
    for (const Statement& s : statements_.list) {
      const KeywordEntry* entry = find_keyword(s.keyword->name);
      if (entry == nullptr || entry->use != KeywordUse::refused_mesh) continue;
      attempt([&] {
        s.keyword->fail("a keyword that Carom does not carry out", "nodes and elements in full",
                        std::string(entry->meaning) + " Write the deck with all its nodes and elements.");
      });
    }
  }

  /// Tables as large as the bytes of the lines let expect.
  void expect_numbers() {
    constexpr std::size_t node_bytes = 16, element_bytes = 24;
    std::vector<std::size_t> nodes(statements_.scopes.size()), elements(statements_.scopes.size());
    for (const Statement& s : statements_.list)
      for (const DeckChunk& chunk : s.keyword->data) {
        if (s.keyword->name == "NODE") nodes[at(s.scope)] += chunk.text.size() / node_bytes;
        if (s.keyword->name == "ELEMENT") elements[at(s.scope)] += chunk.text.size() / element_bytes;
      }
    node_sets_.expect(nodes);
    element_sets_.expect(elements);
  }

  std::int64_t number(DeckCursor& at, std::string_view what) const {
    const std::int64_t value = at.integer(what);
    if (value < 1 || value > highest_number)
      at.fail(fmt::format("{}", value), fmt::format("{} from 1 to {}", what, highest_number));
    return value;
  }

  void read_nodes(const Statement& s) {
    if (s.keyword->name == "NGEN") return generator_.add_nodes(s, node_offset_, highest_node_);
    const std::string* set = s.keyword->parameter("NSET");
    std::vector<Index> members;
    for (DeckCursor at(*s.keyword); at.next_line();) {
      const std::int64_t own = number(at, "the number of a node");
      const auto index = static_cast<Index>(mesh_.coordinates.size());
      Vec3 x{};
      for (double& component : x) component = at.real_or(0.0, "a coordinate");
      if (mesh_.coordinates.size() >= at_most) at.fail("more than 2147483647 nodes", "fewer");
      if (!node_sets_.insert(s.scope, own, index))
        at.fail(fmt::format("node {} a second time", own), "every node once", "Renumber the nodes.");
      mesh_.coordinates.push_back(scope(s).placement.of(x));
      mesh_.node_numbers.push_back(node_offset_ + own);
      highest_node_ = std::max(highest_node_, node_offset_ + own);
      if (set != nullptr) members.push_back(index);
    }
    if (set == nullptr) return;
    std::vector<Index>& to = node_sets_.set(scope(s).prefix + upper_case(*set));
    to.insert(to.end(), members.begin(), members.end());
  }

  const DeckElementType& element_type(const DeckKeyword& keyword) const {
    const std::string name = keyword.required("TYPE");
    const DeckElementType* type = deck_element_type(name);
    if (type != nullptr) return *type;
    std::vector<std::string> known;
    for (const DeckElementType& each : deck_element_types()) known.emplace_back(each.name);
    const std::string near = nearest(name, known);
    keyword.fail("elements of type " + name, "a type that Carom reads (docs/decks.md)",
                 near.empty() ? "" : "The nearest is " + near + ".");
  }

  void read_elements(const Statement& s) {
    if (s.keyword->name == "ELGEN") return generator_.add_elements(s, element_offset_, highest_element_, read_);
    const DeckElementType* known = nullptr;
    if (!errors_.attempt([&] { known = &element_type(*s.keyword); })) return read_unknown_elements(s);
    const DeckElementType& type = *known;
    if (type.kind == DeckElementType::Kind::unknown) return read_unknown_elements(s);
    const std::size_t block = type.kind == DeckElementType::Kind::cell ? block_of(mesh_, type.type) : 0;
    const std::string* set = s.keyword->parameter("ELSET");
    std::vector<Index> members;
    DeckCells made{s.keyword, s.scope, {static_cast<Index>(block), 0}, 0};
    if (type.kind == DeckElementType::Kind::cell) made.begin.cell = static_cast<Index>(mesh_.blocks[block].size());
    for (DeckCursor at(*s.keyword); at.next_line();) {
      const auto index = static_cast<Index>(elements_.size());
      const std::int64_t own = number(at, "the number of an element");
      if (elements_.size() >= at_most) at.fail("more than 2147483647 elements", "fewer");
      if (!element_sets_.insert(s.scope, own, index))
        at.fail(fmt::format("element {} a second time", own), "every element once", "Renumber the elements.");
      read_element(at, s, type, block, own);
      if (set != nullptr) members.push_back(index);
    }
    if (type.kind == DeckElementType::Kind::cell) {
      made.end = static_cast<Index>(mesh_.blocks[block].size());
      read_.push_back(made);
    }
    if (set == nullptr) return;
    std::vector<Index>& to = element_sets_.set(scope(s).prefix + upper_case(*set));
    to.insert(to.end(), members.begin(), members.end());
  }

  /// Their numbers alone: a line that ends with a comma goes on in the next one.
  void read_unknown_elements(const Statement& s) {
    has_unknown_ = true;
    std::vector<Index> members;
    bool goes_on = false;
    for (DeckCursor at(*s.keyword); at.next_line();) {
      const bool is_first = !goes_on;
      goes_on = at.line().ends_with(',');
      if (!is_first) continue;
      const std::int64_t own = number(at, "the number of an element");
      if (!element_sets_.insert(s.scope, own, static_cast<Index>(elements_.size()))) continue;
      members.push_back(static_cast<Index>(elements_.size()));
      elements_.push_back({&unknown_element_type(), {}, {}, own});
    }
    const std::string* set = s.keyword->parameter("ELSET");
    if (set == nullptr) return;
    std::vector<Index>& to = element_sets_.set(scope(s).prefix + upper_case(*set));
    to.insert(to.end(), members.begin(), members.end());
  }

  void read_element(DeckCursor& at, const Statement& s, const DeckElementType& type, std::size_t block,
                    std::int64_t own) {
    std::array<Index, most_nodes> nodes{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(type.nodes); ++i) {
      if (at.at_end() && !at.next_line())
        at.fail(fmt::format("{} nodes of element {}", i, own), fmt::format("{} of a {}", type.nodes, type.name));
      nodes[i] = node_of_element(at, s.scope, own);
    }
    if (!at.at_end() && !at.field().empty())
      at.fail(fmt::format("more than {} nodes of element {}", type.nodes, own),
              fmt::format("{} of a {}", type.nodes, type.name), "Is the TYPE right?");
    DeckElement element{&type, {}, {nodes[0], nodes[1]}, own};
    highest_element_ = std::max(highest_element_, element_offset_ + own);
    if (type.kind == DeckElementType::Kind::cell) {
      CellBlock& cells = mesh_.blocks[block];
      element.cell = {static_cast<Index>(block), static_cast<Index>(cells.size())};
      for (std::size_t i = 0; i < static_cast<std::size_t>(type.nodes); ++i)
        cells.connectivity.push_back(nodes[type.order.empty() ? i : type.order[i]]);
      cells.file_numbers.push_back(element_offset_ + own);
    }
    elements_.push_back(element);
  }

  /// "7", or "PART-1-1.7".
  Index node_of_element(DeckCursor& at, int scope, std::int64_t element) {
    DeckCursor peek = at;
    const std::string_view text = peek.field();
    if (text.find('.') == std::string_view::npos || as_real(text)) {
      const std::int64_t node = at.integer("the number of a node");
      const Index found = node_sets_.find(scope, node);
      if (found < 0) at.fail(fmt::format("node {} in element {}", node, element), "the number of a node in *NODE");
      return found;
    }
    at.field();
    const std::vector<Index>* found = node_sets_.entries(text, scope, statements_);
    if (found == nullptr || found->size() != 1)
      at.fail(fmt::format("node {} in element {}", printable(text), element), "the number of a node in *NODE");
    return found->front();
  }

  void read_set(const Statement& s) {
    const DeckKeyword& keyword = *s.keyword;
    if (keyword.name == "ELSET") element_sets_.read(s, statements_, notes_);
    if (keyword.name != "NSET") return;
    const std::string* of = keyword.parameter("ELSET");
    if (of == nullptr) return node_sets_.read(s, statements_, notes_);
    const std::vector<Index>* elements = element_sets_.entries(*of, s.scope, statements_);
    if (elements == nullptr) keyword.fail("the unknown element set " + *of, "the name of an ELSET before this one");
    std::vector<Index>& to = node_sets_.set(scope(s).prefix + keyword.required("NSET"));
    for (const Index e : *elements) {
      const std::vector<Index> nodes = nodes_of(elements_[at(e)]);
      to.insert(to.end(), nodes.begin(), nodes.end());
    }
  }

  std::vector<Index> nodes_of(const DeckElement& element) const {
    if (element.type->kind != DeckElementType::Kind::cell)
      return {element.node.begin(), element.node.begin() + element.type->nodes};
    const auto nodes = mesh_.blocks[at(element.cell.block)].nodes(element.cell.cell);
    return {nodes.begin(), nodes.end()};
  }

  void read_surface(const Statement& s) {
    const DeckKeyword& keyword = *s.keyword;
    const std::string name = scope(s).prefix + keyword.required("NAME");
    const std::string* given = keyword.parameter("TYPE");
    const std::string type = given == nullptr ? "ELEMENT" : upper_case(*given);
    if (keyword.has("COMBINE")) return unite_surfaces(s, name);
    if (type == "NODE") {
      read_node_surface(s, name);
    } else if (type == "ELEMENT") {
      names_.surfaces[name] = {name, DeckNames::SurfaceKind::faces, name};
      for (DeckCursor at(keyword); at.next_line();) {
        const std::vector<Index> elements = elements_named(at, s.scope);
        std::string label = upper_case(at.field());
        if (label.empty() && are_rigid(elements)) {
          label = faces_.looks_at_bodies(elements) ? "SPOS" : "SNEG";
          names_.surfaces[name].is_side_chosen = true;
        }
        faces_.append(elements, label, at, surface_cells_[name], next_number_);
      }
    } else if (type == "SEGMENTS" || type == "CYLINDER" || type == "REVOLUTION") {
      names_.surfaces[name] = {name, DeckNames::SurfaceKind::faces, name};
      names_.surfaces[name].roundness = add_analytic_faces(s, type, surface_cells_[name]);
    } else {
      notes_.push_back({keyword.where, fmt::format("the surface {} of TYPE={} is no mesh; left out", name, type)});
    }
  }

  /// COMBINE=UNION of surfaces of faces that stand before it, each face once.
  void unite_surfaces(const Statement& s, const std::string& name) {
    const DeckKeyword& keyword = *s.keyword;
    if (keyword.required("COMBINE") != "UNION")
      keyword.fail("COMBINE=" + keyword.required("COMBINE"), "UNION", "Write the faces that are meant.");
    std::vector<CellRef> all;
    for (DeckCursor at(keyword); at.next_line();)
      while (!at.at_end()) {
        const std::string text(at.field());
        if (text.empty()) continue;
        const std::string key = key_of(names_.surfaces, scope(s), text);
        if (key.empty() || names_.surfaces.at(key).kind != DeckNames::SurfaceKind::faces)
          at.fail(printable(text), "the NAME of a *SURFACE of faces before this one");
        std::ranges::copy(surface_cells_[key], std::back_inserter(all));
      }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    names_.surfaces[name] = {name, DeckNames::SurfaceKind::faces, name};
    surface_cells_[name] = std::move(all);
  }

  /// Returns how far the faces are from the surface.
  double add_analytic_faces(const Statement& s, const std::string& type, std::vector<CellRef>& to) {
    const AnalyticFaces made = analytic_faces(*s.keyword, type, box_diagonal());
    const auto first = static_cast<Index>(mesh_.coordinates.size());
    for (const Vec3& x : made.points) {
      mesh_.coordinates.push_back(scope(s).placement.of(x));
      mesh_.node_numbers.push_back(++highest_node_);
    }
    constexpr std::array types{CellType::line2, CellType::tria3, CellType::quad4};
    for (const std::vector<std::size_t>& face : made.faces) {
      const std::size_t block = block_of(mesh_, types.at(face.size() - 2));
      CellBlock& cells = mesh_.blocks[block];
      to.push_back({static_cast<Index>(block), static_cast<Index>(cells.size())});
      for (const std::size_t point : face) cells.connectivity.push_back(first + static_cast<Index>(point));
      cells.file_numbers.push_back(++next_number_);
    }
    return made.roundness;
  }

  /// Of the box around all nodes.
  double box_diagonal() const {
    Vec3 size{};
    for (std::size_t c = 0; c < 3 && !mesh_.coordinates.empty(); ++c) {
      const auto [least, most] = std::ranges::minmax(mesh_.coordinates, {}, [c](const Vec3& x) { return x[c]; });
      size[c] = most[c] - least[c];
    }
    return norm(size);
  }

  void read_node_surface(const Statement& s, const std::string& name) {
    names_.surfaces[name] = {name, DeckNames::SurfaceKind::nodes, {}};
    std::vector<Index>& to = surface_nodes_[name];
    for (DeckCursor at(*s.keyword); at.next_line();) {
      const std::string_view text = at.field();
      const std::vector<Index>* nodes = node_sets_.entries(text, s.scope, statements_);
      if (nodes == nullptr) at.fail(printable(text), "the number of a node or the name of a node set");
      to.insert(to.end(), nodes->begin(), nodes->end());
      // Abaqus' modeller writes the area that nodes have without one.
      const double area = at.real_or(1.0, "an area");
      if (area != 1.0) at.fail(fmt::format("an area of {:g}", area), "1, or none", "Areas of nodes are not taken.");
      at.end_line("one node or set in a line, and an area of 1");
    }
  }

  const std::vector<Index>& elements_named(DeckCursor& at, int scope) {
    const std::string_view text = at.field();
    const std::vector<Index>* elements = element_sets_.entries(text, scope, statements_);
    if (elements == nullptr) at.fail(printable(text), "the number of an element or the name of an element set");
    return *elements;
  }

  /// Of each ELSET: its cells, those of each type where it has several; nodes of point masses and rotary inertias;
  /// ends of springs.
  void make_element_groups() {
    for (const auto& [name, members] : element_sets_.all()) {
      std::map<const DeckElementType*, std::vector<CellRef>> cells;
      for (const Index e : members) {
        const DeckElement& element = elements_[at(e)];
        if (element.type->kind == DeckElementType::Kind::cell)
          cells[element.type].push_back(element.cell);
        else if (element.type->kind == DeckElementType::Kind::unknown)
          names_.element_sets[name];
        else
          group_discrete(name, element, e);
      }
      for (const auto& [type, refs] : cells) {
        const std::string own = cells.size() == 1 ? name : fmt::format("{} {}", name, type->name);
        names_.element_sets[name].push_back({own, type});
        if (cells.size() > 1) mesh_.cell_groups[own] = refs;
        std::vector<CellRef>& all = mesh_.cell_groups[name];
        all.insert(all.end(), refs.begin(), refs.end());
      }
    }
  }

  void group_discrete(const std::string& set, const DeckElement& element, Index number) {
    const bool is_mass = element.type->kind == DeckElementType::Kind::mass;
    if (is_mass || element.type->kind == DeckElementType::Kind::inertia) {
      (is_mass ? names_.masses : names_.inertias)[set] = set;
      std::vector<Index>& nodes = mesh_.node_groups[set];
      if (std::find(nodes.begin(), nodes.end(), element.node[0]) == nodes.end()) nodes.push_back(element.node[0]);
      return;
    }
    const std::string from = fmt::format("SPRING {}, from", number + 1), to = fmt::format("SPRING {}, to", number + 1);
    mesh_.node_groups[from] = {element.node[0]};
    if (element.type->nodes == 2) mesh_.node_groups[to] = {element.node[1]};
    names_.springs[set].push_back({from, element.type->nodes == 2 ? to : ""});
  }

  /// Sets, and nodes that loads and supports name by number.
  void make_node_groups() {
    static const std::set<std::string> by_number{"BOUNDARY", "CLOAD", "INITIAL CONDITIONS"};
    for (const auto& [name, nodes] : node_sets_.all()) add_nodes(name, nodes);
    for (const Statement& s : statements_.list) {
      for (const char* const name : {"REF NODE", "ROT NODE"})
        if (const std::string* node = s.keyword->parameter(name)) add_node(s, *node);
      if (s.keyword->name == "EQUATION") add_nodes_of_equations(s);
      if (by_number.count(s.keyword->name) == 0) continue;
      for (DeckCursor at(*s.keyword); at.next_line();) add_node(s, at.field());
    }
  }

  /// The number of terms on a line of its own; then node, degree of freedom and coefficient of each, four on a line.
  void add_nodes_of_equations(const Statement& s) {
    std::int64_t left = 0;
    for (DeckCursor at(*s.keyword); at.next_line();) {
      if (left <= 0) {
        left = at.integer("the number of terms");
        continue;
      }
      for (; left > 0 && !at.at_end(); --left) {
        const std::string_view node = at.field();
        if (node.empty()) break;
        add_node(s, node);
        at.field();
        at.field();
      }
    }
  }

  void add_node(const Statement& s, std::string_view number) {
    const std::string key = scope(s).prefix + deck_name(number);
    if (names_.node_sets.count(key) != 0) return;
    const std::vector<Index>* nodes = node_sets_.entries(key, 0, statements_);
    if (nodes != nullptr && nodes->size() == 1) add_nodes(key, *nodes);
  }

  void add_nodes(const std::string& name, const std::vector<Index>& nodes) {
    const auto cells = mesh_.cell_groups.find(name);
    const bool has_masses = names_.masses.count(name) + names_.inertias.count(name) != 0;
    std::string group = name;
    if (has_masses || (cells != mesh_.cell_groups.end() && !are_nodes_of(nodes, cells->second))) group += " (nodes)";
    names_.node_sets[name] = group;
    mesh_.node_groups[group] = nodes;
  }

  bool are_nodes_of(std::vector<Index> nodes, const std::vector<CellRef>& cells) const {
    std::vector<Index> own;
    for (const CellRef& cell : cells) {
      const auto more = mesh_.blocks[at(cell.block)].nodes(cell.cell);
      own.insert(own.end(), more.begin(), more.end());
    }
    for (std::vector<Index>* list : {&nodes, &own}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    return nodes == own;
  }

  /// "EALL, P3" in *DLOAD loads the third face of each element.
  void make_loaded_faces(const Statement& s) {
    for (DeckCursor at(*s.keyword); at.next_line();) {
      DeckCursor peek = at;
      const std::string set = deck_name(peek.field()), label = upper_case(peek.field());
      if (label == "GRAV") group_element(at, s, set);
      if (label.size() != 2 || label[0] != 'P' || label[1] < '1' || label[1] > '6') continue;
      const std::string key = scope(s).prefix + set + " " + label;
      if (names_.loaded_faces.count(key) != 0) continue;
      const std::vector<Index>& elements = elements_named(at, s.scope);
      names_.loaded_faces[key] = key;
      faces_.append(elements, fmt::format("S{}", label.substr(1)), at, mesh_.cell_groups[key], next_number_);
    }
  }

  /// An element that a load names by its number is a set.
  void group_element(DeckCursor at, const Statement& s, const std::string& number) {
    if (!as_integer(number) || !key_of(names_.element_sets, scope(s), number).empty()) return;
    const DeckElement& element = elements_[carom::at(elements_named(at, s.scope).front())];
    const std::string key = scope(s).prefix + number;
    if (element.type->kind == DeckElementType::Kind::unknown) names_.element_sets[key];
    if (element.type->kind != DeckElementType::Kind::cell) return;
    names_.element_sets[key] = {{key + " (element)", element.type}};
    mesh_.cell_groups[key + " (element)"] = {element.cell};
  }

  /// General contact meets rigid bodies by a group of all outer faces of the bodies that deform, and by their own faces
  /// on the side where those bodies are.
  void make_general_contact() {
    const auto is_general = [](const Statement& s) {
      return s.keyword->name == "CONTACT INCLUSIONS" && s.keyword->has("ALL EXTERIOR");
    };
    const auto general = std::find_if(statements_.list.begin(), statements_.list.end(), is_general);
    if (general == statements_.list.end()) return;
    const DeckCursor at(*general->keyword);
    for (const Statement& s : statements_.list) {
      const std::string* set = s.keyword->name == "RIGID BODY" ? s.keyword->parameter("ELSET") : nullptr;
      if (set != nullptr) add_rigid_side(s, *set, at);
      if (s.keyword->name == "RIGID BODY") needs_exterior_ = true;
    }
    if (!needs_exterior_) return;
    std::vector<Index> bodies;
    for (std::size_t e = 0; e < elements_.size(); ++e)
      if (deforms(elements_[e]) && elements_[e].type->section != "bar") bodies.push_back(static_cast<Index>(e));
    names_.surfaces[all_exterior] = {all_exterior, DeckNames::SurfaceKind::faces, all_exterior};
    faces_.append(bodies, "", at, surface_cells_[all_exterior], next_number_);
  }

  /// Abaqus' explicit program takes both sides of rigid faces in space where none is named.
  bool are_rigid(const std::vector<Index>& elements) const {
    return std::ranges::all_of(elements, [&](Index e) { return elements_[at(e)].type->name.starts_with("R3D"); });
  }

  void add_rigid_side(const Statement& s, const std::string& set, const DeckCursor& at) {
    const std::vector<Index>* found = element_sets_.entries(set, s.scope, statements_);
    if (found == nullptr || found->empty()) return;
    const std::vector<Index> elements = *found;
    const bool are_faces = std::all_of(elements.begin(), elements.end(), [&](Index e) {
      const DeckElement& element = elements_[carom::at(e)];
      return element.type->kind == DeckElementType::Kind::cell && !deforms(element);
    });
    if (!are_faces) return;
    const std::string key = rigid_side_of(scope(s), set);
    names_.surfaces[key] = {key, DeckNames::SurfaceKind::faces, key};
    faces_.append(elements, faces_.looks_at_bodies(elements) ? "SPOS" : "SNEG", at, surface_cells_[key], next_number_);
  }

  void name_surfaces() {
    for (auto& [name, surface] : names_.surfaces) {
      if (mesh_.has_group(name)) surface.group = name + " (surface)";
      surface.faces = surface.group;
      if (surface.kind == DeckNames::SurfaceKind::faces) {
        mesh_.cell_groups[surface.group] = surface_cells_[name];
        continue;
      }
      mesh_.node_groups[surface.group] = surface_nodes_[name];
      // Bars touch with their sides, which are no faces.
      if (faces_.bars_alone_between(surface_nodes_[name])) continue;
      const std::vector<CellRef> faces = faces_.between(surface_nodes_[name], next_number_);
      surface.faces = faces.empty() && !has_unknown_ ? "" : name + " (faces)";
      if (!faces.empty()) mesh_.cell_groups[surface.faces] = faces;
    }
  }

  void note_others() {
    std::set<std::string> others;
    for (const Statement& s : statements_.list) {
      const KeywordEntry* entry = find_keyword(s.keyword->name);
      if (entry == nullptr || entry->use != KeywordUse::mesh) others.insert("*" + s.keyword->name);
    }
    if (!others.empty())
      mesh_.report.notes.push_back(fmt::format("keywords that are no mesh: {}", fmt::join(others, ", ")));
  }

  static constexpr std::size_t at_most = std::numeric_limits<Index>::max();

  const Statements& statements_;
  CaseErrors& errors_;
  bool is_whole_ = true;
  bool needs_exterior_ = false;  ///< general contact with rigid bodies
  bool has_unknown_ = false;     ///< elements of no known type
  Mesh mesh_;
  DeckNames names_;
  std::vector<DeckNote> notes_;
  std::vector<DeckCells> read_;
  DeckSets node_sets_{"node", "NSET"}, element_sets_{"element", "ELSET"};
  std::vector<DeckElement> elements_;
  DeckFaces faces_;
  DeckGenerator generator_;
  std::map<std::string, std::vector<CellRef>> surface_cells_;
  std::map<std::string, std::vector<Index>> surface_nodes_;
  std::int64_t node_offset_ = 0, element_offset_ = 0, highest_node_ = 0, highest_element_ = 0, next_number_ = 0;
};

}  // namespace

std::string rigid_side_of(const DeckScope& scope, const std::string& set) {
  return scope.prefix + upper_case(set) + " (rigid)";
}

DeckMesh deck_mesh(const Statements& statements, const std::string& source) {
  CaseErrors errors;
  DeckMesh made = deck_mesh(statements, source, errors);
  errors.check();
  return made;
}

DeckMesh deck_mesh(const Statements& statements, const std::string& source, CaseErrors& errors) {
  return DeckMeshReader(statements, source, errors).run();
}

Mesh read_deck_mesh(std::string bytes, const std::string& source, const IncludeReader& include) {
  const Deck deck = read_deck(std::move(bytes), source, include);
  return finished(deck_mesh(statements_of(deck), source).mesh);
}

}  // namespace carom
