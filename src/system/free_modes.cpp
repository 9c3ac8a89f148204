#include "system/free_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "linalg/dense.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

/// Share of its pin's stiffness above which rows hold a motion.
constexpr double held = 1e-4;

/// Representative of the set that i belongs to (union-find with halved paths).
std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

FreeModes::FreeModes(const System& system) : system_(system) {
  find_bodies();
  find_modes();
  for (Body& body : bodies_) {
    body.first = size_;
    size_ += body.modes.size();
    body_of_mode_.insert(body_of_mode_.end(), body.modes.size(), static_cast<std::size_t>(&body - bodies_.data()));
    choose_pins(body);
  }
}

void FreeModes::find_bodies() {
  const Solid& solid = system_.solid;
  const std::vector<double>& mass = system_.mass.node_diagonal();
  const std::vector<Vec3>& X = system_.mesh.coordinates;
  std::vector<std::size_t> parent(solid.node_count());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  std::vector<bool> is_used(parent.size());
  for (std::size_t n = 0; n < parent.size(); ++n) is_used[n] = mass[n] > 0.0;
  for (std::size_t k = 0; k < solid.cells().size(); ++k) {
    const std::span<const Index> nodes = solid.cells().nodes_of(k);
    for (const Index n : nodes) {
      parent[root(parent, static_cast<std::size_t>(n))] = root(parent, static_cast<std::size_t>(nodes[0]));
      is_used[static_cast<std::size_t>(n)] = true;  // also where a modified mass leaves none
    }
  }
  for (const Spring& spring : solid.springs()) {
    const auto a = static_cast<std::size_t>(spring.nodes[0]), b = static_cast<std::size_t>(spring.nodes[1]);
    if (is_used[a] && is_used[b]) parent[root(parent, a)] = root(parent, b);  // else it is the ground
  }
  for (const std::vector<Index>& nodes : solid.cohesive().links())
    for (const Index n : nodes)
      parent[root(parent, static_cast<std::size_t>(n))] = root(parent, static_cast<std::size_t>(nodes[0]));
  body_of_.assign(parent.size(), -1);
  for (std::size_t n = 0; n < parent.size(); ++n) {
    if (!is_used[n]) continue;
    int& body = body_of_[root(parent, n)];
    if (body < 0) {
      body = static_cast<int>(bodies_.size());
      bodies_.emplace_back();
    }
    body_of_[n] = body;
    bodies_[static_cast<std::size_t>(body)].nodes.push_back(static_cast<Index>(n));
  }
  for (Body& body : bodies_) {
    for (const Index n : body.nodes) body.centre = add(body.centre, scaled(X[n], 1.0 / body.nodes.size()));
    double radius = 0.0;
    for (const Index n : body.nodes) radius = std::max(radius, norm(subtract(X[n], body.centre)));
    if (radius > 0.0) body.radius = radius;
  }
}

Vec3 FreeModes::candidate(const Body& body, std::size_t j, const Vec3& x) const {
  Vec3 axis{};
  axis[j % 3] = 1.0;
  return j < 3 ? axis : scaled(cross(axis, subtract(x, body.centre)), 1.0 / body.radius);
}

