// Neo-Hookean law, laws under zero lateral stress and the discrete gradient, at single points.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "material/discrete_gradient.hpp"
#include "material/lateral_update.hpp"
#include "material/law_table.hpp"

namespace carom::material_neo_hookean_test {
namespace {

constexpr NeoHookean material{{.E = 2.0, .nu = 0.3, .rho = 1.0}};
const LameParameters lame = material.lame();
constexpr double round_off = 1e-14;  // some tens of operations on numbers near 1

using Voigt = std::array<double, 6>;

const PreparedLaw neo_hookean = prepare(material, 0, make_law_table<double>()),
                  linear = prepare(LinearElastic{IsotropicElastic{material}}, 0, make_law_table<double>()),
                  plane_stress_neo_hookean = prepare(material, 1, make_law_table<double>()),
                  plane_stress_linear = prepare(LinearElastic{IsotropicElastic{material}}, 1, make_law_table<double>()),
                  bar_neo_hookean = prepare(material, 2, make_law_table<double>()),
                  bar_linear = prepare(LinearElastic{IsotropicElastic{material}}, 2, make_law_table<double>());

struct Response {
  Voigt strain, stress{};
  double energy = 0.0;
};

Response respond(const PreparedLaw& law, const Voigt& strain) {
  Response response{strain};
  law.kernels.update(law.parameters.get(), {1, response.strain.data(), response.stress.data(), &response.energy});
  return response;
}

Voigt tangent(const PreparedLaw& law, const Voigt& strain, const Voigt& change) {
  Voigt result{};
  law.kernels.tangent(law.parameters.get(), {1, strain.data(), change.data(), result.data()});
  return result;
}

// Principal stretches a, b, c: S_i = G (1 - 1/C_i) + lambda ln J / C_i, W = G/2 (tr C - 3) - G ln J + lambda/2 (ln J)^2
// (Bonet and Wood, eqs. 6.27 and 6.28).
TEST(NeoHookean, IsItsFormulaInPrincipalStretches) {
  for (const std::array<double, 3>& stretch :
       {std::array<double, 3>{1.3, 0.9, 1.05}, {0.4, 0.7, 1.1}, {3.0, 2.0, 1.0}, {1.001, 0.999, 1.0}}) {
    const double ln_J = std::log(stretch[0] * stretch[1] * stretch[2]);
    Voigt strain{};
    double trace = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      strain[i] = 0.5 * (stretch[i] * stretch[i] - 1.0);
      trace += stretch[i] * stretch[i];
    }
    const Response response = respond(neo_hookean, strain);
    for (std::size_t i = 0; i < 3; ++i) {
      const double C = stretch[i] * stretch[i];
      EXPECT_NEAR(response.stress[i], lame.G * (1 - 1 / C) + lame.lambda * ln_J / C, 100 * round_off);
    }
    const double energy = 0.5 * lame.G * (trace - 3) - lame.G * ln_J + 0.5 * lame.lambda * ln_J * ln_J;
    EXPECT_NEAR(response.energy, energy, 100 * round_off);
  }
}

// At strains of 1e-6 the law is Hooke's up to relative 1e-5, and nothing may cancel on the way.
TEST(NeoHookean, IsHookeAtSmallStrain) {
  const Voigt strain{1e-6, -2e-6, 5e-7, 1e-6, -1e-6, 3e-7};
  const Response response = respond(neo_hookean, strain), hooke = respond(linear, strain);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(response.stress[c], hooke.stress[c], 1e-5 * 3e-6);
  EXPECT_NEAR(response.energy, hooke.energy, 1e-5 * hooke.energy);
}

TEST(NeoHookean, ANegativeDeterminantGivesNoNumber) {
  EXPECT_TRUE(std::isnan(respond(neo_hookean, {-0.6, 0.0, 0.0, 0.0, 0.0, 0.0}).stress[0]));  // C_xx = -0.2
}

constexpr Voigt at_3d{0.2, -0.1, 0.15, 0.3, -0.2, 0.1}, at_plane{0.2, -0.1, 0.0, 0.3, 0.0, 0.0}, at_bar{0.25};

struct Case {
  const char* name;
  PreparedLaw law;
  Voigt strain;
  std::vector<std::size_t> active;  ///< components that are free to change
};

// S = dW/dE and D = dS/dE by central differences; h = 1e-5 leaves h^2 / 6 times third
// derivatives, which are some 100 at these strains, and round-off of 1e-15 / h.
TEST(Laws, StressIsTheDerivativeOfTheEnergyAndTheTangentThatOfTheStress) {
  const std::vector<std::size_t> all{0, 1, 2, 3, 4, 5}, plane{0, 1, 3}, axial{0};
  const std::vector<Case> cases{{"neo-Hookean", neo_hookean, at_3d, all},
                                {"plane stress, linear", plane_stress_linear, at_plane, plane},
                                {"plane stress, neo-Hookean", plane_stress_neo_hookean, at_plane, plane},
                                {"bar, linear", bar_linear, at_bar, axial},
                                {"bar, neo-Hookean", bar_neo_hookean, at_bar, axial}};
  const double h = 1e-5;
  for (const Case& c : cases)
    for (const std::size_t i : c.active) {
      Voigt plus = c.strain, minus = c.strain, unit{};
      plus[i] += h;
      minus[i] -= h;
      unit[i] = 1.0;
      const Response up = respond(c.law, plus), down = respond(c.law, minus);
      EXPECT_NEAR((up.energy - down.energy) / (2 * h), respond(c.law, c.strain).stress[i], 1e-8) << c.name << i;
      const Voigt D = tangent(c.law, c.strain, unit);
      for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_NEAR((up.stress[j] - down.stress[j]) / (2 * h), D[j], 1e-8) << c.name << i << j;
      }
    }
}

