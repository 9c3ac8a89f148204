// The steps by which the cone problem is solved to round-off: active sets without friction, Newton with it.
#pragma once

#include <vector>

#include "linalg/reused_factors.hpp"
#include "rows/cone_problem.hpp"

namespace carom::cone {

/// From this number of unknowns on, systems of rows that all act on each other are not factored: active sets are solved
/// by conjugate gradients, Newton's systems by GMRES alone.
constexpr std::size_t dense_limit = 2000, newton_limit = 6000;

/// True when so few of the rows act on each other directly that their systems are solved by iterations, and where these
/// do not converge by sparse factors: rows on a lumped mass.
bool is_sparse(const Problem& p, const RowList& set);

/// The system of some active frictionless rows.
class ActiveSystem {
 public:
  bool solve(Problem& p, const std::vector<bool>& active);

 private:
  ReusedFactors factors_;
  bool resists_ = false;  ///< conjugate gradients have not converged
};

/// The number of systems that have been solved, and whether all signs are right at the end.
struct Pivots {
  int systems = 0;
  bool settled = false;
};

/// Frictionless rows, solved exactly by block principal pivoting (Judice and Pires, Comput. Oper. Res. 21, 1994): every
/// wrong row changes sides, as in the primal-dual active set, until that has not lowered their number for ten steps.
/// `active`: one entry per row, start and answer.
Pivots pivot(Problem& p, std::vector<bool>& active, ActiveSystem& system);

/// Solves frictionless rows by the projected Newton method (Bertsekas, SIAM J. Control Optim. 20, 1982) from the
/// present forces: each step goes towards the answer of the rows that press or are pressed on, cut at 0 and shortened
/// until the energy falls; where it does not, towards that of the rows that press, then with one more, until the first
/// pulls (Lawson and Hanson, Solving Least Squares Problems, 1974). Since the energy falls at every step, the method
/// never returns to an earlier point, however redundant the rows are.
Pivots descend(Problem& p, std::vector<bool>& active, ActiveSystem& system);

/// The linearised projection equations of the closed rows, as a linear system.
class NewtonSystem {
 public:
  /// One step of semismooth Newton from r; false if the system is singular.
  bool step(Problem& p);

 private:
  ReusedFactors factors_;
  bool resists_ = false;  ///< GMRES by diagonal blocks has not converged
};

/// Semismooth Newton on the natural map from r, each step shortened until the sum of squares falls, at most `most`
/// steps, until the proximal error is at most `tolerance`. r never gets worse. Returns the number of steps.
int newton(Problem& p, double tolerance, int most, NewtonSystem& system);

}  // namespace carom::cone
