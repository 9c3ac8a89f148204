#include "exact/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace carom::exact_friction_test {
namespace {

constexpr double pi = std::numbers::pi;

/// 1 kg on 1e4 N/m, mu = 0.1, g = 10: R / k = 0.1 mm, so each swing loses 0.2 mm (Den Hartog, section 8.1).
const FrictionOscillatorData one_kilogram{.mass = 1, .stiffness = 1e4, .friction = 1, .start = 0.85e-3};

TEST(FrictionOscillator, TurnsAndSticksAsPublished) {
  const FrictionOscillator oscillator(one_kilogram);
  const std::vector<double> expected{-0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3};
  ASSERT_EQ(oscillator.turning_points().size(), expected.size());
  EXPECT_NEAR(oscillator.half_period(), 31.415927e-3, 0.5e-9);  // digits given
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(oscillator.turning_points()[i], expected[i], 1e-18);
    const double t = static_cast<double>(i + 1) * oscillator.half_period();
    EXPECT_NEAR(oscillator.position(t), expected[i], 1e-18);
    EXPECT_NEAR(oscillator.velocity(t), 0.0, 1e-15);
  }
  EXPECT_EQ(oscillator.position(10.0), oscillator.sticking_position());
  EXPECT_EQ(oscillator.velocity(10.0), 0.0);
  EXPECT_NEAR(oscillator.friction_force(10.0), 0.5, 1e-15);  // k x 0.05 mm, inside the cone
  EXPECT_EQ(oscillator.sticking_time(), 4 * oscillator.half_period());
}

TEST(FrictionOscillator, EquationOfMotionAndEnergyHold) {
  for (const double start : {0.85e-3, -0.85e-3, 2.33e-3}) {
    FrictionOscillatorData data = one_kilogram;
    data.start = start;
    const FrictionOscillator oscillator(data);
    const double h = 1e-6, energy = 0.5e4 * start * start;
    int compared = 0;
    for (int i = 1; i < 400; ++i) {
      const double t = 0.8 * oscillator.sticking_time() * i / 400, swings = t / oscillator.half_period();
      const double x = oscillator.position(t), v = oscillator.velocity(t), R = oscillator.friction_force(t);
      EXPECT_NEAR(0.5 * v * v + 0.5e4 * x * x + oscillator.dissipated(t), energy, 1e-12 * energy) << t;
      EXPECT_NEAR(std::abs(R), 1.0, 1e-14);
      if (std::abs(swings - std::round(swings)) * oscillator.half_period() < 2 * h) continue;
      ++compared;
      EXPECT_LT(R * v, 0.0) << t;
      // Central difference: h^2 / 6 omega^4 x_0 = 4e-8 of the largest force 20.
      EXPECT_NEAR((oscillator.velocity(t + h) - oscillator.velocity(t - h)) / (2 * h), -1e4 * x + R, 1e-6) << t;
      EXPECT_NEAR((oscillator.position(t + h) - oscillator.position(t - h)) / (2 * h), v, 1e-8) << t;
    }
    EXPECT_GT(compared, 380);
    EXPECT_NEAR(oscillator.dissipated(10.0), energy - 0.5e4 * std::pow(oscillator.sticking_position(), 2),
                1e-12 * energy);
  }
}

TEST(FrictionOscillator, InsideTheConeItNeverMoves) {
  FrictionOscillatorData data = one_kilogram;
  for (const double start : {0.0, 0.1e-3, -0.09e-3}) {
    data.start = start;
    const FrictionOscillator oscillator(data);
    EXPECT_TRUE(oscillator.turning_points().empty());
    EXPECT_EQ(oscillator.position(1.0), start);
    EXPECT_EQ(oscillator.dissipated(1.0), 0.0);
    EXPECT_DOUBLE_EQ(oscillator.friction_force(1.0), 1e4 * start);
  }
  data.start = 0.3e-3;  // one swing to the edge of the cone, -0.1 mm, where it sticks despite rounding
  EXPECT_EQ(FrictionOscillator(data).turning_points().size(), 1u);
}

