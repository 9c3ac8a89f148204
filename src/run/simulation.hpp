// The discrete problem of a case, ready to be stepped.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "casefile/case.hpp"
#include "contact/penalty.hpp"
#include "energy/ledger.hpp"
#include "model/model.hpp"
#include "schemes/scheme.hpp"
#include "schemes/stable_step.hpp"
#include "schemes/supports.hpp"
#include "solid/solid.hpp"

namespace carom {

/// Owns everything between the case and the scheme; not movable, since the parts refer to each other. Building it finds
/// every error that can be found without stepping (CaseError).
class Simulation {
 public:
  /// The case must outlive the simulation.
  explicit Simulation(const Case& given);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  const Case& given() const { return case_; }
  const Mesh& mesh() const { return *mesh_; }
  const Model& model() const { return model_; }
  const Solid& solid() const { return solid_; }
  const Mass& mass() const { return mass_; }
  const Penalty& contact() const { return contact_; }
  const System& system() const { return system_; }
  /// The stable step of central differences on this system; costs some hundred actions of the stiffness.
  StableStep stable() const { return stable_step(system_); }
  /// What was mended or noticed while building.
  const std::vector<std::string>& notes() const { return notes_; }

  /// The usual step and the number of steps of that length that reach the end exactly.
  double dt() const { return dt_; }
  long long steps() const { return steps_; }

  /// How many times the energy of the run the scheme may lend to the mechanical energy T + V and take back later.
  /// Central differences keep T + V - h^2/8 a.Ma (Krenk, Comput. Methods Appl. Mech. Eng. 195, 2006), so that T + V is
  /// at most 1 / (1 - (h / stable step)^2) times what they keep. Newmark with 2 beta >= gamma lends where loads jump; a
  /// Newmark that may become unstable is lent nothing.
  double reversible_energy() const { return reversible_energy_; }

  /// The state of the case's [[initial]] sections, before Scheme::start.
  State initial_state() const;
  std::unique_ptr<Scheme> make_scheme() const;
  /// "Newmark beta 0.28 gamma 0.55, consistent mass"
  std::string scheme_name() const;

 private:
  void refuse_ringing_motions() const;
  void refuse_massless_contact() const;
  void refuse_initial_penetration() const;
  void choose_step();

  const Case& case_;
  std::shared_ptr<const Mesh> mesh_;
  Model model_;
  Solid solid_;
  Mass mass_;
  std::vector<std::string> notes_;
  Penalty contact_;
  Supports supports_;
  System system_;
  double dt_ = 0.0;
  long long steps_ = 0;
  double reversible_energy_ = 0.0;
};

}  // namespace carom
