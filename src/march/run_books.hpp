// The books of a run: its energies and momenta since the start, and what they are off by.
#pragma once

#include <string>
#include <vector>

#include "build/simulation.hpp"
#include "energy/ledger.hpp"
#include "march/verdict.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// What velocities add that begin with a stage.
struct GivenMotion {
  double kinetic = 0.0;
  Momentum momentum{};
};
/// What the velocities of the state have more than those before, by the mass of the stage.
GivenMotion given_motion(const Stage& stage, const State& state, const std::vector<double>& v_before);

/// Takes down in the ledger what a run does, and judges it. Not movable, since the monitor refers to the ledger.
class RunBooks {
 public:
  /// From the state on that the first stage begins with, or, before a checkpoint comes in, for any stage. rest: the
  /// energy that cannot be told from rounding (rest_energy). The simulation outlives the books.
  RunBooks(const Simulation& simulation, const Stage& stage, const State& begin, double rest);
  RunBooks(const RunBooks&) = delete;
  RunBooks& operator=(const RunBooks&) = delete;

  /// Another stage goes on from this state. It may have another mass, and starts from accelerations of its own: what
  /// the stored energies jump by is the scheme's doing (ledger: algorithmic), what the momentum jumps by an impulse.
  /// What velocities that begin with the stage add is initial energy. Returns the jump of the stored energy.
  double begin_stage(const Stage& stage, const State& begin, const GivenMotion& given);
  /// A step of length dt that has led to this state.
  void add_step(const Stage& stage, const State& end, const StepReport& report, double dt);
  /// Cells have gone, and have left this state. They take what they have stored and spent with them, rows that are no
  /// more the energy of their springs: evaluated by themselves, so that the balance of powers sees what the bodies have
  /// lost otherwise.
  void add_eroded(const State& after, const EnergyTerms& stored_before, const SolidEnergies& gone);

  const EnergyLedger& ledger() const { return ledger_; }
  const RunMonitor& monitor() const { return monitor_; }
  /// Largest strain so far of the rigid bodies that turn.
  double body_strain() const { return body_strain_; }
  /// Why the run cannot go on after the last step; "" where it can.
  const std::string& alarm() const { return alarm_; }

 private:
  template <class A>
  friend void fields(A& archive, RunBooks& x) {
    archive("ledger", x.ledger_);
    archive("monitor", x.monitor_);
    archive("body_strain", x.body_strain_);
  }
  double load_impulse(const Stage& stage, const State& end, double dt) const;

  const Simulation& s_;
  EnergyLedger ledger_;
  RunMonitor monitor_;
  double body_strain_ = 0.0;
  std::string alarm_;
};

}  // namespace carom
