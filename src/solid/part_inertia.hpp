// Mass, centre and inertia of cells.
#pragma once

#include <span>

#include "model/model.hpp"

namespace carom {

/// Of a body, by the consistent masses of its cells: m = sum of M_ab, m c = sum of M_ab X_a, and about c
///   I = integral of rho (|r|^2 1 - r r^T),  integral of rho r_i r_j = sum over ab of M_ab r_ai r_bj,
/// which is exact, since X is interpolated as displacements are. products: the tensor's entries xy, yz, zx.
struct PartInertia {
  double mass = 0.0;
  Vec3 centre{}, moments{}, products{};
};

/// Of the cells of several parts together.
PartInertia inertia_of(const Mesh& mesh, std::span<const Part* const> parts);

}  // namespace carom
