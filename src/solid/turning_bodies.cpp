#include "solid/turning_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "math/vec3.hpp"
#include "solid/assembly.hpp"

namespace carom {

TurningBodies::TurningBodies(std::vector<TurningBody> bodies, double frequency) {
  for (TurningBody& data : bodies) {
    if (data.is_led()) continue;
    const double omega = data.frequency.value_or(data.rigidity * frequency);
    if (!(omega > 0.0))
      throw std::invalid_argument(fmt::format("rigid body \"{}\": no deformable cell sets its rigidity", data.name));
    Body body{std::move(data), {}};
    const Vec3& r = body.data.radii;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const double a = r[i] * r[i], b = r[j] * r[j];
        body.k[i][j] = 2.0 * omega * omega * body.data.mass * a * b / (a + b);
      }
    }
    bodies_.push_back(std::move(body));
  }
}

/// The directors at displacement u; from displacements, so that far from the origin they are as sharp as near it.
BodyFrame TurningBodies::frame(const Body& body, std::span<const double> u) {
  BodyFrame at = body_frame(body.data, nodal_values(body.data, u));
  for (std::size_t i = 0; i < 3; ++i) at.directors[i] = add(at.directors[i], body.data.axes[i]);
  return at;
}

/// S_ij = k_ij E_ij
TurningBodies::Matrix TurningBodies::stress(const Body& body, const BodyFrame& at) {
  Matrix S{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      S[i][j] = 0.5 * body.k[i][j] * (dot(at.directors[i], at.directors[j]) - (i == j ? 1.0 : 0.0));
  return S;
}

/// f_a += sum over i of s_ai / (4 r_i) force_i, the force on the director i.
void TurningBodies::scatter(const Body& body, const std::array<Vec3, 3>& force, std::span<double> f) {
  for (std::size_t a = 0; a < 4; ++a) {
    double* node = f.data() + 3 * static_cast<std::size_t>(body.data.nodes[a]);
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight = 0.25 * corner_signs[a][i] / body.data.radii[i];
      for (std::size_t c = 0; c < 3; ++c) node[c] += weight * force[i][c];
    }
  }
}

/// On the director i: sum over j of S_ij d_j.
static std::array<Vec3, 3> director_forces(const std::array<Vec3, 3>& S, const std::array<Vec3, 3>& d) {
  std::array<Vec3, 3> force{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) force[i] = add(force[i], scaled(d[j], S[i][j]));
  return force;
}

void TurningBodies::add_force(std::span<const double> u, const PointStep& /*step*/, std::span<double> f,
                              SolidEnergies* energies, std::span<double> /*end*/) const {
  for (const Body& body : bodies_) {
    const BodyFrame at = frame(body, u);
    const Matrix S = stress(body, at);
    scatter(body, director_forces(S, at.directors), f);
    if (energies == nullptr) continue;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) energies->strain += 0.5 * S[i][j] * S[i][j] / body.k[i][j];
  }
}

void TurningBodies::add_discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1,
                                                std::span<double> f) const {
  for (const Body& body : bodies_) {
    const BodyFrame begin = frame(body, u_0), end = frame(body, u_1);
    Matrix S = stress(body, begin);
    const Matrix S_end = stress(body, end);
    std::array<Vec3, 3> middle{};
    for (std::size_t i = 0; i < 3; ++i) {
      S[i] = scaled(add(S[i], S_end[i]), 0.5);
      middle[i] = scaled(add(begin.directors[i], end.directors[i]), 0.5);
    }
    scatter(body, director_forces(S, middle), f);
  }
}

/// Derivative of the director forces: k_ij (dd_i . d_j + d_i . dd_j) / 2 d_j + S_ij dd_j, summed over j.
std::array<Vec3, 3> TurningBodies::stiffness_action(const Body& body, const BodyFrame& at, const BodyFrame& direction) {
  const auto &d = at.directors, &dd = direction.directors;
  Matrix dS{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) dS[i][j] = 0.5 * body.k[i][j] * (dot(dd[i], d[j]) + dot(d[i], dd[j]));
  const std::array<Vec3, 3> material = director_forces(dS, d), initial = director_forces(stress(body, at), dd);
  return {add(material[0], initial[0]), add(material[1], initial[1]), add(material[2], initial[2])};
}

