// One set of coupled rows of the cone problem, as its solvers see it: motions, the natural map, sweeps.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"
#include "rows/delassus.hpp"

namespace carom::cone {

/// Numbers of rows that act on each other, in ascending order.
using RowList = std::vector<std::size_t>;

/// visit(entry) for the entries of a list, in threads: a visit costs a row of W.
template <class List, class Visit>
void each_of(const List& list, const Visit& visit) {
  parallel_for(list.size(), 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) visit(list[k]);
  });
}

/// The given problem and its present solution, with the diagonal of W at hand. The solvers work on the proximal problem
/// with
///   w = W r + b + rho D (r - centre),
/// D_i = the largest diagonal entry of W_ii (Rockafellar, SIAM J. Control Optim. 14, 1976). Its solution is that of the
/// given problem where r = centre; W + rho D is regular also where W is not.
class Problem {
 public:
  Problem(const Delassus& operator_W, std::span<const Vec3> given, std::span<const Admissible> sets,
          std::vector<Vec3>& force);

  /// Chooses the rows that the following calls are about.
  void select(const RowList& rows);
  const RowList& rows() const { return rows_; }
  const Vec3& force(std::size_t i) const { return r_[i]; }
  void set_force(std::size_t i, const Vec3& force);
  /// The forces of the rows, in their order.
  std::vector<Vec3> forces() const;
  void set_forces(const std::vector<Vec3>& forces);

  /// Makes the present forces of the rows the centre.
  void regularise(double strength);

  /// The motion w_i in the proximal problem.
  Vec3 motion(std::size_t i) const;
  /// The change of that motion with a change of the forces (one entry per row of W).
  Vec3 change_of_motion(std::size_t i, const std::vector<Vec3>& change) const;
  /// Largest violation of the natural map among the rows, as a motion, over scale(): of the given problem, and of the
  /// proximal one. Not finite entries count as infinite. The map: min(w_n, W_nn r_n), and W_tt (r_T - the projection of
  /// r_T - w_T / W_tt on the disc of radius mu r_n); of a bond w, but for components that nothing moves.
  double error() const;
  double proximal_error() const;
  /// Sum of squares of the violations of the proximal problem.
  double merit() const;
  /// Largest |b| and |W_ii r_i|, the latter counted up to a limit: forces that grow without end, since no force would
  /// do, must not make any motion look small.
  double scale() const;
  /// Largest |b|.
  double scale_of_given() const;
  /// The row that violates the given problem most.
  std::size_t worst() const;

  /// Diagonal block of the proximal problem.
  FrameBlock own_block(std::size_t i) const;
  double compliance(std::size_t i) const { return compliance_[i]; }
  std::size_t components(std::size_t i) const { return sets[i].components(); }
  bool is_bond(std::size_t i) const { return sets[i].is_bond(); }
  double mu(std::size_t i) const { return sets[i].mu; }
  /// True when the row's own forces move it; otherwise it gets none.
  bool gives_way(std::size_t i) const { return is_bond(i) ? compliance_[i] > 0.0 : own_[i][0] > 0.0; }
  double normal_compliance(std::size_t i) const { return own_[i][0]; }
  /// The unit of a row's forces that makes its diagonal of W 1.
  double unit(std::size_t i) const { return unit_[i]; }
  /// The compliance by which tangential forces are compared with motions.
  double tangential_compliance(std::size_t i) const { return tangential_[i]; }
  /// rho D_i
  double added(std::size_t i) const { return rho_ * compliance_[i]; }
  double strength() const { return rho_; }
  /// Sum of W_ij x_j over the normal entries (one x per row of W).
  double normal_motion(std::size_t i, std::span<const double> x) const;
  double normal_entry(std::size_t k) const { return W.normal_at(k); }
  double centre(std::size_t i) const { return centre_[i][0]; }

  /// One Gauss-Seidel sweep over the proximal problem, each row solved exactly for the forces of the others; forwards
  /// or backwards (Jourdan, Alart and Jean, Comput. Methods Appl. Mech. Eng. 155, 1998).
  void sweep(bool forwards);

  const Delassus& W;
  std::span<const Vec3> b;
  std::span<const Admissible> sets;

 private:
  void add_blocks(std::size_t i, std::size_t left_out, const std::vector<Vec3>& force, Vec3& w) const;
  Vec3 sum_of_blocks(std::size_t i, std::size_t left_out) const;
  const Vec3& given_motion(std::size_t i) const;
  double violation(std::size_t i, const Vec3& w) const;
  template <class Motion>
  double relative_error(const Motion& motion_of) const;

  std::vector<Vec3>& r_;
  RowList rows_;
  mutable std::vector<Vec3> w_;               ///< W r + b on the rows, unless they are stale
  mutable std::vector<double> normal_force_;  ///< those that w_ belongs to
  mutable bool is_stale_ = true;
  bool is_full_;                     ///< W has all blocks
  std::vector<double> normal_made_;  ///< where W has blocks, and no row tangents
  std::span<const double> normal_;   ///< normal entries of all blocks, where no row has tangents
  std::vector<FrameBlock> own_;
  std::vector<double> compliance_, tangential_, unit_;
  std::vector<Vec3> centre_;
  double rho_ = 0.0;
};

/// Rows that act on each other, directly or through others, so that each set is a problem of its own.
std::vector<RowList> coupled_sets(const Delassus& W);

}  // namespace carom::cone
