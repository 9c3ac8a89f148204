// Every element with every law: derivatives, energy, objectivity, the energy-momentum force. Bodies that yield have
// yielded before where it matters.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "math/gauss_legendre.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "solid/cell_values.hpp"
#include "solid/point_history.hpp"
#include "solid_bodies.hpp"

namespace carom::test::solid_finite_test {
namespace {

// Some hundred operations on numbers below 10 stand behind one entry, 300 x 10 x 2^-53 = 4e-13.
constexpr double round_off = 1e-12;

class EveryFiniteBody : public testing::TestWithParam<Body> {
 protected:
  Model model_ = body(GetParam());
  Solid solid_{model_};
  std::vector<double> history_ = yielded();

  /// What the points remember of a step to other displacements; nothing in elastic bodies.
  std::vector<double> yielded() const {
    const auto u = displacement(20);
    std::vector<double> f(u.size()), history = initial_history(solid_), end(history.size());
    const SolidEnergies energies = solid_.evaluate(u, {1.0, history}, f, end);
    EXPECT_EQ(energies.plastic > 1e-3, remembers(GetParam()));
    return end;
  }
  PointStep step() const { return {1.0, history_}; }
  /// Displacements that turn and strain the cells by some 10 % and invert none.
  std::vector<double> displacement(unsigned seed) const {
    auto u = random_vector(solid_.dof_count(), seed);
    for (double& entry : u) entry *= largest_move(GetParam().element.type);
    return u;
  }
  /// Stored energy: of strain and of hourglass modes.
  double energy(const std::vector<double>& u) const {
    std::vector<double> f(u.size());
    const SolidEnergies stored = solid_.evaluate(u, {}, f, {});
    return stored.strain + stored.hourglass;
  }
  std::vector<double> discrete_force(const std::vector<double>& u_0, const std::vector<double>& u_1) const {
    std::vector<double> f(u_0.size());
    solid_.discrete_gradient_force(u_0, u_1, f);
    return f;
  }
};
INSTANTIATE_TEST_SUITE_P(Solid, EveryFiniteBody, testing::ValuesIn(all_bodies()),
                         [](const auto& instance) { return name_of(instance.param); });

TEST_P(EveryFiniteBody, TangentActionIsTheDerivativeOfTheForce) {
  const auto u = displacement(1), x = random_vector(u.size(), 2);
  const double h = 3e-6;  // truncation h^2 F'''/6, F''' up to some 10^4 at these strains, and round-off 1e-14 / h
  const auto plus = internal_force(solid_, sum(h, x, u), step()), minus = internal_force(solid_, sum(-h, x, u), step());
  std::vector<double> Kx(u.size());
  solid_.tangent_action(u, x, Kx, step());
  ASSERT_GT(largest(Kx), 0.1);
  const double tolerance = 1e-8 * std::max(10.0, largest(Kx));  // rings have forces some 10 times as large
  for (std::size_t d = 0; d < u.size(); ++d) EXPECT_NEAR((plus[d] - minus[d]) / (2 * h), Kx[d], tolerance) << d;
}

TEST_P(EveryFiniteBody, AssembledTangentItsDiagonalAndItsActionAgree) {
  const auto u = displacement(3), x = random_vector(u.size(), 4);
  const CsrMatrix K = solid_.tangent(u, step());
  std::vector<double> assembled(x.size()), action(x.size()), Ky(x.size());
  K.apply(x, assembled);
  solid_.tangent_action(u, x, action, step());
  // quadratic rings have forces of up to 900, not below 10
  EXPECT_LT(largest_difference(assembled, action), round_off * std::max(1.0, 0.01 * largest(action)));
  EXPECT_LT(largest_difference(K.diagonal(), solid_.tangent_diagonal(u, step())), round_off);
  const auto y = random_vector(u.size(), 5);
  K.apply(y, Ky);
  EXPECT_NEAR(dot(x, Ky), dot(y, assembled), 10 * round_off) << "symmetry";
}

// Work along the straight path from rest, by 20 Gauss points: the integrand is a polynomial of degree 3 or analytic.
/// Every node between the same three coarse points, with weights of its own.
Interpolation some_interpolation(std::size_t nodes) {
  Interpolation P;
  const auto weight = random_vector(3 * nodes, 22);
  const std::vector<Index> coarse{0, 1, 2};
  for (std::size_t n = 0; n < nodes; ++n) P.add_point(coarse, {weight.data() + 3 * n, 3});
  P.finish(3);
  return P;
}

// x . P^T K P y = (P x) . K (P y) without fixed components, of the coarse tangent to round-off, of the fine one to
// single precision, 2^-24 of the entries; and both again into the graphs of a first call, at another place.
TEST_P(EveryFiniteBody, CoarseAndRoughTangentsAreTheTangent) {
  const Interpolation P = some_interpolation(solid_.dof_count() / 3);
  std::vector<std::uint8_t> fixed(solid_.dof_count() / 3, 0);
  fixed[0] = 5, fixed[2] = 2;
  BlockMatrix coarse, rough;
  for (const unsigned seed : {23U, 24U}) {
    const auto u = displacement(seed), x = random_vector(9, seed + 1), y = random_vector(9, seed + 2);
    solid_.project_tangent(u, step(), P, fixed, coarse, &rough);
    std::vector<double> Px(u.size()), Py(u.size()), KPy(u.size()), rough_KPy(u.size()), coarse_y(9);
    P.apply(x, Px);
    P.apply(y, Py);
    for (std::size_t i = 0; i < u.size(); ++i)
      if ((fixed[i / 3] >> (i % 3) & 1U) != 0) Px[i] = Py[i] = 0.0;
    const CsrMatrix K = solid_.tangent(u, step());
    K.apply(Py, KPy);
    coarse.apply(y, coarse_y);
    rough.apply(Py, rough_KPy);
    const double scale = static_cast<double>(u.size()) * largest(KPy);
    EXPECT_NEAR(dot(x, coarse_y), dot(Px, KPy), 1e-13 * scale);
    EXPECT_LT(largest_difference(rough_KPy, KPy), 1e-6 * std::max(1.0, largest(K.value)));
    EXPECT_LT(largest_difference(rough.diagonal(), K.diagonal()), 1e-6 * largest(K.diagonal()));
  }
}

// A cell that strains by e has nodes apart by e times its edges, which are at most a few of its lengths.
TEST_P(EveryFiniteBody, ChangeIsOfShapeAndTurnAlone) {
  const auto u = displacement(25);
  auto moved = u;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += static_cast<double>(i % 3) - 0.7;
  EXPECT_LT(solid_.largest_change(u, moved), 1e-13);
  EXPECT_EQ(solid_.largest_change(u, u), 0.0);
  for (const double e : {1e-3, 1e-1}) {
    const auto strained = sum(e, affine(*model_.mesh, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}), u);
    EXPECT_GE(solid_.largest_change(u, strained), 0.99 * e);
    EXPECT_LT(solid_.largest_change(u, strained), 10.0 * e);
  }
}

TEST_P(EveryFiniteBody, EnergyIsTheWorkOfTheForce) {
  if (remembers(GetParam())) return;  // the next test
  const auto u = displacement(6);
  double work = 0.0;
  for (const QuadraturePoint& point : gauss_legendre(20)) {
    const double s = 0.5 * (1.0 + point.x);
    work += 0.5 * point.weight * dot(internal_force(solid_, sum(s, u, std::vector<double>(u.size(), 0.0))), u);
  }
  ASSERT_GT(work, 1e-3);
  EXPECT_NEAR(energy(u), work, round_off);
}

/// Work of the forces on the way from rest to u in n equal steps, by the trapezoidal rule, less what is stored and
/// dissipated at its end; over the work.
double missing_work(const Solid& solid, const std::vector<double>& u, int n) {
  const std::vector<double> zero(u.size(), 0.0);
  std::vector<double> f(u.size()), before(u.size(), 0.0), history = initial_history(solid), end(history.size());
  SolidEnergies energies;
  double work = 0.0;
  for (int k = 1; k <= n; ++k) {
    energies = solid.evaluate(sum(static_cast<double>(k) / n, u, zero), {1.0, history}, f, end);
    work += 0.5 * (dot(f, u) + dot(before, u)) / n;
    std::swap(history, end);
    before = f;
  }
  EXPECT_GT(energies.plastic, 0.1 * work);
  return (energies.strain + energies.hourglass + energies.plastic + energies.hourglass_loss) / work - 1.0;
}

// The yield stress at the end of a step (backward Euler) is of first order in the step, the trapezoidal rule of second.
TEST_P(EveryFiniteBody, WorkOfYieldingBodiesIsStoredOrDissipated) {
  if (!remembers(GetParam())) return;
  const auto u = displacement(6);
  const double coarse = std::max(std::abs(missing_work(solid_, u, 20)), std::abs(missing_work(solid_, u, 40)));
  const double fine = missing_work(solid_, u, 160);
  EXPECT_LT(std::abs(fine), 2e-3);
  EXPECT_LT(std::abs(fine), 0.35 * coarse) << "order 1: 0.25";
}

TEST_P(EveryFiniteBody, OnlyHookesLawIsLinear) {
  EXPECT_EQ(solid_.is_linear(), index_of(*GetParam().material.law) == 0);
}

/// A rotation about z for plane cells, about (1, 2, 2) / 3 in space (Rodrigues' formula).
std::array<Vec3, 3> turn_by(double degrees, Section section) {
  const Vec3 n = components(section) == 2 ? Vec3{0, 0, 1} : Vec3{1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
  const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
  std::array<Vec3, 3> R{{{c, -s * n[2], s * n[1]}, {s * n[2], c, -s * n[0]}, {-s * n[1], s * n[0], c}}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) R[i][j] += (1.0 - c) * n[i] * n[j];
  return R;
}

Vec3 turned(const std::array<Vec3, 3>& R, const Vec3& v) {
  Vec3 result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = R[i][0] * v[0] + R[i][1] * v[1] + R[i][2] * v[2];
  return result;
}

/// Displacements of the body that is deformed by u and then turned.
std::vector<double> turned(const Mesh& mesh, const std::array<Vec3, 3>& R, const std::vector<double>& u) {
  std::vector<double> result;
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const Vec3& X = mesh.coordinates[n];
    const Vec3 x = turned(R, {X[0] + u[3 * n], X[1] + u[3 * n + 1], X[2] + u[3 * n + 2]});
    for (std::size_t i = 0; i < 3; ++i) result.push_back(x[i] - X[i]);
  }
  return result;
}

// Objectivity: F(R (X + u) - X) = R F(u) and the same energy; with u = 0 a rotation makes no force at all.
TEST_P(EveryFiniteBody, FiniteStrainIsObjective) {
  const Section section = GetParam().section;
  if (!is_finite_strain(GetParam()) || section == Section::axisymmetric)
    return;  // no rotation maps these to themselves
  const std::vector<double> rest(solid_.dof_count(), 0.0);
  const auto u = displacement(7), f = internal_force(solid_, u);
  for (const double degrees : {1.0, 30.0, 180.0}) {
    const auto R = turn_by(degrees, section);
    EXPECT_LT(largest(internal_force(solid_, turned(*model_.mesh, R, rest))), round_off);
    for (const auto& stress : cell_stress(solid_, turned(*model_.mesh, R, rest)))
      for (const double component : stress) EXPECT_NEAR(component, 0.0, round_off);
    const auto Ru = turned(*model_.mesh, R, u), Rf = internal_force(solid_, Ru);
    EXPECT_NEAR(energy(Ru), energy(u), round_off);
    for (std::size_t n = 0; n < solid_.node_count(); ++n) {
      const Vec3 expected = turned(R, {f[3 * n], f[3 * n + 1], f[3 * n + 2]});
      for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(Rf[3 * n + i], expected[i], round_off);
    }
  }
}

// The discrete gradient: energies to round-off of the energy after any step, however large.
TEST_P(EveryFiniteBody, DiscreteGradientForceHasTheWorkOfTheStep) {
  if (remembers(GetParam())) return;  // no potential
  for (const unsigned seed : {8U, 9U, 10U}) {
    auto u_0 = displacement(seed), u_1 = displacement(seed + 100);
    const double change = energy(u_1) - energy(u_0);
    EXPECT_NEAR(dot(discrete_force(u_0, u_1), sum(-1.0, u_0, u_1)), change, round_off);
    ASSERT_GT(std::abs(change), 1e-6);
  }
}

TEST_P(EveryFiniteBody, DiscreteGradientForceOfNoStepIsTheForce) {
  if (remembers(GetParam())) return;  // no potential
  const auto u = displacement(11);
  EXPECT_LT(largest_difference(discrete_force(u, u), internal_force(solid_, u)), round_off);
}

// Lengths times a power of two, with the thickness of plane cells and the area of bars: areas and forces times its
// square, to the bit.
TEST_P(EveryFiniteBody, DiscreteGradientForceIsThatOfTheSmallerBody) {
  if (remembers(GetParam())) return;  // no potential
  const double unit = std::ldexp(1.0, -20);
  Mesh mesh = *model_.mesh;
  for (Vec3& x : mesh.coordinates) x = scaled(x, unit);
  Model small = model_;
  small.mesh = std::make_shared<const Mesh>(std::move(mesh));
  small.parts[0].thickness *= GetParam().section == Section::bar ? unit * unit : unit;
  const auto u_0 = displacement(26), u_1 = displacement(27), f = discrete_force(u_0, u_1);
  std::vector<double> small_u_0 = u_0, small_u_1 = u_1, small_f(f.size());
  for (std::size_t i = 0; i < f.size(); ++i) small_u_0[i] *= unit, small_u_1[i] *= unit;
  Solid(small).discrete_gradient_force(small_u_0, small_u_1, small_f);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_EQ(small_f[i], unit * unit * f[i]) << i;
}

// No resultant and no moment about the middle configuration (reference configuration under small strain); axisymmetric
// cells hold their hoop forces themselves and have a resultant in x.
TEST_P(EveryFiniteBody, DiscreteGradientForceConservesMomentum) {
  if (remembers(GetParam())) return;  // no potential
  const Section section = GetParam().section;
  const auto u_0 = displacement(12), u_1 = displacement(13);
  const auto f = discrete_force(u_0, u_1);
  const double middle = is_finite_strain(GetParam()) ? 0.5 : 0.0;
  Vec3 force{}, moment{};
  for (std::size_t n = 0; n < solid_.node_count(); ++n) {
    Vec3 x = model_.mesh->coordinates[n];
    for (std::size_t i = 0; i < 3; ++i) x[i] += middle * (u_0[3 * n + i] + u_1[3 * n + i]);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      force[i] += f[3 * n + i];
      moment[i] += x[j] * f[3 * n + k] - x[k] * f[3 * n + j];
    }
  }
  EXPECT_GT(largest(f), 0.01);
  for (std::size_t i = section == Section::axisymmetric ? 1 : 0; i < 3; ++i) EXPECT_NEAR(force[i], 0.0, 10 * round_off);
  if (section == Section::axisymmetric) return;
  if (components(section) == 2) moment[0] = moment[1] = 0.0;  // by u_z, of which plane cells know nothing
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(moment[i], 0.0, 10 * round_off);
}

