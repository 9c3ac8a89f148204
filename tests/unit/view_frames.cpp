#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "cell_meshes.hpp"
#include "mesh/structured_block.hpp"
#include "output/pvd.hpp"
#include "output/results_folder.hpp"
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

VtuCells cells_of(const CellBlock& block) {
  VtuCells cells;
  for (std::size_t k = 0; k < block.size(); ++k) cells.add(block.nodes(static_cast<Index>(k)), block.type);
  return cells;
}

/// A cube that moves by `t` along x; a scalar of the nodes that is their z, and one of the cells that is their number.
void write_frame(const std::string& path, const Mesh& mesh, double t) {
  const CellBlock& block = solids(mesh);
  std::vector<double> displacement(3 * mesh.node_count());
  std::vector<float> height, cell;
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    displacement[3 * n] = t;
    height.push_back(static_cast<float>(mesh.coordinates[n][2]));
  }
  for (std::size_t k = 0; k < block.size(); ++k) cell.push_back(static_cast<float>(k));
  const std::vector<VtuField> points{
      {"node_number", 1, mesh.node_numbers}, {"displacement", 3, displacement}, {"height", 1, height}};
  const std::vector<VtuField> of_cells{{"cell_number", 1, block.file_numbers},
                                       {"part", 1, std::vector<Index>(block.size(), 0)},
                                       {"stress", 6, std::vector<float>(6 * block.size(), 1.0F)},
                                       {"of cell", 1, cell}};
  write_vtu(path, mesh.coordinates, cells_of(block), points, of_cells);
}

TEST_F(ViewFrames, AreReadAsTheyWereWritten) {
  for (const CellType type :
       {CellType::hexa8, CellType::tetra10, CellType::hexa20, CellType::hexa27, CellType::penta15}) {
    const Mesh mesh = cube(2, type);
    write_frame(path("a.vtu"), mesh, 0.5);
    const FrameFile frame(path("a.vtu"));
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
    PvdCollection frames(path("fields.pvd"));
    for (int i = 0; i < 40; ++i) {
      const std::string name = fmt::format("fields/{:06}.vtu", i);
      write_frame(path(name), mesh, 0.01 * i * i);
      frames.add(0.1 * i, name);
    }
  }
  const ViewLabels labels{units_of("SI"), {"cube"}, {}};
  const std::optional<View> whole = make_view(folder_.string(), labels, 4'000'000);
  ASSERT_TRUE(whole.has_value());
  const auto json = nlohmann::json::parse(whole->json);
  EXPECT_EQ(json["times"].size(), 40U);
  EXPECT_EQ(json["scenes"][0]["nodes"], 13 * 13 * 13 - 11 * 11 * 11);
  EXPECT_EQ(json["scenes"][0]["parts"], nlohmann::json::array({"cube"}));
  for (const std::size_t most : {50'000U, 20'000U, 10'000U}) {
    const std::optional<View> small = make_view(folder_.string(), labels, most);
    ASSERT_TRUE(small.has_value());
    EXPECT_LE(small->json.size(), most);
    EXPECT_NE(small->note, whole->note);  // what has been left out is said
  }
  EXPECT_FALSE(make_view((folder_ / "none").string(), labels, 1000).has_value());
}

}  // namespace
}  // namespace carom::view_frames_test
