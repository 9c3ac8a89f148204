#include "run/body_scales.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "math/vec3.hpp"

namespace carom {

RunMonitor::Momenta momenta_of(const Model& model) {
  const auto is_ring = [](const Part& part) { return part.section == Section::axisymmetric; };
  return std::any_of(model.parts.begin(), model.parts.end(), is_ring) ? RunMonitor::Momenta::axial
                                                                      : RunMonitor::Momenta::all;
}

double reach(const Mesh& mesh) {
  double r = 0.0;
  for (const Vec3& x : mesh.coordinates) r = std::max(r, norm(x));
  return r;
}

double rest_energy(const Solid& solid, double reach) {
  const std::vector<double> diagonal = solid.tangent_diagonal(std::vector<double>(solid.dof_count(), 0.0));
  const double sum = std::accumulate(diagonal.begin(), diagonal.end(), 0.0), u = 1e-10 * reach;
  return 0.5 * sum * u * u;
}

}  // namespace carom
