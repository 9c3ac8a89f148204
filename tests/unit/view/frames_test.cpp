#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <stdexcept>

#include "cell_meshes.hpp"
#include "mesh/structured_block.hpp"
#include "output/frame_format.hpp"
#include "output/results_folder.hpp"
#include "output/vtkhdf.hpp"
#include "output/vtu.hpp"
#include "view/frame_file.hpp"
#include "view/packed_arrays.hpp"
#include "view/scene.hpp"
#include "view/view.hpp"

namespace carom::view_frames_test {
namespace {

namespace fs = std::filesystem;

class ViewFrames : public testing::Test {
 protected:
  void SetUp() override {
    const char* name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / fmt::format("carom_view_{}_{}", name, ::getpid());
    prepare_results_folder(folder_.string());
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

Mesh cube(int n, CellType type = CellType::hexa8) {
  StructuredBlock b;
  b.size = {1.0, 1.0, 1.0};
  b.divisions = {n, n, n};
  return type == CellType::hexa8 ? make_structured_blocks({b}) : test::with_cells(make_structured_blocks({b}), type);
}

const CellBlock& solids(const Mesh& mesh) {
  for (const CellBlock& block : mesh.blocks)
    if (dimension(block.type) == 3) return block;
  throw std::logic_error("no solids");
}

FrameCells cells_of(const CellBlock& block) {
  FrameCells cells;
  for (std::size_t k = 0; k < block.size(); ++k) cells.add(block.nodes(static_cast<Index>(k)), block.type);
  return cells;
}

/// A cube that moves by `t` along x; a scalar of the nodes that is their z, and one of the cells that is their number.
/// gone: how many of the cells, the first ones; without it no cell may go.
void write_frame(const std::string& path, const Mesh& mesh, double t, std::optional<std::size_t> gone = {}) {
  const CellBlock& block = solids(mesh);
  std::vector<double> displacement(3 * mesh.node_count());
  std::vector<float> height, cell;
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    displacement[3 * n] = t;
    height.push_back(static_cast<float>(mesh.coordinates[n][2]));
  }
  for (std::size_t k = 0; k < block.size(); ++k) cell.push_back(static_cast<float>(k));
  const std::vector<FrameField> points{
      {"node_number", 1, mesh.node_numbers}, {"displacement", 3, displacement}, {"height", 1, height}};
  std::vector<FrameField> of_cells{{"cell_number", 1, block.file_numbers},
                                   {"part", 1, std::vector<Index>(block.size(), 0)},
                                   {"stress", 6, std::vector<float>(6 * block.size(), 1.0F)},
                                   {"of cell", 1, cell}};
  if (gone) {
    std::vector<std::uint8_t> hidden(block.size(), 0);
    std::fill_n(hidden.begin(), *gone, hidden_cell);
    of_cells.push_back({ghost_type, 1, hidden});
  }
  const FrameMesh frame_mesh{mesh.coordinates, cells_of(block), {}, {}};
  const fs::path file(path);
  if (file.extension() == ".vtu") return write_vtu(path, frame_mesh, {points, of_cells});
  make_vtkhdf_writer(file.parent_path().parent_path().string(), "mesh", frame_mesh)
      ->write("fields/" + file.filename().string(), {points, of_cells});
}

TEST_F(ViewFrames, AreReadAsTheyWereWritten) {
  for (const CellType type :
       {CellType::hexa8, CellType::tetra10, CellType::hexa20, CellType::hexa27, CellType::penta15}) {
    const Mesh mesh = cube(2, type);
    for (const std::string& file : {path("a.vtu"), path("fields/a.vtkhdf")}) {
      write_frame(file, mesh, 0.5);
      const FrameFile frame(file);
      const Mesh back = frame.mesh();
      EXPECT_EQ(back.coordinates, mesh.coordinates);
      ASSERT_EQ(back.blocks.size(), 1U);
      EXPECT_EQ(back.blocks[0].type, type);
      EXPECT_EQ(back.blocks[0].connectivity, solids(mesh).connectivity);
      ASSERT_NE(frame.point_field("displacement"), nullptr);
      EXPECT_EQ(frame.point_field("displacement")->at(7, 0), 0.5);
      EXPECT_EQ(frame.cell_field("of cell")->at(3), 3.0);
      EXPECT_EQ(frame.point_field("no such"), nullptr);
    }
  }
}

TEST_F(ViewFrames, DamagedOnesAreRefusedOrReadButNeverCrash) {
  write_frame(path("a.vtu"), cube(2), 0.5);
  std::ifstream stream(path("a.vtu"), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  const auto write = [&](const std::string& text) {
    std::ofstream(path("b.vtu"), std::ios::binary) << text;
    return path("b.vtu");
  };
  for (std::size_t length = 0; length + 30 < whole.size(); length += 97)  // the end tag is not looked at
    EXPECT_THROW(FrameFile(write(whole.substr(0, length))), std::runtime_error) << length;
  std::mt19937 random(5);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      const std::string file = write(damaged);
      const FrameFile frame(file);
      if (frame.points() > 0) read_scene(std::vector{file}, "part", 1000);
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);  // most hits are in values, which may be anything
}

// A frame has its mesh in a file beside it.
TEST_F(ViewFrames, CutOnesAndThoseWithoutTheirMeshAreRefused) {
  const std::string file = path("fields/a.vtkhdf"), mesh = path("fields/mesh.vtkhdf");
  write_frame(file, cube(2), 0.5);
  EXPECT_NO_THROW(FrameFile{file}.mesh());
  for (const std::string& each : {file, mesh}) {
    const auto whole = fs::file_size(each);
    fs::copy_file(each, path("kept"), fs::copy_options::overwrite_existing);
    for (std::uintmax_t length = 0; length < whole; length += whole / 7) {
      fs::resize_file(each, length);
      EXPECT_THROW(FrameFile{file}, std::runtime_error) << each << " " << length;
      fs::copy_file(path("kept"), each, fs::copy_options::overwrite_existing);
    }
  }
  fs::remove(mesh);
  EXPECT_THROW(FrameFile{file}, std::runtime_error);
}

// A bar of three cubes along z, of which the first goes before the second frame and the second before the fourth one.
TEST_F(ViewFrames, WhatHasGoneHasNoValues) {
  StructuredBlock b;
  b.size = {1.0, 1.0, 3.0};
  b.divisions = {1, 1, 3};
  const Mesh mesh = make_structured_blocks({b});
  std::vector<std::string> files;
  for (const std::size_t gone : {0U, 1U, 1U, 2U}) {
    files.push_back(path(fmt::format("{}.vtu", files.size())));
    write_frame(files.back(), mesh, 0.5, gone);
  }
  const Scene scene = read_scene(files, "part", 1000);
  ASSERT_EQ(scene.surface.nodes.size(), 16U);
  ASSERT_EQ(scene.surface.triangles.size(), 2U * (14 + 2));  // 14 outer faces and two that are laid bare
  const auto count = [&](Index frame) {
    return std::count_if(scene.surface.triangles.begin(), scene.surface.triangles.end(),
                         [frame](const SeenTriangle& t) { return t.from <= frame && frame < t.until; });
  };
  EXPECT_EQ(count(0), 2 * 14);
  EXPECT_EQ(count(1), 2 * 10);
  EXPECT_EQ(count(3), 2 * 6);
  for (const SceneField& field : scene.fields) {
    EXPECT_NE(field.name, ghost_type);
    const auto width = static_cast<std::size_t>(field.components);
    for (const auto& [frame, nodes, cells] : {std::array{0U, 0U, 0U}, {1U, 4U, 1U}, {2U, 4U, 1U}, {3U, 8U, 2U}}) {
      const std::vector<float>& values = field.frames[frame];
      // The nodes and cells of a bar are numbered along it.
      const std::size_t without = width * (field.at_cells ? cells : nodes);
      for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(std::isnan(values[i]), i < without) << field.name << " " << frame << " " << i;
    }
  }
}

std::string decoded(const std::string& text) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> packed;
  unsigned group = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6U | static_cast<unsigned>(letters.find(c));
    if ((bits += 6) < 8) continue;
    packed.push_back(static_cast<unsigned char>(group >> (bits -= 8)));
  }
  std::string bytes(1'000'000, '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, packed.data(), packed.size()), Z_OK);
  bytes.resize(size);
  return bytes;
}

/// What view_data.js does.
std::vector<std::uint32_t> unpacked(const std::string& bytes, std::size_t at, std::size_t count, std::size_t width,
                                    const std::vector<std::uint32_t>* earlier = nullptr) {
  const std::uint32_t mask = width == 4 ? ~0U : (1U << 8U * width) - 1U;
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t folded = 0;
    for (std::size_t b = 0; b < width; ++b)
      folded |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + b * count + i])) << 8U * b;
    const std::uint32_t difference = (folded >> 1U) ^ (0U - (folded & 1U));
    const std::uint32_t before = earlier != nullptr ? (*earlier)[i] : (i > 0 ? numbers.back() : 0U);
    numbers.push_back((before + difference) & mask);
  }
  return numbers;
}

