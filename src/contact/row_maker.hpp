// What makes the rows of one contact, and what the makers share.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "contact/constraint_rows.hpp"
#include "contact/row_history.hpp"
#include "model/model.hpp"
#include "parallel/threads.hpp"

namespace carom {

/// Where the nodes stand, X + u - origin. Only the entries of nodes that belong to a contact are filled.
struct ContactMotion {
  std::span<const Vec3> x_begin;
  std::span<const Vec3> x;
  std::span<const Vec3> displacement;  ///< x - x_begin
  std::span<const double> u;
  std::span<const RowHistory> history{};  ///< of all slots at x_begin; empty where there is none

  /// What the slot was behind at x_begin, -1 when it was in front.
  Index behind(Index slot) const { return history.empty() ? -1 : history[static_cast<std::size_t>(slot)].facet; }
  /// What `count` slots were behind, from the first on.
  std::vector<Index> behind(Index first_slot, std::size_t count) const {
    std::vector<Index> facets(history.empty() ? 0 : count);
    for (std::size_t i = 0; i < facets.size(); ++i) facets[i] = behind(first_slot + static_cast<Index>(i));
    return facets;
  }
};

/// Rows of one contact. Results do not depend on what a maker keeps between calls (search lists), which is why append
/// is const; it is not to be called on one maker from two threads.
class RowMaker {
 public:
  virtual ~RowMaker() = default;
  /// Number of histories; the same for a whole run.
  virtual std::size_t slots() const = 0;
  /// True when append gives the same rows at every displacement.
  virtual bool is_fixed() const = 0;
  /// Appends the rows at motion.x, in the order of their slots, which count from first_slot. The stored gap is the
  /// exact one at motion.x less (G u)_n.
  virtual void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const = 0;
  /// Appends rows of what stands against the bodies beside the rows of the last append, whose gaps are rows' means:
  /// springs eps_N without a force, for tangents alone.
  virtual void append_stiffness(ConstraintRows& /*rows*/) const {}
  /// Appends the nodes whose positions append asks for, besides those of the contact's own facets.
  virtual void add_moving_nodes(std::vector<Index>& /*nodes*/) const {}
};

/// Rows that never change, made once.
class FixedRows : public RowMaker {
 public:
  explicit FixedRows(ConstraintRows rows) : rows_(std::move(rows)) {}
  std::size_t slots() const override { return rows_.size(); }
  bool is_fixed() const override { return true; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override;

 private:
  ConstraintRows rows_;
};

/// The rows of several makers, one after the other.
class MakersInOrder : public RowMaker {
 public:
  /// is_back: of all its rows, ConstraintRows::is_back.
  void add(std::unique_ptr<RowMaker> maker, bool is_back = false) { makers_.push_back({std::move(maker), is_back}); }
  std::size_t slots() const override;
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

/// Blocks of one side of a row in the making, one per node, in the order of their first use.
class RowBlocks {
 public:
  /// Adds to the block of node n.
  void add(Index n, const Vec3& normal, const Vec3& tangent_1, const Vec3& tangent_2);
  std::size_t size() const { return entries_.size(); }
  /// Gives them to the last row.
  void append_to(ConstraintRows& rows) const;

 private:
  std::vector<std::pair<Index, RowBlock>> entries_;
};

/// The law of a contact times the measure of a row. Friction needs a stiffness only where there is friction.
RowLaw row_law(const ContactLaw& law, double measure);

/// Shares of the nodes of a surface in its measure (see Surface), in the reference configuration: integral of N_a dA;
/// on a ring 2 pi L (2 x_a + x_b) / 6.
std::map<Index, double> nodal_measures(std::span<const Vec3> coordinates, const Surface& surface);

/// Mean over the facets of the square root of their area (solid) or of their length; points have none, and no
/// facets none either.
double mean_facet_size(std::span<const Vec3> coordinates, std::span<const Facet> facets);

/// Completes the last row, whose gap was given at displacement u: takes (G u)_n off and sets the slot.
void finish_row(ConstraintRows& rows, std::span<const double> u, Index slot);

/// Appends all rows of `from`, their slots moved by first_slot.
void append_rows(ConstraintRows& rows, const ConstraintRows& from, Index first_slot = 0);

/// Rows that are made in parts, whose memory is kept.
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
