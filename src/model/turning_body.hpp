// A free rigid body that turns: four point masses that hold each other.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "base/types.hpp"

namespace carom {

/// A rigid body of mass m with the principal axes e_i at its centre of mass, as four nodes of mass m / 4 on the corners
/// of a tetrahedron,
///   x_a = phi + sum over i of s_ai r_i d_i,  s = (1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1),
/// with d_i = e_i at first and r_i^2 = E_i / m, E_i = (I_j + I_k - I_i) / 2 the Euler tensor. The four have the mass,
/// the centre and the inertia of the body (equimomental systems: E. J. Routh, Dynamics of a System of Rigid Bodies,
/// 1905, ch. I), and every other point of it follows them by weights that do not change (natural coordinates: J. Garcia
/// de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems, 1994, ch. 4; P. Betsch, S. Leyendecker,
/// Int. J. Numer. Meth. Engng 67, 2006):
///   x = sum over a of N_a x_a,  N_a = 1/4 (1 + sum over i of s_ai X_i / r_i),  X_i = e_i . (X - centre).
/// So the mass matrix is diagonal and constant, and momenta and kinetic energy are exact. What keeps the directors d_i
/// orthonormal is a stiff energy (solid/turning_bodies.hpp).
struct TurningBody {
  std::string name;
  std::array<Index, 4> nodes{-1, -1, -1, -1};
  double mass = 0.0;                ///< 0: the nodes are led, by a motion that is imposed on them
  Vec3 centre{};                    ///< of mass or of rotation, in the reference configuration
  std::array<Vec3, 3> axes{};       ///< e_i, orthonormal and right-handed
  Vec3 radii{};                     ///< r_i > 0, length
  double rigidity = 0.5;            ///< frequency of the directors' vibration over the largest of the mesh
  std::optional<double> frequency;  ///< radian per time, instead of what rigidity makes

  bool is_led() const { return mass == 0.0; }
};

/// s_ai
inline constexpr std::array<Vec3, 4> corner_signs{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};

/// The body without its nodes. inertia: I_xx, I_yy, I_zz about the centre of mass; products: the tensor's entries xy,
/// yz, zx, which are minus the integrals of the products of the coordinates. Throws std::invalid_argument naming the
/// principal moments when a moment is not below the sum of the two others by 1e-6 of the largest Euler moment: bodies
/// without thickness (rods, discs) have no tetrahedron.
TurningBody make_turning_body(double mass, const Vec3& centre, const Vec3& inertia, const Vec3& products);

/// A body without mass that is led to turn about `axis` (of length 1), which is one of its own axes; its nodes stand at
/// the distance size > 0 from the centre.
TurningBody make_led_body(const Vec3& centre, const Vec3& axis, double size);

/// Is there a body that forces move?
bool any_free(std::span<const TurningBody> bodies);

/// Reference position of node a.
Vec3 corner(const TurningBody& body, std::size_t a);

/// N_a of the material point that is at X in the reference configuration.
std::array<double, 4> corner_weights(const TurningBody& body, const Vec3& X);

/// What turns nodal values (positions, or velocities) into those of the centre and the directors:
///   phi = 1/4 sum of x_a,  d_i = 1 / (4 r_i) sum of s_ai x_a.
struct BodyFrame {
  Vec3 centre{};
  std::array<Vec3, 3> directors{};
};
BodyFrame body_frame(const TurningBody& body, const std::array<Vec3, 4>& nodal);

/// Entries of a vector of nodes, or of a dof vector, at the body's nodes.
std::array<Vec3, 4> nodal_values(const TurningBody& body, std::span<const Vec3> values);
std::array<Vec3, 4> nodal_values(const TurningBody& body, std::span<const double> values);

/// Angular velocity of a rigid motion: 1/2 sum of d_i x d_i'.
Vec3 angular_velocity(const BodyFrame& position, const BodyFrame& velocity);

/// Largest |d_i . d_j - delta_ij| / 2: the strain of the body, which rigid ones do not have.
double body_strain(const BodyFrame& position);

/// The body where its nodes stand. Half way between the ends of a step, where some schemes look, the nodes of a body
/// that turns are nearer to its axis than before and after; a led body, whose motion is known, is seen in its own size
/// there.
class BodyPlacement {
 public:
  BodyPlacement(const TurningBody& body, const BodyFrame& frame);

  /// Where the material point that is at x now was in the reference configuration, and back.
  Vec3 reference(const Vec3& x) const;
  Vec3 position(const Vec3& X) const;
  /// Gradient by x of a function of reference(x) whose gradient there is given: F^-T g.
  Vec3 gradient(const Vec3& g) const;
  /// N_a of the material point that is at x; their sum is 1 and the sum of N_a x_a is x.
  std::array<double, 4> weights(const Vec3& x) const;

 private:
  const TurningBody* body_;
  Vec3 centre_;
  std::array<Vec3, 3> duals_;  ///< d^i with d^i . d_j = delta_ij
  std::array<Vec3, 3> seen_;   ///< the same of the body as it is seen
  std::array<Vec3, 3> basis_;  ///< the directors of the body as it is seen
};

/// The body at displacements u of the nodes.
BodyPlacement place_body(const TurningBody& body, std::span<const double> u);

}  // namespace carom
