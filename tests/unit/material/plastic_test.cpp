// Von Mises plasticity at single points: closed forms, tangents, dissipation, objectivity, lanes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "material/hardening.hpp"
#include "material/johnson_cook.hpp"
#include "material_points.hpp"

namespace carom::test::material_plastic_test {
namespace {

constexpr double E = 200.0, nu = 0.3, G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu)), yield = 1.0, H = 10.0;
constexpr double round_off = 1e-13;  // some hundred operations on numbers near 1
const double root_3 = std::sqrt(3.0);

Material plastic(const char* law, double modulus = H) {
  return {law, 1.0, {{"E", E}, {"nu", nu}, {"yield_stress", yield}, {"hardening_modulus", modulus}}};
}

Material voce(const char* law) {
  Material material = plastic(law, 2.0);
  for (const auto& [key, value] : {std::pair{"saturation_stress", 1.5}, {"saturation_rate", 20.0}})
    for (std::size_t p = 0; p < material.values.size(); ++p)
      if (material.law->parameters[p].key == key) material.values[p] = value;
  return material;
}

Material tabulated(const char* law) {
  Material material(law, 1.0, {{"E", E}, {"nu", nu}});
  material.curve = {{0.0, 1.0}, {0.01, 1.2}, {0.05, 1.5}, {0.2, 1.5}, {0.5, 2.0}};
  return material;
}

Material johnson_cook(double C = 0.05, double taylor_quinney = 0.9, double specific_heat = 0.01) {
  return {"johnson_cook",
          8.0,
          {{"E", E},
           {"nu", nu},
           {"A", yield},
           {"B", 0.8},
           {"n", 0.4},
           {"C", C},
           {"m", 1.1},
           {"reference_rate", 1e-4},
           {"melting_temperature", 400.0},
           {"reference_temperature", 300.0},
           {"initial_temperature", 310.0},
           {"specific_heat", specific_heat},
           {"taylor_quinney", taylor_quinney}}};
}

/// All terms of the damage count.
Material damaged(Material material) {
  const bool has_heat = material.law->name == "johnson_cook";
  material.damage = JohnsonCookDamage{0.54, 4.89, -0.5, 0.014, has_heat ? 1.12 : 0.0, 1e-3};
  return material;
}

std::vector<Material> all_plastic() {
  return {plastic("j2_small_strain"),
          plastic("j2"),
          voce("j2_small_strain"),
          voce("j2"),
          tabulated("j2"),
          johnson_cook(),
          with_rates("j2_rate_small_strain", E, nu),
          with_rates("j2_rate", E, nu),
          swift(E, nu),
          damaged(plastic("j2_small_strain")),
          damaged(johnson_cook())};
}

/// Random paths of strain whose steps yield more often than not.
class Path {
 public:
  explicit Path(unsigned seed) : random_(seed) {}
  Voigt next(Voigt strain, double step) {
    std::uniform_real_distribution<double> uniform(-step, step);
    for (double& e : strain) e = 0.97 * e + uniform(random_);
    return strain;
  }

 private:
  std::mt19937 random_;
};

// sqrt(3) tau = yield + H alpha and gamma = tau / G + sqrt(3) alpha: alpha = (sqrt(3) G gamma - yield) / (3 G + H).
// Back to -gamma, the trial stress is |tau| beyond the surface that has grown.
TEST(PlasticSmall, ShearForthAndBackHasItsClosedForm) {
  const PointLaw law(plastic("j2_small_strain"));
  const double gamma = 0.05, alpha = (root_3 * G * gamma - yield) / (3 * G + H);
  const Answer forth = law.update({0, 0, 0, gamma, 0, 0}, law.rest());
  EXPECT_NEAR(forth.stress[3], (yield + H * alpha) / root_3, round_off);
  EXPECT_NEAR(forth.history[6], alpha, round_off);
  EXPECT_NEAR(forth.history[3], 0.5 * root_3 * alpha, round_off);
  EXPECT_NEAR(forth.dissipation, (yield + 0.5 * H * alpha) * alpha, round_off);
  EXPECT_NEAR(forth.energy, 0.5 * forth.stress[3] * forth.stress[3] / G, round_off);
  const Answer back = law.update({0, 0, 0, -gamma, 0, 0}, forth.history);
  const double trial = root_3 * G * (2 * gamma) - root_3 * forth.stress[3];
  const double more = (trial - yield - H * alpha) / (3 * G + H);
  EXPECT_NEAR(back.history[6], alpha + more, round_off);
  EXPECT_NEAR(back.stress[3], -(yield + H * (alpha + more)) / root_3, round_off);
}

