// *MATERIAL of a deck: elasticity, plasticity, heat.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "translate_fixture.hpp"

namespace carom::translate_materials_test {
namespace {

using test::case_from;
using test::good_deck;
using test::has_note;
using test::message_of;
using test::replaced;
using test::translated;

const std::string johnson_cook =
    "*DENSITY\n7.8e-9\n*PLASTIC, HARDENING=JOHNSON COOK\n90., 292., 0.31, 1.09, 1083., 25.\n"
    "*RATE DEPENDENT, TYPE=JOHNSON COOK\n0.025, 1.\n*SPECIFIC HEAT\n3.83e8\n*INELASTIC HEAT FRACTION\n0.9\n"
    "*CONDUCTIVITY\n400.\n*EXPANSION, ZERO=20.\n1.7e-5\n";

TEST(Translate, PlasticityAsATable) {
  const std::string deck = replaced(good_deck, "*DENSITY", "*PLASTIC\n300., 0.\n400., 0.1\n*DENSITY");
  const Case made = case_from(deck);
  EXPECT_EQ(*made.materials[0].law, "j2_small_strain");
  EXPECT_EQ(*made.materials[0].curve, (std::vector<std::array<double, 2>>{{0.0, 300.0}, {0.1, 400.0}}));
  EXPECT_EQ(*case_from(replaced(deck, "*STEP\n", "*STEP, NLGEOM\n")).materials[0].law, "j2");
}

/// The good deck with a temperature at the start.
std::string at_temperature(const std::string& deck, const std::string& temperature) {
  return replaced(
      deck, "*INITIAL CONDITIONS, TYPE=VELOCITY",
      "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, " + temperature + "\n*INITIAL CONDITIONS, TYPE=VELOCITY");
}

/// Abaqus Analysis User's Guide, "Material data definition": values are linear between the temperatures that are given
/// and constant outside; "Initial conditions": those that are not given are zero. 310 is in the middle of 20 and 600.
TEST(Translate, TablesAreTakenAtTheTemperatureOfTheStart) {
  using Curve = std::vector<std::array<double, 2>>;
  const std::string deck =
      replaced(good_deck, "*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n",
               "*PLASTIC\n90., 0., 20.\n120., 0.1, 20.\n60., 0., 600.\n80., 0.2, 600.\n"
               "*ELASTIC\n210000., 0.3, 20.\n110000., 0.4, 600.\n*DENSITY\n8e-9, 20.\n6e-9, 600.\n");
  const CaseMaterial cold = case_from(deck).materials[0], hot = case_from(at_temperature(deck, "700.")).materials[0];
  EXPECT_EQ(*cold.curve, (Curve{{0.0, 90.0}, {0.1, 120.0}}));
  EXPECT_EQ(*cold.value("E"), 210000.0);
  EXPECT_EQ(*hot.curve, (Curve{{0.0, 60.0}, {0.2, 80.0}}));
  EXPECT_EQ(*hot.rho, 6e-9);
  const CaseMaterial warm = case_from(at_temperature(deck, "310.")).materials[0];
  EXPECT_EQ(*warm.curve, (Curve{{0.0, 75.0}, {0.1, 95.0}, {0.2, 100.0}}));
  EXPECT_DOUBLE_EQ(*warm.value("E"), 160000.0);
  EXPECT_DOUBLE_EQ(*warm.value("nu"), 0.35);
  EXPECT_DOUBLE_EQ(*warm.rho, 7e-9);
  EXPECT_TRUE(has_note(translated(at_temperature(deck, "310.")), "*ELASTIC at the temperature of the start, 310"));
}

TEST(Translate, TablesOfTemperaturesThatChangeAreRefused) {
  const std::string deck = replaced(at_temperature(good_deck, "310."), "*ELASTIC\n210000., 0.3\n",
                                    "*ELASTIC\n210000., 0.3, 20.\n110000., 0.4, 600.\n*SPECIFIC HEAT\n4e8\n");
  const std::string heated = replaced(deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3", "*DYNAMIC, EXPLICIT, ADIABATIC\n, 1e-3");
  const std::string refused = message_of(heated);
  EXPECT_NE(refused.find("*ELASTIC: values that depend on the temperature, which changes. Those at the start, at 310,"),
            std::string::npos)
      << refused;
  EXPECT_DOUBLE_EQ(*case_from(heated, {"ELASTIC"}).materials[0].value("E"), 160000.0);
  const std::string some = message_of(replaced(deck, "NALL, 310.", "BASE, 310."));
  EXPECT_NE(some.find("*INITIAL CONDITIONS: several temperatures in the material STEEL"), std::string::npos) << some;
  EXPECT_NE(message_of(replaced(deck, "600.", "10.")).find("found the temperature 10 after 20"), std::string::npos);
}

/// Only Johnson and Cook's law heats: a deck with another one says so.
TEST(Translate, AdiabaticStepsOfOtherLawsSayThatNothingHeats) {
  const std::string deck = replaced(good_deck, "*DENSITY", "*PLASTIC\n90., 0.\n*DENSITY");
  EXPECT_TRUE(
      has_note(translated(replaced(deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3", "*DYNAMIC, EXPLICIT, ADIABATIC\n, 1e-3")),
               "no heating: only Johnson and Cook's law heats"));
}

/// Degree of freedom 11 of Abaqus and CalculiX is the temperature.
TEST(Translate, ImposedTemperaturesAreRefusedUnlessAccepted) {
  const std::string deck = replaced(good_deck, "BASE, 1, 3\n", "BASE, 1, 3\nBASE, 11, 11, 298.\n");
  const std::string refused = message_of(deck);
  EXPECT_NE(refused.find("x.inp:41: *BOUNDARY: an imposed temperature. It would be left out"), std::string::npos)
      << refused;
  EXPECT_EQ(case_from(deck, {"BOUNDARY"}).supports.size(), 3U);
}

TEST(Translate, PlasticityThatDependsOnTheRate) {
  const auto material = [](const std::string& plastic) {
    return case_from(replaced(good_deck, "*DENSITY", plastic + "*DENSITY")).materials[0];
  };
  const CaseMaterial curves = material("*PLASTIC\n90., 0.\n120., 0.1\n*PLASTIC, RATE=100.\n130., 0.\n");
  EXPECT_EQ(*curves.law, "j2_rate_small_strain");
  EXPECT_EQ(curves.rates, (std::vector<double>{0.0, 100.0}));
  EXPECT_EQ(*curves.curve, (std::vector<std::array<double, 2>>{{0.0, 90.0}, {0.1, 120.0}, {0.0, 130.0}}));
  const CaseMaterial ratios = material("*PLASTIC\n90., 0.\n*RATE DEPENDENT, TYPE=YIELD RATIO\n1., 0.\n1.5, 100.\n");
  EXPECT_EQ(*ratios.curve, (std::vector<std::array<double, 2>>{{0.0, 90.0}, {0.0, 135.0}}));
  // Cowper and Symonds' factor of mild steel, 1 + (rate / D)^(1/n), at the rate D is 2 and at 32 D with n = 5 it is 3:
  // within the rates that are written, and between two.
  const CaseMaterial power = material("*PLASTIC\n90., 0.\n*RATE DEPENDENT, TYPE=POWER LAW\n40., 5.\n");
  for (const auto& [rate, factor] : {std::pair{40.0, 2.0}, {1280.0, 3.0}}) {
    const auto faster = std::upper_bound(power.rates.begin(), power.rates.end(), rate);
    ASSERT_NE(faster, power.rates.end());
    const auto k = static_cast<std::size_t>(faster - power.rates.begin());
    const double share = (rate - power.rates[k - 1]) / (power.rates[k] - power.rates[k - 1]);
    const double stress = (*power.curve)[k - 1][1] + share * ((*power.curve)[k][1] - (*power.curve)[k - 1][1]);
    EXPECT_NEAR(stress, factor * 90.0, 0.01 * 90.0);
  }
}

/// Abaqus Analysis User's Guide, "Initial conditions": temperatures that are not given are zero, from where the body is
/// heated; the case has absolute ones, and the law takes differences alone.
TEST(Translate, JohnsonAndCook) {
  const Case made = case_from(replaced(replaced(good_deck, "*DENSITY",
                                                "*PLASTIC, HARDENING=JOHNSON COOK\n90., 292., 0.31, 1.09, 1356., 298.\n"
                                                "*RATE DEPENDENT, TYPE=JOHNSON COOK\n0.025, 1.\n*SPECIFIC HEAT\n3.8e8\n"
                                                "*DENSITY"),
                                       "*DYNAMIC, DIRECT\n1e-6", "*DYNAMIC, EXPLICIT, ADIABATIC\n"));
  EXPECT_EQ(*made.materials[0].law, "johnson_cook");
  EXPECT_EQ(*made.materials[0].value("n"), 0.31);
  EXPECT_EQ(*made.materials[0].value("m"), 1.09);
  EXPECT_EQ(*made.materials[0].value("C"), 0.025);
  EXPECT_EQ(*made.materials[0].value("initial_temperature"), 273.15);
  EXPECT_EQ(*made.materials[0].value("melting_temperature"), 1356.0 + 273.15);
  EXPECT_EQ(*made.materials[0].value("taylor_quinney"), 0.9);
}

/// A deck in degrees Celsius: the law takes differences of temperatures alone.
TEST(Translate, InitialTemperaturesOfJohnsonAndCook) {
  std::string deck = replaced(good_deck, "*DENSITY\n7.8e-9\n", johnson_cook);
  deck =
      replaced(deck, "*INITIAL CONDITIONS", "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, -40.\n*INITIAL CONDITIONS");
  deck = replaced(deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3", "*DYNAMIC, EXPLICIT\n, 1e-3");
  const TranslatedDeck cold = translated(deck);  // no step heats: conduction and expansion change nothing
  EXPECT_TRUE(has_note(cold, "*CONDUCTIVITY changes nothing"));
  EXPECT_TRUE(has_note(cold, "*EXPANSION changes nothing"));
  const Case of_cold = case_of(cold.tree, "x.inp");
  EXPECT_DOUBLE_EQ(*of_cold.materials[0].value("initial_temperature"), -40.0 + 273.15);
  EXPECT_DOUBLE_EQ(*of_cold.materials[0].value("reference_temperature"), 25.0 + 273.15);
  EXPECT_DOUBLE_EQ(*of_cold.materials[0].value("melting_temperature"), 1083.0 + 273.15);
  EXPECT_EQ(*of_cold.materials[0].value("taylor_quinney"), 0.0);
  const std::string some = message_of(replaced(deck, "NALL, -40.", "BASE, -40."));
  EXPECT_NE(some.find("*INITIAL CONDITIONS: several temperatures in the material STEEL, or none at some nodes"),
            std::string::npos)
      << some;
}

/// Adiabatic and coupled steps, and elements with temperatures, which are their mechanical twins.
TEST(Translate, StepsThatHeat) {
  std::string deck = replaced(good_deck, "*DENSITY\n7.8e-9\n", johnson_cook);
  deck = replaced(replaced(deck, "TYPE=C3D8,", "TYPE=C3D8RT,"), "TYPE=C3D8,", "TYPE=C3D8T,");
  const std::string step = "*DYNAMIC, DIRECT\n1e-6, 1e-3";
  const std::string adiabatic = replaced(deck, step, "*DYNAMIC, EXPLICIT, ADIABATIC\n, 1e-3");
  EXPECT_NE(message_of(adiabatic).find("--accept \"EXPANSION\" runs"), std::string::npos) << message_of(adiabatic);
  const std::string coupled = replaced(deck, step, "*DYNAMIC TEMPERATURE-DISPLACEMENT, EXPLICIT\n, 1e-3");
  EXPECT_NE(message_of(coupled).find("--accept \"DYNAMIC TEMPERATURE-DISPLACEMENT,CONDUCTIVITY,EXPANSION\" runs"),
            std::string::npos)
      << message_of(coupled);
  for (const TranslatedDeck& made :
       {translated(adiabatic, {"EXPANSION"}),
        translated(coupled, {"EXPANSION", "CONDUCTIVITY", "DYNAMIC TEMPERATURE-DISPLACEMENT"})}) {
    EXPECT_TRUE(has_note(made, "C3D8RT: its nodes have no temperatures; one point"));
    const Case given = case_of(made.tree, "x.inp");
    EXPECT_EQ(*given.scheme.kind, SchemeKind::central_differences);
    EXPECT_EQ(*given.materials[0].value("taylor_quinney"), 0.9);
    EXPECT_EQ(**given.parts[0].formulation, "one_point");
    EXPECT_FALSE(given.parts[1].formulation);
  }
}

/// The good deck with a material that breaks; the temperatures are those of *PLASTIC.
std::string breaking(const std::string& damage) {
  const std::string deck = replaced(good_deck, "*DENSITY\n7.8e-9\n", johnson_cook + damage);
  return replaced(deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3", "*DYNAMIC, EXPLICIT\n, 1e-3");
}

const std::string initiation =
    "*DAMAGE INITIATION, CRITERION=JOHNSON COOK\n0.54, 4.89, 3.03, 0.014, 1.12, 1083., 25., 2.\n";

// d3 has the other sign in Abaqus.
TEST(Translate, DamageOfJohnsonAndCook) {
  const TranslatedDeck made = translated(breaking(initiation + "*DAMAGE EVOLUTION, TYPE=DISPLACEMENT\n0.\n"));
  const Case given = case_of(made.tree, "x.inp");
  EXPECT_EQ(given.materials[0].damage, (JohnsonCookDamage{0.54, 4.89, -3.03, 0.014, 1.12, 2.0}));
  ASSERT_EQ(given.erosion.size(), 2U);
  EXPECT_EQ(*given.erosion[0].part, *given.parts[0].name);
  EXPECT_EQ(*given.erosion[1].part, *given.parts[1].name);
  EXPECT_EQ(given.erosion[1].damage, 1.0);
  EXPECT_FALSE(given.erosion[1].plastic_strain);
  const TranslatedDeck alone = translated(breaking(initiation));
  EXPECT_TRUE(has_note(alone, "the damage is computed, and no cell goes"));
  EXPECT_TRUE(case_of(alone.tree, "x.inp").materials[0].damage);
  EXPECT_TRUE(case_of(alone.tree, "x.inp").erosion.empty());
}

/// Abaqus keyword *SECTION CONTROLS: ELEMENT DELETION=NO keeps elements that are broken, YES, the default, does not.
TEST(Translate, CellsThatAreToStayWhenBrokenAreRefused) {
  const auto with = [](const std::string& deletion) {
    const std::string deck = breaking(initiation +
                                      "*DAMAGE EVOLUTION, TYPE=DISPLACEMENT\n0.\n*SECTION CONTROLS, NAME=C, "
                                      "ELEMENT DELETION=" +
                                      deletion + "\n");
    return replaced(deck, "ELSET=LOWER, MATERIAL=STEEL", "ELSET=LOWER, MATERIAL=STEEL, CONTROLS=C");
  };
  const std::string refused = message_of(with("NO"));
  EXPECT_NE(refused.find("*SECTION CONTROLS: ELEMENT DELETION=NO. Cells would go where their damage is 1."),
            std::string::npos)
      << refused;
  EXPECT_EQ(message_of(with("YES")), "no error");
}

TEST(Translate, OtherDamageIsRefusedWithItsReason) {
  const auto says = [](const std::string& damage, const std::string& what) {
    EXPECT_NE(message_of(breaking(damage)).find(what), std::string::npos) << message_of(breaking(damage));
  };
  const std::string softening = initiation + "*DAMAGE EVOLUTION, TYPE=DISPLACEMENT\n0.1\n";
  says(softening, "*DAMAGE EVOLUTION: damage that softens the stress until the cell goes");
  EXPECT_EQ(case_from(breaking(softening), {"DAMAGE EVOLUTION"}).erosion.size(), 2U);
  const std::string ductile =
      "*DAMAGE INITIATION, CRITERION=DUCTILE\n0.5, 0.33, 1.\n*DAMAGE EVOLUTION, TYPE=ENERGY\n0.\n";
  says(ductile, "*DAMAGE INITIATION: CRITERION=DUCTILE");
  const Case accepted = case_from(breaking(ductile), {"DAMAGE INITIATION"});
  EXPECT_TRUE(accepted.erosion.empty());
  EXPECT_FALSE(accepted.materials[0].damage);
  says("*DAMAGE EVOLUTION, TYPE=ENERGY\n0.\n", "*DAMAGE EVOLUTION alone");
  says(replaced(initiation, "1083., 25.", "1000., 25."), "melting and transition temperatures 1000, 25");
  says(initiation + "0.045\n", "a second line");
  says(replaced(initiation, ", 2.\n", "\n"), "7 values");
  const std::string elastic = replaced(good_deck, "*DENSITY", initiation + "*DENSITY");
  EXPECT_NE(message_of(elastic).find("*DAMAGE INITIATION without *PLASTIC"), std::string::npos) << message_of(elastic);
  const std::string table = replaced(good_deck, "*DENSITY", "*PLASTIC\n300., 0.\n" + initiation + "*DENSITY");
  EXPECT_NE(message_of(table).find("d5 = 1.12 without HARDENING=JOHNSON COOK"), std::string::npos);
  EXPECT_EQ(case_from(table, {"DAMAGE INITIATION"}).materials[0].damage->D5, 0.0);
}

// C10 = G / 2 and D1 = 2 / K: E = 9 K G / (3 K + G).
TEST(Translate, NeoHookeOnlyWhereItsPotentialIsAccepted) {
  const std::string deck = replaced(replaced(good_deck, "*ELASTIC\n210000., 0.3", "*HYPERELASTIC, NEO HOOKE\n0.5, 0.2"),
                                    "*STEP\n", "*STEP, NLGEOM\n");
  EXPECT_THROW(case_from(deck), CaseError);
  const Case made = case_from(deck, {"hyperelastic"});
  EXPECT_EQ(*made.materials[0].law, "neo_hookean");
  EXPECT_NEAR(*made.materials[0].value("E"), 90.0 / 31.0, 1e-15);  // K = 10, G = 1
  EXPECT_NEAR(*made.materials[0].value("nu"), 28.0 / 62.0, 1e-15);
}

/// CAE writes all that its model has; what nothing refers to needs no density, and may be what Carom has not.
TEST(TranslateMaterials, ThatNothingIsMadeOfAreLeftOut) {
  const std::string unused =
      replaced(good_deck, "*MATERIAL",
               "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, MOONEY-RIVLIN\n1., 0.1, 0.\n*EXPANSION\n1e-5,\n*MATERIAL");
  EXPECT_TRUE(has_note(translated(unused), "the material RUBBER is left out: nothing is made of it"));
  EXPECT_EQ(case_from(unused).materials.size(), 1U);
  EXPECT_NE(message_of(replaced(unused, "MATERIAL=STEEL", "MATERIAL=Rubber")).find("MOONEY-RIVLIN"), std::string::npos);
  const std::string others =
      replaced(unused, "*BOUNDARY",
               "*AMPLITUDE, NAME=WAVE, DEFINITION=PERIODIC\n1, 5., 0., 0.\n*SURFACE INTERACTION, "
               "NAME=GLUED\n*FRICTION, ROUGH\n*COHESIVE BEHAVIOR\n*BOUNDARY");
  EXPECT_EQ(message_of(others), "no error");
  EXPECT_TRUE(has_note(translated(others), "the interaction GLUED is left out: no contact has it"));
  EXPECT_TRUE(has_note(translated(others), "the amplitude WAVE is left out: nothing follows it"));
}

}  // namespace
}  // namespace carom::translate_materials_test
