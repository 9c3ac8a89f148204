// Linear elasticity: batch update and tangent.
#include <gtest/gtest.h>

#include <vector>

#include "material/linear_elastic_update.hpp"

namespace carom::material_linear_elastic_test {
namespace {

constexpr LinearElastic material{{.E = 210.0, .nu = 0.3, .rho = 7.8}};

struct Response {
  std::vector<double> stress;
  double energy = 0.0;
};

Response respond(std::vector<double> strain) {
  const LameParameters lame = material.lame();
  Response response{std::vector<double>(6), 0.0};
  linear_elastic_update<double>(&lame, {1, strain.data(), response.stress.data(), &response.energy});
  return response;
}

constexpr double round_off = 1e-12;  // a few operations on numbers near 300

// Definitions of the constants: free sides give sigma = E eps; sigma_xy = G gamma_xy, G = E / (2 (1 + nu)).
TEST(LinearElasticUpdate, UniaxialStressAndShear) {
  const double nu = material.nu;
  const Response tension = respond({1.0, -nu, -nu, 0.0, 0.0, 0.0});
  EXPECT_NEAR(tension.stress[0], 210.0, round_off);
  EXPECT_NEAR(tension.stress[1], 0.0, round_off);
  EXPECT_NEAR(tension.energy, 105.0, round_off);
  const Response shear = respond({0.0, 0.0, 0.0, 0.0, 0.5, 0.0});
  EXPECT_NEAR(shear.stress[4], 210.0 / 2.6 * 0.5, round_off);
  EXPECT_NEAR(shear.energy, 0.5 * 210.0 / 2.6 * 0.25, round_off);
}

// Bulk modulus E / (3 (1 - 2 nu)) = 175.
TEST(LinearElasticUpdate, PressureIsBulkModulusTimesVolumeChange) {
  const Response response = respond({0.1, 0.1, 0.1, 0.0, 0.0, 0.0});
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(response.stress[c], 175.0 * 0.3, round_off);
}

TEST(LinearElasticUpdate, StressIsTheDerivativeOfTheEnergyAndTheTangentThatOfTheStress) {
  const std::vector<double> strain{0.3, -0.2, 0.5, 0.4, -0.6, 0.1};
  const LameParameters lame = material.lame();
  const double h = 1e-2;  // quadratic energy: central differences have no truncation error
  for (std::size_t c = 0; c < 6; ++c) {
    auto plus = strain, minus = strain;
    plus[c] += h;
    minus[c] -= h;
    const Response up = respond(plus), down = respond(minus);
    std::vector<double> unit(6, 0.0), D(6);
    unit[c] = 1.0;
    linear_elastic_tangent<double>(&lame, {1, strain.data(), unit.data(), D.data()});
    EXPECT_NEAR((up.energy - down.energy) / (2 * h), respond(strain).stress[c], round_off / h);
    for (std::size_t r = 0; r < 6; ++r) EXPECT_NEAR((up.stress[r] - down.stress[r]) / (2 * h), D[r], round_off / h);
  }
}

// Layout of material/point_batch.hpp: lanes fastest, then components, then points; energy is optional.
TEST(LinearElasticUpdate, LanesAndPointsStayApart) {
  const LameParameters lame = material.lame();
  std::vector<double> strain(2 * 6 * 4), stress(strain.size());
  for (std::size_t i = 0; i < strain.size(); ++i) strain[i] = 0.01 * static_cast<double>(i * i % 17);
  linear_elastic_update<Pack4>(&lame, {2, strain.data(), stress.data(), nullptr});
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t l = 0; l < 4; ++l) {
      std::vector<double> one;
      for (std::size_t c = 0; c < 6; ++c) one.push_back(strain[(6 * p + c) * 4 + l]);
      const Response expected = respond(one);
      for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(stress[(6 * p + c) * 4 + l], expected.stress[c], round_off);
    }
}

}  // namespace
}  // namespace carom::material_linear_elastic_test
