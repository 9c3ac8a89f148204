#include "solid/cohesive_zones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "solid/assembly.hpp"

namespace carom {

namespace {

Vec3 value_of(std::span<const double> u, Index n) {
  return {u[3 * at(n)], u[3 * at(n) + 1], u[3 * at(n) + 2]};
}

/// Of the corners of a face, or of a line in the plane x y, not of unit length; zero for a point.
Vec3 normal_of(const std::array<Vec3, 4>& x, int size) {
  if (size == 2) return {x[1][1] - x[0][1], x[0][0] - x[1][0], 0.0};
  if (size == 3) return cross(subtract(x[1], x[0]), subtract(x[2], x[0]));
  if (size == 4) return cross(subtract(x[2], x[0]), subtract(x[3], x[1]));
  return {};
}

}  // namespace

CohesiveZones::CohesiveZones(std::vector<CohesiveZone> zones, std::span<const Vec3> coordinates)
    : zones_(std::move(zones)), X_(coordinates) {
  for (std::size_t z = 0; z < zones_.size(); ++z) {
    for (const CohesiveRow& row : zones_[z].rows) {
      std::array<Vec3, 4> x{};
      for (int a = 0; a < row.facet.size; ++a) x[at(a)] = X_[at(row.facet[at(a)])];
      rows_.push_back({&row, z, dot(normal_of(x, row.facet.size), row.normal) < 0.0 ? -1.0 : 1.0});
      std::vector<Index>& nodes = links_.emplace_back();
      for_each_weight(row, [&](Index n, double) { nodes.push_back(n); });
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
  }
}

Vec3 CohesiveZones::parted(const CohesiveRow& row, std::span<const double> x) {
  Vec3 w{};
  for_each_weight(row, [&](Index n, double weight) { w = add(w, scaled(value_of(x, n), weight)); });
  return w;
}

Vec3 CohesiveZones::normal(std::size_t r, std::span<const double> u) const {
  const CohesiveRow& row = *rows_[r].row;
  std::array<Vec3, 4> x{};
  for (int a = 0; a < row.facet.size; ++a) x[at(a)] = add(X_[at(row.facet[at(a)])], value_of(u, row.facet[at(a)]));
  const Vec3 n = normal_of(x, row.facet.size);
  const double size = norm(n);
  return size > 0.0 ? scaled(n, rows_[r].side / size) : row.normal;
}

CohesiveZones::Mode CohesiveZones::mode(std::size_t r, const Vec3& opening, const Vec3& n) const {
  const CohesiveLaw& of = law(r);
  Mode out;
  out.lambda = norm(opening);
  if (!(out.lambda > 0.0)) return out;
  const double c = std::min(1.0, std::max(0.0, dot(opening, n)) / out.lambda), s_squared = 1.0 - c * c;
  const double stress = std::sqrt(c * c / (of.normal_strength * of.normal_strength) +
                                  s_squared / (of.shear_strength * of.shear_strength));
  const double energy = 1.0 / (c * c / of.normal_energy + s_squared / of.shear_energy);
  out.start = 1.0 / (of.stiffness * stress);
  out.full = 2.0 * energy * stress;
  return out;
}

CohesiveZones::Answer CohesiveZones::answer(std::size_t r, std::span<const double> u, const PointStep& step) const {
  Answer out;
  const std::span<const double> before = own(r, step.history);
  if (!before.empty()) out.damage = before[0], out.dissipated = before[1];
  out.w = parted(*rows_[r].row, u);
  if (out.damage >= 1.0 || step.is_over) return out;
  const Vec3 n = normal(r, u);
  out.opening = subtract(out.w, scaled(n, std::min(0.0, dot(out.w, n))));
  const Mode m = mode(r, out.opening, n);
  if (!(m.lambda > m.start)) return out;
  const double rise = m.full / (m.full - m.start);
  const double damage = m.lambda < m.full ? rise * (1.0 - m.start / m.lambda) : 1.0;
  if (!(damage > out.damage)) return out;
  // Where the softening branch of this direction has the damage that there was.
  const double from = m.start / (1.0 - out.damage / rise), to = std::min(m.lambda, m.full);
  out.dissipated += 0.5 * law(r).stiffness * rise * m.start * (to - from);
  out.damage = damage;
  if (damage < 1.0) out.slope = rise * m.start / (m.lambda * m.lambda * m.lambda);
  return out;
}

std::array<Vec3, 3> CohesiveZones::tangent_of(std::size_t r, const Answer& a) const {
  const double k = law(r).stiffness * rows_[r].row->area;
  std::array<Vec3, 3> D{};
  for (std::size_t i = 0; i < 3; ++i) {
    D[i][i] = (1.0 - a.damage) * k;
    for (std::size_t j = 0; j < 3; ++j) D[i][j] -= k * a.slope * a.opening[i] * a.opening[j];
  }
  return D;
}

void CohesiveZones::add_force(std::span<const double> u, const PointStep& step, std::span<double> f,
                              SolidEnergies* energies, std::span<double> end) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const CohesiveRow& row = *rows_[r].row;
    const Answer a = answer(r, u, step);
    const double k = (1.0 - a.damage) * law(r).stiffness * row.area;
    const Vec3 t = scaled(a.w, k);
    for_each_weight(row, [&](Index n, double weight) {
      for (std::size_t c = 0; c < 3; ++c) f[3 * at(n) + c] += weight * t[c];
    });
    if (energies != nullptr) energies->strain += 0.5 * dot(t, a.w);
    if (!end.empty()) end[first_ + 2 * r] = a.damage, end[first_ + 2 * r + 1] = a.dissipated;
  }
}

