// Can the numbers be trusted?
#pragma once

#include <cstdint>
#include <vector>

#include "energy/ledger.hpp"
#include "math/vec3.hpp"
#include "output/summary.hpp"

namespace carom {

/// Largest errors over a run, collected step by step, each relative to what it is an error of.
class RunMonitor {
 public:
  /// Which components of momentum are balanced: all, or along y alone (axisymmetric parts).
  enum class Momenta : std::uint8_t { all, axial };
  /// What errors are judged by beside the ledger.
  struct Bodies {
    double mass = 0.0;         ///< of all parts
    double rest_energy = 0.0;  ///< energies below cannot be told from rounding: the least scale of all energies
    Momenta momenta = Momenta::all;
  };
  /// One stage: Stage::reversible_energy(), whether it has no inertia, whether its steps are explicit, and h^2 / 8 a.Ma
  /// at its beginning: what schemes keep beside T + V, and may turn into it. Loads that are put on at once leave it far
  /// above what they have done after a step or two.
  struct StageKind {
    double reversible = 1.0;
    bool is_static = false;
    bool is_explicit = false;
    double of_accelerations = 0.0;
  };
  /// Limits of the items that depend on the schemes of the run.
  struct Limits {
    double angular_momentum = 1e-9, energy_gained = 0.005;
    double lent = 0.0;  ///< energy that steps with inertia may have lent at the end
  };
  RunMonitor(const EnergyLedger& ledger, const Bodies& bodies, const StageKind& stage)
      : ledger_(ledger), bodies_(bodies), stage_(stage) {}

  /// Another scheme goes on. springs: what a static stage has stored in springs of contact that the next stage does not
  /// have, which is another part of the path.
  void begin_stage(const StageKind& stage, double springs = 0.0);

  /// One step; load_impulse: magnitude of what the loads alone gave, which supports and contact may cancel; rounding:
  /// energy of its books that is rounding.
  void update(double load_impulse = 0.0, double rounding = 0.0);

  /// Why the run must stop now: mechanical energy grown by more than growth_limit of the larger of initial and supplied
  /// energy, or the balance of powers off by more than 5 % of it; "" while all is well. Growth that the scheme lends
  /// and takes back is none, unless it is for two steps in a row more than a stable step can lend.
  std::string alarm(double growth_limit) const;

  /// balance of powers, quadrature, energy gained, algorithmic, linear and angular momentum. What static stages book as
  /// quadrature and algorithmic is left out, since without inertia it says nothing about the step. Two figures count as
  /// energy gained, of which the larger is shown. One is the net energy that the quadrature has given and that exact
  /// contact has given, less the energy that implicit schemes have taken out beside it, since they book the jump of the
  /// velocities at a touch on either side. The other is the energy that the schemes have given by the end and cannot
  /// take back: explicit ones if it is more than 2 %, implicit ones if it is more than 0.5 % and than exact contact has
  /// taken.
  std::vector<VerdictItem> items(const Limits& limits) const;
  double linear_momentum_error() const;
  double angular_momentum_error() const;
  /// Imbalance now, relative to the energy scale.
  double relative_imbalance() const;

  /// What energies are compared with: the larger of initial and supplied energy, at least the rest energy, what the
  /// rounding of all steps is the energy balance's limit of, as where statics carry bodies on that nothing loads yet,
  /// and the work that contact has done in static stages, as where it pushes bodies apart that began in each other.
  double scale() const;

 private:
  template <class A>
  friend void fields(A& archive, Bodies& x) {
    archive("mass", x.mass);
    archive("rest_energy", x.rest_energy);
    archive("momenta", x.momenta);
  }
  template <class A>
  friend void fields(A& archive, StageKind& x) {
    archive("reversible", x.reversible);
    archive("is_static", x.is_static);
    archive("is_explicit", x.is_explicit);
    archive("of_accelerations", x.of_accelerations);
  }
  template <class A>
  friend void fields(A& archive, RunMonitor& x) {
    archive("bodies", x.bodies_);
    archive("stage", x.stage_);
    archive("before", x.before_);
    archive("static", x.static_);
    archive("contact_work", x.contact_work_);
    archive("lent", x.lent_);
    archive("lent_before", x.lent_before_);
    archive("imbalance", x.imbalance_);
    archive("quadrature", x.quadrature_);
    archive("algorithmic", x.algorithmic_);
    archive("gained", x.gained_);
    archive("implicit_loss", x.implicit_loss_);
    archive("explicit_loss", x.explicit_loss_);
    archive("linear_error", x.linear_error_);
    archive("angular_error", x.angular_error_);
    archive("linear_scale", x.linear_scale_);
    archive("angular_scale", x.angular_scale_);
    archive("load_impulse", x.load_impulse_);
    archive("rounding", x.rounding_);
    archive("steps", x.steps_);
  }

  double kept(double lent) const;
  double growth() const;
  EnergyTerms dynamic() const;

  const EnergyLedger& ledger_;
  Bodies bodies_;
  StageKind stage_;
  EnergyTerms before_{}, static_{};  ///< totals at the last update, and how much of them static stages have booked
  double contact_work_ = 0.0;        ///< largest that exact contact has done or taken in static stages
  double lent_ = 0.0, lent_before_ = 0.0;  ///< energy lent by the scheme, after this step and the one before
  double imbalance_ = 0.0, quadrature_ = 0.0, algorithmic_ = 0.0, gained_ = 0.0;  ///< largest so far, energies
  double implicit_loss_ = 0.0, explicit_loss_ = 0.0;  ///< algorithmic of implicit and static stages, of explicit ones
  double linear_error_ = 0.0, angular_error_ = 0.0;   ///< largest so far, momenta
  double linear_scale_ = 0.0, angular_scale_ = 0.0;   ///< largest momentum or impulse so far
  double load_impulse_ = 0.0;                         ///< sum of the magnitudes
  double rounding_ = 0.0;                             ///< of the steps
  double steps_ = 0.0;                                ///< their number
};

}  // namespace carom
