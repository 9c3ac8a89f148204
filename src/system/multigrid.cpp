#include "system/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/largest_eigenvalue.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "system/background_grids.hpp"
#include "system/held_points.hpp"

namespace carom {
namespace {

constexpr std::size_t enough_corners = 150;  // of the last grid, whose matrix is factored
constexpr int degree = 2;                    // of the polynomials
constexpr double damped = 8.0;               // they smooth eigenvalues from the largest down to this part of it

/// G without the fixed components of nodes, whose bits are set.
ConstraintRows without(const ConstraintRows& rows, std::span<const std::uint8_t> fixed) {
  ConstraintRows out;
  out.begin = rows.begin;
  out.node = rows.node;
  out.block = rows.block;
  out.gap = rows.gap;
  for (std::size_t k = 0; k < out.node.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      if ((fixed[at(out.node[k])] >> c & 1U) != 0)
        for (Vec3& line : out.block[k]) line[c] = 0.0;
  return out;
}

/// G P: the rows as the points of a coarser level see them.
ConstraintRows project(const ConstraintRows& rows, const Interpolation& P) {
  ConstraintRows out;
  std::vector<Index> points;
  std::vector<RowBlock> blocks;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    points.clear();
    blocks.clear();
    for (std::size_t k = at(rows.begin[r]); k < at(rows.begin[r + 1]); ++k) {
      const auto coarse = P.coarse_of(at(rows.node[k]));
      const auto weights = P.weights_of(at(rows.node[k]));
      for (std::size_t p = 0; p < coarse.size(); ++p) {
        const std::size_t place = at(std::find(points.begin(), points.end(), coarse[p]) - points.begin());
        if (place == points.size()) {
          points.push_back(coarse[p]);
          blocks.emplace_back();
        }
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t c = 0; c < 3; ++c) blocks[place][i][c] += weights[p] * rows.block[k][i][c];
      }
    }
    out.node.insert(out.node.end(), points.begin(), points.end());
    out.block.insert(out.block.end(), blocks.begin(), blocks.end());
    out.begin.push_back(static_cast<Index>(out.node.size()));
    out.gap.push_back(0.0);
  }
  return out;
}

/// G^T D G on the points of a level.
BlockMatrix matrix_of(const ConstraintRows& rows, const std::vector<RowTangent>& D, std::size_t points) {
  const auto nodes_of = [&](std::size_t r) {
    std::vector<Index> nodes(rows.node.begin() + rows.begin[r], rows.node.begin() + rows.begin[r + 1]);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  PointGraph graph(points);
  for (std::size_t r = 0; r < D.size(); ++r)
    if (acts(D[r])) graph.couple(nodes_of(r));
  BlockMatrix out = graph.matrix();
  for (std::size_t r = 0; r < D.size(); ++r) {
    if (!acts(D[r])) continue;
    for (auto p = at(rows.begin[r]); p < at(rows.begin[r + 1]); ++p)
      for (auto q = at(rows.begin[r]); q < at(rows.begin[r + 1]); ++q) {
        double* sum = out.block(rows.node[p], rows.node[q]);
        for (std::size_t j = 0; j < 3; ++j) {
          const RowBlock& b = rows.block[q];
          const Vec3 force = product(D[r], {b[0][j], b[1][j], b[2][j]});
          for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) sum[3 * i + j] += rows.block[p][k][i] * force[k];
        }
      }
  }
  return out;
}

/// The step that ends at the place.
PointStep step_to(const TangentPlace& place, const Holding& nodes) {
  return {.dt = place.dt, .history = place.points, .nodes = &nodes};
}

}  // namespace

Multigrid::Multigrid(const System& system)
    : system_(system),
      masses_(system.solid.mass(MassKind::lumped).node_diagonal()),
      P_(background_grids(system.mesh, system.solid, system.supports.fixed_components(), enough_corners)),
      levels_(P_.size() + 1) {
  levels_[0].points = system.solid.shared_nodes();
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const std::size_t n = l == 0 ? system.solid.dof_count() : 3 * P_[l - 1].coarse_points();
    for (std::vector<double>* v : {&levels_[l].b, &levels_[l].x, &levels_[l].d, &levels_[l].Ad}) v->assign(n, 0.0);
  }
}

std::vector<std::size_t> Multigrid::sizes() const {
  std::vector<std::size_t> out;
  for (const Interpolation& P : P_) out.push_back(P.coarse_points());
  return out;
}

void Multigrid::make(double m, double c, std::shared_ptr<const TangentPlace> place,
                     const std::vector<DofSpring>& springs) {
  m_ = m;
  c_ = c;
  springs_ = springs;
  place_ = std::move(place);
  make_first_grid();
  std::vector<double>& fine = levels_[0].diagonal;
  fine.resize(diagonal_.size());
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = m * masses_[i / 3] + c * diagonal_[i];
  for (const DofSpring& spring : springs_) fine[spring.dof] += spring.stiffness;
  // Nothing resists a dof without a diagonal entry: any finite number serves it.
  const double most = *std::max_element(fine.begin(), fine.end());
  const std::vector<bool>& fixed = system_.supports.fixed();
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = fixed[i] ? 0.0 : (fine[i] > 0.0 ? fine[i] : most);
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    levels_[l].diagonal = levels_[l].A.diagonal();
    hold_points(l);
    if (l + 1 == levels_.size()) break;
    galerkin(levels_[l].A, P_[l], levels_[l + 1].A);
    levels_[l].A.round_to_single();  // smoothing needs no more
  }
  D_.clear();
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    levels_[l].rows = nullptr;
    make_diagonal(levels_[l]);
    make_top(l);
  }
  factor_last();
}