void FreeModes::find_modes() {
  const std::size_t dofs = system_.solid.dof_count();
  const std::vector<Vec3>& X = system_.mesh.coordinates;
  const std::vector<double> zero(dofs, 0.0), diagonal = system_.solid.tangent_diagonal(zero);
  std::array<std::vector<double>, 6> c, Kc;
  for (std::size_t j = 0; j < 6; ++j) {
    c[j].assign(dofs, 0.0);
    Kc[j].resize(dofs);
    for (const Body& body : bodies_) {
      for (const Index n : body.nodes) {
        const Vec3 v = candidate(body, j, X[n]);
        std::copy(v.begin(), v.end(), c[j].begin() + 3 * static_cast<std::ptrdiff_t>(n));
      }
    }
    system_.solid.tangent_action(zero, c[j], Kc[j]);
  }
  double softest = std::numeric_limits<double>::infinity();
  const auto dofs_of = [](const Body& body, auto&& visit) {
    for (const Index n : body.nodes)
      for (std::size_t i = 3 * static_cast<std::size_t>(n); i < 3 * static_cast<std::size_t>(n) + 3; ++i) visit(i);
  };
  for (Body& body : bodies_) {
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    dofs_of(body, [&](std::size_t i) {
      if (diagonal[i] > 0.0) least = std::min(least, diagonal[i]);
      most = std::max(most, diagonal[i]);
    });
    body.stiffness = least;
    softest = std::min(softest, least);
    const double of_support = most > 0.0 ? most : 1.0;
    std::vector<double> T(36, 0.0), squares(36, 0.0);
    dofs_of(body, [&](std::size_t i) {
      const double support = system_.supports.fixed()[i] ? of_support : 0.0;
      for (std::size_t j = 0; j < 6; ++j)
        for (std::size_t k = 0; k < 6; ++k) {
          T[6 * j + k] += c[j][i] * (Kc[k][i] + support * c[k][i]);
          squares[6 * j + k] += c[j][i] * c[k][i];
        }
    });
    // A single node does not turn, and a straight bar not about itself: what moves nothing resists nothing and is no
    // mode.
    const SymmetricEigen moved = symmetric_eigen(squares, 6);
    for (std::size_t m = 0; m < 6; ++m) {
      if (moved.values[m] > 1e-9 * moved.values.back()) continue;
      const double* still = moved.vectors.data() + 6 * m;
      for (std::size_t j = 0; j < 6; ++j)
        for (std::size_t k = 0; k < 6; ++k) T[6 * j + k] += of_support * still[j] * still[k];
    }
    const SymmetricEigen eigen = symmetric_eigen(T, 6);
    const double largest = std::max(of_support, eigen.values.back());
    for (std::size_t j = 0; j < 6; ++j) {
      if (eigen.values[j] > 1e-9 * largest) continue;
      Candidate mode;
      for (std::size_t k = 0; k < 6; ++k) mode[k] = eigen.vectors[6 * j + k];
      body.modes.push_back(mode);
    }
  }
  for (Body& body : bodies_) {
    if (!std::isfinite(body.stiffness)) body.stiffness = std::isfinite(softest) ? softest : 1.0;
  }
}

double FreeModes::inertia_for_turns(std::span<const double> u, const PointStep& step) const {
  if (system_.solid.is_linear() || empty()) return 0.0;
  const std::size_t dofs = u.size();
  const std::vector<double>& mass = system_.mass.node_diagonal();
  std::array<std::vector<double>, 6> c, Kc;
  for (std::size_t j = 0; j < 6; ++j) {
    c[j].assign(dofs, 0.0);
    Kc[j].resize(dofs);
    for (const Body& body : bodies_) {
      if (j >= body.modes.size()) continue;
      for (const Index n : body.nodes) {
        const Vec3 v = displacement(body.first + j, n, u);
        std::copy(v.begin(), v.end(), c[j].begin() + 3 * static_cast<std::ptrdiff_t>(n));
      }
    }
    system_.solid.tangent_action(u, c[j], Kc[j], step);
  }
  double most = 0.0;
  for (const Body& body : bodies_) {
    const std::size_t d = body.modes.size();
    if (d == 0) continue;
    std::vector<double> T(d * d, 0.0), M(d * d, 0.0);
    for (const Index n : body.nodes) {
      for (std::size_t i = 3 * static_cast<std::size_t>(n); i < 3 * static_cast<std::size_t>(n) + 3; ++i) {
        for (std::size_t j = 0; j < d; ++j) {
          for (std::size_t k = 0; k < d; ++k) {
            T[d * j + k] += 0.5 * (c[j][i] * Kc[k][i] + c[k][i] * Kc[j][i]);
            M[d * j + k] += mass[i / 3] * c[j][i] * c[k][i];
          }
        }
      }
    }
    // Least eigenvalue of T by M: of S^T T S, S^T M S = 1.
    const SymmetricEigen inertia = symmetric_eigen(M, static_cast<int>(d));
    if (!(inertia.values.front() > 0.0)) continue;
    std::vector<double> of_unit(d * d, 0.0);
    for (std::size_t j = 0; j < d; ++j) {
      for (std::size_t k = 0; k < d; ++k) {
        for (std::size_t p = 0; p < d; ++p)
          for (std::size_t q = 0; q < d; ++q)
            of_unit[d * j + k] += inertia.vectors[d * j + p] * T[d * p + q] * inertia.vectors[d * k + q];
        of_unit[d * j + k] /= std::sqrt(inertia.values[j] * inertia.values[k]);
      }
    }
    constexpr double margin = 1.25;
    most = std::max(most, -margin * symmetric_eigen(of_unit, static_cast<int>(d)).values.front());
  }
  return most;
}

