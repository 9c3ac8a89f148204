// Rigid bodies of a deck as obstacles: where they stand, move and turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "translate_fixture.hpp"

namespace carom::translate_rigid_test {
namespace {

using test::case_from;
using test::good_deck;
using test::has_note;
using test::message_of;
using test::replaced;
using test::translated;

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

/// Abaqus Analysis User's Guide, "Point masses" and "Rotary inertia": what several elements bring to a node adds up.
TEST(Translate, MassesAndInertiasOfAReferenceNodeAddUp) {
  const std::string masses =
      "*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n*ELEMENT, TYPE=MASS, ELSET=N\n51, 99\n*MASS, "
      "ELSET=N\n0.5\n*ELEMENT, TYPE=ROTARYI, ELSET=R\n52, 99\n*ROTARY INERTIA, ELSET=R\n4., 5., 6., 0.1\n*ELEMENT, "
      "TYPE=ROTARYI, ELSET=S\n53, 99\n*ROTARY INERTIA, ELSET=S\n1., 1., 1., 0.2\n";
  const Case made =
      case_from(replaced(with_rigid_wall(masses), "FALLING, 3, -1000.", "FALLING, 3, -1000.\n99, 3, 20."));
  EXPECT_EQ(*made.contacts[0].obstacle()->body.mass, 3.0);
  EXPECT_EQ(**made.contacts[0].obstacle()->body.inertia, (Vec3{5.0, 6.0, 7.0}));
  EXPECT_DOUBLE_EQ((*made.contacts[0].obstacle()->body.products_of_inertia)[0], 0.3);
}

/// A rigid surface that nothing meets is as good as none; cells have to have a section all the same.
TEST(Translate, ARigidSurfaceThatNoContactMeetsIsANote) {
  const std::string deck =
      replaced(with_rigid_wall("*BOUNDARY\n99, ENCASTRE\n"), "*CONTACT PAIR, INTERACTION=I\nFOOT, FLOOR\n", "");
  const TranslatedDeck made = translated(deck);
  EXPECT_TRUE(has_note(made, "no contact meets the rigid surface LOWER"));
  EXPECT_EQ(case_of(made.tree, "x.inp").mesh.unused, CaseMesh::Unused::ignore);
  const std::string loose = message_of(
      replaced(deck, "*NSET, NSET=BASE", "*ELEMENT, TYPE=C3D8, ELSET=MORE\n3,1,2,3,4,5,6,7,8\n*NSET, NSET=BASE"));
  EXPECT_NE(loose.find("x.inp:25: *ELEMENT: found element 3 without a section"), std::string::npos) << loose;
}

/// Abaqus keyword *DISPLAY BODY: the instance is shown and takes no part.
TEST(Translate, AnInstanceThatIsShownTakesNoPart) {
  const std::string deck =
      "*PART, NAME=P\n*NODE\n1,5,0,0\n2,6,0,0\n3,6,1,0\n4,5,1,0\n5,5,0,1\n6,6,0,1\n7,6,1,1\n8,5,1,1\n"
      "*ELEMENT, TYPE=C3D8, ELSET=ALL\n1,1,2,3,4,5,6,7,8\n*END PART\n*ASSEMBLY\n*INSTANCE, NAME=I, PART=P\n"
      "*END INSTANCE\n*DISPLAY BODY, INSTANCE=I\n*END ASSEMBLY\n" +
      good_deck;
  const Case made = case_from(deck);
  EXPECT_EQ(made.parts.size(), 2U);
  EXPECT_EQ(made.mesh.unused, CaseMesh::Unused::ignore);
}

/// A set of a whole instance has the reference node among others: what it says holds for the body, too.
TEST(Translate, SetsWithAReferenceNodeAmongOthersSpeakOfTheBody) {
  const std::string plate = "*NSET, NSET=PLATE\n5, 6, 7, 8, 99, 11\n", mass = "*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n";
  const Case held = case_from(with_rigid_wall(plate + "*BOUNDARY\nPLATE, ENCASTRE\n"));
  EXPECT_FALSE(held.contacts[0].obstacle()->body.mass);
  EXPECT_EQ(held.supports.size(), 3U);  // of node 11
  const Case flying = case_from(
      replaced(with_rigid_wall(plate + mass + "*MASS, ELSET=M\n2.5\n"), "FALLING, 3, -1000.", "PLATE, 3, 20."));
  EXPECT_EQ(*flying.contacts[0].obstacle()->velocity, (Vec3{0.0, 0.0, 20.0}));
  EXPECT_EQ(flying.initial.size(), 1U);
  const std::string two = replaced(mass, "50, 99", "50, 99\n51, 11") + "*MASS, ELSET=M\n2.5\n";
  EXPECT_NE(message_of(with_rigid_wall(two)).find("*MASS: found a set with reference nodes of rigid bodies and other"),
            std::string::npos);
}

TEST(Translate, ARigidSurfaceTakesNoForces) {
  const std::string deck = replaced(with_rigid_wall("*BOUNDARY\n99, ENCASTRE\n"), "15, 1, 5.", "99, 1, 5.");
  EXPECT_NE(message_of(deck).find("*CLOAD: found a force on the reference node of the rigid surface LOWER"),
            std::string::npos)
      << message_of(deck);
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

using Axes = std::array<bool, 3>;

/// Newton's laws along the axes that are left, and about the one that is left: the plate of a drop tower, and a flap.
TEST(Translate, AReferenceNodeIsHeldAlongSomeAxesByAGuide) {
  const std::string mass = "*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n*BOUNDARY\n99, 1, 2\n99, 4, 6\n";
  const std::string deck = replaced(with_rigid_wall(mass), "FALLING, 3, -1000.", "FALLING, 3, -1000.\n99, 3, 20.");
  const CaseContact contact = case_from(deck).contacts[0];
  const CaseObstacle& plate = *contact.obstacle();
  EXPECT_EQ(*plate.body.mass, 2.5);
  EXPECT_EQ(*plate.velocity, (Vec3{0.0, 0.0, 20.0}));
  EXPECT_EQ(**plate.body.guide.blocked, (Axes{true, true, false}));
  EXPECT_EQ(to_string(plate.body.guide.blocked->where), "x.inp:45");
  EXPECT_FALSE(plate.body.inertia);
  EXPECT_FALSE(plate.body.guide.blocked_turns);

  const std::string inertia =
      "*ELEMENT, TYPE=ROTARYI, ELSET=J\n51, 99\n*ROTARY INERTIA, ELSET=J\n0., 5., 0., 0.1, 0.2, 0.3\n";
  const std::string hinge = replaced(replaced(mass, "99, 1, 2", "99, PINNED"), "99, 4, 6", "99, 4\n99, 6");
  const CaseContact turned = case_from(with_rigid_wall(inertia + hinge)).contacts[0];
  const CaseRigidBody& flap = turned.obstacle()->body;
  EXPECT_EQ(**flap.guide.blocked, (Axes{true, true, true}));
  EXPECT_EQ(**flap.guide.blocked_turns, (Axes{true, false, true}));
  EXPECT_EQ(**flap.inertia, (Vec3{5.0, 5.0, 5.0}));  // about y alone
  EXPECT_FALSE(flap.products_of_inertia);
  EXPECT_FALSE(flap.guide.blocked_at);  // its centre of mass, where the reference node is

  const std::string led = replaced(deck, "*BOUNDARY\n99, 1, 2\n", "*BOUNDARY, TYPE=VELOCITY\n99, 1, 2, 5.\n");
  EXPECT_EQ(message_of(led),
            "x.inp:38: *RIGID BODY: found a reference node with a *MASS that is moved along some axes and free along 1 "
            "of 3; expected all axes imposed, or those that are not free held. *BOUNDARY gives the reference node a "
            "motion: impose the others, too, or let it be 0.");
}

/// Abaqus keyword *RIGID BODY: POSITION=CENTER OF MASS moves the reference node there. The mass of a surface of faces
/// is that of its reference node, which stays.
TEST(Translate, APositionAtTheCentreOfMassIsThatOfASurface) {
  const std::string held = "*BOUNDARY\n99, ENCASTRE\n";
  const auto with = [](const std::string& deck) {
    return replaced(deck, "REF NODE=", "POSITION=CENTER OF MASS, REF NODE=");
  };
  EXPECT_EQ(case_from(with(with_rigid_wall(held))).contacts.size(), 1U);
  const std::string solid = replaced(good_deck, "*STEP\n", "*RIGID BODY, ELSET=UPPER, REF NODE=11\n*STEP\n");
  const std::string refused = message_of(with(solid));
  EXPECT_NE(refused.find("*RIGID BODY: POSITION=CENTER OF MASS. Forces and velocities of the reference node"),
            std::string::npos)
      << refused;
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
  EXPECT_EQ(
      refusal(with_free_wall("*BOUNDARY\n99, 5\n")),
      "x.inp:38: *RIGID BODY: found a rigid body that *BOUNDARY holds about y alone; expected turns that are held "
      "about no axis, about two, or about all. What turns about two axes and not about the third has no axis of "
      "its own: hold it about another one, too.");
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
            "x.inp:17: *RIGID BODY: found a reference node without a *MASS that is held along 1 of 2 axes; expected a "
            "*MASS, by which it moves along the others, or all of them imposed. Give the reference node an element of "
            "TYPE=MASS with a *MASS, or impose the others by *BOUNDARY.");
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

}  // namespace
}  // namespace carom::translate_rigid_test