void Multigrid::hold_points(std::size_t l) {
  if (levels_[l].points) return;
  const Level& finer = levels_[l - 1];
  const Interpolation& P = P_[l - 1];
  const bool is_last = l + 1 == levels_.size();
  levels_[l].points = is_last ? Holding(P.coarse_points()) : held_coarse_points(*finer.points, P, levels_[l].A);
  levels_[l - 1].restricted = restricted_points(*finer.points, P);
}

/// P^T A P from the finite elements, and what these keep.
void Multigrid::make_first_grid() {
  const std::vector<std::uint8_t>& fixed = system_.supports.fixed_components();
  const bool is_linear = system_.solid.is_linear();
  BlockMatrix &A = levels_[1].A, &K = levels_[0].A;
  system_.solid.project_tangent(place_->u, step_to(*place_, nodes()), P_[0], fixed, A, is_linear ? nullptr : &K);
  if (is_linear) {
    diagonal_ = system_.solid.diagonal_at_rest();
  } else {
    diagonal_ = K.diagonal();
    system_.solid.all_nodes().update(diagonal_);
  }
  for (double& value : A.value) value *= c_;
  const auto add = [&](std::size_t n, std::size_t i, double value) {
    const auto coarse = P_[0].coarse_of(n);
    const auto weights = P_[0].weights_of(n);
    for (std::size_t p = 0; p < coarse.size(); ++p)
      for (std::size_t q = 0; q < coarse.size(); ++q)
        A.block(coarse[p], coarse[q])[4 * i] += value * weights[p] * weights[q];
  };
  for (std::size_t n = 0; n < masses_.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i)
      if ((fixed[n] >> i & 1U) == 0) add(n, i, m_ * masses_[n]);
  for (const DofSpring& spring : springs_) add(spring.dof / 3, spring.dof % 3, spring.stiffness);
}

/// By Lanczos iterations on D^-1/2 A D^-1/2, where all bodies have the same share of the start vector, however stiff
/// they are: the residual bound makes up for what the value lacks. The bound is of an eigenvalue that is near, not of
/// the largest: where nearly all are alike, as in bodies whose mass prevails, the first iterations see those alone.
void Multigrid::make_top(std::size_t l) {
  Level& level = levels_[l];
  const std::size_t n = level.diagonal.size();
  const Entries entries = level.entries();
  std::vector<double> root(n), scaled(n);
  for (std::size_t i = 0; i < n; ++i) root[i] = std::sqrt(level.inverse_diagonal[i]);
  const LinearOperator A = [&](std::span<const double> x, std::span<double> y) {
    entries.each([&](std::size_t i) { scaled[i] = root[i] * x[i]; });
    apply_level(l, scaled, y);
    entries.each([&](std::size_t i) { y[i] *= root[i]; });
  };
  constexpr double rough = 0.05;
  constexpr int least = 8, most = 25;
  level.top = largest_eigenvalue(A, entries, rough, most, least).upper;
}

void Multigrid::make_diagonal(Level& level) const {
  std::vector<double> diagonal = level.diagonal;
  for (std::size_t r = 0; level.rows && r < D_.size(); ++r) {
    if (!acts(D_[r])) continue;
    const ConstraintRows& rows = *level.rows;
    const double entries = 3.0 * static_cast<double>(rows.begin[r + 1] - rows.begin[r]);
    const double times = std::max(1.0, entries / level.top);
    for (std::size_t k = at(rows.begin[r]); k < at(rows.begin[r + 1]); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3 column{rows.block[k][0][c], rows.block[k][1][c], rows.block[k][2][c]};
        diagonal[3 * at(rows.node[k]) + c] += times * dot(column, product(D_[r], column));
      }
  }
  level.inverse_diagonal.resize(diagonal.size());
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    level.inverse_diagonal[i] = diagonal[i] > 0.0 ? 1.0 / diagonal[i] : 0.0;
}

void Multigrid::use(const std::shared_ptr<const ConstraintRows>& rows, const std::vector<RowTangent>& D) {
  if (D == D_ && (D.empty() || rows == rows_)) return;
  D_ = D;
  const bool has_rows = std::any_of(D.begin(), D.end(), acts);
  const bool are_known = rows == rows_ && levels_[0].rows;
  rows_ = rows;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    if (!has_rows)
      level.rows = nullptr;
    else if (!are_known)
      level.rows = std::make_shared<const ConstraintRows>(l == 0 ? without(*rows, system_.supports.fixed_components())
                                                                 : project(*levels_[l - 1].rows, P_[l - 1]));
    make_diagonal(level);
  }
  factor_last();
}