// Held sides: the trial stress is 2 G eps, sigma_xx = K eps + 2/3 sigma_y.
TEST(PlasticSmall, UniaxialStrainHasItsClosedForm) {
  const PointLaw law(plastic("j2_small_strain"));
  for (const double eps : {0.02, -0.02, 0.5 * yield / (2 * G)}) {
    const Answer answer = law.update({eps, 0, 0, 0, 0, 0}, law.rest());
    const double trial = 2 * G * std::abs(eps), alpha = std::max(0.0, (trial - yield) / (3 * G + H));
    const double stress = K * eps + std::copysign(2.0 / 3.0, eps) * (trial - 3 * G * alpha);
    EXPECT_NEAR(answer.stress[0], stress, round_off);
    EXPECT_NEAR(answer.wave_modulus, K + 4.0 / 3.0 * G, round_off * E);
  }
}

// F = diag(l, 1/l, 1) keeps the principal directions, so the logarithmic strain e = ln l takes the place of the small
// one: alpha = (2 sqrt(3) G e - yield) / (3 G + H) in one step or in many, tau_1 = -tau_2 = sigma_y / sqrt(3), S_1 =
// tau_1 / l^2.
TEST(PlasticFinite, PureShearHasItsClosedFormInAnyNumberOfSteps) {
  const PointLaw law(plastic("j2"));
  const double e = 0.7, alpha = (2 * root_3 * G * e - yield) / (3 * G + H);
  for (const int steps : {1, 7, 100}) {
    std::vector<double> history = law.rest();
    Answer answer{};
    for (int i = 1; i <= steps; ++i) {
      const double l = std::exp(e * i / steps);
      answer = law.update(green_lagrange({{{l, 0, 0}, {0, 1 / l, 0}, {0, 0, 1}}}), history);
      history = answer.history;
    }
    const double tau = (yield + H * alpha) / root_3, tolerance = 100 * steps * 1e-16 * G;
    EXPECT_NEAR(answer.history[6], alpha, tolerance / G);
    EXPECT_NEAR(answer.stress[0], tau * std::exp(-2 * e), tolerance);
    EXPECT_NEAR(answer.stress[1], -tau * std::exp(2 * e), 4 * tolerance);
    EXPECT_NEAR(answer.stress[2], 0.0, tolerance);
    EXPECT_NEAR(answer.dissipation, (yield + 0.5 * H * alpha) * alpha, tolerance);
  }
}

// At strains of 1e-12 the law is Hooke's up to relative 1e-11, and nothing may cancel on the way; nor on the way of a
// body that has yielded by tiny amounts.
TEST(PlasticFinite, NothingCancelsAtSmallStrain) {
  const PointLaw law(plastic("j2")), hooke(Material("linear_elastic", 1.0, {{"E", E}, {"nu", nu}}));
  for (const double scale : {1e-6, 1e-10, 1e-12}) {
    Voigt strain{1.0, -2.0, 0.5, 1.0, -1.0, 0.3};
    for (double& e : strain) e *= scale;
    const Answer answer = law.update(strain, law.rest()), linear = hooke.update(strain, {});
    const double largest = 700 * scale;  // of the stress
    for (std::size_t c = 0; c < 6; ++c)
      EXPECT_NEAR(answer.stress[c], linear.stress[c], (10 * scale + 1e-15) * largest) << scale << c;
    EXPECT_NEAR(answer.energy, linear.energy, (10 * scale + 1e-14) * linear.energy);
  }
  const Material soft("j2", 1.0, {{"E", E}, {"nu", nu}, {"yield_stress", 1e-10}});
  const PointLaw small(Material("j2_small_strain", 1.0, {{"E", E}, {"nu", nu}, {"yield_stress", 1e-10}})), finite(soft);
  const Voigt strain{3e-12, -1e-12, 0, 2e-12, 0, 1e-12};
  const Answer a = small.update(strain, small.rest()), b = finite.update(strain, finite.rest());
  ASSERT_GT(a.history[6], 1e-13);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(b.stress[c], a.stress[c], 1e-11 * 1e-9) << c;
  for (std::size_t c = 0; c < 6; ++c)  // Cp^-1 - 1 = -2 eps_p
    EXPECT_NEAR(b.history[c], -2.0 * a.history[c], 1e-10 * 1e-12) << c;
}

