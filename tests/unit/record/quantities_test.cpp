// Fields and curves against closed forms, and the two tables of quantities against each other.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "record/field_values.hpp"
#include "record/recorder.hpp"
#include "run_fixture.hpp"
#include "solid/cell_strain.hpp"
#include "view/frame_file.hpp"

namespace carom::run_quantities_test {
namespace {

using namespace test;

// What the table calls a field of nodes or cells can be evaluated, and nothing else.
TEST(Quantities, FieldsHaveEvaluators) {
  std::vector<std::string_view> fields, evaluated = evaluated_fields();
  for (const Quantity& q : quantities())
    if (q.place == Place::nodes || q.place == Place::cells) fields.push_back(q.name);
  std::ranges::sort(fields);
  std::ranges::sort(evaluated);
  EXPECT_EQ(fields, evaluated);
  std::vector<std::string_view> names;
  for (const Quantity& q : quantities()) names.push_back(q.name);
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

/// A block of 2 x 2 x 3 that statics pull to the length 3 (1 + e) along z and that is free across; E = 2, nu = 0.3.
std::string pulled(double e, const std::string& rest) {
  return case_of_block(fmt::format(R"([[support]]
nodes = "XMIN"
symmetry = "x"
[[support]]
nodes = "YMIN"
symmetry = "y"
[[support]]
nodes = "FOOT"
symmetry = "z"
[[support]]
nodes = "HEAD"
displacement = {{ z = {}, function = "up" }}
[functions.up]
time = [0.0, 1.0]
value = [0.0, 1.0]
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)",
                                   3.0 * e) +
                       rest);
}

/// Every value of a field at the end of the first step.
std::vector<std::vector<double>> field(const TemporaryCase& in, const std::string& name,
                                       const std::string& file = "1") {
  const FrameFile frame((in.results() / fmt::format("fields/step_{:0>6}.vtkhdf", file)).string());
  const StoredArray* found = frame.cell_field(name);
  if (found == nullptr) found = frame.point_field(name);
  if (found == nullptr) {
    ADD_FAILURE() << "no field " << name;
    return {};
  }
  std::vector<std::vector<double>> values(found->entries());
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t c = 0; c < static_cast<std::size_t>(found->components); ++c) values[i].push_back(found->at(i, c));
  return values;
}

// Uniaxial stress s = E e: principal values (s, 0, 0) or (0, 0, s), pressure -s / 3, shear |s| / 2, energy s e / 2; the
// patch test of statics, to the rounding that the factors leave.
TEST(Quantities, OfUniaxialStress) {
  for (const double e : {0.01, -0.02}) {
    const double s = 2.0 * e;
    const TemporaryCase in(pulled(
        e,
        "[output]\nprecision = \"double\"\nfields = [\"stress_at_nodes\", \"principal_stress\", \"pressure\", "
        "\"strain_energy_density\", \"von_mises\", \"maximum_shear_stress\"]\n[[probe]]\nname = \"foot\"\ngroup = \"FOOT\"\n"
        "quantities = [\"pressure\", \"principal_stress\", \"stress_at_nodes\", \"maximum_shear_stress\"]\n"));
    ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
    const auto is = [&](const std::string& name, const std::vector<double>& expected, std::size_t count) {
      const auto values = field(in, name);
      EXPECT_EQ(values.size(), count) << name;
      for (const auto& value : values) {
        ASSERT_EQ(value.size(), expected.size()) << name;
        for (std::size_t c = 0; c < value.size(); ++c) EXPECT_NEAR(value[c], expected[c], 1e-14) << name << " " << c;
      }
    };
    is("stress_at_nodes", {0.0, 0.0, s, 0.0, 0.0, 0.0}, 36);
    is("principal_stress", {std::max(s, 0.0), 0.0, std::min(s, 0.0)}, 12);
    is("maximum_shear_stress", {0.5 * std::abs(s)}, 12);
    is("pressure", {-s / 3.0}, 12);
    is("strain_energy_density", {0.5 * s * e}, 12);
    is("von_mises", {std::abs(s)}, 12);
    auto row = last_row(in.result("probes.csv"));
    EXPECT_NEAR(row["foot.pressure"], -s / 3.0, 1e-14);
    EXPECT_NEAR(row["foot.principal_stress_1"], std::max(s, 0.0), 1e-14);
    EXPECT_NEAR(row["foot.principal_stress_3"], std::min(s, 0.0), 1e-14);
    EXPECT_NEAR(row["foot.maximum_shear_stress"], 0.5 * std::abs(s), 1e-14);
    EXPECT_NEAR(row["foot.stress_at_nodes_zz"], s, 1e-14);
  }
}

// Rings of the mean radii 1.5 and 2.5 have volumes as 3 to 5, and so their stresses weigh at the nodes between them.
TEST(Quantities, MeansAtNodesWeighByVolume) {
  const TemporaryCase in(R"(units = "SI"
[[mesh.block]]
kind = "quad"
origin = [1.0, 0.0, 0.0]
size = [2.0, 1.0]
divisions = [2, 1]
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "rings"
cells = "BLOCK"
material = "soft"
section = "axisymmetric"
[[support]]
nodes = "all"
symmetry = "y"
[[support]]
nodes = "XMIN"
displacement = { x = 0.01, function = "up" }
[functions.up]
time = [0.0, 1.0]
value = [0.0, 1.0]
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
[output]
precision = "double"
fields = ["stress", "stress_at_nodes"]
)");
  ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
  const auto cells = field(in, "stress"), nodes = field(in, "stress_at_nodes");
  ASSERT_EQ(cells.size(), 2U);
  ASSERT_EQ(nodes.size(), 6U);
  EXPECT_GT(std::abs(cells[0][0] - cells[1][0]), 1e-3);  // or the weights would not be seen
  std::array<int, 3> found{};
  for (const auto& node : nodes) {
    const std::array expected{cells[0][0], (3.0 * cells[0][0] + 5.0 * cells[1][0]) / 8.0, cells[1][0]};
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(node[0] - expected[k]) < 1e-15) ++found[k];
  }
  EXPECT_EQ(found, (std::array<int, 3>{2, 2, 2}));
}

