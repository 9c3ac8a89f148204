// Masses, volumes and external forces of the HEXA8 solid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>

#include "base/errors.hpp"
#include "cell_meshes.hpp"
#include "math/vec3.hpp"
#include "mesh/structured_block.hpp"
#include "solid/loads.hpp"
#include "solid/modified_mass.hpp"
#include "solid_fixture.hpp"

namespace carom::test::solid_mass_and_loads_test {
namespace {

constexpr double round_off = 1e-12;  // sums of some hundred terms below 10, 2^-53 each, with a margin of 10

double volume_of(const std::array<int, 3>& divisions) {
  return static_cast<double>(divisions[0] * divisions[1] * divisions[2]);
}

TEST(SolidMass, TotalIsDensityTimesVolumeOnADistortedMesh) {
  const std::array<int, 3> divisions{3, 4, 3};
  const Solid solid(one_part(block_mesh(divisions, 0.2)));
  const double expected = unit_material.rho * volume_of(divisions);
  EXPECT_NEAR(solid.mass(MassKind::consistent).total(), expected, expected * round_off);
  EXPECT_NEAR(solid.mass(MassKind::lumped).total(), expected, expected * round_off);
  const auto& volumes = solid.cells().volumes;
  EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), volume_of(divisions), expected * round_off);
}

// Unit cube: M_ab = rho / 216 x (8, 4, 2, 1) for nodes that share all, two, one or no coordinate (Zienkiewicz, Taylor
// and Zhu, The Finite Element Method: products of the 1-D matrix (2 1; 1 2) / 6); lumped by symmetry rho / 8.
TEST(SolidMass, OfTheUnitCube) {
  const Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  const Solid solid(model);
  const CsrMatrix M = solid.mass(MassKind::consistent).node_matrix();
  ASSERT_EQ(M.column.size(), 64U);
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t b = 0; b < 8; ++b) {
      double expected = unit_material.rho;
      for (std::size_t i = 0; i < 3; ++i)
        expected *= model.mesh->coordinates[a][i] == model.mesh->coordinates[b][i] ? 2.0 / 6.0 : 1.0 / 6.0;
      EXPECT_NEAR(M.value[8 * a + b], expected, round_off);
    }
  const Mass lumped = solid.mass(MassKind::lumped);
  for (const double m : lumped.node_diagonal()) EXPECT_NEAR(m, unit_material.rho / 8, round_off);
  EXPECT_NEAR(solid.cells().lengths[0], 1.0, round_off);
}

// integral of rho v . v for a linear field v_z = x over the block [0,3]x[0,4]x[0,3]: rho 9 x 12 = 108 rho, exact for
// the consistent mass on distorted cells because the trilinear map reproduces linear fields.
TEST(SolidMass, ConsistentMassIntegratesLinearFieldsExactly) {
  const Model model = one_part(block_mesh({3, 4, 3}, 0.2));
  const Solid solid(model);
  const auto v = affine(*model.mesh, {{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}});
  std::vector<double> Mv(v.size());
  solid.mass(MassKind::consistent).apply(v, Mv);
  EXPECT_NEAR(std::inner_product(v.begin(), v.end(), Mv.begin(), 0.0), 108.0 * unit_material.rho, 1000 * round_off);
}

TEST(SolidMass, NodesOutsideThePartsHaveNone) {
  Model model = one_part(block_mesh({2, 1, 1}, 0.0));
  model.parts[0].cells = {0};
  const Solid solid(model);
  const std::vector<double> nodes = solid.mass(MassKind::consistent).node_diagonal();
  EXPECT_EQ(std::count(nodes.begin(), nodes.end(), 0.0), 4);
  EXPECT_EQ(solid.cells().size(), 1U);
}

std::array<Vec3, 2> resultant_and_moment(const Mesh& mesh, const std::vector<double>& f) {
  Vec3 force{}, moment{};
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      force[i] += f[3 * n + i];
      moment[i] += mesh.coordinates[n][j] * f[3 * n + k] - mesh.coordinates[n][k] * f[3 * n + j];
    }
  return {force, moment};
}

