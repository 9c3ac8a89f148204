// Checkpoint files: what comes back, equal files of equal values, and every kind of damage with its message.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "base/checksum.hpp"
#include "base/errors.hpp"
#include "output/checkpoint_file.hpp"

namespace carom::output_checkpoint_test {
namespace {

namespace fs = std::filesystem;

enum class Colour : std::uint8_t { red, blue };

struct Point {
  double x = 0.0;
  std::array<double, 3> normal{};
  Colour colour{};
  std::string name;
  friend bool operator==(const Point&, const Point&) = default;
};
template <class A>
void fields(A& archive, Point& p) {
  archive("x", p.x);
  archive("normal", p.normal);
  archive("colour", p.colour);
  archive("name", p.name);
}

struct Square {
  std::vector<double> sides;
  friend bool operator==(const Square&, const Square&) = default;
};
template <class A>
void fields(A& archive, Square& s) {
  archive("sides", s.sides);
}

/// One member of every kind.
struct Everything {
  double number = 0.0;
  int whole = 0;
  bool flag = false;
  Colour colour{};
  std::string text;
  std::vector<double> numbers;
  std::vector<std::array<std::array<double, 3>, 2>> blocks;
  std::vector<std::int32_t> indices;
  std::vector<bool> flags;
  std::vector<Colour> colours;
  std::vector<std::string> texts;
  std::vector<Point> points;
  std::optional<Point> maybe, never;
  std::variant<std::monostate, Point, Square> kind;
  std::shared_ptr<const Square> shared, nobody;
};
template <class A>
void fields(A& archive, Everything& e) {
  archive("number", e.number);
  archive("whole", e.whole);
  archive("flag", e.flag);
  archive("colour", e.colour);
  archive("text", e.text);
  archive("numbers", e.numbers);
  archive("blocks", e.blocks);
  archive("indices", e.indices);
  archive("flags", e.flags);
  archive("colours", e.colours);
  archive("texts", e.texts);
  archive("points", e.points);
  archive("maybe", e.maybe);
  archive("never", e.never);
  archive("kind", e.kind);
  archive("shared", e.shared);
  archive("nobody", e.nobody);
}

Everything some_of_everything() {
  Everything e;
  e.number = 0.1;
  e.whole = -7;
  e.flag = true;
  e.colour = Colour::blue;
  e.text = "a line\nand \"another\", \u00e9";
  e.numbers = {1.0 / 3.0, -0.0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::infinity()};
  e.blocks = {{{{1, 2, 3}, {4, 5, 6}}}, {{{7, 8, 9}, {10, 11, 12}}}};
  e.indices = {3, -1, 2147483647};
  e.flags = {true, false, true};
  e.colours = {Colour::blue, Colour::red};
  e.texts = {"", "one", "two"};
  e.points = {{1.5, {1, 0, 0}, Colour::blue, "p"}, {2.5, {0, 1, 0}, Colour::red, ""}};
  e.maybe = e.points[1];
  e.kind = Square{{2.0, 3.0}};
  e.shared = std::make_shared<const Square>(Square{{4.0}});
  return e;
}

const CheckpointInfo info{"1.2.3", "GCC 12", "v3", 0x0123456789abcdefU, 42, 43, 8, 17, 0.1};

std::string bytes_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class CheckpointFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(Everything e, const char* name = "a.h5") const {
    const std::string path = (folder_ / name).string();
    write_checkpoint(path, info, [&](Archive& archive) { fields(archive, e); });
    return path;
  }
  /// The message that a file of these bytes is refused with; "" where it is not.
  std::string refusal(const std::string& bytes) const {
    const std::string path = (folder_ / "damaged.h5").string();
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      verify_checkpoint(path);
    } catch (const CheckpointError& e) {
      return e.what();
    }
    return {};
  }

  fs::path folder_ = fs::temp_directory_path() / fmt::format("carom_checkpoint_{}", ::getpid());
};

