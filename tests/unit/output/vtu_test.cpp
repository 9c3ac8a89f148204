// The frames of every format as VTK's own readers see them (vtu_read.py).
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
#include "output/frame_format.hpp"
#include "output/results_folder.hpp"

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
  FrameCells cells;
};

/// Entry i of a field is scale * (i + 1/3): not exact in decimal, so a loss of digits shows.
std::vector<double> values(std::size_t count, double scale) {
  std::vector<double> v(count);
  for (std::size_t i = 0; i < count; ++i) v[i] = scale * (static_cast<double>(i) + 1.0 / 3.0);
  return v;
}

class Frames : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    static int count = 0;
    folder_ = fs::temp_directory_path() / fmt::format("carom_frames_{}_{}", ++count, ::getpid());
    prepare_results_folder(folder_.string());
  }
  void TearDown() override { fs::remove_all(folder_); }

  const FrameFormat& format() const { return frame_formats()[GetParam()]; }
  std::string index() const { return (folder_ / format().indices.front().name).string(); }

  /// Returns the name of the file.
  std::string write_frame(const Grid& grid, int step, double scale) const {
    const std::vector<double> displacement = values(3 * grid.points.size(), scale);
    const std::vector<double> stress = values(6 * grid.cells.types.size(), -scale);
    const std::vector<double> energy = values(grid.cells.types.size(), 2 * scale);
    const std::vector<float> in_single(energy.begin(), energy.end());
    std::vector<Index> number(grid.cells.types.size());
    std::iota(number.begin(), number.end(), -7);
    std::vector<std::uint8_t> status(grid.points.size());
    for (std::size_t n = 0; n < status.size(); ++n) status[n] = static_cast<std::uint8_t>(n % 251);
    const std::vector<FrameField> on_points{{"displacement", 3, displacement}, {"status", 1, status}};
    const std::vector<FrameField> on_cells{{"stress", 6, stress},
                                           {"energy <&\"> density", 1, energy},
                                           {"in single precision", 1, in_single},
                                           {"number", 1, number}};
    const std::string file = frame_file(format(), step);
    format()
        .make_writer(folder_.string(), bodies_mesh, {grid.points, grid.cells, {}, {}})
        ->write(file, {on_points, on_cells});
    return file;
  }

  fs::path folder_;
};

INSTANTIATE_TEST_SUITE_P(Of, Frames, testing::Range<std::size_t>(0, frame_formats().size()),
                         [](const auto& each) { return std::string(frame_formats()[each.param].name); });

