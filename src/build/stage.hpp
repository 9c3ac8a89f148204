// One stage of a run: a scheme, the mass and the supports it works with, and its steps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "casefile/case.hpp"
#include "schemes/driven_cells.hpp"
#include "schemes/scheme_table.hpp"
#include "schemes/stable_step.hpp"
#include "system/supports.hpp"
#include "system/system.hpp"

namespace carom {

/// What the stages of a run share. References only: the owner outlives the stages.
struct StageContext {
  const Case& given;
  const Mesh& mesh;
  const Model& model;
  const Solid& solid;
  const ContactGeometry& contact;
};

/// Not movable, since the system refers to its members. Building it finds every error of its sections that can be found
/// without stepping (CaseError).
class Stage {
 public:
  /// From `begin` to time.end. later_velocity: one flag per node, set where a velocity has been given that begins after
  /// statics; a free body that has one and no load of its own stays where it is in statics.
  Stage(const StageContext& context, const CaseScheme& scheme, const CaseTime& time, double begin,
        const std::vector<bool>& later_velocity);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  const CaseScheme& scheme() const { return scheme_; }
  const CaseTime& time() const { return time_; }
  const SchemeSettings& settings() const { return settings_; }
  const Mass& mass() const { return mass_; }
  const Supports& supports() const { return supports_; }
  const System& system() const { return system_; }
  const Model& model() const { return context_.model; }
  double begin() const { return begin_; }
  double end() const { return *time_.end; }
  /// The usual step and the number of steps of that length that reach the end exactly.
  double dt() const { return dt_; }
  long long steps() const { return steps_; }

  /// How many times the energy of the run the scheme may lend to the mechanical energy T + V and take back later.
  /// Central differences keep T + V - h^2/8 a.Ma (Krenk, Comput. Methods Appl. Mech. Eng. 195, 2006), so that T + V is
  /// at most 1 / (1 - (h / stable step)^2) times what they keep. Newmark with 2 beta >= gamma lends where loads jump; a
  /// Newmark that may become unstable is lent nothing.
  double reversible_energy() const { return reversible_energy_; }

  std::unique_ptr<Scheme> make_scheme() const;
  /// The cells of an explicit stage that supports strain, which bound the step that it chooses.
  const DrivenCells& driven() const { return driven_; }
  /// The stable step of the stage's scheme on its system at the start.
  StableStep stable() const;
  /// That of another scheme and enforcement on the same system.
  StableStep stable(double limit, EnforcementKind enforcement) const;
  /// True when the stable step of an explicit stage changes during the run.
  bool stable_step_changes() const;
  /// Re-estimates it.
  StableStepWatch watch_stable_step() const;
  /// What was done to the mass, for the log.
  struct MassNotes {
    std::vector<std::string> lines;
    double added = 0.0, added_share = 0.0;  ///< by mass scaling: mass, and over the total
    double moved_share = 0.0;               ///< from contact nodes by the modified mass, over the total
  };
  const MassNotes& mass_notes() const { return notes_; }
  /// "Newmark beta 0.28 gamma 0.55, consistent mass"
  std::string name() const;

 private:
  void hold_bodies_in_flight(const std::vector<bool>& later_velocity);
  void refuse_massless_contact() const;
  void refuse_driven_bonds() const;
  void refuse_history() const;
  void refuse_laws_without_tangent() const;
  void refuse_loads_without_hold() const;
  double chosen_step(const StableStep& stable) const;
  void choose_step();

  const StageContext context_;
  const CaseScheme& scheme_;
  const CaseTime& time_;
  double begin_;
  SchemeSettings settings_;
  MassNotes notes_;
  Mass mass_;
  std::vector<bool> has_mass_;  ///< by node: before contact nodes give theirs away
  Supports supports_;
  System system_;
  RestFrequencies rest_;
  DrivenCells driven_;
  double dt_ = 0.0;
  long long steps_ = 0;
  double reversible_energy_ = 0.0;
};

}  // namespace carom
