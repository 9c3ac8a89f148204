#include "solid/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "element/quad4.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "solid/cell_matrices.hpp"
#include "solid/element_table.hpp"
#include "solid/quadratic_faces.hpp"

namespace carom {
namespace {

/// Forces summed per node; only nodes that were touched are kept.
class NodeSum {
 public:
  explicit NodeSum(std::size_t node_count) : force_(node_count), touched_(node_count, 0) {}

  void add(Index node, double scale, const Vec3& direction) {
    touched_[at(node)] = 1;
    for (std::size_t i = 0; i < 3; ++i) force_[at(node)][i] += scale * direction[i];
  }

  LoadVector result(const TimeFunction& factor) const {
    LoadVector load{{}, {}, factor};
    for (std::size_t n = 0; n < force_.size(); ++n) {
      if (touched_[n] == 0) continue;
      load.nodes.push_back(static_cast<Index>(n));
      load.force.push_back(force_[n]);
    }
    return load;
  }

 private:
  std::vector<Vec3> force_;
  std::vector<char> touched_;
};

LoadVector make_load(const NodalForce& load) {
  LoadVector out{load.nodes, std::vector<Vec3>(load.nodes.size(), load.force), load.factor};
  for (std::size_t k = 0; k < load.shares.size(); ++k) out.force[k] = scaled(load.force, load.shares[k]);
  return out;
}

/// Part of the integral of N_a n dA over a face, at one of its nodes.
struct NodalArea {
  Index node;
  double weight;
  Vec3 direction;
};
using FaceAreas = std::vector<NodalArea>;

/// n dA by the right-hand rule.
FaceAreas areas_of_face(const Mesh& mesh, const Facet& face) {
  FaceAreas out;
  if (face.size == 3) {
    std::array<Vec3, 3> x{};
    for (std::size_t a = 0; a < 3; ++a) x[a] = mesh.coordinates[at(face[a])];
    const Vec3 twice_area = cross(subtract(x[1], x[0]), subtract(x[2], x[0]));
    for (const Index node : face) out.push_back({node, 1.0 / 6.0, twice_area});
    return out;
  }
  std::array<Vec3, 4> x{};
  for (std::size_t a = 0; a < 4; ++a) x[a] = mesh.coordinates[at(face[a])];
  for (const quad4::FacePoint& point : quad4::face_points(x))
    for (std::size_t a = 0; a < 4; ++a) out.push_back({face[a], point.N[a], point.normal_dA});
  return out;
}

/// The same of an edge in the x-y plane with normal (dy, -dx), times thickness, or integral of N_a 2 pi x ds of the
/// linear x: 2 pi L (2 x_a + x_b) / 6.
FaceAreas areas_of_edge(const Mesh& mesh, const Facet& edge, const Surface& surface) {
  const Vec3 &x_0 = mesh.coordinates[at(edge[0])], &x_1 = mesh.coordinates[at(edge[1])];
  const Vec3 normal{x_1[1] - x_0[1], x_0[0] - x_1[0], 0.0};
  if (surface.section != Section::axisymmetric)
    return {{edge[0], 0.5 * surface.thickness, normal}, {edge[1], 0.5 * surface.thickness, normal}};
  return {{edge[0], std::numbers::pi / 3.0 * (2.0 * x_0[0] + x_1[0]), normal},
          {edge[1], std::numbers::pi / 3.0 * (x_0[0] + 2.0 * x_1[0]), normal}};
}

/// Calls on_face(FaceAreas) for each face of a surface, on_end(node) for each end of a bar.
template <class OnFace, class OnEnd>
void for_each_face(const Mesh& mesh, const Surface& surface, const OnFace& on_face, const OnEnd& on_end) {
  std::vector<Facet> facets = surface.facets;
  for (const QuadraticFace& face : take_quadratic_faces(mesh, facets)) {
    const auto vectors = nodal_area_vectors(face, mesh, surface.section, surface.thickness);
    FaceAreas areas;
    for (std::size_t a = 0; a < static_cast<std::size_t>(node_count(face.type)); ++a)
      areas.push_back({face.node[a], 1.0, vectors[a]});
    on_face(areas);
  }
  for (const Facet& facet : facets) {
    if (facet.size == 1)
      on_end(facet[0]);
    else
      on_face(facet.size == 2 ? areas_of_edge(mesh, facet, surface) : areas_of_face(mesh, facet));
  }
}

/// At some nodes, of what all nodes have, over their sum.
std::vector<double> shares_at(std::span<const Index> nodes, std::span<const double> of_nodes) {
  std::vector<double> shares;
  for (const Index n : nodes) shares.push_back(of_nodes[at(n)]);
  const double sum = sum_of(shares);
  for (double& share : shares) share /= sum;
  return shares;
}

/// Unit vector out of the body at the end `node` of a bar, along its axis.
Vec3 end_normal(const Model& model, Index node) {
  const Mesh& mesh = *model.mesh;
  Vec3 normal{};
  int bars = 0;
  for (const Part& part : model.parts) {
    if (part.type != CellType::line2) continue;
    const std::vector<Index>& connectivity = mesh.block(CellType::line2)->connectivity;
    for (const Index cell : part.cells) {
      const Index* nodes = connectivity.data() + 2 * at(cell);
      if (nodes[0] != node && nodes[1] != node) continue;
      const Index other = nodes[0] == node ? nodes[1] : nodes[0];
      normal = normalized(subtract(mesh.coordinates[at(node)], mesh.coordinates[at(other)]));
      ++bars;
    }
  }
  if (bars == 1) return normal;
  throw CaseError(Location{mesh.report.source}, "loads",
                  fmt::format("pressure on node {}, which has {} bars", mesh.node_label(node), bars),
                  "the end of one bar", "load other nodes by forces");
}

LoadVector make_load(const Pressure& load, const Model& model) {
  NodeSum sum(model.mesh->node_count());
  for_each_face(
      *model.mesh, load.surface,
      [&](const FaceAreas& face) {
        for (const NodalArea& area : face) sum.add(area.node, -load.pressure * area.weight, area.direction);
      },
      [&](Index end) { sum.add(end, -load.pressure * load.surface.thickness, end_normal(model, end)); });
  return sum.result(load.factor);
}

/// Forces on nodes of rigid bodies act on what these nodes follow.
LoadVector carried(const LoadVector& load, const Model& model) {
  if (model.embedding.empty()) return load;
  NodeSum sum(model.mesh->node_count());
  for (std::size_t k = 0; k < load.nodes.size(); ++k) {
    const Embedding::Follower* follower = model.embedding.find(load.nodes[k]);
    if (follower == nullptr) {
      sum.add(load.nodes[k], 1.0, load.force[k]);
      continue;
    }
    for (std::size_t a = 0; a < 4; ++a) sum.add(follower->carrier[a], follower->weight[a], load.force[k]);
  }
  return sum.result(load.factor);
}

}  // namespace

std::vector<double> area_shares(const Mesh& mesh, const Surface& surface, std::span<const Index> nodes) {
  std::vector<double> areas(mesh.node_count(), 0.0);
  for_each_face(
      mesh, surface,
      [&](const FaceAreas& face) {
        Vec3 whole{};
        for (const NodalArea& area : face) whole = add(whole, scaled(area.direction, area.weight));
        const Vec3 normal = normalized(whole);
        for (const NodalArea& area : face) areas[at(area.node)] += area.weight * dot(area.direction, normal);
      },
      [&](Index end) { areas[at(end)] += surface.thickness; });
  return shares_at(nodes, areas);
}

std::vector<double> mass_shares(const Model& model, std::span<const Index> nodes) {
  std::vector<double> masses(model.mesh->node_count(), 0.0);
  for (const Part& part : model.parts) {
    const CellMass mass_of = cell_mass(find_element(part.type, part.section, part.formulation)->kind);
    for (const Index cell : part.cells) {
      const std::span<const Index> own = model.mesh->block(part.type)->nodes(cell);
      CellNodes X{};
      for (std::size_t a = 0; a < own.size(); ++a) X[a] = model.mesh->coordinates[at(own[a])];
      const NodeMatrix M = mass_of(X, part.thickness, part.material.rho);
      const double all = sum_of({M.data(), own.size() * own.size()});
      double trace = 0.0;
      for (std::size_t a = 0; a < own.size(); ++a) trace += M[(own.size() + 1) * a];
      for (std::size_t a = 0; a < own.size(); ++a) masses[at(own[a])] += M[(own.size() + 1) * a] * all / trace;
    }
  }
  return shares_at(nodes, masses);
}

std::vector<LoadVector> make_loads(const Model& model) {
  std::vector<LoadVector> loads;
  const auto add = [&](const LoadVector& load) { loads.push_back(carried(load, model)); };
  for (const Load& load : model.loads) {
    if (const auto* force = std::get_if<NodalForce>(&load)) add(make_load(*force));
    if (const auto* pressure = std::get_if<Pressure>(&load)) add(make_load(*pressure, model));
  }
  return loads;
}

std::vector<Gravity> gravity_loads(const Model& model) {
  std::vector<Gravity> loads;
  for (const Load& load : model.loads) {
    if (const auto* gravity = std::get_if<Gravity>(&load)) loads.push_back(*gravity);
  }
  return loads;
}

Loads::Loads(const Model& model) : vectors_(make_loads(model)), gravity_(gravity_loads(model)) {
  if (!gravity_.empty()) {
    nodes_.resize(model.mesh->node_count());
    std::iota(nodes_.begin(), nodes_.end(), Index{0});
    return;
  }
  for (const LoadVector& load : vectors_) nodes_.insert(nodes_.end(), load.nodes.begin(), load.nodes.end());
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
}

void Loads::force(double t, const Mass& mass, std::span<double> f, JumpSide side, const Holding* shared) const {
  const auto each_range = [&](const auto& body) {
    if (shared != nullptr)
      shared->each_range(body);
    else
      parallel_for(f.size() / 3, vector_grain, body);
  };
  each_range(
      [&](std::size_t begin, std::size_t end) { std::ranges::fill(f.subspan(3 * begin, 3 * (end - begin)), 0.0); });
  for (const LoadVector& load : vectors_) {
    const double factor = load.factor(t, side);
    for (std::size_t k = 0; k < load.nodes.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) f[3 * at(load.nodes[k]) + i] += factor * load.force[k][i];
  }
  for (const Gravity& gravity : gravity_) {
    const Vec3 g = scaled(gravity.acceleration, gravity.factor(t, side));
    each_range([&](std::size_t begin, std::size_t end) { mass.add_gravity(g, {begin, end}, f); });
  }
}

}  // namespace carom