std::vector<Facet> faces_of(const Mesh& mesh, const std::string& group) {
  const CellBlock& quads = *mesh.block(CellType::quad4);
  std::vector<Facet> faces;
  for (const CellRef& ref : mesh.cell_groups.at(group)) {
    Facet face{{}, 4};
    for (std::size_t a = 0; a < 4; ++a) face.node[a] = quads.connectivity[4 * static_cast<std::size_t>(ref.cell) + a];
    faces.push_back(face);
  }
  return faces;
}

// Statics: pressure p on the plane face z = 3 of area 6 at centroid (1, 1.5): force -6 p in z, moment r x F.
TEST(SolidLoads, PressureHasItsResultantAndMoment) {
  Model model = one_part(block_mesh({2, 3, 3}, 0.0));
  model.loads.emplace_back(Pressure{{faces_of(*model.mesh, "ZMAX")}, 0.5, TimeFunction{{0.0, 1.0}, {0.0, 2.0}}});
  const Solid solid(model);
  std::vector<double> f(solid.dof_count(), 7.0);
  solid.loads().force(0.5, solid.mass(MassKind::lumped), f);
  const auto [force, moment] = resultant_and_moment(*model.mesh, f);
  const Vec3 expected{0.0, 0.0, -3.0}, expected_moment{1.5 * -3.0, 1.0 * 3.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(force[i], expected[i], round_off);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(moment[i], expected_moment[i], round_off);
  solid.loads().force(0.0, solid.mass(MassKind::lumped), f);
  EXPECT_EQ(largest(f), 0.0);
}

// The same on triangles of a body of pentahedra with flat and of tetrahedra with flat and warped faces: nodal forces
// are a third of each triangle's, and closed skins have no resultant and no moment.
TEST(SolidLoads, PressureOnTrianglesAndOnClosedSkinsOfAnyCells) {
  const double p = 2.5;
  for (const CellType type : {CellType::tetra4, CellType::penta6, CellType::pyra5, CellType::tetra10}) {
    StructuredBlock block;
    block.size = {2, 3, 3};
    block.divisions = {2, 3, 3};
    Mesh mesh = with_cells(make_structured_blocks({block}), type);
    for (Vec3& x : mesh.coordinates) x[0] += 0.05 * std::sin(2.0 * x[1] + x[2]);
    Model model;
    model.mesh = std::make_shared<const Mesh>(mesh);
    Pressure top, all;
    top.pressure = all.pressure = p;
    for (const Facet& facet : skin(mesh)) {
      all.surface.facets.push_back(facet);
      if (std::all_of(facet.begin(), facet.end(),
                      [&](Index n) { return mesh.coordinates[static_cast<std::size_t>(n)][2] > 3.0 - 1e-9; }))
        top.surface.facets.push_back(facet);
    }
    model.loads = {top, all};
    const std::vector<LoadVector> loads = make_loads(model);
    const auto resultant = [&](const LoadVector& load) {
      std::array<Vec3, 2> sum{};  // force and moment
      for (std::size_t i = 0; i < load.nodes.size(); ++i) {
        sum[0] = add(sum[0], load.force[i]);
        sum[1] = add(sum[1], cross(mesh.coordinates[static_cast<std::size_t>(load.nodes[i])], load.force[i]));
      }
      return sum;
    };
    EXPECT_LT(norm(resultant(loads[1])[0]), 100.0 * round_off) << name(type);
    EXPECT_LT(norm(resultant(loads[1])[1]), 100.0 * round_off) << name(type);
    double area = 0.0;
    for (const Facet& facet : top.surface.facets) {
      const auto x = [&](std::size_t a) { return mesh.coordinates[static_cast<std::size_t>(facet[a])]; };
      area += facet.size == 3 ? 0.5 * norm(cross(subtract(x(1), x(0)), subtract(x(2), x(0))))
                              : 0.5 * norm(cross(subtract(x(2), x(0)), subtract(x(3), x(1))));
    }
    EXPECT_NEAR(resultant(loads[0])[0][2], -p * area, 100.0 * round_off) << name(type);
    for (const Vec3& force : loads[0].force) EXPECT_LT(force[2], 0.0) << name(type);
  }
}

/// Forces of a pressure of -1 on the facets, by node.
std::vector<Vec3> forces_of_suction(const Mesh& mesh, const std::vector<Facet>& facets, Section section) {
  Model model;
  model.mesh = std::make_shared<const Mesh>(mesh);
  model.loads.emplace_back(Pressure{{facets, section, 1.0}, -1.0, {}});
  std::vector<Vec3> force(mesh.node_count());
  const LoadVector load = make_loads(model).front();
  for (std::size_t i = 0; i < load.nodes.size(); ++i) force[static_cast<std::size_t>(load.nodes[i])] = load.force[i];
  return force;
}

// Consistent with quadratic shape functions: of the area of a QUAD8 -1/12 at corners and 1/3 at middles, of a QUAD9
// 1/36, 1/9 and 4/9 (Simpson), of a LINE3 1/6 and 2/3 (Zienkiewicz, Taylor, Zhu, The Finite Element Method).
TEST(SolidLoads, PressureOnQuadraticFacesIsConsistent) {
  StructuredBlock cube, square;
  square.kind = StructuredBlock::Kind::quad;
  cube.size = square.size = {1, 1, 1};
  const std::map<CellType, std::array<double, 3>> share{{CellType::hexa20, {-1.0 / 12.0, 1.0 / 3.0, 0.0}},
                                                        {CellType::hexa27, {1.0 / 36.0, 1.0 / 9.0, 4.0 / 9.0}},
                                                        {CellType::quad8, {1.0 / 6.0, 2.0 / 3.0, 0.0}}};
  for (const auto& [type, expected] : share) {
    const bool is_plane = dimension(type) == 2;
    const Mesh mesh = with_cells(make_structured_blocks({is_plane ? square : cube}), type);
    const std::size_t up = is_plane ? 1 : 2;
    std::vector<Facet> top;
    for (const Facet& facet : skin(mesh))
      if (std::all_of(facet.begin(), facet.end(),
                      [&](Index n) { return mesh.coordinates[static_cast<std::size_t>(n)][up] > 1.0 - 1e-9; }))
        top.push_back(facet);
    const Section section = is_plane ? Section::plane_strain : Section::solid;
    const std::vector<Vec3> force = forces_of_suction(mesh, top, section);
    std::vector<Index> all(mesh.node_count());
    std::iota(all.begin(), all.end(), Index{0});
    const std::vector<double> shares = area_shares(mesh, {top, section, 1.0}, all);  // of a total force: likewise
    for (std::size_t n = 0; n < force.size(); ++n) {
      const Vec3& x = mesh.coordinates[n];
      if (x[up] < 1.0 - 1e-9) continue;
      std::size_t middles = 0;
      for (std::size_t c = 0; c < up; ++c) middles += std::abs(x[c] - 0.5) < 1e-9 ? 1 : 0;
      EXPECT_NEAR(force[n][up], expected[middles], round_off) << name(type);
      EXPECT_NEAR(shares[n], expected[middles], round_off) << name(type);
    }
  }
}

// Curved faces too: a pressure on a closed skin has no resultant and no moment, and 2 pi x about an axis is exact.
TEST(SolidLoads, PressureOnCurvedSkinsVanishes) {
  for (const CellType type : {CellType::hexa20, CellType::hexa27, CellType::penta15}) {
    Mesh mesh = with_cells(block_mesh({2, 2, 2}, 0.0), type);
    const auto moves = random_vector(3 * mesh.node_count(), 9);
    for (std::size_t d = 0; d < moves.size(); ++d) mesh.coordinates[d / 3][d % 3] += 0.1 * moves[d];
    const std::vector<Vec3> force = forces_of_suction(mesh, skin(mesh), Section::solid);
    Vec3 sum{}, moment{};
    for (std::size_t n = 0; n < force.size(); ++n) {
      sum = add(sum, force[n]);
      moment = add(moment, cross(mesh.coordinates[n], force[n]));
    }
    EXPECT_LT(norm(sum), round_off) << name(type);
    EXPECT_LT(norm(moment), round_off) << name(type);
  }
  StructuredBlock ring;
  ring.kind = StructuredBlock::Kind::quad;
  ring.origin = {1, 0, 0};
  ring.size = {2, 3, 0};
  const Mesh mesh = with_cells(make_structured_blocks({ring}), CellType::quad8);
  std::vector<Facet> top;
  for (const Facet& facet : skin(mesh))
    if (mesh.coordinates[static_cast<std::size_t>(facet[0])][1] > 2.9 &&
        mesh.coordinates[static_cast<std::size_t>(facet[1])][1] > 2.9)
      top.push_back(facet);
  double total = 0.0;
  for (const Vec3& force : forces_of_suction(mesh, top, Section::axisymmetric)) total += force[1];
  EXPECT_NEAR(total, std::numbers::pi * 8.0, 10.0 * round_off);  // the ring from radius 1 to 3
}

// Gauss' theorem: a uniform pressure on a closed skin has no resultant and no moment, warped faces included.
TEST(SolidLoads, PressureOnAClosedWarpedSkinVanishes) {
  Mesh mesh = block_mesh({2, 2, 2}, 0.0);
  const auto moves = random_vector(3 * mesh.node_count(), 9);
  for (std::size_t d = 0; d < moves.size(); ++d) mesh.coordinates[d / 3][d % 3] += 0.15 * moves[d];
  Model model = one_part(std::move(mesh));
  std::vector<Facet> faces;
  for (const char* side : {"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"})
    for (const auto& face : faces_of(*model.mesh, side)) faces.push_back(face);
  model.loads.emplace_back(Pressure{{faces}, 1.0, {}});
  const Solid solid(model);
  std::vector<double> f(solid.dof_count());
  solid.loads().force(0.0, solid.mass(MassKind::lumped), f);
  EXPECT_GT(largest(f), 0.1);
  const auto [force, moment] = resultant_and_moment(*model.mesh, f);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(force[i], 0.0, round_off);
}

TEST(SolidLoads, GravityIsTheWeightAtTheCentroid) {
  Model model = one_part(block_mesh({3, 4, 3}, 0.2));
  const Vec3 g{0.5, -1.0, 2.0};
  model.loads.emplace_back(Gravity{g, {}});
  const Solid solid(model);
  std::vector<double> f(solid.dof_count());
  solid.loads().force(1.0, solid.mass(MassKind::consistent), f);
  const auto [force, moment] = resultant_and_moment(*model.mesh, f);
  const double m = 36.0 * unit_material.rho;  // block 3 x 4 x 3 with its centroid at (1.5, 2, 1.5)
  const Vec3 expected_moment{m * (2.0 * g[2] - 1.5 * g[1]), m * (1.5 * g[0] - 1.5 * g[2]),
                             m * (1.5 * g[1] - 2.0 * g[0])};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(force[i], m * g[i], m * 10 * round_off);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(moment[i], expected_moment[i], m * 10 * round_off);
}

TEST(SolidLoads, GravityAcceleratesEveryNodeOfADistortedBodyByG) {
  Model model = one_part(block_mesh({2, 2, 2}, 0.3));
  const Vec3 g{0.5, -1.0, 2.0};
  model.loads.emplace_back(Gravity{g, {}});
  const Solid solid(model);
  std::vector<double> f(solid.dof_count()), a(solid.dof_count()), Ma(solid.dof_count());
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = g[i % 3];
  for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) {
    const Mass mass = solid.mass(kind);
    solid.loads().force(0.0, mass, f);
    mass.apply(a, Ma);
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], Ma[i], 100 * round_off);
  }
}

