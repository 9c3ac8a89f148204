// Rigid surfaces of faces that are finer than the cells they meet.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "run_fixture.hpp"

namespace carom::run_rigid_surfaces_test {
namespace {

using namespace test;

/// A cube of one cell, side 1 and mass 1000, falls at 1 m/s on a rigid punch of side 0.2 that none of its nodes meets.
std::string on_punch(const std::string& scheme, bool is_plane) {
  const std::string kind = is_plane ? "kind = \"quad\"\n" : "";
  const auto numbers = [&](const char* plane, const char* solid) { return is_plane ? plane : solid; };
  return fmt::format(R"(units = "SI"
[mesh]
unused = "ignore"
[[mesh.block]]
{0}origin = [-0.5, 0.0, {1}]
size = {2}
divisions = {3}
groups = {{ cells = "BLOCK", ymin = "FOOT" }}
[[mesh.block]]
{0}origin = [-0.1, -0.31, {4}]
size = {5}
divisions = {3}
groups = {{ cells = "PUNCH", xmin = "SKIN", xmax = "SKIN", ymax = "SKIN" }}
[materials.stuff]
law = "linear_elastic"
E = 1.0e9
nu = 0.3
rho = 1000.0
[[part]]
name = "block"
cells = "BLOCK"
material = "stuff"
section = "{6}"
[[initial]]
part = "block"
velocity = [0.0, -1.0, 0.0]
[[contact]]
name = "punch"
kind = "surface"
group = "FOOT"
surface = "SKIN"
[scheme]
{7}
end = 0.03
[output]
fields = []
)",
                     kind, is_plane ? 0.0 : -0.5, numbers("[1.0, 1.0]", "[1.0, 1.0, 1.0]"),
                     numbers("[1, 1]", "[1, 1, 1]"), is_plane ? 0.0 : -0.1, numbers("[0.2, 0.3]", "[0.2, 0.3, 0.2]"),
                     is_plane ? "plane_strain" : "solid", scheme);
}

// The block is stopped, 1000 N s, and thrown back with what is left of its energy: at most as much again, and a quarter
// of a per cent more where half a per cent of energy gained is still good.
TEST(RigidSurfaces, StopFacesThatTheyMeetBetweenNodes) {
  for (const bool is_plane : {true, false}) {
    for (const char* scheme : {"kind = \"central_differences\"\n[time]", "kind = \"newmark\"\n[time]\nstep = 1e-4"}) {
      const TemporaryCase run(on_punch(scheme, is_plane));
      EXPECT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
      const double impulse = last_row(run.result("contact.csv")).at("punch.impulse_y");
      EXPECT_GT(impulse, 1000.0) << scheme << is_plane;
      EXPECT_LT(impulse, 2002.5) << scheme << is_plane;
      EXPECT_NEAR(last_row(run.result("energy.csv")).at("momentum_y"), impulse - 1000.0, 1e-6) << scheme << is_plane;
    }
  }
}

/// A block of 3 x 2 cells that is pressed with 1e6 on a rigid floor ten times as wide, of one face and of seven.
std::string on_floor(int faces) {
  return fmt::format(R"(units = "SI"
[mesh]
unused = "ignore"
[[mesh.block]]
kind = "quad"
origin = [0.0, 0.0, 0.0]
size = [1.0, 1.0]
divisions = [3, 2]
groups = {{ cells = "BLOCK", ymin = "FOOT", ymax = "HEAD", xmin = "LEFT" }}
[[mesh.block]]
kind = "quad"
origin = [-4.0, -1.0, 0.0]
size = [10.0, 1.0]
divisions = [{}, 1]
groups = {{ cells = "FLOOR", ymax = "TOP", xmin = "TOP", xmax = "TOP" }}
[materials.stuff]
law = "linear_elastic"
E = 1.0e9
nu = 0.3
rho = 1000.0
[[part]]
name = "block"
cells = "BLOCK"
material = "stuff"
section = "plane_strain"
[[support]]
nodes = "LEFT"
blocked = ["x"]
[[load]]
group = "HEAD"
pressure = 1.0e6
[[contact]]
name = "floor"
kind = "surface"
group = "FOOT"
surface = "TOP"
stiffness = 1.0e9
[scheme]
kind = "statics"
enforcement = "penalty"
[time]
step = 1.0
end = 1.0
[output]
fields = []
)",
                     faces);
}

// Springs of 1e9 per area under a uniform pressure of 1e6 are pressed by 1e-3, wherever the faces of the floor end. The
// equations are solved to 1e-8 of their forces.
TEST(RigidSurfaces, CarryAUniformPressure) {
  for (const int faces : {1, 7}) {
    const TemporaryCase run(on_floor(faces));
    EXPECT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
    const auto contact = last_row(run.result("contact.csv"));
    EXPECT_NEAR(contact.at("floor.force_y"), 1e6, 0.1) << faces;
    EXPECT_NEAR(contact.at("floor.penetration"), 1e-3, 1e-10) << faces;
    EXPECT_EQ(contact.at("floor.closed"), 4.0) << faces;
  }
}

