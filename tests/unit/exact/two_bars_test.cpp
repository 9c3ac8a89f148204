#include "exact/two_bars.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "exact/bar_impact.hpp"

namespace carom::exact_two_bars_test {
namespace {

/// A bar of unit section by its impedance, round trip and length: c = 2 L / T, rho = Z / c, E = Z c.
ElasticBar bar_of(double impedance, double round_trip, double velocity, double length = 1.0) {
  const double c = 2.0 * length / round_trip;
  return {.length = length, .modulus = impedance * c, .density = impedance / c, .area = 1, .velocity = velocity};
}

struct Plateau {
  double impedance, force, left, right;
};

/// Round trips 2, bar 1 at speed 1 on bar 2 at rest: reflection and transmission at the interface give the force
/// Z_1 Z_2 / (Z_1 + Z_2) V until 2; the mean speeds follow by momentum and energy (Johnson, Impact Strength of
/// Materials, 1972, chapter 1). All digits printed.
TEST(TwoBars, BarsOfEqualRoundTripGiveOnePlateau) {
  for (const Plateau& expected :
       {Plateau{1, 0.5, 0, 1}, Plateau{2, 2.0 / 3, -1.0 / 3, 2.0 / 3}, Plateau{0.5, 1.0 / 3, 1.0 / 3, 4.0 / 3}}) {
    const TwoBars bars({bar_of(1, 2, 1), bar_of(expected.impedance, 2, 0, 3.0), 0.0}, 5.0);
    for (const double t : {0.0, 0.7, 1.9999}) EXPECT_NEAR(bars.force(t), expected.force, 1e-15) << t;
    for (const double t : {2.0, 2.1, 4.9}) EXPECT_EQ(bars.force(t), 0.0) << t;
    EXPECT_NEAR(bars.mean_velocity(0, 5), expected.left, 1e-14);
    EXPECT_NEAR(bars.mean_velocity(1, 5), expected.right, 1e-14);
    ASSERT_EQ(bars.phases().size(), 1u);
    EXPECT_NEAR(bars.phases()[0].impulse, 2 * expected.force, 1e-14);
    ASSERT_EQ(bars.release_times().size(), 1u);
    EXPECT_EQ(bars.release_times()[0], 2.0);
    EXPECT_TRUE(bars.apart_for_good());
    EXPECT_NEAR(bars.gap(5.0), 3.0, 1e-14);  // e = 1: they part at the speed 1 without ringing
    EXPECT_NEAR(bars.stress(0, 0.2, 1.0), -expected.force, 1e-15);
    EXPECT_NEAR(bars.stress(1, 0.2, 1.0), -expected.force, 1e-15);
  }
}

/// Right bar of twice the round trip, same impedance: the left bar stands still and free of stress after its round
/// trip, the force is 0 with zero gap until the wave in the right bar is back (Johnson, same chapter).
TEST(TwoBars, TwiceTheLengthGrazesForOneRoundTrip) {
  const TwoBars bars({bar_of(1, 2, 1), bar_of(1, 4, 0, 2.0), 0.0}, 20.0);
  ASSERT_EQ(bars.phases().size(), 2u);
  EXPECT_DOUBLE_EQ(bars.phases()[0].impulse, 1.0);
  EXPECT_EQ(bars.phases()[1].begin, 2.0);
  EXPECT_EQ(bars.phases()[1].end, 4.0);
  EXPECT_EQ(bars.phases()[1].impulse, 0.0);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(bars.force(2 + 0.1 * i), 0.0);
    EXPECT_NEAR(bars.gap(2 + 0.1 * i), 0.0, 1e-15);
  }
  EXPECT_EQ(bars.release_times(), std::vector<double>{4.0});
  EXPECT_EQ(bars.mean_velocity(0, 20), 0.0);
  EXPECT_DOUBLE_EQ(bars.mean_velocity(1, 20), 0.5);  // e = m_1 / m_2
  EXPECT_TRUE(bars.apart_for_good());
}

TEST(TwoBars, IncommensurateLengthGrazesUntilTheLongerWaveIsBack) {
  const TwoBars bars({bar_of(1, 2, 1), bar_of(1, 3.4, 0, 1.7), 0.3}, 30.0);
  ASSERT_EQ(bars.phases().size(), 2u);
  EXPECT_DOUBLE_EQ(bars.phases()[0].begin, 0.3);
  EXPECT_DOUBLE_EQ(bars.phases()[0].end, 2.3);
  EXPECT_DOUBLE_EQ(bars.phases()[1].end, 3.7);
  EXPECT_EQ(bars.phases()[1].impulse, 0.0);
  EXPECT_NEAR(bars.mean_velocity(1, 30), 1 / 1.7, 1e-14);
  EXPECT_TRUE(bars.apart_for_good());
  EXPECT_FALSE(TwoBars({bar_of(1, 2, 1), bar_of(1, 3.4, 0, 1.7), 0.3}, 3.0).apart_for_good());
}

struct Pair {
  std::string name;
  TwoBarsData data;
};

std::vector<Pair> pairs() {
  return {{"equal", {bar_of(1, 2, 1), bar_of(1, 2, 0), 0.1}},
          {"twice as long", {bar_of(1, 2, 1), bar_of(1, 4, 0, 2.0), 0.1}},
          {"1.7 times, softer", {bar_of(1, 2, 1), bar_of(0.4, 3.4, -0.5, 2.3), 0.25}},
          {"1.7 times, harder", {bar_of(1, 2, 1), bar_of(3, 3.4, -0.5, 2.3), 0.25}},
          {"short and hard", {bar_of(1, 2, 0.25), bar_of(7, 0.31, 0, 0.7), 0.0}},
          {"short and soft", {bar_of(1, 2, 0.25), bar_of(0.13, 0.37, 0, 0.7), 0.0}},
          {"sqrt 2", {bar_of(1, 2, 2), bar_of(2, 2 * std::sqrt(2.0), 1, 0.7), 0.05}}};
}

TEST(TwoBars, MomentumAndEnergyAreConserved) {
  for (const Pair& pair : pairs()) {
    const ElasticBar &left = pair.data.left, &right = pair.data.right;
    const TwoBars bars(pair.data, 25.0);
    const double momentum = left.mass() * left.velocity + right.mass() * right.velocity;
    const double energy =
        0.5 * (left.mass() * left.velocity * left.velocity + right.mass() * right.velocity * right.velocity);
    double force_scale = 0.0;
    for (int i = 0; i <= 100; ++i) {
      const double t = 0.25 * i;
      EXPECT_NEAR(left.mass() * bars.mean_velocity(0, t) + right.mass() * bars.mean_velocity(1, t), momentum, 1e-12)
          << pair.name << ' ' << t;
      const double sum =
          bars.kinetic_energy(0, t) + bars.strain_energy(0, t) + bars.kinetic_energy(1, t) + bars.strain_energy(1, t);
      EXPECT_NEAR(sum, energy, 1e-12 * energy) << pair.name << ' ' << t;
      EXPECT_GE(bars.force(t), 0.0) << pair.name << ' ' << t;
      EXPECT_GE(bars.gap(t), -1e-12) << pair.name << ' ' << t;
      force_scale = std::max(force_scale, bars.force(t));
      if (bars.force(t) > 0.0) {
        EXPECT_NEAR(bars.gap(t), 0.0, 1e-12) << pair.name << ' ' << t;
      }
    }
    EXPECT_GT(force_scale, 0.0) << pair.name;
    EXPECT_TRUE(bars.apart_for_good()) << pair.name;
    EXPECT_NEAR(TwoBars(pair.data, 60.0).mean_velocity(1, 60.0), bars.mean_velocity(1, 25.0), 1e-12) << pair.name;
  }
}

TEST(TwoBars, AnyLengthsAndImpedancesConserveAndPartOnce) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    // Impedance ratios 0.01 to 100, round trips 0.1 to 10 times as long, every other one commensurate.
    const double impedance = std::pow(100.0, exponent(random)), any = 2 * std::pow(10.0, exponent(random));
    const double round_trip = i % 2 == 0 ? any : 0.1 * std::ceil(10 * any);
    const ElasticBar left = bar_of(1, 2, 1), right = bar_of(impedance, round_trip, 0);
    const TwoBars bars({left, right, 0.0}, 50.0);
    // Bars without stress at first, each with one speed, touch once.
    EXPECT_EQ(bars.release_times().size(), 1u) << impedance << ' ' << round_trip;
    EXPECT_TRUE(bars.apart_for_good()) << impedance << ' ' << round_trip;
    for (const double t : {0.3, 1.9, 2.1, 7.7, 50.0}) {
      double energy = 0.0, momentum = 0.0;
      for (const int bar : {0, 1}) {
        energy += bars.kinetic_energy(bar, t) + bars.strain_energy(bar, t);
        momentum += (bar == 0 ? left : right).mass() * bars.mean_velocity(bar, t);
      }
      EXPECT_NEAR(energy, 0.5 * left.mass(), 1e-12) << impedance << ' ' << round_trip << ' ' << t;
      EXPECT_NEAR(momentum, left.mass(), 1e-12) << impedance << ' ' << round_trip << ' ' << t;
      EXPECT_GE(bars.gap(t), -1e-12) << impedance << ' ' << round_trip << ' ' << t;
    }
  }
}

