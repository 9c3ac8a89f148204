// The matrix of a comparison and the cases it comes to.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "casefile/read_case.hpp"
#include "casefile/read_toml.hpp"
#include "compare/edit.hpp"
#include "compare/element_step.hpp"
#include "compare/matrix.hpp"
#include "compare/variant.hpp"

namespace carom::compare::compare_variants_test {
namespace {

Options options_of(std::vector<std::string> schemes, std::vector<int> cells, std::vector<double> courants) {
  return {std::move(schemes), {}, {}, std::move(cells), std::move(courants)};
}

TEST(CompareMatrix, CombinesEveryValueWithEveryOther) {
  const Options options{{"a", "b"}, {"x"}, {"1", "2", "1"}, {10, 20}, {}};
  const std::vector<Choice> all = combinations(options);
  ASSERT_EQ(all.size(), 8U);  // 2 x 1 x 2 x 2: the repeated stiffness counts once
  EXPECT_EQ(all[0], (Choice{"a", "x", "1", 10, {}}));
  EXPECT_EQ(all[1], (Choice{"a", "x", "1", 20, {}}));
  EXPECT_EQ(all[2], (Choice{"a", "x", "2", 10, {}}));
  EXPECT_EQ(all[7], (Choice{"b", "x", "2", 20, {}}));
  EXPECT_EQ(common_choice(options), (Choice{{}, "x", {}, {}, {}}));
  EXPECT_EQ(label_of(varied(all[7], common_choice(options))), "b, stiffness 2, 20 cells");
}

TEST(CompareMatrix, OfNothingIsTheCaseItself) {
  EXPECT_EQ(combinations({}), std::vector<Choice>{Choice{}});
  EXPECT_EQ(label_of({}), "");
}

TEST(CompareEdit, SetsASchemeWithItsKeys) {
  Node root = read_toml("[scheme]\nkind = \"old\"\nmass = \"lumped\"\n", "t");
  const std::vector<std::string> paths = set_scheme(root, "kind", "newmark:beta=0.28:solver=cg");
  EXPECT_EQ(paths, (std::vector<std::string>{"scheme.kind", "scheme.beta", "scheme.solver"}));
  EXPECT_EQ(std::get<std::string>(find(root, "scheme.kind")->value), "newmark");
  EXPECT_EQ(std::get<double>(find(root, "scheme.beta")->value), 0.28);
  EXPECT_EQ(std::get<std::string>(find(root, "scheme.solver")->value), "cg");
  EXPECT_EQ(std::get<std::string>(find(root, "scheme.mass")->value), "lumped");
  EXPECT_THROW(set_scheme(root, "kind", "newmark:0.28"), CaseError);
}

TEST(CompareEdit, FindsAndErasesInLists) {
  Node root = read_toml("[[contact]]\nname = \"a\"\n[[contact]]\nname = \"b\"\nstiffness = 1.0\n", "t");
  EXPECT_EQ(find_at(root, "contact[0].stiffness"), nullptr);
  EXPECT_EQ(find_at(root, "contact[2].name"), nullptr);
  ASSERT_NE(find_at(root, "contact[1].stiffness"), nullptr);
  EXPECT_TRUE(erase_at(root, "contact[1].stiffness"));
  EXPECT_FALSE(erase_at(root, "contact[1].stiffness"));
}

TEST(CompareEdit, ScalesCellsAlongTheLongestEdge) {
  Node root = read_toml("[[mesh.block]]\nsize = [1.0, 2.0, 10]\ndivisions = [1, 3, 100]\n", "t");
  EXPECT_EQ(cells_of(root), 100);
  set_cells(root, 50);
  const List& divisions = std::get<List>(find_at(root, "mesh.block[0].divisions")->value);
  EXPECT_EQ(std::get<std::int64_t>(divisions[0].value), 1);  // one cell stays one cell
  EXPECT_EQ(std::get<std::int64_t>(divisions[1].value), 2);  // 3 / 2, rounded
  EXPECT_EQ(std::get<std::int64_t>(divisions[2].value), 50);
  Node with_file = read_toml("[mesh]\nfile = \"a.msh\"\n", "t");
  EXPECT_EQ(cells_of(with_file), 0);
  EXPECT_THROW(set_cells(with_file, 10), CaseError);
}

/// The bar of cases/impact_bar by Newmark with a step of 2.5e-3, 100 cells of 0.1, c = 30: h / c = 1 / 300.
class CompareVariants : public testing::Test {
 protected:
  std::vector<Variant> variants(const Options& options) const { return make_variants(base_, options, "folder"); }
  static Case read(const Variant& v) { return parse_case(v.case_text, v.name); }

