// The bound of the frequency of contact springs on the masses of their nodes.
#include "enforcement/contact_frequency.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/largest_eigenvalue.hpp"
#include "schemes_fixture.hpp"
#include "solid_bodies.hpp"

namespace carom::schemes_contact_frequency_test {
namespace {

using namespace test;

struct Faces {
  int below = 1, above = 1;  ///< divisions across
  double tilt = 0.0;         ///< slope of the upper block
  double mu = 0.0;
  double shift = 0.0;  ///< of the upper block along x
};

/// A block of 3 x 3 x 2 under one of 2 x 2 x 2 with a gap of 0.1, in two passes; eps = 8.
Model two_blocks(const Faces& faces) {
  StructuredBlock lower, upper;
  lower.size = {3, 3, 2};
  upper.size = {2, 2, 2};
  lower.divisions = {faces.below, faces.below, 2};
  upper.divisions = {faces.above, faces.above, 2};
  upper.origin = {0.5 + faces.shift, 0.5, 2.1};
  lower.face_groups = {"MASTER", "MASTER", "MASTER", "MASTER", "MASTER", "MASTER"};
  upper.face_groups = {"SLAVE", "SLAVE", "SLAVE", "SLAVE", "SLAVE", "SLAVE"};
  Mesh mesh = make_structured_blocks({lower, upper});
  for (Vec3& x : mesh.coordinates)
    if (x[2] > 2.05) x[2] += faces.tilt * (x[0] - 0.5);
  Model model = one_part(std::move(mesh));
  PairContact pair;
  pair.name = "pair";
  pair.slave.facets = faces_of(*model.mesh, "SLAVE");
  pair.master.facets = faces_of(*model.mesh, "MASTER");
  pair.method = PairMethod::two_pass;
  pair.law.eps_N = pair.law.eps_T = 8.0;
  pair.law.mu = faces.mu;
  model.contacts.emplace_back(pair);
  return model;
}

/// Largest eigenvalue of M^-1 G^T D G.
double eigenvalue(const Problem& p, const ConstraintRows& rows) {
  const std::vector<double>& m = p.mass.node_diagonal();
  const LinearOperator springs = [&](std::span<const double> x, std::span<double> y) {
    std::vector<double> scaled(x.begin(), x.end());
    for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] /= std::sqrt(m[i / 3]);
    std::fill(y.begin(), y.end(), 0.0);
    add_closed_stiffness(rows, scaled, y);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] /= std::sqrt(m[i / 3]);
  };
  return largest_eigenvalue(springs, p.solid.dof_count(), 1e-6).upper;
}

double bound(const Problem& p) {
  const std::vector<double> zero(p.solid.dof_count(), 0.0);
  return contact_frequency_bound(p.system, *p.rows(), zero);
}

// Two cubes of one cell face to face: each node has eps A / 4 against two masses of 1/8 of a cell.
TEST(ContactFrequency, IsExactWhereNodesMeet) {
  Model model = two_blocks({});
  StructuredBlock lower, upper;
  lower.size = upper.size = {1, 1, 1};
  upper.origin = {0, 0, 1.1};
  lower.face_groups = {"", "", "", "", "", "MASTER"};
  upper.face_groups = {"", "", "", "", "SLAVE", ""};
  PairContact pair = std::get<PairContact>(model.contacts[0]);
  model = one_part(make_structured_blocks({lower, upper}));
  pair.slave.facets = faces_of(*model.mesh, "SLAVE");
  pair.master.facets = faces_of(*model.mesh, "MASTER");
  model.contacts.emplace_back(pair);
  const Problem p(std::move(model), MassKind::lumped);
  const double m = unit_material.rho / 8.0, exact = 8.0 / 4.0 * (2.0 / m);
  EXPECT_NEAR(bound(p), exact, 1e-9 * exact);
  EXPECT_NEAR(eigenvalue(p, *p.rows()), exact, 1e-5 * exact);
}

// Never below the eigenvalue; above it by the cosines of rows of different faces at an edge, which it takes for 1: at
// most twice where two faces meet.
TEST(ContactFrequency, BoundsTheEigenvalueClosely) {
  for (const Faces& faces :
       {Faces{2, 3}, Faces{1, 4}, Faces{5, 2}, Faces{3, 2, 0.02}, Faces{3, 2, 0.0, 0.3}, Faces{4, 3, 0.02, 0.3, 0.7}}) {
    const Problem p(two_blocks(faces), MassKind::lumped);
    const std::vector<double> zero(p.solid.dof_count(), 0.0);
    const double exact = eigenvalue(p, as_they_close(*p.rows(), zero));
    EXPECT_GE(bound(p), exact * (1.0 - 1e-6)) << faces.below << " " << faces.above;
    EXPECT_LE(bound(p), exact * 2.0) << faces.below << " " << faces.above;
  }
}

// Blocks that stand askew have rows beside their edges, open and far from touching, whose tangents turn with facets
// they stand beside. They must not count for more than when they close: with the same stiffness along and across,
// friction leaves the frequency of the springs as it is, and a tilt that of all.
TEST(ContactFrequency, IsNotRaisedByFrictionOfOpenRows) {
  const Problem straight(two_blocks({3, 2, 0.0, 0.3, 0.9}), MassKind::lumped);
  for (const double tilt : {0.0, 0.02, 0.1}) {
    const Problem smooth(two_blocks({3, 2, tilt, 0.0, 0.9}), MassKind::lumped),
        rough(two_blocks({3, 2, tilt, 0.3, 0.9}), MassKind::lumped);
    EXPECT_LE(bound(rough), 1.05 * bound(smooth)) << tilt;
    EXPECT_NEAR(stable_step(rough.system).dt, stable_step(straight.system).dt, 0.05 * stable_step(straight.system).dt)
        << tilt;
    EXPECT_GT(eigenvalue(rough, *rough.rows()), 1.5 * bound(smooth)) << tilt;  // as the rows stand
  }
}