/// Characteristics on a lattice: both bars in cells that a wave crosses in one step, the gap looked at in every step.
class Lattice {
 public:
  Lattice(const TwoBarsData& data, int left_cells, int right_cells, double left_acceleration = 0.0)
      : step_(0.5 * data.left.round_trip() / left_cells),
        velocity_scale_(std::abs(data.left.velocity) + std::abs(data.right.velocity)),
        gap_(data.gap),
        acceleration_(left_acceleration),
        impedance_{data.left.impedance(), data.right.impedance()},
        away_{Row(static_cast<std::size_t>(left_cells), 0.5 * data.left.velocity),
              Row(static_cast<std::size_t>(right_cells), 0.5 * data.right.velocity)},
        towards_(away_) {}

  double step() const { return step_; }

  /// Goes one step on and returns the force during it.
  double advance() {
    const std::array<double, 2> g{towards_[0].front(), towards_[1].front()};
    time_ += step_;
    const double approach = 2 * (g[0] - g[1]) + acceleration_ * (time_ - 0.5 * step_);
    const bool touches = gap_ <= 1e-9 && approach >= -1e-12 * velocity_scale_;
    const double force = touches ? std::max(0.0, approach / (1 / impedance_[0] + 1 / impedance_[1])) : 0.0;
    gap_ = touches ? 0.0 : gap_ - approach * step_;
    for (std::size_t bar : {0u, 1u}) {
      Row &away = away_[bar], &towards = towards_[bar];
      const double end = away.back();
      std::rotate(away.begin(), away.end() - 1, away.end());
      std::rotate(towards.begin(), towards.begin() + 1, towards.end());
      away.front() = g[bar] + (bar == 0 ? -force : force) / impedance_[bar];
      towards.back() = end;
    }
    return force;
  }

