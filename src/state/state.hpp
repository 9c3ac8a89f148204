// State: everything that evolves, as a value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

#include "base/types.hpp"
#include "energy/ledger.hpp"
#include "model/topology.hpp"
#include "rows/response.hpp"

namespace carom {

/// What a support does at one instant, on its dof: reaction = inertia + internal - external - contact.
struct SupportForce {
  double reaction = 0.0;
  double inertia = 0.0;   ///< M a
  double momentum = 0.0;  ///< M v
  friend bool operator==(const SupportForce&, const SupportForce&) = default;
};
template <class A>
void fields(A& archive, SupportForce& x) {
  archive("reaction", x.reaction);
  archive("inertia", x.inertia);
  archive("momentum", x.momentum);
}

/// A dof vector that has no entries where nothing acts.
struct ExternalForce {
  std::vector<double> value;
  double operator[](std::size_t i) const { return value.empty() ? 0.0 : value[i]; }
  friend bool operator==(const ExternalForce&, const ExternalForce&) = default;
};

/// All forces at one instant. Where a dof is free, inertia = external - internal + contact up to the residual of the
/// solver; where it is prescribed, the support's reaction closes the equation.
struct Forces {
  std::vector<double> internal;  ///< a dof vector
  ExternalForce external;
  NodeForces contact;
  /// M a, a dof vector; none where a scheme makes nothing of it but what follows from the accelerations (central
  /// differences with a lumped mass).
  std::vector<double> inertia;
  std::vector<SupportForce> supports;  ///< one per entry of Supports::prescribed
  ContactResponse rows;
  EnergyTerms stored;                 ///< energies of the state that are functions of it: stored ones, and plastic
  std::vector<EnergyTerms> of_parts;  ///< by part of the case: of these what its cells have by themselves
  Momentum total_momentum;            ///< of the state
  double inertia_power = 0.0;         ///< a . M a
  friend bool operator==(const Forces&, const Forces&) = default;
};
template <class A>
void fields(A& archive, Forces& x) {
  archive("internal", x.internal);
  archive("external", x.external.value);
  archive("contact", x.contact);
  archive("inertia", x.inertia);
  archive("supports", x.supports);
  archive("rows", x.rows);
  archive("stored", x.stored);
  archive("of_parts", x.of_parts);
  archive("total_momentum", x.total_momentum);
  archive("inertia_power", x.inertia_power);
}

/// Contact at an instant within the last step, for schemes that solve for it there, and the weight of its forces in the
/// impulse of the step (0: there is none).
struct ContactWithin {
  double weight = 0.0;
  ContactResponse rows;
  std::vector<double> u;  ///< displacement at that instant
  friend bool operator==(const ContactWithin&, const ContactWithin&) = default;
};
template <class A>
void fields(A& archive, ContactWithin& x) {
  archive("weight", x.weight);
  archive("rows", x.rows);
  archive("u", x.u);
}

/// In which order something has grown that is kept from step to step because it is costly (compliances of rows and of
/// nodes). Rounding depends on that order, and so do the next bits; what has grown can be made anew from it.
struct Growth {
  std::vector<Index> entries;  ///< in the order in which they came
  std::vector<Index> calls;    ///< number of entries after each call that brought some
  friend bool operator==(const Growth&, const Growth&) = default;
};
template <class A>
void fields(A& archive, Growth& x) {
  archive("entries", x.entries);
  archive("calls", x.calls);
}

/// Where a tangent was made.
struct TangentPlace {
  double dt = 0.0;                ///< length of the step
  std::vector<double> u, points;  ///< displacement, and history of the points at the beginning of the step
  friend bool operator==(const TangentPlace&, const TangentPlace&) = default;
};

template <class A>
void fields(A& archive, TangentPlace& x) {
  archive("dt", x.dt);
  archive("u", x.u);
  archive("points", x.points);
}

/// What an implicit stage carries from step to step.
struct StageMemory {
  double m = 0.0, c = 0.0;         ///< of the operator m M + c K that the compliances belong to
  Growth solver_rows;              ///< of springs on fixed rows: 3 row + component
  Growth port_rows;                ///< of multipliers on fixed rows: 3 row + component
  std::vector<Index> chosen_rows;  ///< those that have taken part, in their order
  Growth port_nodes;               ///< of multipliers on rows that move
  Growth mass_nodes;               ///< of impulses, by the mass
  /// Of the first tangent that was not positive definite, which are L D L^T since; -1: none was.
  Index negative_eigenvalues = -1;
  /// Where the diagonal that preconditions the conjugate gradients was made (nonlinear bodies only), and the diagonal.
  std::vector<double> diagonal_at, diagonal;
  std::shared_ptr<const TangentPlace> grids_at;  ///< the tangent of the multigrid; none: that at rest
  friend bool operator==(const StageMemory& a, const StageMemory& b) {
    const auto values = [](const StageMemory& x) {
      return std::tie(x.m, x.c, x.solver_rows, x.port_rows, x.chosen_rows, x.port_nodes, x.mass_nodes,
                      x.negative_eigenvalues, x.diagonal_at, x.diagonal);
    };
    const bool both = a.grids_at && b.grids_at;
    return values(a) == values(b) && (a.grids_at == b.grids_at || (both && *a.grids_at == *b.grids_at));
  }
};
template <class A>
void fields(A& archive, StageMemory& x) {
  archive("m", x.m);
  archive("c", x.c);
  archive("solver_rows", x.solver_rows);
  archive("port_rows", x.port_rows);
  archive("chosen_rows", x.chosen_rows);
  archive("port_nodes", x.port_nodes);
  archive("mass_nodes", x.mass_nodes);
  archive("negative_eigenvalues", x.negative_eigenvalues);
  archive("diagonal_at", x.diagonal_at);
  archive("diagonal", x.diagonal);
  archive("grids_at", x.grids_at);
}

/// What the generalised-alpha family carries from step to step.
struct GeneralizedAlphaMemory {
  Momentum force;  ///< resultant of the forces, filtered like the accelerations
  friend bool operator==(const GeneralizedAlphaMemory&, const GeneralizedAlphaMemory&) = default;
};
template <class A>
void fields(A& archive, GeneralizedAlphaMemory& x) {
  archive("force", x.force);
}

/// What Hulbert and Chung's scheme carries.
struct HulbertChungMemory {
  std::vector<double> e;  ///< the scheme's accelerations
  Momentum force;         ///< resultant of the forces, filtered like them
  double dt = 0.0;        ///< the step that they are of
  friend bool operator==(const HulbertChungMemory&, const HulbertChungMemory&) = default;
};
template <class A>
void fields(A& archive, HulbertChungMemory& x) {
  archive("e", x.e);
  archive("force", x.force);
  archive("dt", x.dt);
}

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
template <class A>
void fields(A& archive, NonsmoothMemory::Acceleration& x) {
  archive("value", x.value);
  archive("force", x.force);
}
template <class A>
void fields(A& archive, NonsmoothMemory& x) {
  archive("a", x.a);
  archive("z", x.z);
}

/// What the semi-explicit modified mass carries.
struct ModifiedMassMemory {
  std::shared_ptr<const TangentPlace> factored_at;  ///< the stiffness of the contact nodes (nonlinear bodies only)
  std::vector<Index> rows;                          ///< fixed rows whose compliance is kept
  Growth nodes;                                     ///< contact nodes whose compliance is kept, where rows move
  friend bool operator==(const ModifiedMassMemory& a, const ModifiedMassMemory& b) {
    const bool both = a.factored_at && b.factored_at;
    return (a.factored_at == b.factored_at || (both && *a.factored_at == *b.factored_at)) && a.rows == b.rows &&
           a.nodes == b.nodes;
  }
};
template <class A>
void fields(A& archive, ModifiedMassMemory& x) {
  archive("factored_at", x.factored_at);
  archive("rows", x.rows);
  archive("nodes", x.nodes);
}

/// Made by Scheme::start.
using SchemeMemory =
    std::variant<std::monostate, GeneralizedAlphaMemory, HulbertChungMemory, NonsmoothMemory, ModifiedMassMemory>;

/// Everything that decides the next step. v and a are always those at time t. Copying a State is a checkpoint.
struct State {
  double t = 0.0;
  std::vector<double> q;                     ///< displacement
  std::vector<double> v;                     ///< velocity
  std::vector<double> a;                     ///< acceleration
  std::vector<double> points;                ///< history of the quadrature points (initial_history)
  std::vector<RowHistory> contact;           ///< one entry per contact slot (ConstraintRows::slot)
  Forces forces;                             ///< at time t
  ContactWithin within;                      ///< of the step that has led here
  SchemeMemory memory;                       ///< what else the scheme carries
  std::vector<StageMemory> stages;           ///< of the scheme's implicit stages, in their order
  std::shared_ptr<const Topology> topology;  ///< null: all cells are there

  /// By solid cell, 0 where it has gone; empty: all are there.
  std::span<const std::uint8_t> alive() const {
    return topology ? std::span<const std::uint8_t>(topology->alive) : std::span<const std::uint8_t>{};
  }

  friend bool operator==(const State& a, const State& b) {
    const auto values = [](const State& x) {
      return std::tie(x.t, x.q, x.v, x.a, x.points, x.contact, x.forces, x.within, x.memory, x.stages);
    };
    return values(a) == values(b) && std::ranges::equal(a.alive(), b.alive());
  }
};
template <class A>
void fields(A& archive, State& x) {
  archive("t", x.t);
  archive("q", x.q);
  archive("v", x.v);
  archive("a", x.a);
  archive("points", x.points);
  archive("contact", x.contact);
  archive("forces", x.forces);
  archive("within", x.within);
  archive("memory", x.memory);
  archive.each("stages", x.stages);
}

}  // namespace carom