// The gap of a face that has just come in from the side, deep at once, is the root of an energy that grows with the way
// itself: its gradient is without bound, the stiffness is not. A gradient of 4 counts whole, and more of it as that.
TEST(ContactFrequency, IsBoundedWhereAGapBeginsAsARoot) {
  const Problem p(two_blocks({}), MassKind::lumped);
  const Index node = 0;
  const auto bound_of = [&](double gradient) {
    ConstraintRows rows;
    RowLaw law;
    law.eps_N = 8.0;
    rows.add_row(-1e-9, {0, 0, 1}, {}, 1.0, law, 0);
    rows.add_node(node, gradient);
    return contact_frequency_bound(p.system, rows, std::vector<double>(p.solid.dof_count(), 0.0));
  };
  const double of_one = 8.0 / p.mass.node_diagonal()[node];
  EXPECT_NEAR(bound_of(1.0), of_one, 1e-12 * of_one);
  EXPECT_NEAR(bound_of(4.0), 16.0 * of_one, 1e-11 * of_one);
  EXPECT_NEAR(bound_of(1e5), 16.0 * of_one, 1e-11 * of_one);
}

// Elastic bodies of every shape, deformed at random, crushed to half their height and stretched: the frequency
// followed is not below that of the tangent there by more than what a run keeps from its stable step (safety 0.9), and
// not twice it.
TEST(StableStepWatch, FollowsElasticBodies) {
  for (const CellType type : {CellType::hexa8, CellType::tetra4, CellType::tetra10, CellType::penta6, CellType::hexa20})
    for (const Material& material : {Material(NeoHookean{unit_material}), Material(StVenantKirchhoff{unit_material})})
      for (const int way : {0, 1, 2}) {
        const Element& element = *find_element(type, Section::solid, {});
        const Problem p(body(with_cells(block_mesh({2, 2, 2}, 0.1), type), element, material), MassKind::lumped);
        std::vector<double> u =
            affine(*p.model.mesh, {Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, way == 1 ? -0.5 : 0.3}});
        if (way == 0) u = random_vector(u.size(), 7);
        for (double& entry : u) entry *= way == 0 ? 0.02 : 1.0;
        const Pencil pencil{[&](auto x, auto y) { p.solid.tangent_action(u, x, y); },
                            [&](auto x, auto y) { p.mass.apply(x, y); },
                            [&](auto x, auto y) {
                              for (std::size_t i = 0; i < x.size(); ++i) y[i] = x[i] / p.mass.node_diagonal()[i / 3];
                            }};
        const double wanted = largest_eigenvalue(pencil, u.size(), 1e-6).value;
        StableStepWatch watch(RestFrequencies(p.system), 2.0, EnforcementKind::lagrange);
        watch.follow_bodies(state_at(u));
        const double followed = watch.with({}, u).omega_max_squared_free;
        EXPECT_GT(followed, 0.81 * wanted) << name(type) << " " << material.law->name << way;
        if (way == 1 && material.law->name == "st_venant_kirchhoff") continue;  // softens there, past its limit point
        EXPECT_LT(followed, (material.law->name == "neo_hookean" ? 2.0 : 4.0) * wanted)
            << name(type) << " " << material.law->name << way;
      }
}

// Crushed by a volume-preserving plastic flow, a body that yields may unload at any moment: the limit is that of an
// elastic body of the same mass in the new shape, not that of the yielding tangent. One length per cell stands for its
// three, so that cubes that are flattened are taken to be stiffer by up to the root of 3.
TEST(StableStepWatch, TakesBodiesThatYieldAsElasticInTheirNewShape) {
  Model model = one_part(block_mesh({3, 3, 3}, 0.1));
  model.parts[0].material = Material("j2", 1.5, {{"E", 2.0}, {"nu", 0.3}, {"yield_stress", 1e-3}});
  const Problem p(model, MassKind::lumped);
  const double at_rest = stable_step(p.system, 2.0, EnforcementKind::lagrange).dt;
  for (const double height : {1.0, 0.6, 0.3}) {
    const double width = 1.0 / std::sqrt(height);
    const std::vector<double> u =
        affine(*p.model.mesh, {Vec3{width - 1.0, 0, 0}, Vec3{0, width - 1.0, 0}, Vec3{0, 0, height - 1.0}});
    Mesh crushed = *p.model.mesh;
    for (std::size_t n = 0; n < crushed.node_count(); ++n)
      for (std::size_t c = 0; c < 3; ++c) crushed.coordinates[n][c] += u[3 * n + c];
    const Problem elastic(one_part(std::move(crushed)), MassKind::lumped);
    const double wanted = stable_step(elastic.system, 2.0, EnforcementKind::lagrange).dt;
    StableStepWatch watch(RestFrequencies(p.system), 2.0, EnforcementKind::lagrange);
    watch.follow_bodies(state_at(u));
    const double dt = watch.with({}, u).dt;
    EXPECT_LE(dt, 1.02 * wanted) << height;  // stable_step and cell bounds differ by a percent or so
    EXPECT_GE(dt, wanted / std::sqrt(3.0)) << height;
    EXPECT_LT(height == 1.0 ? 0.0 : dt, at_rest);
  }
}

}  // namespace
}  // namespace carom::schemes_contact_frequency_test
