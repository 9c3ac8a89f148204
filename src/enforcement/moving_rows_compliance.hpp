// The compliance of rows that move over linear bodies.
#pragma once

#include "enforcement/node_compliance.hpp"
#include "enforcement/port_compliance.hpp"
#include "enforcement/renewed_compliance.hpp"

namespace carom {

/// Keeps the compliance of the rows' nodes for the run, so that the motion of these nodes costs no solve, and that of
/// all dofs one back-substitution. StageMemory says in which order it has grown. Where there would be too many nodes,
/// it makes the columns of the rows anew instead.
class MovingRowsCompliance final : public PortCompliance {
 public:
  /// node_capacity: see NodeCompliance.
  explicit MovingRowsCompliance(std::size_t dof_count, std::size_t node_capacity = NodeCompliance::most_nodes)
      : dof_count_(dof_count), nodes_(node_capacity), columns_(dof_count) {}

  bool use(const std::shared_ptr<const ConstraintRows>& rows, std::size_t operator_number) override;
  void forget() override;
  bool go_on(const StageMemory& memory, std::vector<std::size_t>& chosen, const InverseOperator& inverse) override;
  void leave(StageMemory& memory, std::span<const std::size_t> chosen) const override;
  Delassus make(const ConstraintRows& rows, std::span<const std::size_t> acting, std::span<const std::size_t> counts,
                const InverseOperator& inverse) override;
  bool knows_nodes() const override { return is_by_nodes_; }
  void add_node_motion(std::span<const double> load, std::span<double> y) const override;
  bool knows_columns() const override { return !is_by_nodes_ && columns_.knows_columns(); }
  void add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force, std::span<double> y) const override;

 private:
  std::size_t dof_count_;
  NodeCompliance nodes_;
  RenewedCompliance columns_;  ///< where there are too many nodes
  std::size_t operator_ = 0;   ///< number of the one that the nodes' compliance is of
  bool is_by_nodes_ = false;   ///< the last W
};

}  // namespace carom
