#include "exact/cavity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace carom::exact_cavity_test {
namespace {

/// G = lambda = 1, c = sqrt(3)
const SphericalCavityData unit{.radius = 1, .modulus = 2.5, .nu = 0.25, .density = 1, .pressure = 1};

TEST(SphericalCavity, WallMovesAsTabulated) {
  const SphericalCavity cavity(unit);
  struct Value {
    double t, u;
  };
  // Eight digits given.
  for (const Value& expected :
       {Value{0.5, 0.22621506}, Value{1, 0.31050099}, Value{2, 0.27245989}, Value{4, 0.24803916}})
    EXPECT_NEAR(cavity.displacement(1.0, expected.t), expected.u, 0.5e-8) << expected.t;
  EXPECT_NEAR(cavity.time_of_peak(), 1.170, 0.5e-3);
  EXPECT_NEAR(cavity.displacement(1.0, cavity.time_of_peak()), 0.3147439, 0.5e-7);
  EXPECT_NEAR(cavity.velocity(1.0, cavity.time_of_peak()), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(cavity.static_displacement(1.0), 0.25);
  EXPECT_NEAR(cavity.displacement(1.0, 100.0), 0.25, 1e-15);
  EXPECT_NEAR(cavity.displacement(2.0, 100.0), 0.0625, 1e-15);
}

TEST(SphericalCavity, WallBearsThePressureAndTheFrontIsAsInOneDimension) {
  for (const double nu : {-0.3, 0.0, 0.25, 0.49}) {
    const SphericalCavity cavity({.radius = 0.3, .modulus = 7, .nu = nu, .density = 2, .pressure = 0.8});
    for (const double t : {0.0, 0.01, 0.1, 1.0}) EXPECT_NEAR(cavity.radial_stress(0.3, t), -0.8, 1e-14) << nu;
    // The wall starts with p / (rho c) and the front carries stress = -rho c v, decaying like a / r.
    EXPECT_NEAR(cavity.velocity(0.3, 0.0), 0.8 / (2 * cavity.wave_speed()), 1e-14);
    const double r = 0.9, arrival = (r - 0.3) / cavity.wave_speed(), just = 1e-12;
    EXPECT_NEAR(cavity.radial_stress(r, arrival + just), -0.8 / 3, 1e-9);
    EXPECT_NEAR(cavity.velocity(r, arrival + just), 0.8 / 3 / (2 * cavity.wave_speed()), 1e-9);
    EXPECT_EQ(cavity.displacement(r, arrival - just), 0.0);
  }
}

TEST(SphericalCavity, EquationOfMotionAndHookesLawHoldInside) {
  const double G = 2.8, lambda = 2 * G * 0.25 / 0.5, rho = 2, h = 1e-4;
  const SphericalCavity cavity({.radius = 0.3, .modulus = 7, .nu = 0.25, .density = rho, .pressure = 0.8});
  for (const double r : {0.4, 0.8, 1.5})
    for (const double t : {1.0, 1.3, 2.0}) {  // all behind the front
      const double stress_rate = (cavity.radial_stress(r + h, t) - cavity.radial_stress(r - h, t)) / (2 * h);
      const double force = stress_rate + 2 / r * (cavity.radial_stress(r, t) - cavity.hoop_stress(r, t));
      const double acceleration = (cavity.velocity(r, t + h) - cavity.velocity(r, t - h)) / (2 * h);
      // Central differences: h^2 times third derivatives below 100.
      EXPECT_NEAR(force, rho * acceleration, 1e-6) << r << ' ' << t;
      const double radial = (cavity.displacement(r + h, t) - cavity.displacement(r - h, t)) / (2 * h);
      const double hoop = cavity.displacement(r, t) / r;
      EXPECT_NEAR(cavity.radial_stress(r, t), (lambda + 2 * G) * radial + 2 * lambda * hoop, 1e-6);
      EXPECT_NEAR(cavity.hoop_stress(r, t), lambda * radial + 2 * (lambda + G) * hoop, 1e-6);
      EXPECT_NEAR((cavity.displacement(r, t + h) - cavity.displacement(r, t - h)) / (2 * h), cavity.velocity(r, t),
                  1e-6);
    }
}

TEST(SphericalCavity, WrongDataAreRefused) {
  SphericalCavityData data = unit;
  data.nu = 0.5;
  EXPECT_THROW(SphericalCavity{data}, std::invalid_argument);
  data = unit;
  data.radius = 0;
  EXPECT_THROW(SphericalCavity{data}, std::invalid_argument);
  data = unit;
  data.pressure = INFINITY;
  EXPECT_THROW(SphericalCavity{data}, std::invalid_argument);
}

}  // namespace
}  // namespace carom::exact_cavity_test
