// Every section against closed forms: patches, rigid modes, masses, thick-walled cylinders, tension, loads.
#include <gtest/gtest.h>

#include <numbers>

#include "base/errors.hpp"
#include "solid/cell_values.hpp"
#include "solid/stability.hpp"
#include "solid_bodies.hpp"

namespace carom::test::solid_sections_test {
namespace {

constexpr double round_off = 1e-12;  // some hundred operations on numbers below 10, 2^-53 each
constexpr double pi = std::numbers::pi;

class EveryBody : public testing::TestWithParam<Body> {};
INSTANTIATE_TEST_SUITE_P(Sections, EveryBody, testing::ValuesIn(all_bodies()),
                         [](const auto& instance) { return name_of(instance.param); });

/// A displacement gradient that the section can have uniformly.
std::array<Vec3, 3> patch_gradient(Section section) {
  if (section == Section::axisymmetric)
    return {{{0.1, 0, 0}, {0, -0.2, 0}, {0, 0, 0}}};  // u_x = 0.1 x: hoop strain 0.1
  if (section == Section::solid) return {{{0.1, 0.02, -0.03}, {0.04, -0.2, 0.05}, {0.01, 0.03, 0.15}}};
  return {{{0.1, 0.02, 0}, {0.04, -0.2, 0}, {0, 0, 0}}};
}

/// Distorted cells that hold a uniform stress. Two points a direction integrate it over cells with straight edges
/// alone: its products with the derivatives of shape and place have the degree 3 there, and up to 5 on curved ones.
Mesh patch_mesh(const Element& element) {
  constexpr int n = 4;
  if (element.formulation != Formulation::reduced || element.section == Section::plane_strain ||
      element.section == Section::plane_stress)
    return distorted_mesh(element.type, n);
  return with_cells(dimension(element.type) == 3 ? block_mesh({n, n, n}, 0.15) : quad_mesh(n, n, 0.15), element.type);
}

// Patch test on a distorted mesh: the stress is uniform and the inner nodes are at rest.
TEST_P(EveryBody, PatchTest) {
  const Section section = GetParam().section;
  if (section == Section::bar) return;  // the bars of a truss have each their own stress
  const Model model = body(patch_mesh(GetParam().element), GetParam().element, GetParam().material);
  const Mesh& mesh = *model.mesh;
  const Solid solid(model);
  const auto u = affine(mesh, patch_gradient(section));
  const auto f = internal_force(solid, u);
  const auto stress = cell_stress(solid, u);
  EXPECT_GT(largest({stress[0].begin(), stress[0].end()}), 0.01);
  for (const auto& cell : stress)
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(cell[c], stress[0][c], round_off);
  if (section == Section::plane_stress) {
    EXPECT_NEAR(stress[0][2], 0.0, round_off);
  }
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const Vec3& x = mesh.coordinates[n];
    const double left = section == Section::solid ? 0.0 : 1.0;
    bool inside = x[0] > left + 0.1 && x[0] < left + 3.9 && x[1] > 0.1 && x[1] < 3.9;
    if (section == Section::solid) inside = inside && x[2] > 0.1 && x[2] < 3.9;
    for (std::size_t i = 0; inside && i < 3; ++i) EXPECT_NEAR(f[3 * n + i], 0.0, 10 * round_off) << n;
  }
}

// Rigid motions of one cell: six in space, three in the plane, one along the axis of revolution; z of plane cells is
// free at every node; a bar keeps its length alone. Single cells of some formulations have more, which no neighbours
// share: turning of rings about their one point, and of second order the displacements without change of shape whose
// change of volume has no mean, or that have no strain at the points of reduced integration.
TEST_P(EveryBody, OneCellHasItsRigidModesAndNoMore) {
  const Section section = GetParam().section;
  const Element& element = GetParam().element;
  const bool alone = element.formulation == Formulation::full && section != Section::axisymmetric;
  const Solid solid(body(alone ? one_cell(element.type) : few_cells(element.type), element, GetParam().material));
  const auto values = eigenvalues(dense(solid.tangent(std::vector<double>(solid.dof_count(), 0.0))));
  const std::size_t expected[] = {6, 3, 3, 1, 5};
  const std::size_t zeros =
      expected[static_cast<std::size_t>(section)] + (components(section) == 2 ? solid.node_count() : 0);
  for (std::size_t i = 0; i < zeros; ++i) EXPECT_NEAR(values[i], 0.0, 10 * round_off);
  EXPECT_GT(values[zeros], 1e-3) << "no hourglass mode is without stiffness";
}

// A bar with lumped ends m/2 each: omega^2 = k / m_1 + k / m_2 = 4 E / (rho L^2); |A^8|^(1/8) of a matrix of rank one
// exceeds it by at most 6^(1/16) = 1.12.
TEST(Bar, HasItsFrequency) {
  const Solid solid(body(mesh_of(CellType::line2, {{0, 0, 0}, {0, 0, 0.5}}, {0, 1}), Section::bar, unit_material));
  const double exact = 4 * unit_material.E / (unit_material.rho * 0.25), bound = cell_frequency_bounds(solid)[0];
  EXPECT_GE(bound, exact * (1 - round_off));
  EXPECT_LE(bound, 1.12 * exact);
}

// rho A L / 6 (2 1; 1 2) (Zienkiewicz, Taylor and Zhu); the ring of radii 1 to 4 and height 3: pi (16 - 1) 3.
TEST(SectionMass, BarsAndRingsAndPlates) {
  const double rho = unit_material.rho;
  const Solid bar(body(mesh_of(CellType::line2, {{0, 0, 0}, {3, 4, 0}}, {0, 1}), Section::bar, unit_material, 0.5));
  const Mass bar_mass = bar.mass(MassKind::consistent);
  const std::vector<double> expected{2.0, 1.0, 1.0, 2.0};
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(bar_mass.node_matrix().value[k], rho * 0.5 * 5.0 / 6.0 * expected[k], round_off);
  EXPECT_NEAR(bar.cells().volumes[0], 2.5, round_off);
  EXPECT_NEAR(bar.cells().lengths[0], 5.0, round_off);
  for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) {
    const Solid ring(body(quad_mesh(3, 3, 0.2), Section::axisymmetric, unit_material));
    EXPECT_NEAR(ring.mass(kind).total(), rho * pi * 15 * 3, 100 * round_off);
    const Solid plate(body(quad_mesh(3, 3, 0.2), Section::plane_stress, unit_material, 0.7));
    EXPECT_NEAR(plate.mass(kind).total(), rho * 9 * 0.7, 100 * round_off);
    EXPECT_NEAR(plate.cells().lengths[0], plate.cells().volumes[0] / 0.7, 0.3) << "squares of about 1";
  }
}

