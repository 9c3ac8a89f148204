#include "solid/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "element/quad4.hpp"
#include "math/vec3.hpp"
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
  return {load.nodes, std::vector<Vec3>(load.nodes.size(), load.force), load.factor};
}

/// Adds -p integral of N_a n dA over a face, n dA by the right-hand rule.
void add_pressure_on_face(const Pressure& load, const Mesh& mesh, const Facet& face, NodeSum& sum) {
  if (face.size == 3) {
    std::array<Vec3, 3> x{};
    for (std::size_t a = 0; a < 3; ++a) x[a] = mesh.coordinates[at(face[a])];
    const Vec3 twice_area = cross(subtract(x[1], x[0]), subtract(x[2], x[0]));
    for (const Index node : face) sum.add(node, -load.pressure / 6.0, twice_area);
    return;
  }
  std::array<Vec3, 4> x{};
  for (std::size_t a = 0; a < 4; ++a) x[a] = mesh.coordinates[at(face[a])];
  for (const quad4::FacePoint& point : quad4::face_points(x))
    for (std::size_t a = 0; a < 4; ++a) sum.add(face[a], -load.pressure * point.N[a], point.normal_dA);
}

/// The same on an edge in the x-y plane with normal (dy, -dx), times thickness, or integral of N_a 2 pi x ds of the
/// linear x: 2 pi L (2 x_a + x_b) / 6.
void add_pressure_on_edge(const Pressure& load, const Mesh& mesh, const Facet& edge, NodeSum& sum) {
  const Vec3 &x_0 = mesh.coordinates[at(edge[0])], &x_1 = mesh.coordinates[at(edge[1])];
  const Vec3 normal{x_1[1] - x_0[1], x_0[0] - x_1[0], 0.0};
  double share[2] = {0.5 * load.surface.thickness, 0.5 * load.surface.thickness};
  if (load.surface.section == Section::axisymmetric) {
    share[0] = std::numbers::pi / 3.0 * (2.0 * x_0[0] + x_1[0]);
    share[1] = std::numbers::pi / 3.0 * (x_0[0] + 2.0 * x_1[0]);
  }
  for (std::size_t a = 0; a < 2; ++a) sum.add(edge[a], -load.pressure * share[a], normal);
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
                  fmt::format("pressure on node {}, which has {} bars", mesh.node_numbers[at(node)], bars),
                  "the end of one bar", "load other nodes by forces");
}

LoadVector make_load(const Pressure& load, const Model& model) {
  const Mesh& mesh = *model.mesh;
  NodeSum sum(mesh.node_count());
  std::vector<Facet> facets = load.surface.facets;
  for (const QuadraticFace& face : take_quadratic_faces(mesh, facets)) {
    const auto shares = nodal_area_vectors(face, mesh, load.surface.section, load.surface.thickness);
    for (std::size_t a = 0; a < static_cast<std::size_t>(node_count(face.type)); ++a)
      sum.add(face.node[a], -load.pressure, shares[a]);
  }
  for (const Facet& facet : facets) {
    if (facet.size == 1)
      sum.add(facet[0], -load.pressure * load.surface.thickness, end_normal(model, facet[0]));
    else if (facet.size == 2)
      add_pressure_on_edge(load, mesh, facet, sum);
    else
      add_pressure_on_face(load, mesh, facet, sum);
  }
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

void Loads::force(double t, JumpSide side, const Mass& mass, std::span<double> f) const {
  std::fill(f.begin(), f.end(), 0.0);
  for (const LoadVector& load : vectors_) {
    const double factor = load.factor(t, side);
    for (std::size_t k = 0; k < load.nodes.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) f[3 * at(load.nodes[k]) + i] += factor * load.force[k][i];
  }
  for (const Gravity& gravity : gravity_) {
    const double factor = gravity.factor(t, side);
    const Vec3& g = gravity.acceleration;
    mass.add_gravity({factor * g[0], factor * g[1], factor * g[2]}, f);
  }
}

}  // namespace carom
