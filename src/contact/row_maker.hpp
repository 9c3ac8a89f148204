// Makers of the rows of one contact, and the functions that several of them use.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "contact/slot_keys.hpp"
#include "model/model.hpp"
#include "parallel/threads.hpp"
#include "rows/constraint_rows.hpp"
#include "rows/row_history.hpp"

namespace carom {

/// The positions of the nodes, X + u - origin. Only the entries of nodes that belong to a contact are filled.
struct ContactMotion {
  std::span<const Vec3> x_begin;
  std::span<const Vec3> x;
  std::span<const Vec3> displacement;  ///< x - x_begin
  std::span<const double> u;
  std::span<const RowHistory> history{};  ///< of all slots at x_begin; empty where there is none

  /// The facet that the slot was behind at x_begin, -1 when it was in front.
  Index behind(Index slot) const { return history.empty() ? -1 : history[static_cast<std::size_t>(slot)].facet; }
  /// The facets that `count` slots were behind, from the first slot on.
  std::vector<Index> behind(Index first_slot, std::size_t count) const {
    std::vector<Index> facets(history.empty() ? 0 : count);
    for (std::size_t i = 0; i < facets.size(); ++i) facets[i] = behind(first_slot + static_cast<Index>(i));
    return facets;
  }
};

/// Makes the rows of one contact. The rows do not depend on what a maker keeps between calls (search lists), which is
/// why append is const. Two threads must not call append of one maker at a time.
class RowMaker {
 public:
  virtual ~RowMaker() = default;
  /// The number of slots, which is the same while the topology is.
  virtual std::size_t slots() const = 0;
  /// Appends a key for each slot: the nodes that it belongs to.
  virtual void append_keys(SlotKeys& keys) const = 0;
  /// True when append gives the same rows at every displacement.
  virtual bool is_fixed() const = 0;
  /// Appends the rows at motion.x, in the order of their slots, which count from first_slot. The stored gap is the
  /// exact one at motion.x less (G u)_n.
  virtual void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const = 0;
  /// Appends the stiffness that the rows of the last append lack because their gaps are means: rows of springs eps_N
  /// without a force, for tangents alone.
  virtual void append_stiffness(ConstraintRows& /*rows*/) const {}
  /// Appends the nodes whose positions append() needs besides those of the contact's own facets.
  virtual void add_moving_nodes(std::vector<Index>& /*nodes*/) const {}
};

/// Rows that are made once and never change.
class FixedRows : public RowMaker {
 public:
  explicit FixedRows(ConstraintRows rows) : rows_(std::move(rows)) {}
  std::size_t slots() const override { return rows_.size(); }
  void append_keys(SlotKeys& keys) const override;
  bool is_fixed() const override { return true; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override;

 private:
  ConstraintRows rows_;
};

/// A maker that appends the rows of several makers, one after the other.
class MakersInOrder : public RowMaker {
 public:
  /// is_back: the value of ConstraintRows::is_back of all rows of this maker.
  void add(std::unique_ptr<RowMaker> maker, bool is_back = false) { makers_.push_back({std::move(maker), is_back}); }
  std::size_t slots() const override;
  void append_keys(SlotKeys& keys) const override;
  bool is_fixed() const override;
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override;
  void append_stiffness(ConstraintRows& rows) const override;
  void add_moving_nodes(std::vector<Index>& nodes) const override;

 private:
  struct Entry {
    std::unique_ptr<RowMaker> maker;
    bool is_back;
  };
  std::vector<Entry> makers_;
};

/// Collects the blocks of one side of a row, one per node, in the order of their first use.
class RowBlocks {
 public:
  /// Adds to the block of node n.
  void add(Index n, const Vec3& normal, const Vec3& tangent_1, const Vec3& tangent_2);
  std::size_t size() const { return entries_.size(); }
  /// Adds the blocks to the last row.
  void append_to(ConstraintRows& rows) const;

 private:
  std::vector<std::pair<Index, RowBlock>> entries_;
};

/// The law of a contact times the measure of a row. eps_T stays 0 where there is no friction.
RowLaw row_law(const ContactLaw& law, double measure);

/// The share that each node of a surface has in its measure (see Surface), in the reference configuration: the integral
/// of N_a dA; on a ring 2 pi L (2 x_a + x_b) / 6.
std::map<Index, double> nodal_measures(std::span<const Vec3> coordinates, const Surface& surface);

/// The mean over the facets of the square root of their area (solid) or of their length. It is 0 for points, and where
/// there are no facets.
double mean_facet_size(std::span<const Vec3> coordinates, std::span<const Facet> facets);

/// Completes the last row, whose gap was given at displacement u: subtracts (G u)_n from it and sets the slot.
void finish_row(ConstraintRows& rows, std::span<const double> u, Index slot);

/// Appends all rows of `from`, their slots moved by first_slot.
void append_rows(ConstraintRows& rows, const ConstraintRows& from, Index first_slot = 0);
/// The same with row r alone.
void append_row(ConstraintRows& rows, const ConstraintRows& from, std::size_t r);

/// Makes rows in parts, in threads, and keeps the memory of the parts.
class RowParts {
 public:
  /// Calls make(begin, end, rows_of_the_range) on ranges that cover [0, n), at the same time for different ranges, and
  /// appends what they made in the order of the ranges.
  template <class Make>
  void append(std::size_t n, ConstraintRows& rows, const Make& make) {
    constexpr std::size_t grain = 256;  // rows per task: some hundred microseconds of work
    parts_.resize((n + grain - 1) / grain);
    parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
      ConstraintRows& part = parts_[begin / grain];
      part.clear();
      make(begin, end, part);
    });
    for (const ConstraintRows& part : parts_) append_rows(rows, part);
  }

 private:
  std::vector<ConstraintRows> parts_;
};

}  // namespace carom
