#include "enforcement/contact_frequency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"

namespace carom {

namespace {

RowBlock without_turn(const ConstraintRows& rows, std::size_t r, const RowBlock& b) {
  const Vec3 &t_1 = rows.tangent_1[r], &t_2 = rows.tangent_2[r];
  return {b[0], scaled(t_1, dot(t_1, b[1])), scaled(t_2, dot(t_2, b[2]))};
}

/// sqrt(D_i D_j), D being the slopes of a row's springs.
using RootSlopes = std::array<Vec3, 3>;

RootSlopes roots_of(const Vec3& D) {
  RootSlopes roots{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) roots[i][j] = roots[j][i] = std::sqrt(D[i] * D[j]);
  return roots;
}

/// |A| of a row at a node: see the header.
inline double size_of(const RowBlock& b, const RootSlopes& roots, const Vec3& inverse_mass) {
  RootSlopes A{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      double product = 0.0;
      for (std::size_t c = 0; c < 3; ++c) product += b[i][c] * b[j][c] * inverse_mass[c];
      A[i][j] = A[j][i] = roots[i][j] * std::abs(product);
    }
  }
  double largest = 0.0;
  for (const Vec3& line : A) largest = std::max(largest, line[0] + line[1] + line[2]);
  return std::sqrt(largest);
}

Vec3 inverse_mass_of(const System& system, Index node) {
  const double share = system.mass.kind() == MassKind::lumped ? 1.0 : 1.0 / 8.0;
  const auto n = static_cast<std::size_t>(node);
  const double m = share * system.mass.node_diagonal()[n];
  const unsigned fixed = system.supports.fixed_components(n);
  const double inverse = m > 0.0 ? 1.0 / m : 0.0;
  return {(fixed & 1U) == 0 ? inverse : 0.0, (fixed & 2U) == 0 ? inverse : 0.0, (fixed & 4U) == 0 ? inverse : 0.0};
}

/// The part of a row's slope that its energy has. The energy of a face is a sum of squares over its points; the gap,
/// its root, has a gradient that grows without bound as a face comes in from the side that is deep at once, by as much
/// as the gap itself is small.
double part_of_slope(const ConstraintRows& rows, std::size_t r) {
  constexpr double most = 4.0;  // of the gradient at a node: rows of nodes and edges have 1, more where they fade
  double largest = 0.0;
  for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k)
    largest = std::max(largest, dot(rows.block[k][0], rows.block[k][0]));
  return largest > most * most ? most * most / largest : 1.0;
}

/// |A| of every row at each of its nodes.
std::vector<double> sizes(const System& system, const ConstraintRows& rows, std::span<const double> u) {
  std::vector<double> size(rows.node.size());
  constexpr std::size_t grain = 256;  // rows per task: some ten microseconds of work
  parallel_for(rows.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const double gap = rows.gap_at(r, u);
      const bool is_open = gap > 0.0;
      const RowLaw& law = rows.law[r];
      if (is_bond(law)) continue;  // held by BondedMass, without springs
      const RootSlopes roots =
          roots_of({part_of_slope(rows, r) * law.steepest_slope(std::max(0.0, -gap)), law.eps_T, law.eps_T});
      for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k) {
        const Vec3 inverse_mass = inverse_mass_of(system, rows.node[k]);
        size[k] = is_open ? size_of(without_turn(rows, r, rows.block[k]), roots, inverse_mass)
                          : size_of(rows.block[k], roots, inverse_mass);
      }
    }
  });
  return size;
}

}  // namespace

ConstraintRows as_they_close(const ConstraintRows& rows, std::span<const double> u) {
  ConstraintRows out = rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows.gap_at(r, u) <= 0.0) continue;
    for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k)
      out.block[k] = without_turn(rows, r, rows.block[k]);
  }
  return out;
}

double contact_frequency_bound(const System& system, const ConstraintRows& rows, std::span<const double> u,
                               double enough) {
  constexpr int iterations = 8;
  if (rows.size() == 0) return 0.0;
  const std::vector<double> size = sizes(system, rows, u);
  std::vector<double> x(rows.size(), 1.0);
  // Of all nodes of the mesh, most of which nobody looks at.
  const auto at_node = std::make_unique_for_overwrite<double[]>(system.mass.node_diagonal().size());
  double bound = std::numeric_limits<double>::infinity();
  for (int i = 0; i < iterations && bound > enough; ++i) {
    for (const Index n : rows.node) at_node[static_cast<std::size_t>(n)] = 0.0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k)
        at_node[static_cast<std::size_t>(rows.node[k])] += size[k] * x[r];
    }
    double quotient = 0.0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      double sum = 0.0;
      for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k)
        sum += size[k] * at_node[static_cast<std::size_t>(rows.node[k])];
      if (x[r] > 0.0) quotient = std::max(quotient, sum / x[r]);
      x[r] = sum;
    }
    bound = std::min(bound, quotient);
    if (!(bound > 0.0)) break;
    for (double& value : x) value /= quotient;
  }
  return bound;
}

}  // namespace carom
