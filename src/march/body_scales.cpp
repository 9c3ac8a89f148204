#include "march/body_scales.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"

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

namespace {

/// The trace of K at rest. Of many cells an estimate: z.K z with signs z_i = +-1, which is right on the average over
/// signs (Hutchinson, Commun. Stat. Simul. Comput. 19, 1990) and here to some hundredths.
double trace_at_rest(const Solid& solid) {
  constexpr std::size_t many = 4096;
  if (solid.cells().size() < many) {
    return sum_of(solid.diagonal_at_rest());
  }
  const std::vector<double> zero(solid.dof_count(), 0.0);
  std::vector<double> sign(zero.size()), K_sign(zero.size());
  std::minstd_rand bits;
  for (double& s : sign) s = bits() < std::minstd_rand::max() / 2 ? -1.0 : 1.0;
  solid.tangent_action(zero, sign, K_sign);
  return dot(sign, K_sign);
}

}  // namespace

double rest_energy(const Solid& solid, double reach) {
  const double u = 1e-10 * reach;
  return 0.5 * trace_at_rest(solid) * u * u;
}

}  // namespace carom
