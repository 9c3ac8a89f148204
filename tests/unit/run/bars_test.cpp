// Bars that touch obstacles with their sides: a cable over a drum, a falling bar.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "run_fixture.hpp"

namespace carom::run_bars_test {
namespace {

using namespace test;

constexpr double drum = 0.5, radius = 0.02;  // of the drum, and of the cable
constexpr double inset = 2e-8;               // of its nodes, which begin on the drum and not beside it
constexpr int pieces = 16, hanging = 3;      // bars on half of the drum, and below it on either side
constexpr double half_kink = 0.5 * std::numbers::pi / pieces;

/// A cable of bars over the upper half of the drum around the y axis, in a mesh file; both of its ends hang down.
class CableMesh {
 public:
  CableMesh() : file_(std::filesystem::temp_directory_path() / fmt::format("carom_cable_{}.msh", getpid())) {
    const double r = drum + radius - inset, length = 2.0 * r * std::sin(half_kink);
    std::vector<Vec3> x;
    for (int k = hanging; k > 0; --k) x.push_back({-r, 0.0, -k * length});
    for (int k = 0; k <= pieces; ++k) {
      const double angle = std::numbers::pi * (1.0 - static_cast<double>(k) / pieces);
      x.push_back({r * std::cos(angle), 0.0, r * std::sin(angle)});
    }
    for (int k = 1; k <= hanging; ++k) x.push_back({r, 0.0, -k * length});
    std::ofstream out(file_);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"CABLE\"\n0 2 \"LEFT\"\n0 3 "
           "\"RIGHT\"\n0 4 \"TOP\"\n0 5 \"HANGING\"\n$EndPhysicalNames\n$Nodes\n"
        << x.size() << "\n";
    for (std::size_t n = 0; n < x.size(); ++n)
      out << fmt::format("{} {:.17g} {:.17g} {:.17g}\n", n + 1, x[n][0], x[n][1], x[n][2]);
    std::vector<std::string> cells;
    const auto point = [&](int group, std::size_t n) { cells.push_back(fmt::format("15 2 {} 1 {}", group, n)); };
    for (std::size_t n = 1; n < x.size(); ++n) cells.push_back(fmt::format("1 2 1 1 {} {}", n, n + 1));
    point(2, 1);
    point(3, x.size());
    point(4, static_cast<std::size_t>(hanging + pieces / 2 + 1));
    for (std::size_t k = 1; k <= hanging; ++k) {
      point(5, k);
      point(5, x.size() + 1 - k);
    }
    out << "$EndNodes\n$Elements\n" << cells.size() << "\n";
    for (std::size_t k = 0; k < cells.size(); ++k) out << k + 1 << " " << cells[k] << "\n";
    out << "$EndElements\n";
  }
  ~CableMesh() { std::filesystem::remove(file_); }
  CableMesh(const CableMesh&) = delete;
  CableMesh& operator=(const CableMesh&) = delete;
  std::string file() const { return file_.string(); }

 private:
  std::filesystem::path file_;
};

constexpr double E = 1e9, area = std::numbers::pi * radius * radius;

std::string cable(const CableMesh& mesh, const std::string& contact, const std::string& rest) {
  return fmt::format(R"(units = "SI"
[mesh]
file = "{}"
[materials.rope]
law = "neo_hookean"
E = {}
nu = 0.0
rho = 1000.0
[[part]]
name = "cable"
cells = "CABLE"
material = "rope"
section = "bar"
area = {:.17g}
[[support]]
nodes = "CABLE"
blocked = ["y"]
[[support]]
nodes = "HANGING"
blocked = ["x"]
[[spring]]
nodes = "CABLE"
stiffness = [10.0, 0.0, 10.0]
[[contact]]
name = "drum"
kind = "cylinder"
group = "CABLE"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
radius = {}
{}
[functions.ramp]
time = [0.0, 1.0]
value = [0.0, 1.0]
{}
)",
                     mesh.file(), E, area, drum, contact, rest);
}

// Statics asks for bodies that are stiff without contact: springs of 10 N/m hold the chain, and bear 1e-4 of the
// weights. Without friction the tension is the same all along: that of the hanging ends over the cosine of half a kink,
// since the drum presses on the last node of the half sideways alone. The drum bears both weights.
TEST(CableOverADrum, BearsItsWeightsAtTheSumOfTheRadii) {
  const CableMesh mesh;
  const double weight = 1e3;
  for (const char* enforcement : {"penalty", "lagrange", "augmented_lagrangian"}) {
    SCOPED_TRACE(enforcement);
    const TemporaryCase one(cable(mesh, "",
                                  fmt::format(R"([[support]]
nodes = "TOP"
blocked = ["x"]
[[load]]
group = "LEFT"
force = [0.0, 0.0, -{0}]
function = "ramp"
[[load]]
group = "RIGHT"
force = [0.0, 0.0, -{0}]
function = "ramp"
[scheme]
kind = "statics"
enforcement = "{1}"
[time]
end = 1.0
step = 0.25
[[probe]]
name = "top"
group = "TOP"
quantities = ["displacement"]
)",
                                              weight, enforcement)));
    ASSERT_EQ(one.run(), ExitCode::good) << one.result("summary.json") << one.result("run.log");
    const auto contact = last_row(one.result("contact.csv")), probes = last_row(one.result("probes.csv"));
    const double tension = weight / std::cos(half_kink);
    EXPECT_NEAR(contact.at("drum.force_z"), 2.0 * weight, 2e-4 * weight);
    EXPECT_NEAR(contact.at("drum.force_x"), 0.0, 1e-6 * weight);
    const double press = 2.0 * tension * std::sin(half_kink);  // of a node
    const double length = 2.0 * (drum + radius) * std::sin(half_kink), stiffness = E * area / length;
    const double sinks = std::string(enforcement) == "penalty" ? press / stiffness : 0.0;
    // Bars stretch by 8e-4, which turns the kinks by as much.
    EXPECT_NEAR(probes.at("top.displacement_z"), inset - sinks, 2e-3 * press / stiffness);
  }
}

