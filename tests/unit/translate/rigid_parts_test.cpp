// Rigid bodies of cells and of nodes of a deck as [[rigid_body]].
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "translate_fixture.hpp"

namespace carom::translate_rigid_parts_test {
namespace {

using test::case_from;
using test::good_deck;
using test::has_note;
using test::message_of;
using test::replaced;
using test::translated;

constexpr const char* body_of_upper = "*RIGID BODY, ELSET=UPPER, REF NODE=99\n";

/// The upper cube is rigid; its reference node, which no cell holds, is beside it.
std::string with_body(const std::string& more, const std::string& body = body_of_upper) {
  const std::string node = replaced(good_deck, "18,0,1,2.1\n", "18,0,1,2.1\n99,0.5,0.5,4.\n");
  return replaced(replaced(node, "*BOUNDARY\nBASE, 1, 3\n", body + "*BOUNDARY\nBASE, 1, 3\n" + more),
                  "FALLING, 3, -1000.", "99, 3, -1000.");
}

TEST(TranslateRigidParts, SolidsAreAPartThatIsRigid) {
  const Case made = case_from(with_body(""));
  ASSERT_EQ(made.rigid_parts.size(), 1U);
  const CaseRigidPart& body = made.rigid_parts[0];
  EXPECT_EQ(*body.name, "UPPER");
  ASSERT_EQ(body.parts.size(), 1U);
  EXPECT_EQ(*body.parts[0], "UPPER");
  EXPECT_FALSE(body.nodes);
  EXPECT_FALSE(body.mass);
  EXPECT_EQ(to_string(body.where), "x.inp:40");
  ASSERT_EQ(made.contacts.size(), 1U);  // a pair as of any part
  EXPECT_EQ(*made.contacts[0].kind, "pair");
  EXPECT_EQ(*made.contacts[0].group(), "FOOT");
  EXPECT_EQ(made.supports.size(), 3U);  // those of the base
  ASSERT_EQ(made.initial.size(), 1U);
  EXPECT_EQ(**made.initial[0].nodes, "UPPER");
  EXPECT_EQ(*made.initial[0].velocity, (Vec3{0.0, 0.0, -1000.0}));
  EXPECT_FALSE(made.initial[0].angular_velocity);
}

TEST(TranslateRigidParts, OfSeveralSectionsAreOneBody) {
  const Case made = case_from(replaced(replaced(with_body("",
                                                          "*ELSET, ELSET=BOTH\nUPPER, LOWER\n*RIGID BODY, "
                                                          "ELSET=BOTH, REF NODE=99\n"),
                                                "*CONTACT PAIR, INTERACTION=I\nFOOT, FLOOR\n", ""),
                                       "BASE, 1, 3\n", "99, 1, 6\n"));
  ASSERT_EQ(made.rigid_parts.size(), 1U);
  ASSERT_EQ(made.rigid_parts[0].parts.size(), 2U);
  EXPECT_EQ(*made.rigid_parts[0].parts[0], "LOWER");
  ASSERT_EQ(made.supports.size(), 3U);
  EXPECT_EQ(*made.supports[0].nodes, "BOTH");
}

// The velocity is that of the reference node, about which the body turns.
TEST(TranslateRigidParts, BeginWithTheMotionOfTheirReferenceNode) {
  const Case made = case_from(replaced(with_body(""), "99, 3, -1000.", "99, 1, 7.\n99, 5, 30.\n99, 6, 40."));
  ASSERT_EQ(made.initial.size(), 1U);
  EXPECT_EQ(*made.initial[0].velocity, (Vec3{7.0, 0.0, 0.0}));
  EXPECT_EQ(*made.initial[0].angular_velocity, (Vec3{0.0, 30.0, 40.0}));
  EXPECT_EQ(*made.initial[0].centre, (Vec3{0.5, 0.5, 4.0}));
}

// From the cells as from the node: omega x (X - a) = (0, 0, 2) x (0.5, 0.5, 4) = (-1, 1, 0) beside (5, 6, 7).
TEST(TranslateRigidParts, BeginWithARotatingVelocity) {
  for (const std::string target : {"99", "UPPER"}) {
    const Case made =
        case_from(replaced(with_body(""), "VELOCITY\n99, 3, -1000.\n",
                           "ROTATING VELOCITY\n" + target + ", 2., 5., 6., 7.\n0., 0., 0., 0., 0., 1.\n"));
    ASSERT_EQ(made.initial.size(), 1U) << target;
    EXPECT_EQ(*made.initial[0].velocity, (Vec3{4.0, 7.0, 7.0})) << target;
    EXPECT_EQ(*made.initial[0].angular_velocity, (Vec3{0.0, 0.0, 2.0})) << target;
  }
}

/// The components of the supports of a group: "x" blocked, "x=3" moved.
std::vector<std::string> supports_of(const Case& made, const std::string& group) {
  std::vector<std::string> found;
  const std::array<std::string, 3> axes{"x", "y", "z"};
  for (const CaseSupport& support : made.supports) {
    if (*support.nodes != group) continue;
    for (std::size_t c = 0; c < 3; ++c)
      if (support.blocked[c]) found.push_back(axes[c]);
  }
  return found;
}

// What a support of all nodes can say: along one axis it holds the turns about the two others.
TEST(TranslateRigidParts, AreHeldBySupportsOfAllTheirNodes) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(supports_of(case_from(with_body("99, ENCASTRE\n")), "UPPER"), (Names{"x", "y", "z"}));
  EXPECT_EQ(supports_of(case_from(with_body("99, 1, 2\n99, 4, 6\n")), "UPPER"), (Names{"x", "y"}));
  EXPECT_EQ(supports_of(case_from(with_body("99, YSYMM\n")), "UPPER"), (Names{"y"}));
  for (const char* held : {"99, ENCASTRE\n", "99, 1, 2\n99, 4, 6\n", "99, YSYMM\n"})
    EXPECT_FALSE(case_from(with_body(held)).rigid_parts[0].guide.holds()) << held;
}

// What supports of all nodes cannot say: the reference node is held where it stands, turns about two axes or all.
TEST(TranslateRigidParts, AreHeldByAGuideWhereSupportsWouldHoldMore) {
  using Axes = std::array<bool, 3>;
  struct Row {
    const char* held;
    Axes along, about;
  };
  for (const Row& row : {Row{"99, PINNED\n", {true, true, true}, {}}, Row{"99, 4, 6\n", {}, {true, true, true}},
                         Row{"99, 1, 1\n99, 4, 5\n", {true, false, false}, {true, true, false}},
                         Row{"99, 1, 2\n99, 5, 6\n", {true, true, false}, {false, true, true}}}) {
    SCOPED_TRACE(row.held);
    const Case made = case_from(with_body(row.held));
    const CaseGuide& guide = made.rigid_parts[0].guide;
    EXPECT_EQ(guide.blocked ? **guide.blocked : Axes{}, row.along);
    EXPECT_EQ(guide.blocked_turns ? **guide.blocked_turns : Axes{}, row.about);
    EXPECT_EQ(guide.blocked_at.has_value(), guide.blocked.has_value());
    EXPECT_EQ(guide.blocked_at.value_or(Located<Vec3>{}).value, (guide.blocked ? Vec3{0.5, 0.5, 4.0} : Vec3{}));
    EXPECT_EQ(supports_of(made, "UPPER"), std::vector<std::string>{});
  }
  EXPECT_EQ(
      message_of(with_body("99, 1, 1\n99, 5, 5\n")),
      "x.inp:40: *RIGID BODY: found a rigid body that *BOUNDARY holds about y alone; expected turns that are held "
      "about no axis, about two, or about all. What turns about two axes and not about the third has no axis of "
      "its own: hold it about another one, too.");
  EXPECT_EQ(message_of(replaced(with_body("99, 4, 6\n"), "*CLOAD", "*BOUNDARY, TYPE=VELOCITY\n99, 3, 3, 9.\n*CLOAD")),
            "x.inp:59: *BOUNDARY: found a motion along z of a rigid body of cells or nodes that a guide holds besides; "
            "expected 1 with 5 and 6, 2 with 4 and 6, 3 with 4 and 5, or two or three of 1 to 3 with all of 4 to 6. "
            "Impose or hold these degrees of freedom of its reference node, or let it rest along this one.");
}

TEST(TranslateRigidParts, AreMovedBySupportsOfAllTheirNodes) {
  const std::string deck = with_body("99, 1, 2\n99, 4, 6\n");
  const Case slow = case_from(replaced(deck, "*CLOAD", "*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=A\n99, 3, 3, -5.\n*CLOAD"));
  const CaseSupport& last = slow.supports.back();
  EXPECT_EQ(*last.nodes, "UPPER");
  ASSERT_EQ(last.motions.size(), 1U);
  EXPECT_EQ(last.motions[0].kind, MotionKind::velocity);
  EXPECT_EQ(last.motions[0].component, 2);
  EXPECT_EQ(*last.motions[0].amplitude, -5.0);
  EXPECT_EQ(**last.motions[0].function, "A");
  const Case shaken = case_from(replaced(deck, "*CLOAD", "*BOUNDARY, TYPE=ACCELERATION\n99, 3, 3, 9.\n*CLOAD"));
  EXPECT_EQ(shaken.supports.back().motions.at(0).kind, MotionKind::acceleration);
  EXPECT_EQ(message_of(replaced(deck, "*CLOAD", "*BOUNDARY, TYPE=VELOCITY\n99, 6, 6, 9.\n*CLOAD")),
            "x.inp:60: *BOUNDARY: found a turn that is imposed on a rigid body of cells or nodes; expected a turn that "
            "is held or free. A rigid surface of R3D3 and R3D4 is turned as imposed.");
}

const std::string mass_and_inertia =
    "*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n*ELEMENT, TYPE=ROTARYI, ELSET=J\n51, 99\n"
    "*ROTARY INERTIA, ELSET=J\n4., 5., 6., 0.1, 0.2, 0.3\n";

// Abaqus would add them.
TEST(TranslateRigidParts, HaveTheMassOfTheirCellsAlone) {
  const std::string deck = with_body("", body_of_upper + mass_and_inertia);
  EXPECT_EQ(message_of(deck),
            "x.inp: found 2 things that Carom does not carry over; expected a deck that loses nothing of its physics. "
            "--accept \"MASS,ROTARY INERTIA\" runs without:\n  x.inp:43: *MASS: a mass beside that of cells. The body "
            "would have the mass and the inertia of its cells alone.\n  x.inp:47: *ROTARY INERTIA: an inertia beside "
            "that of cells. The body would have the mass and the inertia of its cells alone.");
  EXPECT_EQ(case_from(deck, {"MASS", "ROTARY INERTIA"}).rigid_parts.size(), 1U);
}

// A reference node that no cell holds goes along, so that forces act where it stands.
TEST(TranslateRigidParts, TakeForcesAtTheirReferenceNode) {
  const Case beside = case_from(replaced(with_body(""), "15, 1, 5.", "99, 1, 5."));
  EXPECT_EQ(**beside.rigid_parts[0].points, "99");
  EXPECT_EQ(**beside.loads[0].group, "99");
  const Case of_cell =
      case_from(replaced(with_body("", "*RIGID BODY, ELSET=UPPER, REF NODE=15\n"), "99, 3, -1000.", "15, 3, -1000."));
  EXPECT_FALSE(of_cell.rigid_parts[0].points);
  EXPECT_EQ(**of_cell.loads[0].group, "15");
}

TEST(TranslateRigidParts, HoldNodesOfOtherBodies) {
  for (const std::string kind : {"TIE NSET", "PIN NSET"})
    EXPECT_EQ(
        **case_from(with_body("", "*RIGID BODY, ELSET=UPPER, REF NODE=99, " + kind + "=BASE\n")).rigid_parts[0].nodes,
        "BASE");
  const Case coupled = case_from(with_body(
      "", body_of_upper + std::string("*COUPLING, REF NODE=99, SURFACE=FLOOR, CONSTRAINT NAME=C\n*KINEMATIC\n")));
  ASSERT_EQ(coupled.rigid_parts.size(), 1U);
  EXPECT_EQ(**coupled.rigid_parts[0].nodes, "FLOOR");
}

// The modeller of Abaqus writes couplings of nodes with an area.
TEST(TranslateRigidParts, HoldNodesOfASurfaceOfNodes) {
  const std::string surface = "*SURFACE, TYPE=NODE, NAME=CNS, INTERNAL\nBASE, 1.\n";
  const Case made =
      case_from(with_body("", body_of_upper + surface + "*COUPLING, REF NODE=99, SURFACE=CNS\n*KINEMATIC\n"));
  EXPECT_EQ(**made.rigid_parts.at(0).nodes, "CNS");
}

constexpr const char* coupling = "*COUPLING, REF NODE=99, SURFACE=FLOOR, CONSTRAINT NAME=C\n*KINEMATIC\n1, 6\n";

// The nodes of a surface with the mass that stands at the reference node.
TEST(TranslateRigidParts, CoupledNodesAreABodyWithAMassOfItsOwn) {
  const std::vector<std::string> bodies{coupling,
                                        "*NSET, NSET=FLOOR NODES\n5, 6, 7, 8\n"
                                        "*RIGID BODY, TIE NSET=FLOOR NODES, REF NODE=99\n"};
  for (const std::string& body : bodies) {
    const Case made = case_from(with_body("", body + mass_and_inertia));
    ASSERT_EQ(made.rigid_parts.size(), 1U);
    const CaseRigidPart& own = made.rigid_parts[0];
    EXPECT_TRUE(own.parts.empty());
    EXPECT_EQ(**own.nodes, body == coupling ? "FLOOR" : "FLOOR NODES");
    EXPECT_EQ(*own.mass, 2.5);
    EXPECT_EQ(**own.centre_of_mass, (Vec3{0.5, 0.5, 4.0}));
    EXPECT_EQ(**own.inertia, (Vec3{4.0, 5.0, 6.0}));
    EXPECT_EQ(*own.products_of_inertia, (Vec3{0.1, 0.3, 0.2}));  // xy, yz, zx of xy, xz, yz
    EXPECT_TRUE(made.point_masses.empty());
    EXPECT_EQ(**made.initial[0].nodes, **own.nodes);
  }
}

TEST(TranslateRigidParts, CoupledNodesWithoutAMassAreRefusedUnlessAccepted) {
  const std::string deck = with_body("", coupling);
  EXPECT_EQ(message_of(deck),
            "x.inp: found something that Carom does not carry over; expected a deck that loses nothing of its physics. "
            "--accept \"COUPLING\" runs without:\n  x.inp:40: *COUPLING: the reference node of FLOOR moves freely and "
            "has no *MASS and *ROTARY INERTIA. Its nodes would not move together. A rigid body needs a mass and an "
            "inertia of its own.");
  EXPECT_TRUE(case_from(deck, {"COUPLING"}).rigid_parts.empty());
  const std::string mass = "*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n";
  EXPECT_NE(message_of(with_body("", coupling + mass)).find("has no *ROTARY INERTIA"), std::string::npos);
}

// What does not turn needs no inertia, and what is imposed as a whole no mass either.
TEST(TranslateRigidParts, CoupledNodesThatAreHeld) {
  const std::string mass = "*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n";
  const Case guided = case_from(with_body("99, 1, 2\n99, 4, 6\n", coupling + mass));
  ASSERT_EQ(guided.rigid_parts.size(), 1U);
  const double reach = 0.5 * 0.5 + 0.5 * 0.5 + 3.0 * 3.0;  // the square of that from the reference node to the corners
  EXPECT_NEAR((**guided.rigid_parts[0].inertia)[0], 2.5 * reach, 1e-14);
  EXPECT_EQ(supports_of(guided, "FLOOR"), (std::vector<std::string>{"x", "y"}));
  const Case held = case_from(with_body("99, ENCASTRE\n", coupling));
  EXPECT_TRUE(held.rigid_parts.empty());
  EXPECT_EQ(supports_of(held, "FLOOR"), (std::vector<std::string>{"x", "y", "z"}));
}

/// CalculiX' manual, *RIGID BODY: NSET are the nodes of the body, and the first three degrees of freedom of ROT NODE
/// are its turns about the axes.
TEST(TranslateRigidParts, TurnsOfCalculixAreThoseOfItsRotationNode) {
  const std::string body = "*NODE\n98,0.5,0.5,4.\n*RIGID BODY, NSET=FALLING, REF NODE=99, ROT NODE=98\n";
  const Case held = case_from(with_body("99, 1, 3\n98, 1, 3\n", body));
  EXPECT_TRUE(held.rigid_parts.empty());
  EXPECT_EQ(supports_of(held, "FALLING"), (std::vector<std::string>{"x", "y", "z"}));
  const std::string solid = "*NODE\n98,0.5,0.5,4.\n*RIGID BODY, ELSET=UPPER, REF NODE=99, ROT NODE=98\n";
  const Case turning = case_from(replaced(with_body("", solid), "99, 3, -1000.", "98, 2, 7."));
  ASSERT_EQ(turning.initial.size(), 1U);
  EXPECT_EQ(*turning.initial[0].angular_velocity, (Vec3{0.0, 7.0, 0.0}));
  EXPECT_NE(message_of(with_body("98, 4\n", solid)).find("found degree of freedom 4 of a ROT NODE"), std::string::npos);
}

// A single node where the reference node is: it does not turn and has no size, so that its mass at a unit's distance is
// as good an inertia as any.
TEST(TranslateRigidParts, ANodeAtItsReferenceNodeHasTheInertiaOfItsMassAtOne) {
  const std::string mass = "*ELEMENT, TYPE=MASS, ELSET=M\n50, 99\n*MASS, ELSET=M\n2.5\n";
  const std::string body = "*NSET, NSET=SPOT\n5\n*RIGID BODY, TIE NSET=SPOT, REF NODE=99\n";
  const Case made = case_from(replaced(with_body("99, 1, 2\n99, 4, 6\n", body + mass), "99,0.5,0.5,4.", "99,0.,0.,1."));
  ASSERT_EQ(made.rigid_parts.size(), 1U);
  EXPECT_EQ(**made.rigid_parts[0].inertia, (Vec3{2.5, 2.5, 2.5}));
}

}  // namespace
}  // namespace carom::translate_rigid_parts_test
