// Hourglass modes of one-point cells that yield: closed form, tangent, objectivity, energies.
#include <gtest/gtest.h>

#include "kernels/hourglass_flow.hpp"
#include "solid/point_history.hpp"
#include "solid_bodies.hpp"

namespace carom::test::solid_hourglass_test {
namespace {

constexpr double E = 200.0, nu = 0.25, G = 80.0, sigma_y = 1.0, coefficient = 0.05;

Model one_point_body(Mesh mesh, CellType type, Section section, std::string_view law) {
  const Material material(law, 1.0, {{"E", E}, {"nu", nu}, {"yield_stress", sigma_y}, {"hardening_modulus", 5.0}});
  return body(std::move(mesh), *find_element(type, section, Formulation::one_point), material, 1.0);
}

/// A body and what it remembers.
struct Walk {
  explicit Walk(const Model& model) : solid(model), history(initial_history(solid)), end(history) {}
  SolidEnergies evaluate(const std::vector<double>& u) {
    f.resize(u.size());
    return solid.evaluate(u, {1.0, history}, f, end);
  }
  SolidEnergies go(const std::vector<double>& u) {
    const SolidEnergies energies = evaluate(u);
    history = end;
    return energies;
  }
  Solid solid;
  std::vector<double> history, end, f;
};

// A unit cube whose nodes move by s in the signs of the mode xi eta: gamma = Gamma / 8, so q = s; kappa = 16/9 x 24/16.
// The force of the mode grows with k s up to the limit; then all work but what is stored is lost.
TEST(Hourglass, OfYieldingCellsIsElasticPerfectlyPlastic) {
  for (const char* law : {"j2_small_strain", "j2"}) {
    Walk walk(one_point_body(block_mesh({1, 1, 1}, 0.0), CellType::hexa8, Section::solid, law));
    const double kappa = 8.0 / 3.0, k = coefficient * G * kappa, limit = coefficient * std::sqrt(kappa / 3.0) * sigma_y;
    const Mesh mesh = block_mesh({1, 1, 1}, 0.0);
    const auto at = [&](double s) {
      std::vector<double> u(24, 0.0);
      for (std::size_t n = 0; n < 8; ++n) {
        const Vec3& X = mesh.coordinates[n];
        u[3 * n + 2] = ((X[0] > 0.5) == (X[1] > 0.5) ? s : -s);
      }
      return u;
    };
    const double yields_at = limit / k, largest_s = 10.0 * yields_at;
    const auto force = [&] { return dot(walk.f, at(1.0)); };  // that works with s
    SolidEnergies energies = walk.go(at(0.5 * yields_at));
    EXPECT_NEAR(force(), 0.5 * limit, 1e-12 * limit) << law;
    EXPECT_EQ(energies.hourglass_loss, 0.0) << law;
    energies = walk.go(at(largest_s));
    EXPECT_NEAR(force(), limit, 1e-12 * limit) << law;
    const double work = limit * largest_s;
    EXPECT_NEAR(energies.hourglass, 0.5 * limit * yields_at, 1e-12 * work) << law;
    EXPECT_NEAR(energies.hourglass_loss, limit * (largest_s - yields_at), 1e-12 * work) << law;
    EXPECT_NEAR(energies.strain + energies.plastic, 0.0, 1e-12 * work) << law << ": the mode has no mean gradient";
    energies = walk.go(at(largest_s - yields_at));  // elastic, back to no force
    EXPECT_NEAR(force(), 0.0, 1e-11 * limit) << law;
    EXPECT_NEAR(energies.hourglass_loss, limit * (largest_s - yields_at), 1e-12 * work) << law;
  }
}

class YieldingHourglass : public testing::TestWithParam<std::tuple<Section, const char*>> {
 protected:
  Section section_ = std::get<0>(GetParam());
  Model model_ = one_point_body(distorted_mesh(section_), cells_of(section_), section_, std::get<1>(GetParam()));
  /// Displacements by which cells flow, and their hourglass modes too.
  std::vector<double> displacement(unsigned seed) const {
    auto u = random_vector(3 * model_.mesh->node_count(), seed);
    for (double& entry : u) entry *= 0.05;
    return u;
  }
};
INSTANTIATE_TEST_SUITE_P(Solid, YieldingHourglass,
                         testing::Combine(testing::Values(Section::solid, Section::plane_strain, Section::plane_stress,
                                                          Section::axisymmetric),
                                          testing::Values("j2_small_strain", "j2")));

TEST_P(YieldingHourglass, TangentIsTheDerivativeOfTheForce) {
  Walk walk(model_);
  ASSERT_GT(walk.go(displacement(1)).hourglass_loss, 0.0);
  const auto u = displacement(2);
  expect_tangent_is_derivative(walk.solid, u, random_vector(u.size(), 3), {1.0, walk.history});
}

TEST_P(YieldingHourglass, StepTurnedAboutZHasTheTurnedForcesAndTheSameEnergies) {
  if (std::get<1>(GetParam()) != std::string("j2") || section_ == Section::axisymmetric)
    return;  // no rotation maps these to themselves
  Walk walk(model_);
  walk.go(displacement(4));
  const auto u = displacement(5);
  const SolidEnergies still = walk.evaluate(u);
  const auto f = walk.f, end = walk.end;
  std::vector<double> turned(u.size());
  for (std::size_t n = 0; n < u.size() / 3; ++n) {  // by 90 degrees
    const Vec3& X = model_.mesh->coordinates[n];
    turned[3 * n] = -(X[1] + u[3 * n + 1]) - X[0];
    turned[3 * n + 1] = X[0] + u[3 * n] - X[1];
    turned[3 * n + 2] = u[3 * n + 2];
  }
  const SolidEnergies after = walk.evaluate(turned);
  EXPECT_NEAR(after.hourglass, still.hourglass, 1e-11 * still.hourglass);
  EXPECT_NEAR(after.hourglass_loss, still.hourglass_loss, 1e-11 * still.hourglass_loss);
  for (std::size_t n = 0; n < u.size() / 3; ++n) {
    EXPECT_NEAR(walk.f[3 * n], -f[3 * n + 1], 1e-11 * largest(f));
    EXPECT_NEAR(walk.f[3 * n + 1], f[3 * n], 1e-11 * largest(f));
  }
  EXPECT_LT(largest_difference(walk.end, end), 1e-11) << "what is remembered does not turn";
}

// Molten metal, and modes without stiffness: no force, no energy, and no 0 / 0.
TEST(HourglassReturn, OfNoStrengthIsNothing) {
  const double q[3] = {0.1, -0.2, 0.3};
  for (const double stiffness : {0.0, 5.0}) {
    HourglassReturn<double, 3> modes;
    modes.go(q, nullptr, stiffness, 0.0);
    double dT[3];
    change_returned<double, 3>(modes.returned, stiffness, modes.share, modes.damper, q, dT);
    EXPECT_EQ(modes.stored, 0.0);
    EXPECT_EQ(modes.lost, 0.0);
    for (const std::size_t c : {0U, 1U, 2U}) {
      EXPECT_EQ(modes.force[c], 0.0);
      EXPECT_EQ(dT[c], 0.0);
    }
  }
}

}  // namespace
}  // namespace carom::test::solid_hourglass_test
