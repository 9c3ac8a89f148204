#include "solid/cell_strain.hpp"

#include "element/cell_shapes.hpp"
#include "math/vec3.hpp"
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

/// Distance at u of two material planes with the normal n at u, over their reference distance: |F^T n|.
template <class Shape>
double stretch_between(const typename Shape::Nodes& x, const typename Shape::Nodes& d, const Vec3& n,
                       double thickness) {
  const typename Shape::Point point = Shape::centre(x, thickness);
  double H[3][3];
  displacement_gradient<Shape>(point, d, H);
  Vec3 back = n;  // F^T n = n + A H^T n, A the directions of H's columns
  for (std::size_t j = 0; j < 3; ++j) {
    const double along = H[0][j] * n[0] + H[1][j] * n[1] + H[2][j] * n[2];
    for (std::size_t i = 0; i < 3; ++i) back[i] += point.frame[i][j] * along;
  }
  return norm(back);
}

template <class Shape>
double shortening(const Mesh& mesh, const Part& part, Index cell, const Vec3& n, std::span<const double> u) {
  typename Shape::Nodes x{}, d{};
  const Index* nodes = mesh.block(part.type)->connectivity.data() + Shape::nodes * static_cast<std::size_t>(cell);
  for (std::size_t a = 0; a < Shape::nodes; ++a) {
    const auto node = static_cast<std::size_t>(nodes[a]);
    x[a] = mesh.coordinates[node];
    d[a] = {u[3 * node], u[3 * node + 1], u[3 * node + 2]};
  }
  return (1.0 - stretch_between<Shape>(x, d, n, part.thickness)) * Shape::length(x);
}

}  // namespace

double cell_shortening(const Mesh& mesh, const Part& part, Index cell, const Vec3& n, std::span<const double> u) {
  switch (part.section) {
    case Section::solid:
      return shortening<HexaShape>(mesh, part, cell, n, u);
    case Section::axisymmetric:
      return shortening<AxisymmetricShape>(mesh, part, cell, n, u);
    case Section::bar:
      return shortening<BarShape>(mesh, part, cell, n, u);
    default:
      return shortening<PlaneShape>(mesh, part, cell, n, u);
  }
}

std::vector<Strain> cell_strain(const Model& model, std::span<const double> u) {
  std::vector<Strain> strain;
  for (const Part& part : model.parts) {
    const std::size_t first = strain.size();
    strain.resize(first + part.cells.size());
    const MeanStrain mean = mean_strain_of(part.section);
    const double finite = part.material.law->measure == Measure::small_strain ? 0.0 : 1.0;
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
