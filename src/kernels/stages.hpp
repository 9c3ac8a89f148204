// What a batch of cells goes through: gather and geometry, gradients, strains, the law (material/point_batch.hpp),
// stresses, integration and scatter.
#pragma once

#include "base/types.hpp"
#include "element/mode_moduli.hpp"

namespace carom {

/// Points of a cell, and numbers of its geometry per lane, at most.
inline constexpr int most_points = 27, most_geometry = 2600;

/// Neighbours and cells of a node's patch at most (solid/node_patches.hpp).
inline constexpr int most_neighbours = 95, most_patch_cells = 192;

/// Numbers of all hourglass modes of a cell at most, 4 modes and 3 directions; of those that are stabilised.
inline constexpr int most_hourglass = 12, most_stabilised = 3 * most_neighbours;

/// Cells of a batch at most.
inline constexpr int most_lanes = 8;

/// Of modes that yield or are viscous by themselves (kernels/hourglass_flow.hpp), in one step.
struct ModeFlow {
  double coefficient = 0.0, modulus = 0.0;
  bool is_viscous = false;
  double viscosity = 0.0;  ///< viscous force over the rate, kappa and the cell's length, over the length of the step
  bool is_over = false;    ///< PointBatch::is_over
};

/// What becomes of them, per lane; T is the force per volume.
struct ModeReturn {
  alignas(64) double T[most_hourglass * most_lanes], returned[most_hourglass * most_lanes];
  alignas(64) double stiffness[most_lanes], share[most_lanes], damper[most_lanes];
  alignas(64) double stored[most_lanes], lost[most_lanes], viscous[most_lanes];
};

struct ModeFlowStages {
  /// Of modes z; yield_stress null: they are elastic. `length` of the cells is asked for by viscous modes alone;
  /// `before` and `after` are what is remembered of the modes, or null.
  void (*give)(const double* geometry, const ModeFlow& flow, const double* z, const double* yield_stress,
               const double* length, const double* before, double* after, ModeReturn& out) = nullptr;
  /// dT of dz
  void (*change)(const double* geometry, const ModeReturn& modes, const double* dz, double* dT) = nullptr;
};

/// What hourglass modes that flow go through; all but the modes' shape and place is of stabilised cells alone
/// (element/stabilised.hpp). Modes q and forces T and Q are laid out as CellStages says, F, E and dH are those of the
/// cell's point (F and E null: small strain, C = 1), `plastic` is q_p, or null. The modes that enter the strain are
/// z = F^T q, of which z - C q_p is elastic.
struct ModeStages {
  void (*pull)(const double* geometry, const double* F, const double* q, double* z) = nullptr;
  /// The energy per volume, its derivatives T by z and S by E.
  void (*trial)(const double* geometry, const ModeModuli& moduli, const double* E, const double* z,
                const double* plastic, double* energy, double* T, double* S) = nullptr;
  /// The forces of the modes Q = V F (share T), and P += q (share T)^T; share null: 1.
  void (*push)(const double* geometry, const double* F, const double* q, const double* T, const double* share,
               double* Q, double* P) = nullptr;
  /// dz = F^T dq + dH^T q
  void (*pull_change)(const double* geometry, const double* F, const double* dH, const double* q, const double* dq,
                      double* dz) = nullptr;
  /// The changes of what `trial` gives.
  void (*change)(const double* geometry, const ModeModuli& moduli, const double* E, const double* dE, const double* z,
                 const double* dz, const double* plastic, double* energy, double* T, double* S) = nullptr;
  /// The changes of what `push` gives; P += them.
  void (*push_change)(const double* geometry, const double* F, const double* dH, const double* q, const double* dq,
                      const double* T, const double* dT, double* Q, double* P) = nullptr;
  /// What a cell remembers of modes that flow with its point: q_p, and 1 - share of the last step. At the beginning of
  /// a step that is q_p; once it is over, what q_p was at its beginning, and its share.
  void (*begin)(const double* geometry, const double* E, const double* z, const double* history, bool is_over,
                double* plastic, double* share) = nullptr;
  /// The same at the end: q_p += (1 - share) (C^-1 z - q_p), of modes that keep the elastic `share`.
  void (*flow)(const double* geometry, const double* E, const double* z, const double* plastic, const double* share,
               double* history) = nullptr;
  /// Of patches. Leaves of the cells of a patch, in every lane, those that are wanted: what comes after is their part.
  void (*keep_cells)(double* geometry, const unsigned char* wanted) = nullptr;
  /// P += factor / V sum_b Q_b (x) X_b: what the forces of the modes add to the stress, since q_b = u_b - H X_b.
  void (*relative)(const double* geometry, double factor, const double* Q, double* P) = nullptr;
};

/// The stages of one kind of cell over one number type. They work on buffers in structure of arrays: `geometry`, whose
/// first numbers are the weights [p lanes], and gradients and stresses [(9 p + 3 i + j) lanes].
struct CellStages {
  int nodes = 0, points = 0;
  int corners = 0;       ///< of patches: places of corners of their cells, which stand after the nodes' offsets
  int frame_offset = 0;  ///< of bars: where F at rest stands in the geometry; 0: it is 1
  /// The smallest Jacobian determinant at the points of the stiffness [lane].
  void (*smallest_jacobian)(const double* x, const Index* offset, double* smallest) = nullptr;
  /// Lumped masses of the nodes [a lanes] (element/cell_integrals.hpp).
  void (*lumped_mass)(const CellStages& own, const double* x, const Index* offset, double thickness, double density,
                      double* m) = nullptr;
  void (*prepare)(const CellStages& own, const double* x, const Index* offset, double thickness,
                  double* geometry) = nullptr;
  /// And of cells with hourglass modes how far these are deformed, q[(directions m + i) lanes] = gamma_ma u_ia.
  void (*gradients)(const double* geometry, const double* u, const Index* offset, double* gradient,
                    double* q) = nullptr;
  /// Adds to the nodes of the first `count` cells; of hourglass modes the forces Q, laid out as q.
  void (*add_forces)(const double* geometry, const double* stress, const double* Q, const Index* offset, int count,
                     double* f) = nullptr;
  /// Lengths (cell_length) of the cells displaced by u [lane]; null: one by one.
  void (*lengths)(const double* x, const double* u, const Index* offset, double* length) = nullptr;
  int modes = 0, directions = 0;                                 ///< hourglass modes; 0: the cell has none
  const double* (*stiffness)(const double* geometry) = nullptr;  ///< theirs, of coefficient x modulus = 1 [lane]
  /// Q = k q and the energy q.Q / 2 [lane] of elastic modes, k = modulus x stiffness.
  void (*elastic_modes)(const double* geometry, double modulus, const double* q, double* Q, double* energy) = nullptr;
  ModeFlowStages flow{};
  ModeStages stabilisation{};  ///< of cells that are stabilised, for which the three above are not, all of it

