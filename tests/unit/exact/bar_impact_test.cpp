#include "exact/bar_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace carom::exact_bar_impact_test {
namespace {

/// Impact bar of Doyen, Ern and Piperno, SIAM J. Sci. Comput. 33(1), 2011: c = 30, touch at 0.5, force 300 until
/// 0.5 + 2/3, then rigid motion at +10.
const BarImpactData impact_bar{.length = 10, .modulus = 900, .density = 1, .area = 1, .speed = 10, .gap = 5};

/// Code_Aster V5.03.100 (SDNV100), full section; nu = 0.3 blocked laterally, or nu = 0.
BarImpactData sdnv100(double nu, double stiffness) {
  const double modulus = 2e11 * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  return {.length = 0.2,
          .modulus = modulus,
          .density = 8000,
          .area = 4e-4,
          .speed = 100,
          .gap = 2e-3,
          .stiffness = stiffness};
}

/// T / t_c of a bar of unit length, modulus and density is 2 eps_N.
BarImpactData unit_bar(double periods_per_contact_time) {
  return {.length = 1,
          .modulus = 1,
          .density = 1,
          .area = 1,
          .speed = 1,
          .gap = 0.5,
          .stiffness = 0.5 * periods_per_contact_time};
}

TEST(BarImpact, RigidWallMeetsThePublishedImpactBar) {
  const BarImpact bar(impact_bar);
  EXPECT_DOUBLE_EQ(bar.wave_speed(), 30.0);
  EXPECT_DOUBLE_EQ(bar.touch_time(), 0.5);
  EXPECT_DOUBLE_EQ(bar.release_time(), 0.5 + 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(bar.rebound_speed(), 10.0);
  for (const double t : {0.0, 0.3, 0.4999, 1.1667, 5.0}) EXPECT_EQ(bar.contact_force(t), 0.0) << t;
  for (const double t : {0.5, 0.8, 1.1666}) EXPECT_DOUBLE_EQ(bar.contact_force(t), 300.0) << t;
  for (const double z : {0.0, 4.0, 10.0}) {
    EXPECT_EQ(bar.velocity(z, 0.2), -10.0);
    EXPECT_EQ(bar.velocity(z, 1.2), 10.0);
    EXPECT_EQ(bar.stress(z, 1.2), 0.0);
    // Arrival of the front at z, its return from the free end.
    EXPECT_EQ(bar.velocity(z, 0.5 + z / 30 - 1e-6), -10.0);
    EXPECT_EQ(bar.velocity(z, 0.5 + (20 - z) / 30 + 1e-6), 10.0);
    // Position at release as at touch: down and up by the same way.
    EXPECT_NEAR(bar.displacement(z, 1.0 / 6.0 + 1.5), -5.0 + 10.0 * (1.0 / 6.0 + 1.5 - 7.0 / 6.0), 1e-13);
  }
  EXPECT_EQ(bar.velocity(4.0, 0.8), 0.0);
  EXPECT_EQ(bar.stress(4.0, 0.8), -300.0);
}

TEST(BarImpact, RigidWallEnergiesFollowTheFront) {
  const BarImpact bar(impact_bar);
  // 1/2 rho S L v0^2 = 500; the front has stopped half of the bar after L / (2 c), all of it after L / c.
  EXPECT_NEAR(bar.kinetic_energy(0.1), 500, 1e-11);
  EXPECT_NEAR(bar.kinetic_energy(0.5 + 1.0 / 6.0), 250, 1e-11);
  EXPECT_NEAR(bar.strain_energy(0.5 + 1.0 / 6.0), 250, 1e-11);
  EXPECT_NEAR(bar.strain_energy(0.5 + 1.0 / 3.0), 500, 1e-11);
  EXPECT_NEAR(bar.kinetic_energy(3.0), 500, 1e-11);
  EXPECT_EQ(bar.contact_energy(0.8), 0.0);
}

TEST(BarImpact, RigidWallMeetsTheReferenceOfSdnv100) {
  const BarImpact bar(sdnv100(0.3, 0));
  // Exact values of the 1-D solution with the initial +2 mm counted, as known to the digits given.
  EXPECT_NEAR(bar.displacement(0.2, 8e-5) + 2e-3, -0.8951e-3, 0.5e-7);
  EXPECT_NEAR(bar.displacement(0.2, 1.2e-4) + 2e-3, 3.1049e-3, 0.5e-7);
  // The manual's formula f = rho c_p v0 S.
  EXPECT_DOUBLE_EQ(bar.contact_force(4e-5), 8000 * std::sqrt(2e11 * 0.7 / (1.3 * 0.4) / 8000) * 100 * 4e-4);
}

TEST(BarImpact, PenaltyWallMeetsTheClosedFormOfBothPhases) {
  const BarImpact bar(sdnv100(0.0, 1e14));
  const double full = 8000.0 * 5000.0 * 100.0, t_c = 8000.0 * 5000.0 / 1e14, T = 8e-5, tau0 = 2e-5;
  EXPECT_NEAR(bar.contact_force(20.4e-6) / 4e-4, 2.528482e9, 0.5e3);  // digits given
  EXPECT_NEAR(bar.displacement(0.0, 20.4e-6) + 2e-3, -0.02528482e-3, 0.5e-11);
  for (const double x : {0.1, 1.0, 3.0, 50.0, 199.0}) {
    // 1e-12: the time x t_c after touch is known to eps tau0 / t_c = 1e-14 only.
    EXPECT_NEAR(bar.contact_force(tau0 + x * t_c) / 4e-4 / full, 1 - std::exp(-x), 1e-12) << x;
  }
  for (const double x : {0.0, 0.2, 0.9, 1.6}) {
    const double q = std::exp(-x) * (2 - std::exp(-T / t_c) + 2 * x) - 1;
    EXPECT_NEAR(bar.contact_force(tau0 + T + x * t_c) / 4e-4 / full, q, 1e-12) << x;
  }
  const double release = (bar.release_time() - tau0 - T) / t_c;
  EXPECT_NEAR(release, 1.6783469900, 1e-10);  // root of exp(-x) (2 + 2 x) = 1, exp(-T/t_c) = 1e-87
  // Integral of q: T/t_c - 1 in the first phase, 4 - exp(-x) (4 + 2 x) - x in the second, exp(-x) = 1 / (2 + 2 x).
  const double impulse = T / t_c - 1 + 4 - (2 + release) / (1 + release) - release;
  EXPECT_NEAR(bar.rebound_speed(), 100 * (2 * impulse * t_c / T - 1), 1e-11);
}

TEST(BarImpact, TractionSatisfiesTheDelayEquationForSoftAndStiffWalls) {
  for (const double X : {0.1, 0.5, 1.0, 1.5, 2.0, 5.0, 30.0}) {
    const BarImpact bar(unit_bar(X));
    const double t_c = 2.0 / X, duration = (bar.release_time() - 0.5) / t_c, h = 1e-4;
    const auto q = [&](double x) { return bar.contact_force(0.5 + x * t_c); };
    for (int i = 1; i < 200; ++i) {
      const double x = duration * i / 200.0, to_front = x - X * std::round(x / X);
      if (std::abs(to_front) < 2 * h) continue;  // q has a kink there
      double expected = 1 - q(x);
      for (double delayed = x - X; delayed > 0; delayed -= X) expected -= 2 * q(delayed);
      // Central difference: h^2 / 6 q''' with |q'''| below 30 after normalisation by t_c; rounding 1e-12.
      EXPECT_NEAR((q(x + h) - q(x - h)) / (2 * h), expected, 1e-7) << "X = " << X << ", x = " << x;
    }
  }
}

TEST(BarImpact, PenetrationTimesStiffnessIsTheTraction) {
  for (const double X : {0.05, 0.7, 1.6, 3.0, 100.0}) {
    const BarImpactData data = unit_bar(X);
    const BarImpact bar(data);
    for (int i = 0; i < 100; ++i) {
      const double t = bar.touch_time() + (bar.release_time() - bar.touch_time()) * (i + 0.5) / 100;
      // Displacements of order 1 are sums of up to 10 x 10 terms of the series.
      EXPECT_NEAR(-bar.displacement(0, t) - data.gap, bar.contact_force(t) / data.stiffness, 1e-11) << X << ' ' << t;
      EXPECT_NEAR(bar.stress(0, t), -bar.contact_force(t), 1e-11) << X << ' ' << t;
    }
    for (int i = 0; i < 1000; ++i)
      EXPECT_GE(bar.displacement(0, bar.release_time() + i * 0.01), -data.gap - 1e-11) << X << ' ' << i;
  }
}

TEST(BarImpact, EnergyIsConservedAtAllTimes) {
  for (const double stiffness : {0.0, 1e12, 1e13, 1e14, 1e16}) {
    const BarImpact bar(sdnv100(0.3, stiffness));
    for (int i = 0; i <= 200; ++i) {
      const double t = 3e-4 * i / 200;
      const double energy = bar.kinetic_energy(t) + bar.strain_energy(t) + bar.contact_energy(t);
      EXPECT_NEAR(energy, 3200, 3200 * 1e-12) << stiffness << ' ' << t;  // 1/2 rho S L v0^2 = 3200 J
    }
  }
}

TEST(BarImpact, WaveEquationHoldsAwayFromFronts) {
  const BarImpact bar(unit_bar(6.0));  // c = 1, T = 2, t_c = 1/3
  const double h = 1e-3;
  int compared = 0;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 60; ++j) {
      const double z = 0.05 + 0.9 * i / 20.0, t = 0.6 + 0.1 * j;
      bool smooth = true;
      for (const double front : {bar.touch_time(), bar.release_time()})
        for (const double s : {t - z, t + z - 2.0}) {
          const double to_front = s - front - 2.0 * std::round((s - front) / 2.0);
          smooth = smooth && std::abs(to_front) > 2.5 * h;
        }
      if (!smooth) continue;
      ++compared;
      const auto u = [&](double dz, double dt) { return bar.displacement(z + dz, t + dt); };
      const double d2u_dt2 = (u(0, h) - 2 * u(0, 0) + u(0, -h)) / (h * h);
      const double d2u_dz2 = (u(h, 0) - 2 * u(0, 0) + u(-h, 0)) / (h * h);
      // Both differences have the same truncation error for waves of speed 1; rounding 4 eps |u| / h^2 with |u| < 6.
      EXPECT_NEAR(d2u_dt2, d2u_dz2, 4 * 2.3e-16 * 6 / (h * h)) << z << ' ' << t;
      // First differences: h^2 / 6 |u'''|, u''' of order 1 / t_c^2 = 9.
      EXPECT_NEAR((u(0, h) - u(0, -h)) / (2 * h), bar.velocity(z, t), 9 * h * h) << z << ' ' << t;
      EXPECT_NEAR((u(h, 0) - u(-h, 0)) / (2 * h), bar.stress(z, t), 9 * h * h) << z << ' ' << t;
    }
  EXPECT_GT(compared, 1000);
}

TEST(BarImpact, StartsAtRestPositionAndKeepsTheFreeEndFree) {
  for (const double stiffness : {0.0, 1e13, 1e14}) {
    const BarImpact bar(sdnv100(0.3, stiffness));
    for (const double z : {0.0, 0.07, 0.2}) EXPECT_NEAR(bar.displacement(z, 0), 0.0, 1e-17);
    // Differences of two equal sums of order rho c v0 = 4.6e9.
    for (int i = 0; i < 50; ++i) EXPECT_NEAR(bar.stress(0.2, i * 7e-6), 0.0, 1e-3);
    for (int i = 0; i < 50; ++i) {
      const double t = bar.release_time() + i * 7e-6 + 1e-9;
      EXPECT_NEAR(bar.stress(0.0, t), 0.0, 1e-3) << stiffness << ' ' << t;
    }
  }
}

TEST(BarImpact, MomentumChangesByTheImpulse) {
  const BarImpact bar(sdnv100(0.0, 1e13));
  const auto momentum = [&](double t) {  // midpoint rule on velocities: the wave is smooth but for a few fronts
    double sum = 0.0;
    for (int i = 0; i < 2000; ++i) sum += bar.velocity(0.2 * (i + 0.5) / 2000, t);
    return 8000 * 4e-4 * 0.2 * sum / 2000;
  };
  const double mass = 8000 * 4e-4 * 0.2;
  EXPECT_NEAR(momentum(0.0), -mass * 100, 1e-10);
  // Midpoint rule with kinks: error about (width of a panel / length)^2 of the jump in slope, 1e-6 relative.
  EXPECT_NEAR(momentum(2e-4), mass * bar.rebound_speed(), mass * 100 * 1e-5);
  EXPECT_NEAR(momentum(5e-4), mass * bar.rebound_speed(), mass * 100 * 1e-5);
}

TEST(BarImpact, StiffPenaltyTendsToTheRigidWall) {
  const BarImpact rigid(sdnv100(0.3, 0)), infinite(sdnv100(0.3, std::numeric_limits<double>::infinity()));
  EXPECT_EQ(infinite.contact_force(5e-5), rigid.contact_force(5e-5));
  for (const double stiffness : {1e16, 1e18, 1e20}) {
    const BarImpact bar(sdnv100(0.3, stiffness));
    const double t_c = 8000 * bar.wave_speed() / stiffness;
    for (const double t : {3e-5, 6e-5, 1e-4, 2e-4})
      for (const double z : {0.03, 0.11, 0.19})
        // u sums two waves v0 (integral of q); q differs from the rigid one by an integral of at most t_c while the
        // transients last and by 0.052 t_c per period afterwards, two periods here: 2 (1 + 2 x 0.052) < 2.3.
        EXPECT_NEAR(bar.displacement(z, t), rigid.displacement(z, t), 2.3 * 100 * t_c + 1e-16) << stiffness << ' ' << t;
  }
}

TEST(BarImpact, WeakWallActsAsASpringOnAMass) {
  // T << t_c: a mass rho L on a spring eps_N, half a period pi sqrt(rho L / eps_N); corrections of relative order
  // eps_N L / (3 M) = 0.005 / 3 (Rayleigh's third of a spring's mass, with the roles exchanged).
  const BarImpact bar(unit_bar(0.01));
  const double half_period = std::acos(-1.0) * std::sqrt(1.0 / 0.005);
  EXPECT_NEAR((bar.release_time() - bar.touch_time()) / half_period, 1.0, 0.005);
  EXPECT_NEAR(bar.rebound_speed(), 1.0, 1e-5);
}

TEST(BarImpact, RefusesDataWithoutASolution) {
  const auto message = [](BarImpactData data) -> std::string {
    try {
      const BarImpact bar(data);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  };
  BarImpactData data = impact_bar;
  EXPECT_EQ(message(data), "no error");
  data.speed = -10;
  EXPECT_EQ(message(data), "bar impact: speed is -10, expected a positive number");
  data = impact_bar;
  data.gap = -1;
  EXPECT_EQ(message(data), "bar impact: gap is -1, expected zero or a positive number");
  data = impact_bar;
  data.stiffness = -3;
  EXPECT_EQ(message(data), "bar impact: stiffness is -3, expected zero (rigid wall) or a positive number");
  data = impact_bar;
  data.density = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(data), "bar impact: density is nan, expected a positive number");
  data = impact_bar;
  data.stiffness = 0.1;  // eps_N L / M = 0.1 * 10 / 900
  EXPECT_NE(message(data).find("too soft: its stiffness times L / modulus is 0.00111"), std::string::npos);
}

/// m dv/dt = Z (v0 - v) until the wave comes back: momentum, energy and force against the closed form.
TEST(BarImpact, FreeMassTakesOverExponentially) {
  for (const double mass : {1.0, 10.0, 100.0}) {
    BarImpactData data = impact_bar;
    data.wall_mass = mass;
    const BarImpact bar(data);
    const double Z = 30.0, M = 10.0, v0 = 10.0, energy = 0.5 * M * v0 * v0;
    EXPECT_DOUBLE_EQ(bar.release_time(), 0.5 + 2.0 / 3.0);
    for (const double t : {0.5, 0.7, 1.1}) {
      EXPECT_NEAR(bar.contact_force(t), Z * v0 * std::exp(-Z * (t - 0.5) / mass), 1e-9);
      EXPECT_NEAR(bar.velocity(0.0, t), bar.wall_velocity(t), 1e-12);  // together
    }
    const double after = -v0 * (1.0 - std::exp(-2.0 * M / mass));
    for (const double t : {1.2, 1.7, 3.1}) {
      EXPECT_EQ(bar.contact_force(t), 0.0);
      EXPECT_NEAR(bar.wall_velocity(t), after, 1e-12);
      EXPECT_LT(bar.wall_velocity(t), bar.velocity(0.0, t));  // apart
    }
    EXPECT_NEAR(M * bar.rebound_speed() + mass * after, -M * v0, 1e-10);
    for (const double t : {0.2, 0.6, 1.0, 1.3, 4.0}) {
      const double v = bar.wall_velocity(t);
      EXPECT_NEAR(bar.kinetic_energy(t) + bar.strain_energy(t) + 0.5 * mass * v * v, energy, 1e-9 * energy) << t;
      EXPECT_EQ(bar.contact_energy(t), 0.0);
    }
  }
  BarImpactData both = impact_bar;
  both.wall_mass = both.stiffness = 1.0;
  EXPECT_THROW(BarImpact{both}, std::invalid_argument);
}

}  // namespace
}  // namespace carom::exact_bar_impact_test