  Base base_ = read_base(std::string(CAROM_SOURCE_DIR) + "/cases/impact_bar/newmark.toml");
};

TEST_F(CompareVariants, CourantNumberIsCountedByTheShortestCell) {
  // h / c: E = 900, rho = 1, nu = 0, so that c_p = 30; 1e-12: round-off of the cell's volume over its face.
  EXPECT_NEAR(variants({})[0].element_step, 1.0 / 300.0, 1e-12);
  const std::vector<Variant> two = variants(options_of({}, {100, 50}, {0.6, 0.7}));
  ASSERT_EQ(two.size(), 4U);
  EXPECT_EQ(two[0].label, "100 cells, Courant 0.6");
  EXPECT_NEAR(**read(two[0]).time.step, 0.6 / 300.0, 1e-12);
  EXPECT_NEAR(**read(two[2]).time.step, 0.6 / 150.0, 1e-12);
  const double step = **read(two[1]).time.step;  // 1.5 / (0.7 / 300) = 642.9 steps: 643 divide the end
  EXPECT_NEAR(step, 1.5 / 643.0, 1e-12);
}

TEST_F(CompareVariants, ScalesTheStepOfTheCaseWithItsCells) {
  const std::vector<Variant> all = variants(options_of({}, {100, 50}, {}));
  EXPECT_EQ(**read(all[0]).time.step, 2.5e-3);
  EXPECT_NEAR(**read(all[1]).time.step, 5e-3, 1e-12);  // 300 steps to 1.5
}

TEST_F(CompareVariants, LeavesOutTheKeysOfTheOtherScheme) {
  const Variant v = variants(options_of({"central_differences"}, {}, {0.5}))[0];
  EXPECT_EQ(v.refusal, "");
  EXPECT_EQ(v.scheme, "central_differences");
  const Case given = read(v);
  EXPECT_EQ(**given.scheme.mass, CaseScheme::Mass::lumped);  // the default of the new scheme
  EXPECT_TRUE(given.output.fields.empty());
  for (const char* note : {"scheme.beta does not apply", "scheme.gamma does not apply", "time.fixed does not apply"})
    EXPECT_EQ(std::count(v.notes.begin(), v.notes.end(), note), 1) << note;
}

TEST_F(CompareVariants, GivesAStepToASchemeThatNeedsOne) {
  Base without = read_base(std::string(CAROM_SOURCE_DIR) + "/cases/impact_bar/central_differences.toml");
  ASSERT_TRUE(erase_at(without.root, "time.step"));
  const Variant v = make_variants(without, options_of({"newmark"}, {}, {}), "folder")[0];
  EXPECT_EQ(v.refusal, "");
  EXPECT_NEAR(**read(v).time.step, 1.0 / 300.0, 1e-12);
  EXPECT_EQ(v.notes, std::vector<std::string>{"time.step from Courant number 1"});
}

TEST_F(CompareVariants, SayWhyACombinationIsNotAllowed) {
  const std::vector<Variant> all = variants(options_of({"newmark", "leapfrog", "newmark:beta=0.7"}, {}, {}));
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].refusal, "");
  EXPECT_TRUE(all[1].refusal.starts_with("scheme.kind: found \"leapfrog\"")) << all[1].refusal;
  EXPECT_TRUE(all[2].refusal.starts_with("scheme.beta: found 0.7")) << all[2].refusal;
}

// Statics has no inertia, so no waves: its force of an impact is another quantity.
TEST_F(CompareVariants, LeaveStaticsOutBesideInertia) {
  const std::vector<Variant> all = variants(options_of({"newmark", "statics"}, {}, {}));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].refusal, "");
  EXPECT_TRUE(all[1].refusal.starts_with("scheme.kind: found \"statics\" beside schemes that have inertia"))
      << all[1].refusal;
  Base at_rest = read_base(std::string(CAROM_SOURCE_DIR) + "/cases/hertz/cylinder.toml");
  ASSERT_FALSE(at_rest.has_inertia);
  EXPECT_EQ(make_variants(at_rest, {}, "folder")[0].refusal, "");
}

TEST_F(CompareVariants, TakeTheEnforcementThatTheSchemeTakes) {
  Base penalty = base_;
  set_key(penalty.root, "scheme", "enforcement", {std::string("penalty"), {}});
  Options options = options_of({"newmark", "moreau_jean"}, {}, {});
  options.stiffnesses = {"5", "6"};
  const std::vector<Variant> all = make_variants(penalty, options, "folder");
  ASSERT_EQ(all.size(), 3U);  // impulses have no stiffness: one variant
  EXPECT_EQ(all[1].enforcement, "penalty");
  EXPECT_EQ(all[2].label, "moreau_jean");
  EXPECT_EQ(all[2].enforcement, "impulse");
  EXPECT_EQ(std::count(all[2].notes.begin(), all[2].notes.end(), "scheme.enforcement does not apply"), 1);
  options.enforcements = {"penalty"};
  const std::vector<Variant> refused = make_variants(penalty, options, "folder");
  ASSERT_EQ(refused.size(), 4U);
  EXPECT_TRUE(refused[2].refusal.starts_with("scheme.enforcement: found \"penalty\" with the scheme moreau_jean"))
      << refused[2].refusal;
}

