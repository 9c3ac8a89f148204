// Single points of a law with their history, for the tests of laws.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "material/law_table.hpp"

namespace carom::test {

using Voigt = std::array<double, 6>;
using Tensor = std::array<std::array<double, 3>, 3>;

/// What a law answers at one point.
struct Answer {
  Voigt strain{}, stress{};
  double energy = 0.0, dissipation = 0.0, wave_modulus = 0.0;
  std::vector<double> history{};
};

/// A law in plain double.
struct PointLaw {
  explicit PointLaw(const Material& material, int free_directions = 0)
      : law(prepare(material, free_directions, make_law_table<double>())) {}

  std::vector<double> rest() const { return std::vector<double>(static_cast<std::size_t>(law.history), 0.0); }

  Answer update(const Voigt& strain, const std::vector<double>& history, double dt = 1.0) const {
    Answer answer{strain};
    answer.history.resize(history.size());
    law.kernels.update(law.parameters.get(),
                       {1, answer.strain.data(), answer.stress.data(), &answer.energy, dt, history.data(),
                        answer.history.data(), &answer.dissipation, &answer.wave_modulus});
    return answer;
  }

  Voigt tangent(const Voigt& strain, const Voigt& change, const std::vector<double>& history, double dt = 1.0) const {
    Voigt result{};
    law.kernels.tangent(law.parameters.get(), {1, strain.data(), change.data(), result.data(), dt, history.data()});
    return result;
  }

  PreparedLaw law;
};

inline Tensor product(const Tensor& A, const Tensor& B) {
  Tensor C{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) C[i][j] += A[i][k] * B[k][j];
  return C;
}

inline Tensor transposed(const Tensor& A) {
  Tensor T{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) T[i][j] = A[j][i];
  return T;
}

inline double determinant_of(const Tensor& A) {
  return A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) - A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
         A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
}

/// Components in Voigt order; shear times `shear`: 2 for strains, 1 for stresses.
inline Voigt voigt(const Tensor& A, double shear) {
  return {A[0][0], A[1][1], A[2][2], shear * A[0][1], shear * A[1][2], shear * A[2][0]};
}

inline Tensor tensor(const Voigt& v, double shear) {
  return {{{v[0], v[3] / shear, v[5] / shear}, {v[3] / shear, v[1], v[4] / shear}, {v[5] / shear, v[4] / shear, v[2]}}};
}

/// (F^T F - 1) / 2
inline Voigt green_lagrange(const Tensor& F) {
  Tensor E = product(transposed(F), F);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) E[i][j] = 0.5 * (E[i][j] - (i == j ? 1.0 : 0.0));
  return voigt(E, 2.0);
}

/// Rotation by the three angles about z, x and z.
inline Tensor rotation(double a, double b, double c) {
  const auto about_z = [](double angle) {
    return Tensor{{{std::cos(angle), -std::sin(angle), 0}, {std::sin(angle), std::cos(angle), 0}, {0, 0, 1}}};
  };
  const Tensor about_x{{{1, 0, 0}, {0, std::cos(b), -std::sin(b)}, {0, std::sin(b), std::cos(b)}}};
  return product(about_z(a), product(about_x, about_z(c)));
}

/// Von Mises' stress.
inline double equivalent(const Voigt& s) {
  const double p = (s[0] + s[1] + s[2]) / 3;
  double square = 0.0;
  for (std::size_t c = 0; c < 6; ++c) square += c < 3 ? (s[c] - p) * (s[c] - p) : 2 * s[c] * s[c];
  return std::sqrt(1.5 * square);
}

/// Curves at the rates 0, 10 and 100.
inline Material with_rates(const char* law, double E, double nu) {
  Material material(law, 1.0, {{"E", E}, {"nu", nu}});
  material.rates = {0.0, 10.0, 100.0};
  material.curve = {{0.0, 1.0}, {0.1, 2.0}, {0.0, 1.5}, {0.05, 2.0}, {0.0, 2.5}};
  return material;
}

/// Swift's hardening from the yield stress 1.
inline Material swift(double E, double nu) {
  return {"swift_small_strain",
          1.0,
          {{"E", E}, {"nu", nu}, {"yield_stress", 1.0}, {"pre_strain", 0.01}, {"exponent", 0.2}}};
}

}  // namespace carom::test
