#include "solid/springs.hpp"

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "solid/assembly.hpp"

namespace carom {

namespace {

Vec3 node_value(std::span<const double> u, Index node) {
  return {u[3 * at(node)], u[3 * at(node) + 1], u[3 * at(node) + 2]};
}

Vec3 elongation(const Spring& spring, std::span<const double> u) {
  return subtract(node_value(u, spring.nodes[0]), node_value(u, spring.nodes[1]));
}

Vec3 force(const Spring& spring, const Vec3& d) {
  return {dot(spring.stiffness[0], d), dot(spring.stiffness[1], d), dot(spring.stiffness[2], d)};
}

}  // namespace

void Springs::add_scaled(double scale, std::span<const double> u, std::span<double> f) const {
  for (const Spring& spring : springs_) {
    const Vec3 k_d = force(spring, elongation(spring, u));
    for (std::size_t c = 0; c < 3; ++c) {
      f[3 * at(spring.nodes[0]) + c] += scale * k_d[c];
      f[3 * at(spring.nodes[1]) + c] -= scale * k_d[c];
    }
  }
}

std::vector<std::vector<Index>> Springs::links() const {
  std::vector<std::vector<Index>> links;
  for (const Spring& spring : springs_) links.emplace_back(spring.nodes.begin(), spring.nodes.end());
  return links;
}

void Springs::add_force(std::span<const double> u, const PointStep& /*step*/, std::span<double> f,
                        SolidEnergies* energies, std::span<double> /*end*/) const {
  add_scaled(1.0, u, f);
  if (energies == nullptr) return;
  for (const Spring& spring : springs_) {
    const Vec3 d = elongation(spring, u);
    energies->strain += 0.5 * dot(d, force(spring, d));
  }
}

void Springs::add_discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1,
                                          std::span<double> f) const {
  add_scaled(0.5, u_0, f);
  add_scaled(0.5, u_1, f);
}

void Springs::add_tangent_action(std::span<const double> /*u*/, std::span<const double> x, std::span<double> y,
                                 const PointStep& /*step*/) const {
  add_scaled(1.0, x, y);
}

void Springs::add_tangent(std::span<const double> /*u*/, const PointStep& /*step*/, CsrMatrix& K) const {
  for (const Spring& spring : springs_)
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t b = 0; b < 2; ++b)
        for (std::size_t i = 0; i < 3; ++i) {
          double* row = K.value.data() + entry(K, 3 * spring.nodes[a] + static_cast<Index>(i), 3 * spring.nodes[b]);
          for (std::size_t j = 0; j < 3; ++j) row[j] += (a == b ? 1.0 : -1.0) * spring.stiffness[i][j];
        }
}

void Springs::add_tangent_diagonal(std::span<const double> /*u*/, const PointStep& /*step*/,
                                   std::span<double> diagonal) const {
  for (const Spring& spring : springs_)
    for (const Index node : spring.nodes)
      for (std::size_t i = 0; i < 3; ++i) diagonal[3 * at(node) + i] += spring.stiffness[i][i];
}

}  // namespace carom
