// Johnson and Cook's damage at single points: hand formulas of triaxiality, rate and temperature, and the law beside
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "material/damaged_law.hpp"
#include "material_points.hpp"

namespace carom::test::material_damage_test {
namespace {

constexpr double E = 200.0, nu = 0.3, G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu)), yield = 1.0, H = 10.0;
constexpr double round_off = 1e-12;  // some hundred operations on numbers near 1, the stress by E times the strain
const JohnsonCookDamage copper{0.54, 4.89, -3.03};  // G. R. Johnson and W. H. Cook, 1985: OFHC copper, D1 to D3
constexpr double D4 = 0.014, D5 = 1.12;             // and the others of it
const double root_3 = std::sqrt(3.0);

Material with(const JohnsonCookDamage& damage, Material material) {
  material.damage = damage;
  return material;
}

Material j2(const char* law = "j2_small_strain") {
  return {law, 1.0, {{"E", E}, {"nu", nu}, {"yield_stress", yield}, {"hardening_modulus", H}}};
}

Material johnson_cook(double initial_temperature = 310.0) {
  return {"johnson_cook",
          8.0,
          {{"E", E},
           {"nu", nu},
           {"A", yield},
           {"B", 0.8},
           {"n", 0.4},
           {"C", 0.05},
           {"m", 1.1},
           {"reference_rate", 1e-4},
           {"melting_temperature", 400.0},
           {"reference_temperature", 300.0},
           {"initial_temperature", initial_temperature},
           {"specific_heat", 0.01}}};
}

/// D1 + D2 exp(D3 eta)
double fracture(const JohnsonCookDamage& d, double eta) {
  return d.D1 + d.D2 * std::exp(d.D3 * eta);
}

// A bar has eta = 1/3 all the time, and -1/3 where it is pressed: alpha = (|eps| - yield / E) / (1 + H / E).
TEST(Damage, OfABarUnderTensionAndCompression) {
  for (const double sign : {1.0, -1.0}) {
    const PointLaw law(with(copper, j2()), 2);
    std::vector<double> history = law.rest();
    ASSERT_EQ(history.size(), 9U);  // that of the law, the damage, the lateral strain
    constexpr int steps = 20;
    for (int i = 1; i <= steps; ++i) {
      const double eps = 0.05 * i / steps, alpha = std::max(0.0, (eps - yield / E) / (1 + H / E));
      history = law.update({sign * eps, 0, 0, 0, 0, 0}, history).history;
      EXPECT_NEAR(history[7], alpha / fracture(copper, sign / 3), round_off) << eps;
    }
  }
}

// The sides are held: eta = K eps / (yield + H alpha), alpha = (2 G |eps| - yield) / (3 G + H); at finite strain eps =
// ln l, and the same of the Kirchhoff stress.
TEST(Damage, UnderPressureAndUnderTensionOfHeldSides) {
  for (const double eps : {0.02, -0.02, 0.3, -0.3}) {
    const double alpha = (2 * G * std::abs(eps) - yield) / (3 * G + H), eta = K * eps / (yield + H * alpha);
    const double expected = alpha / fracture(copper, eta);
    EXPECT_GT(expected, 0.0);
    const PointLaw small(with(copper, j2())), finite(with(copper, j2("j2")));
    EXPECT_NEAR(small.update({eps, 0, 0, 0, 0, 0}, small.rest()).history[7], expected, round_off * expected);
    const Voigt strain{0.5 * std::expm1(2 * eps), 0, 0, 0, 0, 0};
    EXPECT_NEAR(finite.update(strain, finite.rest()).history[7], expected, 10 * round_off * expected) << eps;
  }
}

// Shear has no mean stress, whatever its size and its directions; a change of the volume gives K ln(J) to it.
TEST(Damage, InFiniteShearInAnyDirections) {
  const PointLaw law(with(copper, j2("j2")));
  for (const double J : {1.0, 1.005, 0.99}) {
    const double l = std::cbrt(J);
    const Tensor F = product({{{l, 0.3 * l, 0}, {0, l, 0}, {0, 0, l}}}, rotation(0.4, 1.1, -0.7));
    const Answer answer = law.update(green_lagrange(F), law.rest());
    const double alpha = answer.history[6], eta = K * std::log(J) / (yield + H * alpha);
    ASSERT_GT(alpha, 0.1);
    EXPECT_NEAR(answer.history[7], alpha / fracture(copper, eta), 10 * round_off) << J;
  }
}

// 1 + D4 ln(rate / reference_rate) above that rate, 1 below it and in steps without time; the rate of the law where the
// damage has none.
TEST(Damage, GrowsMoreSlowlyAtAHighRate) {
  const Voigt sheared{0, 0, 0, 0.05, 0, 0};
  JohnsonCookDamage damage = copper;
  damage.D4 = D4;
  damage.reference_rate = 2.0;
  const PointLaw law(with(damage, j2()));
  const double alpha = (root_3 * G * 0.05 - yield) / (3 * G + H), slow = alpha / fracture(copper, 0.0);
  for (const double dt : {0.0, 1.0, 0.9 * alpha})
    EXPECT_NEAR(law.update(sheared, law.rest(), dt).history[7],
                slow / (1 + D4 * std::log(std::max(1.0, dt > 0.0 ? alpha / dt / 2.0 : 0.0))), round_off)
        << dt;
  EXPECT_NEAR(law.update(sheared, law.rest(), 1e-5 * alpha).history[7], slow / (1 + D4 * std::log(5e4)), round_off);
  damage.reference_rate.reset();
  const PointLaw own(with(damage, johnson_cook()));
  const Answer answer = own.update(green_lagrange({{{1, 0.05, 0}, {0, 1, 0}, {0, 0, 1}}}), own.rest(), 0.01);
  const double rate = answer.history[6] / 0.01;
  EXPECT_NEAR(answer.history[9], answer.history[6] / fracture(copper, 0.0) / (1 + D4 * std::log(rate / 1e-4)),
              round_off);
}