/// Gram-Schmidt with the largest remaining dof first.
void FreeModes::choose_pins(Body& body) const {
  const std::size_t d = body.modes.size();
  std::vector<std::size_t> dof;
  std::vector<std::array<double, 6>> row;  // displacement of the dof in each mode
  for (const Index n : body.nodes) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t at = 3 * static_cast<std::size_t>(n) + i;
      if (d == 0 || system_.supports.fixed()[at]) continue;
      dof.push_back(at);
      row.emplace_back();
      for (std::size_t k = 0; k < d; ++k) row.back()[k] = combine(body, body.modes[k], n, {})[i];
    }
  }
  const auto product = [d](const std::array<double, 6>& a, const std::array<double, 6>& b) {
    return dot({a.data(), d}, {b.data(), d});
  };
  for (std::size_t k = 0; k < d; ++k) {
    const auto largest = static_cast<std::size_t>(
        std::max_element(row.begin(), row.end(),
                         [&](const auto& a, const auto& b) { return product(a, a) < product(b, b) * (1.0 - 1e-9); }) -
        row.begin());
    const std::array<double, 6> chosen = row[largest];
    const double square = product(chosen, chosen);
    body.pins.push_back(dof[largest]);
    for (auto& r : row) {
      const double part = product(r, chosen) / square;
      for (std::size_t j = 0; j < d; ++j) r[j] -= part * chosen[j];
    }
  }
}

Vec3 FreeModes::combine(const Body& body, const Candidate& c, Index node, std::span<const double> u) const {
  const auto n = static_cast<std::size_t>(node);
  Vec3 x = system_.mesh.coordinates[n], out{};
  if (!u.empty() && !system_.solid.is_linear()) x = add(x, {u[3 * n], u[3 * n + 1], u[3 * n + 2]});
  for (std::size_t j = 0; j < 6; ++j) out = add(out, scaled(candidate(body, j, x), c[j]));
  return out;
}

std::vector<std::vector<Index>> FreeModes::free_bodies() const {
  std::vector<std::vector<Index>> out;
  for (const Body& body : bodies_)
    if (!body.modes.empty()) out.push_back(body.nodes);
  return out;
}

Vec3 FreeModes::displacement(std::size_t k, Index node, std::span<const double> u) const {
  const std::size_t b = body_of_mode_[k];
  if (body_of_[static_cast<std::size_t>(node)] != static_cast<int>(b)) return {};
  const Body& body = bodies_[b];
  return combine(body, body.modes[k - body.first], node, u);
}

std::vector<DofSpring> FreeModes::pins(double share) const {
  std::vector<DofSpring> out;
  for (const Body& body : bodies_) {
    for (const std::size_t dof : body.pins) out.push_back({dof, share * body.stiffness});
  }
  return out;
}

Vec3 FreeModes::relative(const ConstraintRows& rows, std::size_t r, std::span<const double> coefficient,
                         std::span<const double> u) const {
  Vec3 w{};
  for (auto e = static_cast<std::size_t>(rows.begin[r]); e < static_cast<std::size_t>(rows.begin[r + 1]); ++e) {
    const int b = body_of_[static_cast<std::size_t>(rows.node[e])];
    if (b < 0) continue;
    const Body& body = bodies_[static_cast<std::size_t>(b)];
    Candidate sum{};
    for (std::size_t k = 0; k < body.modes.size(); ++k)
      for (std::size_t j = 0; j < 6; ++j) sum[j] += coefficient[body.first + k] * body.modes[k][j];
    const Vec3 v = combine(body, sum, rows.node[e], u);
    for (std::size_t i = 0; i < 3; ++i) w[i] += dot(rows.block[e][i], v);
  }
  return w;
}

/// T = R^T G^T D G R, row-major.
std::vector<double> FreeModes::stiffness_of_rows(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                                 std::span<const double> u) const {
  std::vector<double> T(size_ * size_, 0.0), unit(size_, 0.0);
  std::vector<Vec3> w(size_);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const RowTangent& t = D[r];
    if (!acts(t)) continue;
    for (std::size_t k = 0; k < size_; ++k) {
      unit[k] = 1.0;
      w[k] = relative(rows, r, unit, u);
      unit[k] = 0.0;
    }
    for (std::size_t k = 0; k < size_; ++k) {
      for (std::size_t l = 0; l < size_; ++l)
        for (std::size_t i = 0; i < 3; ++i)
          T[k * size_ + l] += w[k][i] * (t[3 * i] * w[l][0] + t[3 * i + 1] * w[l][1] + t[3 * i + 2] * w[l][2]);
    }
  }
  return T;
}