TEST_P(EveryFiniteBody, PlaneCellsKnowNothingOfZ) {
  if (components(GetParam().section) == 3) return;
  const auto u = displacement(14);
  auto lifted = u;
  for (std::size_t d = 2; d < u.size(); d += 3) lifted[d] = 5.0;
  const auto f = internal_force(solid_, u);
  EXPECT_EQ(internal_force(solid_, lifted), f);
  for (std::size_t d = 2; d < u.size(); d += 3) EXPECT_EQ(f[d], 0.0);
}

TEST_P(EveryFiniteBody, AnInvertedCellGivesNoNumber) {
  if (!is_finite_strain(GetParam()) || GetParam().section == Section::bar) return;  // a bar turns, it has no inside
  std::vector<double> u(solid_.dof_count());
  const bool plane = components(GetParam().section) == 2;
  for (std::size_t n = 0; n < solid_.node_count(); ++n)  // mirrored at y = 0 (plane) or z = 0: J = -1, C = 1
    u[3 * n + (plane ? 1 : 2)] = -2.0 * model_.mesh->coordinates[n][plane ? 1 : 2];
  EXPECT_TRUE(std::isnan(internal_force(solid_, u)[0]));
  EXPECT_TRUE(std::isnan(strain_energy(solid_, u)));
}