// One end is drawn down until all of it slides: the tensions are as e^(mu pi) (Euler and Eytelwein), for a polygon as
// the product over its kinks, which is 0.5 mu half_kink^2 pi off at most.
TEST(CableOverADrum, HoldsByFrictionAsTheCapstanEquationSays) {
  const CableMesh mesh;
  const double weight = 1e3, mu = 0.3;
  const TemporaryCase one(cable(mesh, fmt::format("friction = {}", mu),
                                fmt::format(R"([[load]]
group = "LEFT"
force = [0.0, 0.0, -{0}]
function = "ramp"
[functions.draw]
time = [0.0, 1.0, 2.0]
value = [0.0, 0.0, 1.0]
[[support]]
nodes = "RIGHT"
displacement = {{ z = -0.02, function = "draw" }}
[scheme]
kind = "statics"
[time]
end = 2.0
step = 0.05
)",
                                            weight)));
  ASSERT_EQ(one.run(), ExitCode::good) << one.result("summary.json") << one.result("run.log");
  const auto contact = last_row(one.result("contact.csv"));
  const double drawn = contact.at("drum.force_z") - weight;
  EXPECT_NEAR(drawn / weight, std::exp(mu * std::numbers::pi), 0.01 * std::exp(mu * std::numbers::pi));
}

/// A level bar, 0.5 above a plate, that falls at 10 m/s.
std::string falling(const std::string& obstacle, const std::string& scheme) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
kind = "bar"
origin = [0.0, 0.0, 0.5]
end = [1.0, 0.0, 0.5]
divisions = 4
groups = {{ cells = "BAR" }}
[materials.s]
law = "linear_elastic"
E = 1e8
nu = 0.0
rho = 1000.0
[[part]]
name = "bar"
cells = "BAR"
material = "s"
section = "bar"
area = {:.17g}
[[initial]]
part = "bar"
velocity = [0.0, 0.0, -10.0]
[[contact]]
name = "plate"
group = "BAR"
{}
[scheme]
{}
[time]
end = 0.1
step = 2e-5
[[probe]]
name = "bar"
group = "BAR"
quantities = ["displacement", "velocity"]
)",
                     area, obstacle, scheme);
}

// It touches when its side does, and rebounds as fast as it came: its nodes bounce together, without strain.
TEST(FallingBar, ReboundsFromAPlateAtItsRadius) {
  const TemporaryCase one(falling("kind = \"plane\"\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]\n",
                                  "kind = \"central_differences\""));
  ASSERT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
  const auto probes = read_csv(one.result("probes.csv"));
  const auto force = column(one.result("contact.csv"), "plate.force_z");
  const auto& time = probes.at("time");
  std::size_t first = 0;
  while (first < force.size() && force[first] == 0.0) ++first;
  ASSERT_LT(first, force.size());
  EXPECT_GE(time[first], (0.5 - radius) / 10.0 * (1.0 - 1e-12));
  EXPECT_LE(time[first - 1], (0.5 - radius) / 10.0);
  EXPECT_NEAR(probes.at("bar.velocity_z").back(), 10.0,
              0.01);  // of contact that begins and ends within steps, a fortieth of its vibration long
}

// A free plate takes over what the bar loses, but for rounding: as after an elastic impact by springs, and by impulses,
// which stop the nodes at the plate (all of it is then a loss, which no verdict likes), with the common velocity.
TEST(FallingBar, GivesItsMomentumToAFreePlate) {
  const double mass = 1000.0 * area, plate = 2.0, common = -10.0 * mass / (mass + plate);
  // Springs: of contact that begins and ends within steps.
  for (const auto& [scheme, expected, tolerance] :
       {std::tuple{"central_differences", 2.0 * common, 1e-3}, {"cd_lagrange", common, 1e-9}}) {
    SCOPED_TRACE(scheme);
    const TemporaryCase one(falling("kind = \"box\"\nlower = [-1.0, -1.0, -0.1]\nupper = [2.0, 1.0, 0.0]\nmass = 2.0\n",
                                    fmt::format("kind = \"{}\"", scheme)));
    EXPECT_LE(one.run(), ExitCode::verdict_failed) << one.result("summary.json");
    const auto momentum = column(one.result("energy.csv"), "momentum_z");
    for (const double p : momentum) EXPECT_NEAR(p / (-10.0 * mass), 1.0, 1e-12);
    EXPECT_NEAR(last_row(one.result("contact.csv")).at("plate.velocity_z"), expected, tolerance);
  }
}