TEST_F(CompareVariants, OfStagesAreOfOtherCellsOnly) {
  Base staged = base_;
  const Node stage = read_toml("[[stage]]\nkind = \"newmark\"\nend = 2.0\nstep = 1e-3\n", "t");
  std::get<Table>(staged.root.value).members.push_back({"stage", {}, *find(stage, "stage")});
  const Variant coarse = make_variants(staged, options_of({}, {50}, {}), "folder")[0];
  ASSERT_EQ(coarse.refusal, "");
  EXPECT_NEAR(**read(coarse).time.step, 5e-3, 1e-12);
  EXPECT_NEAR(**read(coarse).stages[0].time.step, 2e-3, 1e-12);
  EXPECT_NE(make_variants(staged, options_of({"hht"}, {}, {}), "folder")[0].refusal, "");
}

TEST_F(CompareVariants, SetTheStiffnessOfEveryContact) {
  Options options;
  options.stiffnesses = {"5", "-5"};
  const std::vector<Variant> all = variants(options);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(**read(all[0]).contacts[0].springs()->stiffness, 5.0);
  EXPECT_TRUE(all[1].refusal.starts_with("contact[0].stiffness: found -5")) << all[1].refusal;
}

TEST_F(CompareVariants, AreKeptOnceWhereTheStiffnessDoesNotApply) {
  Base without = base_;
  erase_at(without.root, "contact");
  ASSERT_TRUE(erase_at(without.root, "check"));  // one of them is about the contact
  Options options;
  options.stiffnesses = {"5", "6"};
  const std::vector<Variant> all = make_variants(without, options, "folder");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].label, "as the case says");
  EXPECT_EQ(all[0].notes, std::vector<std::string>{"no contact takes a stiffness"});
}

TEST_F(CompareVariants, NameTheMeshFileAsSeenFromTheirFolder) {
  const std::string file = std::string(CAROM_SOURCE_DIR) + "/cases/interface_friction/imposed_slide.toml";
  const Base base = read_base(file);
  const std::string folder = testing::TempDir() + "compare_mesh";
  const Variant v = make_variants(base, {}, folder)[0];
  ASSERT_EQ(v.refusal, "");
  const std::filesystem::path mesh = std::filesystem::path(folder) / v.name / *read(v).mesh.file;
  EXPECT_EQ(mesh.lexically_normal(), std::filesystem::path(CAROM_SOURCE_DIR) / "cases/interface_friction/block.msh");
  const Variant refused = make_variants(base, options_of({}, {10}, {}), folder)[0];
  EXPECT_NE(refused.refusal.find("a case whose mesh comes from a file"), std::string::npos) << refused.refusal;
}

TEST_F(CompareVariants, NameTheInitialStateAsSeenFromTheirFolder) {
  const std::string folder = testing::TempDir() + "compare_state";
  Base begun = base_;
  set_key(begun.root, "initial_state", "from", {std::string("../press/out"), {}});
  begun.file = folder + "/cases/impact.toml";
  const Variant v = make_variants(begun, {}, folder)[0];
  ASSERT_EQ(v.refusal, "");
  ASSERT_TRUE(read(v).initial_state);
  EXPECT_EQ(*read(v).initial_state->from, "../press/out");  // from folder/01_...: that of folder/cases/impact.toml
  const Variant refused = make_variants(begun, options_of({}, {10}, {}), folder)[0];
  EXPECT_NE(refused.refusal.find("the state of one mesh, beside other cells"), std::string::npos) << refused.refusal;
}

constexpr const char* two_cells = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "BODY"
$EndPhysicalNames
$Nodes
12
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
7 0 0 1
8 1 0 1
9 2 0 1
10 0 1 1
11 1 1 1
12 2 1 1
$EndNodes
$Elements
2
1 5 2 1 1 1 2 5 4 7 8 11 10
2 5 2 1 1 2 3 6 5 8 9 12 11
$EndElements
)";

TEST(CompareMeshFiles, AreRefinedByHalves) {
  const auto folder = std::filesystem::temp_directory_path() / ("carom_refine_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "two.msh") << two_cells;
  std::ofstream(folder / "case.toml") << R"(units = "SI"
[mesh]
file = "two.msh"
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "body"
cells = "BODY"
material = "soft"
[scheme]
kind = "newmark"
[time]
end = 1.0
step = 0.1
)";
  Options options;
  options.refinements = {0, 1};
  const Base base = read_base((folder / "case.toml").string());
  const std::vector<Variant> variants = make_variants(base, options, (folder / "out").string());
  ASSERT_EQ(variants.size(), 2U);
  EXPECT_EQ(variants[0].refusal, "");
  EXPECT_EQ(variants[1].refusal, "");
  EXPECT_EQ(variants[1].label, "refined 1");
  EXPECT_EQ(variants[0].cells, 1);  // relative to the file
  EXPECT_EQ(variants[1].cells, 2);
  EXPECT_NEAR(variants[1].element_step, 0.5 * variants[0].element_step, 1e-14);
  const Case finer = parse_case(variants[1].case_text, "case.toml");
  EXPECT_EQ(finer.mesh.refine, 1);
  EXPECT_NEAR(**finer.time.step, 0.05, 1e-14);
  options.refinements = {};
  options.cells = {4};
  EXPECT_NE(make_variants(base, options, "out")[0].refusal.find("--refine"), std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace carom::compare::compare_variants_test
