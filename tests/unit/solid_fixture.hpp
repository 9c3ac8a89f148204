// Small models for the tests of the solid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "mesh/structured_block.hpp"
#include "model/model.hpp"
#include "solid/solid.hpp"

namespace carom::test {

/// A steel-like material with numbers near 1, so that absolute tolerances have a meaning.
inline constexpr LinearElastic unit_material{{.E = 2.0, .nu = 0.3, .rho = 1.5}};

/// Block of the given divisions with edges of length `edge`; inner nodes moved by up to `distortion` x edge (seeded).
/// With a distortion of 0.2 all Jacobian determinants stay positive.
inline Mesh block_mesh(std::array<int, 3> divisions, double distortion, double edge = 1.0, unsigned seed = 1) {
  StructuredBlock block;
  block.size = {edge * divisions[0], edge * divisions[1], edge * divisions[2]};
  block.divisions = divisions;
  Mesh mesh = make_structured_blocks({block});
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> move(-distortion * edge, distortion * edge);
  for (Vec3& x : mesh.coordinates)
    for (std::size_t i = 0; i < 3; ++i) {
      const double step = move(generator);
      const bool inside = x[i] > 0.5 * edge && x[i] < block.size[i] - 0.5 * edge;
      if (inside) x[i] += step;
    }
  return mesh;
}

/// One part of all HEXA8 cells.
inline Model one_part(Mesh mesh, const Material& material = unit_material) {
  Model model;
  Part part{.name = "body", .cells = {}, .material = material};
  for (std::size_t c = 0; c < mesh.block(CellType::hexa8)->size(); ++c) part.cells.push_back(static_cast<Index>(c));
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.parts.push_back(std::move(part));
  return model;
}

/// The same bodies, their cells integrated at all points.
inline Model fully_integrated(Model model) {
  for (Part& part : model.parts) part.formulation = Formulation::full;
  return model;
}

/// Uniform numbers in [-1, 1].
inline std::vector<double> random_vector(std::size_t n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<double> x(n);
  for (double& entry : x) entry = value(generator);
  return x;
}

inline double largest(const std::vector<double>& x) {
  double m = 0.0;
  for (const double entry : x) m = std::max(m, std::abs(entry));
  return m;
}

inline double largest_difference(const std::vector<double>& x, const std::vector<double>& y) {
  double m = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) m = std::max(m, std::abs(x[i] - y[i]));
  return m;
}

inline std::vector<double> internal_force(const Solid& solid, const std::vector<double>& u,
                                          const PointStep& step = {}) {
  std::vector<double> f(u.size());
  solid.internal_force(u, f, step);
  return f;
}

/// u_i = sum over j of gradient[i][j] x_j + shift_i
inline std::vector<double> affine(const Mesh& mesh, const std::array<Vec3, 3>& gradient, const Vec3& shift = {}) {
  std::vector<double> u;
  for (const Vec3& x : mesh.coordinates)
    for (std::size_t i = 0; i < 3; ++i)
      u.push_back(gradient[i][0] * x[0] + gradient[i][1] * x[1] + gradient[i][2] * x[2] + shift[i]);
  return u;
}

/// Instruction sets of this processor, the reference first.
inline std::vector<Isa> available_isas() {
  std::vector<Isa> isas;
  for (const Isa isa : {Isa::reference, Isa::x86_64_v2, Isa::x86_64_v3, Isa::x86_64_v4})
    if (supported(isa)) isas.push_back(isa);
  return isas;
}

/// Eigenvalues of a small symmetric matrix by Jacobi rotations (Golub and Van Loan, 4th ed., section 8.5), ascending.
/// Entries below round-off of the largest are left alone.
inline std::vector<double> eigenvalues(std::vector<std::vector<double>> A) {
  const std::size_t n = A.size();
  double small = 0.0;
  for (const auto& row : A) small = std::max(small, 1e-17 * largest(row));
  for (int sweep = 0; sweep < 30; ++sweep)
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        if (std::abs(A[p][q]) <= small) continue;
        const double theta = (A[q][q] - A[p][p]) / (2 * A[p][q]);
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (std::size_t k = 0; k < n; ++k) {
          const double a = A[k][p], b = A[k][q];
          A[k][p] = c * a - s * b, A[k][q] = s * a + c * b;
        }
        for (std::size_t k = 0; k < n; ++k) {
          const double a = A[p][k], b = A[q][k];
          A[p][k] = c * a - s * b, A[q][k] = s * a + c * b;
        }
      }
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(A[i][i]);
  std::sort(values.begin(), values.end());
  return values;
}

inline std::vector<std::vector<double>> dense(const CsrMatrix& K) {
  const auto n = static_cast<std::size_t>(K.size);
  std::vector<std::vector<double>> A(n, std::vector<double>(n, 0.0));
  for (std::size_t r = 0; r < n; ++r)
    for (auto k = static_cast<std::size_t>(K.row_begin[r]); k < static_cast<std::size_t>(K.row_begin[r + 1]); ++k)
      A[r][static_cast<std::size_t>(K.column[k])] = K.value[k];
  return A;
}

}  // namespace carom::test