/// Two bars that cross at right angles, the upper one falling on the middle of the lower one at 5 m/s.
std::string crossing(const std::string& lower, const std::string& contact, const std::string& rest) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
kind = "bar"
origin = [-0.5, 0.0, 0.0]
end = [0.5, 0.0, 0.0]
divisions = 5
groups = {{ cells = "LOW" }}
[[mesh.block]]
kind = "bar"
origin = [0.0, -0.5, 0.041]
end = [0.0, 0.5, 0.041]
divisions = 3
groups = {{ cells = "HIGH" }}
[materials.s]
law = "neo_hookean"
E = 1e8
nu = 0.0
rho = 1000.0
[[part]]
name = "low"
cells = "LOW"
material = "s"
section = "bar"
area = {0:.17g}
[[part]]
name = "high"
cells = "HIGH"
material = "s"
section = "bar"
area = {0:.17g}
{1}
[[contact]]
name = "bars"
{2}
{3}
)",
                     area, lower, contact, rest);
}

// Bars without bending stiffness fly on folded; nothing comes from outside, and little is lost to rounding. The gap is
// 1 mm: they touch when the axes are the sum of the radii apart.
TEST(CrossingBars, KeepMomentumItsMomentAndEnergy) {
  for (const char* contact :
       {"kind = \"pair\"\ngroup = \"HIGH\"\nmaster = \"LOW\"\n", "kind = \"self\"\ngroup = \"all\"\n"}) {
    SCOPED_TRACE(contact);
    const TemporaryCase one(crossing("[[initial]]\npart = \"high\"\nvelocity = [0.0, 0.0, -5.0]\n", contact,
                                     "[scheme]\nkind = \"central_differences\"\n[time]\nend = 4e-3\nstep = 4e-6\n"));
    ASSERT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
    const auto energy = read_csv(one.result("energy.csv"));
    const double momentum = -5.0 * 1000.0 * area, kinetic = 12.5 * 1000.0 * area;
    for (std::size_t k = 0; k < energy.at("time").size(); ++k) {
      EXPECT_NEAR(energy.at("momentum_z")[k] / momentum, 1.0, 1e-12);
      EXPECT_NEAR(energy.at("angular_momentum_error")[k] / momentum, 0.0, 1e-12);
      EXPECT_LT(std::abs(energy.at("imbalance")[k]), 0.005 * kinetic);  // what a good run may gain
    }
    const auto force =
        column(one.result("contact.csv"),
               std::string(contact).find("self") == std::string::npos ? "bars.force_z" : "bars.high_on_low.force_z");
    std::size_t first = 0;
    while (first < force.size() && force[first] == 0.0) ++first;
    ASSERT_LT(first, force.size());
    EXPECT_NEAR(energy.at("time")[first], 0.001 / 5.0, 4e-6 * (1.0 + 1e-9));  // a step
  }
}

// The upper bar, of one cell that is held by its supports to move as a whole, is pressed on the lower one that is held:
// it rests where the axes are the sum of the radii apart, and the lower one bears the force.
TEST(CrossingBars, RestAtTheSumOfTheirRadii) {
  std::string text = crossing(
      "[[support]]\nnodes = \"LOW\"\nblocked = [\"x\", \"y\", \"z\"]\n[[support]]\nnodes = \"HIGH\"\nblocked = "
      "[\"x\", \"y\"]\n[[spring]]\nnodes = \"HIGH\"\nstiffness = [0.0, 0.0, 1e3]\n",
      "kind = \"pair\"\ngroup = \"HIGH\"\nmaster = \"LOW\"\n",
      "[[load]]\ngroup = \"HIGH\"\nforce = [0.0, 0.0, -10.0]\n[scheme]\nkind = \"statics\"\nenforcement = "
      "\"lagrange\"\n[time]\nend = 1.0\nstep = 0.5\n[[probe]]\nname = \"high\"\ngroup = \"HIGH\"\nquantities = "
      "[\"displacement\"]\n");
  text.replace(text.find("divisions = 3"), 13, "divisions = 1");
  text.replace(text.find("name = \"bars\"\n"), 14, fmt::format("name = \"bars\"\nbar_radius = {}\n", radius));
  const TemporaryCase one(text);
  ASSERT_EQ(one.run(), ExitCode::good) << one.result("summary.json") << one.result("run.log");
  const auto contact = last_row(one.result("contact.csv")), probes = last_row(one.result("probes.csv"));
  // Two nodes, 10 N and a spring of 1e3 N/m each, the middle of which has sunk by the gap of 1 mm.
  EXPECT_NEAR(probes.at("high.displacement_z"), -1e-3, 1e-9);
  EXPECT_NEAR(contact.at("bars.force_z"), 2.0 * (10.0 - 1.0), 1e-6);
}

}  // namespace
}  // namespace carom::run_bars_test