TEST(SolidLoads, NodalForcesAddUpAndFollowTheirFactor) {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  EXPECT_FALSE(!Solid(model).loads().empty());
  model.loads.emplace_back(NodalForce{{0, 3}, {1.0, 2.0, 3.0}, TimeFunction{{0.0, 2.0}, {1.0, 3.0}}});
  model.loads.emplace_back(NodalForce{{3}, {0.0, 0.0, 1.0}, {}});
  const Solid solid(model);
  EXPECT_TRUE(!solid.loads().empty());
  std::vector<double> f(24), expected(24, 0.0);
  solid.loads().force(1.0, solid.mass(MassKind::lumped), f);
  expected[0] = 2.0, expected[1] = 4.0, expected[2] = 6.0;
  expected[9] = 2.0, expected[10] = 4.0, expected[11] = 7.0;
  EXPECT_EQ(f, expected);
}

std::string message_of(const Model& model) {
  try {
    const Solid solid(model);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SolidErrors, NameThePartTheCellAndTheRemedy) {
  Model twice = one_part(block_mesh({2, 1, 1}, 0.0));
  twice.parts.push_back({.name = "again", .cells = {1}, .material = unit_material});
  EXPECT_NE(message_of(twice).find("cell 2, which is in parts.body already"), std::string::npos) << message_of(twice);
  Model beyond = one_part(block_mesh({2, 1, 1}, 0.0));
  beyond.parts[0].cells.push_back(2);
  EXPECT_NE(message_of(beyond).find("one of the 2 HEXA8 cells"), std::string::npos) << message_of(beyond);
  Mesh flat = block_mesh({1, 1, 1}, 0.0);
  for (Vec3& x : flat.coordinates) x[2] = 0.0;
  EXPECT_NE(message_of(one_part(std::move(flat))).find("Jacobian determinant 0 in cell 1"), std::string::npos);
}

class IsaVariable : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* value = std::getenv("CAROM_ISA")) before_ = value;
  }
  void TearDown() override { setenv("CAROM_ISA", before_.c_str(), 1); }
  static std::string message(const char* value) {
    setenv("CAROM_ISA", value, 1);
    try {
      return std::string(name(chosen_isa()));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

 private:
  std::string before_;
};

TEST_F(IsaVariable, ForcesAnInstructionSetOrSaysWhyNot) {
  EXPECT_EQ(message("reference"), "reference");
  for (const Isa isa : available_isas()) EXPECT_EQ(message(std::string(name(isa)).c_str()), name(isa));
  EXPECT_EQ(message(""), name(available_isas().back()));
  EXPECT_NE(message("avx9").find("CAROM_ISA=avx9: no such instruction set; expected reference, v2, v3 or v4"),
            std::string::npos);
  if (supported(Isa::x86_64_v4)) return;
  EXPECT_NE(message("v4").find("this processor lacks x86-64-v4; the best it has is"), std::string::npos);
}

// Products of shape functions of second order are negative for some pairs of nodes, and those of TETRA10 in parts are 0
// for some: the mass goes inwards all the same, and nothing inside loses any.
TEST(ModifiedMass, GoesInwardsWhateverTheCells) {
  for (const CellType type : {CellType::tetra4, CellType::tetra10, CellType::penta6, CellType::pyra5, CellType::hexa8,
                              CellType::hexa20, CellType::hexa27, CellType::penta15, CellType::pyra13}) {
    Model model;
    model.mesh = std::make_shared<const Mesh>(with_cells(block_mesh({3, 3, 3}, 0.0), type));
    Part part{.name = "body", .cells = {}, .material = unit_material, .type = type};
    part.cells.resize(model.mesh->block(type)->size());
    std::iota(part.cells.begin(), part.cells.end(), Index{0});
    model.parts.push_back(std::move(part));
    ObstacleContact plane;
    plane.shape = Plane{{0, 0, -0.1}, {0, 0, 1}};
    plane.measure = RowMeasure::per_node;
    for (Index n = 0; n < static_cast<Index>(model.mesh->node_count()); ++n)
      if (const Vec3& x = model.mesh->coordinates[static_cast<std::size_t>(n)];
          std::any_of(x.begin(), x.end(), [](double c) { return c < 1e-9 || c > 3.0 - 1e-9; }))
        plane.nodes.push_back(n);
    model.contacts.emplace_back(plane);
    const MassShift shift = modify_mass(Solid(model), model, {}).shift;
    EXPECT_NEAR(shift.total_error, 0.0, 1e-13 * shift.total) << static_cast<int>(type);
    EXPECT_LE(shift.largest_loss, 0.0) << static_cast<int>(type);
    EXPECT_LT(norm(shift.centre), 0.1) << static_cast<int>(type);  // cells are cut alike everywhere, not by mirrors
  }
}

}  // namespace
}  // namespace carom::test::solid_mass_and_loads_test
