#include "run/build_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "casefile/document.hpp"
#include "model/node_lengths.hpp"
#include "run/attached.hpp"
#include "run/build_mesh.hpp"
#include "run/groups.hpp"
#include "run/initial_velocities.hpp"
#include "run/parts.hpp"
#include "run/redundant_contacts.hpp"
#include "run/rigid_bodies.hpp"
#include "run/unused_cells.hpp"

namespace carom {

namespace {

class ModelBuilder {
 public:
  ModelBuilder(const Case& given, const Mesh& mesh, Model& model)
      : case_(given), mesh_(mesh), groups_(mesh), parts_(given, mesh, groups_), model_(model) {}

  void build() {
    model_.parts = parts_.parts();
    model_.node_lengths = node_lengths(model_);
    model_.outer_facets = groups_.outer_facets();
    model_.motions = parts_.held();
    add_attached(case_, mesh_, groups_, parts_, static_cast<Index>(given_nodes(case_, mesh_)), model_);
    for (std::size_t i = 0; i < case_.supports.size(); ++i) add_support(case_.supports[i], i);
    for (const CaseLoad& load : case_.loads) add_load(load);
    for (const CaseInitial& initial : case_.initial) add_initial(initial, 0);
    for (std::size_t i = 0; i < case_.stages.size(); ++i)
      for (const CaseInitial& initial : case_.stages[i].initial) add_initial(initial, i + 1);
    for (const CaseContact& contact : case_.contacts) add_contact(contact);
    refuse_unused_cells(case_, mesh_, parts_);
    refuse_redundant_contacts(case_, model_);
    refuse_faces_of_parts(case_, model_);
  }

 private:
  TimeFunction function(const std::optional<Located<std::string>>& name, double amplitude) const {
    if (!name) return {{0.0}, {amplitude}};
    const auto found = std::find_if(case_.functions.begin(), case_.functions.end(),
                                    [&](const CaseFunction& f) { return f.name == **name; });
    if (found->is_called && !found->function.called) {
      throw CaseError(found->where, join("functions", found->name), "a function that a program computes",
                      "a table or a step",
                      "The program that gave it can run this case, and go on with it from its own snapshots.");
    }
    TimeFunction scaled = found->function;
    for (double& value : scaled.value) value *= amplitude;
    return scaled;
  }

  void add_support(const CaseSupport& given, std::size_t index) {
    const std::vector<Index> nodes = groups_.nodes(given.nodes, "support.nodes");
    const std::string label = fmt::format("support[{}] on {} (line {})", index, *given.nodes, given.where.line);
    std::array<bool, 3> blocked = given.blocked;
    if (given.symmetry) blocked[static_cast<std::size_t>((**given.symmetry)[0] - 'x')] = true;
    for (int c = 0; c < 3; ++c) {
      if (blocked[static_cast<std::size_t>(c)]) {
        // No velocity rather than no displacement: nodes stay where [[initial]] has put them.
        model_.motions.push_back({label, nodes, c, MotionKind::velocity, {{0.0}, {0.0}}});
      }
    }
    for (const CaseSupport::Motion& motion : given.motions) {
      model_.motions.push_back(
          {label, nodes, motion.component, motion.kind, function(motion.function, *motion.amplitude)});
    }
  }

  void add_load(const CaseLoad& given) {
    switch (given.kind) {
      case CaseLoad::Kind::force: {
        const std::vector<Index> nodes = groups_.nodes(*given.group, "load.group");
        for (const Index n : nodes) refuse_outside_parts(n, *given.group);
        model_.loads.emplace_back(NodalForce{nodes, given.vector, function(given.function, 1.0)});
        break;
      }
      case CaseLoad::Kind::pressure: {
        const Surface loaded = surface(*given.group, "load.group");
        for (const Facet& facet : loaded.facets)
          std::for_each(facet.begin(), facet.end(), [&](Index n) { refuse_outside_parts(n, *given.group); });
        model_.loads.emplace_back(Pressure{loaded, given.pressure, function(given.function, 1.0)});
        break;
      }
      case CaseLoad::Kind::gravity:
        model_.loads.emplace_back(Gravity{given.vector, function(given.function, 1.0)});
        break;
    }
  }

