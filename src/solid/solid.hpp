// The semi-discrete solids: internal force, tangent, mass, external force, stable step, energies, stresses.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linalg/block_matrix.hpp"
#include "linalg/csr_matrix.hpp"
#include "math/voigt.hpp"
#include "model/model.hpp"
#include "solid/cohesive_zones.hpp"
#include "solid/evaluation.hpp"
#include "solid/mass.hpp"
#include "solid/rotation.hpp"

namespace carom {

/// Instruction sets for which the kernels are compiled; `reference` is the same source over plain double.
enum class Isa : std::uint8_t { reference, x86_64_v2, x86_64_v3, x86_64_v4 };

/// Best instruction set of this processor, or the one named by the environment variable CAROM_ISA
/// (reference, v2, v3, v4). Throws std::runtime_error for an unknown name or one the processor lacks.
Isa chosen_isa();
std::string_view name(Isa isa);
/// True when this processor has the instruction set.
bool supported(Isa isa);

/// What a value of a cell is of those of its points.
enum class OverPoints : std::uint8_t { mean, largest };

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
  std::size_t cell_count() const;
  Isa isa() const;

  /// Largest strain of the rigid bodies that turn (turning_bodies.hpp): how far they are from rigid. 0 without.
  double body_strain(std::span<const double> u) const;

  /// Adds, on the nodes of rigid bodies that turn, the forces whose relative rounding internal_force cannot avoid at
  /// any displacement: the bodies' stiffness times their size.
  void add_body_force_scale(std::span<double> f) const;

  /// True when internal_force is linear in u: then K is constant and may be prepared once per run.
  bool is_linear() const;
  /// True when cells have hourglass modes, whose energy u.F / 2 alone does not tell from that of strain.
  bool has_hourglass() const;

  /// Numbers that the quadrature points remember, their history variables: the order is that of the kernels and
  /// depends on the instruction set. None for elastic bodies.
  std::size_t history_size() const;
  /// That of bodies at rest.
  std::vector<double> initial_history() const;
  /// The same numbers in an order that depends on the mesh and the laws alone, and back: cell by cell, part after part.
  /// Throws std::invalid_argument where they are not as many as the bodies remember.
  std::vector<double> history_by_cell(std::span<const double> history) const;
  std::vector<double> history_of_lanes(std::span<const double> by_cell) const;

  /// One sweep over the cells: f = F(u) = sum over cells of the integral of B^T sigma(B u), small strain, or P dN/dX
  /// with P = F S(E), for the step that ends at u; overwrites f and the history at the end of the step (`end`; empty:
  /// not wanted; it may not be step.history). Returns the energies at its end. f and the energies are not numbers where
  /// a cell of finite strain is inverted (det F <= 0 at a quadrature point). Threaded in coloured chunks, the same bits
  /// for any thread count.
  SolidEnergies evaluate(std::span<const double> u, const PointStep& step, std::span<double> f,
                         std::span<double> end) const;
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
  /// cells of |w_a - w_0| / length of their nodes, w = u_1 - u_0 (cell_lengths), and over the directors of turning
  /// bodies of their change.
  double largest_change(std::span<const double> u_0, std::span<const double> u_1) const;
  /// Diagonal of K(u).
  std::vector<double> tangent_diagonal(std::span<const double> u, const PointStep& step = {}) const;
  /// u.K_e u / 2 of cell k of cells() at rest, u the displacements of its nodes (not of nodal parts, whose cells have
  /// no K_e); and the integral of f^2 over its reference volume, f the values at its nodes.
  double energy_at_rest(std::size_t k, std::span<const Vec3> u) const;
  double square_integral(std::size_t k, std::span<const double> f) const;
  /// The strain energy of `evaluate` for points at rest before; allocates.
  double strain_energy(std::span<const double> u) const;

  /// Largest rotation of a small-strain cell that is there: the angle of R in its mean F = R U, bars: the angle by
  /// which the axis turns; pi for a cell turned inside out. Small strain makes an error of order angle^2. Threaded,
  /// cheap enough to be called every few steps.
  Rotation largest_rotation(std::span<const double> u, std::span<const std::uint8_t> alive = {}) const;

