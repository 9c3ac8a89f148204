// The discrete problem of a case, ready to be stepped.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "build/initial_state.hpp"
#include "build/stage.hpp"
#include "casefile/case.hpp"
#include "contact/contact_geometry.hpp"
#include "energy/ledger.hpp"
#include "model/model.hpp"
#include "solid/solid.hpp"

namespace carom {

/// Owns everything between the case and the scheme; not movable, since the parts refer to each other. Building it finds
/// every error that can be found without stepping (CaseError).
class Simulation {
 public:
  explicit Simulation(Case given);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  const Case& given() const { return case_; }
  const Mesh& mesh() const { return *mesh_; }
  const Model& model() const { return model_; }
  const Solid& solid() const { return solid_; }
  const ContactGeometry& contact() const { return contact_; }
  /// What follows one another in time; at least one.
  const std::vector<std::unique_ptr<Stage>>& stages() const { return stages_; }
  const Stage& first() const { return *stages_.front(); }
  const Mass& mass() const { return first().mass(); }
  const System& system() const { return first().system(); }
  /// The usual step of the first stage.
  double dt() const { return first().dt(); }
  /// Steps of all stages.
  long long steps() const;
  /// End of the last stage.
  double end() const { return stages_.back()->end(); }
  /// The stable step of central differences on the first stage's system; costs some hundred actions of the stiffness.
  StableStep stable() const { return first().stable(2.0, EnforcementKind::penalty); }
  /// What was mended or noticed while building.
  const std::vector<std::string>& notes() const { return notes_; }

  /// What the case takes over of another run.
  const std::optional<TakenState>& taken() const { return taken_; }

  /// The state of the case's [initial_state] and [[initial]] sections, before Scheme::start; with the velocities that
  /// begin later, if the first stages are statics.
  State initial_state() const;
  /// Gives the nodes the velocities that begin with a stage (0: that of [scheme]); false when there are none. Where
  /// ranks share the nodes out: those that this one holds, and any others.
  bool begin_velocities(std::size_t stage, State& state, const Holding* shared = nullptr) const;

 private:
  std::vector<bool> later_velocities(std::size_t stage) const;
  std::size_t first_with_inertia() const;
  void refuse_velocities(const State& start) const;
  void refuse_surfaces_from_behind() const;
  void settle_initial_penetrations();
  void refuse_buried_facets(std::size_t c, const State& state) const;

  const Case case_;
  std::shared_ptr<const Mesh> mesh_;
  std::vector<std::string> notes_;
  std::optional<TakenState> taken_;
  Model model_;
  Solid solid_;
  ContactGeometry contact_;
  std::vector<std::unique_ptr<Stage>> stages_;
};

}  // namespace carom
