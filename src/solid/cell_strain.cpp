#include "solid/cell_strain.hpp"

#include "kernels/batch_gradients.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_size.hpp"
#include "parallel/threads.hpp"
#include "solid/cell_matrices.hpp"
#include "solid/element_table.hpp"

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

/// One cell for the stages of plain double.
class OneCell {
 public:
  OneCell(const Mesh& mesh, std::span<const Vec3> x, const Part& part, Index cell) {
    const Element& element = *find_element(part.type, part.section, part.formulation);
    stages_.cell = &kernels_reference().cells[static_cast<std::size_t>(element.kind)];
    const auto n = static_cast<std::size_t>(stages_.cell->nodes);
    const Index* nodes = mesh.block(part.type)->connectivity.data() + n * static_cast<std::size_t>(cell);
    for (std::size_t a = 0; a < n; ++a) offset_[a] = 3 * nodes[a];
    cells_.stages = &stages_;
    cells_.x = x.front().data();
    cells_.offset = offset_.data();
    cells_.cells = 1;
    cells_.thickness = part.thickness;
  }
  OneCell(const OneCell&) = delete;
  OneCell& operator=(const OneCell&) = delete;

  BatchGradients gradients(std::span<const double> u) const { return {cells_, u.data()}; }

 private:
  std::array<Index, most_nodes> offset_{};
  BatchStages stages_;
  CellBatches cells_;
};

bool is_small(const Part& part) {
  return part.material.law->measure == Measure::small_strain;
}

Strain mean_strain(const BatchGradients& gradients, const Part& part, double finite) {
  Strain mean{};
  for (int p = 0; p < gradients.points(); ++p) {
    double A[3][3], H[3][3], E[3][3];
    gradients.frame(0, A);
    gradients.gradient(p, 0, H);
    strain_of(A, H, finite, E);
    if (part.section == Section::bar) {  // from the bar's axis to space
      const double axial = E[0][0];
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) E[i][j] = axial * A[i][0] * A[j][0];
    }
    const Strain of_point{E[0][0], E[1][1], E[2][2], E[0][1], E[1][2], E[2][0]};
    for (std::size_t c = 0; c < 6; ++c) mean[c] += gradients.weight(p, 0) * of_point[c];
  }
  for (double& c : mean) c /= gradients.volume(0);
  return mean;
}

/// Distance at u of two material planes with the normal n at u, over their reference distance: |F^T n| of the mean F.
double stretch_between(const BatchGradients& gradients, const Vec3& n) {
  double A[3][3], H[9 * most_lanes];
  gradients.frame(0, A);
  gradients.means(H);
  Vec3 back = n;  // F^T n = n + A H^T n, A the directions of H's columns
  for (std::size_t j = 0; j < 3; ++j) {
    const auto column = [&](std::size_t i) { return H[(3 * i + j) * static_cast<std::size_t>(gradients.lanes())]; };
    const double along = column(0) * n[0] + column(1) * n[1] + column(2) * n[2];
    for (std::size_t i = 0; i < 3; ++i) back[i] += A[i][j] * along;
  }
  return norm(back);
}

/// `strain_of_cell(part, cell)` of all solid cells, part after part.
template <class OfCell>
std::vector<Strain> strains(const Model& model, const OfCell& strain_of_cell) {
  std::vector<Strain> strain;
  for (const Part& part : model.parts) {
    const std::size_t first = strain.size();
    strain.resize(first + part.cells.size());
    constexpr std::size_t grain = 256;
    parallel_for(part.cells.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) strain[first + k] = strain_of_cell(part, part.cells[k]);
    });
  }
  return strain;
}

}  // namespace

double cell_shortening(const Mesh& mesh, const Part& part, Index cell, const Vec3& n, std::span<const double> u) {
  const double stretch = stretch_between(OneCell(mesh, mesh.coordinates, part, cell).gradients(u), n);
  std::vector<Vec3> x;
  const auto size = static_cast<std::size_t>(node_count(part.type));
  const Index* nodes = mesh.block(part.type)->connectivity.data() + size * static_cast<std::size_t>(cell);
  for (std::size_t a = 0; a < size; ++a) x.push_back(mesh.coordinates[static_cast<std::size_t>(nodes[a])]);
  return (1.0 - stretch) * cell_length(part.type, x);
}

std::vector<Strain> cell_strain(const Model& model, std::span<const double> u) {
  return strains(model, [&](const Part& part, Index cell) {
    const OneCell one(*model.mesh, model.mesh->coordinates, part, cell);
    return mean_strain(one.gradients(u), part, is_small(part) ? 0.0 : 1.0);
  });
}

std::vector<Strain> cell_strain_rate(const Model& model, std::span<const double> u, std::span<const double> v) {
  std::vector<Vec3> x = model.mesh->coordinates;
  for (std::size_t i = 0; i < 3 * x.size(); ++i) x[i / 3][i % 3] += u[i];
  return strains(model, [&](const Part& part, Index cell) {
    const OneCell one(*model.mesh, is_small(part) ? model.mesh->coordinates : x, part, cell);
    return mean_strain(one.gradients(v), part, 0.0);
  });
}

}  // namespace carom