constexpr double inner = 1.0, outer = 2.0, pressure = 0.1;

/// Lame's radial displacement of a thick tube in plane strain under internal pressure (Timoshenko and Goodier, Theory
/// of Elasticity, section 28): u = (1 + nu)/E p a^2/(b^2 - a^2) ((1 - 2 nu) r + b^2 / r).
double lame_displacement(double r) {
  const double E = unit_material.E, nu = unit_material.nu;
  const double factor = (1 + nu) / E * pressure * inner * inner / (outer * outer - inner * inner);
  return factor * ((1 - 2 * nu) * r + outer * outer / r);
}

/// Largest error of the radial displacement of the tube with n cells across the wall: a slice of rings between held
/// planes, or a quarter in the plane of `2 n` cells around.
double tube_error(Section section, int n) {
  const bool ring = section == Section::axisymmetric;
  Mesh mesh = quad_mesh(n, ring ? 1 : 2 * n, 0.0, 0.0);
  for (Vec3& x : mesh.coordinates) {
    const double r = inner + (outer - inner) * x[0] / n, angle = 0.5 * pi * x[1] / (2 * n);
    x = ring ? Vec3{r, 0.3 * x[1], 0.0} : Vec3{r * std::cos(angle), r * std::sin(angle), 0.0};
  }
  Model model = body(mesh, section, unit_material, 1.0);
  Pressure load{{{}, section, 1.0}, pressure, {}};
  for (Index j = 0; j < (ring ? 1 : 2 * n); ++j)  // downwards along x = a: the body lies on the left
    load.surface.facets.push_back({{(j + 1) * (n + 1), j * (n + 1), -1, -1}, 2});
  model.loads.emplace_back(load);
  const Solid solid(model);
  std::vector<double> f(solid.dof_count());
  solid.loads().force(0.0, solid.mass(MassKind::lumped), f);
  std::vector<bool> held(f.size(), false);
  for (std::size_t k = 0; k < mesh.node_count(); ++k) {
    held[3 * k + 2] = true;
    held[3 * k + 1] = ring || mesh.coordinates[k][1] < 1e-9;
    held[3 * k] = !ring && mesh.coordinates[k][0] < 1e-9;
  }
  const auto u = solve(solid, f, held);
  double error = 0.0;
  for (std::size_t k = 0; k < mesh.node_count(); ++k) {
    const double r = ring ? mesh.coordinates[k][0] : std::hypot(mesh.coordinates[k][0], mesh.coordinates[k][1]);
    const double radial = ring ? u[3 * k] : std::hypot(u[3 * k], u[3 * k + 1]);
    error = std::max(error, std::abs(radial - lame_displacement(r)));
  }
  return error;
}

