#include "build/build_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <set>
#include <stdexcept>
#include <utility>

#include "build/attached.hpp"
#include "build/build_mesh.hpp"
#include "build/equations.hpp"
#include "build/eroding_parts.hpp"
#include "build/group_names.hpp"
#include "build/groups.hpp"
#include "build/initial_velocities.hpp"
#include "build/parts.hpp"
#include "build/redundant_contacts.hpp"
#include "build/rigid_bodies.hpp"
#include "build/rigid_parts.hpp"
#include "build/touching_bars.hpp"
#include "build/unused_cells.hpp"
#include "casefile/document.hpp"
#include "contact/tie_rows.hpp"
#include "math/vec3.hpp"
#include "model/node_lengths.hpp"
#include "solid/loads.hpp"

namespace carom {

namespace {

class ModelBuilder {
 public:
  ModelBuilder(const Case& given, const Mesh& mesh, Model& model)
      : case_(given),
        mesh_(mesh),
        groups_(mesh),
        parts_(given, mesh, groups_),
        rigid_(given, mesh, groups_, parts_),
        model_(model) {}

  void build() {
    model_.parts = parts_.parts();
    model_.notes = parts_.notes();
    note_turned_cells();
    model_.node_lengths = node_lengths(model_);
    model_.outer_facets = groups_.outer_facets();
    model_.motions = parts_.held();
    rigid_.add_to(model_, static_cast<Index>(mesh_.node_count() - carrier_nodes(case_) - rigid_nodes(case_)));
    add_attached(case_, mesh_, groups_, parts_, static_cast<Index>(given_nodes(case_, mesh_)), model_);
    CaseErrors errors;
    for (std::size_t i = 0; i < case_.supports.size(); ++i) errors.attempt([&] { add_support(case_.supports[i], i); });
    errors.attempt([&] { add_equations(case_, mesh_, groups_, parts_, model_); });
    for (const CaseLoad& load : case_.loads) errors.attempt([&] { add_load(load); });
    for (const CaseInitial& initial : case_.initial) errors.attempt([&] { add_initial(initial, 0); });
    for (std::size_t i = 0; i < case_.stages.size(); ++i)
      for (const CaseInitial& initial : case_.stages[i].initial) errors.attempt([&] { add_initial(initial, i + 1); });
    for (std::size_t i = 0; i <= case_.stages.size(); ++i) errors.attempt([&] { rigid_.carry(model_.initial, i); });
    for (const CaseContact& contact : case_.contacts) errors.attempt([&] { add_contact(contact); });
    errors.attempt([&] { refuse_unused_cells(case_, mesh_, parts_); });
    errors.attempt([&] { rigid_.refuse_torn(model_); });
    errors.attempt([&] { rigid_.refuse_rigid_contacts(model_); });
    errors.check();
    leave_tied_faces();
    for (const CaseErosion& erosion : case_.erosion) errors.attempt([&] { add_erosion(erosion, model_); });
    errors.check();
    refuse_redundant_contacts(case_, model_);
    refuse_faces_of_parts(case_, model_);
  }

 private:
  /// The reader mends cells that other programs refuse.
  void note_turned_cells() {
    const MeshReport& report = mesh_.report;
    if (report.turned > 0)
      model_.notes.push_back(
          fmt::format("mesh: {} inside out by the order of {} nodes, which has been turned: cell {}{}",
                      report.turned == 1 ? "1 cell was" : fmt::format("{} cells were", report.turned),
                      report.turned == 1 ? "its" : "their", mesh_.cell_label(report.first_turned),
                      report.turned == 1 ? "" : " and others"));
  }

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
    const std::vector<Index> nodes =
        rigid_.carried(groups_.nodes(given.nodes, "support.nodes"), given.nodes, "support.nodes");
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
      case CaseLoad::Kind::total_force:
        add_total_force(given);
        break;
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