  /// The first cell that is there, a position in cells(), that has forces which are no numbers at u: at finite
  /// positions one that is turned inside out (det F <= 0 at a quadrature point of finite strain). -1: none. One cell
  /// after the other.
  Index first_inverted_cell(std::span<const double> u, std::span<const std::uint8_t> alive = {}) const;

  Mass mass(MassKind kind) const;
  /// The lumped mass, that of each cell times its factor.
  Mass lumped_mass(std::span<const double> cell_factors) const;
  /// Mass of each solid cell.
  std::vector<double> cell_masses() const;

  /// Upper bound of omega^2 per cell: |A^8|^(1/8) of A = M_e^-1/2 K_e M_e^-1/2 with the lumped mass of the cell, in the
  /// largest-row-sum norm (a power sharpens Gershgorin's bound). The largest over the cells bounds the omega^2 of the
  /// whole body with lumped mass (Irons). K_e is that of the reference configuration. Cells of the same shape
  /// (congruent_cells) share theirs. One entry per solid cell, in the order of cells().
  std::vector<double> cell_frequency_bounds() const;
  /// The largest of them; 0 without cells.
  double largest_frequency_bound() const;

  /// How many times the omega^2 of each solid cell is at u what it is at rest, for elastic changes: (c / l)^2 over that
  /// at rest, c the fastest elastic wave of its points (PointBatch::wave_modulus) and l its length (cell_lengths) where
  /// its nodes stand (Courant, Friedrichs and Lewy, Mathematische Annalen 100, 1928); 1 of cells of small strain. Not a
  /// number where a cell is inverted.
  void frequency_growth(std::span<const double> u, const PointStep& step, std::span<double> growth) const;

  /// Upper bound of the eigenvalues of M^-1 C, C the damping of artificial viscosity at the rates of the last step that
  /// the history remembers (empty: at rest), by the lumped masses of the cells in the reference configuration; 1 /
  /// time. Of the quadratic term twice the secant, its slope.
  double largest_damping(std::span<const double> history) const;

  /// f = external force at time t (nodal forces, pressures, gravity); overwrites f. Gravity acts on the mass that the
  /// scheme uses.
  void external_force(double t, const Mass& mass, std::span<double> f) const;
  bool has_loads() const { return !loaded_nodes().empty(); }
  /// The nodes that it may act on, increasing: all of them under gravity.
  const std::vector<Index>& loaded_nodes() const;

  const std::vector<Spring>& springs() const;
  const CohesiveZones& cohesive() const;

  /// The solid cells; all per-cell results come in this order.
  const std::vector<CellRef>& cells() const;
  /// Nodes of cell k of cells().
  std::span<const Index> nodes_of_cell(std::size_t k) const;
  /// Mean over the reference volume of the Cauchy stress of each solid cell: xx, yy, zz, xy, yz, zx. zz is the hoop
  /// stress of axisymmetric cells; bars give the tensor of their axial stress, nodal cells the mean of their patches.
  std::vector<std::array<double, 6>> cell_stress(std::span<const double> u, const PointStep& step = {}) const;
  /// The largest measure of these stresses and its cell, the first of several.
  std::pair<double, std::size_t> largest_stress(std::span<const double> u, const PointStep& step,
                                                double (*measure)(const Voigt& stress)) const;
  /// Mean over the reference volume, or largest, of a history variable of the points of each solid cell (Law::history),
  /// from the history of all points; 0 in cells of laws without it. Empty when no law of the bodies has it.
  std::vector<double> cell_history(std::string_view variable, std::span<const double> history,
                                   OverPoints over = OverPoints::mean) const;
  /// Zeroes what the points of the cells that have gone (alive: 0, by cell) remember.
  void forget_gone(std::span<const std::uint8_t> alive, std::span<double> history) const;
  /// Reference volume of each solid cell (axisymmetric: of the ring) and a length: volume over the largest face area of
  /// HEXA8, area over the longest edge of QUAD4, the length of a bar.
  const std::vector<double>& cell_volumes() const;
  const std::vector<double>& cell_lengths() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
