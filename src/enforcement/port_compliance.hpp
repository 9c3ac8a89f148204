// How exact contact within implicit stages comes by the compliance of its rows.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "contact/delassus.hpp"
#include "state/state.hpp"
#include "system/system.hpp"

namespace carom {

/// W = G A^-1 G^T of the rows in question, and the motions of forces on them as far as making W has found them. What is
/// kept from one W to the next is a matter of the implementation.
class PortCompliance {
 public:
  virtual ~PortCompliance() = default;
  /// These rows and the operator of this number (EffectiveSolver::operators_made) come next. False when no W made
  /// before is theirs, and no row chosen before one of them.
  virtual bool use(const std::shared_ptr<const ConstraintRows>& rows, std::size_t operator_number) = 0;
  /// Forgets what an inverse has made that failed.
  virtual void forget() = 0;
  /// Becomes what the memory of the beginning of the stage holds, and `chosen` the rows that had been chosen by then.
  /// True when either was something else.
  virtual bool go_on(const StageMemory& /*memory*/, std::vector<std::size_t>& /*chosen*/,
                     const InverseOperator& /*inverse*/) {
    return false;
  }
  /// Writes to where the next stage looks for it what go_on() goes on from.
  virtual void leave(StageMemory& /*memory*/, std::span<const std::size_t> /*chosen*/) const {}
  /// W of the listed ones of the rows, of which row i has counts[i] components. Throws TooManyRows.
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

/// By columns that are kept, by nodes or anew, as the bodies and the rows of the system are.
std::unique_ptr<PortCompliance> make_port_compliance(const System& system);

}  // namespace carom
