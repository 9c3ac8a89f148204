// Constraint rows: the one form in which every source of contact reaches every enforcement.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "model/options.hpp"
#include "model/own_contact_law.hpp"

namespace carom {

/// The part of G by which a row sees one node: a 3 x 3 block with the rows n, t_1, t_2.
using RowBlock = std::array<Vec3, 3>;

/// The forces that a row may bear (rows/admissible.hpp): those of unilateral contact with Coulomb friction; any at
/// all, as a tie does; any at all, and never by springs, as a linear equation does.
enum class AdmissibleSet : std::uint8_t { cone, bond, equation };

/// A table of pressure over depth, which the model holds, for a row of this measure. All are equal: which one a row has
/// follows from its contact.
struct RowPressure {
  const PressureTable* table = nullptr;
  double measure = 0.0;
  friend bool operator==(const RowPressure& /*a*/, const RowPressure& /*b*/) { return true; }
};

/// The law of one row, times its measure: force per length (eps_N, eps_T), force per velocity (damping). The normal
/// spring of the penalty is linear down to linear_depth and hardens below: at depth d
///   force eps_N (d + <d - d_0>^3 / d_0^2),  d_0 = linear_depth,
/// or it is that of a table, times the measure, whose largest slope is eps_N then.
struct RowLaw {
  double eps_N = 0.0;
  double eps_T = 0.0;
  double damping = 0.0;
  double mu = 0.0;           ///< Coulomb's coefficient
  double restitution = 0.0;  ///< Newton's coefficient
  DamperActs damper_acts = DamperActs::compression;
  AdmissibleSet set = AdmissibleSet::cone;
  double linear_depth = std::numeric_limits<double>::infinity();
  RowPressure own{};  ///< not in checkpoints: rows are made anew before they are asked

  /// Force, slope and energy of the normal spring at a depth d >= 0.
  double spring_force(double d) const {
    if (own.table != nullptr) return own.measure * own.table->pressure(d);
    return eps_N * d + hardening() * cubed(beyond(d));
  }
  double spring_slope(double d) const {
    if (own.table != nullptr) return own.measure * own.table->slope(d);
    return eps_N + 3.0 * hardening() * beyond(d) * beyond(d);
  }
  /// The slope that a stable step allows for: of a table, whose slope may jump within a step, the largest of all.
  double steepest_slope(double d) const { return own.table != nullptr ? eps_N : spring_slope(d); }
  double spring_energy(double d) const {
    if (own.table != nullptr) return own.measure * own.table->energy(d);
    return 0.5 * eps_N * d * d + 0.25 * hardening() * cubed(beyond(d)) * beyond(d);
  }
  /// How far d is beyond linear_depth, and the factor of its cube in the force.
  double beyond(double d) const { return d > linear_depth ? d - linear_depth : 0.0; }
  double hardening() const { return eps_N / (linear_depth * linear_depth); }

  friend bool operator==(const RowLaw&, const RowLaw&) = default;

 private:
  static double cubed(double x) { return x * x * x; }
};

template <class A>
void fields(A& archive, RowLaw& x) {
  archive("eps_N", x.eps_N);
  archive("eps_T", x.eps_T);
  archive("damping", x.damping);
  archive("mu", x.mu);
  archive("restitution", x.restitution);
  archive("damper_acts", x.damper_acts);
  archive("set", x.set);
  archive("linear_depth", x.linear_depth);
}

/// Rows of constraints, each with the set of forces that it admits. Row r sees the displacements of its nodes, in its
/// frame (normal, tangent_1, tangent_2), as
///   w = (G u)_r = sum over its nodes of block_a u_a,
/// and its gap is g_r(u) = gap_r + w_n (length; positive: open), exactly for fixed rows, to first order about the
/// displacement that they were made for otherwise. The normal points from the obstacle (or the other body) to the body
/// that the row's force acts on with a positive sign. Force s in the frame gives the nodal forces block_a^T s.
struct ConstraintRows {
  std::vector<Index> begin{0};  ///< nodes of row r are node[begin[r]] ... node[begin[r + 1] - 1]
  std::vector<Index> node;
  std::vector<RowBlock> block;
  std::vector<double> gap;  ///< at zero displacement
  std::vector<Vec3> normal, tangent_1, tangent_2;
  std::vector<Vec3> position;   ///< where the row acts, for messages, output and moments
  std::vector<double> reach;    ///< largest length that the gap is a difference of
  std::vector<double> measure;  ///< area that the row stands for, or 1 for a row that is a single node
  std::vector<RowLaw> law;
  std::vector<Index> source;    ///< index in Model::contacts; of equation k of the model -1 - k
  std::vector<Index> behind;    ///< how many of the row's last nodes belong to the other side: master or obstacle
  std::vector<bool> is_back;    ///< the row's positive side is not the contact's group but the other body (two passes)
  std::vector<double> allowed;  ///< added to the gap of rows that guard what means do not see; else 0
  std::vector<double> offset;   ///< <= 0: RowHistory::offset, taken from the gap
  std::vector<double> rounded;  ///< what going round the edges of the other surface has taken from the gap, >= 0
  std::vector<bool> has_entered;  ///< a part of what a mean stands for is behind, whatever its gap is
  std::vector<Index> facet;  ///< what the row meets: facet of the other surface, face of a box, 0 where there is one
  std::vector<Index> slot;   ///< entry of State::contact; at most one row per slot

