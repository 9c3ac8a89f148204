// Constraint rows: the one form in which every source of contact reaches every enforcement.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Rows of unilateral constraints. Row r sees the relative displacement of its two sides,
///   d_r = sum over its nodes of weight_a u_a,
/// in the frame (normal, tangent_1, tangent_2): w = (n . d_r, t_1 . d_r, t_2 . d_r) = (G u)_r, and its gap is
///   g_r = gap_r + n . d_r   (length; positive: open).
/// The normal points from the obstacle (or the other body) to the body that the positive weights belong to.
struct ConstraintRows {
  std::vector<Index> begin{0};  ///< nodes of row r are node[begin[r]] ... node[begin[r + 1] - 1]
  std::vector<Index> node;
  std::vector<double> weight;
  std::vector<double> gap;  ///< at zero displacement
  std::vector<Vec3> normal, tangent_1, tangent_2;
  std::vector<Vec3> position;   ///< reference position, for messages and output
  std::vector<double> measure;  ///< area that the row stands for, or 1 for a row that is a single node
  std::vector<double> mu;       ///< Coulomb coefficient
  std::vector<Index> source;    ///< index in Model::contacts

  std::size_t size() const { return gap.size(); }

  /// Appends a row without nodes; add_node then gives it its weights. The tangents are made from the normal.
  void add_row(double row_gap, const Vec3& row_normal, const Vec3& row_position, double row_measure, double row_mu,
               Index row_source);
  void add_node(Index n, double w);

  /// w = (G x)_r in the row's frame; x is a dof vector.
  Vec3 relative(std::size_t r, std::span<const double> x) const;
  /// f += G_r^T s for the row's force s in its frame.
  void scatter(std::size_t r, const Vec3& s, std::span<double> f) const;
};

}  // namespace carom
