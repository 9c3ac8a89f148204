// Meshes that are surfaces only, and checks of the rows made from them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "contact/contact_geometry.hpp"
#include "math/vec3.hpp"

namespace carom::test {

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }

 private:
  std::mt19937 generator_;
};

/// Nodes and surfaces of a model that is only its contacts.
struct Scene {
  Mesh mesh;
  Model model;

  Index add_node(const Vec3& x) {
    mesh.coordinates.push_back(x);
    mesh.node_numbers.push_back(static_cast<std::int64_t>(mesh.coordinates.size()));
    return static_cast<Index>(mesh.coordinates.size()) - 1;
  }
  /// n_1 x n_2 facets (quadrilaterals, or twice as many triangles) over at(s, t), s and t in [0, 1]; the normal is
  /// along d/ds x d/dt.
  template <class At>
  std::vector<Facet> add_patch(int n_1, int n_2, const At& at, bool triangles = false) {
    std::vector<Index> node;
    for (int j = 0; j <= n_2; ++j)
      for (int i = 0; i <= n_1; ++i) node.push_back(add_node(at(double(i) / n_1, double(j) / n_2)));
    std::vector<Facet> facets;
    for (int j = 0; j < n_2; ++j) {
      for (int i = 0; i < n_1; ++i) {
        const auto n = [&](int di, int dj) { return node[static_cast<std::size_t>((j + dj) * (n_1 + 1) + i + di)]; };
        if (triangles) {
          facets.push_back({{n(0, 0), n(1, 0), n(1, 1), -1}, 3});
          facets.push_back({{n(0, 0), n(1, 1), n(0, 1), -1}, 3});
        } else {
          facets.push_back({{n(0, 0), n(1, 0), n(1, 1), n(0, 1)}, 4});
        }
      }
    }
    return facets;
  }
  /// The skin of the box [low, high], facets of n x n x n, normals outward.
  std::vector<Facet> add_box(const Vec3& low, const Vec3& high, int n) {
    std::vector<Facet> facets;
    std::map<std::array<int, 3>, Index> node;
    const auto at = [&](std::array<int, 3> i) {
      const auto [entry, is_new] = node.try_emplace(i, static_cast<Index>(mesh.coordinates.size()));
      if (is_new) {
        Vec3 x{};
        for (std::size_t c = 0; c < 3; ++c) x[c] = low[c] + (high[c] - low[c]) * i[c] / n;
        add_node(x);
      }
      return entry->second;
    };
    for (std::size_t c = 0; c < 3; ++c) {
      for (const int side : {0, n}) {
        for (int i = 0; i < n; ++i) {
          for (int j = 0; j < n; ++j) {
            const auto corner = [&](int di, int dj) {
              std::array<int, 3> k{};
              k[c] = side;
              k[(c + 1) % 3] = i + di;
              k[(c + 2) % 3] = j + dj;
              return at(k);
            };
            Facet facet{{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, 4};
            if (side == 0) std::swap(facet.node[1], facet.node[3]);
            facets.push_back(facet);
          }
        }
      }
    }
    return facets;
  }
  /// Closes the mesh; the model is complete when its contacts are added.
  Model& finish() {
    model.mesh = std::make_shared<const Mesh>(mesh);
    return model;
  }
  std::vector<double> zero() const { return std::vector<double>(3 * mesh.coordinates.size(), 0.0); }
};

inline std::vector<double> with_displacement(std::vector<double> u, Index n, const Vec3& d) {
  for (std::size_t c = 0; c < 3; ++c) u[3 * static_cast<std::size_t>(n) + c] += d[c];
  return u;
}

/// Random displacements up to `size`.
inline std::vector<double> shaken(const Scene& scene, Random& random, double size) {
  std::vector<double> u = scene.zero();
  for (double& x : u) x = random(-size, size);
  return u;
}

/// Sum of the springs' energies at u.
inline double energy(const ContactGeometry& contact, const std::vector<double>& u) {
  const auto rows = contact.rows_at(u, u);
  double sum = 0.0;
  for (std::size_t r = 0; r < rows->size(); ++r) sum += rows->law[r].spring_energy(std::max(0.0, -rows->gap_at(r, u)));
  return sum;
}

/// Forces of the springs at u, by dof.
inline std::vector<double> forces(const ContactGeometry& contact, const std::vector<double>& u) {
  const auto rows = contact.rows_at(u, u);
  std::vector<double> f(u.size(), 0.0);
  for (std::size_t r = 0; r < rows->size(); ++r)
    rows->scatter(r, {rows->law[r].spring_force(std::max(0.0, -rows->gap_at(r, u))), 0.0, 0.0}, f);
  return f;
}

/// Number of the row of a slot, or -1.
inline std::ptrdiff_t row_of(const ConstraintRows& rows, Index slot) {
  const auto found = std::find(rows.slot.begin(), rows.slot.end(), slot);
  return found == rows.slot.end() ? -1 : found - rows.slot.begin();
}

/// Gap of the slot at u, made there.
inline double gap_of(const ContactGeometry& contact, const std::vector<double>& u, Index slot) {
  const auto rows = contact.rows_at(u, u);
  const auto r = row_of(*rows, slot);
  return r < 0 ? NAN : rows->gap_at(static_cast<std::size_t>(r), u);
}

/// The normal block of every row of the first `slots` against central differences of the gap, by steps h; returns the
/// largest error.
inline double gradient_error(const ContactGeometry& contact, const std::vector<double>& u, double h,
                             Index slots = std::numeric_limits<Index>::max()) {
  const auto rows = contact.rows_at(u, u);
  double error = 0.0;
  for (std::size_t r = 0; r < rows->size() && rows->slot[r] < slots; ++r) {
    for (Index k = rows->begin[r]; k < rows->begin[r + 1]; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        Vec3 d{};
        d[c] = h;
        const Index n = rows->node[static_cast<std::size_t>(k)];
        const double up = gap_of(contact, with_displacement(u, n, d), rows->slot[r]);
        d[c] = -h;
        const double down = gap_of(contact, with_displacement(u, n, d), rows->slot[r]);
        const double slope = (up - down) / (2.0 * h) - rows->block[static_cast<std::size_t>(k)][0][c];
        error = std::max(error, std::isnan(slope) ? INFINITY : std::abs(slope));
      }
    }
  }
  return error;
}

/// Sums of the nodal forces and of their moments about the origin for the force s of row r at displacement u.
struct Resultant {
  Vec3 force{}, moment{};
};
inline Resultant resultant(const Scene& scene, const ConstraintRows& rows, std::size_t r, const Vec3& s,
                           const std::vector<double>& u) {
  std::vector<double> f(u.size(), 0.0);
  rows.scatter(r, s, f);
  Resultant sum;
  for (std::size_t n = 0; n < scene.mesh.coordinates.size(); ++n) {
    const Vec3 x = add(scene.mesh.coordinates[n], {u[3 * n], u[3 * n + 1], u[3 * n + 2]});
    const Vec3 force{f[3 * n], f[3 * n + 1], f[3 * n + 2]};
    sum.force = add(sum.force, force);
    sum.moment = add(sum.moment, cross(x, force));
  }
  return sum;
}

}  // namespace carom::test