TEST_P(EveryFiniteBody, SameBitsForAnyNumberOfThreads) {
  const Section section = GetParam().section;
  const CellType type = GetParam().element.type;
  Mesh mesh = section == Section::solid ? block_mesh({8, 8, 24}, 0.1) : quad_mesh(40, 40, 0.1);
  if (section != Section::bar) mesh = with_cells(mesh, type);
  if (section == Section::bar) {  // a grid of 3200 bars
    std::vector<Index> bars;
    for (Index n = 0; n < 40 * 40; ++n) bars.insert(bars.end(), {n, n + 1, n, n + 41});
    mesh = mesh_of(CellType::line2, mesh.coordinates, bars);
  }
  const Model model = body(std::move(mesh), GetParam().element, GetParam().material);
  const Solid solid(model);
  auto u = random_vector(solid.dof_count(), 15);
  for (double& entry : u) entry *= 0.02;
  const auto x = random_vector(u.size(), 16);
  const auto all = [&](int threads) {
    set_threads(threads);
    std::vector<double> result(u.size()), y(u.size()), history = initial_history(solid), end(history.size());
    const SolidEnergies energies = solid.evaluate(u, {1.0, history}, result, end);
    result.insert(result.end(), {energies.strain, energies.plastic, energies.hourglass, energies.hourglass_loss});
    result.insert(result.end(), end.begin(), end.end());
    solid.tangent_action(u, x, y);
    result.insert(result.end(), y.begin(), y.end());
    if (!remembers(GetParam())) {
      solid.discrete_gradient_force(u, std::vector<double>(u.size(), 0.0), y);
      result.insert(result.end(), y.begin(), y.end());
    }
    result.push_back(strain_energy(solid, u));
    const Rotation rotation = largest_rotation(solid, u);
    result.push_back(rotation.angle);
    result.push_back(rotation.cell);
    return result;
  };
  const auto expected = all(1);
  for (const double entry : expected) ASSERT_TRUE(std::isfinite(entry));
  EXPECT_EQ(all(2), expected);
  EXPECT_EQ(all(4), expected);
  set_threads(0);
}

