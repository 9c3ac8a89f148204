// The compliance of rows, as exact contact within implicit stages asks for it.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "rows/delassus.hpp"
#include "state/state.hpp"
#include "system/system.hpp"

namespace carom {

/// Makes W = G A^-1 G^T of the rows in question, and knows the motions under forces on them as far as making W has
/// found these. Each implementation decides what it keeps from one W to the next.
class PortCompliance {
 public:
  virtual ~PortCompliance() = default;
  /// Says which rows, and the operator of which number (EffectiveSolver::operators_made), come next. Returns false when
  /// all that was made and chosen before belongs to others.
  virtual bool use(const std::shared_ptr<const ConstraintRows>& rows, std::size_t operator_number) = 0;
  /// Forgets all that was made, since the inverse has failed.
  virtual void forget() = 0;
  /// Goes back to what the memory at the beginning of the stage holds, and sets `chosen` to the rows that had been
  /// chosen by then. Returns true when either was something else.
  virtual bool go_on(const StageMemory& /*memory*/, std::vector<std::size_t>& /*chosen*/,
                     const InverseOperator& /*inverse*/) {
    return false;
  }
  /// Writes into the memory what go_on() of the next stage will read.
  virtual void leave(StageMemory& /*memory*/, std::span<const std::size_t> /*chosen*/) const {}
  /// Makes W of the rows listed in `acting`, of which entry i has counts[i] components. Throws TooManyRows.
  virtual Delassus make(const ConstraintRows& rows, std::span<const std::size_t> acting,
                        std::span<const std::size_t> counts, const InverseOperator& inverse) = 0;
  /// True when the last W was made of what add_node_motion() knows.
  virtual bool knows_nodes() const { return false; }
  /// y += A^-1 load on the nodes of the rows, for a load that acts on them.
  virtual void add_node_motion(std::span<const double> /*load*/, std::span<double> /*y*/) const {}
  /// True when the last W was made of columns and all of them are kept.
  virtual bool knows_columns() const = 0;
  /// y += A^-1 G^T force, force in the frames of the listed rows of the last W.
  virtual void add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force,
                           std::span<double> y) const = 0;
};

}  // namespace carom
