// QUAD4: the bilinear face of a HEXA8 and the plane cell (shape functions, normals, quadrature). Knows no physics.
#pragma once

#include <array>

#include "base/types.hpp"

namespace carom::quad4 {

/// N_a = (1 + xi xi_a)(1 + eta eta_a) / 4 with nodes (-1,-1), (1,-1), (1,1), (-1,1).
inline std::array<double, 4> shape(double xi, double eta) {
  return {0.25 * (1.0 - xi) * (1.0 - eta), 0.25 * (1.0 + xi) * (1.0 - eta), 0.25 * (1.0 + xi) * (1.0 + eta),
          0.25 * (1.0 - xi) * (1.0 + eta)};
}

/// Normal of length |dX/dxi x dX/deta| (area density), by the right-hand rule of the node order.
Vec3 area_normal(const std::array<Vec3, 4>& x, double xi, double eta);

/// One point of the 2 x 2 Gauss rule on a face: shape functions and the weighted area normal n dA.
struct FacePoint {
  std::array<double, 4> N{};
  Vec3 normal_dA{};
};

/// The 2 x 2 Gauss points. N_a n dA is of degree 2 or less in each direction, so its integral is exact.
std::array<FacePoint, 4> face_points(const std::array<Vec3, 4>& x);

/// Area (2 x 2 Gauss; exact for plane faces).
double area(const std::array<Vec3, 4>& x);

}  // namespace carom::quad4