std::vector<double> FreeModes::on_modes(std::span<const double> u, std::span<const double> field) const {
  std::vector<double> out(size_, 0.0);
  for (const Body& body : bodies_)
    for (std::size_t k = 0; k < body.modes.size(); ++k)
      for (const Index n : body.nodes)
        out[body.first + k] += dot(combine(body, body.modes[k], n, u), vector_at(field, static_cast<std::size_t>(n)));
  return out;
}

/// Bodies pass their loads on: what rounding leaves on one may come from the load of another.
double FreeModes::largest_load(std::span<const double> u, std::span<const double> magnitude) const {
  double largest = 0.0;
  for (const Body& body : bodies_) {
    for (const Candidate& mode : body.modes) {
      double parts = 0.0;
      for (const Index n : body.nodes)
        parts += norm(combine(body, mode, n, u)) * norm(vector_at(magnitude, static_cast<std::size_t>(n)));
      largest = std::max(largest, parts);
    }
  }
  return largest;
}

std::vector<double> FreeModes::unheld(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                      std::span<const double> u, std::span<const double> force,
                                      std::span<const double> magnitude) const {
  std::vector<double> T = stiffness_of_rows(rows, D, u), e(size_);
  double most = 0.0;
  for (std::size_t k = 0; k < size_; ++k) most = std::max(most, T[k * size_ + k]);
  for (std::size_t k = 0; k < size_; ++k) {
    e[k] = std::max(1e-12 * pin_stiffness(k), 1e-14 * most);
    T[k * size_ + k] += e[k];
  }
  const double largest = largest_load(u, magnitude);
  std::vector<double> rho = on_modes(u, force);
  DenseLu(std::move(T), static_cast<int>(size_)).solve(rho);
  for (std::size_t k = 0; k < size_; ++k) {
    rho[k] *= e[k];
    if (std::abs(rho[k]) <= 1e-8 * largest) rho[k] = 0.0;
  }
  return rho;
}

SymmetricEigen FreeModes::resistance(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                     std::span<const double> u) const {
  const std::size_t d = size_;
  std::vector<double> T = stiffness_of_rows(rows, D, u);
  for (std::size_t k = 0; k < d; ++k) {
    for (std::size_t l = 0; l <= k; ++l) {
      const double mean = 0.5 * (T[k * d + l] + T[l * d + k]) / std::sqrt(pin_stiffness(k) * pin_stiffness(l));
      T[k * d + l] = T[l * d + k] = mean;
    }
  }
  return symmetric_eigen(std::move(T), static_cast<int>(d));
}

std::vector<double> FreeModes::weak_part(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                         std::span<const double> u, std::span<const double> c, double a) const {
  const SymmetricEigen eigen = resistance(rows, D, u);
  std::vector<double> out(size_, 0.0);
  for (std::size_t m = 0; m < size_ && eigen.values[m] <= held; ++m) {
    const double* v = eigen.vectors.data() + m * size_;
    double part = 0.0;
    for (std::size_t k = 0; k < size_; ++k) part += v[k] * c[k] * std::pow(pin_stiffness(k), -a);
    for (std::size_t k = 0; k < size_; ++k) out[k] += v[k] * part * std::pow(pin_stiffness(k), a);
  }
  return out;
}

std::vector<double> FreeModes::per_square(std::span<const double> u, std::span<const double> c) const {
  std::vector<double> out(c.begin(), c.end());
  for (const Body& body : bodies_) {
    const std::size_t count = body.modes.size();
    if (count == 0) continue;
    std::vector<double> square(count * count, 0.0);
    for (const Index n : body.nodes)
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t l = 0; l < count; ++l)
          square[k * count + l] += dot(combine(body, body.modes[k], n, u), combine(body, body.modes[l], n, u));
    std::vector<double> own(out.begin() + static_cast<std::ptrdiff_t>(body.first),
                            out.begin() + static_cast<std::ptrdiff_t>(body.first + count));
    DenseLu(std::move(square), static_cast<int>(count)).solve(own);
    std::copy(own.begin(), own.end(), out.begin() + static_cast<std::ptrdiff_t>(body.first));
  }
  return out;
}