  /// Numbers of a cell's connectivity.
  int places() const { return nodes + corners; }
};

/// Kinematics over one number type. The frame is F at rest, one matrix; null: 1. A gradient buffer holds H on the way
/// in and, of finite strain, F on the way out.
struct PointStages {
  bool is_finite = false;
  /// H to F, and the strain: sym(frame^T H), or E = (F^T F - frame^T frame) / 2, not a number where det F <= 0.
  void (*strain)(int points, const double* frame, double* gradient, double* strain) = nullptr;
  /// P = frame S, or F S.
  void (*stress)(int points, const double* frame, const double* F, const double* S, double* P) = nullptr;
  /// dE = sym(frame^T dH), or sym(F^T dH).
  void (*strain_change)(int points, const double* frame, const double* F, const double* dH, double* dE) = nullptr;
  /// P = frame dS, or dH S + F dS. P may stand where dH does.
  void (*stress_change)(int points, const double* frame, const double* F, const double* dH, const double* S,
                        const double* dS, double* P) = nullptr;
  /// The Cauchy stress of the law's stress S at its strain E: S itself (bars: in space), or
  /// F S F^T / sqrt(det(1 + 2 E)); E has the lateral strains that the law has found.
  void (*cauchy)(int points, const double* frame, const double* F, const double* E, const double* S,
                 double* sigma) = nullptr;
};

/// Numbers of a point that mean dilatation remembers within a sweep.
inline constexpr int dilatation_memory = 24;

/// What cells under mean dilatation know of their volume: its mean, or a linear function of the parent coordinates of
/// QUAD8, of HEXA20 and HEXA27, of PENTA15 or of PYRA13 (kernels/mean_dilatation.hpp).
enum class VolumeField : unsigned char { mean, linear_square, linear_cube, linear_wedge, linear_pyramid };
inline constexpr int volume_fields = 5;

/// What stands between the kinematics and the law: strains on their way to the law, stresses on their way back. The
/// energy of a cell is the integral of W(E_bar), and what comes back is its derivative by E. `memory` has
/// dilatation_memory numbers per point and lane, filled by `strain` and read by the others.
struct DilatationStages {
  /// E to E_bar
  void (*strain)(int points, const double* weight, double* E, double* memory) = nullptr;
  /// S_bar to S
  void (*stress)(int points, const double* weight, double* memory, const double* E_bar, double* S) = nullptr;
  /// dE to dE_bar
  void (*strain_change)(int points, const double* weight, double* memory, const double* E_bar, double* dE) = nullptr;
  /// dS_bar to dS; after `stress` and `strain_change`
  void (*stress_change)(int points, const double* weight, const double* memory, const double* E_bar,
                        const double* dE_bar, double* dS) = nullptr;
  /// From the Cauchy stress of F S_bar F^T to that of F_bar S_bar F_bar^T.
  void (*cauchy)(int points, const double* memory, double* sigma) = nullptr;
};

/// The volume of a cell, for bulk viscosity (kernels/bulk_viscosity.hpp): V - V_0 and its change per lane, the least
/// stretch of the points less 1, and the derivative g = dJ/dE of the volume ratio J of a point by the strain that the
/// kinematics give, [(6 p + c) lanes].
struct BulkStages {
  void (*volume)(int points, const double* weight, const double* E, double* change, double* stretch,
                 double* g) = nullptr;
  void (*volume_change)(int points, const double* weight, const double* g, const double* dE, double* change) = nullptr;
  /// dg of dE
  void (*gradient_change)(int points, const double* g, const double* dE, double* dg) = nullptr;
  /// out += a b, a one number per lane and b six per point
  void (*add_scaled)(int points, const double* a, const double* b, double* out) = nullptr;
};

}  // namespace carom