  void add_total_force(const CaseLoad& given) {
    const std::vector<Index> nodes = groups_.nodes(*given.group, "load.group");
    for (const Index n : nodes) refuse_outside_parts(n, *given.group);
    const std::vector<OuterFacet> faces = groups_.faces_alone(*given.group, "load.group");
    std::vector<double> shares =
        faces.empty() ? mass_shares(model_, nodes)
                      : area_shares(mesh_, parts_.surface(faces, given.group->where, "load.group"), nodes);
    if (!std::isfinite(sum_of(shares)))
      throw CaseError(given.group->where, "load.group",
                      fmt::format("\"{}\", which has no {}", **given.group, faces.empty() ? "mass" : "area"),
                      "nodes that can share a total force",
                      "On the axis faces have none: name other faces, or give the force of each node.");
    model_.notes.push_back(fmt::format("load on \"{}\": {} nodes share the total force by their {}", **given.group,
                                       nodes.size(), faces.empty() ? "masses" : "areas"));
    model_.loads.emplace_back(NodalForce{nodes, given.vector, function(given.function, 1.0), std::move(shares)});
  }

  Surface surface(const Located<std::string>& group, const std::string& key) const {
    return parts_.surface(groups_.outer_facets(group, key), group.where, key);
  }

  static constexpr const char* ends_alone =
      "Bars touch obstacles and bars with their sides, and faces with their ends alone: name the nodes of the ends.";

  /// The surface of a contact. Bars have none but their ends: what meets the nodes between them would pass.
  Surface touching_surface(const Located<std::string>& group, const std::string& key, const char* remedy) const {
    const Surface touching = surface(group, key);
    const std::vector<Index> nodes = groups_.nodes(group, key);
    const std::vector<Facet>& facets = touching.facets;
    if (facets.empty() || facets[0].size != 1 || nodes.size() <= facets.size()) return touching;
    throw CaseError(
        group.where, key,
        fmt::format("{} nodes of \"{}\", of which {} are ends of bars", nodes.size(), *group, facets.size()),
        "ends of bars alone: only they have an area, and what meets the nodes between them passes", remedy);
  }

  /// A force on a node that no part holds would move nothing.
  void refuse_outside_parts(Index node, const Located<std::string>& group) const {
    if (parts_.hold(node) || rigid_.hold(node) || has_point_mass(model_, node)) return;
    throw CaseError(group.where, "load.group",
                    fmt::format("node {} of \"{}\", which belongs to no part", mesh_.node_label(node), *group),
                    "nodes or faces of parts");
  }

  void add_initial(const CaseInitial& given, std::size_t stage) {
    InitialState initial;
    initial.stage = stage;
    if (given.nodes) {
      initial.nodes = groups_.nodes(*given.nodes, "initial.nodes");
    } else {
      initial.nodes = parts_.nodes_of(**given.part);
    }
    if (given.displacement) initial.displacement = {*given.displacement};
    initial.velocity = initial_velocities(given, mesh_, initial.nodes);
    model_.initial.push_back(std::move(initial));
  }

  void add_contact(const CaseContact& given) {
    std::visit([&](const auto& kind) { add(given, kind); }, given.of);
  }

  void add(const CaseContact& given, const CaseInterface& kind) {
    model_.contacts.emplace_back(
        InterfaceContact{*given.name, interface_cells(kind), law(kind.law), initial(kind.law)});
  }

  void add(const CaseContact& given, const CaseStop& stop) {
    model_.contacts.emplace_back(StopContact{*given.name, groups_.nodes(stop.group, "contact.group"), *stop.normal,
                                             stop.gap, stop.stiffness, stop.damping, stop.damper});
  }

  static ContactLaw law(const CaseStiffness& given) {
    ContactLaw law;
    if (given.stiffness) law.eps_N = **given.stiffness;
    law.stiffness_factor = given.stiffness_factor;
    return law;
  }
  static ContactLaw law(const CaseContactLaw& given) {
    ContactLaw law = ModelBuilder::law(static_cast<const CaseStiffness&>(given));
    law.eps_T = given.tangential_stiffness;
    law.mu = given.friction;
    if (!given.pressures->empty()) {
      law.pressure = std::make_shared<const PressureTable>(*given.depths, *given.pressures);
      law.eps_N = law.pressure->largest_slope();
    }
    if (given.friction_law) {
      if (!given.called_friction)
        throw CaseError(given.friction_law->where, "contact.friction_law", "a law of friction that a program computes",
                        "friction, a number",
                        "The program that gave it can run this case, and go on with it from its own snapshots.");
      law.friction = given.called_friction;
      law.mu = 1.0;
    }
    law.restitution = *given.restitution;
    return law;
  }

