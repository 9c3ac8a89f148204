// The semi-discrete system M a = f - F(u) + contact + reactions, its forces at one instant, and the books of one step.
#pragma once

#include <span>
#include <vector>

#include "contact/contact_geometry.hpp"
#include "energy/ledger.hpp"
#include "math/vec3.hpp"
#include "rows/penalty.hpp"
#include "solid/solid.hpp"
#include "state/state.hpp"
#include "system/supports.hpp"

namespace carom {

/// All that a scheme steps, as references: the owner outlives the scheme.
struct System {
  const Mesh& mesh;
  const Solid& solid;
  const Mass& mass;
  const ContactGeometry& contact;
  const Supports& supports;
};

/// The step of length dt that begins at the state, as the bodies ask for it; and the past of its contact rows.
inline PointStep step_from(const State& begin, double dt) {
  return {.dt = dt, .history = begin.points, .alive = begin.alive()};
}
inline ContactPast past_of(const State& begin) {
  return {begin.contact, begin.topology, begin.forces.rows.rows ? &begin.forces.rows : nullptr, begin.v, begin.t};
}

/// The step to evaluate the bodies with at a state before the first step. Where points remember something, a step has
/// ended there already, so that nothing flows any more.
PointStep start_step(double dt, std::span<const double> points, const State& state);

/// Evaluates the bodies at the end of a step, at displacement end.q, from the points' history at its beginning. Fills
/// their internal forces, the energies that they store and have dissipated, in all and by part, and the points'
/// history.
void evaluate_solid(const System& system, const PointStep& step, State& end);
/// Does what evaluate_solid does, and fills the external forces at end.t.
void evaluate_bodies(const System& system, const PointStep& step, State& end);
/// Fills the external forces at time t alone, of the nodes that ranks share out (null: of all).
void evaluate_loads(const System& system, double t, Forces& forces, JumpSide side = JumpSide::after,
                    const Holding* shared = nullptr);

/// Fills the forces that follow from the accelerations and velocities of the state: inertia and forces of the supports;
/// and with them the stored energies and the total momentum (moments by MomentArms). Precondition: the other forces are
/// there (evaluate_bodies).
void complete_forces(const System& system, State& state);
/// Does the same but for the inertia itself, with a lumped mass, where ranks share the nodes out. All ranks call it.
void complete_forces_without_inertia(const System& system, const Holding& nodes, State& state);
/// Fills the forces of the supports alone.
void complete_supports(const System& system, State& state);

/// rhs = f - F(u) + contact.
void force_sum(const Forces& forces, std::span<double> rhs);

/// Copies to the end of a step what the scheme carries, and clears State::within.
void carry_memory(const State& begin, State& end);
/// Does what carry_memory does, and copies displacement, velocity, acceleration and contact history to go on from.
void go_on_from(const State& begin, State& end);

/// The inertia M a, the forces of the supports, and a . M a at one instant, which balance the other forces.
struct Balance {
  explicit Balance(const Forces& forces)
      : inertia(forces.inertia), supports(forces.supports), inertia_power(forces.inertia_power) {}
  std::span<const double> inertia;
  std::span<const SupportForce> supports;
  double inertia_power;
};

/// Adds component c of a nodal force or momentum p at x, and its moment about the origin, to six sums.
inline void add_with_moment(const Vec3& x, std::size_t c, double p, double* sums) {
  const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
  sums[c] += p;
  sums[3 + d] += x[e] * p;  // (x cross p)_d = x_e p_c - x_c p_e
  sums[3 + e] -= x[d] * p;
}
/// Adds all three components p of a node at x, and their moment, to six sums.
inline void add_with_moment(const Vec3& x, const Vec3& p, double* sums) {
  const Vec3 moment = cross(x, p);
  for (std::size_t c = 0; c < 3; ++c) {
    sums[c] += p[c];
    sums[3 + c] += moment[c];
  }
}
/// The momentum that the six sums are.
Momentum momentum_from(const double* sums);

/// The arms of moments: nodes stand at X where all bodies are linear (small displacements; their internal forces
/// balance there), at X + (1 - w) u_0 + w u_1 where they are not.
class MomentArms {
 public:
  MomentArms(const System& system, std::span<const double> u) : MomentArms(system, u, u, 1.0) {}
  MomentArms(const System& system, std::span<const double> u_0, std::span<const double> u_1, double w)
      : X_(system.mesh.coordinates), u_0_(u_0.data()), u_1_(u_1.data()), w_(w), is_linear_(system.solid.is_linear()) {}

  Vec3 at(std::size_t node) const {
    Vec3 x = X_[node];
    if (is_linear_) return x;
    for (std::size_t c = 0; c < 3; ++c) x[c] += (1.0 - w_) * u_0_[3 * node + c] + w_ * u_1_[3 * node + c];
    return x;
  }

 private:
  const std::vector<Vec3>& X_;
  const double *u_0_, *u_1_;
  double w_;
  bool is_linear_;
};

/// Sums over the nodes from which the energies and momenta of a state follow: v.Mv, u.F (twice the energy of linear
/// bodies), a.Ma, momentum and its moment, in the order of parallel_sums.
class StateSums {
 public:
  static constexpr std::size_t count = 9;

  StateSums(const System& system, const State& state)
      : arms_(system, state.q), q_(state.q.data()), internal_(state.forces.internal.data()) {}

  void add(std::size_t node, const Vec3& v, const Vec3& Mv, const Vec3& a, const Vec3& Ma, double* sums) const {
    for (std::size_t c = 0; c < 3; ++c) {
      sums[0] += v[c] * Mv[c];
      sums[1] += q_[3 * node + c] * internal_[3 * node + c];
      sums[2] += a[c] * Ma[c];
    }
    add_with_moment(arms_.at(node), Mv, sums + 3);
  }
  /// Gives the sums to the forces of the state.
  static void give(const System& system, const double* sums, Forces& forces);

 private:
  MomentArms arms_;
  const double *q_, *internal_;
};

}  // namespace carom
