// Observed order of both schemes on a smooth vibration.
#include <gtest/gtest.h>

#include <numbers>

#include "schemes_fixture.hpp"

namespace carom::schemes_order_test {
namespace {

using namespace test;

/// A column of one cell, guided laterally, foot clamped: one free motion, the head's u_z, an oscillator of
///   omega^2 = k / m,  k = C A / L per column,  m = rho A L / 3 (consistent) or / 2 (lumped): with
/// C = E (1 - nu) / ((1 + nu) (1 - 2 nu)) and unit edges omega^2 = C / (share rho).
Model guided_cell() {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  block(model, "BLOCK", {0, 1});
  block(model, "ZMIN", {2});
  return model;
}

double frequency(MassKind kind) {
  const auto& m = unit_material;
  const double modulus = m.E * (1 - m.nu) / ((1 + m.nu) * (1 - 2 * m.nu));
  return std::sqrt(modulus / (m.rho * (kind == MassKind::consistent ? 1.0 / 3.0 : 1.0 / 2.0)));
}

/// Error of displacement and velocity at the end of 1.3 periods, released from rest at 0.1, with n steps.
double error_with(const NewmarkParameters* parameters, MassKind kind, int n) {
  const Problem p(guided_cell(), kind);
  const double omega = frequency(kind), end = 1.3 * 2.0 * std::numbers::pi / omega, h = end / n;
  State begin = p.moving({});
  for (const Index node : p.model.mesh->nodes_of("ZMAX")) begin.q[3 * static_cast<std::size_t>(node) + 2] = 0.1;
  const auto scheme = parameters != nullptr ? newmark(p, h, *parameters) : central(p);
  const History run = march(*scheme, begin, h, n);
  double error = 0.0;
  for (const Index node : p.model.mesh->nodes_of("ZMAX")) {
    const std::size_t i = 3 * static_cast<std::size_t>(node) + 2;
    error = std::max(error, std::abs(run.state.q[i] - 0.1 * std::cos(omega * end)));
    error = std::max(error, std::abs(run.state.v[i] + 0.1 * omega * std::sin(omega * end)) / omega);
  }
  return error;
}

/// The order over three halvings of the step. e(h) = c h^p (1 + O(h^2)), for order 1 (1 + O(h)): from 100 and from 200
/// steps the next term changes the observed order by less than 0.05.
void expect_order(const NewmarkParameters* parameters, MassKind kind, double order) {
  const int first = order == 1.0 ? 200 : 100;
  double coarse = error_with(parameters, kind, first);
  for (int n = 2 * first; n <= 8 * first; n *= 2) {
    const double fine = error_with(parameters, kind, n);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.05) << n << " steps";
    coarse = fine;
  }
}

TEST(Order, TrapezoidalNewmarkIsTwo) {
  const NewmarkParameters trapezoidal;
  for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) expect_order(&trapezoidal, kind, 2.0);
}

TEST(Order, CentralDifferencesIsTwo) {
  for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) expect_order(nullptr, kind, 2.0);
}

TEST(Order, DissipativeNewmarkIsOne) {
  const NewmarkParameters dissipative{.beta = 0.28, .gamma = 0.55};
  expect_order(&dissipative, MassKind::consistent, 1.0);
}

TEST(Order, ForcedMotionOfTheHeadIsTwo) {
  // Gravity switched on as a ramp t/T on the same oscillator: u = g (t - sin(omega t) / omega) / (T omega^2) times the
  // ratio of the load to the mass, which is 3/2 for the consistent mass (half the cell's weight on a third of its
  // mass).
  const double omega = frequency(MassKind::consistent), end = 1.3 * 2.0 * std::numbers::pi / omega;
  double coarse = 0.0;
  for (const int n : {100, 200, 400}) {
    Model model = guided_cell();
    model.loads.emplace_back(Gravity{{0, 0, -1.0}, {{0.0, end}, {0.0, 1.0}}});
    const Problem p(model);
    const auto scheme = newmark(p, end / n);
    const History run = march(*scheme, p.moving({}), end / n, n);
    const std::size_t i = 3 * static_cast<std::size_t>(p.model.mesh->nodes_of("ZMAX")[0]) + 2;
    const double exact = -1.5 / (end * omega * omega) * (end - std::sin(omega * end) / omega);
    const double error = std::abs(run.state.q[i] - exact);
    if (coarse > 0.0) {
      EXPECT_NEAR(std::log2(coarse / error), 2.0, 0.05) << n;
    }
    coarse = error;
  }
}

}  // namespace
}  // namespace carom::schemes_order_test
