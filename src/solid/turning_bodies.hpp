// Rigid bodies that turn: the forces that keep their directors orthonormal.
#pragma once

#include <span>
#include <vector>

#include "model/turning_body.hpp"
#include "solid/contributor.hpp"

namespace carom {

/// Director of a body with their stiffness. With the strains E_ij = (d_i . d_j - delta_ij) / 2 the bodies store
///   W = 1/2 sum over ij of k_ij E_ij^2,  k_ij = 2 omega^2 m r_i^2 r_j^2 / (r_i^2 + r_j^2),
/// the form of St. Venant and Kirchhoff, so that all six small vibrations of the directors have the one frequency omega
/// and the energy-momentum force is the mean one. Rigid motions cost nothing; forces on the body strain it by about
/// force x arm / (m r^2 omega^2), spinning at Omega by (Omega / omega)^2. Feeds the ledger's `strain`. Forces have
/// neither resultant nor moment.
class TurningBodies : public Contributor {
 public:
  /// frequency: of the mesh. Throws std::invalid_argument when it is not positive and a body names none of its own.
  TurningBodies(std::vector<TurningBody> bodies, double frequency);

  bool empty() const override { return bodies_.empty(); }
  bool is_linear() const override { return bodies_.empty(); }
  std::vector<std::vector<Index>> links() const override;
  /// m / 4 on every node.
  std::vector<std::pair<Index, double>> masses() const override;
  void add_force(std::span<const double> u, const PointStep& step, std::span<double> f, SolidEnergies* energies,
                 std::span<double> end) const override;
  void add_discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1,
                                   std::span<double> f) const override;
  void add_tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                          const PointStep& step) const override;
  void add_tangent(std::span<const double> u, const PointStep& step, CsrMatrix& K) const override;
  void add_tangent_diagonal(std::span<const double> u, const PointStep& step,
                            std::span<double> diagonal) const override;
  /// Largest change of a director between two displacements; 0 without.
  double largest_change(std::span<const double> u_0, std::span<const double> u_1) const override;

  /// Adds stiffness x size of the body: a relative rounding of the directors makes this times it of force.
  void add_force_scale(std::span<double> f) const;
  /// Largest strain over the bodies; 0 without.
  double largest_strain(std::span<const double> u) const;

 private:
  using Matrix = std::array<Vec3, 3>;  ///< symmetric: S or k
  struct Body {
    TurningBody data;
    Matrix k{};
  };
  static BodyFrame frame(const Body& body, std::span<const double> u);
  static Matrix stress(const Body& body, const BodyFrame& at);
  static void scatter(const Body& body, const std::array<Vec3, 3>& force, std::span<double> f);
  static std::array<Vec3, 3> stiffness_action(const Body& body, const BodyFrame& at, const BodyFrame& direction);

  std::vector<Body> bodies_;
};

}  // namespace carom