// The velocity v = L x of what is at x = X + u has the rate of strain sym L in the configuration where it is, also of a
// finite strain; a rotation w x x has none. Cells of small strain have the gradient by X. To round-off.
TEST(Quantities, StrainRateIsWhereTheCellsAre) {
  constexpr double F[3][3] = {{0.0, -1.2, 0.1}, {0.9, 0.0, 0.0}, {0.0, 0.2, 1.1}};  // a quarter turn and some strain
  constexpr double spin[3][3] = {{0.0, -3.0, 2.0}, {3.0, 0.0, -1.0}, {-2.0, 1.0, 0.0}};
  constexpr double L[3][3] = {{0.3, 0.4, 0.0}, {-0.1, 0.2, 0.6}, {0.0, 0.0, -0.5}};
  constexpr std::array<std::array<std::size_t, 2>, 6> voigt{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  for (const char* law : {"neo_hookean", "linear_elastic"}) {
    const bool is_finite = std::string(law) == "neo_hookean";
    const Simulation simulation(parse_case(
        replaced(case_of_block("[scheme]\nkind = \"newmark\"\n[time]\nend = 1.0\nstep = 0.5\n"), "linear_elastic", law),
        "case.toml"));
    for (const auto& rate : {L, spin}) {
      std::vector<double> u, v;
      for (const Vec3& X : simulation.mesh().coordinates) {
        Vec3 x{};
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t j = 0; j < 3; ++j) x[i] += F[i][j] * X[j];
          u.push_back(x[i] - X[i]);
        }
        const Vec3& at = is_finite ? x : X;
        for (std::size_t i = 0; i < 3; ++i) v.push_back(rate[i][0] * at[0] + rate[i][1] * at[1] + rate[i][2] * at[2]);
      }
      const auto strain = cell_strain_rate(simulation.model(), u, v);
      ASSERT_EQ(strain.size(), 12U);
      for (const auto& of_cell : strain)
        for (std::size_t c = 0; c < 6; ++c) {
          const auto [i, j] = voigt[c];
          EXPECT_NEAR(of_cell[c], 0.5 * (rate[i][j] + rate[j][i]), 1e-14) << law;
        }
    }
  }
}