TEST_P(EveryFiniteBody, ForceOfSomeCellsIsTheirShare) {
  const auto u = displacement(17);
  std::vector<double> f(u.size(), 0.0);
  std::vector<Index> others;
  for (Index c = 1; c < static_cast<Index>(solid_.cells().size()); ++c) others.push_back(c);
  solid_.add_internal_force_of(std::vector<Index>{0}, u, f);
  EXPECT_GT(largest_difference(f, internal_force(solid_, u)), 0.01);
  solid_.add_internal_force_of(others, u, f);
  EXPECT_LT(largest_difference(f, internal_force(solid_, u)), round_off);
}

class EveryIsaAndBody : public testing::TestWithParam<std::tuple<Isa, Body>> {};
INSTANTIATE_TEST_SUITE_P(Solid, EveryIsaAndBody,
                         testing::Combine(testing::ValuesIn(available_isas()), testing::ValuesIn(all_bodies())),
                         [](const auto& instance) {
                           return std::string(name(std::get<0>(instance.param))) + name_of(std::get<1>(instance.param));
                         });

/// Forces and energies of a step to v after one to u; the order of the histories differs.
void expect_equal_second_steps(const Solid& solid, const Solid& reference, const std::vector<double>& u,
                               const std::vector<double>& v) {
  const auto second = [&](const Solid& of, std::vector<double>& f) {
    std::vector<double> rest = initial_history(of), begin(rest.size()), end(rest.size());
    of.evaluate(u, {1.0, rest}, f, begin);
    return of.evaluate(v, {1.0, begin}, f, end);
  };
  std::vector<double> f(u.size()), expected(u.size());
  const SolidEnergies energies = second(solid, f), wanted = second(reference, expected);
  EXPECT_LT(largest_difference(f, expected), round_off);
  EXPECT_GT(wanted.plastic, 1e-3);
  EXPECT_NEAR(energies.plastic, wanted.plastic, round_off * wanted.plastic);
  EXPECT_NEAR(energies.strain, wanted.strain, round_off * wanted.strain);
}

