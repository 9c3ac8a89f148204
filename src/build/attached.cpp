#include "build/attached.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr const char *mass_nodes = "point_mass.nodes", *spring_nodes = "spring.nodes", *spring_to = "spring.to";

class Attachment {
 public:
  Attachment(const Mesh& mesh, const Groups& groups, Model& model) : mesh_(mesh), groups_(groups), model_(model) {}

  void add(const CasePointMass& given) {
    PointMass point{groups_.nodes(given.nodes, mass_nodes), 0.0};
    point.mass = given.mass ? *given.mass : *given.total / static_cast<double>(point.nodes.size());
    model_.point_masses.push_back(std::move(point));
  }

  /// Springs to the ground take their other ends from `ground` on, which moves behind them.
  void add(const CaseSpring& given, const Parts& parts, Index& ground) {
    const std::vector<Index> nodes = groups_.nodes(given.nodes, spring_nodes);
    refuse_without_mass(nodes, parts, given.nodes, spring_nodes);
    if (given.axial) {
      const std::vector<Index> to = groups_.nodes(*given.to, spring_to);
      refuse_without_mass(to, parts, *given.to, spring_to);
      add_between(given, nodes, to);
      return;
    }
    const Vec3 k =
        given.stiffness ? **given.stiffness : scaled(**given.total_stiffness, 1.0 / static_cast<double>(nodes.size()));
    std::vector<Index> ends;
    for (const Index node : nodes) {
      model_.springs.push_back({{node, ground}, {Vec3{k[0], 0.0, 0.0}, {0.0, k[1], 0.0}, {0.0, 0.0, k[2]}}});
      ends.push_back(ground++);
    }
    for (int c = 0; c < 3; ++c)
      model_.motions.push_back({fmt::format("the ground of a spring (line {})", given.where.line),
                                ends,
                                c,
                                MotionKind::velocity,
                                {{0.0}, {0.0}}});
  }

 private:
  const Vec3& X(Index node) const { return mesh_.coordinates[static_cast<std::size_t>(node)]; }
  std::string number(Index node) const { return mesh_.node_label(node); }

  void refuse_without_mass(const std::vector<Index>& nodes, const Parts& parts, const Located<std::string>& group,
                           const char* key) const {
    for (const Index node : nodes) {
      if (parts.hold(node) || has_point_mass(model_, node)) continue;
      throw CaseError(group.where, key,
                      fmt::format("node {} of \"{}\", which belongs to no part", number(node), *group),
                      "nodes of parts, or nodes with a [[point_mass]]");
    }
  }

  Index nearest_of(const std::vector<Index>& to, Index node) const {
    return *std::min_element(to.begin(), to.end(), [&](Index a, Index b) {
      return norm(subtract(X(a), X(node))) < norm(subtract(X(b), X(node)));
    });
  }

  void add_between(const CaseSpring& given, const std::vector<Index>& nodes, const std::vector<Index>& to) {
    if (to.size() != 1 && to.size() != nodes.size()) {
      throw CaseError(
          given.to->where, spring_to,
          fmt::format("{} nodes in \"{}\" against {} in \"{}\"", to.size(), **given.to, nodes.size(), *given.nodes),
          "one node, or as many as `nodes` has");
    }
    std::set<Index> taken;
    for (const Index node : nodes) {
      const Index other = nearest_of(to, node);
      if (to.size() > 1 && !taken.insert(other).second) {
        throw CaseError(given.to->where, spring_to,
                        fmt::format("node {} of \"{}\", which is the nearest to two nodes of \"{}\", {} being one",
                                    number(other), **given.to, *given.nodes, number(node)),
                        "groups whose nodes lie opposite each other", "Give each pair a [[spring]] of its own.");
      }
      const Vec3 along = subtract(X(other), X(node));
      const double length = norm(along);
      if (!(length > 0.0)) {
        throw CaseError(given.to->where, spring_to,
                        fmt::format("nodes {} and {} at one place", number(node), number(other)),
                        "ends that are apart, since the spring acts along their line");
      }
      const Vec3 n = scaled(along, 1.0 / length);
      model_.springs.push_back(
          {{node, other},
           {scaled(n, *given.axial * n[0]), scaled(n, *given.axial * n[1]), scaled(n, *given.axial * n[2])}});
    }
  }

  const Mesh& mesh_;
  const Groups& groups_;
  Model& model_;
};

}  // namespace

std::vector<Vec3> ground_positions(const Case& given, const Mesh& mesh) {
  const Groups groups(mesh);
  std::vector<Vec3> positions;
  for (const CaseSpring& spring : given.springs) {
    if (spring.axial) continue;
    for (const Index node : groups.nodes(spring.nodes, spring_nodes))
      positions.push_back(mesh.coordinates[static_cast<std::size_t>(node)]);
  }
  return positions;
}

std::vector<AttachedGroup> attached_groups(const Case& given) {
  std::vector<AttachedGroup> groups;
  for (const CasePointMass& mass : given.point_masses)
    groups.push_back({mass.nodes, mass_nodes, "a point mass", "Give the body its mass and inertia instead."});
  for (const CaseSpring& spring : given.springs) {
    const char* remedy = "Join a group of deformable cells to the body, and let the spring act on them.";
    groups.push_back({spring.nodes, spring_nodes, "a spring", remedy});
    if (spring.to) groups.push_back({*spring.to, spring_to, "a spring", remedy});
  }
  return groups;
}

bool has_point_mass(const Model& model, Index node) {
  return std::any_of(model.point_masses.begin(), model.point_masses.end(), [&](const PointMass& point) {
    return std::binary_search(point.nodes.begin(), point.nodes.end(), node);
  });
}

void add_attached(const Case& given, const Mesh& mesh, const Groups& groups, const Parts& parts, Index ground,
                  Model& model) {
  Attachment attachment(mesh, groups, model);
  for (const CasePointMass& point : given.point_masses) attachment.add(point);
  for (const CaseSpring& spring : given.springs) attachment.add(spring, parts, ground);
}

}  // namespace carom