void TurningBodies::add_tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                                       const PointStep& /*step*/) const {
  for (const Body& body : bodies_) {
    const BodyFrame direction = body_frame(body.data, nodal_values(body.data, x));
    scatter(body, stiffness_action(body, frame(body, u), direction), y);
  }
}

void TurningBodies::add_tangent(std::span<const double> u, const PointStep& /*step*/, CsrMatrix& K) const {
  if (empty()) return;
  std::vector<double> column(u.size(), 0.0);
  for (const Body& body : bodies_) {
    const BodyFrame at = frame(body, u);
    for (std::size_t b = 0; b < 12; ++b) {
      std::array<Vec3, 4> unit{};
      unit[b / 3][b % 3] = 1.0;
      scatter(body, stiffness_action(body, at, body_frame(body.data, unit)), column);
      const auto j = 3 * body.data.nodes[b / 3] + static_cast<Index>(b % 3);
      for (const Index n : body.data.nodes) {
        for (Index i = 3 * n; i < 3 * n + 3; ++i) {
          K.value[entry(K, i, j)] += column[static_cast<std::size_t>(i)];
          column[static_cast<std::size_t>(i)] = 0.0;
        }
      }
    }
  }
}

void TurningBodies::add_tangent_diagonal(std::span<const double> u, const PointStep& /*step*/,
                                         std::span<double> diagonal) const {
  if (empty()) return;
  std::vector<double> column(u.size(), 0.0);
  for (const Body& body : bodies_) {
    const BodyFrame at = frame(body, u);
    for (std::size_t b = 0; b < 12; ++b) {
      std::array<Vec3, 4> unit{};
      unit[b / 3][b % 3] = 1.0;
      scatter(body, stiffness_action(body, at, body_frame(body.data, unit)), column);
      const std::size_t i = 3 * static_cast<std::size_t>(body.data.nodes[b / 3]) + b % 3;
      diagonal[i] += column[i];
      for (const Index n : body.data.nodes) std::fill_n(column.data() + 3 * n, 3, 0.0);
    }
  }
}

void TurningBodies::add_force_scale(std::span<double> f) const {
  if (empty()) return;
  std::vector<double> diagonal(f.size(), 0.0);
  add_tangent_diagonal(std::vector<double>(f.size(), 0.0), {}, diagonal);
  for (const Body& body : bodies_) {
    const double length = norm(body.data.radii);
    for (const Index n : body.data.nodes)
      for (std::size_t i = 3 * static_cast<std::size_t>(n), c = 0; c < 3; ++c) f[i + c] += length * diagonal[i + c];
  }
}

std::vector<std::vector<Index>> TurningBodies::links() const {
  std::vector<std::vector<Index>> links;
  for (const Body& body : bodies_) links.emplace_back(body.data.nodes.begin(), body.data.nodes.end());
  return links;
}

std::vector<std::pair<Index, double>> TurningBodies::masses() const {
  std::vector<std::pair<Index, double>> masses;
  for (const Body& body : bodies_)
    for (const Index n : body.data.nodes) masses.emplace_back(n, 0.25 * body.data.mass);
  return masses;
}

double TurningBodies::largest_change(std::span<const double> u_0, std::span<const double> u_1) const {
  double most = 0.0;
  for (const Body& body : bodies_) {
    const BodyFrame from = frame(body, u_0), to = frame(body, u_1);
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, norm(subtract(to.directors[i], from.directors[i])));
  }
  return most;
}

double TurningBodies::largest_strain(std::span<const double> u) const {
  double largest = 0.0;
  for (const Body& body : bodies_) largest = std::max(largest, body_strain(frame(body, u)));
  return largest;
}

}  // namespace carom
