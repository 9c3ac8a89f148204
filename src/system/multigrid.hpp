// A multilevel preconditioner of implicit steps.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "linalg/cholesky.hpp"
#include "linalg/conjugate_gradients.hpp"
#include "parallel/entries.hpp"
#include "system/dof_spring.hpp"
#include "system/system.hpp"

namespace carom {

/// z = B r with B near to A^-1, A = m M + c K + G^T D G: one symmetric V-cycle (Briggs, Henson and McCormick, A
/// Multigrid Tutorial, 2nd ed., chapters 3 and 10) over the finite elements and the grids of background_grids. M is
/// lumped. Linear finite elements keep no matrix: their kernels are faster than one; others, whose tangents cost
/// several times as much, keep K in single precision. The grids have Galerkin's, A_l+1 = P^T A_l P, the first one
/// summed over the cells. Contact stands on every level as rows of its own, G_l+1 = G_l P, so that no matrix depends on
/// it but the last, which is factored. Smoothing is by Chebyshev polynomials in D^-1 A (Adams, Brezina, Hu and
/// Tuminaro, J. Comput. Phys. 188, 2003), D the diagonal, of contact as many times over as it has entries in a row:
/// then rows do not raise the largest eigenvalue. B is symmetric and positive definite; it is the same for any
/// number of threads and ranks. Ranks share the points of every level out but the last one's (system/held_points.hpp).
class Multigrid {
 public:
  explicit Multigrid(const System& system);

  /// A = m M + c K + springs between dofs and the ground, K being the tangent at `place`.
  void make(double m, double c, std::shared_ptr<const TangentPlace> place, const std::vector<DofSpring>& springs);
  /// Sets the part of A that contact adds, G^T D G. Keeps `rows`.
  void use(const std::shared_ptr<const ConstraintRows>& rows, const std::vector<RowTangent>& D);
  /// Who holds the nodes of the vectors.
  const Holding& nodes() const { return *levels_[0].points; }
  /// z = B r of what this rank holds. r and z are zero on fixed dofs. All ranks call it.
  void apply(std::span<const double> r, std::span<double> z);

  /// Corners of each grid.
  std::vector<std::size_t> sizes() const;

 private:
  struct Level {
    BlockMatrix A;  ///< on the finite elements K alone, if that
    std::vector<double> diagonal, inverse_diagonal;
    double top = 0.0;                            ///< bound of the eigenvalues of D^-1 A
    std::shared_ptr<const ConstraintRows> rows;  ///< of contact, where D acts
    std::vector<double> b, x, d, Ad;
    std::optional<Holding> points, restricted;  ///< who holds them, and who needs them for the next level

    EntryRange own() const { return own_share_of(points->size()); }
    Entries entries() const { return Entries(*points); }
  };

  void make_first_grid();
  void hold_points(std::size_t l);
  void make_diagonal(Level& level) const;
  void make_top(std::size_t l);
  void apply_fine(std::span<const double> x, std::span<double> y) const;
  void apply_level(std::size_t l, std::span<const double> x, std::span<double> y) const;
  void smooth(std::size_t l, bool is_start);
  void cycle(std::size_t l);
  void factor_last();

  const System& system_;
  std::vector<double> masses_;    ///< of the nodes, lumped
  std::vector<double> diagonal_;  ///< of K
  std::vector<Interpolation> P_;  ///< from level l + 1 to level l
  std::vector<Level> levels_;     ///< the finite elements first
  double m_ = 0.0, c_ = 0.0;
  std::shared_ptr<const TangentPlace> place_;  ///< where K is
  std::vector<DofSpring> springs_;
  std::shared_ptr<const ConstraintRows> rows_;  ///< of use()
  std::vector<RowTangent> D_;
  std::optional<Cholesky> last_;
};

}  // namespace carom