TEST_P(Frames, VtkReadsEveryPointCellAndFieldExactly) {
  Grid grid(3, 2, 2);
  grid.add_flat_cells();
  FrameIndex frames(folder_.string(), format());
  for (const int step : {0, 10}) frames.add({0.1 * step, write_frame(grid, step, step + 1.0), ""});
  const std::string command = fmt::format(
      "/usr/bin/python3 \"{}/tests/unit/output/vtu_read.py\" \"{}\" 3 2 2 mixed 0 10", CAROM_SOURCE_DIR, index());
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_P(Frames, VtkReadsMoreThanOneBuffer) {
  // 24,000 cells: every array is larger than the writer's buffer of 256 KiB except the cell types, and than a piece of
  // a deflated one.
  const Grid grid(40, 30, 20);
  FrameIndex frames(folder_.string(), format());
  frames.add({0.1 * 123456, write_frame(grid, 123456, 123457.0), ""});
  const std::string command =
      fmt::format("/usr/bin/python3 \"{}/tests/unit/output/vtu_read.py\" \"{}\" 40 30 20 hexahedra 123456",
                  CAROM_SOURCE_DIR, index());
  EXPECT_EQ(std::system(command.c_str()), 0);
}

// Faces that look outward, middles on their edges, volumes that add up, as VTK sees them.
TEST_P(Frames, VtkReadsEveryTypeOfCell) {
  StructuredBlock box, strip;
  box.size = strip.size = {2.0, 1.0, 3.0};
  box.divisions = strip.divisions = {2, 1, 2};
  strip.kind = StructuredBlock::Kind::quad;
  const auto write = [&](const StructuredBlock& block, CellType type) {
    const Mesh mesh = test::with_cells(make_structured_blocks({block}), type);
    const CellBlock& of_type = *mesh.block(type);
    const auto n = static_cast<std::size_t>(node_count(type));
    FrameCells cells;
    for (std::size_t k = 0; k < of_type.size(); ++k) cells.add(std::span(of_type.connectivity).subspan(n * k, n), type);
    const std::string file = fmt::format("fields/{}{}", name(type), format().end);
    const std::string body = fmt::format("{}_mesh", name(type));
    format().make_writer(folder_.string(), body, {mesh.coordinates, cells, {}, {}})->write(file, {});
    return fmt::format(" \"{}\"", (folder_ / file).string());
  };
  std::string solids, planes;
  for (const CellType type : test::solid_types) solids += write(box, type);
  for (const CellType type : test::plane_types) planes += write(strip, type);
  const std::string script = fmt::format("/usr/bin/python3 \"{}/tests/unit/output/vtu_cells.py\"", CAROM_SOURCE_DIR);
  EXPECT_EQ(std::system((script + " 6" + solids).c_str()), 0);
  EXPECT_EQ(std::system((script + " 2" + planes).c_str()), 0);
}

// Three cubes in a row have 14 faces outside; without the one in the middle two cubes are left, with 6 faces each, and
// without the first one a row of two, with 10.
TEST_P(Frames, VtkLeavesOutHiddenCells) {
  const Grid grid(3, 1, 1);
  const auto surface_has = [&](const std::vector<std::uint8_t>& hidden, int faces) {
    const std::string file = frame_file(format(), 0);
    format()
        .make_writer(folder_.string(), bodies_mesh, {grid.points, grid.cells, {}, {}})
        ->write(file, {{}, {{"energy", 1, values(3, 1.0)}, {ghost_type, 1, hidden}}});
    const std::string script = fmt::format("/usr/bin/python3 \"{}/tests/unit/output/vtu_hidden.py\"", CAROM_SOURCE_DIR);
    return std::system(fmt::format("{} \"{}\" {} {}", script, (folder_ / file).string(), faces, faces).c_str()) == 0;
  };
  EXPECT_TRUE(surface_has({0, 0, 0}, 14));
  EXPECT_TRUE(surface_has({0, hidden_cell, 0}, 12));
  EXPECT_TRUE(surface_has({hidden_cell, 0, 0}, 10));
}

// What has grown frame by frame is what is written at once, when a run is resumed.
TEST_P(Frames, IndexIsWholeAfterEveryFrame) {
  const Grid grid(1, 1, 1);
  FrameIndex frames(folder_.string(), format());
  std::vector<FrameEntry> all;
  for (const int step : {0, 7, 8}) {
    const std::string file = write_frame(grid, step, 1.0);
    all.push_back({0.1 * step, file, step == 7 ? file : ""});
    frames.add(all.back());
    std::vector<std::string> grown;
    for (const IndexFile& each : format().indices) grown.push_back(read_text(folder_ / each.name));
    const FrameIndex anew(folder_.string(), format(), all);
    for (std::size_t i = 0; i < grown.size(); ++i) {
      EXPECT_EQ(grown[i], read_text(folder_ / format().indices[i].name));
      EXPECT_EQ(i == 1 && step == 0, grown[i].empty());  // no obstacles yet
    }
    EXPECT_TRUE(grown[0].ends_with(format().indices[0].tail));
  }
}

// The same values, the same bytes: a resumed run leaves what one that was never stopped does.
TEST_P(Frames, EqualValuesMakeEqualFiles) {
  const Grid grid(3, 2, 2);
  const std::string first = read_text(folder_ / write_frame(grid, 0, 1.0));
  EXPECT_EQ(first, read_text(folder_ / write_frame(grid, 0, 1.0)));
  EXPECT_NE(first, read_text(folder_ / write_frame(grid, 0, 2.0)));
}

TEST_P(Frames, MissingFolderIsAnErrorThatNamesThePath) {
  const Grid grid(1, 1, 1);
  const std::string folder = (folder_ / "absent").string();
  const std::string path = folder + "/" + (format().shares_mesh ? "fields/mesh" + std::string(format().end) : "a");
  try {
    format().make_writer(folder, bodies_mesh, {grid.points, grid.cells, {}, {}})->write("a", {});
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.what(), "cannot write " + path + ": No such file or directory");
  }
}

}  // namespace
}  // namespace carom::output_vtu_test
