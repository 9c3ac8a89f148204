// The semi-discrete solids: internal force, tangent, mass, external force, stable step, energies, stresses.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "linalg/csr_matrix.hpp"
#include "model/model.hpp"
#include "solid/mass.hpp"

namespace carom {

/// Instruction sets for which the kernels are compiled; `reference` is the same source over plain double.
enum class Isa : std::uint8_t { reference, x86_64_v2, x86_64_v3, x86_64_v4 };

/// Best instruction set of this processor, or the one named by the environment variable CAROM_ISA
/// (reference, v2, v3, v4). Throws std::runtime_error for an unknown name or one the processor lacks.
Isa chosen_isa();
std::string_view name(Isa isa);
/// True when this processor has the instruction set.
bool supported(Isa isa);

/// HEXA8 solids, 2 x 2 x 2 Gauss points, small strain. Dof 3 n + c is component c of node n; dof vectors have
/// 3 x node_count entries. All cells of all parts take part; interface cells of contact do not.
class Solid {
 public:
  explicit Solid(const Model& model, Isa isa = chosen_isa());
  ~Solid();
  Solid(Solid&&) noexcept;

  std::size_t node_count() const;
  std::size_t dof_count() const { return 3 * node_count(); }
  std::size_t cell_count() const;
  Isa isa() const;

  /// True when internal_force is linear in u: then K is constant and may be prepared once per run.
  bool is_linear() const { return true; }

  /// f = F(u) = sum over cells of the integral of B^T sigma(B u); overwrites f. Threaded in coloured chunks, the same
  /// bits for any thread count. Does not allocate.
  void internal_force(std::span<const double> u, std::span<double> f) const;
  /// Adds to f the internal force of the listed solid cells alone (positions in cells()); for section forces.
  void add_internal_force_of(std::span<const Index> cells, std::span<const double> u, std::span<double> f) const;
  /// y = K(u) x; overwrites y. As internal_force.
  void tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y) const;
  /// Assembled K(u), 3 nodes x 3 nodes.
  CsrMatrix tangent(std::span<const double> u) const;
  /// Diagonal of K(u).
  std::vector<double> tangent_diagonal(std::span<const double> u) const;
  /// Integral of the stored energy density; a function of u alone (ledger term `strain`).
  double strain_energy(std::span<const double> u) const;

  Mass mass(MassKind kind) const;

  /// Upper bound of omega^2 per cell: |A^8|^(1/8) of A = M_e^-1/2 K_e M_e^-1/2 with the lumped mass of the cell, in the
  /// largest-row-sum norm (a power sharpens Gershgorin's bound). The largest over the cells bounds the omega^2 of the
  /// whole body with lumped mass (Irons). One entry per solid cell, in the order of cells().
  std::vector<double> cell_frequency_bounds() const;

  /// f = external force at time t (nodal forces, pressures, gravity); overwrites f. Gravity acts on the mass that the
  /// scheme uses.
  void external_force(double t, const Mass& mass, std::span<double> f) const;
  bool has_loads() const;

  /// Index in Mesh::block(hexa8) of each solid cell; all per-cell results come in this order.
  const std::vector<Index>& cells() const;
  /// Volume mean of the stress of each solid cell: xx, yy, zz, xy, yz, zx.
  std::vector<std::array<double, 6>> cell_stress(std::span<const double> u) const;
  /// Volume and a length of each solid cell (volume over the largest face area).
  const std::vector<double>& cell_volumes() const;
  const std::vector<double>& cell_lengths() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