// Yielding keeps the volume: det Cp = 1 after a thousand steps.
TEST(PlasticFinite, PlasticDeformationKeepsTheVolume) {
  const PointLaw law(voce("j2"));
  Path path(5);
  std::vector<double> history = law.rest();
  Voigt strain{};
  for (int i = 0; i < 1000; ++i) {
    strain = path.next(strain, 0.03);
    history = law.update(strain, history).history;
  }
  ASSERT_GT(history[6], 5.0);
  Tensor C = tensor({history[0], history[1], history[2], history[3], history[4], history[5]}, 1.0);
  for (std::size_t i = 0; i < 3; ++i) C[i][i] += 1.0;
  EXPECT_NEAR(determinant_of(C), 1.0, 1000 * 1e-15);
}

/// Strains at which principal values are apart, or two or three of them coincide.
const std::vector<Voigt> looked_at{{0.03, -0.02, 0.01, 0.04, -0.02, 0.03}, {0.05, -0.01, -0.01, 0, 0, 0},
                                   {0.02, 0.02, -0.03, 0, 0, 0},           {0.01, 0.01, 0.01, 0, 0, 0},
                                   {1e-3, -2e-3, 0, 1e-3, 0, 0},           {0.3, -0.1, 0.2, 0.4, 0.1, -0.2}};

// dS/dE by central differences with h = 1e-6: third derivatives, up to G / (elastic strain)^2 = 1e6 where the direction
// of the flow turns, leave h^2 / 6 of that, and round-off of the stresses, 1e-13, leaves 1e-7.
TEST(Plastic, TangentsAreTheDerivativesOfTheStressAndSymmetric) {
  const double h = 1e-6;
  for (const Material& material : all_plastic()) {
    const PointLaw law(material);
    const std::vector<double> yielded = law.update({-0.02, 0.03, 0.01, -0.01, 0.02, 0.01}, law.rest(), 0.1).history;
    for (const auto& history : {law.rest(), yielded})
      for (const Voigt& strain : looked_at) {
        std::array<Voigt, 6> D;
        for (std::size_t i = 0; i < 6; ++i) {
          Voigt plus = strain, minus = strain, unit{};
          plus[i] += h;
          minus[i] -= h;
          unit[i] = 1.0;
          D[i] = law.tangent(strain, unit, history, 0.1);
          const Answer up = law.update(plus, history, 0.1), down = law.update(minus, history, 0.1);
          for (std::size_t j = 0; j < 6; ++j)
            EXPECT_NEAR(D[i][j], (up.stress[j] - down.stress[j]) / (2 * h), 1e-6 * E) << material.law->name << i << j;
        }
        for (std::size_t i = 0; i < 6; ++i)
          for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(D[i][j], D[j][i], 1e-12 * E) << material.law->name;
      }
  }
}

// The step's stress is the derivative of stored energy and plastic work together (Ortiz and Stainier, Comput. Methods
// Appl. Mech. Eng. 171, 1999): the books of a step close to second order, whatever the law hardens by.
TEST(Plastic, StressIsTheDerivativeOfEnergyAndWork) {
  const double h = 1e-5;
  for (const Material& material :
       {plastic("j2_small_strain"), plastic("j2"), voce("j2"), tabulated("j2"), swift(E, nu)}) {
    const PointLaw law(material);
    const auto history = law.update({-0.02, 0.03, 0.01, -0.01, 0.02, 0.01}, law.rest()).history;
    for (const Voigt& strain : looked_at)
      for (std::size_t i = 0; i < 6; ++i) {
        Voigt plus = strain, minus = strain;
        plus[i] += h;
        minus[i] -= h;
        const Answer up = law.update(plus, history), down = law.update(minus, history);
        const double change = up.energy + up.dissipation - down.energy - down.dissipation;
        EXPECT_NEAR(change / (2 * h), law.update(strain, history).stress[i], 1e-7 * E) << material.law->name << i;
      }
  }
}

