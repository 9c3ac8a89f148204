#include "solid/least_squares_mass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr std::size_t conditions = 10;
using Moments = std::array<double, conditions>;
using MomentMatrix = std::array<Moments, conditions>;

/// Centre and size of the points, so that moments are of order 1.
struct KeptFrame {
  Vec3 centre{};
  double size = 0.0;

  KeptFrame(std::span<const MassPoint> kept, std::span<const MassPoint> removed) {
    double total = 0.0;
    for (const auto& points : {kept, removed}) {
      for (const MassPoint& p : points) {
        centre = add(centre, scaled(p.x, p.mass));
        total += p.mass;
      }
    }
    centre = scaled(centre, 1.0 / total);
    for (const auto& points : {kept, removed}) {
      for (const MassPoint& p : points) size = std::max(size, norm(subtract(p.x, centre)));
    }
  }

  Moments of(const MassPoint& p) const {
    const Vec3 r = size > 0.0 ? scaled(subtract(p.x, centre), 1.0 / size) : Vec3{};
    return {1.0, r[0], r[1], r[2], r[0] * r[0], r[1] * r[1], r[2] * r[2], r[0] * r[1], r[1] * r[2], r[2] * r[0]};
  }
};

double product(const Moments& a, const Moments& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < conditions; ++i) sum += a[i] * b[i];
  return sum;
}

/// Solves H y = b for a positive semi-definite H by Cholesky's factorisation with pivoting; unknowns whose pivot is
/// round-off are zero.
Moments solve_semi_definite(MomentMatrix H, const Moments& b) {
  std::array<std::size_t, conditions> order{};
  for (std::size_t i = 0; i < conditions; ++i) order[i] = i;
  double first = 0.0;
  std::size_t rank = 0;
  for (; rank < conditions; ++rank) {
    std::size_t best = rank;
    for (std::size_t i = rank; i < conditions; ++i) {
      if (H[order[i]][order[i]] > H[order[best]][order[best]]) best = i;
    }
    std::swap(order[rank], order[best]);
    const std::size_t p = order[rank];
    if (rank == 0) first = H[p][p];
    if (!(H[p][p] > 1e-12 * first)) break;
    for (std::size_t i = rank + 1; i < conditions; ++i) {
      const std::size_t q = order[i];
      const double factor = H[q][p] / H[p][p];
      for (std::size_t j = rank + 1; j < conditions; ++j) H[q][order[j]] -= factor * H[p][order[j]];
      H[q][p] = factor;
    }
  }
  Moments y{};
  for (std::size_t i = 0; i < rank; ++i) {
    y[order[i]] = b[order[i]];
    for (std::size_t j = 0; j < i; ++j) y[order[i]] -= H[order[i]][order[j]] * y[order[j]];
  }
  // H = L D L^T; the strict lower part holds L, the rows above the diagonal hold D L^T.
  for (std::size_t i = rank; i-- > 0;) {
    const std::size_t p = order[i];
    y[p] /= H[p][p];
    for (std::size_t j = i + 1; j < rank; ++j) y[p] -= H[order[j]][p] * y[order[j]];
  }
  return y;
}

}  // namespace

std::vector<double> redistribute(std::span<const MassPoint> kept, std::span<const MassPoint> removed, double floor) {
  const KeptFrame frame(kept, removed);
  Moments target{}, y{};
  double moved = 0.0;
  for (const MassPoint& point : removed) {
    const Moments p = frame.of(point);
    for (std::size_t i = 0; i < conditions; ++i) target[i] += point.mass * p[i];
    moved += point.mass;
  }
  std::vector<double> change(kept.size());
  // Each step changes the set of masses at their floor; a set comes back only when there is no solution.
  constexpr int most = 100;
  for (int iteration = 0; iteration < most; ++iteration) {
    Moments missing = target;
    MomentMatrix H{};
    for (std::size_t a = 0; a < kept.size(); ++a) {
      const Moments p = frame.of(kept[a]);
      const double slope = product(p, y);
      change[a] = kept[a].mass * std::max(slope, floor - 1.0);
      for (std::size_t i = 0; i < conditions; ++i) {
        missing[i] -= change[a] * p[i];
        if (slope < floor - 1.0) continue;
        for (std::size_t j = 0; j < conditions; ++j) H[i][j] += kept[a].mass * p[i] * p[j];
      }
    }
    double error = 0.0;
    for (const double m : missing) error = std::max(error, std::abs(m));
    if (error <= 1e-13 * moved * std::sqrt(static_cast<double>(kept.size()))) return change;
    const Moments step = solve_semi_definite(H, missing);
    for (std::size_t i = 0; i < conditions; ++i) y[i] += step[i];
  }
  throw std::invalid_argument(
      "the modified mass finds no positive masses that keep the centre and the inertia of a body whose contact nodes "
      "lose theirs; refine the mesh, or spread the mass over layers");
}

}  // namespace carom
