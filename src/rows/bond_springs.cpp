#include "rows/bond_springs.hpp"

#include "math/vec3.hpp"

namespace carom {

double bond_energy(const RowLaw& law, const Vec3& w) {
  return 0.5 * law.eps_N * dot(w, w);
}

RowTangent bond_tangent(double stiffness) {
  return {stiffness, 0.0, 0.0, 0.0, stiffness, 0.0, 0.0, 0.0, stiffness};
}

void add_bond_springs(std::span<const double> x, ContactResponse& response) {
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const RowLaw& law = rows.law[r];
    if (!is_bond(law) || is_equation(law)) continue;
    const Vec3 w = parted(rows, r, x);
    response.force[r] = scaled(w, -law.eps_N);
    response.status[r] = admissible(law).status(response.force[r]);
    response.stored += bond_energy(law, w);
  }
}

}  // namespace carom