 private:
  using Row = std::vector<double>;
  double step_, velocity_scale_, gap_, acceleration_, time_ = 0.0;
  std::array<double, 2> impedance_;
  std::array<Row, 2> away_, towards_;
};

TEST(TwoBars, LatticeOfCharacteristicsGivesTheSameForce) {
  struct Mesh {
    TwoBarsData data;
    int left, right;
  };
  // The gaps close after a whole number of steps.
  for (const Mesh& mesh : {Mesh{{bar_of(1, 2, 1), bar_of(1, 4, 0, 2.0), 0.1}, 10, 20},
                           Mesh{{bar_of(1, 2, 1), bar_of(1, 3.4, 0, 1.7), 0.3}, 10, 17},
                           Mesh{{bar_of(1, 2, 1), bar_of(0.4, 3.4, -0.5, 2.3), 0.3}, 10, 17},
                           Mesh{{bar_of(1, 2, 1), bar_of(3, 3.4, -0.5, 2.3), 0.3}, 10, 17},
                           Mesh{{bar_of(1, 2, 0.25), bar_of(7, 0.3, 0, 0.7), 0.0}, 20, 3}}) {
    Lattice lattice(mesh.data, mesh.left, mesh.right);
    const TwoBars bars(mesh.data, 20.0);
    for (int i = 0; (i + 1) * lattice.step() < 20.0; ++i)
      EXPECT_NEAR(lattice.advance(), bars.force((i + 0.5) * lattice.step()), 1e-12) << mesh.right << ' ' << i;
  }
}

