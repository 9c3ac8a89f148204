// General contact of chosen surfaces, sides that are not named, and arcs as faces.
#include <gtest/gtest.h>

#include <string>

#include "math/vec3.hpp"
#include "mesh/deck_mesh.hpp"
#include "translate_fixture.hpp"

namespace carom::translate_contacts_test {
namespace {

using test::case_from;
using test::good_deck;
using test::has_note;
using test::message_of;
using test::replaced;
using test::translated;

const std::string pair_lines = "*CONTACT PAIR, INTERACTION=I\nFOOT, FLOOR\n";

/// The contact of the good deck as general contact with these keywords in its step, an explicit one.
std::string generally(const std::string& keywords) {
  return replaced(replaced(good_deck, pair_lines, "*SURFACE INTERACTION, NAME=SMOOTH\n"),
                  "*DYNAMIC, DIRECT\n1e-6, 1e-3", "*DYNAMIC, EXPLICIT\n, 1e-3\n*CONTACT\n" + keywords);
}

/// The lower cube replaced by a rigid square that is seen from above or below.
std::string with_rigid_floor(const std::string& nodes, const std::string& side) {
  std::string deck = replaced(good_deck, "*ELEMENT, TYPE=C3D8, ELSET=LOWER\n1,1,2,3,4,5,6,7,8\n",
                              "99,0,0,0\n*ELEMENT, TYPE=R3D4, ELSET=LOWER\n1," + nodes + "\n");
  deck = replaced(deck, "LOWER, S2", "LOWER" + side);
  deck = replaced(deck, "*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL\n", "*RIGID BODY, ELSET=LOWER, REF NODE=99\n");
  return replaced(replaced(deck, "BASE, 1, 3", "99, ENCASTRE"), "*DYNAMIC, DIRECT\n1e-6, 1e-3",
                  "*DYNAMIC, EXPLICIT\n, 1e-3");
}

/// Abaqus keyword *CONTACT EXCLUSIONS: without a first name it is all exterior faces that the second does not touch.
TEST(TranslateContacts, WhatIsExcludedTouchesNothing) {
  const std::string all = "*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT EXCLUSIONS\n";
  const Case made = case_from(generally(all + ", FLOOR\n"));
  ASSERT_EQ(made.contacts.size(), 1U);
  const auto& kind = std::get<CaseAll>(made.contacts[0].of);
  ASSERT_EQ(kind.exclude.size(), 1U);
  EXPECT_EQ(*kind.exclude[0], "FLOOR");
  for (const char* pair : {"FOOT, FLOOR\n", "FLOOR,\n", "FLOOR, FLOOR\n"}) {
    EXPECT_NE(message_of(generally(all + pair))
                  .find("They would touch. A line with the second name alone takes a surface "
                        "out altogether, where no rigid body is met."),
              std::string::npos)
        << pair;
    EXPECT_TRUE(
        std::get<CaseAll>(case_from(generally(all + pair), {"CONTACT EXCLUSIONS"}).contacts[0].of).exclude.empty());
  }
  const std::string rigid =
      replaced(with_rigid_floor("5,6,7,8", ", SPOS"), "*CONTACT PAIR, INTERACTION=I\nFOOT, FLOOR\n", "");
  const auto with = [&](const std::string& lines) {
    return replaced(rigid, "*CLOAD", "*CONTACT\n" + all + lines + "*CLOAD");
  };
  EXPECT_EQ(case_from(with("")).contacts.size(), 2U);
  EXPECT_EQ(case_from(with(", FLOOR\n")).contacts.size(), 1U);
  EXPECT_EQ(case_from(with("FLOOR, FLOOR\n")).contacts.size(), 2U);
  EXPECT_NE(message_of(with(", FOOT\n")).find("FOOT beside rigid bodies"), std::string::npos);
  EXPECT_NE(message_of(generally("*CONTACT INCLUSIONS\nFOOT, FLOOR\n*CONTACT EXCLUSIONS\nFOOT,\n"))
                .find("exclusions beside chosen surfaces"),
            std::string::npos);
}

/// z of the normal of the first face of a group, by the right-hand rule.
double normal_z(const std::string& deck, const std::string& group) {
  const Mesh mesh = read_deck_mesh(deck, "x.inp", test::no_file);
  const CellRef face = mesh.cell_groups.at(group).front();
  const auto nodes = mesh.blocks[at(face.block)].nodes(face.cell);
  const auto x = [&](std::size_t n) { return mesh.coordinates[at(nodes[n])]; };
  return cross(subtract(x(1), x(0)), subtract(x(2), x(0)))[2];
}

/// Abaqus keyword *CONTACT INCLUSIONS: two surfaces in a line touch each other, one alone touches itself.
TEST(TranslateContacts, GeneralContactOfChosenSurfacesIsPairs) {
  const Case made =
      case_from(generally("*CONTACT INCLUSIONS\nFOOT, FLOOR\nFOOT,\n*CONTACT PROPERTY ASSIGNMENT\n,,I\n"));
  ASSERT_EQ(made.contacts.size(), 2U);
  EXPECT_EQ(*made.contacts[0].kind, "pair");
  EXPECT_EQ(**made.contacts[0].master(), "FLOOR");
  EXPECT_EQ(made.contacts[0].law()->friction, 0.2);
  EXPECT_EQ(*made.contacts[1].kind, "self");
}

/// Abaqus keyword *CONTACT PROPERTY ASSIGNMENT: of the lines that fit two surfaces the last one holds.
TEST(TranslateContacts, TwoChosenSurfacesHaveAnInteractionOfTheirOwn) {
  const std::string chosen = "*CONTACT INCLUSIONS\nFOOT, FLOOR\nFOOT,\n*CONTACT PROPERTY ASSIGNMENT\n,,I\n";
  const Case made = case_from(generally(chosen + "FLOOR, FOOT, SMOOTH\n"));
  EXPECT_EQ(made.contacts[0].law()->friction, 0.0);
  EXPECT_EQ(made.contacts[1].law()->friction, 0.2);
}

/// Abaqus keyword *SURFACE: COMBINE=UNION has the faces of all surfaces that its lines name.
TEST(TranslateContacts, AUnionOfSurfacesHasTheFacesOfAll) {
  const std::string deck =
      replaced(good_deck, "*MATERIAL", "*SURFACE, NAME=BOTH, COMBINE=UNION\nFOOT, FLOOR\nFOOT\n*MATERIAL");
  EXPECT_EQ(read_deck_mesh(deck, "x.inp", test::no_file).cell_groups.at("BOTH").size(), 2U);
  EXPECT_EQ(case_from(replaced(deck, "\nFOOT, FLOOR\n*AMPL", "\nBOTH,\n*AMPL")).contacts.size(), 1U);
  EXPECT_NE(message_of(replaced(deck, "UNION", "DIFFERENCE")).find("found COMBINE=DIFFERENCE; expected UNION"),
            std::string::npos);
  EXPECT_NE(message_of(replaced(deck, "FOOT, FLOOR\nFOOT", "FOOT, ROOF")).find("*SURFACE: found 'ROOF'"),
            std::string::npos);
}

/// Abaqus keyword *CONTACT PAIR: OP=DELETE ends the contact of a pair with the step before.
TEST(TranslateContacts, ContactThatEndsStaysWhereThatIsAccepted) {
  const std::string deck =
      good_deck + "*STEP\n*DYNAMIC, DIRECT\n1e-6, 1e-3\n*CONTACT PAIR, OP=DELETE\nFOOT, FLOOR\n*END STEP\n";
  const std::string refused = message_of(deck);
  EXPECT_NE(refused.find("*CONTACT PAIR: contact that ends with a step. It would stay."), std::string::npos) << refused;
  EXPECT_EQ(case_from(deck, {"CONTACT PAIR"}).contacts.size(), 1U);
}

/// Named twice: a second material, interaction or load would silently take the place of the first, or join it.
TEST(TranslateContacts, WhatIsNamedTwiceIsRefused) {
  const std::string interaction =
      replaced(good_deck, "*SURFACE INTERACTION", "*SURFACE INTERACTION, NAME=I\n*SURFACE INTERACTION");
  EXPECT_NE(message_of(interaction).find("*SURFACE INTERACTION: found the interaction I a second time"),
            std::string::npos)
      << message_of(interaction);
  const std::string material = replaced(good_deck, "*MATERIAL", "*MATERIAL, NAME=STEEL\n*MATERIAL");
  EXPECT_NE(message_of(material).find("*MATERIAL: found the material STEEL a second time"), std::string::npos)
      << message_of(material);
  const std::string load = replaced(good_deck, "15, 1, 5.\n", "15, 1, 5.\n15, 1, 7.\n");
  EXPECT_NE(message_of(load).find("*CLOAD: found this load of 15 a second time in its step: 7 after 5"),
            std::string::npos)
      << message_of(load);
}

/// Abaqus keyword *SURFACE BEHAVIOR: TABULAR has lines of pressure, overclosure.
TEST(TranslateContacts, ATableOfPressuresIsALawOfPressure) {
  const std::string rigid = with_rigid_floor("5,6,7,8", ", SPOS");
  const auto with = [&](const std::string& lines) {
    return replaced(rigid, "OVERCLOSURE=LINEAR\n1e6", "OVERCLOSURE=TABULAR" + lines);
  };
  const Case made = case_from(with("\n0., 0.\n10., 1e-6\n40., 2e-6"));
  const CaseContactLaw& law = *made.contacts[0].law();
  EXPECT_EQ(*law.depths, (std::vector<double>{1e-6, 2e-6}));
  EXPECT_EQ(*law.pressures, (std::vector<double>{10.0, 40.0}));
  EXPECT_FALSE(law.stiffness.has_value());
  EXPECT_NE(message_of(with("\n0., -1e-3\n10., 1e-6")).find("found pressure 0 at overclosure -0.001 in the first line"),
            std::string::npos);
  const std::string between_bodies = replaced(good_deck, "LINEAR\n1e6", "TABULAR\n0., 0.\n10., 1e-6");
  EXPECT_NE(message_of(between_bodies).find("PRESSURE-OVERCLOSURE=TABULAR between bodies that deform. Rigid surfaces"),
            std::string::npos)
      << message_of(between_bodies);
  EXPECT_NE(message_of(with("\n0., 0.")).find("*SURFACE BEHAVIOR: found no points"), std::string::npos);
}

/// CalculiX' PRESSURE-OVERCLOSURE=TIED holds the surfaces together.
TEST(TranslateContacts, TiedContactIsNoContact) {
  const std::string refused = message_of(replaced(good_deck, "OVERCLOSURE=LINEAR", "OVERCLOSURE=TIED"));
  EXPECT_NE(refused.find("PRESSURE-OVERCLOSURE=TIED. The surfaces would slide and part: write *TIE."),
            std::string::npos)
      << refused;
}

TEST(TranslateContacts, GeneralContactThatIsNotPairsIsRefused) {
  EXPECT_NE(message_of(generally("*CONTACT INCLUSIONS\n, FLOOR\n")).find("found contact of all with chosen surfaces"),
            std::string::npos);
  EXPECT_NE(message_of(generally("*CONTACT INCLUSIONS\n")).find("*CONTACT INCLUSIONS: found no surfaces"),
            std::string::npos);
  const std::string all = "*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n";
  const std::string single = generally(all + "FOOT, FLOOR, I\n");
  EXPECT_NE(message_of(single).find("*CONTACT PROPERTY ASSIGNMENT: an interaction of single surfaces. That of all"),
            std::string::npos)
      << message_of(single);
  EXPECT_EQ(case_from(single, {"CONTACT PROPERTY ASSIGNMENT"}).contacts[0].law()->friction, 0.0);
  const std::string later = message_of(generally(all + ",,I\n") +
                                       "*STEP\n*DYNAMIC, EXPLICIT\n, 1e-3\n*CONTACT PROPERTY ASSIGNMENT\n,,SMOOTH\n"
                                       "*END STEP\n");
  EXPECT_NE(later.find("x.inp:65: *CONTACT PROPERTY ASSIGNMENT: an interaction that begins with a later step"),
            std::string::npos)
      << later;
}

/// Abaqus Analysis User's Guide, "Element-based surface definition": rigid faces in space without SPOS or SNEG are a
/// surface of two sides in its explicit program. The bodies are above.
TEST(TranslateContacts, ARigidSurfaceOfNoNamedSideLooksToTheBodies) {
  for (const char* nodes : {"5,6,7,8", "8,7,6,5"}) {
    const std::string deck = with_rigid_floor(nodes, ",");
    EXPECT_GT(normal_z(deck, "FLOOR"), 0.0) << nodes;
    EXPECT_TRUE(has_note(translated(deck), "FLOOR names no side: it is met from that where the bodies are")) << nodes;
  }
  EXPECT_LT(normal_z(with_rigid_floor("8,7,6,5", ", SPOS"), "FLOOR"), 0.0);
  EXPECT_FALSE(has_note(translated(with_rigid_floor("5,6,7,8", ", SPOS")), "names no side"));
}

/// Abaqus Analysis User's Guide, "Contact formulations for contact pairs in Abaqus/Explicit": a rigid surface is the
/// master in either order; in its standard program and in CalculiX the master is the second one.
TEST(TranslateContacts, ARigidSurfaceMayBeNamedFirstInExplicitDecks) {
  const std::string deck = replaced(with_rigid_floor("5,6,7,8", ", SPOS"), "FOOT, FLOOR", "FLOOR, FOOT");
  const Case made = case_from(deck);
  EXPECT_EQ(*made.contacts[0].kind, "surface");
  EXPECT_EQ(**made.contacts[0].own_cells(), "FLOOR");
  EXPECT_NE(message_of(replaced(deck, "*DYNAMIC, EXPLICIT\n, 1e-3", "*DYNAMIC\n1e-6, 1e-3"))
                .find("found FLOOR, the surface of a rigid body"),
            std::string::npos);
}

/// A chord is r (1 - cos(angle / 2)) inside of its arc: of a ball of radius 5 in 72 pieces around, 5 degrees each,
/// 4.76e-3; flat faces are where the surface is.
TEST(TranslateContacts, ArcsOfAnalyticalSurfacesSayHowFlatTheyAre) {
  const auto with = [](const std::string& surface) {
    std::string deck = with_rigid_floor("5,6,7,8", ", SPOS");
    deck = replaced(deck, "*ELEMENT, TYPE=R3D4, ELSET=LOWER\n1,5,6,7,8\n", "");
    deck = replaced(deck, "*SURFACE, NAME=FLOOR\nLOWER, SPOS\n", "*SURFACE, NAME=FLOOR, " + surface);
    return replaced(deck, "ELSET=LOWER, REF", "ANALYTICAL SURFACE=FLOOR, REF");
  };
  const std::string ball = with("TYPE=REVOLUTION\n0.5,0.5,-4., 0.5,0.5,0.\nSTART, 0., 5.\nCIRCL, 5., 0., 0., 0.\n");
  EXPECT_TRUE(has_note(translated(ball), "FLOOR is made of flat faces, whose middles are up to 0.00476 inside of its"));
  // Either way about is as long: Abaqus' arcs are below 179.74 degrees.
  const std::string half = with("TYPE=REVOLUTION\n0.5,0.5,-4., 0.5,0.5,0.\nSTART, 0., 5.\nCIRCL, 0., -5., 0., 0.\n");
  EXPECT_NE(message_of(half).find("*SURFACE: found an arc of half a circle"), std::string::npos) << message_of(half);
  const std::string flat = with("TYPE=CYLINDER\n0.,0.,1., 1.,0.,1.\n0.,-1.,1.\nSTART, 3., 0.\nLINE, -3., 0.\n");
  EXPECT_FALSE(has_note(translated(flat), "flat faces"));
}

}  // namespace
}  // namespace carom::translate_contacts_test
