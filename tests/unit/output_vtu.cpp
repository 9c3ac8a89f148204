// The .vtu and .pvd files as VTK's own reader sees them (vtu_read.py).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "cell_meshes.hpp"
#include "mesh/structured_block.hpp"
#include "output/pvd.hpp"
#include "output/results_folder.hpp"
#include "output/vtu.hpp"

namespace carom::output_vtu_test {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// nx x ny x nz unit cubes, points numbered x fastest; the Python script builds the same numbers by itself.
struct Grid {
  explicit Grid(int nx, int ny, int nz) {
    const auto point = [&](int i, int j, int k) { return static_cast<Index>(i + (nx + 1) * (j + (ny + 1) * k)); };
    for (int k = 0; k <= nz; ++k)
      for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) points.push_back({double(i), double(j), double(k)});
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
          for (const Index n :
               {point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k), point(i, j + 1, k), point(i, j, k + 1),
                point(i + 1, j, k + 1), point(i + 1, j + 1, k + 1), point(i, j + 1, k + 1)})
            hexa8.push_back(n);
    for (std::size_t c = 0; c < hexa8.size(); c += 8) cells.add({&hexa8[c], 8}, CellType::hexa8);
  }
  /// Adds the face z = 0 of the first cube as a QUAD4, and its edge along x as a LINE2.
  void add_flat_cells() {
    cells.add({hexa8.data(), 4}, CellType::quad4);
    cells.add({hexa8.data(), 2}, CellType::line2);
  }
  std::vector<Vec3> points;
  std::vector<Index> hexa8;
  VtuCells cells;
};

/// Entry i of a field is scale * (i + 1/3): not exact in decimal, so a loss of digits shows.
std::vector<double> values(std::size_t count, double scale) {
  std::vector<double> v(count);
  for (std::size_t i = 0; i < count; ++i) v[i] = scale * (static_cast<double>(i) + 1.0 / 3.0);
  return v;
}

class VtuTest : public testing::Test {
 protected:
  void SetUp() override {
    const char* name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / fmt::format("carom_vtu_{}_{}", name, ::getpid());
    prepare_results_folder(folder_.string());
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write_frame(const Grid& grid, int step, double scale) const {
    const std::vector<double> displacement = values(3 * grid.points.size(), scale);
    const std::vector<double> stress = values(6 * grid.cells.types.size(), -scale);
    const std::vector<double> energy = values(grid.cells.types.size(), 2 * scale);
    const std::vector<float> in_single(energy.begin(), energy.end());
    std::vector<Index> number(grid.cells.types.size());
    std::iota(number.begin(), number.end(), -7);
    std::vector<std::uint8_t> status(grid.points.size());
    for (std::size_t n = 0; n < status.size(); ++n) status[n] = static_cast<std::uint8_t>(n % 251);
    const std::vector<VtuField> on_points{{"displacement", 3, displacement}, {"status", 1, status}};
    const std::vector<VtuField> on_cells{{"stress", 6, stress},
                                         {"energy <&\"> density", 1, energy},
                                         {"in single precision", 1, in_single},
                                         {"number", 1, number}};
    write_vtu((folder_ / frame_file(step)).string(), grid.points, grid.cells, on_points, on_cells);
  }

  fs::path folder_;
};

TEST_F(VtuTest, VtkReadsEveryPointCellAndFieldExactly) {
  Grid grid(3, 2, 2);
  grid.add_flat_cells();
  PvdCollection pvd((folder_ / "fields.pvd").string());
  for (const int step : {0, 10}) {
    write_frame(grid, step, step + 1.0);
    pvd.add(0.1 * step, frame_file(step));
  }
  const std::string command = fmt::format("/usr/bin/python3 \"{}/tests/unit/vtu_read.py\" \"{}\" 3 2 2 mixed 0 10",
                                          CAROM_SOURCE_DIR, folder_.string());
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(VtuTest, VtkReadsMoreThanOneBuffer) {
  // 24,000 cells: every array is larger than the writer's buffer of 256 KiB except the cell types.
  const Grid grid(40, 30, 20);
  PvdCollection pvd((folder_ / "fields.pvd").string());
  write_frame(grid, 123456, 123457.0);
  pvd.add(0.1 * 123456, frame_file(123456));
  const std::string command =
      fmt::format("/usr/bin/python3 \"{}/tests/unit/vtu_read.py\" \"{}\" 40 30 20 hexahedra 123456", CAROM_SOURCE_DIR,
                  folder_.string());
  EXPECT_EQ(std::system(command.c_str()), 0);
}

// Faces that look outward, middles on their edges, volumes that add up, as VTK sees them.
TEST_F(VtuTest, VtkReadsEveryTypeOfCell) {
  StructuredBlock box, strip;
  box.size = strip.size = {2.0, 1.0, 3.0};
  box.divisions = strip.divisions = {2, 1, 2};
  strip.kind = StructuredBlock::Kind::quad;
  const auto write = [&](const StructuredBlock& block, CellType type) {
    const Mesh mesh = test::with_cells(make_structured_blocks({block}), type);
    const CellBlock& of_type = *mesh.block(type);
    const auto n = static_cast<std::size_t>(node_count(type));
    VtuCells cells;
    for (std::size_t k = 0; k < of_type.size(); ++k) cells.add(std::span(of_type.connectivity).subspan(n * k, n), type);
    const std::string file = (folder_ / fmt::format("{}.vtu", name(type))).string();
    write_vtu(file, mesh.coordinates, cells, {}, {});
    return fmt::format(" \"{}\"", file);
  };
  std::string solids, planes;
  for (const CellType type : test::solid_types) solids += write(box, type);
  for (const CellType type : test::plane_types) planes += write(strip, type);
  const std::string script = fmt::format("/usr/bin/python3 \"{}/tests/unit/vtu_cells.py\"", CAROM_SOURCE_DIR);
  EXPECT_EQ(std::system((script + " 6" + solids).c_str()), 0);
  EXPECT_EQ(std::system((script + " 2" + planes).c_str()), 0);
}

TEST_F(VtuTest, CollectionIsWholeAfterEveryFrame) {
  PvdCollection pvd((folder_ / "fields.pvd").string());
  EXPECT_NE(read_text(folder_ / "fields.pvd").find("</VTKFile>"), std::string::npos);
  pvd.add(0.1, frame_file(7));
  const std::string text = read_text(folder_ / "fields.pvd");
  EXPECT_NE(text.find("timestep=\"0.1\" group=\"\" part=\"0\" file=\"fields/step_000007.vtu\""), std::string::npos);
  EXPECT_NE(text.find("</VTKFile>"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "fields.pvd.tmp"));
}

TEST_F(VtuTest, MissingFolderIsAnErrorThatNamesThePath) {
  const Grid grid(1, 1, 1);
  const std::string path = (folder_ / "absent" / "a.vtu").string();
  try {
    write_vtu(path, grid.points, grid.cells, {}, {});
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.what(), "cannot write " + path + ": No such file or directory");
  }
}

}  // namespace
}  // namespace carom::output_vtu_test
