// Decks as cases: what each keyword becomes.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "casefile/read_case.hpp"
#include "casefile/write_toml.hpp"
#include "translate/amplitudes.hpp"
#include "translate/decks_page.hpp"
#include "translate/translate_deck.hpp"
#include "translate_fixture.hpp"

namespace carom::translate_test {
namespace {

using test::good_deck;
using test::replaced;

std::string no_file(const std::string& path, const Location& where) {
  throw CaseError(where, "*INCLUDE", "no file " + path, "");
}

TranslatedDeck translated(const std::string& text, const std::vector<std::string>& accepted = {}) {
  return translate_deck(text, "x.inp", accepted, no_file);
}

Case case_from(const std::string& text, const std::vector<std::string>& accepted = {}) {
  return case_of(translated(text, accepted).tree, "x.inp");
}

bool has_note(const TranslatedDeck& deck, const std::string& part) {
  return std::any_of(deck.notes.begin(), deck.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

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

TEST(Translate, PlasticityAsATable) {
  const std::string deck = replaced(good_deck, "*DENSITY", "*PLASTIC\n300., 0.\n400., 0.1\n*DENSITY");
  const Case made = case_from(deck);
  EXPECT_EQ(*made.materials[0].law, "j2_small_strain");
  EXPECT_EQ(*made.materials[0].curve, (std::vector<std::array<double, 2>>{{0.0, 300.0}, {0.1, 400.0}}));
  EXPECT_EQ(*case_from(replaced(deck, "*STEP\n", "*STEP, NLGEOM\n")).materials[0].law, "j2");
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
  EXPECT_EQ(*made.materials[0].value("melting_temperature"), 1356.0);
  EXPECT_EQ(*made.materials[0].value("taylor_quinney"), 0.9);
}

/// C10 = G / 2 and D1 = 2 / K: E = 9 K G / (3 K + G).
TEST(Translate, NeoHookeOnlyWhereItsPotentialIsAccepted) {
  const std::string deck = replaced(replaced(good_deck, "*ELASTIC\n210000., 0.3", "*HYPERELASTIC, NEO HOOKE\n0.5, 0.2"),
                                    "*STEP\n", "*STEP, NLGEOM\n");
  EXPECT_THROW(case_from(deck), CaseError);
  const Case made = case_from(deck, {"hyperelastic"});
  EXPECT_EQ(*made.materials[0].law, "neo_hookean");
  EXPECT_NEAR(*made.materials[0].value("E"), 90.0 / 31.0, 1e-15);  // K = 10, G = 1
  EXPECT_NEAR(*made.materials[0].value("nu"), 28.0 / 62.0, 1e-15);
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

/// The lower cube replaced by a rigid square with the reference node 99.
std::string with_rigid_wall(const std::string& reference) {
  const std::string wall = replaced(good_deck, "*ELEMENT, TYPE=C3D8, ELSET=LOWER\n1,1,2,3,4,5,6,7,8\n",
                                    "99,0,0,0\n*ELEMENT, TYPE=R3D4, ELSET=LOWER\n1,5,6,7,8\n");
  return replaced(replaced(replaced(wall, "LOWER, S2", "LOWER, SPOS"), "*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL\n",
                           "*RIGID BODY, ELSET=LOWER, REF NODE=99\n"),
                  "*BOUNDARY\nBASE, 1, 3\n", reference);
}

TEST(Translate, ARigidSurfaceAtRestIsAnObstacle) {
  const Case made = case_from(with_rigid_wall("*BOUNDARY\n99, ENCASTRE\n"));
  EXPECT_EQ(*made.contacts[0].kind, "surface");
  EXPECT_EQ(**made.contacts[0].own_cells(), "FLOOR");
  EXPECT_FALSE(made.contacts[0].obstacle()->velocity);
  EXPECT_TRUE(made.supports.empty());
}

TEST(Translate, ADisplacedReferenceNodeMovesItsSurfaceByTheSlope) {
  const Case made = case_from(
      replaced(with_rigid_wall("*BOUNDARY\n99, 1, 2\n"), "*CLOAD", "*BOUNDARY, AMPLITUDE=A\n99, 3, 3, 0.5\n*CLOAD"));
  EXPECT_EQ(*made.contacts[0].obstacle()->velocity, (Vec3{0.0, 0.0, 500.0}));  // 0.5 in 1e-3
  ASSERT_TRUE(made.contacts[0].obstacle()->function);
  for (const CaseFunction& function : made.functions) {
    if (function.name != **made.contacts[0].obstacle()->function) continue;
    EXPECT_EQ(function.function(5e-4), 1.0);
    EXPECT_EQ(function.function(2e-3), 0.0);
  }
}

TEST(Translate, AFreeRigidSurfaceHasTheMassOfItsReferenceNode) {
  const Case made = case_from(replaced(with_rigid_wall("*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n"),
                                       "FALLING, 3, -1000.", "FALLING, 3, -1000.\n99, 3, 20."));
  EXPECT_EQ(*made.contacts[0].obstacle()->body.mass, 2.5);
  EXPECT_EQ(*made.contacts[0].obstacle()->velocity, (Vec3{0.0, 0.0, 20.0}));
  EXPECT_TRUE(made.point_masses.empty());
  EXPECT_EQ(made.initial.size(), 1U);
}

TEST(Translate, AReferenceNodeThatIsNotHeldIsRefused) {
  EXPECT_THROW(case_from(with_rigid_wall("*BOUNDARY\n99, 3\n")), CaseError);
}

/// The rigid square; its reference node, which stands at (1, 2, 0.5), is held but for what the step says of it.
std::string with_turning_wall(const std::string& in_step, const std::string& held = "99, 1, 6") {
  const std::string wall = replaced(with_rigid_wall("*BOUNDARY\n" + held + "\n"), "99,0,0,0\n", "99,1,2,0.5\n");
  return replaced(wall, "*CLOAD", in_step + "*CLOAD");
}

const CaseFunction& function_named(const Case& made, const std::string& name) {
  const auto found = std::find_if(made.functions.begin(), made.functions.end(),
                                  [&](const CaseFunction& function) { return function.name == name; });
  EXPECT_NE(found, made.functions.end()) << name;
  return *found;
}

TEST(Translate, AReferenceNodeTurnsItsSurface) {
  const TranslatedDeck deck = translated(with_turning_wall("*BOUNDARY, TYPE=VELOCITY\n99, 6, 6, 3.\n99, 4, 4, -4.\n"));
  const Case made = case_of(deck.tree, "x.inp");
  const CaseObstacle& wall = *made.contacts[0].obstacle();
  EXPECT_EQ(**wall.body.angular_velocity, (Vec3{-4.0, 0.0, 3.0}));
  EXPECT_EQ(to_string(wall.body.angular_velocity->where), "x.inp:57");  // of the last component
  EXPECT_EQ(*wall.body.centre_of_rotation, (Vec3{1.0, 2.0, 0.5}));
  EXPECT_FALSE(wall.velocity);
  EXPECT_FALSE(wall.function);
  EXPECT_FALSE(wall.angular_function);
  EXPECT_FALSE(has_note(deck, "does not turn"));
  EXPECT_TRUE(made.supports.empty());
}

// 1.5 radians in 1e-3, as the amplitude goes; the travel has a time of its own.
TEST(Translate, ATurnByAnAmplitudeHasItsSlope) {
  const Case made =
      case_from(with_turning_wall("*BOUNDARY, AMPLITUDE=A\n99, 5, 6, 1.5\n"
                                  "*BOUNDARY, TYPE=VELOCITY\n99, 1, 1, 7.\n"));
  const CaseObstacle& wall = *made.contacts[0].obstacle();
  EXPECT_EQ(**wall.body.angular_velocity, (Vec3{0.0, 1500.0, 1500.0}));
  EXPECT_EQ(*wall.velocity, (Vec3{7.0, 0.0, 0.0}));
  EXPECT_FALSE(wall.function);
  EXPECT_EQ(function_named(made, **wall.angular_function).function(5e-4), 1.0);
  EXPECT_EQ(function_named(made, **wall.angular_function).function(2e-3), 0.0);
}

// Else the rotation would have the function of the travel.
TEST(Translate, ASteadyTurnBesideATravelWithAFunction) {
  const Case made =
      case_from(with_turning_wall("*BOUNDARY, AMPLITUDE=A\n99, 1, 1, 1.5\n"
                                  "*BOUNDARY, TYPE=VELOCITY\n99, 6, 6, 7.\n"));
  const CaseObstacle& wall = *made.contacts[0].obstacle();
  EXPECT_EQ(**wall.body.angular_velocity, (Vec3{0.0, 0.0, 7.0}));
  EXPECT_EQ(function_named(made, **wall.function).function(2e-3), 0.0);
  EXPECT_EQ(function_named(made, **wall.angular_function).function(2e-3), 1.0);
}

// A third of an amplitude and a seventh of it are rounded differently.
TEST(Translate, MultiplesOfOneAmplitudeAreOneFunction) {
  const std::string smooth = "*AMPLITUDE, NAME=S, DEFINITION=SMOOTH STEP\n0., 0., 1e-3, 0.7\n";
  const std::string deck =
      with_turning_wall("*BOUNDARY, AMPLITUDE=S\n99, 4, 4, 0.3333333\n99, 5, 5, 0.1428571\n99, 6, 6, -0.7\n");
  const Case made = case_from(replaced(deck, "*STEP\n", smooth + "*STEP\n"));
  const Vec3 rate = **made.contacts[0].obstacle()->body.angular_velocity;
  EXPECT_NEAR(rate[1] / rate[0], 0.1428571 / 0.3333333, 1e-12);
  EXPECT_NEAR(rate[2] / rate[0], -0.7 / 0.3333333, 1e-12);
}

TEST(Translate, ASetOfReferenceNodesImposesOnEachBody) {
  const std::string second =
      "98,0,0,3\n25,0,0,3\n26,1,0,3\n27,1,1,3\n28,0,1,3\n"
      "*ELEMENT, TYPE=R3D4, ELSET=LID\n9,25,28,27,26\n*SURFACE, NAME=COVER\nLID, SPOS\n*SURFACE, NAME=HEAD\nUPPER, S2\n"
      "*RIGID BODY, ELSET=LID, REF NODE=98\n*NSET, NSET=BOTH\n98, 99\n*ELEMENT, TYPE=R3D4, ELSET=LOWER\n";
  const std::string deck = replaced(with_rigid_wall("*BOUNDARY\nBOTH, 1, 5\nBOTH, 6, 6, 0.\n"),
                                    "*ELEMENT, TYPE=R3D4, ELSET=LOWER\n", second);
  const Case made = case_from(replaced(replaced(deck, "FOOT, FLOOR", "FOOT, FLOOR\nHEAD, COVER"), "*CLOAD",
                                       "*BOUNDARY, TYPE=VELOCITY\nBOTH, 6, 6, 2.\n98, 6, 6, 5.\n*CLOAD"));
  ASSERT_EQ(made.contacts.size(), 2U);
  EXPECT_EQ(**made.contacts[0].obstacle()->body.angular_velocity, (Vec3{0.0, 0.0, 2.0}));
  EXPECT_EQ(**made.contacts[1].obstacle()->body.angular_velocity, (Vec3{0.0, 0.0, 5.0}));
  EXPECT_EQ(*made.contacts[1].obstacle()->body.centre_of_rotation, (Vec3{0.0, 0.0, 3.0}));
  EXPECT_TRUE(made.supports.empty());
}

/// The free rigid square with a mass of 2.5 and an inertia; `more` stands before the steps.
std::string with_free_wall(const std::string& more) {
  return replaced(with_rigid_wall("*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n"
                                  "*ELEMENT, TYPE=ROTARYI, ELSET=J\n51, 99\n"
                                  "*ROTARY INERTIA, ELSET=J\n4., 5., 6., 0.1, 0.2, 0.3\n" +
                                  more),
                  "99,0,0,0\n", "99,1,2,0.5\n");
}

TEST(Translate, AFreeRigidSurfaceTurnsByItsRotaryInertia) {
  const Case made = case_from(
      replaced(with_free_wall(""), "FALLING, 3, -1000.", "FALLING, 3, -1000.\n99, 2, 20.\n99, 5, 30.\n99, 6, 40."));
  const CaseObstacle& wall = *made.contacts[0].obstacle();
  EXPECT_EQ(*wall.body.mass, 2.5);
  EXPECT_EQ(**wall.body.inertia, (Vec3{4.0, 5.0, 6.0}));
  EXPECT_EQ(*wall.body.products_of_inertia, (Vec3{0.1, 0.3, 0.2}));  // xy, yz, zx of xy, xz, yz
  EXPECT_EQ(*wall.body.centre_of_mass, (Vec3{1.0, 2.0, 0.5}));
  EXPECT_EQ(*wall.velocity, (Vec3{0.0, 20.0, 0.0}));
  EXPECT_EQ(**wall.body.angular_velocity, (Vec3{0.0, 30.0, 40.0}));
  EXPECT_EQ(made.initial.size(), 1U);
}

// omega x (X - a) = (0, 0, 2) x (1, 2, 0) = (-4, 2, 0) beside the velocity (5, 6, 7), from the node or the cells.
TEST(Translate, ARotatingVelocityOfAFreeRigidSurface) {
  for (const std::string target : {"99", "LOWER"}) {
    const Case made = case_from(with_free_wall("*INITIAL CONDITIONS, TYPE=ROTATING VELOCITY\n" + target +
                                               ", 2., 5., 6., 7.\n0., 0., 0., 0., 0., 1.\n"));
    const CaseObstacle& wall = *made.contacts[0].obstacle();
    EXPECT_EQ(*wall.velocity, (Vec3{1.0, 8.0, 7.0})) << target;
    EXPECT_EQ(**wall.body.angular_velocity, (Vec3{0.0, 0.0, 2.0})) << target;
    EXPECT_EQ(made.initial.size(), 1U) << target;
  }
}

TEST(Translate, AFreeRigidSurfaceThatIsHeldAboutAllAxesDoesNotTurn) {
  const TranslatedDeck deck = translated(with_free_wall("*BOUNDARY\n99, 4, 6\n"));
  const Case made = case_of(deck.tree, "x.inp");
  EXPECT_EQ(*made.contacts[0].obstacle()->body.mass, 2.5);
  EXPECT_FALSE(made.contacts[0].obstacle()->body.inertia);
  EXPECT_TRUE(has_note(deck, "the rigid body does not turn"));
}

/// A square of plane cells over a rigid line, `type`, with the reference node 99.
std::string plane_deck(const std::string& type, const std::string& cells, const std::string& more) {
  return "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n11,-1,0\n12,2,0\n99,0,-2\n*ELEMENT, TYPE=" + cells +
         ", ELSET=BODY\n1,1,2,3,4\n*ELEMENT, TYPE=" + type +
         ", ELSET=LINE\n2,11,12\n*SURFACE, NAME=FOOT\nBODY, S1\n*SURFACE, NAME=FLOOR\nLINE, SPOS\n"
         "*RIGID BODY, ELSET=LINE, REF NODE=99\n*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n"
         "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n*SURFACE INTERACTION, NAME=I\n*CONTACT PAIR, INTERACTION=I\n"
         "FOOT, FLOOR\n" +
         more + "*STEP\n*DYNAMIC\n1e-6, 1e-3\n*END STEP\n";
}

TEST(Translate, RigidLinesTurnInThePlane) {
  const Case led = case_from(plane_deck("R2D2", "CPE4", "*BOUNDARY, TYPE=VELOCITY\n99, 1, 2\n99, 6, 6, 3.\n"));
  EXPECT_EQ(**led.contacts[0].obstacle()->body.angular_velocity, (Vec3{0.0, 0.0, 3.0}));
  EXPECT_EQ(*led.contacts[0].obstacle()->body.centre_of_rotation, (Vec3{0.0, -2.0, 0.0}));
  const std::string inertia =
      "*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n"
      "*ELEMENT, TYPE=ROTARYI, ELSET=J\n51, 99\n*ROTARY INERTIA, ELSET=J\n0., 0., 6.\n";
  const Case free = case_from(plane_deck("R2D2", "CPE4", inertia));
  EXPECT_EQ(**free.contacts[0].obstacle()->body.inertia, (Vec3{6.0, 6.0, 6.0}));
}

TEST(Translate, ARingMovesAlongItsAxis) {
  const Case made = case_from(plane_deck("RAX2", "CAX4", "*BOUNDARY, TYPE=VELOCITY\n99, 1, 1\n99, 2, 2, 3.\n99, 6\n"));
  EXPECT_EQ(*made.contacts[0].obstacle()->velocity, (Vec3{0.0, 3.0, 0.0}));
  EXPECT_FALSE(made.contacts[0].obstacle()->body.angular_velocity);
}

TEST(Translate, MotionsOfRigidBodiesThatCannotBeAreRefused) {
  const auto refusal = [](const std::string& deck) {
    try {
      case_from(deck);
    } catch (const CaseError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(refusal(with_turning_wall("*BOUNDARY, TYPE=VELOCITY\n99, 4, 4, 3.\n*BOUNDARY, TYPE=VELOCITY, "
                                      "AMPLITUDE=A\n99, 6, 6, 3.\n")),
            "x.inp:59: *BOUNDARY: found a turn with an amplitude for each axis; expected one amplitude for all. "
            "Carom's obstacles turn about an axis of fixed direction.");
  EXPECT_EQ(refusal(with_turning_wall("*BOUNDARY, TYPE=ACCELERATION\n99, 6, 6, 3.\n")),
            "x.inp:57: *BOUNDARY: found an imposed acceleration of the reference node of a rigid body; expected its "
            "velocity or displacement");
  EXPECT_EQ(refusal(with_free_wall("*BOUNDARY, TYPE=VELOCITY\n99, 6, 6, 3.\n")),
            "x.inp:49: *BOUNDARY: found a turn that is imposed on a rigid body that moves freely; expected a body that "
            "is held or moved along all axes, or turns freely too. Impose its degrees of freedom 1 to 3, or give it a "
            "*ROTARY INERTIA.");
  EXPECT_EQ(refusal(with_free_wall("*BOUNDARY\n99, 4, 5\n")),
            "x.inp:38: *RIGID BODY: found a free rigid body that is held about 2 of 3 axes; expected about all, or "
            "none. Carom's free bodies turn about every axis or do not turn.");
  EXPECT_EQ(refusal(with_free_wall("*BOUNDARY\n99, 1, 3\n")),
            "x.inp: found something that Carom does not carry over; expected a deck that loses nothing of its physics. "
            "--accept \"ROTARY INERTIA\" runs without:\n  x.inp:38: *ROTARY INERTIA: a rigid body that is held in its "
            "place and not in its turns. It would turn only as *BOUNDARY says.");
  EXPECT_EQ(refusal(with_free_wall("*INITIAL CONDITIONS, TYPE=VELOCITY\n99, 6, 30.\n*BOUNDARY\n99, 4, 6\n")),
            "x.inp:38: *RIGID BODY: found an angular velocity of a rigid body that does not turn; expected a *ROTARY "
            "INERTIA of its reference node, which *BOUNDARY does not hold");
  EXPECT_EQ(refusal(plane_deck("R2D2", "CPE4", "*BOUNDARY, TYPE=VELOCITY\n99, 1, 3\n99, 4, 4, 3.\n")),
            "x.inp:29: *BOUNDARY: found a motion of degree of freedom 4 of a rigid body in the plane; expected 1, 2 or "
            "6. Plane cells have no displacement along z.");
  EXPECT_EQ(refusal(plane_deck("RAX2", "CAX4", "*BOUNDARY, TYPE=VELOCITY\n99, 1, 2\n99, 6, 6, 3.\n")),
            "x.inp:29: *BOUNDARY: found a motion of degree of freedom 6 of a rigid body around an axis; expected 2 "
            "alone. What moves otherwise is no ring: model it in three dimensions.");
  EXPECT_EQ(refusal(plane_deck("R2D2", "CPE4", "*BOUNDARY\n99, 1\n")),
            "x.inp:17: *RIGID BODY: found a reference node that is held along 1 of 2 axes; expected all of them "
            "imposed, or none and a *MASS. Say with *BOUNDARY what its reference node does.");
}

// The tensor is given along the axes of the part, which the instance turns.
TEST(Translate, AnInertiaInAnInstanceThatTurnsIsRefused) {
  const std::string deck = plane_deck("R2D2", "CPE4", "*BOUNDARY\n99, 1, 2\n");
  const auto in_instance = [&](const std::string& placement) {
    return "*PART, NAME=P\n*NODE\n1,0,0\n*ELEMENT, TYPE=ROTARYI, ELSET=J\n1,1\n*ROTARY INERTIA, ELSET=J\n1.,1.,1.\n"
           "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n" +
           placement + "*END INSTANCE\n*END ASSEMBLY\n" + deck;
  };
  try {
    translated(in_instance("0., 0., 0.\n0., 0., 0., 0., 0., 1., 90.\n"));
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_EQ(to_string(error.where()), "x.inp:7");
    EXPECT_EQ(error.found(), "an inertia in an instance that is turned");
  }
  try {
    translated(in_instance(""));
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("*ROTARY INERTIA: an inertia of nodes that no *RIGID BODY refers to"),
              std::string::npos)
        << error.what();
  }
}

TEST(Translate, GravityLineByLineIsThatOfAll) {
  const std::string deck =
      replaced(good_deck, "*CLOAD, AMPLITUDE=A\n15, 1, 5.", "*DLOAD\nUPPER, GRAV, 9., 0., 0., -1.\n");
  EXPECT_THROW(translated(deck), CaseError);
  const Case made = case_from(replaced(deck, "*DLOAD\n", "*DLOAD\nLOWER, GRAV, 9., 0., 0., -1.\n"));
  ASSERT_EQ(made.loads.size(), 1U);
  EXPECT_EQ(made.loads[0].vector, (Vec3{0.0, 0.0, -9.0}));
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

TEST(Translate, GravityPressureAndMasses) {
  const Case made = case_from(replaced(good_deck, "*CLOAD, AMPLITUDE=A\n15, 1, 5.",
                                       "*DLOAD\n, GRAV, 9810., 0., 0., -2.\nUPPER, P2, 3.\n*DSLOAD\nFLOOR, P, -1."));
  ASSERT_EQ(made.loads.size(), 3U);
  EXPECT_EQ(made.loads[0].vector, (Vec3{0.0, 0.0, -9810.0}));
  EXPECT_EQ(**made.loads[1].group, "UPPER P2");
  EXPECT_EQ(made.loads[2].pressure, -1.0);
}

TEST(Translate, WhatChangesThePhysicsIsRefusedAllAtOnceUnlessAccepted) {
  const std::string deck = replaced(good_deck, "*BOUNDARY", "*COUPLING\n1\n*FANCY STUFF\n*BOUNDARY");
  try {
    translated(deck);
    FAIL();
  } catch (const CaseError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("x.inp:39: *COUPLING"), std::string::npos) << what;
    EXPECT_NE(what.find("x.inp:41: *FANCY STUFF: an unknown keyword"), std::string::npos) << what;
    EXPECT_NE(what.find("--accept \"COUPLING,FANCY STUFF\""), std::string::npos) << what;
  }
  EXPECT_TRUE(has_note(translated(deck, {"coupling", "FancyStuff"}), "*COUPLING: not carried out"));
}

TEST(Translate, UnknownParametersAreRefusedAndThoseOfOutputNoted) {
  EXPECT_THROW(translated(replaced(good_deck, "*CLOAD, ", "*CLOAD, FOLLOWER, ")), CaseError);
  const TranslatedDeck made =
      translated(replaced(good_deck, "*END STEP", "*NODE PRINT, NSET=BASE\nU, RF\n*EL FILE\nS\n*END STEP"));
  EXPECT_TRUE(has_note(made, "*EL FILE"));
  EXPECT_TRUE(has_note(made, "RF: no probe"));
  EXPECT_EQ(case_of(made.tree, "x.inp").probes.size(), 4U);
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

}  // namespace
}  // namespace carom::translate_test
