#include "rows/constraint_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr double precision = 16.0 * std::numeric_limits<double>::epsilon();
constexpr double drift = 64.0;  // of a displacement that is a sum over steps: rounding as a random walk of 4096

/// A unit vector normal to n, from the axis least aligned with it.
Vec3 any_tangent(const Vec3& n) {
  std::size_t axis = 0;
  for (std::size_t c = 1; c < 3; ++c) {
    if (std::abs(n[c]) < std::abs(n[axis])) axis = c;
  }
  Vec3 e{};
  e[axis] = 1.0;
  const Vec3 t = cross(n, e);  // of length 0.8 at least
  return scaled(t, 1.0 / std::sqrt(dot(t, t)));
}

}  // namespace

void ConstraintRows::clear() {
  begin.assign(1, 0);
  node.clear();
  block.clear();
  gap.clear();
  normal.clear();
  tangent_1.clear();
  tangent_2.clear();
  position.clear();
  reach.clear();
  measure.clear();
  law.clear();
  source.clear();
  behind.clear();
  is_back.clear();
  allowed.clear();
  offset.clear();
  rounded.clear();
  has_entered.clear();
  facet.clear();
  slot.clear();
}

void ConstraintRows::add_row(double row_gap, const Vec3& row_normal, const Vec3& row_position, double row_measure,
                             const RowLaw& row_law, Index row_source) {
  slot.push_back(static_cast<Index>(size()));
  begin.push_back(begin.back());
  gap.push_back(row_gap);
  normal.push_back(row_normal);
  tangent_1.push_back(any_tangent(row_normal));
  tangent_2.push_back(cross(row_normal, tangent_1.back()));
  position.push_back(row_position);
  reach.push_back(std::sqrt(dot(row_position, row_position)));
  measure.push_back(row_measure);
  law.push_back(row_law);
  source.push_back(row_source);
  behind.push_back(0);
  is_back.push_back(false);
  allowed.push_back(0.0);
  offset.push_back(0.0);
  rounded.push_back(0.0);
  has_entered.push_back(false);
  facet.push_back(0);
}

void ConstraintRows::add_node(Index n, double w) {
  add_block(n, {scaled(normal.back(), w), scaled(tangent_1.back(), w), scaled(tangent_2.back(), w)});
}

void ConstraintRows::add_block(Index n, const RowBlock& b) {
  node.push_back(n);
  block.push_back(b);
  ++begin.back();
}

void ConstraintRows::add_behind(Index n, const RowBlock& b) {
  const auto there = std::find(node.end() - behind.back(), node.end(), n);
  if (there == node.end()) {
    add_block(n, b);
    ++behind.back();
    return;
  }
  RowBlock& sum = block[static_cast<std::size_t>(there - node.begin())];
  for (std::size_t i = 0; i < 3; ++i) sum[i] = add(sum[i], b[i]);
}

void ConstraintRows::scatter(std::size_t r, const Vec3& s, std::span<double> f) const {
  for_each_share(r, s, [&](Index n, const Vec3& share) {
    for (std::size_t c = 0; c < 3; ++c) f[3 * static_cast<std::size_t>(n) + c] += share[c];
  });
}

double ConstraintRows::rounding(std::size_t r, std::span<const double> x) const {
  double sum = 0.0;
  for (auto k = static_cast<std::size_t>(begin[r]); k < static_cast<std::size_t>(begin[r + 1]); ++k) {
    const double* u = x.data() + 3 * static_cast<std::size_t>(node[k]);
    for (const Vec3& line : block[k])
      sum = std::max(sum, std::abs(line[0] * u[0]) + std::abs(line[1] * u[1]) + std::abs(line[2] * u[2]));
  }
  return precision * sum;
}

double ConstraintRows::gap_rounding(std::size_t r, std::span<const double> x) const {
  return rounding(r, x) + precision * (reach[r] + std::abs(gap[r]));
}

bool ConstraintRows::is_closed(std::size_t r, std::span<const double> x, double extent) const {
  const Vec3 w = relative(r, x);
  return gap[r] + w[0] <= drift * precision * (reach[r] + std::abs(gap[r]) + norm(w) + extent);
}

Vec3 ConstraintRows::to_space(std::size_t r, const Vec3& s) const {
  return add(scaled(normal[r], s[0]), add(scaled(tangent_1[r], s[1]), scaled(tangent_2[r], s[2])));
}

Vec3 ConstraintRows::to_frame(std::size_t r, const Vec3& vector) const {
  return {dot(normal[r], vector), dot(tangent_1[r], vector), dot(tangent_2[r], vector)};
}

}  // namespace carom
