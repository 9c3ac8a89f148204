// What every row of the table of laws must be, so that a new line in it is tested as it comes.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <stdexcept>

#include "law_samples.hpp"
#include "material_points.hpp"

namespace carom::test::material_table_test {
namespace {

TEST(Laws, RowsAreWholeAndTheirNamesTheirOwn) {
  std::set<std::string> names;
  for (const Law& law : laws()) {
    EXPECT_TRUE(names.insert(law.name).second) << law.name;
    EXPECT_EQ(find_law(law.name), &law);
    EXPECT_EQ(&laws()[index_of(law)], &law);
    EXPECT_FALSE(law.summary.empty()) << law.name;
    EXPECT_NE(law.formula.find('='), std::string::npos) << law.name;
    EXPECT_EQ(law.measure == Measure::small_strain, !law.when_turning.empty()) << law.name;
    std::set<std::string> keys;
    for (const LawParameter& p : law.parameters) {
      EXPECT_TRUE(keys.insert(p.key).second) << law.name << p.key;
      EXPECT_EQ(p.meaning.back(), '.') << law.name << p.key;
      if (!p.initial || !p.initial_phrase.empty()) continue;
      EXPECT_TRUE(*p.initial > p.range.low || (p.range.is_closed_low && *p.initial == p.range.low)) << p.key;
      EXPECT_LE(*p.initial, p.range.high) << p.key;
    }
    const Material material = sample(law);
    EXPECT_TRUE(law.check == nullptr || !law.check(material)) << law.name;
    EXPECT_EQ(material.at_rest().E, 200.0);
    EXPECT_EQ(std::set<std::string>(law.history.begin(), law.history.end()).size(), law.history.size());
  }
  EXPECT_EQ(find_law("glass"), nullptr);
  EXPECT_THROW(Material("glass", 1.0, {}), std::invalid_argument);
  EXPECT_THROW(Material("j2", 1.0, {{"B", 1.0}}), std::invalid_argument);
}

// At rest nothing is there, and small changes meet the moduli at rest: Hooke's, of the section's directions.
TEST(Laws, BeginAtRestWithTheirModuli) {
  const double E = 200.0, nu = 0.3, wave = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  for (const Law& law : laws())
    for (const auto& [free_directions, modulus] : {std::pair{0, wave}, {1, E / (1 - nu * nu)}, {2, E}}) {
      const PointLaw point(sample(law), free_directions);
      const Answer rest = point.update({}, point.rest());
      EXPECT_EQ(rest.stress, Voigt{}) << law.name;
      EXPECT_EQ(rest.energy, 0.0);
      EXPECT_EQ(rest.dissipation, 0.0);
      EXPECT_EQ(rest.history, point.rest()) << law.name;
      EXPECT_NEAR(rest.wave_modulus, wave, 1e-13 * E) << law.name << ": of sections more than theirs";
      EXPECT_NEAR(point.tangent({}, {1, 0, 0, 0, 0, 0}, point.rest())[0], modulus, 1e-13 * E) << law.name;
      const Answer answer = point.update({1e-9, 0, 0, 0, 0, 0}, point.rest());
      EXPECT_NEAR(answer.stress[0], modulus * 1e-9, 1e-7 * 1e-9 * E) << law.name;
    }
}

// rho c^2 of a wave along n with the amplitude w, both of length 1, in an elastic state, over current lengths: the
// tangent carried forward and the stress, dE : D : dE + N . S N with N = F^T n, dE = sym(F^T w N^T) (Bonet and Wood,
// section 6.3), F one of the deformations of the strain. It must not be above what the law says: pressure and shear
// waves along the axes, and random ones.
TEST(Laws, NoElasticWaveIsFasterThanTheyClaim) {
  for (const Law& law : laws()) {
    Material material = sample(law);
    for (std::size_t p = 0; p < material.values.size(); ++p)  // nothing yields
      if (law.parameters[p].key == "yield_stress" || law.parameters[p].key == "A") material.values[p] = 1e4;
    for (auto& point : material.curve) point[1] *= 1e4;
    const PointLaw point(material);
    for (const Voigt& strain : {Voigt{0.2, 0, 0, 0, 0, 0},
                                {-0.1, 0, 0, 0, 0, 0},
                                {0.1, 0.1, -0.05, 0, 0, 0},
                                {-0.1, -0.15, -0.05, 0, 0, 0},
                                {0.2, -0.2, 0.1, 0, 0, 0}}) {
      const Answer answer = point.update(strain, point.rest());
      const bool is_small = law.measure == Measure::small_strain;
      double F[3];  // of axes that stay
      for (std::size_t i = 0; i < 3; ++i) F[i] = is_small ? 1.0 : std::sqrt(1.0 + 2.0 * strain[i]);
      std::mt19937 random(5);
      std::normal_distribution<double> normal;
      for (int k = 0; k < 100; ++k) {
        double n[3] = {}, w[3] = {};
        if (k < 9) {
          n[k % 3] = w[k / 3] = 1.0;
        } else {
          for (double& component : n) component = normal(random);
          for (double& component : w) component = normal(random);
        }
        const double length_n = std::hypot(n[0], n[1], n[2]), length_w = std::hypot(w[0], w[1], w[2]);
        double along = 0.0;  // N . S N
        for (std::size_t i = 0; i < 3; ++i) {
          n[i] *= F[i] / length_n;
          w[i] *= F[i] / length_w;
          if (!is_small) along += n[i] * answer.stress[i] * n[i];
        }
        const Voigt dE{w[0] * n[0],
                       w[1] * n[1],
                       w[2] * n[2],
                       w[0] * n[1] + w[1] * n[0],
                       w[1] * n[2] + w[2] * n[1],
                       w[2] * n[0] + w[0] * n[2]};
        const Voigt dS = point.tangent(strain, dE, point.rest());
        double modulus = along;
        for (std::size_t c = 0; c < 6; ++c) modulus += dE[c] * dS[c];
        EXPECT_GE(answer.wave_modulus, modulus * (1 - 1e-12)) << law.name << k;
      }
    }
  }
}

class EveryLaw : public testing::TestWithParam<Material> {};

// Steps that flow, from rest and on, that let go, and that flow back, each evaluated again from the history at its end:
// nothing flows, hardens, heats or damages once more.
TEST_P(EveryLaw, AStepThatIsOverIsWhatItWas) {
  constexpr double round_off = 1e-13 * 200.0;  // some hundred operations on strains below 1, times E
  for (const int free_directions : {0, 1, 2}) {
    const PointLaw law(GetParam(), free_directions);
    std::vector<double> history = law.rest();
    const std::size_t own = GetParam().law->history.size();
    int changed = 0;
    for (const auto& [size, dt] :
         {std::pair{0.02, 0.5}, {0.05, 1e-3}, {0.05, 0.1}, {0.049, 0.1}, {-0.03, 10.0}, {-0.1, 1e-6}}) {
      SCOPED_TRACE(testing::Message() << free_directions << " free directions, strains of " << size);
      const auto strain_of = [](double s) { return Voigt{s, -0.4 * s, 0.1 * s, 1.5 * s, -0.3 * s, 0.5 * s}; };
      const Voigt strain = strain_of(size);
      const Answer step = law.update(strain, history, dt), again = law.update(strain, step.history, dt, true);
      EXPECT_EQ(again.history, step.history);
      EXPECT_EQ(again.strain, step.strain) << "lateral ones";
      EXPECT_EQ(again.dissipation, step.dissipation) << "a function of the history";
      for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(again.stress[c], step.stress[c], round_off);
      EXPECT_NEAR(again.energy, step.energy, round_off);
      EXPECT_EQ(law.update(strain_of(1.5 * size), step.history, dt, true).history, step.history) << "at any strain";
      EXPECT_NEAR(again.wave_modulus, step.wave_modulus, round_off);
      changed += !std::equal(history.begin(), history.begin() + static_cast<std::ptrdiff_t>(own), step.history.begin());
      history = step.history;
    }
    EXPECT_GE(changed, own > 0 ? 4 : 0);
    if (GetParam().damage) {
      EXPECT_GT(history[own], 0.0);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(, EveryLaw, testing::ValuesIn(all_samples()),
                         [](const auto& instance) { return name_of(instance.param); });

}  // namespace
}  // namespace carom::test::material_table_test
