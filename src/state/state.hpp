// State: everything that evolves, as a value.
#pragma once

#include <variant>
#include <vector>

#include "base/types.hpp"
#include "contact/response.hpp"
#include "energy/ledger.hpp"

namespace carom {

/// All forces at one instant (dof vectors). Where a dof is free, inertia = external - internal + contact up to the
/// residual of the solver; where it is prescribed, reaction closes the equation.
struct Forces {
  std::vector<double> internal, external, contact, reaction;
  std::vector<double> inertia;   ///< M a
  std::vector<double> momentum;  ///< M v
  ContactResponse rows;
  EnergyTerms stored;          ///< stored energies of the state
  Momentum total_momentum;     ///< of the state
  double inertia_power = 0.0;  ///< a . M a
  friend bool operator==(const Forces&, const Forces&) = default;
};

/// Contact at an instant within the last step, for schemes that solve for it there, and the weight of its forces in the
/// impulse of the step (0: there is none).
struct ContactWithin {
  double weight = 0.0;
  ContactResponse rows;
  std::vector<double> u;  ///< displacement at that instant
  friend bool operator==(const ContactWithin&, const ContactWithin&) = default;
};

/// In which order something has grown that is kept from step to step because it is costly (compliances of rows and of
/// nodes). Rounding depends on that order, and so do the next bits; what has grown can be made anew from it.
struct Growth {
  std::vector<Index> entries;  ///< in the order in which they came
  std::vector<Index> calls;    ///< number of entries after each call that brought some
  friend bool operator==(const Growth&, const Growth&) = default;
};

/// What an implicit stage carries from step to step.
struct StageMemory {
  double m = 0.0, c = 0.0;         ///< of the operator m M + c K that the compliances belong to
  Growth solver_rows;              ///< of springs on fixed rows: 3 row + component
  Growth port_rows;                ///< of multipliers on fixed rows: 3 row + component
  std::vector<Index> chosen_rows;  ///< those that have taken part, in their order
  Growth port_nodes;               ///< of multipliers on rows that move
  Growth mass_nodes;               ///< of impulses, by the mass
  Index negative_eigenvalues =
      -1;  ///< of the first tangent that was not positive definite, -1: none was. L D L^T since
  /// Where the diagonal that preconditions the conjugate gradients was made (nonlinear bodies only), and the diagonal.
  std::vector<double> diagonal_at, diagonal;
  friend bool operator==(const StageMemory&, const StageMemory&) = default;
};

/// What the generalised-alpha family carries from step to step.
struct GeneralizedAlphaMemory {
  Momentum force;  ///< resultant of the forces, filtered like the accelerations
  friend bool operator==(const GeneralizedAlphaMemory&, const GeneralizedAlphaMemory&) = default;
};

/// What Hulbert and Chung's scheme carries.
struct HulbertChungMemory {
  std::vector<double> e;  ///< the scheme's accelerations
  Momentum force;         ///< resultant of the forces, filtered like them
  friend bool operator==(const HulbertChungMemory&, const HulbertChungMemory&) = default;
};

/// What the nonsmooth generalised-alpha scheme carries.
struct NonsmoothMemory {
  struct Acceleration {
    std::vector<double> value;
    Momentum force;  ///< resultant of M times it, as a force
    friend bool operator==(const Acceleration&, const Acceleration&) = default;
  };
  Acceleration a;  ///< algorithmic
  Acceleration z;  ///< smooth
  friend bool operator==(const NonsmoothMemory&, const NonsmoothMemory&) = default;
};

/// What the semi-explicit modified mass carries.
struct ModifiedMassMemory {
  std::vector<double> factored_at;  ///< displacement of the cells at the contact nodes (nonlinear bodies only)
  std::vector<Index> rows;          ///< fixed rows whose compliance is kept
  Growth nodes;                     ///< contact nodes whose compliance is kept, where rows move
  friend bool operator==(const ModifiedMassMemory&, const ModifiedMassMemory&) = default;
};

/// Made by Scheme::start.
using SchemeMemory =
    std::variant<std::monostate, GeneralizedAlphaMemory, HulbertChungMemory, NonsmoothMemory, ModifiedMassMemory>;

/// Everything that decides the next step. v and a are always those at time t. Copying a State is a checkpoint.
struct State {
  double t = 0.0;
  std::vector<double> q;            ///< displacement
  std::vector<double> v;            ///< velocity
  std::vector<double> a;            ///< acceleration
  std::vector<RowHistory> contact;  ///< one entry per contact slot (ConstraintRows::slot)
  Forces forces;                    ///< at time t
  ContactWithin within;             ///< of the step that has led here
  SchemeMemory memory;              ///< what else the scheme carries
  std::vector<StageMemory> stages;  ///< of the scheme's implicit stages, in their order

  friend bool operator==(const State&, const State&) = default;
};

}  // namespace carom