// The check value of the catalogue of CRC algorithms (CRC-64/XZ, as in the .xz file format).
TEST(Checksum, IsThatOfTheCatalogue) {
  EXPECT_EQ(checksum("123456789"), 0x995dc9bbdf1939faU);
  EXPECT_EQ(checksum("6789", checksum("12345")), checksum("123456789"));
}

TEST_F(CheckpointFile, GivesEveryKindOfValueBack) {
  const Everything out = some_of_everything();
  const std::string path = write(out);
  const CheckpointInfo found = verify_checkpoint(path);
  EXPECT_EQ(found.version, info.version);
  EXPECT_EQ(found.compiler, info.compiler);
  EXPECT_EQ(found.isa, info.isa);
  EXPECT_EQ(found.case_digest, info.case_digest);
  EXPECT_EQ(found.mesh_digest, info.mesh_digest);
  EXPECT_EQ(found.bodies_digest, info.bodies_digest);
  EXPECT_EQ(found.nodes, info.nodes);
  EXPECT_EQ(found.step, info.step);
  EXPECT_EQ(found.time, info.time);

  Everything in;
  in.never.emplace();
  in.nobody = std::make_shared<const Square>();
  in.points.resize(5);
  read_checkpoint(path, [&](Archive& archive) { fields(archive, in); });
  EXPECT_EQ(in.number, out.number);
  EXPECT_EQ(in.whole, out.whole);
  EXPECT_EQ(in.flag, out.flag);
  EXPECT_EQ(in.colour, out.colour);
  EXPECT_EQ(in.text, out.text);
  EXPECT_EQ(in.numbers, out.numbers);
  EXPECT_TRUE(std::signbit(in.numbers[1]));
  EXPECT_EQ(in.blocks, out.blocks);
  EXPECT_EQ(in.indices, out.indices);
  EXPECT_EQ(in.flags, out.flags);
  EXPECT_EQ(in.colours, out.colours);
  EXPECT_EQ(in.texts, out.texts);
  EXPECT_EQ(in.points, out.points);
  EXPECT_EQ(in.maybe, out.maybe);
  EXPECT_FALSE(in.never.has_value());
  EXPECT_EQ(in.kind, out.kind);
  ASSERT_NE(in.shared, nullptr);
  EXPECT_EQ(*in.shared, *out.shared);
  EXPECT_EQ(in.nobody, nullptr);
}

TEST_F(CheckpointFile, OfEqualValuesAreEqual) {
  EXPECT_EQ(bytes_of(write(some_of_everything(), "a.h5")), bytes_of(write(some_of_everything(), "b.h5")));
}

TEST_F(CheckpointFile, LeavesNothingBesideWhenItCannotBeWritten) {
  EXPECT_THROW(write_checkpoint((folder_ / "none" / "a.h5").string(), info, [](Archive&) {}), OutputError);
  const std::string path = write(some_of_everything());
  const std::string before = bytes_of(path);
  const auto fails = [](Archive& archive) {
    double x = 1.0;
    archive("x", x);
    throw std::runtime_error("in the middle");
  };
  EXPECT_THROW(write_checkpoint(path, info, fails), std::runtime_error);
  EXPECT_EQ(bytes_of(path), before);  // what was there stays
  EXPECT_FALSE(fs::exists(path + ".tmp"));
}

TEST_F(CheckpointFile, SaysWhatItDoesNotHold) {
  const std::string path = write(some_of_everything());
  const auto message = [&](const CheckpointContents& contents) -> std::string {
    try {
      read_checkpoint(path, contents);
    } catch (const CheckpointError& e) {
      return e.what();
    }
    return {};
  };
  double x = 0.0;
  int i = 0;
  std::array<double, 3> three{};
  EXPECT_NE(message([&](Archive& a) { a("length", x); }).find("it has no values of \"length\""), std::string::npos);
  EXPECT_NE(message([&](Archive& a) { a("number", three); }).find("it has 1 values of \"number\" and not 3"),
            std::string::npos);
  EXPECT_NE(message([&](Archive& a) { a("number", i); }).find("\"number\" is of another type"), std::string::npos);
}