void Multigrid::factor_last() {
  const Level& level = levels_.back();
  last_.reset();
  BlockMatrix A = level.rows ? sum(level.A, matrix_of(*level.rows, D_, level.A.points())) : level.A;
  for (std::size_t p = 0; p < A.points(); ++p)
    for (std::size_t i = 0; i < 3; ++i) {
      double& entry = A.block(static_cast<Index>(p), static_cast<Index>(p))[4 * i];
      if (entry == 0.0) entry = 1.0;  // fixed, as all nodes around it
    }
  try {
    last_.emplace(by_unknowns(A));
  } catch (const NotPositiveDefinite&) {
    // Then smoothing has to do, and the conjugate gradients say what is wrong.
  }
}

/// (m M + c K) x on the finite elements, without fixed dofs, of the nodes that this rank holds.
void Multigrid::apply_fine(std::span<const double> x, std::span<double> y) const {
  if (system_.solid.is_linear()) {
    system_.solid.tangent_action(place_->u, x, y, step_to(*place_, nodes()));
  } else {
    levels_[0].A.apply(x, y, levels_[0].own());
    nodes().update(y);
  }
  const std::vector<std::uint8_t>& all_fixed = system_.supports.fixed_components();
  nodes().each_range([&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const double mass = m_ * masses_[n];
      const unsigned fixed = all_fixed[n];
      for (std::size_t i = 3 * n; i < 3 * n + 3; ++i)
        y[i] = (fixed >> (i - 3 * n) & 1U) != 0 ? 0.0 : mass * x[i] + c_ * y[i];
    }
  });
  for (const DofSpring& spring : springs_) y[spring.dof] += spring.stiffness * x[spring.dof];
}

void Multigrid::apply_level(std::size_t l, std::span<const double> x, std::span<double> y) const {
  const Level& level = levels_[l];
  if (l == 0) {
    apply_fine(x, y);
  } else {
    level.A.apply(x, y, level.own());
    level.points->update(y);
  }
  if (!level.rows) return;
  for (std::size_t r = 0; r < D_.size(); ++r)
    if (acts(D_[r])) level.rows->scatter(r, product(D_[r], level.rows->relative(r, x)), y);
}

/// Chebyshev's iteration on A x = b from the x there is; b is the residual before `A_times_d` is taken off, and lacks
/// that of the last change afterwards (Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., algorithm 12.1).
void Multigrid::smooth(std::size_t l, bool is_start) {
  Level& level = levels_[l];
  const double theta = 0.5 * level.top * (1.0 + 1.0 / damped), delta = 0.5 * level.top * (1.0 - 1.0 / damped);
  const double sigma = theta / delta;
  double rho = 1.0 / sigma, keep = 0.0, add = 1.0 / theta;
  for (int k = 1; k <= degree; ++k) {
    const bool is_first = is_start && k == 1;
    if (!is_first) apply_level(l, level.d, level.Ad);
    level.entries().each([&](std::size_t i) {
      if (!is_first) level.b[i] -= level.Ad[i];
      level.d[i] = (k == 1 ? 0.0 : keep * level.d[i]) + add * level.inverse_diagonal[i] * level.b[i];
      level.x[i] = (is_first ? 0.0 : level.x[i]) + level.d[i];
    });
    const double next = 1.0 / (2.0 * sigma - rho);
    keep = rho * next;
    add = 2.0 * next / delta;
    rho = next;
  }
}

/// levels_[l].x = B b, which changes b.
void Multigrid::cycle(std::size_t l) {
  Level& level = levels_[l];
  if (l + 1 == levels_.size() && last_) {
    level.x = level.b;
    last_->solve(level.x);
    return;
  }
  smooth(l, true);
  if (l + 1 == levels_.size()) return;
  apply_level(l, level.d, level.Ad);
  level.entries().each([&](std::size_t i) { level.b[i] -= level.Ad[i]; });
  Level& coarse = levels_[l + 1];
  level.restricted->update(level.b);
  P_[l].restrict_to(level.b, coarse.b, coarse.own());
  coarse.points->update(coarse.b);
  cycle(l + 1);
  P_[l].apply(coarse.x, level.d, level.own());
  level.points->update(level.d);
  level.entries().each([&](std::size_t i) {
    if (level.inverse_diagonal[i] == 0.0) level.d[i] = 0.0;  // fixed
    level.x[i] += level.d[i];
  });
  smooth(l, false);
}

void Multigrid::apply(std::span<const double> r, std::span<double> z) {
  Level& fine = levels_[0];
  for (Level& level : levels_)
    for (std::vector<double>* v : {&level.b, &level.x, &level.d, &level.Ad}) level.points->spoil(*v);
  fine.entries().each([&](std::size_t i) { fine.b[i] = r[i]; });
  cycle(0);
  fine.entries().each([&](std::size_t i) { z[i] = fine.x[i]; });
}

}  // namespace carom