void FreeModes::take_motion(std::span<const double> u, std::span<const double> c, std::span<double> field) const {
  for (const Body& body : bodies_) {
    for (const Index n : body.nodes) {
      for (std::size_t k = 0; k < body.modes.size(); ++k) {
        const Vec3 v = combine(body, body.modes[k], n, u);
        for (std::size_t i = 0; i < 3; ++i) field[3 * static_cast<std::size_t>(n) + i] -= c[body.first + k] * v[i];
      }
    }
  }
}

std::vector<double> FreeModes::relieve(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                       std::span<const double> u, std::span<double> force) const {
  std::vector<double> weak = weak_part(rows, D, u, on_modes(u, force), 0.5);
  take_motion(u, per_square(u, weak), force);
  return weak;
}

bool FreeModes::are_loads(std::span<const double> weak, std::span<const double> u,
                          std::span<const double> magnitude) const {
  const double limit = 1e-9 * largest_load(u, magnitude);
  return largest_of(weak) > limit;
}

void FreeModes::move_weakly(const ConstraintRows& rows, const std::vector<RowTangent>& D, std::span<const double> u,
                            std::span<const double> weak, std::span<double> dy) const {
  std::vector<double> change = weak_part(rows, D, u, per_square(u, on_modes(u, dy)), -0.5);
  for (std::size_t k = 0; k < size_; ++k) change[k] -= weak[k] / pin_stiffness(k);
  take_motion(u, change, dy);
}

std::vector<double> FreeModes::needless(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                        std::span<const double> u) const {
  const std::size_t d = size_;
  const SymmetricEigen eigen = resistance(rows, D, u);
  // An orthonormal basis of the pins' displacements, scaled by the roots of their stiffnesses.
  std::vector<std::vector<double>> basis;
  for (std::size_t m = 0; m < d; ++m) {
    if (!(eigen.values[m] > held)) continue;
    std::vector<double> p(d, 0.0);
    for (const Body& body : bodies_) {
      for (std::size_t i = 0; i < body.pins.size(); ++i) {
        const auto node = static_cast<Index>(body.pins[i] / 3);
        for (std::size_t k = 0; k < body.modes.size(); ++k)
          p[body.first + i] +=
              combine(body, body.modes[k], node, u)[body.pins[i] % 3] * eigen.vectors[m * d + body.first + k];
      }
    }
    for (int again = 0; again < 2; ++again) {
      for (const std::vector<double>& q : basis) {
        const double part = dot(p, q);
        for (std::size_t i = 0; i < d; ++i) p[i] -= part * q[i];
      }
    }
    const double length = std::sqrt(dot(p, p));
    for (double& v : p) v /= length;
    basis.push_back(std::move(p));
  }
  if (basis.empty()) return {};
  std::vector<double> N(d * d, 0.0);
  for (const std::vector<double>& q : basis)
    for (std::size_t i = 0; i < d; ++i)
      for (std::size_t j = 0; j < d; ++j) N[i * d + j] += std::sqrt(pin_stiffness(i) * pin_stiffness(j)) * q[i] * q[j];
  return N;
}

std::string FreeModes::describe(std::span<const double> load) const {
  const auto largest = static_cast<std::size_t>(
      std::max_element(load.begin(), load.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      load.begin());
  const Body& body = bodies_[body_of_mode_[largest]];
  Candidate sum{};
  for (std::size_t k = 0; k < body.modes.size(); ++k)
    for (std::size_t j = 0; j < 6; ++j) sum[j] += load[body.first + k] * body.modes[k][j];
  const bool is_turn = std::hypot(sum[3], sum[4], sum[5]) > std::hypot(sum[0], sum[1], sum[2]);
  const std::size_t at = is_turn ? 3 : 0;
  const Vec3 direction = normalized({sum[at], sum[at + 1], sum[at + 2]});
  const Vec3& c = body.centre;
  return fmt::format("the body about ({:.4g}, {:.4g}, {:.4g}), with node {}, {} ({:.3g}, {:.3g}, {:.3g})", c[0], c[1],
                     c[2], system_.mesh.node_label(body.nodes[0]), is_turn ? "about the axis" : "along", direction[0],
                     direction[1], direction[2]);
}

}  // namespace carom