  Surface surface(const Located<std::string>& group, const std::string& key) const {
    return parts_.surface(groups_.outer_facets(group, key), group.where, key);
  }

  /// The surface of a contact. Bars have none but their ends: what meets the nodes between them would pass.
  Surface touching_surface(const CaseContact& given, const Located<std::string>& group, const std::string& key) const {
    const Surface touching = surface(group, key);
    const std::vector<Index> nodes = groups_.nodes(group, key);
    const std::vector<Facet>& facets = touching.facets;
    if (facets.empty() || facets[0].size != 1 || nodes.size() <= facets.size()) return touching;
    const bool is_obstacle = *given.kind != CaseContact::Kind::pair && *given.kind != CaseContact::Kind::self;
    throw CaseError(
        group.where, key,
        fmt::format("{} nodes of \"{}\", of which {} are ends of bars", nodes.size(), *group, facets.size()),
        "ends of bars alone: only they have an area, and what meets the nodes between them passes",
        is_obstacle ? "measure = \"node\" (with a stiffness of force per length) takes all nodes; or name the "
                      "nodes of the ends."
                    : "Name the nodes of the ends; bars cannot touch with their sides.");
  }

  /// A force on a node that no part holds would move nothing.
  void refuse_outside_parts(Index node, const Located<std::string>& group) const {
    if (parts_.hold(node) || has_point_mass(model_, node)) return;
    throw CaseError(group.where, "load.group",
                    fmt::format("node {} of \"{}\", which belongs to no part",
                                mesh_.node_numbers[static_cast<std::size_t>(node)], *group),
                    "nodes or faces of parts");
  }

  void add_initial(const CaseInitial& given, std::size_t stage) {
    InitialState initial;
    initial.stage = stage;
    if (given.nodes) {
      initial.nodes = groups_.nodes(*given.nodes, "initial.nodes");
    } else {
      const auto part =
          std::find_if(model_.parts.begin(), model_.parts.end(), [&](const Part& p) { return p.name == **given.part; });
      initial.nodes = parts_.nodes_of(*part);
    }
    if (given.displacement) initial.displacement = {*given.displacement};
    initial.velocity = initial_velocities(given, mesh_, initial.nodes);
    model_.initial.push_back(std::move(initial));
  }

  void add_contact(const CaseContact& given) {
    using Kind = CaseContact::Kind;
    switch (*given.kind) {
      case Kind::interface:
        model_.contacts.emplace_back(InterfaceContact{*given.name, interface_cells(given), law(given), initial(given)});
        break;
      case Kind::pair:
      case Kind::self:
      case Kind::all:
        add_pair(given);
        break;
      case Kind::tie:
        add_tie(given);
        break;
      case Kind::stop:
        model_.contacts.emplace_back(StopContact{*given.name, groups_.nodes(given.group, "contact.group"),
                                                 *given.normal, given.gap, **given.stiffness, given.damping,
                                                 given.damper});
        break;
      default:
        add_obstacle(given);
    }
  }

  static ContactLaw law(const CaseContact& given) {
    ContactLaw law;
    if (given.stiffness) law.eps_N = **given.stiffness;
    law.eps_T = given.tangential_stiffness;
    law.stiffness_factor = given.stiffness_factor;
    law.mu = given.friction;
    law.restitution = *given.restitution;
    return law;
  }

  static InitialPenetration initial(const CaseContact& given) {
    return given.initial_penetration.value_or(InitialPenetration::prestress);
  }

  void add_tie(const CaseContact& given) {
    refuse_itself(given, "What is one surface needs no tie.");
    TieContact tie;
    tie.name = *given.name;
    tie.slave = surface(given.group, "contact.group");
    tie.master = surface(given.master, "contact.master");
    tie.method = given.tie_method;
    tie.tolerance = given.tolerance;
    tie.distance = given.distance;
    tie.far = given.far;
    tie.law = law(given);
    model_.contacts.emplace_back(std::move(tie));
  }

  static void refuse_itself(const CaseContact& given, const std::string& remedy) {
    if (*given.group == *given.master)
      throw CaseError(given.master.where, "contact.master",
                      fmt::format("\"{}\", which is the group as well", *given.master), "the faces of another body",
                      remedy);
  }