// Newton's method for the strains that meet given stresses, of size 1: each error at most the square of the one before,
// times the curvature of the response over its slope, some hundred, until round-off.
TEST(Plastic, NewtonIsQuadratic) {
  for (const Material& material : all_plastic()) {
    const PointLaw law(material);
    const auto history = law.update({0.01, -0.02, 0.01, 0.02, -0.01, 0.0}, law.rest(), 0.1).history;
    const Voigt wanted = law.update({0.02, -0.021, 0.005, 0.025, -0.01, 0.01}, history, 0.1).stress;
    Voigt strain{0.0195, -0.0208, 0.0052, 0.0251, -0.0101, 0.0099};
    std::vector<double> errors;
    for (int iteration = 0; iteration < 8; ++iteration) {
      const Answer answer = law.update(strain, history, 0.1);
      std::array<std::array<double, 7>, 6> A{};
      double error = 0.0;
      for (std::size_t r = 0; r < 6; ++r) {
        A[r][6] = wanted[r] - answer.stress[r];
        error = std::max(error, std::abs(A[r][6]));
      }
      errors.push_back(error);
      for (std::size_t c = 0; c < 6; ++c) {
        Voigt unit{};
        unit[c] = 1.0;
        const Voigt column = law.tangent(strain, unit, history, 0.1);
        for (std::size_t r = 0; r < 6; ++r) A[r][c] = column[r];
      }
      for (std::size_t k = 0; k < 6; ++k)  // positive definite: no pivots are needed
        for (std::size_t r = 0; r < 6; ++r) {
          if (r == k) continue;
          const double factor = A[r][k] / A[k][k];
          for (std::size_t c = k; c < 7; ++c) A[r][c] -= factor * A[k][c];
        }
      for (std::size_t c = 0; c < 6; ++c) strain[c] += A[c][6] / A[c][c];
    }
    ASSERT_GT(errors.front(), 1e-3) << material.law->name;
    for (std::size_t i = 1; i < errors.size(); ++i)
      EXPECT_LE(errors[i], std::max(1e-12, 100 * errors[i - 1] * errors[i - 1])) << material.law->name << i;
    EXPECT_LT(errors[5], 1e-12) << material.law->name;
  }
}

// 10,000 paths of 12 steps, eight at a time: no step gives dissipated energy back, and no stress leaves the yield
// surface.
TEST(Plastic, DissipationNeverFallsOnTenThousandPaths) {
  const std::vector<Material> materials = all_plastic();
  const int paths = 10000 / 8, steps = 12;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const PreparedLaw law = prepare(materials[m], 0, make_law_table<Pack8>());
    const auto size = static_cast<std::size_t>(8 * law.history);
    Path path(static_cast<unsigned>(11 + m));
    int yielded = 0;
    for (int k = static_cast<int>(m); k < paths; k += static_cast<int>(materials.size())) {
      std::array<Voigt, 8> lane{};
      std::vector<double> strain(48), stress(48), history(size), next(size), before(8), after(8);
      for (int i = 0; i < steps; ++i) {
        for (std::size_t l = 0; l < 8; ++l) {
          lane[l] = path.next(lane[l], 0.004 * (k % 7 + 1));
          for (std::size_t c = 0; c < 6; ++c) strain[8 * c + l] = lane[l][c];
        }
        law.kernels.update(law.parameters.get(), {1, strain.data(), stress.data(), nullptr, 0.01, history.data(),
                                                  next.data(), after.data(), nullptr});
        for (std::size_t l = 0; l < 8; ++l) {
          ASSERT_GE(after[l], before[l]) << materials[m].law->name;
          ASSERT_GE(next[8 * 6 + l], history[8 * 6 + l]);
          if (after[l] > before[l]) ++yielded;
        }
        std::swap(history, next);
        std::swap(before, after);
      }
    }
    EXPECT_GT(yielded, paths);
  }
}

