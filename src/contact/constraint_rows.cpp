#include "contact/constraint_rows.hpp"

#include <cmath>

#include "math/vec3.hpp"

namespace carom {

namespace {

/// A unit vector normal to n, from the axis least aligned with it.
Vec3 any_tangent(const Vec3& n) {
  std::size_t axis = 0;
  for (std::size_t c = 1; c < 3; ++c) {
    if (std::abs(n[c]) < std::abs(n[axis])) axis = c;
  }
  Vec3 e{};
  e[axis] = 1.0;
  return normalized(cross(n, e));
}

}  // namespace

void ConstraintRows::add_row(double row_gap, const Vec3& row_normal, const Vec3& row_position, double row_measure,
                             double row_mu, Index row_source) {
  begin.push_back(begin.back());
  gap.push_back(row_gap);
  normal.push_back(row_normal);
  tangent_1.push_back(any_tangent(row_normal));
  tangent_2.push_back(cross(row_normal, tangent_1.back()));
  position.push_back(row_position);
  measure.push_back(row_measure);
  mu.push_back(row_mu);
  source.push_back(row_source);
}

void ConstraintRows::add_node(Index n, double w) {
  node.push_back(n);
  weight.push_back(w);
  ++begin.back();
}

Vec3 ConstraintRows::relative(std::size_t r, std::span<const double> x) const {
  Vec3 d{};
  for (Index k = begin[r]; k < begin[r + 1]; ++k) {
    for (std::size_t c = 0; c < 3; ++c) d[c] += weight[k] * x[3 * static_cast<std::size_t>(node[k]) + c];
  }
  return {dot(normal[r], d), dot(tangent_1[r], d), dot(tangent_2[r], d)};
}

void ConstraintRows::scatter(std::size_t r, const Vec3& s, std::span<double> f) const {
  Vec3 force;
  for (std::size_t c = 0; c < 3; ++c) force[c] = s[0] * normal[r][c] + s[1] * tangent_1[r][c] + s[2] * tangent_2[r][c];
  for (Index k = begin[r]; k < begin[r + 1]; ++k) {
    for (std::size_t c = 0; c < 3; ++c) f[3 * static_cast<std::size_t>(node[k]) + c] += weight[k] * force[c];
  }
}

}  // namespace carom
