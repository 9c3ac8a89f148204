// Decks as cases: what each keyword becomes.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "casefile/read_case.hpp"
#include "casefile/write_toml.hpp"
#include "deck/keyword_table.hpp"
#include "translate/amplitudes.hpp"
#include "translate/decks_page.hpp"
#include "translate/translate_deck.hpp"
#include "translate_fixture.hpp"

namespace carom::translate_test {
namespace {

using test::good_deck;
using test::replaced;

using test::case_from;
using test::has_note;
using test::message_of;
using test::no_file;
using test::translated;

TEST(Translate, TheWholeOfASmallDeck) {
  const Case made = case_from(good_deck);
  EXPECT_EQ(made.title, "Two cubes");
  EXPECT_EQ(made.units, UnitSystem::mm_t_s);
  EXPECT_EQ(*made.mesh.file, "x.inp");
  ASSERT_EQ(made.materials.size(), 1U);
  EXPECT_EQ(*made.materials[0].law, "linear_elastic");
  EXPECT_EQ(*made.materials[0].value("E"), 210000.0);
  EXPECT_EQ(*made.materials[0].rho, 7.8e-9);
  ASSERT_EQ(made.parts.size(), 2U);
  EXPECT_EQ(*made.parts[1].cells, "UPPER");
  ASSERT_EQ(made.supports.size(), 3U);
  EXPECT_EQ(*made.supports[0].nodes, "BASE");
  EXPECT_TRUE(made.supports[2].blocked[2]);
  ASSERT_EQ(made.initial.size(), 1U);
  EXPECT_EQ(*made.initial[0].velocity, (Vec3{0.0, 0.0, -1000.0}));
  ASSERT_EQ(made.contacts.size(), 1U);
  EXPECT_EQ(*made.contacts[0].group(), "FOOT");
  EXPECT_EQ(*std::get<CasePair>(made.contacts[0].of).master, "FLOOR");
  EXPECT_EQ(**made.contacts[0].springs()->stiffness, 1e6);
  EXPECT_EQ(made.contacts[0].law()->friction, 0.2);
  ASSERT_EQ(made.loads.size(), 1U);
  EXPECT_EQ(made.loads[0].vector, (Vec3{5.0, 0.0, 0.0}));
  EXPECT_EQ(**made.loads[0].function, "A");
  EXPECT_EQ(*made.scheme.kind, SchemeKind::hht);
  EXPECT_EQ(*made.time.end, 1e-3);
  EXPECT_EQ(**made.time.step, 1e-6);
  EXPECT_TRUE(made.time.fixed);
}

TEST(Translate, PlacesAreThoseOfTheDeck) {
  const Case made = case_from(good_deck);
  EXPECT_EQ(to_string(made.parts[1].cells.where), "x.inp:38");
  EXPECT_EQ(to_string(made.contacts[0].where), "x.inp:49");
  EXPECT_EQ(to_string(made.time.end.where), "x.inp:53");
}

TEST(Translate, ErrorsOfTheSchemaNameTheLineOfTheDeck) {
  try {
    case_from(replaced(good_deck, "210000., 0.3", "210000., 0.7"));
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_EQ(to_string(error.where()), "x.inp:33");
    EXPECT_EQ(error.key(), "materials.STEEL.nu");
  }
}

TEST(Translate, RotationsAreFiniteAsTheProgramHasThem) {
  const auto law = [](const std::string& step, const std::string& dynamic) {
    return *case_from(replaced(replaced(good_deck, "*STEP\n", step), "*DYNAMIC, DIRECT\n1e-6, 1e-3", dynamic))
                .materials[0]
                .law;
  };
  EXPECT_EQ(law("*STEP\n", "*DYNAMIC\n1e-6, 1e-3"), "linear_elastic");
  EXPECT_EQ(law("*STEP, NLGEOM\n", "*DYNAMIC\n1e-6, 1e-3"), "st_venant_kirchhoff");
  EXPECT_EQ(law("*STEP, NLGEOM=NO\n", "*DYNAMIC\n1e-6, 1e-3"), "linear_elastic");
  EXPECT_EQ(law("*STEP\n", "*DYNAMIC, EXPLICIT\n, 1e-3"), "st_venant_kirchhoff");  // Abaqus' explicit program
  EXPECT_EQ(law("*STEP, NLGEOM=NO\n", "*DYNAMIC, EXPLICIT\n, 1e-3"), "linear_elastic");
  EXPECT_EQ(law("*STEP\n", "*DYNAMIC, EXPLICIT=2\n1e-6, 1e-3"), "linear_elastic");  // CalculiX
}

TEST(Translate, SchemesOfTheProcedures) {
  const auto made = [](const std::string& procedure) {
    return case_from(replaced(good_deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3", procedure));
  };
  EXPECT_EQ(std::get<AlphaParameters>(made("*DYNAMIC, ALPHA=-0.2\n1e-6, 1e-3").scheme.parameters).alpha, -0.2);
  EXPECT_EQ(*made("*DYNAMIC, EXPLICIT\n, 1e-3").scheme.kind, SchemeKind::central_differences);
  EXPECT_FALSE(made("*DYNAMIC, EXPLICIT\n, 1e-3").time.step);
  EXPECT_EQ(made("*DYNAMIC, EXPLICIT\n, 1e-3").parts[0].linear_bulk_viscosity, 0.06);
  EXPECT_EQ(made("*DYNAMIC, EXPLICIT\n, 1e-3\n*BULK VISCOSITY\n0.1, 2.").parts[0].quadratic_bulk_viscosity, 2.0);
  EXPECT_EQ(*made("*STATIC\n0.1, 1.").scheme.kind, SchemeKind::statics);
  EXPECT_EQ(**made("*STATIC\n").time.step, 1.0);
}

TEST(Translate, StepsAreStagesThatGoOn) {
  const Case made = case_from(good_deck + "*STEP\n*STATIC, DIRECT\n0.5, 2.\n*END STEP\n");
  ASSERT_EQ(made.stages.size(), 1U);
  EXPECT_EQ(*made.stages[0].scheme.kind, SchemeKind::statics);
  EXPECT_EQ(*made.stages[0].time.end, 2.001);
}

TEST(Translate, OverlapsOfAbaqusExplicitCountAsTouching) {
  const auto penetration = [](const char* line) {
    return *case_from(replaced(good_deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3", line)).contacts[0].law()->initial_penetration;
  };
  EXPECT_EQ(penetration("*DYNAMIC, EXPLICIT\n, 1e-3"), InitialPenetration::strain_free_offset);
  EXPECT_EQ(penetration("*DYNAMIC, EXPLICIT=1\n1e-7, 1e-3"), InitialPenetration::prestress);
}

TEST(Translate, AMarkOfUtf8IsPassedOver) {
  EXPECT_TRUE(looks_like_deck("\xef\xbb\xbf" + good_deck));
  EXPECT_EQ(case_from("\xef\xbb\xbf" + good_deck).parts.size(), 2U);
}

TEST(Translate, AnExplicitStepHasItsTimeInTheSecondNumber) {
  for (const char* line : {"*DYNAMIC, EXPLICIT\n4e-5", "*DYNAMIC, EXPLICIT\n"}) {
    try {
      case_from(replaced(good_deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3", line));
      ADD_FAILURE() << line;
    } catch (const CaseError& error) {
      EXPECT_EQ(error.found(), "no time of the step") << line;
    }
  }
}

TEST(Translate, FormulationsOfElementTypes) {
  const TranslatedDeck made = translated(replaced(good_deck, "TYPE=C3D8,", "TYPE=C3D8R,"));
  const Case read = case_of(made.tree, "x.inp");
  EXPECT_EQ(**read.parts[0].formulation, "one_point");
  EXPECT_FALSE(read.parts[1].formulation);
  EXPECT_TRUE(has_note(made, "C3D8R: one point"));
}

TEST(Translate, FacesBetweenTheNodesOfASurface) {
  const TranslatedDeck made =
      translated(replaced(good_deck, "*SURFACE, NAME=FOOT\nUPPER, S1", "*SURFACE, NAME=FOOT, TYPE=NODE\nFALLING"));
  EXPECT_EQ(*case_of(made.tree, "x.inp").contacts[0].group(), "FOOT (faces)");
  EXPECT_TRUE(has_note(made, "surface of nodes"));
}

// A cable's ends are faces, too: they alone would touch, and what is between them would fall through.
TEST(Translate, BarsBetweenTheNodesOfASurfaceTouchWithTheirSides) {
  const std::string truss =
      replaced(replaced(good_deck, "*ELEMENT, TYPE=C3D8, ELSET=UPPER\n2,11,12,13,14,15,16,17,18\n",
                        "*ELEMENT, TYPE=T3D2, ELSET=UPPER\n2,11,12\n3,12,13\n"),
               "ELSET=UPPER, MATERIAL=STEEL\n", "ELSET=UPPER, MATERIAL=STEEL\n0.1\n");
  const auto group = [&](const std::string& nodes) {
    return *case_from(replaced(truss, "*SURFACE, NAME=FOOT\nUPPER, S1", "*SURFACE, NAME=FOOT, TYPE=NODE\n" + nodes))
                .contacts[0]
                .group();
  };
  EXPECT_EQ(group("11\n12\n13"), "FOOT");
  EXPECT_EQ(group("11"), "FOOT (faces)");  // its end
}

TEST(Translate, GravityLineByLineIsThatOfAll) {
  const std::string deck =
      replaced(good_deck, "*CLOAD, AMPLITUDE=A\n15, 1, 5.", "*DLOAD\nUPPER, GRAV, 9., 0., 0., -1.\n");
  EXPECT_THROW(translated(deck), CaseError);
  const Case made = case_from(replaced(deck, "*DLOAD\n", "*DLOAD\nLOWER, GRAV, 9., 0., 0., -1.\n"));
  ASSERT_EQ(made.loads.size(), 1U);
  EXPECT_EQ(made.loads[0].vector, (Vec3{0.0, 0.0, -9.0}));
}

/// Abaqus Analysis User's Guide, "Distributed loads": gravity acts on the elements that are named, point masses as
/// well.
TEST(Translate, GravityThatLeavesPointMassesOutIsRefused) {
  const std::string deck = replaced(good_deck, "*SURFACE INTERACTION",
                                    "*ELEMENT, TYPE=MASS, ELSET=M\n50, 15\n*MASS, ELSET=M\n2.5\n*SURFACE INTERACTION");
  const std::string cells = replaced(deck, "*CLOAD, AMPLITUDE=A\n15, 1, 5.\n",
                                     "*DLOAD\nLOWER, GRAV, 9810., 0., 0., -1.\nUPPER, GRAV, 9810., 0., 0., -1.\n");
  const std::string refused = message_of(cells);
  EXPECT_NE(refused.find("*DLOAD: gravity on cells and not on all point masses. It would act on these, too."),
            std::string::npos)
      << refused;
  const std::string all = replaced(cells, "*END STEP", "*DLOAD\nM, GRAV, 9810., 0., 0., -1.\n*END STEP");
  EXPECT_EQ(case_from(all).loads.size(), 1U);
}

TEST(Translate, SupportsAndContactOfLaterStepsAreRefusedUnlessAccepted) {
  const std::string second = "*STEP\n*STATIC\n1., 1.\n";
  EXPECT_THROW(case_from(good_deck + second + "*BOUNDARY\nFALLING, 1\n*END STEP\n"), CaseError);
  EXPECT_THROW(case_from(good_deck + second + "*BOUNDARY, OP=NEW\nBASE, 1\n*END STEP\n"), CaseError);
  EXPECT_THROW(case_from(good_deck + second + "*CONTACT PAIR, INTERACTION=I\nFLOOR, FOOT\n*END STEP\n"), CaseError);
  EXPECT_EQ(case_from(good_deck + second + "*BOUNDARY, OP=NEW\nBASE, 1\n*END STEP\n", {"boundary"}).supports.size(),
            3U);
}

TEST(Translate, Ties) {
  const Case plain = case_from(replaced(good_deck, "*BOUNDARY", "*TIE, NAME=GLUE, ADJUST=NO\nFOOT, FLOOR\n*BOUNDARY"));
  ASSERT_EQ(plain.contacts.size(), 2U);
  EXPECT_EQ(*plain.contacts[0].name, "FOOT to FLOOR");
  const auto& tie = std::get<CaseTie>(plain.contacts[0].of);
  const auto& pair = std::get<CasePair>(plain.contacts[1].of);
  EXPECT_EQ(*tie.group, *pair.group);
  EXPECT_EQ(*tie.master, *pair.master);
  EXPECT_EQ(tie.method, TieMethod::node_to_surface);
  EXPECT_EQ(tie.far, FarNodes::refuse);
  EXPECT_FALSE(tie.distance.has_value());
  const Case wide =
      case_from(replaced(good_deck, "*BOUNDARY",
                         "*TIE, NAME=GLUE, POSITION TOLERANCE=0.2, TYPE=SURFACE TO SURFACE\nFOOT, FLOOR\n*BOUNDARY"));
  const auto& spread = std::get<CaseTie>(wide.contacts[0].of);
  EXPECT_EQ(spread.method, TieMethod::surface_to_surface);
  EXPECT_EQ(spread.far, FarNodes::leave);
  EXPECT_EQ(spread.distance, 0.2);
}

TEST(Translate, Equations) {
  const std::string sets = "*NSET, NSET=LEFT\n11, 14\n*NSET, NSET=RIGHT\n12, 13\n";
  const Case made = case_from(replaced(
      good_deck, "*BOUNDARY",
      sets + "*EQUATION\n2\nRIGHT, 1, 1., LEFT, 1, -1.\n5\n15, 2, 1., 16, 2, -0.5, 17, 2, -0.5, 18, 3, 2.,\n11, 1, "
             "4.\n*BOUNDARY"));
  ASSERT_EQ(made.equations.size(), 2U);
  ASSERT_EQ(made.equations[0].terms.size(), 2U);
  EXPECT_EQ(*made.equations[0].terms[1].nodes, "LEFT");
  EXPECT_EQ(*made.equations[0].terms[1].dof, "x");
  EXPECT_EQ(*made.equations[0].terms[1].coefficient, -1.0);
  ASSERT_EQ(made.equations[1].terms.size(), 5U);
  EXPECT_EQ(*made.equations[1].terms[3].dof, "z");
  EXPECT_EQ(*made.equations[1].terms[4].nodes, "11");
  EXPECT_EQ(*made.equations[1].terms[4].coefficient, 4.0);
}

TEST(Translate, EquationsThatCannotBeAreRefused) {
  const auto with = [](const std::string& equation) {
    return replaced(good_deck, "*BOUNDARY", "*EQUATION\n" + equation + "*BOUNDARY");
  };
  for (const char* bad : {"2\n15, 1, 1.\n", "1\n15, 4, 1.\n", "0\n", "2\n15, 1, 1., NOWHERE, 1, 1.\n"})
    EXPECT_THROW(case_from(with(bad)), CaseError) << bad;
  // By number 13 belongs to 11, by place 16 does.
  const std::string sets = "*NSET, NSET=A\n11, 14\n*NSET, NSET=B\n13, 16\n";
  EXPECT_THROW(case_from(replaced(good_deck, "*BOUNDARY", sets + "*EQUATION\n2\nA, 1, 1., B, 1, 1.\n*BOUNDARY")),
               CaseError);
  EXPECT_THROW(case_from(replaced(good_deck, "*CLOAD, AMPLITUDE=A", "*EQUATION\n2\n15, 1, 1., 16, 1, 1.\n*CLOAD")),
               CaseError);
}

TEST(Translate, NamedSupports) {
  const Case made = case_from(replaced(good_deck, "BASE, 1, 3", "BASE, YSYMM\nFALLING, 4, 6\n5, PINNED"));
  ASSERT_EQ(made.supports.size(), 4U);
  EXPECT_TRUE(made.supports[0].blocked[1]);
  EXPECT_EQ(*made.supports[3].nodes, "5");
}

/// All names that Abaqus has for nodes of solids, in upper and lower case; turns of nodes are nothing.
TEST(Translate, NamesOfSupportsHoldWhatTheySay) {
  for (const auto& [name, x, y, z] : {std::tuple{"encastre", true, true, true},
                                      {"PINNED", true, true, true},
                                      {"XSymm", true, false, false},
                                      {"YSYMM", false, true, false},
                                      {"ZSYMM", false, false, true},
                                      {"XASYMM", false, true, true},
                                      {"YASYMM", true, false, true},
                                      {"ZASYMM", true, true, false}}) {
    const Case made = case_from(replaced(good_deck, "BASE, 1, 3", std::string("BASE, ") + name));
    std::array<bool, 3> blocked{};
    for (const CaseSupport& support : made.supports)
      for (std::size_t c = 0; c < 3; ++c) blocked[c] = blocked[c] || support.blocked[c];
    EXPECT_EQ(blocked, (std::array{x, y, z})) << name;
  }
}

TEST(Translate, GravityPressureAndMasses) {
  const Case made = case_from(replaced(good_deck, "*CLOAD, AMPLITUDE=A\n15, 1, 5.",
                                       "*DLOAD\n, GRAV, 9810., 0., 0., -2.\nUPPER, P2, 3.\n*DSLOAD\nFLOOR, P, -1."));
  ASSERT_EQ(made.loads.size(), 3U);
  EXPECT_EQ(made.loads[0].vector, (Vec3{0.0, 0.0, -9810.0}));
  EXPECT_EQ(**made.loads[1].group, "UPPER P2");
  EXPECT_EQ(made.loads[2].pressure, -1.0);
}

TEST(Translate, WhatChangesThePhysicsIsRefusedAllAtOnceUnlessAccepted) {
  const std::string deck = replaced(good_deck, "*BOUNDARY", "*MPC\n1\n*FANCY STUFF\n*BOUNDARY");
  try {
    translated(deck);
    FAIL();
  } catch (const CaseError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("x.inp:39: *MPC"), std::string::npos) << what;
    EXPECT_NE(what.find("x.inp:41: *FANCY STUFF: an unknown keyword"), std::string::npos) << what;
    EXPECT_NE(what.find("--accept \"MPC,FANCY STUFF\""), std::string::npos) << what;
  }
  EXPECT_TRUE(has_note(translated(deck, {"mpc", "FancyStuff"}), "*MPC: not carried out"));
}

std::size_t count(const std::string& text, const std::string& of) {
  std::size_t n = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + 1)) ++n;
  return n;
}

/// An element type that Carom does not have hides nothing, and nothing follows from it: its cells are in their sets,
/// and sections, surfaces, loads and contact of them are not looked at.
TEST(Translate, AllFindingsOfADeckAreSaidAtOnce) {
  std::string deck = replaced(good_deck, "TYPE=C3D8, ELSET=UPPER", "TYPE=C3D9, ELSET=UPPER");
  deck = replaced(deck, "*DENSITY\n", "*CREEP\n1., 1., 1.\n*DENSITY\n");
  deck = replaced(deck, "*BOUNDARY\n", "*FANCY STUFF\n*BOUNDARY, FANCY=1\n");
  deck = replaced(deck, "15, 1, 5.\n", "15, 7, 5.\n*DLOAD\nUPPER, P2, 1.\n2, GRAV, 9.81, 0., 0., -1.\n");
  deck = replaced(deck, "FOOT, FLOOR\n", "FOOT, FLOOR\nFEET, FLOOR\n");
  const std::string what = message_of(deck);
  for (const char* finding :
       {"found 4 things that Carom does not carry over, and 3 that are wrong",
        "--accept \"CREEP,FANCY STUFF,BOUNDARY,DLOAD\"", "x.inp:22: *ELEMENT: found elements of type C3D9",
        "x.inp:35: *CREEP", "x.inp:41: *FANCY STUFF", "x.inp:42: *BOUNDARY: the parameter FANCY",
        "*CLOAD: found degree of freedom 7", "*CONTACT PAIR: found \"FEET\""})
    EXPECT_NE(what.find(finding), std::string::npos) << finding << " in " << what;
  EXPECT_EQ(count(what, "\n  x.inp:"), 7U) << what;
}

/// Each line of a keyword is looked at, whatever the others are.
TEST(Translate, AllLinesOfAKeywordAreLookedAt) {
  std::string deck = replaced(good_deck, "FALLING, 3, -1000.\n", "FALLNG, 3, -1000.\n99, 3, 1.\n");
  deck = replaced(deck, "FOOT, FLOOR\n", "FEET, FLOOR\nFOOT, GROUND\n");
  const std::string what = message_of(deck);
  for (const char* finding : {"found \"FALLNG\"", "found \"99\"", "found \"FEET\"", "found \"GROUND\""})
    EXPECT_NE(what.find(finding), std::string::npos) << finding << " in " << what;
}

/// What is wrong with nodes or sets is said with the findings of the survey, the materials and the steps.
TEST(Translate, AWrongMeshHidesNoKeyword) {
  std::string deck = replaced(good_deck, "LOWER, S2", "LOWR, S2");
  deck = replaced(deck, "*DENSITY\n", "*CREEP\n1., 1., 1.\n*DENSITY\n");
  deck = replaced(deck, "1e-6, 1e-3", "1e-6, -1.");
  const std::string what = message_of(deck);
  for (const char* finding : {"x.inp:29: *SURFACE: found 'LOWR'", "*CREEP", "found increment 1e-06, time -1"})
    EXPECT_NE(what.find(finding), std::string::npos) << finding << " in " << what;
  EXPECT_EQ(count(what, "\n  x.inp:"), 3U) << what;
}

TEST(Translate, AcceptedWordsAreKeywords) {
  const std::string deck = replaced(good_deck, "*BOUNDARY", "*SUBMODEL\n1\n*BOUNDARY");
  const std::string what = message_of(deck, {"sumbodel"});
  EXPECT_NE(what.find("--accept: found \"sumbodel\"; expected names of keywords. Did you mean \"SUBMODEL\"?"),
            std::string::npos)
      << what;
  EXPECT_NE(what.find("x.inp:39: *SUBMODEL"), std::string::npos) << what;
  EXPECT_TRUE(has_note(translated(deck, {"SUBMODEL", "CREEP"}), "--accept CREEP: nothing of the deck"));
  EXPECT_TRUE(has_note(translated(deck, {"*submode"}), "*SUBMODEL: not carried out"));
}

TEST(Translate, UnknownParametersAreRefusedAndThoseOfOutputNoted) {
  EXPECT_THROW(translated(replaced(good_deck, "*CLOAD, ", "*CLOAD, FOLLOWER, ")), CaseError);
  const TranslatedDeck made =
      translated(replaced(good_deck, "*END STEP", "*NODE PRINT, NSET=BASE\nU, RF\n*EL FILE\nS\n*END STEP"));
  EXPECT_TRUE(has_note(made, "*EL FILE"));
  EXPECT_TRUE(has_note(made, "RF: no probe"));
  EXPECT_EQ(case_of(made.tree, "x.inp").probes.size(), 4U);
}

/// Of Abaqus at once, of CalculiX and those that vary where they are accepted.
TEST(Translate, MassScaling) {
  const std::string step = "*DYNAMIC, DIRECT\n1e-6, 1e-3";
  const auto scaled = [&](const std::string& procedure, const std::vector<std::string>& accepted = {}) {
    return case_of(translated(replaced(good_deck, step, procedure), accepted).tree, "x.inp").scheme;
  };
  const CaseScheme fixed = scaled("*DYNAMIC, EXPLICIT\n, 1e-3\n*FIXED MASS SCALING, DT=2e-6, TYPE=BELOW MIN");
  EXPECT_EQ(**fixed.mass_scaling_step, 2e-6);
  EXPECT_EQ(*fixed.mass_scaling_limit, 1e9);
  EXPECT_FALSE(scaled("*DYNAMIC, EXPLICIT\n, 1e-3").mass_scaling_step);
  for (const char* refused :
       {"*DYNAMIC, EXPLICIT\n, 1e-3\n*VARIABLE MASS SCALING, DT=2e-6, TYPE=BELOW MIN, FREQUENCY=10",
        "*DYNAMIC, EXPLICIT=1\n1e-6, 1e-3, 2e-6"}) {
    EXPECT_THROW(scaled(refused), CaseError);
    EXPECT_EQ(**scaled(refused, {"VARIABLE MASS SCALING", "DYNAMIC"}).mass_scaling_step, 2e-6);
  }
  const std::string uniform =
      message_of(replaced(good_deck, step, "*DYNAMIC, EXPLICIT\n, 1e-3\n*FIXED MASS SCALING, DT=2e-6, TYPE=UNIFORM"));
  EXPECT_NE(uniform.find("*FIXED MASS SCALING: TYPE=UNIFORM. No mass would be added: write TYPE=BELOW MIN"),
            std::string::npos)
      << uniform;
  EXPECT_FALSE(scaled("*DYNAMIC\n1e-6, 1e-3, 1e-9, 1e-5").mass_scaling_step);  // halves as far as it must
}

/// Abaqus keyword *FIXED MASS SCALING: without DT and FACTOR masses are those of the material; ELSET limits it, and all
/// cells of parts are as good as none.
TEST(Translate, MassScalingOfSetsAndByFactors) {
  const std::string step = "*DYNAMIC, DIRECT\n1e-6, 1e-3", scaling = "*DYNAMIC, EXPLICIT\n, 1e-3\n*FIXED MASS SCALING";
  const auto with = [&](const std::string& parameters) { return replaced(good_deck, step, scaling + parameters); };
  const std::string all = replaced(with(", ELSET=BOTH, DT=2e-6"), "*STEP", "*ELSET, ELSET=BOTH\n1, 2\n*STEP");
  EXPECT_EQ(**case_from(all).scheme.mass_scaling_step, 2e-6);
  EXPECT_FALSE(case_from(with("")).scheme.mass_scaling_step);
  const std::string some = message_of(with(", ELSET=UPPER, DT=2e-6"));
  EXPECT_NE(some.find("x.inp:55: *FIXED MASS SCALING: masses of UPPER alone. Cells of all parts"), std::string::npos)
      << some;
  const std::string factor = message_of(with(", FACTOR=100."));
  EXPECT_NE(
      factor.find("*FIXED MASS SCALING: FACTOR=100 of masses. Masses would stay as they are, but for DT: multiply "
                  "the *DENSITY."),
      std::string::npos)
      << factor;
  EXPECT_NE(message_of(with(", ELSET=ROCK, DT=2e-6")).find("found ELSET=ROCK"), std::string::npos);
}

/// Abaqus Analysis User's Guide, "Mass scaling", in an analysis of several steps: the scaled masses of one step are
/// those of the next, unless it has a *FIXED MASS SCALING of its own.
TEST(Translate, ScaledMassesStayInLaterSteps) {
  const std::string scaled = replaced(good_deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3",
                                      "*DYNAMIC, EXPLICIT\n, 1e-3\n*FIXED MASS SCALING, DT=2e-6, TYPE=BELOW MIN");
  const auto next = [&](const std::string& keyword) {
    return case_from(scaled + "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-3\n" + keyword + "*END STEP\n").stages.at(0).scheme;
  };
  EXPECT_EQ(**next("").mass_scaling_step, 2e-6);
  EXPECT_EQ(**next("*FIXED MASS SCALING, DT=1e-6\n").mass_scaling_step, 1e-6);
  EXPECT_FALSE(next("*FIXED MASS SCALING\n").mass_scaling_step);
}

/// Abaqus Analysis User's Guide, "Implicit dynamic analysis using direct integration": TRANSIENT FIDELITY is
/// Hilber-Hughes-Taylor with alpha = -0.05; MODERATE DISSIPATION, the default beside contact, with alpha = -0.41421,
/// beyond -1/3, the strongest of hht here; QUASI-STATIC backward Euler, under which loads grow linearly.
TEST(Translate, ApplicationsOfImplicitSteps) {
  const auto with = [](const std::string& parameters) {
    return replaced(good_deck, "*DYNAMIC, DIRECT", "*DYNAMIC, DIRECT" + parameters);
  };
  const auto alpha = [&](const std::string& parameters, const std::vector<std::string>& accepted = {}) {
    return std::get<AlphaParameters>(case_from(with(parameters), accepted).scheme.parameters).alpha;
  };
  EXPECT_EQ(alpha(""), -0.05);
  EXPECT_EQ(alpha(", APPLICATION=TRANSIENT FIDELITY"), -0.05);
  EXPECT_EQ(alpha(", APPLICATION=MODERATE DISSIPATION"), -1.0 / 3.0);
  EXPECT_EQ(alpha(", TIME INTEGRATOR=HHT-MD"), -1.0 / 3.0);
  EXPECT_EQ(alpha(", APPLICATION=MODERATE DISSIPATION, ALPHA=-0.1"), -0.1);
  EXPECT_TRUE(has_note(translated(with(", APPLICATION=MODERATE DISSIPATION")), "Abaqus has -0.41421"));
  EXPECT_TRUE(has_note(translated(good_deck), "beside contact Abaqus takes APPLICATION=MODERATE DISSIPATION"));
  EXPECT_FALSE(has_note(translated(with(", ALPHA=0.")), "beside contact"));
  const std::string quasi = message_of(with(", APPLICATION=QUASI-STATIC"));
  EXPECT_NE(quasi.find("x.inp:53: *DYNAMIC: the backward Euler method"), std::string::npos) << quasi;
  EXPECT_EQ(alpha(", APPLICATION=QUASI-STATIC", {"DYNAMIC"}), -1.0 / 3.0);
  const std::string ramp = replaced(with(", APPLICATION=QUASI-STATIC"), "*CLOAD, AMPLITUDE=A", "*CLOAD");
  EXPECT_EQ(case_from(ramp, {"DYNAMIC"}).functions.at(0).function(5e-4), 0.5);
  EXPECT_NE(
      message_of(with(", APPLICATION=FAST")).find("expected TRANSIENTFIDELITY, MODERATEDISSIPATION, QUASI-STATIC"),
      std::string::npos);
}

TEST(Translate, MasslessContactKeepsItsMassWhereAccepted) {
  const std::string deck =
      replaced(good_deck, "*CONTACT PAIR, INTERACTION=I", "*CONTACT PAIR, INTERACTION=I, TYPE=MASSLESS");
  EXPECT_NE(message_of(deck).find("TYPE=MASSLESS. Nodes in contact would keep their mass"), std::string::npos);
  EXPECT_EQ(case_of(translated(deck, {"CONTACT PAIR"}).tree, "x.inp").contacts.size(), 1U);
}

/// Elements that go with a keyword that is accepted: what gives them their properties says what is lost.
TEST(Translate, ElementsOfAcceptedKeywordsAreLeftOut) {
  const struct {
    const char *type, *keyword;
  } rows[] = {{"DASHPOTA", "DASHPOT"}, {"GAPUNI", "GAP"}, {"CONN3D2", "CONNECTOR SECTION"}};
  for (const auto& row : rows) {
    const std::string keyword = row.keyword;
    const std::string deck = replaced(good_deck, "*SURFACE INTERACTION",
                                      std::string("*ELEMENT, TYPE=") + row.type + ", ELSET=D\n90, 5, 11\n*" + keyword +
                                          ", ELSET=D\n1.\n*SURFACE INTERACTION");
    const std::string refused = message_of(deck);
    EXPECT_NE(refused.find("--accept \"" + keyword + "\" runs without:\n  x.inp:45: *" + keyword), std::string::npos)
        << refused;
    EXPECT_EQ(case_from(deck, {keyword}).parts.size(), 2U);
    EXPECT_TRUE(has_note(translated(deck, {keyword}), std::string(row.type) + ": left out with its *" + keyword));
  }
}

/// Abaqus Analysis User's Guide, "Choosing the element's formulation": hybrid elements have the pressure as a further
/// unknown, for materials that are nearly or quite incompressible; their nodes and points are those of their twins.
TEST(Translate, HybridElementsAreTheirTwins) {
  const std::string deck = replaced(good_deck, "TYPE=C3D8, ELSET=UPPER", "TYPE=C3D8RH, ELSET=UPPER");
  EXPECT_EQ(**case_from(deck).parts[1].formulation, "one_point");
  EXPECT_TRUE(has_note(translated(deck), "C3D8RH: its pressure is no unknown of its own"));
}

/// Abaqus keyword *BULK VISCOSITY: of a step and those behind it; 0.06 and 1.2 where none is given.
TEST(Translate, BulkViscosityThatChangesIsRefused) {
  const std::string one = replaced(good_deck, "*DYNAMIC, DIRECT\n1e-6, 1e-3", "*DYNAMIC, EXPLICIT\n, 1e-3");
  const std::string next = "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-3\n*BULK VISCOSITY\n0.06, 1.2\n*END STEP\n";
  EXPECT_EQ(case_from(one + next).parts[0].linear_bulk_viscosity, 0.06);
  const std::string other = message_of(one + replaced(next, "0.06", "0.2"));
  EXPECT_NE(other.find("*BULK VISCOSITY: another bulk viscosity than in a step before"), std::string::npos) << other;
}

/// Abaqus keyword *AMPLITUDE: EQUALLY SPACED has values alone, FIXED INTERVAL apart, from BEGIN on.
TEST(Translate, AmplitudesOfEquallySpacedValues) {
  const auto with = [](const std::string& keyword, const std::string& lines) {
    return replaced(good_deck, "*AMPLITUDE, NAME=A\n0., 0., 1e-3, 1.", "*AMPLITUDE, NAME=A, " + keyword + "\n" + lines);
  };
  const Case made = case_from(with("DEFINITION=EQUALLY SPACED, FIXED INTERVAL=5e-4", "0., 1.\n0.5"));
  EXPECT_DOUBLE_EQ(made.functions.at(0).function(2.5e-4), 0.5);
  EXPECT_DOUBLE_EQ(made.functions.at(0).function(1e-3), 0.5);
  EXPECT_NE(message_of(with("DEFINITION=EQUALLY SPACED", "0., 1.")).find("found no FIXED INTERVAL"), std::string::npos);
  EXPECT_NE(message_of(with("DEFINITION=PERIODIC", "1, 6.28, 0., 0.\n0., 1.")).find("found DEFINITION=PERIODIC"),
            std::string::npos);
}

/// *RESTART, READ goes on with another run; its other parameters say what is written.
TEST(Translate, RestartOfAnotherRunIsRefused) {
  EXPECT_TRUE(has_note(translated("*RESTART, WRITE, FREQUENCY=1\n" + good_deck), "*RESTART: WRITE changes nothing"));
  EXPECT_NE(message_of("*RESTART, READ, STEP=1\n" + good_deck).find("*RESTART: the parameter READ is not known"),
            std::string::npos);
}

/// Every keyword that asks for results or messages alone is a note: a deck with all of them is a case.
TEST(Translate, OutputAloneIsANote) {
  for (const KeywordEntry& entry : keyword_table()) {
    if (entry.use != KeywordUse::output) continue;
    const std::string keyword = "*" + std::string(entry.name);
    EXPECT_TRUE(has_note(translated(replaced(good_deck, "*END STEP", keyword + ", FREQUENCY=1\n*END STEP")), keyword));
  }
  for (const char* name : {"INCREMENTATION OUTPUT", "INTEGRATED OUTPUT SECTION", "MODAL OUTPUT", "RADIATION OUTPUT",
                           "SECTION FILE", "MONITOR", "PREPRINT", "FILE FORMAT", "DISPLAY BODY"})
    EXPECT_EQ(find_keyword(name)->use, KeywordUse::output) << name;
}

TEST(Translate, ComponentsOfOutputAreProbes) {
  const TranslatedDeck made =
      translated(replaced(good_deck, "*END STEP", "*NODE OUTPUT, NSET=FALLING\nU3, V3, A3, RF3\n*END STEP"));
  const Case given = case_of(made.tree, "x.inp");
  ASSERT_EQ(given.probes.size(), 8U);
  EXPECT_EQ(given.probes[0].quantities.size(), 3U);
  EXPECT_TRUE(has_note(made, "RF3: no probe"));
}

TEST(Translate, HistoriesOfStepsWithAndWithoutRamps) {
  DeckStep first, second;
  first.ramps = true;
  second.start = 1.0;
  second.period = 2.0;
  const std::vector<DeckStep> steps{first, second};
  // A jump between two steps comes just after: the first ends with its own value.
  EXPECT_EQ(history({{0, 4.0}}, steps), (Points{{0.0, 0.0}, {1.0, 4.0}}));
  EXPECT_EQ(history({{0, 4.0}, {1, 6.0}}, steps), (Points{{0.0, 0.0}, {1.0, 4.0}, {1.0 + 2e-9, 6.0}, {3.0, 6.0}}));
  EXPECT_EQ(history({{1, 6.0}}, steps), (Points{{1.0, 0.0}, {1.0 + 2e-9, 6.0}, {3.0, 6.0}}));
  Amplitude amplitude{nullptr, {{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.0}}, false};
  EXPECT_EQ(history({{1, 2.0, &amplitude}}, steps), (Points{{1.0, 0.0}, {1.5, 2.0}, {2.0, 0.0}, {3.0, 0.0}}));
  Amplitude total{nullptr, {{0.0, 0.0}, {4.0, 8.0}}, true};  // goes on where nothing is said
  EXPECT_EQ(history({{0, 1.0, &total}}, steps), (Points{{0.0, 0.0}, {1.0, 2.0}, {3.0, 6.0}}));
  const Amplitude jump{nullptr, {{0.0, 1.0}, {0.5, 1.0}, {0.5, 0.0}, {3.0, 0.0}}, false};
  EXPECT_EQ(history({{0, 2.0, &jump}}, {first}), (Points{{0.0, 2.0}, {0.5, 2.0}, {0.5, 0.0}, {1.0, 0.0}}));
  amplitude.is_total = true;  // its second half lies in the first step
  EXPECT_EQ(history({{1, 2.0, &amplitude}}, steps), (Points{{1.0, 0.0}, {3.0, 0.0}}));
}

TEST(Translate, ThePageInTheRepositoryIsCurrent) {
  std::ifstream file(std::string(CAROM_SOURCE_DIR) + "/docs/decks.md");
  const std::string committed{std::istreambuf_iterator<char>(file), {}}, current = decks_markdown();
  if (committed != current) std::ofstream(testing::TempDir() + "decks.md") << current;
  EXPECT_TRUE(committed == current) << "copy " << testing::TempDir() << "decks.md to docs/decks.md";
}

/// What a static step has ramped up may stay in the step that follows; another value there would be a jump.
TEST(Translate, DisplacementsMayStayButNotJumpBetweenSteps) {
  const std::string ramped = replaced(good_deck, "*STEP\n*DYNAMIC, DIRECT\n1e-6, 1e-3",
                                      "*STEP\n*STATIC\n0.5, 1.\n*BOUNDARY\nFALLING, 1, 1, 0.1\n*END STEP\n"
                                      "*STEP\n*DYNAMIC, DIRECT\n1e-6, 1e-3\n*BOUNDARY\nFALLING, 1, 1, 0.1");
  EXPECT_EQ(message_of(ramped), "no error");
  const std::string jumps =
      message_of(replaced(ramped, "1e-3\n*BOUNDARY\nFALLING, 1, 1, 0.1", "1e-3\n*BOUNDARY\nFALLING, 1, 1, 0.2"));
  EXPECT_NE(jumps.find("a displacement of FALLING that jumps at t = 1;"), std::string::npos) << jumps;
  const auto by = [](const std::string& amplitude) {
    return message_of(replaced(replaced(good_deck, "0., 0., 1e-3, 1.", amplitude), "1e-6, 1e-3\n",
                               "1e-6, 1e-3\n*BOUNDARY, AMPLITUDE=A\nFALLING, 1, 1, 0.1\n"));
  };
  EXPECT_EQ(by("0., 0., 1e-9, 1."), "no error");  // steep is no jump
  EXPECT_NE(by("0., 0., 5e-4, 0., 5e-4, 1.").find("a displacement of FALLING that jumps at t = 0.0005;"),
            std::string::npos)
      << by("0., 0., 5e-4, 0., 5e-4, 1.");
}

}  // namespace
}  // namespace carom::translate_test