  static InitialPenetration initial(const CaseContactLaw& given) {
    return given.initial_penetration.value_or(InitialPenetration::prestress);
  }

  void add(const CaseContact& given, const CaseTie& kind) {
    refuse_itself(kind, "What is one surface needs no tie.");
    TieContact tie;
    tie.name = *given.name;
    tie.slave = surface(kind.group, "contact.group");
    tie.master = surface(kind.master, "contact.master");
    tie.method = kind.method;
    tie.tolerance = kind.tolerance;
    tie.distance = kind.distance;
    tie.far = kind.far;
    tie.law = law(static_cast<const CaseStiffness&>(kind));
    add_held_faces(tie);
    if (kind.tears())
      add_tearing(given, kind, tie);
    else
      model_.contacts.emplace_back(std::move(tie));
  }

  /// A cohesive zone in the place of the bonds, and the pair that is left when it has torn.
  void add_tearing(const CaseContact& given, const CaseTie& kind, const TieContact& tie) {
    CohesiveZone zone;
    zone.contact = model_.contacts.size();
    zone.name = tie.name;
    zone.law = kind.tearing();
    zone.stiffness_factor = kind.stiffness_factor;
    try {
      zone.rows = cohesive_rows(model_, tie, zone.notes);
    } catch (const std::invalid_argument& e) {
      throw CaseError(given.where, "contact", e.what(), "");
    }
    model_.cohesive.push_back(std::move(zone));
    PairContact pair = pair_of(given, kind.torn);
    pair.slave = tie.slave;
    pair.master = tie.master;
    model_.contacts.emplace_back(std::move(pair));
  }

  template <class Kind>
  static void refuse_itself(const Kind& given, const std::string& remedy) {
    if (*given.group == *given.master)
      throw CaseError(given.master.where, "contact.master",
                      fmt::format("\"{}\", which is the group as well", *given.master), "the faces of another body",
                      remedy);
  }

  static PairContact pair_of(const CaseContact& given, const CaseSurfaces& surfaces) {
    PairContact pair;
    pair.name = *given.name;
    pair.method = **surfaces.method;
    pair.smooth = !surfaces.smooth ? Smoothing::round : **surfaces.smooth ? Smoothing::all : Smoothing::none;
    pair.law = law(surfaces.law);
    pair.initial = initial(surfaces.law);
    pair.self = surfaces.is_self;
    return pair;
  }

  /// One that the case gives, not the default.
  static void refuse_method_of_bars(const CaseContact& given, const CaseSurfaces& kind) {
    if (kind.method->where.line == given.where.line) return;
    throw CaseError(kind.method->where, "contact.method", "a method, for bars", "faces with a method",
                    "Bars meet where their axes are closest: remove method.");
  }

  void add(const CaseContact& given, const CasePair& kind) {
    refuse_itself(kind, "One surface with itself is kind = \"self\".");
    PairContact pair = pair_of(given, kind);
    pair.slave_bars = touching_bars(mesh_, groups_, parts_, kind.group, "contact.group", kind.bar_radius);
    pair.master_bars = touching_bars(mesh_, groups_, parts_, kind.master, "contact.master", kind.bar_radius);
    if (pair.slave_bars.empty() || pair.master_bars.empty()) {
      pair.slave_bars.clear();
      pair.master_bars.clear();
      pair.slave = touching_surface(kind.group, "contact.group", ends_alone);
      pair.master = touching_surface(kind.master, "contact.master", ends_alone);
    } else {
      refuse_method_of_bars(given, kind);
    }
    model_.contacts.emplace_back(std::move(pair));
  }

  void add(const CaseContact& given, const CaseSelf& kind) {
    PairContact pair = pair_of(given, kind);
    pair.master_bars = pair.slave_bars =
        touching_bars(mesh_, groups_, parts_, kind.group, "contact.group", kind.bar_radius);
    if (pair.slave_bars.empty())
      pair.master = pair.slave = touching_surface(kind.group, "contact.group", ends_alone);
    else
      refuse_method_of_bars(given, kind);
    model_.contacts.emplace_back(std::move(pair));
  }