TEST(PlasticSmall, NoStressLeavesTheYieldSurface) {
  for (const Material& material : {plastic("j2_small_strain"), voce("j2_small_strain"), tabulated("j2_small_strain")}) {
    const PointLaw law(material);
    const Hardening hardening(material);
    Path path(3);
    Voigt strain{};
    std::vector<double> history = law.rest();
    for (int i = 0; i < 2000; ++i) {
      strain = path.next(strain, 0.01);
      const Answer answer = law.update(strain, history);
      const double surface = hardening.begin(&answer.history[6]).stress, stress = equivalent(answer.stress);
      if (answer.history[6] > history[6])
        ASSERT_NEAR(stress, surface, 1e-12);
      else
        ASSERT_LE(stress, surface * (1 + 1e-14));
      history = answer.history;
    }
  }
}

// A rotation Q of all that came gives the stress rotated: S(E) is that of (Q F), whose E is the same up to round-off,
// and turning the reference frame turns S. E of strains up to 0.5 has round-off 1e-16, times moduli of 200 and
// amplified by the step's flow: 1e-12 relative to E.
TEST(PlasticFinite, SuperposedRotationsRotateTheStress) {
  for (const Material& material : {voce("j2"), johnson_cook()}) {
    const PointLaw law(material);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(-0.3, 0.3), angle(-3.0, 3.0);
    std::vector<double> plain = law.rest(), turned = law.rest(), framed = law.rest();
    const Tensor frame = rotation(0.5, -1.1, 0.7);
    for (int i = 0; i < 30; ++i) {
      Tensor F{};
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) F[r][c] = uniform(random) + (r == c ? 1.0 : 0.0);
      if (determinant_of(F) < 0.3) continue;
      const Tensor Q = rotation(angle(random), angle(random), angle(random));
      const Answer a = law.update(green_lagrange(F), plain), b = law.update(green_lagrange(product(Q, F)), turned);
      const Tensor S = tensor(a.stress, 1.0), expected = product(frame, product(S, transposed(frame)));
      const Answer c = law.update(green_lagrange(product(F, transposed(frame))), framed);
      for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(b.stress[k], a.stress[k], 1e-12 * E);
        EXPECT_NEAR(c.stress[k], voigt(expected, 1.0)[k], 1e-12 * E);
      }
      EXPECT_NEAR(b.energy, a.energy, 1e-12 * E);
      EXPECT_NEAR(b.dissipation, a.dissipation, 1e-12 * E);
      plain = a.history;
      turned = b.history;
      framed = c.history;
    }
    EXPECT_GT(plain[6], 1.0);
  }
}

/// Strains and histories of lanes, some elastic, some yielding, some at rest.
template <class Real>
void expect_lanes_as_plain(const Material& material, int free_directions) {
  constexpr int n = lanes<Real>;
  const PreparedLaw law = prepare(material, free_directions, make_law_table<Real>());
  const PointLaw one(material, free_directions);
  const auto variables = static_cast<std::size_t>(law.history);
  const std::size_t points = 3, N = static_cast<std::size_t>(n);
  std::vector<double> strain(6 * points * N), change(strain.size()), stress(strain.size()),
      stress_change(strain.size()), energy(points * N), dissipation(energy.size()), waves(energy.size()),
      history(variables * points * N), next(history.size());
  Path path(2);
  std::vector<Answer> expected;
  std::vector<Voigt> expected_change;
  for (std::size_t p = 0; p < points; ++p)
    for (std::size_t l = 0; l < N; ++l) {
      const Voigt first = path.next({}, 0.002 * static_cast<double>(l)), second = path.next(first, 0.01);
      const Voigt d = path.next({}, 1.0);
      const Answer before = one.update(first, one.rest(), 0.1);
      expected.push_back(one.update(second, before.history, 0.1));
      expected_change.push_back(one.tangent(second, d, before.history, 0.1));
      for (std::size_t c = 0; c < 6; ++c) {
        strain[(6 * p + c) * N + l] = second[c];
        change[(6 * p + c) * N + l] = d[c];
      }
      for (std::size_t c = 0; c < variables; ++c) history[(variables * p + c) * N + l] = before.history[c];
    }
  law.kernels.tangent(law.parameters.get(),
                      {points, strain.data(), change.data(), stress_change.data(), 0.1, history.data()});
  law.kernels.update(law.parameters.get(), {points, strain.data(), stress.data(), energy.data(), 0.1, history.data(),
                                            next.data(), dissipation.data(), waves.data()});
  for (std::size_t p = 0; p < points; ++p)
    for (std::size_t l = 0; l < N; ++l) {
      const Answer& a = expected[p * N + l];
      for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_NEAR(stress[(6 * p + c) * N + l], a.stress[c], 1e-13 * E);
        EXPECT_NEAR(stress_change[(6 * p + c) * N + l], expected_change[p * N + l][c], 1e-11 * E);
      }
      for (std::size_t c = 0; c < variables; ++c) EXPECT_NEAR(next[(variables * p + c) * N + l], a.history[c], 1e-13);
      EXPECT_NEAR(energy[p * N + l], a.energy, 1e-13);
      EXPECT_NEAR(dissipation[p * N + l], a.dissipation, 1e-13);
      EXPECT_NEAR(waves[p * N + l], a.wave_modulus, 1e-13 * a.wave_modulus);
    }
}