/// Two blocks that fly and ring; `scheme` has its mass.
std::string two_bodies(const std::string& scheme) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
size = [2.0, 1.0, 1.0]
divisions = [3, 2, 1]
groups = {{ cells = "LEFT" }}
[[mesh.block]]
origin = [3.0, 0.0, 0.0]
size = [3.0, 1.0, 1.0]
divisions = [3, 1, 2]
groups = {{ cells = "RIGHT" }}
[materials.soft]
law = "st_venant_kirchhoff"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "left"
cells = "LEFT"
material = "soft"
[[part]]
name = "right"
cells = "RIGHT"
material = "soft"
[[initial]]
part = "left"
velocity_field = ["0.1 * x", "0.2 * z", "-0.1 * x * y"]
[[initial]]
part = "right"
velocity_field = ["-0.05 * x", "0.1", "0"]
[scheme]
kind = "{}"
[time]
end = 1.0
step = 0.1
[output]
fields = ["strain_rate"]
precision = "double"
[[probe]]
name = "a"
part = "left"
quantities = ["mass", "momentum", "kinetic_energy", "strain_energy"]
[[probe]]
name = "b"
part = "right"
quantities = ["mass", "momentum", "kinetic_energy", "strain_energy"]
)",
                     scheme);
}

// The bodies' energies and momenta are those of the ledger, which sums over all; consistent and lumped masses. To the
// rounding of sums in another order.
TEST(Quantities, PartsAddUpToTheLedger) {
  for (const char* scheme : {"newmark", "central_differences"}) {
    SCOPED_TRACE(scheme);
    const TemporaryCase in(two_bodies(scheme));
    ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
    Columns probes = test::read_csv(in.result("probes.csv")), energy = test::read_csv(in.result("energy.csv"));
    const std::size_t rows = energy["time"].size();
    ASSERT_EQ(probes["time"].size(), rows);
    const auto add_up = [&](const std::string& quantity, const std::string& column) {
      double largest = 0.0;
      for (std::size_t i = 0; i < rows; ++i) {
        const double a = probes["a." + quantity].at(i), b = probes["b." + quantity].at(i);
        EXPECT_NEAR(a + b, energy[column].at(i), 1e-13) << quantity << " in row " << i;
        largest = std::max(largest, std::min(std::abs(a), std::abs(b)));
      }
      EXPECT_GT(largest, 1e-4) << quantity;
    };
    add_up("kinetic_energy", "kinetic");
    add_up("strain_energy", "strain");
    add_up("momentum_x", "momentum_x");
    EXPECT_NEAR(probes["a.mass"].back(), 1.5 * 2.0, 1e-14);
    EXPECT_NEAR(probes["b.mass"].back(), 1.5 * 3.0, 1e-14);
    // v_x = 0.1 x of the left block: 0.1 times its mass times the centre at 1.
    EXPECT_NEAR(probes["a.momentum_x"].front(), 0.1 * 3.0 * 1.0, 1e-14);
    EXPECT_NEAR(field(in, "strain_rate", "0")[0][0], 0.1, 1e-14);
  }
}

