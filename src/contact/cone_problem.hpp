// One set of coupled rows of the cone problem, as its solvers see it: motions, the natural map, sweeps.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "contact/delassus.hpp"

namespace carom::cone {

/// Rows that act on each other, in ascending order.
using RowList = std::vector<std::size_t>;

/// What is known and what is wanted, with the diagonal of W at hand. The solvers work on the problem with
///   w = W r + b + rho D (r - centre),
/// D_i = the largest diagonal entry of W_ii: the proximal one (Rockafellar, SIAM J. Control Optim. 14, 1976). Its
/// solution is that of the given problem where r = centre; W + rho D is regular also where W is not.
class Problem {
 public:
  Problem(const Delassus& operator_W, std::span<const Vec3> given, std::span<const double> friction,
          std::vector<Vec3>& force);

  /// Takes the present forces of the rows for the centre.
  void regularise(const RowList& rows, double strength);

  /// w_i of the proximal problem.
  Vec3 motion(std::size_t i) const;
  /// Largest violation of the natural map among the rows, as a motion, over scale(): of the given problem, and of the
  /// proximal one. Not finite entries count as infinite. The map: min(w_n, W_nn r_n), and W_tt (r_T - the projection of
  /// r_T - w_T / W_tt on the disc of radius mu r_n).
  double error(const RowList& rows) const;
  double proximal_error(const RowList& rows) const;
  /// Sum of squares of the violations of the proximal problem.
  double merit(const RowList& rows) const;
  /// Largest |b| and |W_ii r_i|, the latter counted up to a limit: forces that grow without end, since no force would
  /// do, must not make any motion look small.
  double scale(const RowList& rows) const;
  /// Largest |b|.
  double scale_of_given(const RowList& rows) const;
  /// The row that violates the given problem most.
  std::size_t worst(const RowList& rows) const;

  /// Diagonal block of the proximal problem.
  FrameBlock own_block(std::size_t i) const;
  double compliance(std::size_t i) const { return compliance_[i]; }
  double normal_compliance(std::size_t i) const { return own_[i][0]; }
  /// Compliance by which tangential forces are compared with motions.
  double tangential_compliance(std::size_t i) const { return tangential_[i]; }
  /// rho D_i
  double added(std::size_t i) const { return rho_ * compliance_[i]; }
  double strength() const { return rho_; }
  /// visit(j, normal entry of W_ij) for the rows j that act on i.
  template <class Visit>
  void each_normal(std::size_t i, const Visit& visit) const {
    for (std::size_t k = W.begin[i]; k < W.begin[i + 1]; ++k)
      visit(W.column[k], normal_.empty() ? W.block[k][0] : normal_[k]);
  }
  double centre(std::size_t i) const { return centre_[i][0]; }

  /// r of the rows, in their order.
  std::vector<Vec3> forces(const RowList& rows) const;
  /// One Gauss-Seidel sweep over the proximal problem, each row solved exactly for the forces of the others; forwards
  /// or backwards (Jourdan, Alart and Jean, Comput. Methods Appl. Mech. Eng. 155, 1998).
  void sweep(const RowList& rows, bool forwards);

  const Delassus& W;
  std::span<const Vec3> b;
  std::span<const double> mu;
  std::vector<Vec3>& r;

 private:
  Vec3 sum_of_blocks(std::size_t i, std::size_t left_out) const;
  double violation(std::size_t i, const Vec3& w) const;
  template <class Motion>
  double relative_error(const RowList& rows, const Motion& motion_of) const;

  std::vector<double> normal_;  ///< normal entries of all blocks, where there is no friction
  std::vector<FrameBlock> own_;
  std::vector<double> compliance_, tangential_;
  std::vector<Vec3> centre_;
  double rho_ = 0.0;
};

/// Rows that act on each other, directly or through others, so that each set is a problem of its own.
std::vector<RowList> coupled_sets(const Delassus& W);

}  // namespace carom::cone