  void add_pair(const CaseContact& given) {
    if (*given.kind == CaseContact::Kind::pair) refuse_itself(given, "One surface with itself is kind = \"self\".");
    PairContact pair;
    pair.name = *given.name;
    pair.method = **given.method;
    pair.law = law(given);
    pair.initial = initial(given);
    pair.self = *given.kind != CaseContact::Kind::pair;
    if (*given.kind == CaseContact::Kind::all) {
      std::vector<OuterFacet> facets = groups_.exterior(given.exclude, "contact.exclude");
      std::erase_if(facets, [&](const OuterFacet& outer) { return parts_.part_of(outer.cell) == nullptr; });
      pair.slave = parts_.surface(facets, given.where, "contact");
    } else {
      pair.slave = touching_surface(given, given.group, "contact.group");
    }
    pair.master = pair.self ? pair.slave : touching_surface(given, given.master, "contact.master");
    model_.contacts.emplace_back(std::move(pair));
  }

  RigidShape shape(const CaseContact& given) const {
    switch (*given.kind) {
      case CaseContact::Kind::sphere:
        return Sphere{given.centre, given.radius, given.inside};
      case CaseContact::Kind::cylinder:
        return Cylinder{given.point, *given.axis, given.radius, given.inside};
      case CaseContact::Kind::box:
        return Box{given.lower, *given.upper};
      case CaseContact::Kind::surface:
        return RigidSurface{{groups_.rigid_faces(given.surface, "contact.surface")}};
      default:
        return Plane{given.point, *given.normal};
    }
  }

  void add_obstacle(const CaseContact& given) {
    ObstacleContact obstacle;
    obstacle.name = *given.name;
    obstacle.shape = shape(given);
    obstacle.law = law(given);
    obstacle.initial = initial(given);
    if (given.per_node) {
      obstacle.measure = RowMeasure::per_node;
      obstacle.nodes = groups_.nodes(given.group, "contact.group");
    } else {
      obstacle.surface = touching_surface(given, given.group, "contact.group");
    }
    add_carrier(given, obstacle);
    model_.contacts.emplace_back(std::move(obstacle));
  }

  /// A moving obstacle hangs on the nodes that build_mesh has appended for it.
  void add_carrier(const CaseContact& given, ObstacleContact& obstacle) {
    const std::size_t nodes = carrier_nodes(given);
    if (nodes == 0) return;
    const auto first = static_cast<Index>(mesh_.node_count() - carrier_nodes(case_) + carriers_);
    carriers_ += nodes;
    if (given.mass) {
      add_free_body(given, first, obstacle, model_);
      return;
    }
    obstacle.carrier = first;
    const std::vector<Index> node{first};
    const Vec3 velocity = *given.velocity;
    model_.initial.push_back({node, {}, {velocity}});
    const std::string label = fmt::format("velocity of contact \"{}\" (line {})", *given.name, given.where.line);
    for (std::size_t c = 0; c < 3; ++c)
      model_.motions.push_back(
          {label, node, static_cast<int>(c), MotionKind::velocity, function(given.function, velocity[c])});
  }

  std::vector<Index> interface_cells(const CaseContact& given) const {
    const std::vector<Index> cells =
        groups_.cells(given.group, "contact.group", std::array{CellType::hexa8}, "HEXA8 cells").cells;
    const auto block = static_cast<Index>(mesh_.block(CellType::hexa8) - mesh_.blocks.data());
    for (const Index cell : cells) {
      const Part* part = parts_.part_of({block, cell});
      if (part == nullptr) continue;
      throw CaseError(given.group.where, "contact.group",
                      fmt::format("cell {} of \"{}\", which belongs to part \"{}\"",
                                  mesh_.block(CellType::hexa8)->file_numbers[static_cast<std::size_t>(cell)],
                                  *given.group, part->name),
                      "interface cells that belong to no part");
    }
    return cells;
  }

  const Case& case_;
  const Mesh& mesh_;
  Groups groups_;
  Parts parts_;
  Model& model_;
  std::size_t carriers_ = 0;  ///< nodes of moving obstacles given away so far
};

}  // namespace

Model build_model(const Case& given, std::shared_ptr<const Mesh> mesh) {
  Model model;
  model.mesh = std::move(mesh);
  ModelBuilder(given, *model.mesh, model).build();
  return model;
}

}  // namespace carom