// Extremes over the cells of a part are those of the fields that are written, cell by cell.
TEST(Quantities, ExtremesOfPartsAreThoseOfTheirCells) {
  std::string text = two_bodies("newmark");
  const std::string fields = "fields = [\"strain_rate\"]", asked = "quantities = [\"mass\", \"momentum\", ";
  text.replace(text.find(fields), fields.size(),
               "fields = [\"von_mises\", \"principal_stress\", \"pressure\"]\nfields_every = 5");
  for (std::size_t place = text.find(asked); place != std::string::npos; place = text.find(asked, place + 1))
    text.replace(place, asked.size(),
                 "quantities = [\"largest_von_mises\", \"largest_principal_stress\", \"smallest_principal_stress\", "
                 "\"largest_pressure\", ");
  const TemporaryCase in(text);
  ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
  Columns probes = test::read_csv(in.result("probes.csv"));
  for (const std::size_t step : {5, 10})
    for (const auto& [part, first] : {std::pair{"a", 0}, {"b", 6}}) {
      const std::string at_step = std::to_string(step), name = part;
      const auto of_part = [&](const std::string& field_name, std::size_t component) {
        std::vector<double> values;
        for (std::size_t k = 0; k < 6; ++k)
          values.push_back(field(in, field_name, at_step).at(static_cast<std::size_t>(first) + k).at(component));
        return values;
      };
      EXPECT_EQ(probes[name + ".largest_von_mises"].at(step), std::ranges::max(of_part("von_mises", 0)));
      EXPECT_EQ(probes[name + ".largest_principal_stress"].at(step), std::ranges::max(of_part("principal_stress", 0)));
      EXPECT_EQ(probes[name + ".smallest_principal_stress"].at(step), std::ranges::min(of_part("principal_stress", 2)));
      EXPECT_EQ(probes[name + ".largest_pressure"].at(step), std::ranges::max(of_part("pressure", 0)));
    }
}

TEST(Quantities, PartsWithoutSuchValuesAreRefused) {
  std::string text = two_bodies("newmark");
  text.replace(text.rfind("\"mass\""), 6, "\"largest_plastic_strain\"");
  const Simulation simulation(parse_case(text, "case.toml"));
  try {
    const RunTables tables(simulation);
    ADD_FAILURE() << "a body that does not yield has a plastic strain";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("found largest_plastic_strain of \"right\", which does not yield"),
              std::string::npos)
        << e.what();
  }
}

// Exact solutions know places, and nothing of the sums over a part.
TEST(Quantities, ExactCurvesLeaveProbesOfPartsOut) {
  const std::string exact = R"([exact]
solution = "two_bars"
axis = "x"
length = 2.0
area = 1.0
modulus = 2.0
density = 1.5
speed = 0.1
gap = 1.0
second = { length = 3.0, area = 1.0, modulus = 2.0, density = 1.5 }
[[probe]]
name = "end"
point = [2.0, 0.0, 0.0]
quantities = ["velocity"]
)";
  const Simulation simulation(parse_case(two_bodies("newmark") + exact, "case.toml"));
  const RunTables tables(simulation);
  EXPECT_EQ(tables.exact->table().columns, (std::vector<std::string>{"time", "end.velocity_x", "kinetic", "strain"}));
  EXPECT_EQ(tables.exact->value("end.velocity_x", 0.5), 0.1);  // before they meet
}

// A brick of 1 x 2 x 3 and mass 12 that turns about z: w^2 / 2 times m (1 + 4) / 12, and m v.
TEST(Quantities, RigidPartsHaveThoseOfTheirBody) {
  const TemporaryCase in(R"(units = "SI"
[[mesh.block]]
origin = [-0.5, -1.0, -1.5]
size = [1.0, 2.0, 3.0]
divisions = [2, 2, 3]
groups = { cells = "BRICK" }
[materials.hard]
law = "linear_elastic"
E = 2.0e3
nu = 0.3
rho = 2.0
[[part]]
name = "brick"
cells = "BRICK"
material = "hard"
[[rigid_body]]
name = "brick"
parts = ["brick"]
[[initial]]
part = "brick"
velocity = [0.2, 0.0, 0.0]
angular_velocity = [0.0, 0.0, 2.0]
centre = [0.0, 0.0, 0.0]
[scheme]
kind = "central_differences"
[time]
end = 0.1
[[probe]]
name = "all"
part = "brick"
quantities = ["mass", "momentum", "kinetic_energy", "strain_energy"]
)");
  ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
  Columns probes = test::read_csv(in.result("probes.csv")), energy = test::read_csv(in.result("energy.csv"));
  EXPECT_NEAR(probes["all.mass"].front(), 12.0, 1e-13);
  EXPECT_NEAR(probes["all.momentum_x"].front(), 2.4, 1e-13);
  EXPECT_NEAR(probes["all.kinetic_energy"].front(), 0.5 * 12.0 * 0.04 + 0.5 * 5.0 * 4.0, 1e-12);
  for (std::size_t i = 0; i < probes["time"].size(); ++i)
    EXPECT_NEAR(probes["all.kinetic_energy"][i], energy["kinetic"].at(i), 1e-12);
  EXPECT_EQ(probes["all.strain_energy"].back(), 0.0);
}