// 1 + D5 theta of the beginning of the step: theta is 0.1 at first, or 0 below the reference temperature, then 0.01
// more for each degree; 1 of molten metal, whose eta without shear is beyond all bounds and leaves D1.
TEST(Damage, GrowsMoreSlowlyInTheHeat) {
  JohnsonCookDamage damage = copper;
  damage.D5 = D5;
  for (const double initial : {310.0, 290.0}) {
    const PointLaw law(with(damage, johnson_cook(initial)));
    const Answer first = law.update(green_lagrange({{{1, 0.05, 0}, {0, 1, 0}, {0, 0, 1}}}), law.rest(), 0.01);
    const double at_first = std::max(0.0, (initial - 300.0) / 100.0), cold = fracture(copper, 0.0);
    EXPECT_NEAR(first.history[9], first.history[6] / cold / (1 + D5 * at_first), round_off);
    const Answer second = law.update(green_lagrange({{{1, 0.1, 0}, {0, 1, 0}, {0, 0, 1}}}), first.history, 0.01);
    const double then = (initial - 300.0 + first.history[8]) / 100.0;
    EXPECT_GT(first.history[8], 0.1);  // degrees, so that the second step has another theta
    EXPECT_NEAR(second.history[9] - first.history[9],
                (second.history[6] - first.history[6]) / cold / (1 + D5 * std::max(0.0, then)), round_off);
  }
  const PointLaw law(with(damage, johnson_cook()));
  std::vector<double> molten = law.rest();
  molten[7] = 20.0, molten[8] = 0.9 / (8.0 * 0.01) * molten[7];
  const Answer answer = law.update({0.05, 0.01, 0.01, 0, 0, 0}, molten, 0.01);
  ASSERT_GT(answer.history[6], 0.01);
  EXPECT_NEAR(answer.history[9], answer.history[6] / damage.D1 / (1 + D5), round_off);
}

// Armco iron of the same paper: its formula is negative where eta is above 1.92. What unloads
// does not break.
TEST(Damage, GrowsByOneAtMostInAStep) {
  const PointLaw law(with({-2.2, 5.43, -0.47}, j2()));
  std::vector<double> history = law.rest();
  for (const double eps : {0.02, 0.019, 0.03}) {
    const double before = history[7], alpha = history[6];
    history = law.update({eps, 0, 0, 0, 0, 0}, history).history;
    EXPECT_EQ(history[7], before + (history[6] > alpha ? 1.0 : 0.0));
  }
  EXPECT_EQ(history[7], 2.0);
  const PointLaw brittle(with({0.001, 0.0, 0.0}, j2()));
  EXPECT_EQ(brittle.update({0, 0, 0, 0.05, 0, 0}, brittle.rest()).history[7], 1.0);
}

// Stress, energies, waves, tangents and all other history are to the bit those of the law without damage.
TEST(Damage, LeavesTheLawAsItIs) {
  std::vector<Material> laws{
      j2(),        j2("j2"), johnson_cook(), with_rates("j2_rate_small_strain", E, nu), with_rates("j2_rate", E, nu),
      swift(E, nu)};
  for (const Material& material : laws)
    for (const int free_directions : {0, 1, 2}) {
      const PointLaw plain(material, free_directions), damaged(with(copper, material), free_directions);
      const auto place = static_cast<std::ptrdiff_t>(material.law->history.size());
      ASSERT_EQ(damaged.law.history, plain.law.history + 1);
      std::vector<double> before = plain.rest(), with_it = damaged.rest();
      for (int i = 1; i <= 10; ++i) {
        const Voigt strain{0.003 * i, -0.002 * i, 0.001 * i, 0.002 * i, 0, 0.001 * i}, change{1, 0, 0.5, 0, 0.3, 0};
        const Answer a = plain.update(strain, before, 0.1), b = damaged.update(strain, with_it, 0.1);
        EXPECT_EQ(a.strain, b.strain);
        EXPECT_EQ(a.stress, b.stress);
        EXPECT_EQ(a.energy, b.energy);
        EXPECT_EQ(a.dissipation, b.dissipation);
        EXPECT_EQ(a.wave_modulus, b.wave_modulus);
        EXPECT_EQ(plain.tangent(strain, change, before, 0.1), damaged.tangent(strain, change, with_it, 0.1));
        before = a.history, with_it = b.history;
      }
      EXPECT_GT(with_it[static_cast<std::size_t>(place)], 0.0) << material.law->name << free_directions;
      with_it.erase(with_it.begin() + place);
      EXPECT_EQ(before, with_it) << material.law->name << free_directions;
    }
}

}  // namespace
}  // namespace carom::test::material_damage_test
