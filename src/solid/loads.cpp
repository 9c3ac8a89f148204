#include "solid/loads.hpp"

#include "element/quad4.hpp"

namespace carom {
namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

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

LoadVector make_load(const Pressure& load, const Mesh& mesh) {
  NodeSum sum(mesh.node_count());
  for (const auto& face : load.faces) {
    std::array<Vec3, 4> x{};
    for (std::size_t a = 0; a < 4; ++a) x[a] = mesh.coordinates[at(face[a])];
    for (const quad4::FacePoint& point : quad4::face_points(x))
      for (std::size_t a = 0; a < 4; ++a) sum.add(face[a], -load.pressure * point.N[a], point.normal_dA);
  }
  return sum.result(load.factor);
}

}  // namespace

std::vector<LoadVector> make_loads(const Model& model) {
  std::vector<LoadVector> loads;
  for (const Load& load : model.loads) {
    if (const auto* force = std::get_if<NodalForce>(&load)) loads.push_back(make_load(*force));
    if (const auto* pressure = std::get_if<Pressure>(&load)) loads.push_back(make_load(*pressure, *model.mesh));
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

}  // namespace carom
