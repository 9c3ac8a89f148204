#include "solid/cell_strain.hpp"

#include "element/cell_shapes.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

using Strain = std::array<double, 6>;

/// (A^T H + H^T A + H^T H) / 2 with the frame A; the last term of finite strain alone. In the frame's directions.
void strain_of(const double A[3][3], const double H[3][3], double finite, double E[3][3]) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      E[i][j] = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        E[i][j] += 0.5 * (A[k][i] * H[k][j] + H[k][i] * A[k][j] + finite * H[k][i] * H[k][j]);
    }
}

template <class Shape>
Strain mean_strain(const Mesh& mesh, const Index* cell, std::span<const double> u, double finite, double thickness) {
  typename Shape::Nodes x{}, d{};
  for (std::size_t a = 0; a < Shape::nodes; ++a) {
    const auto n = static_cast<std::size_t>(cell[a]);
    x[a] = mesh.coordinates[n];
    d[a] = {u[3 * n], u[3 * n + 1], u[3 * n + 2]};
  }
  Strain mean{};
  double volume = 0.0;
  for (std::size_t p = 0; p < Shape::points; ++p) {
    const typename Shape::Point point = Shape::point(x, p, thickness);
    double H[3][3], E[3][3];
    displacement_gradient<Shape>(point, d, H);
    strain_of(point.frame, H, finite, E);
    if constexpr (Shape::nodes == 2) {  // from the bar's axis to space
      const double axial = E[0][0];
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) E[i][j] = axial * point.frame[i][0] * point.frame[j][0];
    }
    const Strain of_point{E[0][0], E[1][1], E[2][2], E[0][1], E[1][2], E[2][0]};
    for (std::size_t c = 0; c < 6; ++c) mean[c] += point.weight * of_point[c];
    volume += point.weight;
  }
  for (double& c : mean) c /= volume;
  return mean;
}

using MeanStrain = Strain (*)(const Mesh&, const Index*, std::span<const double>, double, double);

MeanStrain mean_strain_of(Section section) {
  switch (section) {
    case Section::solid:
      return mean_strain<HexaShape>;
    case Section::axisymmetric:
      return mean_strain<AxisymmetricShape>;
    case Section::bar:
      return mean_strain<BarShape>;
    default:
      return mean_strain<PlaneShape>;
  }
}

}  // namespace

std::vector<Strain> cell_strain(const Model& model, std::span<const double> u) {
  std::vector<Strain> strain;
  for (const Part& part : model.parts) {
    const std::size_t first = strain.size();
    strain.resize(first + part.cells.size());
    const MeanStrain mean = mean_strain_of(part.section);
    const double finite = std::holds_alternative<LinearElastic>(part.material) ? 0.0 : 1.0;
    const auto nodes = static_cast<std::size_t>(node_count(part.type));
    const Index* connectivity = model.mesh->block(part.type)->connectivity.data();
    constexpr std::size_t grain = 256;
    parallel_for(part.cells.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        strain[first + k] = mean(*model.mesh, connectivity + nodes * static_cast<std::size_t>(part.cells[k]), u, finite,
                                 part.thickness);
      }
    });
  }
  return strain;
}

}  // namespace carom
