// The semi-discrete solids: internal force, tangent and mass. What else is asked of them: cell_values.hpp (stresses,
// energies), point_history.hpp, stability.hpp (bounds of frequencies).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernels/isa.hpp"
#include "linalg/block_matrix.hpp"
#include "linalg/csr_matrix.hpp"
#include "model/model.hpp"
#include "solid/body_cells.hpp"
#include "solid/cohesive_zones.hpp"
#include "solid/loads.hpp"
#include "solid/mass.hpp"
#include "solid/point_step.hpp"
#include "solid/turning_bodies.hpp"

namespace carom {

/// Bodies of the elements of solid/element_table.hpp. Dof 3 n + c is component c of node n whatever the cells; dof
/// vectors have 3 x node_count entries. Plane cells have no forces and no stiffness in z, bars none across their axis
/// but for the initial-stress term of finite strain. Parts whose law measures small strain are so, the others total
/// Lagrangian. All cells of all parts take part; interface cells of contact do not. Springs, point masses and
/// ties that tear (cohesive_zones.hpp) are part of all sums, and the latter make the system nonlinear. Rigid bodies
/// that turn stand among the nodes: their directors' forces, stiffness, energy and mass are part of all sums here, and
/// make the system nonlinear; the frequency of their directors is TurningBody::rigidity times the largest bound of the
/// cells'.
class Solid {
 public:
  explicit Solid(const Model& model, Isa isa = chosen_isa());
  ~Solid();
  Solid(Solid&&) noexcept;

  std::size_t node_count() const;
  std::size_t dof_count() const { return 3 * node_count(); }
  /// The solid cells; all results per cell come in their order.
  const BodyCells& cells() const;

  /// True when internal_force is linear in u: then K is constant and may be prepared once per run.
  bool is_linear() const;

  /// One sweep over the cells: f = F(u) = sum over cells of the integral of B^T sigma(B u), small strain, or P dN/dX
  /// with P = F S(E), for the step that ends at u; overwrites f and the history at the end of the step (`end`; empty:
  /// not wanted; it may not be step.history). Returns the energies at its end, and in of_parts those of the cells of
  /// each part of the case (Model::part_numbers), unless null. f and the energies are not numbers where a cell of
  /// finite strain is inverted (det F <= 0 at a quadrature point). Threaded in coloured chunks, the same bits for any
  /// thread count.
  SolidEnergies evaluate(std::span<const double> u, const PointStep& step, std::span<double> f, std::span<double> end,
                         std::vector<SolidEnergies>* of_parts = nullptr) const;
  /// The force of `evaluate` alone. Does not allocate.
  void internal_force(std::span<const double> u, std::span<double> f, const PointStep& step = {}) const;
  /// Adds to f the internal force of the listed solid cells alone (positions in cells()), of nodal ones their part of
  /// it. Adds their energies unless null (not of nodal ones).
  void add_internal_force_of(std::span<const Index> cells, std::span<const double> u, std::span<double> f,
                             const PointStep& step = {}, SolidEnergies* energies = nullptr) const;
  /// y = K(u) x, the derivative of F at u in the direction x; overwrites y. As internal_force.
  void tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                      const PointStep& step = {}) const;
  /// The energy-momentum force of a step from u_0 to u_1; overwrites f. As internal_force.
  /// f = integral of F_mid S_alg dN/dX, F_mid = (F_0 + F_1) / 2, S_alg the discrete gradient of the stored energy
  /// (material/discrete_gradient.hpp; Gonzalez, Comput. Methods Appl. Mech. Eng. 190, 2000), so that
  /// f . (u_1 - u_0) = strain_energy(u_1) - strain_energy(u_0), and f has no resultant and no moment about the middle
  /// configuration. St. Venant-Kirchhoff: S_alg = (S_0 + S_1) / 2; small strain: f = F((u_0 + u_1) / 2), likewise with
  /// the reference configuration for the moment. Its derivative by u_1 is not symmetric; tangent_action at
  /// (u_0 + u_1) / 2, halved, is a symmetric approximation to first order in u_1 - u_0 for Newton's method.
  void discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1, std::span<double> f) const;
  /// Assembled K(u), 3 nodes x 3 nodes.
  CsrMatrix tangent(std::span<const double> u, const PointStep& step = {}) const;
  /// P^T K(u) P without the fixed components of nodes, and K(u) itself in single precision unless null
  /// (solid/projected_stiffness.hpp). Both: empty, or of an earlier call, whose graph they keep.
  void project_tangent(std::span<const double> u, const PointStep& step, const Interpolation& P,
                       std::span<const std::uint8_t> fixed, BlockMatrix& coarse, BlockMatrix* fine) const;
  /// How far anything has strained or turned from u_0 to u_1, so that its tangent is another one: the largest over the
  /// cells of |w_a - w_0| / length of their nodes, w = u_1 - u_0 (BodyCells::lengths), and over the directors of
  /// turning bodies of their change.
  double largest_change(std::span<const double> u_0, std::span<const double> u_1) const;
  /// Diagonal of K(u). Every rank has all of it.
  std::vector<double> tangent_diagonal(std::span<const double> u, const PointStep& step = {}) const;
  /// That of K(0), computed once.
  const std::vector<double>& diagonal_at_rest() const;

  Mass mass(MassKind kind) const;
  /// The lumped mass, that of each cell times its factor.
  Mass lumped_mass(std::span<const double> cell_factors) const;

  /// Which nodes each rank holds: all of them, or those whose values it needs in the steps of schemes that share them
  /// out (PointStep::nodes).
  const Holding& all_nodes() const;
  const Holding& shared_nodes() const;

  const Loads& loads() const;
  const std::vector<Spring>& springs() const;
  const CohesiveZones& cohesive() const;
  const TurningBodies& turning_bodies() const;

  /// What it is made of: solid/solid_impl.hpp, for the files of this folder.
  struct Parts;
  const Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace carom