void CohesiveZones::add_tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                                       const PointStep& step) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const CohesiveRow& row = *rows_[r].row;
    const std::array<Vec3, 3> D = tangent_of(r, answer(r, u, step));
    const Vec3 w = parted(row, x), t{dot(D[0], w), dot(D[1], w), dot(D[2], w)};
    for_each_weight(row, [&](Index n, double weight) {
      for (std::size_t c = 0; c < 3; ++c) y[3 * at(n) + c] += weight * t[c];
    });
  }
}

void CohesiveZones::add_tangent(std::span<const double> u, const PointStep& step, CsrMatrix& K) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const CohesiveRow& row = *rows_[r].row;
    const std::array<Vec3, 3> D = tangent_of(r, answer(r, u, step));
    for_each_weight(row, [&](Index a, double of_a) {
      for_each_weight(row, [&](Index b, double of_b) {
        for (std::size_t i = 0; i < 3; ++i) {
          double* line = K.value.data() + entry(K, 3 * a + static_cast<Index>(i), 3 * b);
          for (std::size_t j = 0; j < 3; ++j) line[j] += of_a * of_b * D[i][j];
        }
      });
    });
  }
}

void CohesiveZones::add_tangent_diagonal(std::span<const double> u, const PointStep& step,
                                         std::span<double> diagonal) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const std::array<Vec3, 3> D = tangent_of(r, answer(r, u, step));
    for_each_weight(*rows_[r].row, [&](Index n, double weight) {
      for (std::size_t i = 0; i < 3; ++i) diagonal[3 * at(n) + i] += weight * weight * D[i][i];
    });
  }
}

double CohesiveZones::largest_change(std::span<const double> u_0, std::span<const double> u_1) const {
  double most = 0.0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const CohesiveLaw& of = law(r);
    const double full =
        std::min(2.0 * of.normal_energy / of.normal_strength, 2.0 * of.shear_energy / of.shear_strength);
    most = std::max(most, norm(subtract(parted(*rows_[r].row, u_1), parted(*rows_[r].row, u_0))) / full);
  }
  return most;
}

Vec3 CohesiveZones::force_on_slave(std::size_t r, std::span<const double> u, std::span<const double> history) const {
  const std::span<const double> state = own(r, history);
  const double intact = state.empty() ? 1.0 : 1.0 - state[0];
  return scaled(parted(*rows_[r].row, u), -intact * law(r).stiffness * rows_[r].row->area);
}

double CohesiveZones::dissipated(std::span<const double> history) const {
  double sum = 0.0;
  for (std::size_t r = 0; r < rows_.size() && !history.empty(); ++r) sum += own(r, history)[1] * rows_[r].row->area;
  return sum;
}

std::vector<double> CohesiveZones::nodal_damage(std::span<const double> history, std::size_t nodes) const {
  std::vector<double> damage(nodes, -1.0);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const std::span<const double> state = own(r, history);
    const double d = state.empty() ? 0.0 : state[0];
    for_each_weight(*rows_[r].row, [&](Index n, double) { damage[at(n)] = std::max(damage[at(n)], d); });
  }
  return damage;
}

}  // namespace carom
