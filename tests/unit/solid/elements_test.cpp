// Every element of the table against closed forms: masses, free fall, the largest frequency.
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "solid/cell_values.hpp"
#include "solid/stability.hpp"
#include "solid_bodies.hpp"

namespace carom::test::solid_elements_test {
namespace {

constexpr double round_off = 1e-12;  // some hundred operations on numbers below 10, 2^-53 each
constexpr double pi = std::numbers::pi, thickness = 0.7;

class EveryElement : public testing::TestWithParam<Element> {};
INSTANTIATE_TEST_SUITE_P(Solid, EveryElement, testing::ValuesIn(elements().begin(), elements().end()),
                         [](const auto& instance) {
                           return name_of({instance.param, unit_material});
                         });

/// Distorted cells with straight edges that fill a box: 2 x 2 x 2, or [1, 4] x [0, 3] in the plane; the truss.
Mesh straight_mesh(CellType type) {
  if (dimension(type) == 1) return truss_mesh();
  return with_cells(dimension(type) == 3 ? block_mesh({2, 2, 2}, 0.15) : quad_mesh(3, 3, 0.15), type);
}

/// The volume of straight_mesh: box, plate, ring of radii 1 to 4, six bars with the section `thickness`.
double volume(Section section) {
  if (section == Section::solid) return 8.0;
  if (section == Section::axisymmetric) return pi * (16.0 - 1.0) * 3.0;
  if (section != Section::bar) return 9.0 * thickness;
  const Mesh truss = truss_mesh();
  double length = 0.0;
  for (std::size_t k = 0; k < 12; k += 2) {
    const auto end = [&](std::size_t i) {
      return truss.coordinates[static_cast<std::size_t>(truss.blocks[0].connectivity[i])];
    };
    length += norm(subtract(end(k), end(k + 1)));
  }
  return length * thickness;
}

TEST_P(EveryElement, MassesAreDensityTimesVolumeAndLumpedOnesPositive) {
  const Element& element = GetParam();
  const Solid solid(body(straight_mesh(element.type), element, unit_material, thickness));
  const double exact = unit_material.rho * volume(element.section), tolerance = round_off * exact;
  const Mass consistent = solid.mass(MassKind::consistent), lumped = solid.mass(MassKind::lumped);
  EXPECT_NEAR(consistent.total(), exact, tolerance);
  EXPECT_NEAR(lumped.total(), exact, tolerance);
  for (const double m : lumped.node_diagonal()) EXPECT_GT(m, 1e-3 * exact / static_cast<double>(solid.node_count()));
  const auto masses = cell_masses(solid);
  double sum = 0.0;
  for (std::size_t c = 0; c < masses.size(); ++c) {
    EXPECT_NEAR(masses[c], unit_material.rho * solid.cells().volumes[c], tolerance);
    sum += masses[c];
  }
  EXPECT_NEAR(sum, exact, tolerance);
  const std::vector<double> x = random_vector(solid.dof_count(), 31);
  std::vector<double> Mx(x.size());
  consistent.apply(x, Mx);
  EXPECT_GT(dot(x, Mx), 0.0);
}

// The scaled diagonal of one cell: equal shares of linear shapes without a favoured node; of second order the integrals
// of N_a^2 over their sum (Hinton, Rock and Zienkiewicz, Earthquake Eng. Struct. Dyn. 4, 1976): QUAD8 3/76 and 16/76,
// TRIA6 3/57 and 16/57, HEXA27 products of 1/6, 4/6, 1/6; PENTA15 3, 8 and 12 of 102, PYRA13 11, 9, 48 and 32 of 373.
TEST_P(EveryElement, LumpedMassOfOneCellHasItsClosedForm) {
  const Element& element = GetParam();
  if (element.section == Section::axisymmetric || element.type == CellType::pyra5) return;  // shares by place
  if (element.type == CellType::tetra10 || element.type == CellType::hexa20) return;        // below
  const Mesh grid = dimension(element.type) == 3 ? block_mesh({1, 1, 1}, 0.0) : quad_mesh(1, 1, 0.0);
  Mesh mesh = dimension(element.type) == 1 ? one_cell(element.type) : with_cells(grid, element.type);
  CellBlock& block = mesh.blocks[0];
  const auto nodes = static_cast<std::size_t>(node_count(element.type));
  block.connectivity.resize(nodes);
  block.file_numbers.resize(1);
  const Solid solid(body(mesh, element, unit_material, thickness));
  const double total = unit_material.rho * solid.cells().volumes[0];
  const auto m = solid.mass(MassKind::lumped).node_diagonal();
  const auto corners = static_cast<std::size_t>(corner_count(element.type));
  for (std::size_t a = 0; a < nodes; ++a) {
    double share = 1.0 / static_cast<double>(nodes);
    if (element.type == CellType::quad8) share = a < corners ? 3.0 / 76.0 : 16.0 / 76.0;
    if (element.type == CellType::tria6) share = a < corners ? 3.0 / 57.0 : 16.0 / 57.0;
    if (element.type == CellType::hexa27) share = std::pow(4.0, a < 8 ? 0 : a < 20 ? 1 : a < 26 ? 2 : 3) / 216.0;
    if (element.type == CellType::penta15) share = (a < 6 ? 3.0 : a < 12 ? 8.0 : 12.0) / 102.0;
    if (element.type == CellType::pyra13) share = (a < 4 ? 11.0 : a < 5 ? 9.0 : a < 9 ? 48.0 : 32.0) / 373.0;
    EXPECT_NEAR(m[static_cast<std::size_t>(block.connectivity[a])], share * total, round_off) << a;
  }
}

// On a distorted cell: the diagonal of the consistent mass, scaled to its sum.
TEST_P(EveryElement, LumpedMassOfADistortedCellIsTheScaledDiagonal) {
  const Element& element = GetParam();
  Mesh mesh = distorted_mesh(element.type);
  CellBlock& block = mesh.blocks[0];
  block.connectivity.resize(static_cast<std::size_t>(node_count(element.type)));
  block.file_numbers.resize(1);
  const Solid solid(body(mesh, element, unit_material, thickness));
  const Mass consistent = solid.mass(MassKind::consistent), lumped = solid.mass(MassKind::lumped);
  const std::vector<double>& diagonal = consistent.node_diagonal();
  const double scale = consistent.total() / std::accumulate(diagonal.begin(), diagonal.end(), 0.0);
  for (std::size_t n = 0; n < diagonal.size(); ++n)
    EXPECT_NEAR(lumped.node_diagonal()[n], scale * diagonal[n], round_off) << n;
}

// Under gravity every node falls by g t^2 / 2, without stress, which central differences give without error:
// u_(k+1) = 2 u_k - u_(k-1) + h^2 M^-1 (f - F(u_k)).
TEST_P(EveryElement, FallsFreely) {
  const Element& element = GetParam();
  Model model = body(distorted_mesh(element.type), element, unit_material, thickness);
  Vec3 g{0.3, -1.0, 0.5};
  if (element.section == Section::axisymmetric) g[0] = 0.0;  // rings cannot fall outwards
  model.loads.emplace_back(Gravity{g, {}});
  const Solid solid(model);
  const Mass mass = solid.mass(MassKind::lumped);
  const auto bounds = cell_frequency_bounds(solid);
  const double h = 1.0 / std::sqrt(*std::max_element(bounds.begin(), bounds.end()));
  std::vector<double> u(solid.dof_count(), 0.0), before(u.size()), f(u.size());
  for (std::size_t d = 0; d < u.size(); ++d) before[d] = 0.5 * h * h * g[d % 3];  // u(-h)
  constexpr int steps = 20;
  for (int k = 0; k < steps; ++k) {
    solid.loads().force(k * h, mass, f);
    const auto F = internal_force(solid, u);
    for (std::size_t d = 0; d < u.size(); ++d) {
      const double next = 2 * u[d] - before[d] + h * h * (f[d] - F[d]) / mass.node_diagonal()[d / 3];
      before[d] = std::exchange(u[d], next);
    }
  }
  const double t = steps * h, tolerance = steps * steps * round_off * t * t;  // rounding sums twice
  for (std::size_t d = 0; d < u.size(); ++d) EXPECT_NEAR(u[d], 0.5 * g[d % 3] * t * t, tolerance) << d;
}

/// Largest omega^2 of K x = omega^2 M x with the lumped mass by power iteration on M^-1 K (Golub and Van Loan, Matrix
/// Computations, 4th ed., section 8.2): Rayleigh quotients, which grow to it from below.
double largest_frequency_squared(const Solid& solid) {
  const auto m = solid.mass(MassKind::lumped).node_diagonal();
  const std::vector<double> rest(solid.dof_count(), 0.0);
  std::vector<double> x = random_vector(rest.size(), 32), Kx(x.size());
  double value = 0.0;
  for (int k = 0; k < 3000; ++k) {
    double norm = 0.0;
    for (std::size_t d = 0; d < x.size(); ++d) norm += m[d / 3] * x[d] * x[d];
    for (double& entry : x) entry /= std::sqrt(norm);
    solid.tangent_action(rest, x, Kx);
    const double last = std::exchange(value, dot(x, Kx));
    if (value - last < 1e-9 * value && k > 100) return value;
    for (std::size_t d = 0; d < x.size(); ++d) x[d] = Kx[d] / m[d / 3];
  }
  return value;
}

// The bound of the stable step is that of the worst cell alone (Irons): above the body's frequency, and most of what is
// between them is between cell and mesh (solid_tangent.cpp).
TEST_P(EveryElement, CellBoundsAreAboveTheLargestFrequency) {
  const Solid solid(body(distorted_mesh(GetParam().type), GetParam(), unit_material, thickness));
  const auto bounds = cell_frequency_bounds(solid);
  const double exact = largest_frequency_squared(solid), bound = *std::max_element(bounds.begin(), bounds.end());
  EXPECT_GE(bound, exact);
  // A patch has a quarter of its cells' masses, and couples more nodes than a cell; the top of a PYRA13 has little
  // mass.
  const bool is_wide = GetParam().formulation == Formulation::nodal || GetParam().type == CellType::pyra13;
  EXPECT_LE(bound, (is_wide ? 3.5 : 3.0) * exact);
}

// A body that yields has the step of its elasticity.
TEST_P(EveryElement, YieldingLeavesTheStableStep) {
  const Element& element = GetParam();
  const Mesh mesh = distorted_mesh(element.type);
  const auto bounds = cell_frequency_bounds(Solid(body(mesh, element, yielding("j2"))));
  const auto expected = cell_frequency_bounds(Solid(body(mesh, element, unit_material)));
  EXPECT_LT(largest_difference(bounds, expected), round_off * largest(expected));
}

/// An equilibrium without loads (Papkovich and Neuber; Timoshenko and Goodier, Theory of Elasticity, section 88):
/// u = 4 (1 - nu) B e_y - grad(y B) with a harmonic B, in space and for rings 8 y^4 - 24 y^2 s + 3 s^2, s = x^2 + z^2,
/// in the plane x^4 - 6 x^2 y^2 + y^4. Plane stress takes nu / (1 + nu) in place of nu.
Vec3 equilibrium(const Vec3& X, Section section) {
  const bool in_plane = section == Section::plane_strain || section == Section::plane_stress;
  const double nu = section == Section::plane_stress ? unit_material.nu / (1 + unit_material.nu) : unit_material.nu;
  const auto& [x, y, z] = X;
  const double s = x * x + z * z;
  const double B = in_plane ? x * x * (x * x - 6 * y * y) + y * y * y * y : 8 * y * y * (y * y - 3 * s) + 3 * s * s;
  const double by_y = in_plane ? 4 * y * (y * y - 3 * x * x) : 16 * y * (2 * y * y - 3 * s);
  const double by_s = 12 * (s - 4 * y * y);  // twice the derivative by s: grad s = (2 x, 0, 2 z)
  const double by_x = in_plane ? 4 * x * (x * x - 3 * y * y) : by_s * x;
  return {-y * by_x, 4 * (1 - nu) * B - B - y * by_y, in_plane ? 0.0 : -y * by_s * z};
}

/// Mean error, by the lumped mass, of the displacements of the inner nodes of a unit square or cube of smoothly curved
/// lines of n cells with the boundary of `equilibrium`; over the largest displacement.
double displacement_error(const Element& element, int n) {
  const bool in_space = element.section == Section::solid;
  Mesh grid = in_space ? block_mesh({n, n, n}, 0.0) : quad_mesh(n, n, 0.0, 0.0);
  for (Vec3& x : grid.coordinates) x = scaled(x, 1.0 / n);
  Mesh mesh = with_cells(grid, element.type);
  std::vector<double> exact;
  std::vector<bool> held;
  for (Vec3& x : mesh.coordinates) {
    const auto inside = [](double c) { return c > 1e-9 && c < 1.0 - 1e-9; };
    const bool is_inner = inside(x[0]) && inside(x[1]) && (!in_space || inside(x[2]));
    const double bend = 0.05 * std::sin(pi * x[0]) * std::sin(pi * x[1]) * (in_space ? std::sin(pi * x[2]) : 1.0);
    x = {x[0] + bend, x[1] - bend, in_space ? x[2] + bend : 0.0};
    if (element.section == Section::axisymmetric) x[0] += 0.5;
    const Vec3 u = equilibrium(x, element.section);
    for (std::size_t i = 0; i < 3; ++i) {
      exact.push_back(u[i]);
      held.push_back(!is_inner || i >= components(element.section));
    }
  }
  const Solid solid(body(mesh, element, unit_material));
  std::vector<double> boundary(exact);
  for (std::size_t d = 0; d < held.size(); ++d)
    if (!held[d]) boundary[d] = 0.0;
  const auto error = sum(-1.0, exact, relaxed(solid, boundary, held, 1e-10));
  const auto m = solid.mass(MassKind::lumped).node_diagonal();
  double squares = 0.0, mass = 0.0;
  for (std::size_t d = 0; d < error.size(); ++d) {
    if (held[d]) continue;  // the share of the boundary is not the same on all meshes
    squares += m[d / 3] * error[d] * error[d];
    mass += m[d / 3];
  }
  return std::sqrt(squares / mass) / largest(exact);
}

// Displacements of degree p have errors of order p + 1 (Strang and Fix, An Analysis of the Finite Element Method,
// section 1.6), at the nodes of such meshes up to one more. Linear cells and the composite of linear ones: 2; second
// order: 3, and 2 of TRIA6 where one mean dilatation for a cell is all that it knows of its volume.
TEST_P(EveryElement, DisplacementsConvergeWithTheirOrder) {
  const Element& element = GetParam();
  if (element.section == Section::bar) return;  // exact at its nodes, below
  const bool is_quadratic = node_count(element.type) > corner_count(element.type) && element.type != CellType::tetra10;
  const bool has_one_volume = element.dilatation == VolumeField::mean;
  const double order = is_quadratic && !has_one_volume ? 3.0 : 2.0;
  const bool is_nodal = element.formulation == Formulation::nodal;  // whose skin has half patches alone
  const int n = element.section != Section::solid ? 8 : is_quadratic ? 2 : is_nodal ? 6 : 4;
  const double coarse = displacement_error(element, n), fine = displacement_error(element, 2 * n);
  EXPECT_GT(std::log2(coarse / fine), order - 0.2);
}

// A hanging bar: u = rho g (L x - x^2 / 2) / E at the nodes for any number of cells (Strang and Fix, section 1.6).
TEST(Bar, HangsExactlyAtItsNodes) {
  constexpr double g = 0.1, length = 4.0;
  Model model =
      body(mesh_of(CellType::line2, {{0, 0, 0}, {1.0, 0, 0}, {2.5, 0, 0}, {length, 0, 0}}, {0, 1, 1, 2, 2, 3}),
           Section::bar, unit_material, 0.5);
  model.loads.emplace_back(Gravity{{g, 0.0, 0.0}, {}});
  const Solid solid(model);
  std::vector<double> f(solid.dof_count());
  solid.loads().force(0.0, solid.mass(MassKind::lumped), f);
  std::vector<bool> held(f.size(), true);
  for (std::size_t n = 1; n < 4; ++n) held[3 * n] = false;
  const auto u = solve(solid, f, held);
  for (std::size_t n = 0; n < 4; ++n) {
    const double x = model.mesh->coordinates[n][0];
    EXPECT_NEAR(u[3 * n], unit_material.rho * g * (length * x - 0.5 * x * x) / unit_material.E, round_off);
  }
}

}  // namespace
}  // namespace carom::test::solid_elements_test