/// A cube, side 1 and mass 1000, that falls at 1 m/s on a rigid floor of a deck; in the plane along y.
std::string on_floor_of_deck(const std::string& wall, const std::string& contact, bool is_plane = false) {
  const std::string cube =
      is_plane ? "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n11,0,0\n*ELEMENT, TYPE=CPE4, ELSET=CUBE\n1,1,2,3,4\n"
               : "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n11,-1,-1,-1e-3\n"
                 "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1,1,2,3,4,5,6,7,8\n";
  return cube + "*NSET, NSET=ALL, ELSET=CUBE\n*SURFACE, NAME=FOOT\nCUBE, S1\n" + wall +
         "*MATERIAL, NAME=STUFF\n*ELASTIC\n1e9, 0.3\n*DENSITY\n1000.\n*SOLID SECTION, ELSET=CUBE, MATERIAL=STUFF\n"
         "*BOUNDARY\n11, 1, 6\n*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, " +
         (is_plane ? "2" : "3") + ", -1.\n*STEP\n*DYNAMIC, EXPLICIT\n, 0.02\n" + contact + "*END STEP\n";
}

void expect_rebound(const std::string& deck, const std::string& contact, const std::string& axis = "z") {
  const TemporaryCase run(deck);
  EXPECT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
  const double impulse = last_row(run.result("contact.csv")).at(contact + ".impulse_" + axis);
  EXPECT_GT(impulse, 1000.0) << contact;
  EXPECT_LT(impulse, 2002.5) << contact;  // as above
}

const std::string two_faces =
    "*NODE\n12,0.4,-1,-1e-3\n13,2,-1,-0.2\n14,-1,2,-1e-3\n15,0.4,2,-1e-3\n16,2,2,-0.2\n"
    "*ELEMENT, TYPE=R3D4, ELSET=WALL\n2,11,12,15,14\n3,12,13,16,15\n"
    "*SURFACE, NAME=FLOOR\nWALL, SPOS\n*RIGID BODY, ELSET=WALL, REF NODE=11\n";
const std::string pair = "*CONTACT PAIR\nFOOT, FLOOR\n";  // without an interaction: no friction
const std::string general = "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n";

/// Two faces that are sides of no cell and meet in a fold.
TEST(RigidSurfaces, OfDecksAreMetByPairsWithoutAnInteraction) {
  expect_rebound(on_floor_of_deck(two_faces, pair), "FOOT on FLOOR");
}

/// General contact meets them from the side where the cube is, whichever way their nodes go.
TEST(RigidSurfaces, OfDecksAreMetByGeneralContact) {
  const std::string name = "general contact on WALL (rigid)";
  expect_rebound(on_floor_of_deck(two_faces, general), name);
  std::string turned = two_faces;
  for (const auto& [from, to] :
       {std::pair("2,11,12,15,14", "2,11,14,15,12"), std::pair("3,12,13,16,15", "3,12,15,16,13")})
    turned.replace(turned.find(from), std::string(from).size(), to);
  expect_rebound(on_floor_of_deck(turned, general), name);
}

/// A profile that goes to the right has its outward normal upwards: as a line, along y, and around z. Of a cylinder the
/// local z-axis points against the generator (Abaqus keyword *SURFACE; TexGen writes its plates so).
TEST(RigidSurfaces, OfDecksMayBeAnalytical) {
  const std::string body = "*RIGID BODY, ANALYTICAL SURFACE=FLOOR, REF NODE=11\n";
  const std::string cylinder =
      "*SURFACE, TYPE=CYLINDER, NAME=FLOOR\n0,0,0,1,0,0\n0,1,0\nSTART,-5,-1e-3\nLINE,5,-1e-3\n" + body;
  const std::string revolution =
      "*SURFACE, TYPE=REVOLUTION, NAME=FLOOR\n0,0,0,0,0,1\nSTART,0,-1e-3\nLINE,5,-1e-3\n" + body;
  const std::string segments = "*SURFACE, TYPE=SEGMENTS, NAME=FLOOR\nSTART,-5,-1e-3\nLINE,5,-1e-3\n" + body;
  expect_rebound(on_floor_of_deck(cylinder, pair), "FOOT on FLOOR");
  expect_rebound(on_floor_of_deck(revolution, pair), "FOOT on FLOOR");
  expect_rebound(on_floor_of_deck(segments, pair, true), "FOOT on FLOOR", "y");
  expect_rebound(on_floor_of_deck(cylinder, general), "general contact on FLOOR");
}

}  // namespace
}  // namespace carom::run_rigid_surfaces_test