// Differences are those of fused products: round-off, times what the tangent has of curvature.
TEST(Plastic, LanesAreAsPlainDouble) {
  for (const Material& material : all_plastic())
    for (const int free_directions : {0, 1, 2}) {
      expect_lanes_as_plain<Pack2>(material, free_directions);
      expect_lanes_as_plain<Pack4>(material, free_directions);
      expect_lanes_as_plain<Pack8>(material, free_directions);
    }
}

/// The radial return of the equivalent stress `trial`.
template <class Yield>
RadialReturn<double> returned(const Yield& law, double trial, double dt, const double (&own)[most_plastic_variables]) {
  RadialReturn<double> at_end{1.0, 1.0, {own[0], own[1], own[2]}};
  law.flow(law.begin(own), 3 * G, trial, dt, at_end);
  const double change = at_end.variables[0] - own[0];  // it has the rounding of alpha
  EXPECT_NEAR(at_end.share * trial, trial - 3 * G * change, 0x1p-51 * (trial + 3 * G * at_end.variables[0]));
  return at_end;
}

// The equation of the radial return, and the work as the integral of the stress by Simpson's rule on every piece.
TEST(Hardening, ReturnAndWorkFollowTheCurve) {
  for (const Material& material : {plastic("j2"), plastic("j2", 0.0), voce("j2"), tabulated("j2")}) {
    const Hardening hardening(material);
    const auto stress = [&](double alpha) { return hardening.begin(&alpha).stress; };
    EXPECT_EQ(stress(0.0), hardening.elastic_limit());
    for (const double alpha : {0.0, 0.003, 0.01, 0.3, 0.9}) {
      for (const double beyond : {1e-9, 0.1, 3.0, 200.0}) {
        const double trial = stress(alpha) + beyond;
        const RadialReturn<double> at_end = returned(hardening, trial, 0.0, {alpha});
        EXPECT_GT(at_end.variables[0], alpha);
        EXPECT_NEAR(at_end.share * trial, stress(at_end.variables[0]), 1e-14 * trial);
      }
      EXPECT_EQ(returned(hardening, 0.9 * stress(alpha), 0.0, {alpha}).variables[0], alpha);
      double sum = 0.0;
      const int pieces = 900;  // corners of the polygon are among their ends
      for (int i = 0; i < pieces; ++i) {
        const double h = alpha / pieces, a = i * h;
        sum += h / 6 * (stress(a) + 4 * stress(a + h / 2) + stress(a + h));
      }
      EXPECT_NEAR(hardening.plastic_work(&alpha), sum, 1e-6 * (1e-6 + sum));
    }
  }
  const double far = 7.0;
  EXPECT_EQ(Hardening(tabulated("j2")).begin(&far).stress, 2.0);
}

