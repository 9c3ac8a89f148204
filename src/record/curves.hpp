// The curves of a run: one row of named numbers per finished step.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "build/section_mass.hpp"
#include "build/simulation.hpp"
#include "march/observer.hpp"
#include "record/contact_resultants.hpp"
#include "record/curve_table.hpp"
#include "record/field_values.hpp"
#include "record/part_sums.hpp"
#include "record/probe_place.hpp"
#include "record/turning_axes.hpp"
#include "solid/loads.hpp"

namespace carom {

/// energy.csv: ledger, Code_Aster's terms, momentum.
class EnergyCurves {
 public:
  EnergyCurves();
  void sample(const StepView& view);
  const CurveTable& table() const { return table_; }

 private:
  CurveTable table_;
};

/// contact.csv: for each place of a contact (ContactResultants) the resultant force, its impulse and its moment about
/// the moment_point; for each contact the largest penetration, closed rows, and how often it went from open everywhere
/// to closed somewhere; of an obstacle that moves the displacement and velocity of its centre, and where it turns its
/// angular velocity.
class ContactCurves {
 public:
  explicit ContactCurves(const Simulation& simulation);
  /// Resultants at this state; before the first step and after each one. Impulses are those that the scheme has
  /// exerted, by its own weights.
  void sample(const StepView& view);
  const CurveTable& table() const { return table_; }
  /// Columns of the forces and moments of a contact.
  std::vector<std::string> resultants(std::size_t contact) const;

 private:
  template <class A>
  friend void fields(A& archive, ContactCurves& x) {
    archive("row", x.table_.row);
    archive("force", x.force_);
    archive("impulse", x.impulse_);
    archive("closed", x.closed_);
    archive("closings", x.closings_);
  }

  void add_impulses(const StepView& view, const std::vector<ContactResultant>& now);
  void add_motion(std::size_t contact, const State& state);

  const Model& model_;
  const Solid& solid_;
  std::size_t contacts_;
  ContactResultants resultants_;
  CurveTable table_;
  std::vector<Vec3> force_, impulse_;  ///< of each resultant, so far
  std::vector<double> closed_, closings_;
};

/// A force and its moment.
struct Wrench {
  Vec3 force{}, moment{};
};

/// probes.csv: means of fields over the probes' nodes and cells; section forces: what the cells on the probe's side
/// pull the section with, that is minus their internal force on its nodes, minus the inertia of their share of these
/// nodes and plus its weight; the reactions of what holds or moves nodes, with their moment about the probe's reference
/// position; accelerations along axes that turn with the body; and sums over parts.
class ProbeCurves {
 public:
  /// parts: sampled before sample(). Throws CaseError as place_probe, across_section and PartSums do.
  ProbeCurves(const Simulation& simulation, const CurveTable& parts);
  void sample(FieldsNow& now);
  /// The cells whose stresses sample() looks at, increasing; none where it may look at others.
  const std::vector<Index>& stressed_cells() const { return stressed_cells_; }
  /// On several ranks, asks for what sample() looks at.
  void complete(const StepView& view) const;
  const CurveTable& table() const { return table_; }
  /// Mean reference position of each probe, in the order of Case::probes.
  const std::vector<Vec3>& positions() const { return positions_; }
  /// Which node stands for each point, and how far from it.
  const std::vector<std::string>& notes() const { return notes_; }
  const std::vector<Index>& nodes(std::size_t probe) const { return probes_[probe].nodes; }
  /// Names of the columns of a probe.
  const std::vector<std::string>& columns(std::size_t probe) const { return probes_[probe].columns; }

 private:
  struct Probe {
    std::vector<Index> nodes;
    std::vector<Index> held;           ///< increasing: those whose reactions it sums
    std::vector<Index> cells;          ///< positions in Solid::cells() of the cells that touch the nodes
    std::vector<Index> section_cells;  ///< those of them on the probe's side
    SectionMass section_mass;
    TurningAxes axes;
    PartSums part;
    Vec3 position{};  ///< mean reference position
    std::vector<std::string> quantities;
    std::vector<std::string> columns{};
  };
  void find_stressed_cells();
  void note_node(const CaseProbe& given, const ProbePlace& place);
  void find_cells(const CaseProbe& given, const Vec3& position, Probe& probe) const;
  void find_held(const CaseProbe& given, Probe& probe) const;
  Vec3 section_force(const Probe& probe, const StepView& view);
  Wrench reaction(const Probe& probe, const StepView& view) const;
  Vec3 reaction_force(const Probe& probe, const StepView& view) { return reaction(probe, view).force; }
  Vec3 reaction_moment(const Probe& probe, const StepView& view) { return reaction(probe, view).moment; }
  Vec3 local_acceleration(const Probe& probe, const StepView& view);
  void add_nodes(const CaseProbe& given, Probe& probe);
  void add_columns(const CaseProbe& given, Probe& probe);
  void append(const std::string& quantity, const Probe& probe, FieldsNow& now);
  void append_mean(const std::string& field, const Probe& probe, FieldsNow& now);

  const Simulation& simulation_;
  std::vector<Probe> probes_;
  std::vector<Vec3> positions_;
  std::vector<std::string> notes_;
  CurveTable table_;
  std::vector<Index> stressed_cells_;
  std::vector<double> section_work_;
  std::vector<Gravity> gravity_;
};

}  // namespace carom
