// Von Mises plasticity by curves over strain and rate, at single points: closed forms, tangents, wrong tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "material_points.hpp"

namespace carom::test::material_rates_test {
namespace {

constexpr double E = 200.0, nu = 0.3, H = 10.0;
constexpr double round_off = 1e-13;  // some hundred operations on numbers near 1
const double root_3 = std::sqrt(3.0);

Material with_rates(const char* law) {
  return test::with_rates(law, E, nu);
}

/// Curves that are flat: 1 at rest, 1.8 at the rate 10, 2 at the rate 100.
Material flat(const char* law) {
  Material material = with_rates(law);
  material.curve = {{0.0, 1.0}, {0.0, 1.8}, {0.0, 2.0}};
  return material;
}

/// Steady shear with the rate g flows with the rate g / sqrt(3): 1.4 at half the way to the second curve, 2 beyond the
/// last. What is left of the start falls by exp(-t / tau), tau = slope over the rate / 3 G, at least 60 of which go by.
TEST(RateHardening, SteadyShearHasTheStressOfItsRate) {
  const PointLaw point(flat("j2_rate_small_strain"));
  for (const auto& [rate, stress] : {std::pair{5.0, 1.4}, {10.0, 1.8}, {55.0, 1.9}, {1e4, 2.0}}) {
    std::vector<double> history = point.rest();
    const double step = 1e-4;  // of shear
    Answer answer;
    for (int i = 1; i <= 4000; ++i) {
      answer = point.update({0, 0, 0, i * step, 0, 0}, history, step / (rate * root_3));
      history = answer.history;
    }
    EXPECT_NEAR(answer.stress[3] * root_3, stress, 1e-11) << rate;
  }
}

/// sigma = E (R t - alpha) = s + H alpha + k alpha', of which the solution that is left of the start is
/// alpha = E R / (E + H) (t - s / E R - k / (E + H)); its rate is E R / (E + H), and s and k are those of the curves
/// around it. The same of the logarithmic strain and Kirchhoff's stress.
TEST(RateHardening, UniaxialStressAtConstantRateHasItsClosedForm) {
  struct Between {
    double rate, s, k;
  };
  for (const char* name : {"j2_rate_small_strain", "j2_rate"}) {
    Material material = with_rates(name);
    material.curve = {{0.0, 1.0}, {1.0, 1.0 + H}, {0.0, 1.8}, {1.0, 1.8 + H}, {0.0, 2.0}, {1.0, 2.0 + H}};
    const PointLaw law(material, 2);
    for (const Between& b : {Between{5.0, 1.0, 0.08}, {55.0, 1.8 - 10.0 * 0.2 / 90.0, 0.2 / 90.0}, {1e4, 2.0, 0.0}}) {
      std::vector<double> history = law.rest();
      const bool is_finite = std::string(name) == "j2_rate";
      const double step = 1e-4, end = 4000 * step;
      Answer answer;
      for (int i = 1; i <= 4000; ++i) {
        const double e = i * step;
        answer = law.update({is_finite ? 0.5 * std::expm1(2.0 * e) : e, 0, 0, 0, 0, 0}, history, step / b.rate);
        history = answer.history;
      }
      const double alpha = E * b.rate / (E + H) * (end / b.rate - b.s / (E * b.rate) - b.k / (E + H));
      EXPECT_NEAR(history[6], alpha, 1e-11) << name << b.rate;
      EXPECT_NEAR(answer.stress[0] * (is_finite ? std::exp(2.0 * end) : 1.0), E * (end - alpha), 1e-9)
          << name << b.rate;
    }
  }
}

/// At finite strain Kirchhoff's stress F S F^T is on the surface of the rate with which alpha has grown.
TEST(RateHardening, LargeShearIsOnTheSurfaceOfItsRate) {
  const PointLaw point(flat("j2_rate"));
  for (const double rate : {5.0, 55.0, 1e4}) {
    std::vector<double> history = point.rest();
    const double step = 1e-2, dt = step / (rate * root_3);
    for (int i = 1; i <= 100; ++i) {
      const double before = history[6];
      const Tensor F{{{1, i * step, 0}, {0, 1, 0}, {0, 0, 1}}};
      const Answer answer = point.update(green_lagrange(F), history, dt);
      history = answer.history;
      const double own = (history[6] - before) / dt;
      const double stress = own < 10.0 ? 1.0 + 0.08 * own : own < 100.0 ? 1.8 + (own - 10.0) / 450.0 : 2.0;
      const Voigt kirchhoff = voigt(product(product(F, tensor(answer.stress, 1.0)), transposed(F)), 1.0);
      EXPECT_NEAR(equivalent(kirchhoff), stress, 1e-11) << rate << " " << i;
    }
    EXPECT_GT(history[6], 0.5) << rate;  // shear 1 over sqrt(3), but for what is elastic
  }
}

/// Within a step the stress is that of the end: strain and rate of the flow.
TEST(RateHardening, TheEndOfAStepIsOnTheSurface) {
  const PointLaw point(with_rates("j2_rate_small_strain"));
  const auto expected = [](double alpha, double rate) {
    const double slow = 1.0 + 10.0 * std::min(alpha, 0.1), middle = 1.5 + 10.0 * std::min(alpha, 0.05), fast = 2.5;
    return rate < 10.0    ? slow + (middle - slow) * rate / 10.0
           : rate < 100.0 ? middle + (fast - middle) * (rate - 10.0) / 90.0
                          : fast;
  };
  for (const double dt : {1e-5, 1e-4, 5e-4, 2e-3, 1.0}) {
    std::vector<double> history = point.rest();
    for (int i = 1; i <= 40; ++i) {
      const double before = history[6];
      const Answer answer = point.update({0.004 * i, -0.001 * i, 0, 0.002 * i, 0, 0}, history, dt);
      history = answer.history;
      if (history[6] == before) continue;
      const double stress = expected(history[6], (history[6] - before) / dt);
      EXPECT_NEAR(equivalent(answer.stress), stress, round_off) << dt << " " << i;
      EXPECT_GE(answer.dissipation, history[6] * 0.999999) << "at least the lowest stress";
    }
  }
}

TEST(RateHardening, TangentIsThatOfDifferences) {
  for (const char* law : {"j2_rate_small_strain", "j2_rate"}) {
    const PointLaw point(with_rates(law));
    for (const double dt : {1e-4, 1e-3, 1.0}) {
      const std::vector<double> history = point.update({0.01, -0.003, 0, 0.004, 0, 0.002}, point.rest(), dt).history;
      const Voigt strain{0.0187, -0.006, 0.001, 0.007, 0.001, 0.003}, change{0.3, -0.2, 0.1, 0.4, -0.1, 0.2};
      const double h = 1e-7;
      Voigt plus = strain, minus = strain;
      for (std::size_t c = 0; c < 6; ++c) plus[c] += h * change[c], minus[c] -= h * change[c];
      const Voigt high = point.update(plus, history, dt).stress, low = point.update(minus, history, dt).stress;
      const Voigt tangent = point.tangent(strain, change, history, dt);
      for (std::size_t c = 0; c < 6; ++c)  // rounding 1e-16 E / h, and h^2
        EXPECT_NEAR(tangent[c], (high[c] - low[c]) / (2 * h), 1e-6 * E) << law << dt << c;
    }
  }
}

TEST(RateHardening, WrongTablesAreNamed) {
  const auto found = [](auto change) {
    Material material = with_rates("j2_rate");
    change(material);
    const auto problem = material.law->check(material);
    return problem ? problem->key + ": " + problem->found : "";
  };
  EXPECT_EQ(found([](Material&) {}), "");
  EXPECT_EQ(found([](Material& m) { m.rates.pop_back(); }), "rates: 2 rates and 3 curves");
  EXPECT_EQ(found([](Material& m) { m.rates[2] = 5.0; }), "rates: 5 after 10");
  EXPECT_EQ(found([](Material& m) { m.curve.back()[1] = 1.6; }),
            "hardening_tables: 1.6 at the rate 100, below 2 at the rate 10, at plastic strain 0.05");
  EXPECT_EQ(found([](Material& m) { m.curve[1][1] = 0.5; }), "hardening_tables: yield stress 0.5 after 1");
}

}  // namespace
}  // namespace carom::test::material_rates_test