// Bilinear displacements converge with order 2 at the nodes too.
TEST(ThickTube, ConvergesToLameWithOrderTwo) {
  for (const Section section : {Section::axisymmetric, Section::plane_strain}) {
    const double coarse = tube_error(section, 8), fine = tube_error(section, 16);
    EXPECT_LT(fine, 2e-3 * lame_displacement(inner));
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << static_cast<int>(section);
  }
}

struct Tension {
  double axial, lateral, nominal_stress;  ///< stretches, and axial force per reference area
};

// Uniaxial stress, closed forms. Hooke and St. Venant-Kirchhoff: e_lateral = -nu e, S = E e. Neo-Hookean with the
// squared lateral stretch c given: zero lateral stress means lambda ln J = G (1 - c), and J = c x axial stretch.
Tension elastic_tension(const Material& material) {
  const double E = unit_material.E, nu = unit_material.nu, G = unit_material.shear_modulus();
  if (index_of(*material.law) == 0) return {1.2, 1.0 - nu * 0.2, E * 0.2};
  if (index_of(*material.law) == 1) return {std::sqrt(1.4), std::sqrt(1.0 - nu * 0.4), E * 0.2 * std::sqrt(1.4)};
  const double c = 0.9, ln_J = G * (1.0 - c) / unit_material.lame_lambda(), axial = std::exp(ln_J) / c;
  const double S = G * (1.0 - 1.0 / (axial * axial)) + unit_material.lame_lambda() * ln_J / (axial * axial);
  return {axial, std::sqrt(c), axial * S};
}

// Linear hardening: e = s / E + (s - s_y) / H, and the plastic strain keeps the volume. At finite strain the same holds
// between the logarithms of the stretches and the Kirchhoff stress, axial stretch x nominal stress.
Tension tension(const Body& body) {
  if (!remembers(body)) return elastic_tension(body.material);
  const double E = unit_material.E, nu = unit_material.nu, H = body.material.value("hardening_modulus");
  const double e = 0.2, s = (e + body.material.value("yield_stress") / H) / (1.0 / E + 1.0 / H);
  const double lateral = -nu * s / E - 0.5 * (e - s / E);
  if (!is_finite_strain(body)) return {1.0 + e, 1.0 + lateral, s};
  return {std::exp(e), std::exp(lateral), s * std::exp(-e)};
}

TEST_P(EveryBody, UniaxialTension) {
  const auto& [element, material, section] = GetParam();
  if (section == Section::plane_strain || section == Section::axisymmetric) return;  // no uniaxial stress there
  const Tension t = tension(GetParam());
  const Mesh mesh = section == Section::solid ? with_cells(block_mesh({2, 2, 2}, 0.15, 0.5), element.type)
                    : section == Section::bar ? mesh_of(CellType::line2, {{0, 0, 0}, {1, 0, 0}}, {0, 1})
                                              : with_cells(quad_mesh(1, 1, 0.0, 0.0), element.type);
  const Solid solid(body(mesh, element, material, 0.7));
  const double area = section == Section::solid ? 1.0 : 0.7;
  const auto u = affine(mesh, {{{t.axial - 1, 0, 0}, {0, t.lateral - 1, 0}, {0, 0, t.lateral - 1}}});
  const auto f = internal_force(solid, u);
  double force = 0.0;
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    if (mesh.coordinates[n][0] > 0.9) force += f[3 * n];
    EXPECT_NEAR(f[3 * n + 1], 0.0, round_off);
  }
  EXPECT_NEAR(force, area * t.nominal_stress, round_off);
  const double section_ratio = !is_finite_strain(GetParam()) ? 1.0 : t.lateral * t.lateral;
  for (const auto& stress : cell_stress(solid, u)) {
    EXPECT_NEAR(stress[0], t.nominal_stress / section_ratio, round_off);
    for (std::size_t c = 1; c < 6; ++c) EXPECT_NEAR(stress[c], 0.0, round_off);
  }
}

std::array<double, 3> resultant(const Model& model) {
  const Solid solid(model);
  std::vector<double> f(solid.dof_count());
  solid.loads().force(0.0, solid.mass(MassKind::lumped), f);
  std::array<double, 3> force{};
  for (std::size_t d = 0; d < f.size(); ++d) force[d % 3] += f[d];
  return force;
}