  void add(const CaseContact& given, const CaseAll& kind) {
    PairContact pair = pair_of(given, kind);
    std::vector<OuterFacet> facets = groups_.exterior(kind.exclude, "contact.exclude");
    std::erase_if(facets, [&](const OuterFacet& outer) { return parts_.part_of(outer.cell) == nullptr; });
    pair.master = pair.slave = parts_.surface(facets, given.where, "contact");
    model_.contacts.emplace_back(std::move(pair));
  }

  /// Those of the slave of which the tie holds a node.
  void add_held_faces(const TieContact& tie) {
    const std::vector<Index> held = nodes_near_master(mesh_.coordinates, tie);
    const auto is_held = [&](Index n) { return std::ranges::binary_search(held, n); };
    HeldFaces& faces = held_faces_.emplace_back(HeldFaces{tie.name, {}});
    for (const Facet& facet : tie.slave.facets)
      if (std::any_of(facet.begin(), facet.end(), is_held)) faces.keys.insert(sorted(facet));
  }

  static std::array<Index, 4> sorted(const Facet& facet) {
    std::array<Index, 4> key = facet.node;
    std::ranges::sort(key);
    return key;
  }

  /// What a tie holds already takes no part in contact of all with all.
  void leave_tied_faces() {
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      if (!std::holds_alternative<CaseAll>(case_.contacts[c].of)) continue;
      auto& pair = std::get<PairContact>(model_.contacts[c]);
      for (const HeldFaces& tie : held_faces_) {
        const auto is_held = [&](const Facet& facet) { return tie.keys.contains(sorted(facet)); };
        const auto left = std::erase_if(pair.slave.facets, is_held);
        if (left == 0) continue;
        std::erase_if(pair.master.facets, is_held);
        model_.notes.push_back(
            fmt::format("contact \"{}\" leaves out {} faces that \"{}\" holds", pair.name, left, tie.tie));
      }
    }
  }

  static RigidShape shape(const CasePlane& given) { return Plane{given.point, *given.normal}; }
  static RigidShape shape(const CaseSphere& given) { return Sphere{given.centre, given.radius, given.inside}; }
  static RigidShape shape(const CaseCylinder& given) {
    return Cylinder{given.point, *given.axis, given.radius, given.inside};
  }
  static RigidShape shape(const CaseBox& given) { return Box{given.lower, *given.upper}; }
  RigidShape shape(const CaseRigidSurface& given) const {
    return RigidSurface{{groups_.rigid_faces(given.surface, "contact.surface")}};
  }

  template <std::derived_from<CaseObstacle> Kind>
  void add(const CaseContact& given, const Kind& kind) {
    ObstacleContact obstacle;
    obstacle.name = *given.name;
    obstacle.shape = shape(kind);
    obstacle.law = law(kind.law);
    obstacle.initial = initial(kind.law);
    if (kind.per_node) {
      obstacle.measure = RowMeasure::per_node;
      obstacle.nodes = groups_.nodes(kind.group, "contact.group");
    } else if (obstacle.bars = touching_bars(mesh_, groups_, parts_, kind.group, "contact.group", kind.bar_radius);
               obstacle.bars.empty()) {
      obstacle.surface = touching_surface(
          kind.group, "contact.group",
          "measure = \"node\" (with a stiffness of force per length) takes all nodes; or name the nodes of the ends.");
    }
    add_carrier(given, kind, obstacle);
    model_.contacts.emplace_back(std::move(obstacle));
  }

