// The geometry step: from contact definitions to constraint rows, at any displacement.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/topology.hpp"
#include "rows/constraint_rows.hpp"
#include "rows/response.hpp"
#include "rows/row_history.hpp"

namespace carom {

/// A row that penetrates in the initial state.
struct Penetration {
  Index slot = -1;
  Index contact = -1;  ///< index in Model::contacts
  Vec3 position{};
  double depth = 0.0;    ///< - gap, positive
  double rounded = 0.0;  ///< how much of it is the rounding of edges alone (ConstraintRows::rounded)
};

/// The past on which rows depend beside the positions: the history of the slots (empty: nothing was behind a facet),
/// which cells there are (null: all), and for laws of friction what pressed (null: nothing) and how it moved, at a
/// time.
struct ContactPast {
  std::span<const RowHistory> history{};
  std::shared_ptr<const Topology> topology{};
  const ContactResponse* pressed = nullptr;
  std::span<const double> velocity{};
  double time = 0.0;
};

/// Makes the rows of all contacts of a model:
/// - interface cells: four rows per cell (interface_rows.hpp);
/// - obstacles: one row per node with the area it stands for, or 1 per node (obstacle_rows.hpp);
/// - pairs: see PairMethod and pair_rows.hpp, face_rows.hpp;
/// - stops: one row per node, measure 1;
/// - ties: one bond per slave node that is tied (tie_rows.hpp);
/// - after them, linear equations: one bond each (equation_rows.hpp).
/// Every contact has a fixed number of histories (slots): one per Gauss point of an interface, per node of an obstacle
/// or a stop, per slave node of a pair (and master node, in two passes). Rows stand in the order of their slots; slots
/// that are far from touching may have none.
class ContactGeometry {
 public:
  /// Throws std::invalid_argument naming the contact (and the cell) where an interface cell is not of zero thickness or
  /// the kinds of facets of a pair cannot meet. The model must outlive the object.
  explicit ContactGeometry(const Model& model);
  ~ContactGeometry();
  ContactGeometry(ContactGeometry&&) noexcept;

  /// Number of entries of State::contact; the same as long as the topology is.
  std::size_t slots(const std::shared_ptr<const Topology>& topology = nullptr) const;
  /// Largest coordinate that gaps of rows that move are differences of; 0 where all rows are fixed.
  double reach() const;
  /// Largest distance of a node from the middle of all, along an axis.
  double extent() const;
  /// True when the rows are the same at every displacement.
  bool is_fixed() const;
  /// The rows that are bonds, which are the same at every displacement; in the order that they have among all rows.
  const ConstraintRows& bonds() const;
  /// The bonds that are linear equations.
  const ConstraintRows& equations() const;
  /// Rows at displacement u, when the step began at u_begin (so that what crossed a facet in between is found) with the
  /// past given (so that what was behind a facet stays there). Where is_fixed, always the same object while the
  /// topology is the same. Search lists are kept from call to call, but the rows do not depend on them, nor on the
  /// number of threads. Not to be called from two threads at once. Contacts whose rows are not fixed have none when a
  /// displacement of their nodes is not finite.
  std::shared_ptr<const ConstraintRows> rows_at(std::span<const double> u_begin, std::span<const double> u,
                                                const ContactPast& past = {}) const;

  /// The springs that resist motion beside the rows that rows_at gave last, as rows (RowMaker::append_stiffness).
  ConstraintRows stiffness_rows() const;

  /// The rows that penetrate at displacement u, worst first. Offsets of set_initial count.
  std::vector<Penetration> initial_penetrations(std::span<const double> u) const;
  /// The histories with which a run begins at displacement u: a row that is behind a facet there is taken to have been
  /// behind it before.
  std::vector<RowHistory> first_history(std::span<const double> u) const;
  /// The history of the slots of the topology `after` at displacement u, from `before` and its rows there. A slot is
  /// found again by its nodes and facets; nodes that are new on a surface were behind nothing. No row becomes deeper by
  /// the change: RowHistory::offset takes up the depth that it would gain.
  std::vector<RowHistory> carried_history(const ContactPast& before, const ConstraintRows& rows,
                                          std::span<const double> u,
                                          const std::shared_ptr<const Topology>& after) const;
  /// Takes the penetrations at displacement u as free of strain in the contacts that say so
  /// (InitialPenetration::strain_free_offset), and in all others what is the rounding of edges alone: their gaps are
  /// subtracted from the slots' gaps from here on. Open slots have no offset.
  void set_initial(std::span<const double> u);

  /// A row's contact and place, for messages: 'contact "faces", node 12 at (0.1, 0, 0.2)'.
  std::string describe(const ConstraintRows& rows, std::size_t r) const;
  /// Notes for the log: facets that were turned, and what else was noticed.
  const std::vector<std::string>& notes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
