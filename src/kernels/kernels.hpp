// The batch kernels of the solid, compiled once per instruction set.
#pragma once

#include <cstddef>

#include "base/types.hpp"
#include "element/cell_list.hpp"
#include "kernels/bulk_viscosity.hpp"
#include "kernels/cell_memory.hpp"
#include "kernels/energies.hpp"
#include "kernels/stages.hpp"
#include "material/law_kernels.hpp"
#include "material/point_batch.hpp"
#include "material/viscosity.hpp"

namespace carom {

/// What a batch goes through, of one number type: the cell, the kinematics, and mean dilatation and bulk viscosity
/// unless null.
struct BatchStages {
  int lanes = 1;
  const CellStages* cell = nullptr;
  const PointStages* points = nullptr;
  const DilatationStages* dilatation = nullptr;
  const BulkStages* bulk = nullptr;
  double hourglass = 0.0;              ///< coefficient x modulus of the hourglass stiffness
  ModeModuli moduli{};                 ///< of stabilised cells
  double hourglass_coefficient = 0.0;  ///< of modes that yield or are viscous (kernels/hourglass_flow.hpp)
  CellMemory memory{};                 ///< of a cell; no slot of modes: they are elastic
  double heating_share = 0.0;          ///< of the plastic work (Law)
  Viscosity viscosity{};
  double modulus = 0.0, rho = 0.0, wave_speed = 0.0;  ///< for viscosity: shear modulus, density, c, all at rest
};

/// Cells of one type, section and material, `lanes` of them per batch. offset[(n b + a) lanes + l] is 3 x the node
/// number of local node a (of n) of cell b lanes + l. The last batch is filled up by repeating its last cell; such
/// lanes are never written back, but in their history, which is that of the repeated cell.
struct CellBatches {
  const BatchStages* stages = nullptr;
  const double* x = nullptr;  ///< coordinates, 3 per node
  const Index* offset = nullptr;
  Index cells = 0;
  double thickness = 1.0;           ///< of plane cells; area of the section of bars
  double dt = 0.0;                  ///< length of the step, for laws with rates
  double viscous_dt = 0.0;          ///< the same for artificial viscosity; 0: it rests
  const double* length = nullptr;   ///< of each cell, where there is viscosity, whole batches
  int history_variables = 0;        ///< of a point
  const double* history = nullptr;  ///< CellMemory of batch after batch at the beginning of the step; null: at rest
  double* new_history = nullptr;    ///< at its end; null: not wanted
  bool is_over = false;             ///< the history is that at its end (PointStep)
};

/// The kernels of one kind of cell under one formulation. Dof vectors have 3 entries per node. None of them allocates.
/// An inverted cell under finite strain gives forces and energies that are not numbers.
struct CellKernels {
  /// f += F(u) of the cells; fills the new history, and adds to the energies unless they are null.
  void (*add_internal_force)(const CellBatches&, const BatchLaw&, const double* u, double* f,
                             SolidEnergies* energies) = nullptr;
  /// y += K(u) x of the cells.
  void (*add_tangent_action)(const CellBatches&, const BatchLaw&, const double* u, const double* x,
                             double* y) = nullptr;
  /// K_e(u) of one batch, where it costs less than a tangent action for each of its columns; null elsewhere. Entry
  /// (r, s) of lane l at [(3 n r + s) lanes + l], the upper triangle by blocks of nodes alone.
  void (*stiffness)(const CellBatches&, const BatchLaw&, const double* u, double* K) = nullptr;
  /// f += energy-momentum force between u_0 and u_1 (Solid::discrete_gradient_force).
  void (*add_discrete_gradient_force)(const CellBatches&, const BatchLaw&, const double* u_0, const double* u_1,
                                      double* f) = nullptr;
  /// stress[6 cell + c] = volume mean of the Cauchy stress.
  void (*mean_stress)(const CellBatches&, const BatchLaw&, const double* u, double* stress) = nullptr;
};

/// The kernels of any cell, formulation and law, made of the stages.
extern const CellKernels staged_kernels;

/// modulus[cell] = largest PointBatch::wave_modulus of its points.
void wave_modulus(const CellBatches& cells, const BatchLaw& law, const double* u, double* modulus);

/// f += the part of the forces of a batch filled up with one patch that comes from its cells that are wanted.
void add_internal_force_of_parts(const CellBatches& cells, const BatchLaw& law, const double* u,
                                 const unsigned char* wanted, double* f);

/// What is compiled for one instruction set.
struct KernelTable {
  int lanes = 1;
  CellKernels hexa8_small, hexa8_finite;  ///< of HEXA8 with full integration and elastic laws, fused
  CellStages cells[cell_kinds];           ///< in the order of CellKind
  CellStages patches[3];                  ///< of nodes, by frame: TETRA4, TRIA3 in the plane and of rings
  PointStages small, finite;
  DilatationStages small_dilatation[volume_fields], finite_dilatation[volume_fields];  ///< in the order of VolumeField
  BulkStages small_bulk, finite_bulk;
  LawTable laws;
  void (*power_bound)(int n, double* A, double* work, double* bound) = nullptr;  ///< kernels/power_bound.hpp
};

const KernelTable& kernels_reference();
const KernelTable& kernels_v2();
const KernelTable& kernels_v3();
const KernelTable& kernels_v4();

}  // namespace carom
