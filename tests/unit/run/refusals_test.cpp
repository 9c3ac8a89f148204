// What a case is refused for before it runs, beyond its single sections: what no part takes, and where probes stand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "record/recorder.hpp"
#include "run_fixture.hpp"

namespace carom::run_refusals_test {
namespace {

using namespace test;

const std::string newmark = "[scheme]\nkind = \"newmark\"\n[time]\nend = 1.0\nstep = 0.1\n";

/// A second block beside the body that no part takes.
const std::string forgotten =
    "[[mesh.block]]\norigin = [5.0, 0.0, 0.0]\nsize = [1.0, 1.0, 2.0]\ndivisions = [1, 1, 2]\n"
    "groups = { cells = \"FORGOTTEN\" }\n";

/// A rigid sheet under the body; a contact takes it or does not.
const std::string sheet =
    "[[mesh.block]]\nkind = \"quad\"\norigin = [-1.0, -1.0, -0.1]\nsize = [4.0, 4.0]\ndivisions = [1, 1]\n"
    "groups = { cells = \"SHEET\" }\n";
const std::string on_sheet =
    "[[contact]]\nname = \"floor\"\nkind = \"surface\"\nsurface = \"SHEET\"\ngroup = \"FOOT\"\n";

CaseError tables_error(const std::string& rest) {
  const Case given = parse_case(case_of_block(rest + newmark), "case.toml");
  const Simulation simulation(given);
  try {
    const RunTables tables(simulation);
  } catch (const CaseError& e) {
    return e;
  }
  ADD_FAILURE() << "no error for\n" << rest;
  return {{}, "", "", ""};
}

std::vector<std::string> probe_notes(const std::string& rest) {
  const Case given = parse_case(case_of_block(rest + newmark), "case.toml");
  const Simulation simulation(given);
  return RunTables(simulation).probes.notes();
}

/// The same case with bodies that yield.
std::string yielding(std::string text) {
  const std::string law = "law = \"linear_elastic\"\n";
  return text.replace(text.find(law), law.size(), "law = \"j2\"\nyield_stress = 0.1\n");
}

TEST(EnergyMomentum, TakesNoBodiesThatYield) {
  const std::string text = case_of_block("[scheme]\nkind = \"energy_momentum\"\n[time]\nend = 1.0\nstep = 0.1\n");
  EXPECT_NO_THROW(Simulation(parse_case(text, "case.toml")));
  const CaseError error = case_error(yielding(text));
  EXPECT_EQ(error.key(), "scheme.kind");
  EXPECT_EQ(error.found(), "\"energy_momentum\" with the law \"j2\" of the part \"body\"");
  EXPECT_NO_THROW(Simulation(parse_case(yielding(case_of_block(newmark)), "case.toml")));
}

TEST(UnusedCells, AreNamedWithTheirCount) {
  const CaseError error = case_error(case_of_block(forgotten + newmark));
  EXPECT_EQ(error.key(), "mesh");
  EXPECT_NE(error.found().find("2 HEXA8 in \"FORGOTTEN\" (cell 13 and others)"), std::string::npos) << error.found();
  EXPECT_NE(error.suggestion().find("mesh.unused = \"ignore\""), std::string::npos);
  const CaseError free_face = case_error(case_of_block(sheet + newmark));
  EXPECT_NE(free_face.found().find("1 QUAD4 in \"SHEET\""), std::string::npos) << free_face.found();
}

TEST(UnusedCells, AreTakenWhereAContactUsesThemOrTheCaseSaysSo) {
  const auto builds = [](const std::string& text) {
    const Case given = parse_case(text, "case.toml");
    const Simulation simulation(given);
  };
  EXPECT_NO_THROW(builds(case_of_block(sheet + on_sheet + newmark)));
  EXPECT_NO_THROW(builds("mesh.unused = \"ignore\"\n" + case_of_block(forgotten + newmark)));
}

TEST(ProbePlace, IsRefusedBeyondACell) {
  const auto probe = [](const std::string& where) {
    return "[[probe]]\nname = \"far\"\nquantities = [\"velocity\"]\n" + where;
  };
  // A cell's longest line is sqrt(3): 1.7 from the corner (2, 2, 3) is within it, 1.8 is not.
  const std::vector<std::string> notes = probe_notes(probe("point = [3.7, 2.0, 3.0]\n"));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("at (2, 2, 3), 1.7 from the point"), std::string::npos) << notes[0];
  EXPECT_EQ(tables_error(probe("point = [3.8, 2.0, 3.0]\n")).key(), "probe.point");
  EXPECT_EQ(tables_error(probe("point = [1000.0, 2.0, 3.0]\n")).key(), "probe.point");
  EXPECT_EQ(probe_notes(probe("point = [1000.0, 2.0, 3.0]\nwithin = 1000.0\n")).size(), 1U);
  EXPECT_EQ(tables_error(probe("point = [3.7, 2.0, 3.0]\nwithin = 1.0\n")).key(), "probe.point");
}

TEST(SectionForce, NeedsASideAcrossItsSection) {
  const auto section = [](const std::string& side) {
    return "[[probe]]\nname = \"cut\"\ngroup = \"FOOT\"\nquantities = [\"section_force\"]\nside = " + side + "\n";
  };
  EXPECT_EQ(probe_notes(section("[0.0, 0.0, 1.0]")).size(), 0U);
  EXPECT_EQ(tables_error(section("[1.0, 1.0, 0.0]")).key(), "probe.side");
  EXPECT_EQ(tables_error(section("[1.0, 0.0, 0.001]")).key(), "probe.side");
  // Along the section as much as across it: the cells above are taken whichever way it leans, none below are.
  EXPECT_EQ(probe_notes(section("[1.0, 0.0, 0.5]")).size(), 0U);
  EXPECT_EQ(tables_error(section("[1.0, 0.0, -0.5]")).key(), "probe");
}

TEST(RedundantContacts, AreRefused) {
  const auto plane = [](const char* name, double height) {
    return fmt::format(
        "[[contact]]\nname = \"{}\"\nkind = \"plane\"\ngroup = \"FOOT\"\npoint = [{}, 0.0, {}]\nnormal = [0.0, 0.0, "
        "1.0]\n",
        name, height < -1.0 ? 5.0 : 0.0, height);
  };
  const auto key_of = [](const std::string& rest) { return case_error(case_of_block(rest + newmark)).key(); };
  EXPECT_EQ(key_of(plane("a", -2.0) + plane("b", -2.0)), "contact");
  const Case two = parse_case(case_of_block(plane("a", -2.0) + plane("b", -0.5) + newmark), "case.toml");
  EXPECT_NO_THROW(Simulation{two});
  const std::string other =
      "[[mesh.block]]\norigin = [0.0, 0.0, 3.5]\nsize = [2.0, 2.0, 1.0]\ndivisions = [1, 1, 1]\n"
      "groups = { cells = \"OTHER\", zmin = \"UNDER\", zmax = \"OVER\" }\n"
      "[[part]]\nname = \"other\"\ncells = \"OTHER\"\nmaterial = \"soft\"\n";
  const auto pair = [](const char* name, const char* group, const char* master) {
    return fmt::format("[[contact]]\nname = \"{}\"\nkind = \"pair\"\ngroup = \"{}\"\nmaster = \"{}\"\n", name, group,
                       master);
  };
  const std::string all = "[[contact]]\nname = \"all\"\nkind = \"all\"\n";
  EXPECT_EQ(key_of(other + pair("a", "HEAD", "UNDER") + pair("b", "UNDER", "HEAD")), "contact");
  EXPECT_EQ(key_of(other + all + pair("b", "UNDER", "HEAD")), "contact");
  const Case excluded = parse_case(
      case_of_block(other + all + "exclude = [\"UNDER\"]\n" + pair("b", "UNDER", "HEAD") + newmark), "case.toml");
  EXPECT_NO_THROW(Simulation{excluded});
}

// A block on top of the body that is tied to it, and hangs over by one of its two cells: what the tie holds is no
// contact again, and what hangs over stays in contact.
TEST(RedundantContacts, OfAllLeaveOutWhatATieHolds) {
  const auto other = [](const char* lower, const char* divisions) {
    return fmt::format(
        "[[mesh.block]]\norigin = [{}, 0.0, 3.0]\nsize = [4.0, 2.0, 1.0]\ndivisions = {}\n"
        "groups = {{ cells = \"OTHER\", zmin = \"UNDER\" }}\n"
        "[[part]]\nname = \"other\"\ncells = \"OTHER\"\nmaterial = \"soft\"\n"
        "[[contact]]\nname = \"all\"\nkind = \"all\"\n"
        "[[contact]]\nname = \"glue\"\nkind = \"tie\"\ngroup = \"UNDER\"\nmaster = \"HEAD\"\nfar = \"leave\"\n",
        lower, divisions);
  };
  // Those over the body go, and the row beside it, which has nodes at its rim.
  for (const auto& [lower, divisions, left] : {std::tuple{"0.0", "[4, 2, 1]", 2U}, {"0.0", "[8, 2, 1]", 6U}}) {
    const Case given = parse_case(case_of_block(other(lower, divisions) + newmark), "case.toml");
    const Simulation simulation(given);
    const Model& model = simulation.model();
    const auto& all = std::get<PairContact>(model.contacts[0]);
    const auto is_under = [&](const Facet& facet) {
      return std::all_of(facet.begin(), facet.end(),
                         [&](Index n) { return model.mesh->coordinates[static_cast<std::size_t>(n)][2] == 3.0; });
    };
    // the four faces of the head, and what hangs over
    EXPECT_EQ(std::count_if(all.slave.facets.begin(), all.slave.facets.end(), is_under), 4 + left);
    EXPECT_EQ(std::count_if(all.master.facets.begin(), all.master.facets.end(), is_under), 4 + left);
    EXPECT_NE(std::find_if(model.notes.begin(), model.notes.end(),
                           [](const std::string& note) {
                             return note.find("contact \"all\" leaves out ") == 0 && note.ends_with("\"glue\" holds");
                           }),
              model.notes.end());
  }
}

TEST(RigidSurface, OfFacesOfAPartThatMovesIsRefused) {
  const std::string lid =
      "[[mesh.block]]\norigin = [0.0, 0.0, 3.5]\nsize = [2.0, 2.0, 1.0]\ndivisions = [1, 1, 1]\n"
      "groups = { cells = \"OTHER\", zmin = \"UNDER\" }\n"
      "[[part]]\nname = \"other\"\ncells = \"OTHER\"\nmaterial = \"soft\"\n"
      "[[contact]]\nname = \"lid\"\nkind = \"surface\"\nsurface = \"UNDER\"\ngroup = \"HEAD\"\n";
  EXPECT_EQ(case_error(case_of_block(lid + newmark)).key(), "contact.surface");
  const std::string held = "[[support]]\nnodes = \"OTHER\"\nblocked = [\"x\", \"y\", \"z\"]\n";
  const Case given = parse_case(case_of_block(lid + held + newmark), "case.toml");
  EXPECT_NO_THROW(Simulation{given});
}

// Keys for hourglass modes belong to cells that have them, and no viscosity is none, whatever the cells.
TEST(Hourglass, KeysOfOtherCellsAreRefused) {
  const CaseError stabilised = case_error(case_of_block("hourglass_viscosity = 0.1\n" + newmark));
  EXPECT_NE(
      std::string(stabilised.what()).find("found formulation \"stabilised\", which these cells have without the key"),
      std::string::npos)
      << stabilised.what();
  const CaseError full = case_error(case_of_block("formulation = \"full\"\nhourglass = 0.1\n" + newmark));
  EXPECT_NE(std::string(full.what()).find("expected formulation = \"one_point\", \"stabilised\" or \"nodal\""),
            std::string::npos)
      << full.what();
  EXPECT_NO_THROW(Simulation(parse_case(case_of_block("hourglass_viscosity = 0.0\n" + newmark), "case.toml")));
}

// `check` said that such a case was ready to run.
TEST(Statics, LoadsThatNothingHoldsAreRefusedBeforeTheRun) {
  const std::string pushed =
                        "[scheme]\nkind = \"statics\"\n[time]\nend = 1.0\nstep = 0.5\n[[load]]\ngroup = \"HEAD\"\n"
                        "pressure = 1.0\n",
                    held = "[[support]]\nnodes = \"FOOT\"\nblocked = [\"z\"]\n";
  EXPECT_NE(std::string(case_error(case_of_block(pushed)).what()).find("no support and no contact holds the body"),
            std::string::npos);
  EXPECT_NO_THROW(Simulation(parse_case(case_of_block(pushed + held), "case.toml")));
}

TEST(CellTypes, WithoutAnElementAreRefusedWithARemedy) {
  const auto message = [](int gmsh_type, const std::string& nodes, const std::string& cell) -> std::string {
    const std::string file = testing::TempDir() + "other_cells.msh";
    std::ofstream(file) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"BODY\"\n"
                           "$EndPhysicalNames\n$Nodes\n" +
                               nodes + "$EndNodes\n$Elements\n1\n1 " + std::to_string(gmsh_type) + " 2 1 1 " + cell +
                               "\n$EndElements\n";
    return case_error("units = \"SI\"\nmesh.file = \"" + file +
                      "\"\n[materials.m]\nlaw = \"linear_elastic\"\nE = 1e9\nnu = 0.3\nrho = 1000.0\n"
                      "[[part]]\nname = \"body\"\ncells = \"BODY\"\nmaterial = \"m\"\nsection = \"plane_strain\"\n" +
                      newmark)
        .what();
  };
  std::string nodes = "9\n";
  constexpr double x[9][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {.5, 0}, {1, .5}, {.5, 1}, {0, .5}, {.5, .5}};
  std::string cell;
  for (int i = 0; i < 9; ++i) {
    nodes += fmt::format("{} {} {} 0\n", i + 1, x[i][0], x[i][1]);
    cell += fmt::format("{}{}", i == 0 ? "" : " ", i + 1);
  }
  const std::string second_order = message(10, nodes, cell);
  EXPECT_NE(second_order.find("1 QUAD9 cell (1) in \"BODY\""), std::string::npos) << second_order;
  EXPECT_NE(second_order.find("mesh.order = \"linear\""), std::string::npos) << second_order;
  EXPECT_NE(second_order.find("cells of first order"), std::string::npos) << second_order;
}

}  // namespace
}  // namespace carom::run_refusals_test