  /// A moving obstacle hangs on the nodes that build_mesh has appended for it.
  void add_carrier(const CaseContact& given, const CaseObstacle& kind, ObstacleContact& obstacle) {
    const std::size_t nodes = carrier_nodes(given);
    if (nodes == 0) return;
    const auto first = static_cast<Index>(mesh_.node_count() - carrier_nodes(case_) + carriers_);
    carriers_ += nodes;
    add_body(given, first, obstacle, model_);
    if (kind.body.mass) return;
    const Vec3 velocity = kind.velocity.value_or(Vec3{});
    const std::string label = fmt::format("velocity of contact \"{}\" (line {})", *given.name, given.where.line);
    for (std::size_t c = 0; c < 3; ++c) {
      const TimeFunction travel = function(kind.function, velocity[c]);
      PrescribedMotion motion{label, {first}, static_cast<int>(c), MotionKind::velocity, travel};
      if (kind.turns()) turn(kind, obstacle, travel, motion);
      model_.motions.push_back(std::move(motion));
    }
  }

  /// A motion of an obstacle that is led, which turns beside its travel.
  void turn(const CaseObstacle& kind, const ObstacleContact& obstacle, const TimeFunction& travel,
            PrescribedMotion& motion) const {
    const TurningBody& body = model_.turning_bodies[static_cast<std::size_t>(obstacle.body)];
    refuse_turning_out_of_plane(obstacle, *kind.body.angular_velocity);
    motion.nodes.assign(body.nodes.begin(), body.nodes.end());
    motion.kind = MotionKind::rotation;
    motion.function =
        function(kind.angular_function ? kind.angular_function : kind.function, norm(**kind.body.angular_velocity));
    motion.rotation = ImposedRotation{body.centre, body.axes[2], travel};
  }

  /// Plane cells move in their plane alone, and axisymmetric ones around no angle.
  void refuse_turning_out_of_plane(const ObstacleContact& obstacle, const Located<Vec3>& omega) const {
    const std::vector<Index> nodes = nodes_of(obstacle.parts(), mesh_);
    for (const Part& part : model_.parts) {
      if (dimension(part.type) != 2) continue;
      const bool is_ring = part.section == Section::axisymmetric;
      if (!is_ring && (*omega)[0] == 0.0 && (*omega)[1] == 0.0) continue;
      const std::vector<Index> of_part = parts_.nodes_of(part.name);
      const auto is_member = [&](Index n) { return std::binary_search(of_part.begin(), of_part.end(), n); };
      if (std::none_of(nodes.begin(), nodes.end(), is_member)) continue;
      throw CaseError(omega.where, "contact.angular_velocity",
                      fmt::format("[{:g}, {:g}, {:g}] beside \"{}\", which is {}", (*omega)[0], (*omega)[1],
                                  (*omega)[2], part.name, name(part.section)),
                      is_ring ? "an obstacle that does not turn" : "a rotation about z, [0, 0, w]",
                      is_ring
                          ? "What turns about the axis rubs around it, where the cells have no displacement, and what "
                            "turns otherwise is no ring: model it in three dimensions."
                          : "Plane cells have no displacement along z.");
    }
  }

  std::vector<Index> interface_cells(const CaseInterface& given) const {
    const std::vector<Index> cells =
        groups_.cells(given.group, "contact.group", std::array{CellType::hexa8}, "HEXA8 cells").at(CellType::hexa8);
    const auto block = static_cast<Index>(mesh_.block(CellType::hexa8) - mesh_.blocks.data());
    for (const Index cell : cells) {
      const Part* part = parts_.part_of({block, cell});
      if (part == nullptr) continue;
      throw CaseError(given.group.where, "contact.group",
                      fmt::format("cell {} of \"{}\", which belongs to part \"{}\"", mesh_.cell_label({block, cell}),
                                  *given.group, part->name),
                      "interface cells that belong to no part");
    }
    return cells;
  }

  const Case& case_;
  const Mesh& mesh_;
  Groups groups_;
  Parts parts_;
  RigidParts rigid_;
  Model& model_;
  struct HeldFaces {
    std::string tie;
    std::set<std::array<Index, 4>> keys;
  };
  std::vector<HeldFaces> held_faces_;
  std::size_t carriers_ = 0;  ///< nodes of moving obstacles given away so far
};

}  // namespace

Model build_model(const Case& given, std::shared_ptr<const Mesh> mesh) {
  CaseErrors errors;
  check_group_names(given, *mesh, errors);
  errors.check();
  Model model;
  model.mesh = std::move(mesh);
  ModelBuilder(given, *model.mesh, model).build();
  return model;
}

}  // namespace carom