// The equation of the radial return with hardening, rate and softening, from anywhere: small and large steps, slow and
// fast, across the kink at the reference rate, cold, hot and molten, against long doubles.
TEST(JohnsonCook, ReturnMeetsTheYieldStress) {
  std::mt19937 generator(3);
  const auto exponent = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(generator));
  };
  for (int i = 0; i < 20000; ++i) {
    const double B = i % 7 == 0 ? 0.0 : exponent(-2.0, 1.0), n = exponent(-1.5, 0.3), m = exponent(-0.5, 0.5);
    const JohnsonCook jc{yield, B, n, i % 5 == 0 ? 0.0 : exponent(-3.0, 0.0), m, 1.0, 300.0, 400.0, 310.0, 10.0};
    const double alpha = i % 3 == 0 ? 0.0 : exponent(-12.0, 0.5), work = i % 2 == 0 ? 0.0 : exponent(-2.0, 1.2);
    const double own[3] = {alpha, work, 0.0}, begin = jc.begin(own).stress;
    const double trial = begin + exponent(-9.0, 2.0), dt = i % 11 == 0 ? 0.0 : exponent(-12.0, 1.0);
    const RadialReturn<double> at_end = returned(jc, trial, dt, own);
    const long double end = at_end.variables[0],
                      change = (1 - at_end.share) * static_cast<long double>(trial) / (3 * G);
    const long double theta = std::clamp((10.0L + 10.0L * work) / 100.0L, 0.0L, 1.0L);
    const long double rate = dt > 0.0 ? std::max(1.0L, change / dt) : 1.0L;
    const long double strain = yield + B * std::pow(end, static_cast<long double>(n));
    const long double slow = (1 - std::pow(theta, static_cast<long double>(m))) * strain;
    // Round-off of the powers, of 1 - theta^m near melting, and of 1 - share where little flows, which the logarithm
    // of the rate sees.
    const double of_change = 0x1p-52 * trial / (3 * G);
    const double tolerance = 0x1p-52 * (10 * trial + 4 * static_cast<double>(strain)) +
                             of_change * jc.C * static_cast<double>(slow) / (of_change + static_cast<double>(change));
    ASSERT_NEAR(at_end.share * trial, static_cast<double>(slow * (1 + jc.C * std::log(rate))), tolerance) << i;
    EXPECT_NEAR(at_end.variables[1] - work, static_cast<double>(at_end.share * trial * change),
                0x1p-50 * (trial * trial / (3 * G) + work));
  }
}

// At a constant rate and without heating the yield stress is (A + B alpha^n)(1 + C ln(rate / rate_0)): a step of shear
// from rest, checked by the equation that it must fulfil.
TEST(JohnsonCook, RateRaisesTheYieldStress) {
  const double C = 0.05, T = std::pow(0.1, 1.1);  // T* = (310 - 300) / 100
  const PointLaw law(johnson_cook(C, 0.0));
  for (const double dt : {1e-4, 1.0, 1e6}) {
    const double l = std::exp(0.05);
    const Answer answer = law.update(green_lagrange({{{l, 0, 0}, {0, 1 / l, 0}, {0, 0, 1}}}), law.rest(), dt);
    const double alpha = answer.history[6], rate = std::max(1.0, alpha / dt / 1e-4);
    const double stress = (yield + 0.8 * std::pow(alpha, 0.4)) * (1 + C * std::log(rate)) * (1 - T);
    EXPECT_NEAR(root_3 * answer.stress[0] * l * l, stress, 1e-12) << dt;
    EXPECT_NEAR(2 * root_3 * G * 0.05 - 3 * G * alpha, stress, 1e-12) << dt;
    EXPECT_EQ(answer.history[8], 0.0);
  }
}

// The temperature rises by taylor_quinney / (rho c) times the plastic work, to no more than what melts: the stress
// vanishes there, and the work with it.
TEST(JohnsonCook, PlasticWorkHeatsUntilNothingIsLeftToYield) {
  const PointLaw law(johnson_cook(0.05, 0.9, 0.001));
  std::vector<double> history = law.rest();
  double work = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double l = std::exp(0.001 * i);
    const Answer answer = law.update(green_lagrange({{{l, 0, 0}, {0, 1 / l, 0}, {0, 0, 1}}}), history, 1e-3);
    const double tau = root_3 * answer.stress[0] * l * l;
    work += tau * (answer.history[6] - history[6]);
    EXPECT_NEAR(answer.history[8], 0.9 / (8.0 * 0.001) * answer.dissipation, 1e-12);
    history = answer.history;
  }
  EXPECT_NEAR(history[7], work, 1e-9);
  EXPECT_GT(history[8], 85.0);
  EXPECT_LT(history[8], 90.0);
}