TEST(PackedArrays, ComeBack) {
  std::mt19937 random(3);
  for (const std::size_t width : {1U, 2U, 4U}) {
    const std::uint32_t most = width == 4 ? ~0U : (1U << 8U * width) - 1U;
    std::vector<std::uint32_t> first{0, most, most, 0, 1, most / 2}, second{most, 0, most / 2, 3, 2, 1};
    for (int i = 0; i < 1000; ++i) {
      first.push_back(random() & most);
      second.push_back(random() & most);
    }
    PackedArrays arrays;
    arrays.add(first, static_cast<int>(width));
    arrays.add(second, static_cast<int>(width), first);
    const std::string bytes = decoded(arrays.text());
    ASSERT_EQ(bytes.size(), 2 * width * first.size());
    EXPECT_EQ(unpacked(bytes, 0, first.size(), width), first);
    EXPECT_EQ(unpacked(bytes, width * first.size(), first.size(), width, &first), second);
  }
}

TEST_F(ViewFrames, AViewTellsWhatItHoldsAndFitsItsPage) {
  const Mesh mesh = cube(12);
  {
    FrameIndex frames(folder_.string(), xdmf_format());
    for (int i = 0; i < 40; ++i) {
      const std::string name = fmt::format("fields/{:06}.vtkhdf", i);
      write_frame(path(name), mesh, 0.01 * i * i);
      frames.add({0.1 * i, name, ""});
    }
  }
  const ViewLabels labels{units_of("SI"), {"cube"}, {}};
  const std::optional<View> whole = make_view(folder_.string(), labels, 4'000'000);
  ASSERT_TRUE(whole.has_value());
  const auto json = nlohmann::json::parse(whole->json);
  EXPECT_EQ(json["times"].size(), 40U);
  EXPECT_EQ(json["scenes"][0]["nodes"], 13 * 13 * 13 - 11 * 11 * 11);
  EXPECT_EQ(json["scenes"][0]["parts"], nlohmann::json::array({"cube"}));
  std::map<std::string, nlohmann::json> fields;
  for (const auto& field : json["scenes"][0]["fields"]) fields[field["name"]] = field;
  EXPECT_EQ(fields["displacement"]["components"], nlohmann::json::array({"x", "y", "z"}));
  EXPECT_EQ(fields["stress"]["components"].size(), 6U);
  EXPECT_EQ(fields["stress"]["unit"], "Pa");
  EXPECT_EQ(fields["height"]["components"].size(), 1U);  // of no row of the table
  for (const std::size_t most : {50'000U, 20'000U, 10'000U}) {
    const std::optional<View> small = make_view(folder_.string(), labels, most);
    ASSERT_TRUE(small.has_value());
    EXPECT_LE(small->json.size(), most);
    EXPECT_NE(small->note, whole->note);  // what has been left out is said
  }
  const std::optional<View> least = make_view(folder_.string(), labels, 1);  // there is no smaller one
  ASSERT_TRUE(least.has_value());
  EXPECT_FALSE(nlohmann::json::parse(least->json)["data"].empty());
  EXPECT_FALSE(make_view((folder_ / "none").string(), labels, 1000).has_value());
}

// Which frames a triangle is seen in stands behind the edges; where no cell goes there is nothing of it.
TEST_F(ViewFrames, AViewTellsWhenTrianglesAreSeen) {
  StructuredBlock b;
  b.size = {1.0, 1.0, 3.0};
  b.divisions = {1, 1, 3};
  const Mesh mesh = make_structured_blocks({b});
  const auto view_of = [&](std::size_t gone, const FrameFormat& format) {
    prepare_results_folder(folder_.string());
    FrameIndex frames(folder_.string(), format);
    for (int i = 0; i < 3; ++i) {
      const std::string name = fmt::format("fields/{:06}{}", i, format.end);
      write_frame(path(name), mesh, 0.01 * i, i < 2 ? 0 : gone);
      frames.add({0.1 * i, name, ""});
    }
    return nlohmann::json::parse(make_view(folder_.string(), {units_of("SI"), {"bar"}, {}}, 4'000'000)->json);
  };
  EXPECT_FALSE(view_of(0, xdmf_format())["scenes"][0].contains("changes"));
  const auto json = view_of(1, xdmf_format());
  EXPECT_EQ(view_of(1, vtu_format()), json);
  const auto& scene = json["scenes"][0];
  EXPECT_EQ(scene["changes"], true);
  const auto nodes = scene["nodes"].get<std::size_t>(), cells = scene["cells"].get<std::size_t>(),
             triangles = scene["triangles"].get<std::size_t>();
  ASSERT_EQ(triangles, 2U * (14 + 1));
  const std::string bytes = decoded(json["data"]);
  std::size_t place = 3 * 2 * nodes + 4 * nodes + 4 * cells + 2 * cells + 4 * 4 * triangles + triangles;
  const std::vector<std::uint32_t> from = unpacked(bytes, place, triangles, 2);
  const std::vector<std::uint32_t> until = unpacked(bytes, place + 2 * triangles, triangles, 2);
  EXPECT_EQ(std::count(from.begin(), from.end(), 2U), 2);       // the face behind
  EXPECT_EQ(std::count(from.begin(), from.end(), 0U), 2 * 14);  // the others
  EXPECT_EQ(std::count(until.begin(), until.end(), 2U), 2 * 5);
  EXPECT_EQ(std::count(until.begin(), until.end(), 3U), 2 * 10);  // to the end
}

// Both numbers have two bytes each, whatever stands behind them: here the greatest displacement, since the bar begins
// at the far end of its way.
TEST_F(ViewFrames, AViewHasTwoBytesForTheFramesOfATriangle) {
  StructuredBlock b;
  b.size = {1.0, 1.0, 3.0};
  b.divisions = {1, 1, 3};
  const Mesh mesh = make_structured_blocks({b});
  FrameIndex frames(folder_.string(), vtu_format());
  for (int i = 0; i < 3; ++i) {
    const std::string name = fmt::format("fields/{:06}.vtu", i);
    write_frame(path(name), mesh, 0.01 * (2 - i), i < 2 ? 0 : 1);
    frames.add({0.1 * i, name, ""});
  }
  const auto json = nlohmann::json::parse(make_view(folder_.string(), {units_of("SI"), {"bar"}, {}}, 4'000'000)->json);
  const auto& scene = json["scenes"][0];
  const auto nodes = scene["nodes"].get<std::size_t>(), cells = scene["cells"].get<std::size_t>(),
             triangles = scene["triangles"].get<std::size_t>();
  const std::string bytes = decoded(json["data"]);
  const std::size_t place = 3 * 2 * nodes + 4 * nodes + 4 * cells + 2 * cells + 4 * 4 * triangles + triangles;
  const std::vector<std::uint32_t> from = unpacked(bytes, place, triangles, 2);
  const std::vector<std::uint32_t> until = unpacked(bytes, place + 2 * triangles, triangles, 2);
  const std::vector<std::uint32_t> along_x = unpacked(bytes, place + 4 * triangles, nodes, 2);
  for (std::size_t t = 0; t < triangles; ++t) {
    EXPECT_LE(from[t], 2U);
    EXPECT_TRUE(until[t] == 2U || until[t] == 3U) << until[t];
  }
  EXPECT_GT(along_x.at(0), 65000U);  // of 65535
}

}  // namespace
}  // namespace carom::view_frames_test
