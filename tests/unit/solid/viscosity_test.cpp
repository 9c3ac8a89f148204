// Artificial viscosity: closed forms, tangents, objectivity, books, and the damping that explicit steps are told of.
#include <gtest/gtest.h>

#include "kernels/bulk_viscosity.hpp"
#include "solid/point_history.hpp"
#include "solid/stability.hpp"
#include "solid_bodies.hpp"

namespace carom::test::solid_viscosity_test {
namespace {

constexpr double dt = 0.3;

/// A body with a memory of one step to a displacement.
struct Walk {
  explicit Walk(const Model& model) : solid(model), history(initial_history(solid)), end(history) {}
  SolidEnergies go(const std::vector<double>& u) {
    f.resize(u.size());
    const SolidEnergies energies = solid.evaluate(u, {dt, history}, f, end);
    history = end;
    return energies;
  }
  Solid solid;
  std::vector<double> history, end, f;
};

Model viscous(Mesh mesh, const Element& element, const Material& material, const Viscosity& viscosity) {
  Model model = body(std::move(mesh), element, material);
  model.parts[0].viscosity = viscosity;
  return model;
}

std::vector<double> stretched(const Mesh& mesh, const Vec3& by) {
  std::vector<double> u;
  for (const Vec3& x : mesh.coordinates)
    for (std::size_t c = 0; c < 3; ++c) u.push_back(by[c] * x[c]);
  return u;
}

// A unit cube that is compressed along x by two steps, stretches 1, 0.9 and 0.7: the viscous force on its face is
//   (rho / j) l d (b_1 c + b_2^2 l |d|), d = -0.2 / (j dt), j = 0.7 and l = 0.9 in the second step,
// since q dV/du is q times the area of the face; the work of the viscous forces is theirs by the trapezoidal rule.
// Small strain has the same in the volume 1 + tr e, and the length at rest. When it opens again, the quadratic term
// rests.
TEST(BulkViscosity, IsItsFormula) {
  const Mesh mesh = block_mesh({1, 1, 1}, 0.0);
  constexpr double b_1 = 0.3, b_2 = 1.1;
  for (const Material& material : {Material(unit_material), Material(NeoHookean{unit_material})}) {
    const Element& element = *find_element(CellType::hexa8, Section::solid, Formulation::full);
    Walk walk(viscous(mesh, element, material, {.linear = b_1, .quadratic = b_2})),
        elastic(body(mesh, element, material));
    const double rho = unit_material.rho, c = std::sqrt(unit_material.p_wave_modulus() / rho);
    const auto step = [&](double stretch) {
      const auto u = stretched(mesh, {stretch - 1.0, 0.0, 0.0}), pull = stretched(mesh, {1.0, 0.0, 0.0});
      elastic.go(u);
      const double viscous = walk.go(u).viscous;
      return std::pair{dot(walk.f, pull) - dot(elastic.f, pull), viscous};
    };
    const bool is_small = material.law->measure == Measure::small_strain;
    const auto wanted = [&](double change, double j, double length) {
      const double d = change / dt / j, l = is_small ? 1.0 : length;
      return rho / j * l * d * (b_1 * c + b_2 * b_2 * l * std::max(0.0, -d));
    };
    const double q_1 = wanted(-0.1, 0.9, 1.0), q_2 = wanted(-0.2, 0.7, 0.9), q_3 = wanted(0.1, 0.8, 0.7);
    const double tolerance = 1e-13;  // round-off of the elastic forces that are taken off
    const auto first = step(0.9), second = step(0.7), third = step(0.8);
    EXPECT_NEAR(first.first, q_1, tolerance);
    EXPECT_NEAR(second.first, q_2, tolerance);
    EXPECT_NEAR(third.first, q_3, tolerance);
    EXPECT_NEAR(first.second, -0.05 * q_1, tolerance);
    EXPECT_NEAR(second.second - first.second, -0.1 * (q_1 + q_2), tolerance);
    EXPECT_NEAR(third.second - second.second, 0.05 * (q_2 + q_3), tolerance);
    EXPECT_LT(q_2, 1.9 * q_1) << "the quadratic term acts";
  }
}

// A bar that is stretched has the length for the volume, plane stress the area: q l A / l_0 and q times the thickness.
TEST(BulkViscosity, OfBarsAndPlaneStressIsThatOfTheLengthAndTheArea) {
  constexpr double b_1 = 0.3, thickness = 0.7, stretch = 1.2;
  const double rho = unit_material.rho, E = unit_material.E, nu = unit_material.nu;
  const Material material = NeoHookean{unit_material};
  const auto force = [&](const Mesh& mesh, Section section) {
    const Element& element = *find_element(cells_of(section), section, Formulation::full);
    Walk walk(viscous(mesh, element, material, {.linear = b_1})), elastic(body(mesh, element, material));
    const auto u = stretched(mesh, {stretch - 1.0, 0.0, 0.0}), pull = stretched(mesh, {1.0, 0.0, 0.0});
    elastic.go(u);
    walk.go(u);
    return dot(walk.f, pull) - dot(elastic.f, pull);
  };
  const double q = rho * b_1 * (stretch - 1.0) / dt / (stretch * stretch) * thickness, tolerance = 1e-12;
  const Mesh bar = mesh_of(CellType::line2, {{0, 0, 0}, {1, 0, 0}}, {0, 1});
  EXPECT_NEAR(force(bar, Section::bar), q * std::sqrt(E / rho), tolerance);
  const double c = std::sqrt(E / (1.0 - nu * nu) / rho);
  EXPECT_NEAR(force(quad_mesh(1, 1, 0.0, 0.0), Section::plane_stress), q * c, tolerance);
}

// The hourglass mode of a unit cube (solid_hourglass_test.cpp): the force viscosity G kappa (l / c) s' works with s,
// and its work is viscous, by the trapezoidal rule. Elastic and yielding modes have the same.
TEST(HourglassViscosity, IsItsFormula) {
  const Mesh mesh = block_mesh({1, 1, 1}, 0.0);
  constexpr double viscosity = 0.2, kappa = 8.0 / 3.0;
  for (const Material& material : {Material(unit_material), yielding("j2_small_strain"), yielding("j2")}) {
    const Element& element = *find_element(CellType::hexa8, Section::solid, Formulation::one_point);
    Walk walk(viscous(mesh, element, material, {.hourglass = viscosity})), still(body(mesh, element, material));
    const auto at = [&](double s) {
      std::vector<double> u(24, 0.0);
      for (std::size_t n = 0; n < 8; ++n)
        u[3 * n + 2] = (mesh.coordinates[n][0] > 0.5) == (mesh.coordinates[n][1] > 0.5) ? s : -s;
      return u;
    };
    const double G = unit_material.E / (2.0 * (1.0 + unit_material.nu));
    const double c = std::sqrt(unit_material.p_wave_modulus() / unit_material.rho);
    const double per_step = viscosity * G * kappa / c / dt;
    double before = 0.0, force_before = 0.0, lost = 0.0;
    for (const double s : {0.1, 0.3, 0.2}) {
      const SolidEnergies energies = walk.go(at(s)), without = still.go(at(s));
      const double force = dot(walk.f, at(1.0)) - dot(still.f, at(1.0));
      EXPECT_NEAR(force, per_step * (s - before), 1e-13);
      lost += 0.5 * (force_before + force) * (s - before);
      EXPECT_NEAR(energies.viscous, lost, 1e-13);
      EXPECT_NEAR(energies.hourglass, without.hourglass, 1e-14);
      EXPECT_NEAR(energies.hourglass_loss, without.hourglass_loss, 1e-14);
      before = s;
      force_before = force;
    }
  }
}

class ViscousBody : public testing::TestWithParam<Body> {
 protected:
  Model model_ = viscous(distorted_mesh(GetParam().element.type), GetParam().element, GetParam().material,
                         {.linear = 0.3,
                          .quadratic = 1.2,
                          .hourglass = GetParam().element.formulation == Formulation::one_point ? 0.2 : 0.0});
  std::vector<double> displacement(unsigned seed, double size) const {
    auto u = random_vector(3 * model_.mesh->node_count(), seed);
    for (double& entry : u) entry *= size;
    return u;
  }
};
/// Laws of either measure, one that yields.
std::vector<Body> viscous_bodies() {
  std::vector<Body> bodies;
  for (const Element& element : elements())
    for (const Material& material : {Material(unit_material), Material(NeoHookean{unit_material}), yielding("j2")})
      bodies.push_back({element, material});
  return bodies;
}
INSTANTIATE_TEST_SUITE_P(Solid, ViscousBody, testing::ValuesIn(viscous_bodies()),
                         [](const auto& of) { return name_of(of.param); });

TEST_P(ViscousBody, TangentIsTheDerivativeOfTheForce) {
  Walk walk(model_);
  ASSERT_NE(walk.go(displacement(1, 0.02)).viscous, 0.0);
  expect_tangent_is_derivative(walk.solid, displacement(7, 0.03), displacement(3, 1.0), {dt, walk.history});
}

// What is recorded of a step is asked for when it is over: the forces are those that it ended with.
void expect_forces_of_the_end(const Model& model) {
  Walk walk(model);
  for (const unsigned seed : {4U, 5U}) {
    auto u = random_vector(3 * model.mesh->node_count(), seed);
    for (double& entry : u) entry *= 0.03;
    const SolidEnergies energies = walk.go(u);
    const bool heats = model.parts[0].material.law->name == "johnson_cook";
    EXPECT_NEAR(energies.heat, heats ? 0.9 * energies.plastic : 0.0, 1e-14 * energies.plastic) << "taylor_quinney";
    std::vector<double> again(u.size());
    walk.solid.internal_force(u, again, {dt, walk.history, true});
    EXPECT_LT(largest_difference(again, walk.f), 1e-12 * largest(walk.f));
  }
}
TEST_P(ViscousBody, HasTheForcesOfTheEndWhenTheStepIsOver) {
  expect_forces_of_the_end(model_);
}
TEST(JohnsonCook, HasTheForcesOfTheEndWhenTheStepIsOver) {
  const Material material("johnson_cook", 1.5,
                          {{"E", 2.0},
                           {"nu", 0.3},
                           {"A", 0.02},
                           {"B", 0.05},
                           {"n", 0.4},
                           {"C", 0.3},
                           {"m", 1.0},
                           {"reference_rate", 1e-3},
                           {"melting_temperature", 1300.0},
                           {"specific_heat", 1e-4}});
  for (const Element& element : elements()) {
    SCOPED_TRACE(std::string(name(element.type)) + " " + std::string(name(element.formulation)));
    expect_forces_of_the_end(body(distorted_mesh(element.type), element, material));
  }
}

// Steps by which a body moves and turns alone: no volume changes, no mode works. Small strain takes translations only.
TEST_P(ViscousBody, RigidMotionsAreNotResisted) {
  const bool is_finite = is_finite_strain(GetParam()) && GetParam().element.section != Section::axisymmetric;
  std::vector<double> u;
  for (const Vec3& X : model_.mesh->coordinates) {
    const Vec3 turned = is_finite ? Vec3{-X[1], X[0], X[2]} : X;
    const bool has_axis = GetParam().element.section == Section::axisymmetric;
    for (std::size_t c = 0; c < 3; ++c) u.push_back(turned[c] - X[c] + (has_axis && c == 0 ? 0.0 : 0.4));
    if (components(GetParam().element.section) == 2) u.back() = 0.0;
  }
  Walk walk(model_);
  EXPECT_LT(std::abs(walk.go(u).viscous), 1e-13);
  EXPECT_LT(largest(walk.f), 1e-12);
}

// Any instruction set has the plain source's answers.
TEST_P(ViscousBody, EveryInstructionSetAgrees) {
  const auto u = displacement(4, 0.02), v = displacement(5, 0.02);
  const auto answers = [&](Isa isa) {
    const Solid solid(model_, isa);
    std::vector<double> f(u.size()), history = initial_history(solid), end = history;
    solid.evaluate(u, {dt, history}, f, end);
    const SolidEnergies energies = solid.evaluate(v, {dt, end}, f, history);
    f.push_back(energies.viscous);
    std::vector<double> Kx(u.size());
    solid.tangent_action(v, u, Kx, {dt, end});
    f.insert(f.end(), Kx.begin(), Kx.end());
    f.push_back(largest_damping(solid, history));
    return f;
  };
  const auto wanted = answers(Isa::reference);
  for (const Isa isa : {Isa::x86_64_v2, Isa::x86_64_v3, Isa::x86_64_v4})
    if (supported(isa)) {
      EXPECT_LT(largest_difference(answers(isa), wanted), 1e-12 * largest(wanted)) << name(isa);
    }
}

// The bound is none below the largest eigenvalue of M^-1 C, found by the power method on the tangents of a step, and
// for equal bars it is that: 4 b_1 c / l.
TEST_P(ViscousBody, DampingIsBounded) {
  const Solid solid(model_);
  const Mass mass = solid.mass(MassKind::lumped);
  const std::vector<double> zero(solid.dof_count(), 0.0);
  std::vector<double> x = displacement(6, 1.0), Cx(x.size()), Kx(x.size());
  double eigenvalue = 0.0;
  for (int i = 0; i < 300; ++i) {
    solid.tangent_action(zero, x, Cx, {dt, {}});
    solid.tangent_action(zero, x, Kx, {0.0, {}});
    for (std::size_t d = 0; d < x.size(); ++d) {
      const double m = mass.node_diagonal()[d / 3];
      Cx[d] = m > 0.0 ? (Cx[d] - Kx[d]) * dt / m : 0.0;
    }
    eigenvalue = std::sqrt(dot(Cx, Cx) / dot(x, x));
    for (std::size_t d = 0; d < x.size(); ++d) x[d] = Cx[d] / eigenvalue;
  }
  const double bound = largest_damping(solid, {});
  EXPECT_GE(bound, eigenvalue * (1.0 - 1e-6));
  EXPECT_LE(bound, 4.0 * eigenvalue) << "cells apart, norms for eigenvalues";
}

TEST(BulkViscosity, DampingGrowsWithTheRateOfCompression) {
  const Mesh bar = mesh_of(CellType::line2, {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}}, {0, 1, 1, 2});
  constexpr double b_1 = 0.1, b_2 = 1.3;
  Walk walk(viscous(bar, *find_element(CellType::line2, Section::bar, {}), NeoHookean{unit_material},
                    {.linear = b_1, .quadratic = b_2}));
  const double c = std::sqrt(unit_material.E / unit_material.rho), l = 0.5;
  const double at_rest = 4.0 * b_1 * c / l, norm = 1.1;  // of 2 x 2 blocks: 2^(1/16)
  EXPECT_GE(largest_damping(walk.solid, {}), at_rest * (1.0 - 1e-12));
  EXPECT_LE(largest_damping(walk.solid, {}), norm * at_rest);
  walk.go(stretched(bar, {-0.2, 0.0, 0.0}));
  const double rate = 0.2 / dt / 0.8, per_rest = 1.0 + 2.0 * b_2 * b_2 * l * rate / (c * b_1);
  EXPECT_NEAR(largest_damping(walk.solid, walk.history), per_rest * largest_damping(walk.solid, {}), 1e-12);
}

}  // namespace
}  // namespace carom::test::solid_viscosity_test
