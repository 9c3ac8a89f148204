// The stiffness of contact that is chosen where none is given, against M / h by hand.
#include "contact/stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "contact_fixture.hpp"
#include "mesh/mesh.hpp"
#include "mesh/skin.hpp"
#include "mesh/structured_block.hpp"

namespace carom::contact_stiffness_test {
namespace {

constexpr double round_off = 1e-14;  // relative: a few products and sums of equal numbers

const LinearElastic soft{{.E = 2.0, .nu = 0.3, .rho = 1.0}};

void expect_relative(const std::optional<double>& value, double expected) {
  ASSERT_TRUE(value);
  EXPECT_NEAR(*value / expected, 1.0, round_off);
}

/// Facets of a cell group of the mesh.
std::vector<Facet> facets_of(const Mesh& mesh, const std::string& group) {
  std::vector<Facet> facets;
  for (const CellRef& ref : mesh.cell_groups.at(group)) {
    const CellBlock& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
    Facet facet{{}, node_count(block.type)};
    for (int a = 0; a < facet.size; ++a)
      facet.node[static_cast<std::size_t>(a)] = block.connectivity[static_cast<std::size_t>(facet.size * ref.cell + a)];
    facets.push_back(facet);
  }
  return facets;
}

Part part_of(const Mesh& mesh, const std::string& group, CellType type, Section section, const Material& material,
             double thickness = 1.0) {
  Part part{.name = group, .cells = {}, .material = material, .type = type, .section = section, .thickness = thickness};
  for (const CellRef& ref : mesh.cell_groups.at(group)) part.cells.push_back(ref.cell);
  return part;
}

/// Two blocks of HEXA8, one on the other with a gap: 3 x 2 x 4 and 2 x 2 x 8 cells of heights 0.5 and 0.125.
Model two_blocks(double unit_length = 1.0, double unit_stress = 1.0, double ratio = 10.0) {
  StructuredBlock lower, upper;
  const double l = unit_length;
  lower.size = {3.0 * l, 2.0 * l, 2.0 * l};
  lower.divisions = {3, 2, 4};
  lower.cells_group = "LOWER";
  lower.face_groups = {"", "", "", "", "", "TOP"};
  upper.origin = {0.0, 0.0, 2.1 * l};
  upper.size = {3.0 * l, 2.0 * l, 1.0 * l};
  upper.divisions = {2, 2, 8};
  upper.cells_group = "UPPER";
  upper.face_groups = {"", "", "", "", "BOTTOM", ""};
  Model model;
  model.mesh = std::make_shared<const Mesh>(make_structured_blocks({lower, upper}));
  LinearElastic material = soft;
  material.E *= unit_stress;
  model.parts.push_back(part_of(*model.mesh, "LOWER", CellType::hexa8, Section::solid, material));
  StVenantKirchhoff stiff{material};
  stiff.E *= ratio;
  model.parts.push_back(part_of(*model.mesh, "UPPER", CellType::hexa8, Section::solid, stiff));
  return model;
}

PairContact pair_of(const Mesh& mesh, const ContactLaw& law = {}) {
  PairContact pair;
  pair.name = "pair";
  pair.slave.facets = facets_of(mesh, "BOTTOM");
  pair.master.facets = facets_of(mesh, "TOP");
  pair.law = law;
  return pair;
}

ObstacleContact floor_under(const std::vector<Facet>& facets, const ContactLaw& law = {}) {
  ObstacleContact floor;
  floor.name = "floor";
  floor.shape = Plane{};
  floor.surface.facets = facets;
  floor.law = law;
  return floor;
}

TEST(Stiffness, AgainstAnObstacleIsTheModulusOverTheHeightOfTheCells) {
  Model model = two_blocks();
  model.contacts.emplace_back(floor_under(facets_of(*model.mesh, "TOP")));
  const auto notes = choose_stiffness(model);
  expect_relative(std::get<ObstacleContact>(model.contacts[0]).law.eps_N, soft.p_wave_modulus() / 0.5);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "contact \"floor\": stiffness 5.385 chosen from modulus 2.692 over cell height 0.5");
}

// The smallest cells at the contact are 0.125 high and the upper block is of finite strain.
TEST(Stiffness, HardensBelowThreeQuartersOfAPercentOfTheSmallestCellWhereItIsChosen) {
  Model model = two_blocks();
  ContactLaw given;
  given.eps_N = 7.0;
  model.contacts.emplace_back(pair_of(*model.mesh));
  model.contacts.emplace_back(pair_of(*model.mesh, given));
  choose_stiffness(model);
  expect_relative(std::get<PairContact>(model.contacts[0]).law.linear_depth, 0.0075 * 0.125);
  EXPECT_TRUE(std::isinf(std::get<PairContact>(model.contacts[1]).law.linear_depth));
  Model small_strain = two_blocks();
  small_strain.parts.pop_back();
  small_strain.contacts.emplace_back(floor_under(facets_of(*small_strain.mesh, "TOP")));
  choose_stiffness(small_strain);
  EXPECT_TRUE(std::isinf(std::get<ObstacleContact>(small_strain.contacts[0]).law.linear_depth));
}

TEST(Stiffness, OfAPairIsTheModuliInSeriesOverTheFinerCellWhicheverSideIsTheSlave) {
  Model model = two_blocks();
  model.contacts.emplace_back(pair_of(*model.mesh));
  PairContact turned = pair_of(*model.mesh);
  std::swap(turned.slave, turned.master);
  model.contacts.emplace_back(turned);
  choose_stiffness(model);
  const double M = soft.p_wave_modulus(), expected = 2.0 / (1.0 / M + 1.0 / (10.0 * M)) / 0.125;
  expect_relative(std::get<PairContact>(model.contacts[0]).law.eps_N, expected);
  expect_relative(std::get<PairContact>(model.contacts[1]).law.eps_N, expected);
}

TEST(Stiffness, KeepsThePenetrationSmallForAnyRatioOfStiffnessAndSize) {
  // Penetration p / eps_N over the height of the finer cell, in units of p / E of the softer body: at most that of
  // equal bodies, p / M = 0.743 p / E (nu = 0.3).
  for (const double ratio : {1e-3, 1.0, 1e3}) {
    Model model = two_blocks(1.0, 1.0, ratio);
    model.contacts.emplace_back(pair_of(*model.mesh));
    choose_stiffness(model);
    const double softer = soft.E * std::min(1.0, ratio);
    EXPECT_LE(softer / (*std::get<PairContact>(model.contacts[0]).law.eps_N * 0.125), 0.75);
  }
}

// Cells of the lower block are 1 x 1 x 0.5, of the upper one 1.5 x 1 x 0.125: sides that look elsewhere say nothing of
// what is pressed.
TEST(Stiffness, OfWholeSkinsIsThatOfTheFacesBetweenThem) {
  Model model = two_blocks();
  model.contacts.emplace_back(pair_of(*model.mesh));
  PairContact whole = pair_of(*model.mesh);
  whole.slave.facets.clear();
  whole.master.facets.clear();
  for (const Facet& facet : skin(*model.mesh))
    (model.mesh->coordinates[static_cast<std::size_t>(facet[0])][2] < 2.05 ? whole.master : whole.slave)
        .facets.push_back(facet);
  model.contacts.emplace_back(whole);
  choose_stiffness(model);
  expect_relative(std::get<PairContact>(model.contacts[1]).law.eps_N,
                  *std::get<PairContact>(model.contacts[0]).law.eps_N);
}

TEST(Stiffness, FollowsTheUnitSystem) {
  std::vector<double> dimensionless;
  for (const auto& [length, stress] : {std::pair{1.0, 1.0}, {1e3, 1e-6}, {1e3, 1e-9}, {1e-3, 1.0}}) {
    Model model = two_blocks(length, stress);
    model.contacts.emplace_back(pair_of(*model.mesh));
    choose_stiffness(model);
    dimensionless.push_back(*std::get<PairContact>(model.contacts[0]).law.eps_N * length / stress);
  }
  for (const double value : dimensionless) EXPECT_NEAR(value / dimensionless[0], 1.0, round_off);
}

/// A law with friction and a factor.
ContactLaw law_of(std::optional<double> eps_N, std::optional<double> eps_T) {
  ContactLaw law;
  law.eps_N = eps_N;
  law.eps_T = eps_T;
  law.stiffness_factor = 3.0;
  law.mu = 0.2;
  return law;
}

TEST(Stiffness, LeavesWhatIsGivenAndAppliesTheFactorToWhatIsChosen) {
  Model model = two_blocks();
  const auto facets = facets_of(*model.mesh, "TOP");
  model.contacts.emplace_back(floor_under(facets, law_of(7.0, std::nullopt)));
  model.contacts.emplace_back(floor_under(facets, law_of(std::nullopt, 5.0)));
  model.contacts.emplace_back(floor_under(facets, law_of(std::nullopt, std::nullopt)));
  model.contacts.emplace_back(floor_under(facets));
  EXPECT_EQ(choose_stiffness(model).size(), 3U);
  const auto law = [&](std::size_t i) { return std::get<ObstacleContact>(model.contacts[i]).law; };
  const double chosen = soft.p_wave_modulus() / 0.5;
  EXPECT_EQ(law(0).eps_N, 7.0);
  EXPECT_EQ(law(0).eps_T, 7.0);
  expect_relative(law(1).eps_N, 3.0 * chosen);
  EXPECT_EQ(law(1).eps_T, 5.0);
  expect_relative(law(2).eps_T, 3.0 * chosen);
  EXPECT_FALSE(law(3).eps_T);  // without friction there is none
}

TEST(Stiffness, PerNodeCountsTheMeanAreaOfTheNodes) {
  Model model = two_blocks();
  ObstacleContact floor = floor_under({});
  floor.measure = RowMeasure::per_node;
  floor.nodes = model.mesh->nodes_of("TOP");
  model.contacts.emplace_back(floor);
  choose_stiffness(model);
  // 3 x 2 faces of area 1 on 4 x 3 nodes
  expect_relative(std::get<ObstacleContact>(model.contacts[0]).law.eps_N, soft.p_wave_modulus() / 0.5 * 6.0 / 12.0);
}

TEST(Stiffness, OfGradedSurfacesIsTheMeanByArea) {
  Model model = two_blocks();
  Mesh mesh = *model.mesh;
  for (Vec3& x : mesh.coordinates) {
    if (x[2] <= 2.0) x[2] *= 1.0 + x[0] / 3.0;  // heights grow from 0.5 to 1 along x; the top slopes by 2/3
  }
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.contacts.emplace_back(floor_under(facets_of(*model.mesh, "TOP")));
  choose_stiffness(model);
  // The cell of column i: mean height 0.5 (1 + (i + 1/2) / 3), centroid at half of it under the middle of its facet;
  // normal to the facet, whose normal is (-2/3, 0, 1) / |.|, that height shrinks by the cosine.
  double mean = 0.0;
  for (const int i : {0, 1, 2}) mean += soft.p_wave_modulus() / (0.5 * (1.0 + (i + 0.5) / 3.0) * 3.0 / std::sqrt(13.0));
  expect_relative(std::get<ObstacleContact>(model.contacts[0]).law.eps_N, mean / 3.0);
}

TEST(Stiffness, OfAnInterfaceComesFromThePartsThatHoldItsFaces) {
  Mesh mesh = *two_blocks().mesh;
  const std::vector<Index> cells = test::add_interface(mesh, "TOP");
  Model model = two_blocks();
  model.mesh = std::make_shared<const Mesh>(mesh);
  model.contacts.emplace_back(InterfaceContact{"joint", cells, {}, {}});
  choose_stiffness(model);
  expect_relative(std::get<InterfaceContact>(model.contacts[0]).law.eps_N, soft.p_wave_modulus() / 0.5);
}

TEST(Stiffness, OfAnInterfaceBetweenTwoPartsIsThatOfAPair) {
  // A column of three cells whose middle one has no height.
  StructuredBlock column;
  column.size = {1.0, 1.0, 3.0};
  column.divisions = {1, 1, 3};
  Mesh mesh = make_structured_blocks({column});
  for (Vec3& x : mesh.coordinates) {
    if (std::abs(x[2] - 2.0) < 0.5) x[2] = 1.0;
  }
  Model model;
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.parts = {Part{.name = "lower", .cells = {0}, .material = soft},
                 Part{.name = "upper", .cells = {2}, .material = soft}};
  model.contacts.emplace_back(InterfaceContact{"joint", {1}, {}, {}});
  choose_stiffness(model);
  expect_relative(std::get<InterfaceContact>(model.contacts[0]).law.eps_N, soft.p_wave_modulus() / 1.0);
}

TEST(Stiffness, OfPlaneSections) {
  StructuredBlock strip;
  strip.kind = StructuredBlock::Kind::quad;
  strip.origin = {1.0, 0.0, 0.0};
  strip.size = {2.0, 3.0, 0.0};
  strip.divisions = {4, 6, 1};  // cells 0.5 x 0.5
  const auto chosen = [&](Section section, RowMeasure measure) {
    Model model;
    model.mesh = std::make_shared<const Mesh>(make_structured_blocks({strip}));
    model.parts.push_back(part_of(*model.mesh, "BLOCK", CellType::quad4, section, soft, 0.1));
    ObstacleContact floor = floor_under(facets_of(*model.mesh, "YMIN"));
    floor.measure = measure;
    floor.nodes = model.mesh->nodes_of("YMIN");
    model.contacts.emplace_back(floor);
    choose_stiffness(model);
    return std::get<ObstacleContact>(model.contacts[0]).law.eps_N;
  };
  const double M = soft.p_wave_modulus();
  expect_relative(chosen(Section::plane_strain, RowMeasure::per_area), M / 0.5);
  expect_relative(chosen(Section::axisymmetric, RowMeasure::per_area), M / 0.5);
  expect_relative(chosen(Section::plane_stress, RowMeasure::per_area), 2.0 / 0.91 / 0.5);
  expect_relative(chosen(Section::plane_strain, RowMeasure::per_node), M / 0.5 * 2.0 * 0.1 / 5.0);
  // the ring from radius 1 to 3 on five nodes
  expect_relative(chosen(Section::axisymmetric, RowMeasure::per_node), M / 0.5 * std::numbers::pi * 8.0 / 5.0);
}

TEST(Stiffness, OfTheEndOfABarIsYoungsModulusOverTheLengthOfItsCell) {
  StructuredBlock bar;
  bar.kind = StructuredBlock::Kind::bar;
  bar.end = {3.0, 4.0, 0.0};
  bar.divisions = {10, 1, 1};  // cells of length 0.5
  for (const RowMeasure measure : {RowMeasure::per_area, RowMeasure::per_node}) {
    Model model;
    model.mesh = std::make_shared<const Mesh>(make_structured_blocks({bar}));
    model.parts.push_back(part_of(*model.mesh, "BLOCK", CellType::line2, Section::bar, soft, 0.25));
    const std::vector<Index> nodes = model.mesh->nodes_of("END");
    ObstacleContact wall = floor_under({Facet{{nodes[0], -1, -1, -1}, 1}});
    wall.measure = measure;
    wall.nodes = nodes;
    model.contacts.emplace_back(wall);
    choose_stiffness(model);
    expect_relative(std::get<ObstacleContact>(model.contacts[0]).law.eps_N,
                    2.0 / 0.5 * (measure == RowMeasure::per_node ? 0.25 : 1.0));
  }
}

TEST(Stiffness, IsRefusedWhereNoPartIsBehindTheContact) {
  Model model = two_blocks();
  model.contacts.emplace_back(pair_of(*model.mesh));
  model.parts.pop_back();
  try {
    choose_stiffness(model);
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("contact \"pair\""), std::string::npos);
  }
  model.contacts = {StopContact{"stop", {0}, {0, 0, 1}, 0.0, 4.0, 0.0}};
  EXPECT_TRUE(choose_stiffness(model).empty());
}

}  // namespace
}  // namespace carom::contact_stiffness_test