  std::size_t size() const { return gap.size(); }
  /// Removes all rows and keeps the memory.
  void clear();

  /// Appends a row without nodes, whose slot is its own number; add_node or add_block then give it its nodes. The
  /// tangents are made from the normal.
  void add_row(double row_gap, const Vec3& row_normal, const Vec3& row_position, double row_measure,
               const RowLaw& row_law, Index row_source);
  /// Adds a node that the last row sees with the weight w in all three directions.
  void add_node(Index n, double w);
  /// Adds a node that the last row sees by a block of its own.
  void add_block(Index n, const RowBlock& b);
  /// Adds a node of the other side by its block. Where the last row sees that node already, the blocks are added up.
  void add_behind(Index n, const RowBlock& b);

  /// w = (G x)_r in the row's frame; x is a dof vector.
  Vec3 relative(std::size_t r, std::span<const double> x) const {
    Vec3 w{};
    for (auto k = static_cast<std::size_t>(begin[r]); k < static_cast<std::size_t>(begin[r + 1]); ++k) {
      const double* u = x.data() + 3 * static_cast<std::size_t>(node[k]);
      const RowBlock& b = block[k];
      for (std::size_t i = 0; i < 3; ++i) w[i] += b[i][0] * u[0] + b[i][1] * u[1] + b[i][2] * u[2];
    }
    return w;
  }
  /// g_r(x)
  double gap_at(std::size_t r, std::span<const double> x) const { return gap[r] + relative(r, x)[0]; }
  /// The largest error of (G x)_r that rounding may have made: 16 units of round-off of its terms.
  double rounding(std::size_t r, std::span<const double> x) const;
  /// The largest error of g_r(x) that rounding may have made, since its gap is a difference of lengths up to `reach`.
  double gap_rounding(std::size_t r, std::span<const double> x) const;
  /// True when the gap is not above what rounding makes of it over some thousand steps: 1024 units of round-off of
  /// reach, gap and displacement, 2e-13, and of `extent`, a length of the bodies. A body that rests or slides would
  /// else lift off for a step at every gap of 1e-17, and slip without friction; and one that has begun at the origin,
  /// where its gap is the difference of nothing, at one of 1e-25.
  bool is_closed(std::size_t r, std::span<const double> x, double extent = 0.0) const;
  /// Calls add(node, force on it) for G_r^T s, s being the row's force in its frame.
  template <class Add>
  void for_each_share(std::size_t r, const Vec3& s, const Add& add) const {
    for (auto k = static_cast<std::size_t>(begin[r]); k < static_cast<std::size_t>(begin[r + 1]); ++k) {
      const RowBlock& b = block[k];
      Vec3 share;
      for (std::size_t c = 0; c < 3; ++c) share[c] = s[0] * b[0][c] + s[1] * b[1][c] + s[2] * b[2][c];
      add(node[k], share);
    }
  }
  /// f += G_r^T s
  void scatter(std::size_t r, const Vec3& s, std::span<double> f) const;
  /// The vector of space with components s in the row's frame, and back.
  Vec3 to_space(std::size_t r, const Vec3& s) const;
  Vec3 to_frame(std::size_t r, const Vec3& vector) const;

  friend bool operator==(const ConstraintRows&, const ConstraintRows&) = default;
};

template <class A>
void fields(A& archive, ConstraintRows& x) {
  archive("begin", x.begin);
  archive("node", x.node);
  archive("block", x.block);
  archive("gap", x.gap);
  archive("normal", x.normal);
  archive("tangent_1", x.tangent_1);
  archive("tangent_2", x.tangent_2);
  archive("position", x.position);
  archive("reach", x.reach);
  archive("measure", x.measure);
  archive("law", x.law);
  archive("source", x.source);
  archive("behind", x.behind);
  archive("is_back", x.is_back);
  archive("allowed", x.allowed);
  archive("offset", x.offset);
  archive("rounded", x.rounded);
  archive("has_entered", x.has_entered);
  archive("facet", x.facet);
  archive("slot", x.slot);
}

}  // namespace carom
