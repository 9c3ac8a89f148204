#include "exact/bouncing_bar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "exact/bar_impact.hpp"

namespace carom::exact_bouncing_bar_test {
namespace {

/// Doyen, Ern and Piperno, SIAM J. Sci. Comput. 33(1), 2011, section 3: c = 30, T = 2/3, fall of 1, period 16/3.
const BouncingBarData published{
    .bar = {.length = 10, .modulus = 900, .density = 1, .area = 1}, .gravity = 10, .gap = 5};
constexpr double period = 16.0 / 3;

double energy(const BouncingBar& bar, double t) {
  return bar.kinetic_energy(t) + bar.strain_energy(t) + bar.potential_energy(t);
}

TEST(BouncingBar, ForceOfBothContacts) {
  const BouncingBar bar(published, 6.0);
  ASSERT_EQ(bar.phases().size(), 2u);
  EXPECT_DOUBLE_EQ(bar.phases()[0].begin, 1.0);
  EXPECT_DOUBLE_EQ(bar.phases()[0].end, 5.0 / 3);
  EXPECT_NEAR(bar.phases()[1].begin, 11.0 / 3, 1e-14);
  EXPECT_NEAR(bar.phases()[1].end, 13.0 / 3, 1e-14);
  EXPECT_EQ(bar.release_times().size(), 2u);
  for (int i = 0; i < 100; ++i) {
    const double s = 2.0 / 3 * (i + 0.5) / 100;
    EXPECT_NEAR(bar.contact_force(1 + s), 300 + 300 * s, 1e-11) << s;
    EXPECT_NEAR(bar.contact_force(11.0 / 3 + s), 500 - 300 * s, 1e-11) << s;
    EXPECT_EQ(bar.contact_force(5.0 / 3 + 3 * s), 0.0) << s;
    EXPECT_EQ(bar.contact_force(1.49 * s), 0.0) << s;
  }
}

TEST(BouncingBar, PositionsAsDerivedByHand) {
  const BouncingBar bar(published, 8.0);
  struct Positions {
    double t, end, middle, free;
  };
  // Over the place standing undeformed on the floor; six decimals given.
  for (const Positions& expected :
       {Positions{4.0 / 3, 0, -2.083333, -3.888889}, Positions{2, 1.666667, 1.944444, 2.777778},
        Positions{8.0 / 3, 3.888889, 4.166667, 5}, Positions{4.5, 1.527778, 1.527778, 1.527778},
        Positions{period, 5, 5, 5}}) {
    EXPECT_NEAR(bar.displacement(0, expected.t) + 5, expected.end, 5.1e-7) << expected.t;
    EXPECT_NEAR(bar.displacement(5, expected.t) + 5, expected.middle, 5.1e-7) << expected.t;
    EXPECT_NEAR(bar.displacement(10, expected.t) + 5, expected.free, 5.1e-7) << expected.t;
  }
  EXPECT_NEAR(bar.kinetic_energy(4.5), 347.2222, 5e-5);
  EXPECT_NEAR(bar.strain_energy(4.5), 0.0, 1e-11);
  for (const double z : {0.0, 5.0, 10.0}) EXPECT_NEAR(bar.velocity(z, period), 0.0, 1e-12);
}

TEST(BouncingBar, TwentyBouncesRepeatThemselvesAndKeepTheEnergy) {
  const BouncingBar bar(published, 10.5 * period);
  EXPECT_EQ(bar.phases().size(), 21u);
  for (int i = 0; i <= 500; ++i) {
    const double t = 10.5 * period * i / 500, in_period = t - period * std::floor(t / period);
    EXPECT_NEAR(energy(bar, t), 500, 1e-9) << t;  // m g gap; rounding of displacements summed over 16000
    EXPECT_NEAR(bar.displacement(3, t), bar.displacement(3, in_period), 1e-9) << t;
  }
}

TEST(BouncingBar, FallForWholeHalfRoundTripsIsPeriodic) {
  for (const int m : {3, 4, 5}) {
    const double T = 2.0 / 3;
    const BouncingBar bar({.bar = published.bar, .gravity = 10, .gap = 10 * m * m * T * T / 8}, 20.0);
    double begin = 0.5 * m * T;
    for (const ContactPhase& phase : bar.phases()) {
      EXPECT_NEAR(phase.begin, begin, 1e-11) << m;
      if (phase.end < 20.0) {
        EXPECT_NEAR(phase.end, begin + T, 1e-11) << m;
      }
      begin += (m + 1) * T;
    }
    EXPECT_GT(begin, 20.0) << m;
  }
}

/// Released standing on the floor: the fundamental period is 4 L / c = 2 T, the force rises from 0 to 2 m g in T
/// (f = g t in the first round trip) and falls back in the next. It touches zero but the bar stays.
TEST(BouncingBar, SuddenWeightMakesATriangleOfForce) {
  const BouncingBar bar({.bar = published.bar, .gravity = 10, .gap = 0}, 10.0);
  const double T = 2.0 / 3, weight = 100.0;
  ASSERT_EQ(bar.phases().size(), 1u);
  EXPECT_EQ(bar.phases()[0].end, 10.0);
  EXPECT_TRUE(bar.release_times().empty());
  for (int i = 0; i < 200; ++i) {
    const double t = 0.05 * i, x = t / (2 * T) - std::floor(t / (2 * T));
    EXPECT_NEAR(bar.contact_force(t), 2 * weight * (1 - std::abs(2 * x - 1)), 1e-10) << t;
    EXPECT_NEAR(bar.displacement(0, t), 0.0, 1e-12) << t;
    EXPECT_NEAR(energy(bar, t), 0.0, 1e-10) << t;
  }
}

TEST(BouncingBar, ReleaseInsideARoundTripWhenTheForceVanishes) {
  // Any data: no penetration, no tension, energy kept, Newton's law for the centre of mass.
  for (const double gap : {0.01, 0.3, 1.7, 6.1}) {
    const BouncingBarData data{.bar = published.bar, .gravity = 10, .gap = gap};
    const BouncingBar bar(data, 20.0);
    double impulse = 0.0;
    for (const ContactPhase& phase : bar.phases()) impulse += phase.impulse;
    EXPECT_NEAR(10.0 * bar.mean_velocity(20.0), impulse - 100.0 * 20.0, 1e-9) << gap;
    for (int i = 0; i <= 1000; ++i) {
      const double t = 0.02 * i;
      EXPECT_GE(bar.contact_force(t), -1e-9) << gap << ' ' << t;
      EXPECT_GE(bar.displacement(0, t), -gap - 1e-11) << gap << ' ' << t;
      EXPECT_NEAR(energy(bar, t), 100 * gap, 1e-9) << gap << ' ' << t;
      if (bar.contact_force(t) > 1e-9) {
        EXPECT_NEAR(bar.stress(0, t), -bar.contact_force(t), 1e-9) << gap << ' ' << t;
      }
    }
  }
}

TEST(BouncingBar, WithoutGravityItIsTheBarImpact) {
  BouncingBarData data{.bar = published.bar, .gravity = 0, .gap = 5};
  data.bar.velocity = -10;
  const BouncingBar bar(data, 5.0);
  const BarImpact impact({.length = 10, .modulus = 900, .density = 1, .area = 1, .speed = 10, .gap = 5});
  for (int i = 0; i < 100; ++i) {
    const double t = 0.0123 + 0.049 * i;
    EXPECT_NEAR(bar.contact_force(t), impact.contact_force(t), 1e-11) << t;
    EXPECT_NEAR(bar.displacement(7, t), impact.displacement(7, t), 1e-11) << t;
    EXPECT_NEAR(bar.velocity(7, t), impact.velocity(7, t), 1e-11) << t;
    EXPECT_NEAR(bar.strain_energy(t), impact.strain_energy(t), 1e-9) << t;
  }
}

TEST(BouncingBar, WrongDataAreRefused) {
  BouncingBarData data = published;
  EXPECT_THROW(BouncingBar(data, 0.0), std::invalid_argument);
  data.gravity = -1;
  EXPECT_THROW(BouncingBar(data, 1.0), std::invalid_argument);
  data = published;
  data.gap = -1;
  EXPECT_THROW(BouncingBar(data, 1.0), std::invalid_argument);
  data = published;
  data.bar.length = 0;
  EXPECT_THROW(BouncingBar(data, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace carom::exact_bouncing_bar_test