// The eliminated strain is the one under which the law in three dimensions has no lateral stress.
TEST(Laws, LateralStressesVanish) {
  struct Pair {
    const PreparedLaw &lateral, &full;
  };
  for (const auto& [lateral, full] : {Pair{plane_stress_linear, linear},
                                      {plane_stress_neo_hookean, neo_hookean},
                                      {bar_linear, linear},
                                      {bar_neo_hookean, neo_hookean}})
    for (const double scale : {1.0, -1.0, 1e-4}) {
      Voigt strain = at_plane;
      for (double& e : strain) e *= scale;
      const bool bar = &lateral == &bar_linear || &lateral == &bar_neo_hookean;
      if (bar) strain = {scale * 0.3};
      const Response response = respond(lateral, strain), check = respond(full, response.strain);
      EXPECT_NEAR(check.stress[2], 0.0, round_off);
      if (bar) {
        EXPECT_NEAR(check.stress[1], 0.0, round_off);
      }
      EXPECT_NEAR(response.stress[0], check.stress[0], round_off);
      EXPECT_EQ(response.stress[2], 0.0);
    }
}

// A lateral stress that no strain makes vanish leaves no number, so that the step is refused, and the iteration ends.
TEST(Laws, NoLateralStrainIsFoundWhereThereIsNone) {
  LateralLaw law;
  law.least_strain = -0.5;
  law.kernels.update = [](const void*, const PointBatch& batch) { std::fill_n(batch.stress, 6, 1.0); };
  law.kernels.tangent = [](const void*, const TangentBatch& batch) { std::fill_n(batch.stress_change, 6, 1e-3); };
  Voigt strain{0.1};
  complete_strain<double>(law, strain.data(), nullptr, 0.0, nullptr);
  EXPECT_EQ(strain[0], 0.1);
  EXPECT_TRUE(std::isnan(strain[2]));
}

// A bar has Young's modulus: S = E E_11; plane stress E / (1 - nu^2) with the other side held.
TEST(Laws, LinearLateralLawsHaveTheirModuli) {
  EXPECT_NEAR(respond(bar_linear, {0.1}).stress[0], 2.0 * 0.1, round_off);
  EXPECT_NEAR(respond(plane_stress_linear, {0.1}).stress[0], 2.0 / (1 - 0.09) * 0.1, round_off);
}

// S : (e_1 - e_0) = W_1 - W_0 by construction; of quadratic energy the correction vanishes: S = (S_0 + S_1) / 2.
TEST(DiscreteGradient, HasTheWorkOfTheStep) {
  const Voigt e_0{0.2, -0.1, 0.15, 0.3, -0.2, 0.1}, e_1{-0.1, 0.2, 0.05, -0.2, 0.1, 0.25};
  Voigt middle{};
  for (std::size_t c = 0; c < 6; ++c) middle[c] = 0.5 * (e_0[c] + e_1[c]);
  for (const PreparedLaw& law : {neo_hookean, linear}) {
    const Response start = respond(law, e_0), end = respond(law, e_1), mid = respond(law, middle);
    Voigt S{};
    discrete_gradient_stress(e_0.data(), e_1.data(), mid.stress.data(), start.energy, end.energy, S.data());
    double work = 0.0, correction = 0.0;
    for (std::size_t c = 0; c < 6; ++c) {
      work += S[c] * (e_1[c] - e_0[c]);
      correction += std::abs(S[c] - 0.5 * (start.stress[c] + end.stress[c]));
    }
    EXPECT_NEAR(work, end.energy - start.energy, round_off);
    if (law.kernels.update == linear.kernels.update)
      EXPECT_LT(correction, 10 * round_off);
    else
      EXPECT_GT(correction, 1e-3);
  }
}

}  // namespace
}  // namespace carom::material_neo_hookean_test