// Bars: sigma = yield + H alpha and eps = sigma / E + alpha, so that d sigma / d eps = E H / (E + H); a cycle of
// constant amplitude hardens to and fro.
TEST(Lateral, BarsFollowTheTensileTest) {
  const PointLaw law(plastic("j2_small_strain"), 2);
  std::vector<double> history = law.rest();
  double alpha = 0.0, plastic_strain = 0.0;
  for (const double eps : {0.004, 0.02, -0.02, 0.02, -0.02}) {
    const double trial = E * (eps - plastic_strain);
    if (std::abs(trial) > yield + H * alpha) {
      const double more = (std::abs(trial) - yield - H * alpha) / (E + H);
      alpha += more;
      plastic_strain += std::copysign(more, trial);
    }
    const Answer answer = law.update({eps, 0, 0, 0, 0, 0}, history);
    EXPECT_NEAR(answer.stress[0], E * (eps - plastic_strain), round_off);
    EXPECT_NEAR(answer.strain[1], -nu * (eps - plastic_strain) - 0.5 * plastic_strain, round_off);
    EXPECT_EQ(answer.strain[1], answer.strain[2]);
    EXPECT_EQ(answer.stress[1], 0.0);
    EXPECT_NEAR(answer.history[6], alpha, round_off);
    const double slope = law.tangent({eps, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 0, 0}, history)[0];
    EXPECT_NEAR(slope, answer.history[6] > history[6] ? E * H / (E + H) : E, 1e-11 * E);
    history = answer.history;
  }
}

// At finite strain the same holds of tau and ln l: S = tau / l^2.
TEST(Lateral, BarsAtFiniteStrainFollowTheLogarithmicTensileTest) {
  const PointLaw law(plastic("j2"), 2);
  const double e = 0.4, l = std::exp(e), tau = (yield + H * e) / (1 + H / E);
  for (const int steps : {1, 10}) {
    std::vector<double> history = law.rest();
    Answer answer{};
    for (int i = 1; i <= steps; ++i) {
      answer = law.update({0.5 * std::expm1(2 * e * i / steps), 0, 0, 0, 0, 0}, history);
      history = answer.history;
    }
    EXPECT_NEAR(answer.stress[0], tau / (l * l), 1e-12);
    const double lateral = -nu * tau / E - 0.5 * (e - tau / E);  // logarithmic
    EXPECT_NEAR(answer.strain[2], 0.5 * std::expm1(2 * lateral), 1e-13);
  }
}

// The law in three dimensions has no lateral stress at the strain found, on whatever path; tangents by differences as
// above, in the components that are free to change.
TEST(Lateral, PlaneStressIsTheLawInThreeDimensions) {
  const double h = 1e-6;
  for (const Material& material : all_plastic()) {
    const PointLaw law(material, 1), full(material);
    Path path(9);
    Voigt strain{};
    std::vector<double> history = law.rest();
    for (int i = 0; i < 40; ++i) {
      strain = path.next(strain, 0.03);
      strain[2] = strain[4] = strain[5] = 0.0;
      const Answer answer = law.update(strain, history, 0.1);
      std::vector<double> inner(history.begin(), history.end() - 1);
      const Answer check = full.update(answer.strain, inner, 0.1);
      ASSERT_NEAR(check.stress[2], 0.0, 1e-12 * E) << material.law->name << i;
      for (const std::size_t c : {0U, 1U, 3U}) ASSERT_EQ(check.stress[c], answer.stress[c]);
      for (const std::size_t c : {0U, 1U, 3U}) {
        Voigt plus = strain, minus = strain, unit{};
        plus[c] += h;
        minus[c] -= h;
        unit[c] = 1.0;
        const Voigt D = law.tangent(strain, unit, history, 0.1);
        const Answer up = law.update(plus, history, 0.1), down = law.update(minus, history, 0.1);
        for (const std::size_t j : {0U, 1U, 3U})
          ASSERT_NEAR(D[j], (up.stress[j] - down.stress[j]) / (2 * h), 1e-5 * E) << material.law->name << i;
      }
      history = answer.history;
    }
    EXPECT_GT(history[6], 0.3);
  }
}

// What is no number on entry is none on return, and the iteration for the lateral strain ends.
TEST(Lateral, NoNumbersStayNoNumbers) {
  for (const int free_directions : {0, 1, 2}) {
    const PointLaw law(plastic("j2"), free_directions);
    EXPECT_TRUE(std::isnan(law.update({-0.6, 0, 0, 0, 0, 0}, law.rest()).stress[0]));  // C_xx = -0.2
  }
}

}  // namespace
}  // namespace carom::test::material_plastic_test