// Pressure times the area it acts on: thickness x length, the frustum's 2 pi x ds, triangles, a bar's section.
TEST(SectionLoads, PressuresHaveTheirResultants) {
  Model plate = body(quad_mesh(2, 1, 0.0), Section::plane_strain, unit_material, 0.7);
  plate.loads.emplace_back(Pressure{{{{{1, 0, -1, -1}, 2}, {{2, 1, -1, -1}, 2}}, Section::plane_strain, 0.7}, 2.0, {}});
  EXPECT_NEAR(resultant(plate)[1], -2.0 * 0.7 * 2.0, round_off) << "edge from right to left: normal up, pushed down";
  Model ring = body(quad_mesh(2, 1, 0.0), Section::axisymmetric, unit_material);
  ring.loads.emplace_back(Pressure{{{{{0, 1, -1, -1}, 2}, {{1, 2, -1, -1}, 2}}, Section::axisymmetric, 1.0}, 2.0, {}});
  EXPECT_NEAR(resultant(ring)[1], 2.0 * pi * (9.0 - 1.0), 10 * round_off) << "annulus of radii 1 and 3";
  Model block = body(block_mesh({1, 1, 1}, 0.0), Section::solid, unit_material);
  std::array<Index, 3> top{};
  for (Index n = 0; n < 8; ++n) {  // the triangle (1,0,1), (1,1,1), (0,1,1)
    const Vec3& x = block.mesh->coordinates[static_cast<std::size_t>(n)];
    if (x[2] > 0.5 && x[0] + x[1] > 0.5) top[static_cast<std::size_t>(x[0] < 0.5 ? 2 : x[1] < 0.5 ? 0 : 1)] = n;
  }
  block.loads.emplace_back(Pressure{{{{{top[0], top[1], top[2], -1}, 3}}}, 2.0, {}});
  EXPECT_NEAR(resultant(block)[2], -2.0 * 0.5, round_off);
  Model bar =
      body(mesh_of(CellType::line2, {{0, 0, 0}, {3, 4, 0}, {6, 8, 0}}, {0, 1, 1, 2}), Section::bar, unit_material, 0.5);
  bar.loads.emplace_back(Pressure{{{{{2, -1, -1, -1}, 1}}, Section::bar, 0.5}, 2.0, {}});
  EXPECT_NEAR(resultant(bar)[0], -0.6, round_off);
  EXPECT_NEAR(resultant(bar)[1], -0.8, round_off);
  std::get<Pressure>(bar.loads[0]).surface.facets[0].node[0] = 1;
  EXPECT_THROW(Solid{bar}, CaseError) << "the middle node is no end";
}

TEST(SectionLoads, GravityPullsRingsAndBars) {
  Model ring = body(quad_mesh(2, 1, 0.0), Section::axisymmetric, unit_material);
  ring.loads.emplace_back(Gravity{{0.0, -2.0, 0.0}, {}});
  EXPECT_NEAR(resultant(ring)[1], -2.0 * unit_material.rho * pi * 8.0, 100 * round_off);
}

std::string message_of(const Model& model) {
  try {
    const Solid solid(model);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SectionErrors, SayWhatIsWrong) {
  Model wrong = body(quad_mesh(1, 1, 0.0), Section::plane_strain, unit_material);
  wrong.parts[0].section = Section::bar;
  EXPECT_NE(message_of(wrong).find("LINE2 cells for this section"), std::string::npos) << message_of(wrong);
  Mesh lifted = quad_mesh(1, 1, 0.0);
  lifted.coordinates[2][2] = 0.1;
  EXPECT_NE(message_of(body(lifted, Section::plane_stress, unit_material)).find("plane cells in the x-y plane"),
            std::string::npos);
  EXPECT_NE(message_of(body(quad_mesh(1, 1, 0.0, -0.2), Section::axisymmetric, unit_material)).find("x >= 0"),
            std::string::npos);
  // The axis itself, as meshers write it.
  EXPECT_EQ(message_of(body(quad_mesh(1, 1, 0.0, -1.7e-15), Section::axisymmetric, unit_material)), "no error");
  EXPECT_NE(message_of(body(quad_mesh(1, 1, 0.0), Section::plane_strain, unit_material, 0.0)).find("a positive number"),
            std::string::npos);
  const Mesh point = mesh_of(CellType::line2, {{0, 0, 0}, {0, 0, 0}}, {0, 1});
  EXPECT_NE(message_of(body(point, Section::bar, unit_material)).find("Jacobian determinant 0 in cell 1"),
            std::string::npos);
}

}  // namespace
}  // namespace carom::test::solid_sections_test