TEST_P(EveryIsaAndBody, KernelsEqualTheReference) {
  const auto& [isa, of] = GetParam();
  const Model model = body(of);  // the last batch is not full
  const Solid solid(model, isa), reference(model, Isa::reference);
  auto u = random_vector(solid.dof_count(), 18), v = random_vector(solid.dof_count(), 19);
  for (double& entry : u) entry *= 0.8 * largest_move(of.element.type);
  for (double& entry : v) entry *= 0.8 * largest_move(of.element.type);
  EXPECT_LT(largest_difference(internal_force(solid, u), internal_force(reference, u)), round_off);
  std::vector<double> y(u.size()), expected(u.size());
  solid.tangent_action(u, v, y);
  reference.tangent_action(u, v, expected);
  EXPECT_LT(largest_difference(y, expected), round_off);
  EXPECT_LT(largest_difference(solid.tangent(u).value, reference.tangent(u).value), round_off);
  if (remembers(of)) {
    expect_equal_second_steps(solid, reference, u, v);
  } else {
    solid.discrete_gradient_force(u, v, y);
    reference.discrete_gradient_force(u, v, expected);
    EXPECT_LT(largest_difference(y, expected), round_off);
  }
  EXPECT_NEAR(strain_energy(solid, u), strain_energy(reference, u), round_off * strain_energy(reference, u));
  const auto stress = cell_stress(solid, u), expected_stress = cell_stress(reference, u);
  for (std::size_t c = 0; c < stress.size(); ++c)
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(stress[c][i], expected_stress[c][i], round_off);
}