// What a law remembers is a field, and of a probe a curve, by its name alone: a uniaxial strain of a body that yields
// has at every node the plastic strain of its cells.
TEST(Quantities, WhatLawsRememberJoins) {
  const std::string text = pulled(0.05, R"([output]
precision = "double"
fields = ["equivalent_plastic_strain", "equivalent_plastic_strain_at_nodes", "plastic_strain_zz", "damage"]
[[probe]]
name = "foot"
group = "FOOT"
quantities = ["equivalent_plastic_strain", "plastic_strain_zz", "damage"]
)");
  const TemporaryCase in(replaced(text, "\"linear_elastic\"",
                                  "\"j2_small_strain\"\nyield_stress = 0.04\nhardening_modulus = 0.5\n"
                                  "damage = { D1 = 0.01, D2 = 0.04, D3 = -1.5 }"));
  ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
  // 0.05 = s / E + (s - 0.04) / 0.5: s = 0.052, to what Newton's iterations leave.
  const double alpha = (0.052 - 0.04) / 0.5;
  for (const char* name : {"equivalent_plastic_strain", "equivalent_plastic_strain_at_nodes", "plastic_strain_zz"})
    for (const auto& value : field(in, name)) EXPECT_NEAR(value[0], alpha, 1e-10) << name;
  EXPECT_NEAR(last_row(in.result("probes.csv"))["foot.equivalent_plastic_strain"], alpha, 1e-10);
  EXPECT_NEAR(last_row(in.result("probes.csv"))["foot.plastic_strain_zz"], alpha, 1e-10);
  const double damage = alpha / (0.01 + 0.04 * std::exp(-0.5));  // the mean stress is a third of von Mises'
  for (const auto& value : field(in, "damage")) EXPECT_NEAR(value[0], damage, 1e-8);  // alpha's, over 0.034
  EXPECT_NEAR(last_row(in.result("probes.csv"))["foot.damage"], damage, 1e-8);
}

std::string message_of(const std::string& text) {
  try {
    const Case given = parse_case(text, "case.toml");
    const Simulation simulation(given);
    const RunTables tables(simulation);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(Quantities, WhatACaseDoesNotHaveIsRefused) {
  const auto probe = [](const std::string& place, const std::string& quantity) {
    return pulled(0.01, fmt::format("[[probe]]\nname = \"p\"\n{}\nquantities = [\"{}\"]\n", place, quantity));
  };
  const auto says = [](const std::string& text, const std::string& what) {
    EXPECT_NE(message_of(text).find(what), std::string::npos) << message_of(text);
  };
  const std::string foot = "group = \"FOOT\"", body = "part = \"body\"";
  says(pulled(0.01, "[output]\nfields = [\"presure\"]\n"), "Did you mean \"pressure\"?");
  says(pulled(0.01, "[output]\nfields = [\"plastic_strain_zz\"]\n"), "the unknown name \"plastic_strain_zz\"");
  says(probe(foot, "contact_pressure"), "\"contact_pressure\", which this case does not have");
  says(probe(foot, "kinetic_energy"), "\"kinetic_energy\" without a part");
  says(probe(body, "displacement"), "\"displacement\" of a part");
  says(probe("part = \"bode\"", "mass"), "Did you mean \"body\"?");
  says(probe(body, "distortion_energy"), "distortion_energy of \"body\", which nothing in this case has");
  says(probe(foot, "displacement") + "shock = true\n",
       "found shock without an acceleration; expected \"acceleration\" or \"local_acceleration\" among the quantities");
  says(probe(foot, "acceleration") + "quality_factor = 5\n",
       "found a quality factor without shock; expected shock = true beside it");
  EXPECT_EQ(message_of(probe(foot, "acceleration") + "shock = true\nquality_factor = 5\n"), "");
  EXPECT_EQ(message_of(probe(body, "mass")), "");
}

}  // namespace
}  // namespace carom::run_quantities_test
