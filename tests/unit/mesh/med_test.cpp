// MED files of Code_Aster's validation base, and the child process that reads them.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <numeric>

#include "base/errors.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/isolated_process.hpp"
#include "mesh/med_mesh.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh_fixture.hpp"

namespace carom::mesh_med_test {
namespace {

const std::string kMeshes = CAROM_SOURCE_DIR "/cases/sdnv100/meshes/";

TEST(MeshMed, AgreesWithTheGmshFileOfTheSameMesh) {
  const Mesh med = read_mesh(kMeshes + "sdnv100a.med"), msh = read_mesh(kMeshes + "sdnv100a.msh");
  const test::ByFileNumbers a = test::by_file_numbers(med), b = test::by_file_numbers(msh);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  double largest = 0;
  for (const auto& [number, x] : a.nodes)
    for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(x[c] - b.nodes.at(number)[c]));
  EXPECT_LE(largest, 1e-12);  // 15 digits are printed in the Gmsh file: coordinates of 0.2 differ by 1e-16 at most
  EXPECT_EQ(a.node_groups, b.node_groups);
  ASSERT_EQ(med.cell_groups.size(), msh.cell_groups.size());
  for (const auto& [group, cells] : msh.cell_groups) {
    ASSERT_EQ(med.cell_groups.count(group), 1u) << group;
    EXPECT_EQ(med.cell_groups.at(group).size(), cells.size()) << group;
    EXPECT_EQ(med.nodes_of(group).size(), msh.nodes_of(group).size()) << group;
  }
  std::multiset<std::set<std::int64_t>> med_cells, msh_cells;  // the files number cells differently
  for (const auto& [number, nodes] : a.cells.at("HEXA8")) med_cells.emplace(nodes.begin(), nodes.end());
  for (const auto& [number, nodes] : b.cells.at("HEXA8")) msh_cells.emplace(nodes.begin(), nodes.end());
  EXPECT_EQ(med_cells, msh_cells);
}

TEST(MeshMed, TurnsTheCellsOfMixedOrientation) {
  const Mesh mesh = read_mesh(kMeshes + "sdnv100a.med");
  EXPECT_EQ(mesh.report.format, "MED 3.3");
  EXPECT_EQ(mesh.report.turned, 4u);  // the block VSOL; the beam is written as MED's manual asks
  const CellBlock& hexas = *mesh.block(CellType::hexa8);
  ASSERT_EQ(hexas.size(), 24u);
  // Beam 0.02 x 0.02 x 0.2 in 20 cells, block 0.04 x 0.04 x 0.01 in 4: all 4e-6, with z in single precision (6e-8 of
  // 0.2, on edges of 0.01).
  for (std::size_t c = 0; c < 24; ++c) EXPECT_NEAR(test::hexa_volume(mesh, hexas, c), 4e-6, 4e-6 * 2e-6);
  EXPECT_GT(mesh.report.worst_jacobian, 0.999);
}

TEST(MeshMed, KeepsFileNumbersOfCells) {
  const Mesh mesh = read_mesh(kMeshes + "sdnv100a.med");
  const auto hexas = test::by_file_numbers(mesh).cells.at("HEXA8");
  EXPECT_EQ(hexas.begin()->first, 126);  // MAI/HE8/NUM of the file runs from 126 to 149
  EXPECT_EQ(hexas.rbegin()->first, 149);
}

TEST(MeshMed, ReadsQuadraticCellsAndFamiliesOfSeveralGroups) {
  const Mesh mesh = read_mesh(kMeshes + "sdnv100f.med");
  EXPECT_EQ(mesh.node_count(), 256u);
  const CellBlock& hexas = *mesh.block(CellType::hexa20);
  ASSERT_EQ(hexas.size(), 20u);
  EXPECT_EQ(mesh.cell_groups.at("BARRE"), mesh.cell_groups.at("VOLU"));  // one family names both
  EXPECT_EQ(mesh.cell_groups.at("PLANSYMX").size(), 20u);
  EXPECT_EQ(mesh.node_groups.at("P1").size(), 1u);
  EXPECT_TRUE(std::includes(mesh.node_groups.at("PLANSYMX").begin(), mesh.node_groups.at("PLANSYMX").end(),
                            mesh.node_groups.at("P1").begin(), mesh.node_groups.at("P1").end()));
  constexpr std::array<std::array<std::size_t, 2>, 12> edges{
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  for (std::size_t c = 0; c < 20; ++c) {
    const auto x = [&](std::size_t i) {
      return mesh.coordinates[static_cast<std::size_t>(hexas.connectivity[20 * c + i])];
    };
    EXPECT_NEAR(test::hexa_volume(mesh, hexas, c), 1e-6, 1e-6 * 2e-6);  // 0.01 x 0.01 x 0.01, single precision
    for (std::size_t e = 0; e < 12; ++e)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(x(8 + e)[k], (x(edges[e][0])[k] + x(edges[e][1])[k]) / 2, 2e-8);  // single precision of 0.2
  }
}

TEST(MeshMed, BothFilesOfTheRepositoryAreReadWhateverTheyAreCalled) {
  const std::string bytes = test::bytes_of(kMeshes + "sdnv100a.med");
  EXPECT_EQ(read_mesh(bytes, "misnamed.msh").node_count(), 102u);
}

/// Written through the 2.3.6 interface of the MED library: one cell 1 x 1 x 2, its lower and upper face, two corners.
TEST(MeshMed, ReadsFilesOfOlderVersions) {
  const Mesh mesh = read_mesh(CAROM_SOURCE_DIR "/tests/data/cube_med_2_3.med");
  EXPECT_EQ(mesh.report.format, "MED 2.3");
  ASSERT_EQ(mesh.node_count(), 8u);
  ASSERT_EQ(mesh.block(CellType::hexa8)->size(), 1u);
  EXPECT_DOUBLE_EQ(test::hexa_volume(mesh, *mesh.block(CellType::hexa8), 0), 2.0);
  const test::ByFileNumbers read = test::by_file_numbers(mesh);
  EXPECT_EQ(read.nodes.at(18), (Vec3{1.0, 1.0, 2.0}));
  EXPECT_EQ(read.node_groups.at("CORNER"), (std::set<std::int64_t>{15, 18}));
  EXPECT_EQ(read.node_groups.at("TIP"), (std::set<std::int64_t>{18}));
  EXPECT_EQ(mesh.cell_groups.at("BODY").size(), 1u);
  EXPECT_EQ(mesh.cell_groups.at("SKIN").size(), 2u);
  EXPECT_EQ(mesh.nodes_of("TOP").size(), 4u);
}

/// The corners that nodes 8 to 26 of a HEXA27 are the means of: edges of the bottom, of the top, upright ones; the
/// faces; all.
using Corners = std::vector<std::vector<std::size_t>>;
Corners corners_of(const Corners& faces) {
  Corners means = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  means.insert(means.end(), faces.begin(), faces.end());
  means.push_back({0, 1, 2, 3, 4, 5, 6, 7});
  return means;
}

/// A cube of 27 nodes as MED numbers them: corners of the bottom clockwise from above, then of the top; middles of the
/// edges of the bottom, of the top and upright; faces 1234, 1265, 2376, 3487, 1584, 5678; centre.
Hdf5Tree hexa27_of_med() {
  constexpr int corners[8][3] = {{-1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {1, -1, -1},
                                 {-1, -1, 1},  {-1, 1, 1},  {1, 1, 1},  {1, -1, 1}};
  const Corners means =
      corners_of({{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {0, 4, 7, 3}, {4, 5, 6, 7}});
  std::vector<double> x(3 * 27);  // all x, all y, all z
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t a = 0; a < 8; ++a) x[27 * c + a] = corners[a][c];
    for (std::size_t k = 0; k < means.size(); ++k) {
      double sum = 0.0;
      for (const std::size_t a : means[k]) sum += corners[a][c];
      x[27 * c + 8 + k] = sum / static_cast<double>(means[k].size());
    }
  }
  std::vector<std::int64_t> nodes(27);
  std::iota(nodes.begin(), nodes.end(), std::int64_t{1});
  Hdf5Tree tree;
  tree.groups = {"/INFOS_GENERALES", "/ENS_MAA",           "/ENS_MAA/m",    "/ENS_MAA/m/FAS",
                 "/ENS_MAA/m/MAI",   "/ENS_MAA/m/MAI/H27", "/ENS_MAA/m/NOE"};
  tree.attributes = {{"/INFOS_GENERALES@MAJ", 2},
                     {"/INFOS_GENERALES@MIN", 3},
                     {"/ENS_MAA/m@TYP", 0},
                     {"/ENS_MAA/m@DIM", 3},
                     {"/ENS_MAA/m@ESP", 3}};
  tree.data_sets = {{"/ENS_MAA/m/NOE/COO", {{81}, x}}, {"/ENS_MAA/m/MAI/H27/NOD", {{27}, nodes}}};
  return tree;
}

// Every node is the mean of its corners here as there: faces -x, +x, -y, +y, -z, +z (element/shapes/hexa27.hpp).
TEST(MeshMed, ReadsHexa27) {
  const Mesh mesh = med_mesh(hexa27_of_med(), "cube.med");
  const CellBlock& block = *mesh.block(CellType::hexa27);
  ASSERT_EQ(block.size(), 1U);
  EXPECT_NEAR(test::hexa_volume(mesh, block, 0), 8.0, 1e-12);
  const Corners means =
      corners_of({{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}});
  const auto x = [&](std::size_t a) { return mesh.coordinates[static_cast<std::size_t>(block.connectivity[a])]; };
  for (std::size_t k = 0; k < means.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (const std::size_t a : means[k]) sum += x(a)[c];
      EXPECT_NEAR(x(8 + k)[c], sum / static_cast<double>(means[k].size()), 1e-15) << k;
    }
}

/// Two bars in the plane; before 2.3.2 the families stood side by side.
Hdf5Tree bars_of_med_2(std::int64_t minor) {
  Hdf5Tree tree;
  tree.groups = {
      "/INFOS_GENERALES",      "/ENS_MAA",       "/ENS_MAA/m",         "/ENS_MAA/m/FAS", "/ENS_MAA/m/FAS/FAM_1",
      "/ENS_MAA/m/FAS/FAM_-1", "/ENS_MAA/m/MAI", "/ENS_MAA/m/MAI/SE2", "/ENS_MAA/m/NOE"};
  tree.attributes = {{"/INFOS_GENERALES@MAJ", 2},
                     {"/INFOS_GENERALES@MIN", minor},
                     {"/ENS_MAA/m@TYP", 0},
                     {"/ENS_MAA/m@DIM", 1},
                     {"/ENS_MAA/m@ESP", 2},
                     {"/ENS_MAA/m/FAS/FAM_1@NUM", 1},
                     {"/ENS_MAA/m/FAS/FAM_-1@NUM", -1}};
  const auto name = [](const std::string& text) {
    std::vector<std::int64_t> letters(81, ' ');
    std::copy(text.begin(), text.end(), letters.begin());
    letters.back() = 0;
    return Hdf5Tree::DataSet{{81, 1}, letters};
  };
  const auto integers = [](std::vector<std::int64_t> values) { return Hdf5Tree::DataSet{{values.size()}, values}; };
  tree.data_sets = {{"/ENS_MAA/m/FAS/FAM_1/GRO/NOM", name("END")},
                    {"/ENS_MAA/m/FAS/FAM_-1/GRO/NOM", name("BARS")},
                    {"/ENS_MAA/m/NOE/COO", {{6}, std::vector<double>{0.0, 1.0, 2.0, 0.0, 3.0, 4.0}}},
                    {"/ENS_MAA/m/NOE/FAM", integers({0, 0, 1})},
                    {"/ENS_MAA/m/MAI/SE2/NOD", integers({1, 2, 2, 3})},
                    {"/ENS_MAA/m/MAI/SE2/FAM", integers({-1, -1})}};
  return tree;
}

TEST(MeshMed, ReadsTheFamiliesOf22AndSaysHowToConvertOlderFiles) {
  const Mesh mesh = med_mesh(bars_of_med_2(2), "old.med");
  EXPECT_EQ(mesh.coordinates[2], (Vec3{2.0, 4.0, 0.0}));  // all x stand before all y
  EXPECT_EQ(mesh.node_groups.at("END"), (std::vector<Index>{2}));
  EXPECT_EQ(mesh.cell_groups.at("BARS").size(), 2u);
  try {
    med_mesh(bars_of_med_2(1), "old.med");
    FAIL() << "MED 2.1 was read";
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("MED 2.1"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("medimport"), std::string::npos) << error.what();
  }
}

constexpr IsolationLimits kLimits{.memory_bytes = 1 << 28, .output_bytes = 1000, .cpu_seconds = 1};

TEST(IsolatedProcess, HandsBackWhatTheWorkWrites) {
  const IsolatedResult result = run_isolated(kLimits, [](int fd) { write_all(fd, "carom", 5); });
  EXPECT_EQ(result.output, "carom");
  EXPECT_EQ(result.failure, "");
}

TEST(IsolatedProcess, SurvivesCrashesExceptionsEndlessLoopsAndFloods) {
  EXPECT_EQ(run_isolated(kLimits, [](int) { std::raise(SIGSEGV); }).failure,
            "it was stopped by the signal 'Segmentation fault'");
  EXPECT_EQ(run_isolated(kLimits, [](int) { throw 1; }).failure, "it ended early");
  EXPECT_EQ(run_isolated(kLimits,
                         [](int) {
                           std::atomic<int> turns = 0;
                           for (;;) ++turns;
                         })
                .failure,
            "it did not end within 1 s");
  EXPECT_EQ(run_isolated(kLimits,
                         [](int fd) {
                           for (;;) write_all(fd, "flood", 5);
                         })
                .failure,
            "it holds more data than its size allows");
}

}  // namespace
}  // namespace carom::mesh_med_test