TEST(SolidRotation, IsTheAngleOfTheRotationWhateverTheStretch) {
  const double angle = 0.3, c = std::cos(angle), s = std::sin(angle);
  // F = R U with U = diag(1.1, 0.9, 1): the columns of the rotation about z, stretched
  const std::array<Vec3, 3> H{{{1.1 * c - 1, -0.9 * s, 0}, {1.1 * s, 0.9 * c - 1, 0}, {0, 0, 0}}};
  for (const Section section : {Section::solid, Section::plane_stress, Section::plane_strain}) {
    const Model model = body(distorted_mesh(section), section, unit_material);
    EXPECT_NEAR(largest_rotation(Solid(model), affine(*model.mesh, H)).angle, angle, round_off);
  }
  const std::array<Vec3, 3> R{{{c - 1, -s, 0}, {s, c - 1, 0}, {0, 0, 0}}};
  const Model bar = body(mesh_of(CellType::line2, {{0, 0, 0}, {2, 0, 0}}, {0, 1}), Section::bar, unit_material);
  EXPECT_NEAR(largest_rotation(Solid(bar), affine(*bar.mesh, R)).angle, angle, round_off);
}

TEST(SolidRotation, NamesTheCellAndLooksAtSmallStrainAlone) {
  Model model = body(block_mesh({3, 1, 1}, 0.0), Section::solid, unit_material);
  std::vector<double> u(3 * model.mesh->node_count(), 0.0);
  for (std::size_t n = 0; n < model.mesh->node_count(); ++n)  // the last cell leans by tan = 0.1
    if (model.mesh->coordinates[n][0] > 2.5) u[3 * n + 1] = 0.1;
  const Rotation rotation = largest_rotation(Solid(model), u);
  EXPECT_EQ(rotation.cell, 2);
  EXPECT_NEAR(rotation.angle, std::atan(0.05), round_off);  // simple shear: tan(angle) = shear / 2
  model.parts[0].material = NeoHookean{unit_material};
  EXPECT_EQ(largest_rotation(Solid(model), u).cell, -1);
  model.parts[0].material = unit_material;
  u[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(largest_rotation(Solid(model), u).angle, std::numbers::pi);
}

}  // namespace
}  // namespace carom::test::solid_finite_test
