// How far a step may carry contact nodes towards what they may touch.
#pragma once

#include <optional>
#include <vector>

#include "model/model.hpp"
#include "rows/response.hpp"
#include "solid/solid.hpp"
#include "state/state.hpp"

namespace carom {

/// A row that is deep in the other body is lost to the search, and one that meets a spring deep has work done on it
/// that nobody sees. So rows of pairs and obstacles may close, within a step, to a depth of
///   allowed = 1/2 min(cell lengths at the row's nodes, half of the obstacle's thickness),
/// counted from the surface or from where the row began, whichever is deeper. Only what is near enough to have a row
/// counts, and only the motion along its normal: bodies fly and slide as fast as they like. Cells of interfaces and
/// stops have no far side and are left alone.
class MotionLimit {
 public:
  explicit MotionLimit(const Model& model);

  /// A row that is carried too far.
  struct Overrun {
    double fraction = 1.0;  ///< of the step: where the row is half as deep as is allowed
    double depth = 0.0;     ///< how far it is carried, in cells
    Index contact = -1;     ///< index in Model::contacts
    std::size_t row = 0;
  };
  /// The row for which a step of length h from `begin`, whose rows are given, has to be cut most at the velocity of the
  /// beginning, if any.
  std::optional<Overrun> foreseen(const State& begin, const ConstraintRows& rows, double h) const;
  /// The same of a step that has been made. Rows that carry a force at the end are taken to have gone on with their
  /// velocity of the beginning where that leads deeper: exact contact leaves no depth to see.
  std::optional<Overrun> overrun(const State& begin, const State& end, const ContactResponse& at_end) const;

 private:
  void judge(const ConstraintRows& rows, std::size_t r, double before, double after,
             std::optional<Overrun>& worst) const;
  double allowed(const ConstraintRows& rows, std::size_t r) const;

  std::shared_ptr<const std::vector<double>> length_;  ///< by node: the least of the cells there
  std::vector<double> most_;                           ///< by contact
  double least_;                                       ///< what any row that is limited may do
};

}  // namespace carom