TEST(SlidingBlock, LevelPlaneStopsIt) {
  const SlidingBlock block({.mass = 3, .mu = 0.3, .gravity = 9.81, .speed = 2});
  EXPECT_NEAR(block.stop_time(), 0.67957866, 0.5e-8);  // v / (mu g), digits given
  EXPECT_NEAR(block.stop_position(), 0.67957866, 0.5e-8);
  EXPECT_EQ(block.velocity(5.0), 0.0);
  EXPECT_EQ(block.position(5.0), block.stop_position());
  EXPECT_NEAR(block.dissipated(5.0), 6.0, 1e-14);  // the whole kinetic energy
  EXPECT_EQ(block.friction_force(5.0), 0.0);
  EXPECT_DOUBLE_EQ(block.friction_force(0.1), -0.3 * 3 * 9.81);
}

TEST(SlidingBlock, SlopeAboutTheFrictionAngle) {
  const double mu = 0.3, friction_angle = std::atan(mu), degree = pi / 180;
  const SlidingBlock under({.mass = 1, .mu = mu, .gravity = 9.81, .angle = friction_angle - degree});
  EXPECT_TRUE(under.holds());
  EXPECT_EQ(under.position(10.0), 0.0);
  EXPECT_DOUBLE_EQ(under.friction_force(1.0), -9.81 * std::sin(friction_angle - degree));
  const SlidingBlock over({.mass = 1, .mu = mu, .gravity = 9.81, .angle = friction_angle + degree});
  EXPECT_FALSE(over.holds());
  // sin(alpha) - tan(phi) cos(alpha) = sin(alpha - phi) / cos(phi)
  const double a = 9.81 * std::sin(degree) / std::cos(friction_angle);
  EXPECT_NEAR(over.velocity(2.0), 2 * a, 1e-14);
  EXPECT_NEAR(over.position(2.0), 2 * a, 1e-14);
}

TEST(SlidingBlock, WorkAndHeatBalanceInEveryDirection) {
  for (const double mu : {0.0, 0.2, 0.6})
    for (const double angle : {0.0, 0.1, 0.5})
      for (const double speed : {-3.0, 0.0, 2.0}) {
        const SlidingBlock block({.mass = 2, .mu = mu, .gravity = 9.81, .angle = angle, .speed = speed});
        for (int i = 0; i <= 60; ++i) {
          const double t = 0.05 * i, v = block.velocity(t), h = 1e-5;
          const double height = -block.position(t) * std::sin(angle);
          EXPECT_NEAR(v * v + 2 * 9.81 * height + block.dissipated(t), speed * speed, 1e-12 * (1 + v * v))
              << mu << ' ' << angle << ' ' << speed << ' ' << t;
          if (std::abs(t - block.stop_time()) < 2 * h || t == 0.0) continue;
          const double a = (block.velocity(t + h) - block.velocity(t - h)) / (2 * h);
          EXPECT_NEAR(2 * a, 2 * 9.81 * std::sin(angle) + block.friction_force(t), 1e-8);
          if (v != 0.0) {
            EXPECT_LE(block.friction_force(t) * v, 0.0);
          }
        }
      }
}

TEST(SlidingBlock, UpTheSlopeAndBackDown) {
  const SlidingBlock block({.mass = 1, .mu = 0.2, .gravity = 10, .angle = 0.5, .speed = -3});
  EXPECT_NEAR(block.stop_time(), 3 / (10 * (std::sin(0.5) + 0.2 * std::cos(0.5))), 1e-15);
  EXPECT_LT(block.stop_position(), 0.0);
  EXPECT_GT(block.velocity(2.0), 0.0);
  EXPECT_TRUE(std::isinf(SlidingBlock({.mass = 1, .mu = 0.2, .gravity = 10, .angle = 0.5, .speed = 3}).stop_time()));
}

TEST(Friction, WrongDataAreRefused) {
  EXPECT_THROW(FrictionOscillator({.mass = 1, .stiffness = 1, .friction = 0, .start = 1}), std::invalid_argument);
  EXPECT_THROW(FrictionOscillator({.mass = 1, .stiffness = 1, .friction = 1, .start = NAN}), std::invalid_argument);
  EXPECT_THROW(SlidingBlock({.mass = 1, .mu = -0.1, .gravity = 1}), std::invalid_argument);
  EXPECT_THROW(SlidingBlock({.mass = 1, .mu = 0.1, .gravity = 1, .angle = 1.6}), std::invalid_argument);
  EXPECT_THROW(SlidingBlock({.mass = 0, .mu = 0.1, .gravity = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace carom::exact_friction_test