// A flipped bit at any place, a cut at any length, and what else may happen to a file: thirty kinds and more.
TEST_F(CheckpointFile, EveryDamageIsSeenAndNamed) {
  const std::string good = bytes_of(write(some_of_everything()));
  ASSERT_EQ(refusal(good), "");
  ASSERT_GT(good.size(), 4096U);
  struct Damage {
    std::string what, bytes, says;
  };
  std::vector<Damage> list{{"empty", "", "it is empty"},
                           {"cut in the title", good.substr(0, 10), "cut off within its header"},
                           {"cut in the header", good.substr(0, 1000), "cut off within its header"},
                           {"header alone", good.substr(0, 1024), "it is cut off: 0 of"},
                           {"a byte short", good.substr(0, good.size() - 1), "it is cut off"},
                           {"a byte more", good + "x", "1 bytes have been added"},
                           {"twice", good + good, "bytes have been added"},
                           {"no checkpoint", std::string(5000, 'a'), "it is no checkpoint"},
                           {"zeros", std::string(good.size(), '\0'), "it is no checkpoint"},
                           {"HDF5 without header", good.substr(1024), "it is no checkpoint"},
                           {"a header of zeros", std::string(1024, '\0') + good.substr(1024), "it is no checkpoint"}};
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string bytes = good;
    bytes.replace(bytes.find(from), from.size(), to);
    return bytes;
  };
  list.push_back({"another format", replaced("format 4", "format 5"), "header is damaged"});
  list.push_back({"another version", replaced("version 1.2.3", "version 1.2.4"), "header is damaged"});
  list.push_back({"another instruction set", replaced("isa v3", "isa v4"), "header is damaged"});
  list.push_back({"another case", replaced("case 0", "case 1"), "header is damaged"});
  list.push_back({"another mesh", replaced("mesh 0", "mesh 1"), "header is damaged"});
  list.push_back({"another step", replaced("step 17", "step 18"), "header is damaged"});
  list.push_back({"another time", replaced("time 0.1", "time 0.2"), "header is damaged"});
  list.push_back({"without its sum", replaced("\nheader ", "\nfooter "), "header is damaged"});
  std::string later = good;  // whole, but of a format to come
  later.replace(later.find("format 4"), 8, "format 5");
  const std::size_t sum = later.find("\nheader ") + 1;
  later.replace(sum + 7, 16, fmt::format("{:016x}", checksum(later.substr(0, sum))));
  list.push_back({"a later format", later, "it is of format 5; this program reads format 4"});
  for (const std::size_t part : {1U, 2U, 3U}) {
    const std::size_t length = 1024 + part * (good.size() - 1024) / 4;
    list.push_back({fmt::format("cut at {}", length), good.substr(0, length), "it is cut off"});
    std::string hole = good;
    std::fill(hole.begin() + static_cast<std::ptrdiff_t>(length),
              hole.begin() + static_cast<std::ptrdiff_t>(length) + 512, '\x55');
    list.push_back({fmt::format("a sector overwritten at {}", length), hole, "its values are damaged"});
  }
  std::mt19937 random(20261122);
  for (int i = 0; i < 40; ++i) {
    const std::size_t at = random() % good.size();
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random() % 8)));
    const bool in_title = at < std::string("carom checkpoint, format ").size();
    list.push_back({fmt::format("bit at {}", at), bytes,
                    at >= 1024 ? "its values are damaged" : (in_title ? "it is no checkpoint" : "header is damaged")});
  }
  for (const std::size_t at :
       {std::size_t{0}, std::size_t{30}, std::size_t{1023}, std::size_t{1024}, good.size() - 1}) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    list.push_back({fmt::format("bit at {}", at), bytes,
                    at >= 1024 ? "its values are damaged" : (at < 25 ? "it is no checkpoint" : "header is damaged")});
  }
  EXPECT_GE(list.size(), 30U);
  for (const Damage& damage : list)
    EXPECT_NE(refusal(damage.bytes).find(damage.says), std::string::npos)
        << damage.what << ": \"" << refusal(damage.bytes) << "\" and not \"" << damage.says << "\"";
}

}  // namespace
}  // namespace carom::output_checkpoint_test
