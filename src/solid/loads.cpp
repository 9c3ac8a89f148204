#include "solid/loads.hpp"

#include "element/quad4.hpp"
#include "solid/cell_matrices.hpp"

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

LoadVector make_load(const NodalForce& load, const Model&, const SolidCells&) {
  return {load.nodes, std::vector<Vec3>(load.nodes.size(), load.force), load.factor};
}

LoadVector make_load(const Pressure& load, const Model& model, const SolidCells&) {
  NodeSum sum(model.mesh->node_count());
  for (const auto& face : load.faces) {
    std::array<Vec3, 4> x{};
    for (std::size_t a = 0; a < 4; ++a) x[a] = model.mesh->coordinates[at(face[a])];
    for (const quad4::FacePoint& point : quad4::face_points(x))
      for (std::size_t a = 0; a < 4; ++a) sum.add(face[a], -load.pressure * point.N[a], point.normal_dA);
  }
  return sum.result(load.factor);
}

LoadVector make_load(const Gravity& load, const Model& model, const SolidCells& solid) {
  NodeSum sum(model.mesh->node_count());
  for (const Block& block : solid.blocks)
    for (Index c = 0; c < block.cells; ++c) {
      const Index cell = solid.cells[at(block.first + c)];
      const CellMass M = cell_mass(cell_coordinates(*model.mesh, cell), block.material.rho);
      const auto nodes = cell_nodes(*model.mesh, cell);
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t b = 0; b < 8; ++b) sum.add(nodes[a], M[a][b], load.acceleration);
    }
  return sum.result(load.factor);
}

}  // namespace

std::vector<LoadVector> make_loads(const Model& model, const SolidCells& solid) {
  std::vector<LoadVector> loads;
  for (const Load& load : model.loads)
    loads.push_back(std::visit([&](const auto& kind) { return make_load(kind, model, solid); }, load));
  return loads;
}

}  // namespace carom
