#include "run/build_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "run/groups.hpp"

namespace carom {

namespace {

class Builder {
 public:
  Builder(const Case& given, const Mesh& mesh, Model& model)
      : case_(given), mesh_(mesh), groups_(mesh), model_(model), is_in_part_(mesh.node_count(), false) {}

  void build() {
    for (const CasePart& part : case_.parts) add_part(part);
    for (std::size_t i = 0; i < case_.supports.size(); ++i) add_support(case_.supports[i], i);
    for (const CaseLoad& load : case_.loads) add_load(load);
    for (const CaseInitial& initial : case_.initial) add_initial(initial);
    for (const CaseContact& contact : case_.contacts) add_contact(contact);
  }

 private:
  void add_part(const CasePart& given) {
    const auto material = std::find_if(case_.materials.begin(), case_.materials.end(),
                                       [&](const CaseMaterial& m) { return m.name == *given.material; });
    Part part{*given.name, groups_.hexas(given.cells, "part.cells"),
              LinearElastic{*material->E, *material->nu, *material->rho}};
    for (const Index cell : part.cells) {
      const auto [entry, is_new] = part_of_.emplace(cell, *given.name);
      if (is_new) {
        for (std::size_t a = 0; a < 8; ++a) {
          const Index n = mesh_.block(CellType::hexa8)->connectivity[8 * static_cast<std::size_t>(cell) + a];
          is_in_part_[static_cast<std::size_t>(n)] = true;
        }
        continue;
      }
      throw CaseError(given.cells.where, "part.cells",
                      fmt::format("cell {} in part \"{}\" and in part \"{}\"",
                                  mesh_.block(CellType::hexa8)->file_numbers[static_cast<std::size_t>(cell)],
                                  entry->second, *given.name),
                      "every cell in one part only");
    }
    model_.parts.push_back(std::move(part));
  }

  TimeFunction function(const std::optional<Located<std::string>>& name, double amplitude) const {
    if (!name) return {{0.0}, {amplitude}};
    const auto found = std::find_if(case_.functions.begin(), case_.functions.end(),
                                    [&](const CaseFunction& f) { return f.name == **name; });
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
      static constexpr MotionKind kinds[] = {MotionKind::displacement, MotionKind::velocity, MotionKind::acceleration};
      model_.motions.push_back({label, nodes, motion.component, kinds[static_cast<int>(motion.kind)],
                                function(motion.function, *motion.amplitude)});
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
        const std::vector<std::array<Index, 4>> faces = groups_.outer_faces(*given.group, "load.group");
        for (const auto& face : faces)
          std::for_each(face.begin(), face.end(), [&](Index n) { refuse_outside_parts(n, *given.group); });
        model_.loads.emplace_back(Pressure{faces, given.pressure, function(given.function, 1.0)});
        break;
      }
      case CaseLoad::Kind::gravity:
        model_.loads.emplace_back(Gravity{given.vector, function(given.function, 1.0)});
        break;
    }
  }

  /// A force on a node that no part holds would move nothing.
  void refuse_outside_parts(Index node, const Located<std::string>& group) const {
    if (is_in_part_[static_cast<std::size_t>(node)]) return;
    throw CaseError(group.where, "load.group",
                    fmt::format("node {} of \"{}\", which belongs to no part",
                                mesh_.node_numbers[static_cast<std::size_t>(node)], *group),
                    "nodes or faces of parts");
  }

  void add_initial(const CaseInitial& given) {
    InitialState initial;
    if (given.nodes) {
      initial.nodes = groups_.nodes(*given.nodes, "initial.nodes");
    } else {
      const auto part =
          std::find_if(model_.parts.begin(), model_.parts.end(), [&](const Part& p) { return p.name == **given.part; });
      const std::vector<Index>& connectivity = mesh_.block(CellType::hexa8)->connectivity;
      for (const Index cell : part->cells) {
        for (std::size_t a = 0; a < 8; ++a)
          initial.nodes.push_back(connectivity[8 * static_cast<std::size_t>(cell) + a]);
      }
      std::sort(initial.nodes.begin(), initial.nodes.end());
      initial.nodes.erase(std::unique(initial.nodes.begin(), initial.nodes.end()), initial.nodes.end());
    }
    initial.displacement = given.displacement;
    initial.velocity = given.velocity;
    model_.initial.push_back(std::move(initial));
  }

  void add_contact(const CaseContact& given) {
    const FrictionLaw friction{given.tangential_stiffness, given.friction};
    switch (given.kind) {
      case CaseContact::Kind::interface:
        model_.contacts.emplace_back(InterfaceContact{*given.name, interface_cells(given), *given.stiffness, friction});
        break;
      case CaseContact::Kind::plane: {
        PlaneContact plane{*given.name, given.point, *given.normal,    PenaltyMeasure::per_area,
                           {},          {},          *given.stiffness, friction};
        if (given.per_node) {
          plane.measure = PenaltyMeasure::per_node;
          plane.nodes = groups_.nodes(given.group, "contact.group");
        } else {
          plane.faces = groups_.outer_faces(given.group, "contact.group");
        }
        model_.contacts.emplace_back(std::move(plane));
        break;
      }
      case CaseContact::Kind::stop:
        model_.contacts.emplace_back(StopContact{*given.name, groups_.nodes(given.group, "contact.group"),
                                                 *given.normal, given.gap, *given.stiffness, given.damping});
        break;
    }
  }

  std::vector<Index> interface_cells(const CaseContact& given) const {
    std::vector<Index> cells = groups_.hexas(given.group, "contact.group");
    for (const Index cell : cells) {
      const auto part = part_of_.find(cell);
      if (part == part_of_.end()) continue;
      throw CaseError(given.group.where, "contact.group",
                      fmt::format("cell {} of \"{}\", which belongs to part \"{}\"",
                                  mesh_.block(CellType::hexa8)->file_numbers[static_cast<std::size_t>(cell)],
                                  *given.group, part->second),
                      "interface cells that belong to no part");
    }
    return cells;
  }

  const Case& case_;
  const Mesh& mesh_;
  Groups groups_;
  Model& model_;
  std::map<Index, std::string> part_of_;
  std::vector<bool> is_in_part_;  ///< per node
};

}  // namespace

Model build_model(const Case& given, std::shared_ptr<const Mesh> mesh) {
  Model model;
  model.mesh = std::move(mesh);
  Builder(given, *model.mesh, model).build();
  return model;
}

}  // namespace carom
