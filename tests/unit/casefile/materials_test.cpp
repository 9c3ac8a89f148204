// Materials in case files: every law of the table, and what is refused of their values.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "casefile/plausibility.hpp"
#include "casefile/read_case.hpp"
#include "casefile/resolved_case.hpp"
#include "casefile/schema.hpp"
#include "output/quantities.hpp"

namespace carom::casefile_materials_test {
namespace {

std::string case_with(const std::string& material) {
  return "title = \"t\"\nunits = \"SI\"\n[mesh]\nfile = \"bar.msh\"\n[materials.m]\n" + material +
         "[[part]]\nname = \"p\"\ncells = \"all\"\nmaterial = \"m\"\n[scheme]\nkind = \"central_differences\"\n"
         "[time]\nend = 1e-3\n";
}

const std::string elastic = "E = 2e11\nnu = 0.3\nrho = 7800.0\n";
const std::string j2 = "law = \"j2\"\n" + elastic;
const std::string johnson_cook = "law = \"johnson_cook\"\n" + elastic +
                                 "A = 4e8\nB = 5e8\nn = 0.3\nC = 0.01\nm = 1.03\nreference_rate = 1.0\n"
                                 "melting_temperature = 1800.0\nspecific_heat = 450.0\n";

const std::vector<std::string> good{
    "law = \"linear_elastic\"\n" + elastic,
    "law = \"st_venant_kirchhoff\"\n" + elastic,
    "law = \"neo_hookean\"\n" + elastic,
    "law = \"j2_small_strain\"\n" + elastic + "yield_stress = 4e8\n",
    j2 + "yield_stress = 4e8\nhardening_modulus = 1e8\n",
    j2 + "yield_stress = 4e8\nhardening_modulus = 1e8\nsaturation_stress = 6e8\nsaturation_rate = 12.0\n",
    j2 + "hardening_table = [[0.0, 4e8], [0.1, 5e8], [0.2, 5e8]]\n",
    johnson_cook,
    johnson_cook + "taylor_quinney = 1.0\ninitial_temperature = 600.0\n",
    johnson_cook + "damage = { D1 = -2.2, D2 = 5.43, D3 = -0.47, D4 = 0.016, D5 = 0.63 }\n",
    j2 + "yield_stress = 4e8\ndamage = { D1 = 0.5, D2 = 0.1, D3 = -1.5, D4 = -0.01, reference_rate = 5e-4 }\n"};

// What is written of a case reads as the same material, to the last bit.
TEST(CasefileMaterials, EveryLawIsReadAndWritten) {
  for (const std::string& text : good) {
    const Case given = parse_case(case_with(text), "c.toml"), again = parse_case(resolved_toml(given), "again.toml");
    const Material a = given.materials[0].made(), b = again.materials[0].made();
    EXPECT_EQ(a.law, b.law) << text;
    EXPECT_EQ(a.rho, 7800.0);
    EXPECT_EQ(a.values, b.values) << text;
    EXPECT_EQ(a.curve, b.curve) << text;
    EXPECT_EQ(a.at_rest().E, 2e11);
    EXPECT_EQ(a.at_rest().nu, 0.3);
    EXPECT_EQ(a.damage, b.damage) << text;
  }
  const Material table = parse_case(case_with(good[6]), "c.toml").materials[0].made();
  ASSERT_EQ(table.curve.size(), 3U);
  EXPECT_EQ(table.curve[1], (std::array<double, 2>{0.1, 5e8}));
  const Material heated = parse_case(case_with(good[8]), "c.toml").materials[0].made();
  EXPECT_EQ(heated.value("initial_temperature"), 600.0);
  EXPECT_EQ(heated.value("reference_temperature"), 293.15);
  EXPECT_FALSE(heated.damage);
  const auto damage_of = [](std::size_t i) {
    return parse_case(case_with(good[i]), "c.toml").materials[0].made().damage;
  };
  EXPECT_EQ(damage_of(9), (JohnsonCookDamage{-2.2, 5.43, -0.47, 0.016, 0.63, std::nullopt}));
  EXPECT_EQ(damage_of(10), (JohnsonCookDamage{0.5, 0.1, -1.5, -0.01, 0.0, 5e-4}));
}

std::string message_of(const std::string& material) {
  try {
    parse_case(case_with(material), "c.toml");
  } catch (const CaseError& error) {
    return error.what();
  }
  return "no error";
}

struct Bad {
  std::string material, message;
};

TEST(CasefileMaterials, BadValuesAreRefusedWithTheirReason) {
  const std::string start = "law = \"j2\"\nE = 2e11\nrho = 7800.0\n";
  const std::vector<Bad> all{
      {start + "yield_stress = 4e8\nnu = 0.5\n",
       "c.toml:10:6: materials.m.nu: found 0.5; expected a number > -1 and < 0.5. Poisson's ratio of a material lies between 0 and 0.5. At 0.5 a body cannot change its volume at all, and its bulk modulus is infinite: take 0.499 with formulation = \"mean_dilatation\"."},
      {start + "nu = 0.3\nyield_stress = 0.0\n",
       "c.toml:10:16: materials.m.yield_stress: found 0.0; expected a number > 0 in Pa"},
      {j2, "c.toml:5:1: materials.m.yield_stress: found nothing; expected a yield stress > 0, or a hardening_table"},
      {j2 + "yield_stress = 4e8\nhardening_modulus = -1e8\n",
       "c.toml:11:21: materials.m.hardening_modulus: found -1e+08; expected a number >= 0 in Pa"},
      {j2 + "yield_stress = 4e8\nsaturation_stress = 3e8\nsaturation_rate = 10.0\n",
       "c.toml:11:21: materials.m.saturation_stress: found 3e+08, below the yield stress of 4e+08; expected at least "
       "the yield stress. Softening bodies localise in single cells."},
      {j2 + "yield_stress = 4e8\nsaturation_stress = 5e8\n",
       "c.toml:11:21: materials.m.saturation_stress: found a stress without saturation_rate; expected both, for Voce's "
       "hardening"},
      {j2 + "yield_stress = 4e8\nhardening_table = [[0.0, 4e8]]\n",
       "c.toml:10:16: materials.m.yield_stress: found yield_stress beside hardening_table; expected one of the two. "
       "The "
       "table says it all."},
      {j2 + "hardening_table = [[0.0, 4e8, 1.0]]\n",
       "c.toml:10:20: materials.m.hardening_table[0]: found a list of 3 values; expected two numbers [x, y] >= 0"},
      {j2 + "hardening_table = [0.0, 4e8]\n",
       "c.toml:10:20: materials.m.hardening_table[0]: found 0.0; expected two numbers [x, y] >= 0"},
      {j2 + "hardening_table = []\n",
       "c.toml:10:19: materials.m.hardening_table: found a list of 0 values; expected a list of rows [x, y], each of "
       "two "
       "numbers >= 0"},
      {j2 + "hardening_table = [[0.1, 4e8]]\n",
       "c.toml:10:19: materials.m.hardening_table: found a first plastic strain of 0.1; expected 0"},
      {j2 + "hardening_table = [[0.0, 0.0], [0.1, 4e8]]\n",
       "c.toml:10:19: materials.m.hardening_table: found a first yield stress of 0; expected a yield stress > 0. A "
       "body "
       "that yields at once has no elastic states; take an elastic law, or a small stress."},
      {j2 + "hardening_table = [[0.0, 4e8], [0.2, 5e8], [0.1, 6e8]]\n",
       "c.toml:10:19: materials.m.hardening_table: found plastic strain 0.1 after 0.2; expected plastic strains in "
       "increasing order"},
      {j2 + "hardening_table = [[0.0, 4e8], [0.1, 3e8]]\n",
       "c.toml:10:19: materials.m.hardening_table: found yield stress 3e+08 after 4e+08; expected yield stresses that "
       "do "
       "not fall. Softening bodies localise in single cells; end the table at its highest stress."},
      {johnson_cook + "initial_temperature = 1800.0\n",
       "c.toml:18:23: materials.m.initial_temperature: found 1800 with melting_temperature = 1800; expected a "
       "temperature below that of melting. Both are absolute, in K."},
      {johnson_cook + "taylor_quinney = 1.1\n",
       "c.toml:18:18: materials.m.taylor_quinney: found 1.1; expected a number >= 0 and <= 1"},
      {"law = \"linear_elastic\"\n" + elastic + "yield_stress = 4e8\n",
       "c.toml:10:1: materials.m.yield_stress: found a key that law = \"linear_elastic\" does not take; expected one "
       "of "
       "law, E, nu, rho, library, checksum. It belongs to law = \"j2_small_strain\", \"j2\", \"swift_small_strain\"."},
      {"law = \"j2\"\n" + elastic + "yield = 4e8\n",
       "c.toml:10:1: materials.m.yield: found an unknown key; expected one of law, E, nu, rho, yield_stress, "
       "hardening_modulus, saturation_stress, saturation_rate, hardening_table, damage, library, checksum. Did you mean "
       "yield_stress?"},
      {"law = \"neo_hookean\"\n" + elastic + "damage = { D1 = 0.5 }\n",
       "c.toml:10:1: materials.m.damage: found a key that law = \"neo_hookean\" does not take; expected one of law, E, "
       "nu, rho, library, checksum. It belongs to law = \"j2_small_strain\", \"j2\", \"johnson_cook\", "
       "\"j2_rate_small_strain\", \"j2_rate\", \"swift_small_strain\"."},
      {j2 + "yield_stress = 4e8\ndamage = { D2 = 0.5 }\n",
       "c.toml:11:10: materials.m.damage.D1: found nothing; expected a number. Add D1: Strain at fracture that is left "
       "at a high eta."},
      {j2 + "yield_stress = 4e8\ndamage = { D1 = 0.5, D2 = -0.5 }\n",
       "c.toml:11:27: materials.m.damage.D2: found -0.5; expected a number >= 0"},
      {j2 + "yield_stress = 4e8\ndamage = { D1 = 0.5, d2 = 0.5 }\n",
       "c.toml:11:22: materials.m.damage.d2: found an unknown key; expected one of D1, D2, D3, D4, D5, "
       "reference_rate. Did you mean D2?"},
      {j2 + "yield_stress = 4e8\ndamage = { D1 = -0.5, D2 = 0.5, D3 = -1.5 }\n",
       "c.toml:11:17: materials.m.damage.D1: found D1 + D2 exp(D3 / 3) = -0.196735; expected a strain at fracture > "
       "0. That is the strain at which a bar under slow tension breaks."},
      {j2 + "yield_stress = 4e8\ndamage = { D1 = 0.5, D4 = 0.01 }\n",
       "c.toml:11:27: materials.m.damage.D4: found 0.01 without reference_rate; expected reference_rate beside it. The "
       "law j2 has none of its own."},
      {j2 + "yield_stress = 4e8\ndamage = { D1 = 0.5, D5 = 0.6 }\n",
       "c.toml:11:27: materials.m.damage.D5: found 0.6 with law = \"j2\"; expected a law that knows the temperature. "
       "Take \"johnson_cook\", or leave D5 out."},
      {johnson_cook + "damage = { D1 = 0.5, reference_rate = 0.0 }\n",
       "c.toml:18:39: materials.m.damage.reference_rate: found 0.0; expected a number > 0 in 1/s"}};
  for (const Bad& bad : all) EXPECT_EQ(message_of(bad.material), bad.message) << bad.material;
}

// Constants of an input file of Abaqus, copied as they are.
TEST(CasefileMaterials, DamageWithTheSignOfAbaqusIsDoubtful) {
  const auto doubts = [](const std::string& D3) {
    return plausibility_warnings(
        parse_case(case_with(johnson_cook + "damage = { D1 = 0.54, D2 = 4.89, D3 = " + D3 + " }\n"), "c.toml"));
  };
  EXPECT_TRUE(doubts("-3.03").empty());
  ASSERT_EQ(doubts("3.03").size(), 1U);
  EXPECT_EQ(
      doubts("3.03")[0],
      "c.toml:5: materials.m: D3 = 3.03 of the damage lets tension break later than compression; the d3 of Abaqus "
      "has the other sign, is it one?");
}

TEST(CasefileMaterials, ThePageInTheRepositoryIsCurrent) {
  std::ifstream file(std::string(CAROM_SOURCE_DIR) + "/docs/material_laws.md");
  const std::string committed{std::istreambuf_iterator<char>(file), {}};
  const std::string written = testing::TempDir() + "material_laws.md";
  if (committed != laws_markdown()) std::ofstream(written) << laws_markdown();
  EXPECT_TRUE(committed == laws_markdown()) << "copy " << written << " to docs/material_laws.md";
}

TEST(CasefileQuantities, ThePageInTheRepositoryIsCurrent) {
  std::ifstream file(std::string(CAROM_SOURCE_DIR) + "/docs/quantities.md");
  const std::string committed{std::istreambuf_iterator<char>(file), {}};
  const std::string written = testing::TempDir() + "quantities.md";
  if (committed != quantities_markdown()) std::ofstream(written) << quantities_markdown();
  EXPECT_TRUE(committed == quantities_markdown()) << "copy " << written << " to docs/quantities.md";
}

}  // namespace
}  // namespace carom::casefile_materials_test