TEST(FaceContact, FineLatticeFindsTheSameReturningContacts) {
  // Bars without stress at first part only once; a steady push on the left one brings it back again and again.
  const double push = 0.6, until = 30.0;
  const ElasticBar left = bar_of(1, 2, 1), right = bar_of(3, 3.4, 0, 1.7);
  const FaceContact contact =
      solve_face_contact({.impedance = left.impedance(), .round_trip = 2, .velocity = 1, .acceleration = push},
                         {.impedance = right.impedance(), .round_trip = 3.4}, 0.0, until);
  EXPECT_GE(contact.releases.size(), 3u);
  double momentum = left.mass() * (1 + push * until);
  momentum -= left.mass() * BarMotion(left, push, contact.waves[0]).mean_velocity(until);
  EXPECT_NEAR(momentum, contact.force.integral(until), 1e-11);
  EXPECT_NEAR(momentum, right.mass() * BarMotion(right, 0.0, contact.waves[1]).mean_velocity(until), 1e-11);
  for (const int refinement : {1, 4, 16}) {
    Lattice lattice({left, right, 0.0}, 100 * refinement, 170 * refinement, push);
    double error = 0.0;
    for (int i = 0; (i + 1) * lattice.step() <= until; ++i)
      error += lattice.step() * std::abs(lattice.advance() - contact.force.value((i + 0.5) * lattice.step()));
    // First order: each closing and release is late by up to a step of 0.01 / refinement, and later ones inherit it.
    EXPECT_LT(error / contact.force.integral(until), 0.1 / refinement);
  }
}

TEST(TwoBars, HardRightBarIsARigidWall) {
  // Impedance 1e9: the force is below that on the wall by 1e-9, and the same holds for displacements.
  const ElasticBar left = bar_of(1, 2, 1, 10.0);
  const TwoBars bars({left, bar_of(1e9, 50, 0, 10.0), 0.5}, 20.0);
  const BarImpact wall(
      {.length = 10, .modulus = left.modulus, .density = left.density, .area = 1, .speed = 1, .gap = 0.5});
  for (int i = 0; i < 100; ++i) {
    const double t = 0.0371 + 0.1 * i;
    EXPECT_NEAR(bars.force(t), wall.contact_force(t), 1e-8) << t;
    for (const double z : {0.0, 3.0, 10.0}) {
      EXPECT_NEAR(bars.velocity(0, z, t), -wall.velocity(z, t), 1e-8) << t;
      EXPECT_NEAR(bars.displacement(0, z, t), -wall.displacement(z, t), 1e-7) << t;
      EXPECT_NEAR(bars.stress(0, z, t), wall.stress(z, t), 1e-8) << t;
    }
  }
}

TEST(TwoBars, WaveEquationAndFreeEndsHold) {
  const TwoBars bars({bar_of(1, 2, 1), bar_of(0.4, 3.4, -0.5, 2.3), 0.25}, 20.0);
  const double lengths[] = {1.0, 2.3}, h = 1e-4;
  int compared = 0;  // displacements of 20 are rounded to 4e-15, their difference is divided by 2 h
  for (const int bar : {0, 1})
    for (int i = 0; i < 200; ++i) {
      const double t = 0.05 + 0.0731 * i, z = lengths[bar] * (0.01 + 0.98 * (i % 7) / 6.0);
      EXPECT_NEAR(bars.stress(bar, lengths[bar], t), 0.0, 1e-15);
      const double rate = (bars.displacement(bar, z, t + h) - bars.displacement(bar, z, t - h)) / (2 * h);
      if (bars.velocity(bar, z, t - h) != bars.velocity(bar, z, t + h)) continue;  // a front between
      ++compared;
      EXPECT_NEAR(rate, bars.velocity(bar, z, t), 1e-10) << bar << ' ' << t;
    }
  EXPECT_GT(compared, 350);
}

TEST(TwoBars, WrongDataAreNamed) {
  TwoBarsData data{bar_of(1, 2, 1), bar_of(1, 2, 0), 0.0};
  data.right.density = 0;
  try {
    static_cast<void>(TwoBars(data, 1.0));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()), "right bar: density is 0, expected a positive number");
  }
  data.right.density = 1;
  data.gap = -1;
  EXPECT_THROW(TwoBars(data, 1.0), std::invalid_argument);
  data.gap = 0;
  EXPECT_THROW(TwoBars(data, 0.0), std::invalid_argument);
  data.left.velocity = NAN;
  EXPECT_THROW(TwoBars(data, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace carom::exact_two_bars_test
