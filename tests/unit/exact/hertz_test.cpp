#include "exact/hertz.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace carom::exact_hertz_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;
const double steel_on_rigid = hertz_modulus(210e9, 0.3, infinity, 0.0);

TEST(Hertz, ModuliAndRadiiCombineInSeries) {
  EXPECT_DOUBLE_EQ(steel_on_rigid, 210e9 / 0.91);
  EXPECT_DOUBLE_EQ(hertz_modulus(210e9, 0.3, 210e9, 0.3), 210e9 / 1.82);
  EXPECT_DOUBLE_EQ(hertz_combination(0.01, infinity), 0.01);
  EXPECT_DOUBLE_EQ(hertz_combination(0.01, 0.03), 0.0075);
}

/// R = 10 mm of steel on a rigid plane, 1 kN: values of Johnson's (4.22) to (4.24), to the digits given.
TEST(Hertz, SphereAtRest) {
  const HertzSphere sphere(0.01, steel_on_rigid);
  EXPECT_NEAR(sphere.contact_radius(1000), 0.319125e-3, 0.5e-9);
  EXPECT_NEAR(sphere.approach(1000), 0.0101841e-3, 0.5e-10);
  EXPECT_NEAR(sphere.peak_pressure(1000), 4688.34e6, 0.005e6);
  EXPECT_NEAR(sphere.force(sphere.approach(1000)), 1000, 1e-10);
  EXPECT_EQ(sphere.approach(0), 0.0);
}

TEST(Hertz, CylinderAtRest) {
  const HertzCylinder cylinder(0.01, steel_on_rigid);
  EXPECT_NEAR(cylinder.half_width(1e6), 0.234891e-3, 0.5e-9);
  EXPECT_NEAR(cylinder.peak_pressure(1e6), 2710.28e6, 0.005e6);
}

TEST(Hertz, PressureSumsToTheForceAndForceToTheEnergy) {
  const HertzSphere sphere(0.02, 7e9);
  const HertzCylinder cylinder(0.02, 7e9);
  const int n = 20000;
  const double a = sphere.contact_radius(50), b = cylinder.half_width(50), deepest = sphere.approach(50);
  double ring = 0.0, strip = 0.0, work = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    ring += sphere.pressure(50, a * x) * 2 * pi * a * x * a / n;
    strip += 2 * cylinder.pressure(50, b * x) * b / n;
    work += sphere.force(deepest * x) * deepest / n;
  }
  // Midpoint rule: the square root at the edge leaves about n^(-3/2).
  EXPECT_NEAR(ring, 50, 50e-6);
  EXPECT_NEAR(strip, 50, 50e-6);
  EXPECT_NEAR(work, sphere.energy(deepest), 1e-8 * work);
  EXPECT_EQ(sphere.pressure(50, 1.01 * a), 0.0);
  EXPECT_EQ(cylinder.pressure(50, -1.01 * b), 0.0);
}

/// Steel sphere, R = 10 mm, 1 m/s on a rigid wall; to the digits given.
TEST(Hertz, SphereHitsAWall) {
  const double mass = 7800 * 4.0 / 3.0 * pi * 1e-6;
  const HertzImpact impact(mass, 0.01, steel_on_rigid, 1.0);
  EXPECT_NEAR(impact.peak_approach(), 17.7497e-6, 0.5e-10);
  EXPECT_NEAR(impact.peak_force(), 2300.93, 0.005);
  EXPECT_NEAR(impact.contact_time(), 52.2422e-6, 0.5e-10);
  EXPECT_NEAR(impact.peak_pressure(), 6189.5e6, 0.05e6);
  EXPECT_EQ(impact.speed(1.0), -1.0);
  // Two such spheres at the relative speed 2: the wall is their plane of symmetry.
  const HertzImpact two(hertz_combination(mass, mass), hertz_combination(0.01, 0.01),
                        hertz_modulus(210e9, 0.3, 210e9, 0.3), 2.0);
  EXPECT_NEAR(two.peak_approach(), 35.4994e-6, 0.5e-10);
  EXPECT_NEAR(two.peak_force() / impact.peak_force(), 1.0, 1e-14);
  EXPECT_NEAR(two.contact_time() / impact.contact_time(), 1.0, 1e-14);
}

TEST(Hertz, ContactTimeHasTheExactConstant) {
  const HertzImpact impact(2.0, 0.3, 5.0, 0.7);
  const double constant = 4 * std::sqrt(pi) * std::tgamma(0.4) / (5 * std::tgamma(0.9));
  EXPECT_NEAR(constant, 2.94327518, 0.5e-8);
  EXPECT_NEAR(impact.contact_time() * 0.7 / impact.peak_approach(), constant, 1e-14);
}

TEST(Hertz, ImpactFollowsItsEquationOfMotion) {
  const double mass = 2.0;
  const HertzImpact impact(mass, 0.3, 5.0, 0.7);
  const HertzSphere sphere(0.3, 5.0);
  // Runge and Kutta's method; its error falls like h^2.5, the force being unsmooth at touch, to 1.2e-9 at 1000 steps.
  const int steps = 1000;
  const double h = impact.contact_time() / steps;
  double delta = 0.0, speed = 0.7;
  const auto acceleration = [&](double x) { return -sphere.force(std::max(0.0, x)) / mass; };
  for (int i = 1; i <= steps; ++i) {
    const double v1 = speed, a1 = acceleration(delta), v2 = speed + 0.5 * h * a1,
                 a2 = acceleration(delta + 0.5 * h * v1);
    const double v3 = speed + 0.5 * h * a2, a3 = acceleration(delta + 0.5 * h * v2), v4 = speed + h * a3,
                 a4 = acceleration(delta + h * v3);
    delta += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    speed += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    EXPECT_NEAR(impact.approach(i * h), delta, 2e-9) << i;
    EXPECT_NEAR(impact.speed(i * h), speed, 2e-9) << i;
    const double t = i * h;
    EXPECT_NEAR(0.5 * mass * impact.speed(t) * impact.speed(t) + sphere.energy(impact.approach(t)), 0.5 * mass * 0.49,
                1e-14);
  }
  EXPECT_EQ(impact.force(-0.1), 0.0);
  EXPECT_EQ(impact.speed(-0.1), 0.7);
  EXPECT_NEAR(impact.force(0.5 * impact.contact_time()), impact.peak_force(), 1e-14);
}

TEST(Hertz, WrongDataAreRefused) {
  EXPECT_THROW(hertz_modulus(0, 0.3, 1, 0.3), std::invalid_argument);
  EXPECT_THROW(hertz_modulus(1, 0.6, 1, 0.3), std::invalid_argument);
  EXPECT_THROW(hertz_modulus(infinity, 0.3, infinity, 0.3), std::invalid_argument);
  EXPECT_THROW(hertz_combination(infinity, infinity), std::invalid_argument);
  EXPECT_THROW(hertz_combination(-1, 1), std::invalid_argument);
  EXPECT_THROW(HertzSphere(0, 1), std::invalid_argument);
  EXPECT_THROW(HertzCylinder(1, 0), std::invalid_argument);
  EXPECT_THROW(HertzImpact(1, 1, 1, 0), std::invalid_argument);
  EXPECT_THROW(HertzImpact(0, 1, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace carom::exact_hertz_test
