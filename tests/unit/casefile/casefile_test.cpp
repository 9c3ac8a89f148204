// Reading cases: values, defaults, places, and what is written from the declared format.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "casefile/case_schema.hpp"
#include "casefile/plausibility.hpp"
#include "casefile/read_case.hpp"
#include "casefile/resolved_case.hpp"
#include "casefile/schema.hpp"

namespace carom::casefile_test {
namespace {

double beta_of(const Case& c) {
  return std::get<NewmarkParameters>(c.scheme.parameters).beta;
}

double alpha_of(const Case& c) {
  return std::get<AlphaParameters>(c.scheme.parameters).alpha;
}

const std::string complete_path = std::string(CAROM_SOURCE_DIR) + "/tests/data/case_complete.toml";

/// The least that a case needs.
const std::string minimal = R"(
[mesh]
file = "bar.msh"
[materials.steel]
law = "linear_elastic"
E = 2.1e11
nu = 0.3
rho = 7850
[[part]]
name = "bar"
cells = "BAR"
material = "steel"
[scheme]
kind = "newmark"
[time]
end = 1e-3
step = 1e-6
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Case complete() {
  return read_case(complete_path);
}

TEST(Casefile, DefaultsOfAMinimalCase) {
  const Case c = parse_case(minimal, "minimal.toml");
  EXPECT_EQ(c.file, "minimal.toml");
  EXPECT_EQ(c.units, UnitSystem::si);
  EXPECT_EQ(*c.mesh.file, "bar.msh");
  EXPECT_EQ(beta_of(c), 0.25);
  EXPECT_EQ(std::get<NewmarkParameters>(c.scheme.parameters).gamma, 0.5);
  EXPECT_EQ(**c.scheme.mass, CaseScheme::Mass::consistent);
  EXPECT_FALSE(c.time.fixed);
  EXPECT_EQ(c.solver.kind, SolverKind::automatic);
  EXPECT_EQ(c.solver.max_contact_iterations, 50);
  ASSERT_EQ(c.output.fields.size(), 12U);
  EXPECT_EQ(*c.output.fields[2], "stress");
  EXPECT_EQ(c.output.curves_every, 1);
  EXPECT_FALSE(c.exact.has_value());
}

TEST(Casefile, EveryValueKnowsItsPlace) {
  const Case c = parse_case(minimal, "minimal.toml");
  // Lines counted in `minimal`, whose first line is empty; columns of the values.
  EXPECT_EQ(to_string(c.materials[0].value("E").where), "minimal.toml:6:5");
  EXPECT_EQ(to_string(c.parts[0].material.where), "minimal.toml:12:12");
  EXPECT_EQ(to_string(c.time.step->where), "minimal.toml:17:8");
  EXPECT_EQ(c.materials[0].where.line, 4);
  EXPECT_EQ(c.parts[0].where.line, 9);
}

TEST(Casefile, MassDefaultsToLumpedForCentralDifferences) {
  const std::string text = with(minimal, "newmark", "central_differences");
  EXPECT_EQ(**parse_case(text, "c").scheme.mass, CaseScheme::Mass::lumped);
  const std::string consistent =
      with(text, "\"central_differences\"", "\"central_differences\"\nmass = \"consistent\"");
  EXPECT_EQ(**parse_case(consistent, "c").scheme.mass, CaseScheme::Mass::consistent);
}

TEST(Casefile, ParametersOfTheAlphaFamilyAreTheSameForEveryEnforcement) {
  for (const EnforcementTraits& enforcement : enforcement_table) {
    if (!takes(SchemeKind::newmark, enforcement.kind)) continue;
    const std::string text =
        with(minimal, "\"newmark\"", fmt::format("\"newmark\"\nenforcement = \"{}\"", enforcement.name));
    EXPECT_EQ(beta_of(parse_case(text, "c")), 0.25);
    EXPECT_EQ(alpha_of(parse_case(with(text, "newmark", "hht"), "c")), -0.05);
    EXPECT_EQ(alpha_of(parse_case(with(text, "newmark", "wbz"), "c")), -0.05);
    const std::string given = with(text, "\"newmark\"", "\"newmark\"\nbeta = 0.3");
    EXPECT_EQ(beta_of(parse_case(given, "c")), 0.3);
  }
}

// Multipliers whose touches are not stopped: where something moves, and where nodes have mass that could be stopped.
TEST(Casefile, PlainMultipliersAreRefusedWhereNothingCouldBeStopped) {
  const std::string plain = with(minimal, "\"newmark\"", "\"newmark\"\nenforcement = \"plain\"");
  EXPECT_EQ(**parse_case(plain, "c").scheme.enforcement, EnforcementKind::plain);
  for (const SchemeTraits& scheme : scheme_table) {
    if (takes(scheme.kind, EnforcementKind::plain)) continue;
    EXPECT_THROW(parse_case(with(plain, "newmark", std::string(scheme.name)), "c"), CaseError) << scheme.name;
  }
  EXPECT_THROW(parse_case(with(plain, "\"plain\"", "\"plain\"\nmass = \"modified\""), "c"), CaseError);
}

// Names of the literature are read as the scheme with its enforcement, which is what is written.
TEST(Casefile, AliasesOfSchemesAreTheSchemeWithAnEnforcement) {
  for (const SchemeAlias& alias : scheme_aliases) {
    SCOPED_TRACE(alias.name);
    const std::string text = with(with(minimal, "newmark", std::string(alias.name)), "step = 1e-6", "safety = 0.5");
    const Case read = parse_case(text, "c");
    EXPECT_EQ(*read.scheme.kind, alias.kind);
    EXPECT_EQ(**read.scheme.enforcement, alias.enforcement);
    const Case again = parse_case(resolved_toml(read), "c");
    EXPECT_EQ(*again.scheme.kind, alias.kind);
    EXPECT_EQ(**again.scheme.enforcement, alias.enforcement);
    const auto beside = [&](std::string_view enforcement) {
      return with(text, fmt::format("\"{}\"", alias.name),
                  fmt::format("\"{}\"\nenforcement = \"{}\"", alias.name, enforcement));
    };
    EXPECT_NO_THROW(parse_case(beside(name(alias.enforcement)), "c"));
    EXPECT_THROW(parse_case(beside("penalty"), "c"), CaseError);
  }
}

TEST(Casefile, CentralDifferencesNeedNoStep) {
  const std::string text = with(with(minimal, "newmark", "central_differences"), "step = 1e-6", "");
  const Case c = parse_case(text, "c");
  EXPECT_FALSE(c.time.step.has_value());
  EXPECT_EQ(c.time.safety, 0.9);
}

TEST(Casefile, BlocksAndMaterials) {
  const Case c = complete();
  EXPECT_EQ(c.title, "A \"complete\" case");
  EXPECT_EQ(c.units, UnitSystem::mm_t_s);
  ASSERT_EQ(c.mesh.blocks.size(), 2U);
  const StructuredBlock& block = c.mesh.blocks[0];
  EXPECT_EQ(block.divisions, (std::array{2, 2, 20}));
  EXPECT_EQ(block.cells_group, "BAR");
  EXPECT_EQ(block.face_groups, (std::array<std::string, 6>{"XMIN", "", "YMIN", "YMAX", "FOOT", "ZMAX"}));
  ASSERT_EQ(block.points.size(), 1U);
  EXPECT_EQ(block.points[0].name, "TIP");
  EXPECT_EQ(block.points[0].position, (Vec3{10.0, 10.0, 100.0}));
  EXPECT_EQ(c.mesh.blocks[1].cells_group, "BLOCK");
  ASSERT_EQ(c.materials.size(), 2U);
  EXPECT_EQ(c.materials[1].name, "soft rubber");
  EXPECT_EQ(*c.materials[0].value("E"), 210000.0);
  EXPECT_EQ(*c.parts[1].material, "soft rubber");
}

TEST(Casefile, SupportsLoadsAndInitialState) {
  const Case c = complete();
  ASSERT_EQ(c.supports.size(), 3U);
  EXPECT_EQ(**c.supports[0].symmetry, "x");
  EXPECT_EQ(c.supports[1].blocked, (std::array{true, true, false}));
  ASSERT_EQ(c.supports[1].motions.size(), 1U);
  EXPECT_EQ(c.supports[1].motions[0].kind, MotionKind::velocity);
  EXPECT_EQ(c.supports[1].motions[0].component, 2);
  EXPECT_EQ(*c.supports[1].motions[0].amplitude, -2.0);
  EXPECT_EQ(**c.supports[1].motions[0].function, "ramp");
  ASSERT_EQ(c.supports[2].motions.size(), 3U);
  EXPECT_FALSE(c.supports[2].motions[1].function.has_value());
  EXPECT_EQ(c.supports[2].motions[2].kind, MotionKind::acceleration);
  ASSERT_EQ(c.loads.size(), 3U);
  EXPECT_EQ(c.loads[0].kind, CaseLoad::Kind::force);
  EXPECT_EQ(c.loads[0].vector, (Vec3{0.0, 1.0, 0.0}));
  EXPECT_EQ(c.loads[1].pressure, 2.5);
  EXPECT_EQ(c.loads[2].kind, CaseLoad::Kind::gravity);
  EXPECT_EQ((*c.initial[0].velocity)[2], -5000.0);
  EXPECT_FALSE(c.initial[0].displacement.has_value());
}

TEST(Casefile, PointMassesAndSprings) {
  const Case c = complete();
  ASSERT_EQ(c.point_masses.size(), 1U);
  EXPECT_EQ(c.point_masses[0].total, 0.25);
  EXPECT_FALSE(c.point_masses[0].mass.has_value());
  ASSERT_EQ(c.springs.size(), 3U);
  EXPECT_EQ(**c.springs[2].total_stiffness, (Vec3{0.0, 7e3, 0.0}));
  EXPECT_EQ(**c.springs[0].stiffness, (Vec3{1e3, 0.0, 2e3}));
  EXPECT_EQ(**c.springs[1].to, "FOOT");
  EXPECT_EQ(c.springs[1].axial, 5e3);
  ASSERT_EQ(c.equations.size(), 1U);
  ASSERT_EQ(c.equations[0].terms.size(), 2U);
  EXPECT_EQ(*c.equations[0].terms[1].dof, "z");
  EXPECT_EQ(*c.equations[0].terms[1].coefficient, -0.5);
}

TEST(Casefile, AForceIsThatOfEachNodeOrOfAllTogether) {
  const auto loads = [](const std::string& keys) {
    return parse_case(minimal + "[[load]]\ngroup = \"FOOT\"\n" + keys, "c.toml").loads;
  };
  const CaseLoad load = loads("total_force = [1.0, 0.0, 2.0]\n").at(0);
  EXPECT_EQ(load.kind, CaseLoad::Kind::total_force);
  EXPECT_EQ(load.vector, (Vec3{1.0, 0.0, 2.0}));
  try {
    loads("force = [1.0, 0.0, 0.0]\ntotal_force = [1.0, 0.0, 0.0]\n");
    FAIL() << "no error";
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("load[0]: found force and total_force together; expected exactly one of "
                        "force, total_force, pressure, gravity"),
              std::string::npos)
        << error.what();
  }
}

TEST(Casefile, ContactsAndFunctions) {
  const Case c = complete();
  ASSERT_EQ(c.contacts.size(), 4U);
  EXPECT_EQ(*std::get<CasePlane>(c.contacts[0].of).normal, (Vec3{0.0, 0.6, 0.8}));  // [0, 3, 4] / 5
  EXPECT_FALSE(c.contacts[0].obstacle()->per_node);
  EXPECT_TRUE(c.contacts[1].obstacle()->per_node);
  EXPECT_EQ(*c.contacts[2].kind, "interface");
  EXPECT_EQ(std::get<CaseStop>(c.contacts[3].of).damping, 0.1);
  EXPECT_EQ(std::get<CaseStop>(c.contacts[3].of).damper, DamperActs::two_sided);
  ASSERT_EQ(c.functions.size(), 2U);
  const TimeFunction& jump = c.functions[1].function;
  EXPECT_EQ(jump(4.9e-5), 0.0);
  EXPECT_EQ(jump(5e-5), 1.0);  // right-continuous, as TimeFunction says
  const TimeFunction& ramp = c.functions[0].function;
  EXPECT_EQ(ramp(0.5e-4), 0.5);
  EXPECT_EQ(ramp(1e-4), 0.5);
}

TEST(Casefile, ProbesChecksAndExact) {
  const Case c = complete();
  ASSERT_EQ(c.probes.size(), 3U);
  EXPECT_EQ(**c.probes[0].node, 42);
  EXPECT_EQ(*c.probes[0].cfc, 1000.0);
  EXPECT_EQ(*c.probes[2].side, (Vec3{0.0, 0.0, 1.0}));
  ASSERT_EQ(c.checks.size(), 2U);
  EXPECT_TRUE(c.checks[0].exact);
  EXPECT_FALSE(c.checks[0].value.has_value());
  EXPECT_TRUE(c.checks[1].absolute);
  ASSERT_TRUE(c.exact.has_value());
  EXPECT_EQ(c.exact->values.at("stiffness"), 1e6);
  EXPECT_EQ(c.exact->axis, 2);
}

TEST(Casefile, ResolvedCaseReadsBackToItself) {
  for (const std::string& text : {resolved_toml(complete()), resolved_toml(parse_case(minimal, "minimal"))}) {
    EXPECT_EQ(resolved_toml(parse_case(text, "resolved")), text);
  }
}

TEST(Casefile, ResolvedCaseKeepsEveryValueAndShowsDefaults) {
  const Case again = parse_case(resolved_toml(complete()), "resolved");
  const Case c = complete();
  const auto normal = [](const Case& given) { return *std::get<CasePlane>(given.contacts[1].of).normal; };
  EXPECT_EQ(normal(again), normal(c));  // bits: a unit vector is not scaled again
  EXPECT_EQ(again.functions[1].function.time, c.functions[1].function.time);
  EXPECT_EQ(again.supports[2].motions.size(), c.supports[2].motions.size());
  EXPECT_EQ(again.mesh.blocks[0].face_groups, c.mesh.blocks[0].face_groups);
  const std::string text = resolved_toml(parse_case(minimal, "minimal"));
  for (const char* line :
       {"units = \"SI\"", "beta = 0.25", "mass = \"consistent\"", "kind = \"auto\"", "max_contact_iterations = 50",
        "fields = [\"displacement\", \"velocity\", \"stress\", \"von_mises\", \"strain\", \"part\", "
        "\"equivalent_plastic_strain\", \"contact_force\""}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
  EXPECT_EQ(text.find("safety"), std::string::npos);  // not a key of newmark
}

TEST(Casefile, AnEmptyListOfFieldsStaysEmpty) {
  const Case c = parse_case(minimal + "[output]\nfields = []\n", "c");
  EXPECT_TRUE(c.output.fields.empty());
  EXPECT_TRUE(parse_case(resolved_toml(c), "resolved").output.fields.empty());
}

TEST(Casefile, CasesOfTheRepositoryAreRead) {
  const Case c = read_case(std::string(CAROM_SOURCE_DIR) + "/cases/sdnv100/as_published.toml");
  EXPECT_EQ(resolved_toml(parse_case(resolved_toml(c), "resolved")), resolved_toml(c));
  EXPECT_EQ(std::get<NewmarkParameters>(c.scheme.parameters).gamma, 0.55);  // SDNV100: DELTA = 0.55
  EXPECT_TRUE(plausibility_warnings(c).empty());
}

/// The schema of a key: where it has one form for each kind, the one with its text.
const nlohmann::json& form_of(const KeyDescription& key, const nlohmann::json& property) {
  if (!property.contains("anyOf")) return property;
  const nlohmann::json& forms = property["anyOf"];
  const auto found = std::find_if(forms.begin(), forms.end(), [&](const nlohmann::json& form) {
    return form["description"].get<std::string>().starts_with(key.doc);
  });
  return found == forms.end() ? property : *found;
}

/// Every key of the declaration is a property of the JSON Schema, at its place.
void expect_listed(const SectionDescription& section, const nlohmann::json& schema, const std::string& path) {
  for (const KeyDescription& key : section.keys) {
    const std::string child = join(path, key.key);
    ASSERT_TRUE(schema["properties"].contains(key.key)) << child;
    const nlohmann::json& property = form_of(key, schema["properties"][key.key]);
    ASSERT_TRUE(property.contains("description")) << child;
    if (key.shape == Shape::section) expect_listed(*key.section, property, child);
    if (key.shape == Shape::sections) expect_listed(*key.section, property["items"], child);
    if (key.shape == Shape::named_sections) {
      const nlohmann::json& entry = property["additionalProperties"];
      expect_listed(*key.section, key.section->opened_by.empty() ? entry : entry["else"], child);
    }
  }
}

TEST(Casefile, JsonSchemaListsEveryKey) {
  const nlohmann::json schema = nlohmann::json::parse(json_schema());
  expect_listed(case_schema().description, schema, "");
  const nlohmann::json& any_material = schema["properties"]["materials"]["additionalProperties"];
  EXPECT_EQ(any_material["if"]["required"], nlohmann::json{"library"});  // the keys are then those of its law
  EXPECT_EQ(any_material["then"]["required"], nlohmann::json{"law"});
  EXPECT_FALSE(any_material.contains("additionalProperties"));
  const nlohmann::json& material = any_material["else"];
  EXPECT_EQ(material["properties"]["nu"]["exclusiveMaximum"], 0.5);
  EXPECT_EQ(material["additionalProperties"], false);
  EXPECT_EQ(schema["required"], (nlohmann::json{"mesh", "materials", "part", "scheme", "time"}));
  EXPECT_EQ(schema["properties"]["time"]["properties"]["safety"]["default"], 0.9);
}

TEST(Casefile, JsonSchemaKnowsWhatEachKindTakes) {
  const nlohmann::json schema = nlohmann::json::parse(json_schema());
  const nlohmann::json& rules = schema["properties"]["contact"]["items"]["allOf"];
  ASSERT_EQ(rules.size(), 11U);
  EXPECT_EQ(rules[0]["if"]["properties"]["kind"]["const"], "interface");
  EXPECT_EQ(rules[0]["then"]["properties"]["gap"], false);
  EXPECT_FALSE(rules[0]["then"]["properties"].contains("stiffness"));
  const nlohmann::json& plane_needs = rules[1]["then"]["required"];
  EXPECT_NE(std::find(plane_needs.begin(), plane_needs.end(), "normal"), plane_needs.end());
  // [time] depends on scheme.kind: newmark needs a step and takes no safety.
  const nlohmann::json& newmark = schema["allOf"][0];
  EXPECT_EQ(newmark["if"]["properties"]["scheme"]["properties"]["kind"]["const"], "newmark");
  EXPECT_EQ(newmark["then"]["properties"]["time"]["required"], nlohmann::json{"step"});
  EXPECT_EQ(newmark["then"]["properties"]["time"]["properties"]["safety"], false);
}

const std::string examples = std::string(CAROM_SOURCE_DIR) + "/examples/format/";

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> words_of(const std::string& dotted) {
  std::vector<std::string> words;
  std::istringstream stream(dotted);
  for (std::string word; std::getline(stream, word, '.');) words.push_back(word);
  return words;
}

/// Has a text a header [name] or [[name]]? Names may stand in it: materials.damage is [materials.steel.damage].
bool has_section(const std::string& text, const std::string& name) {
  const std::vector<std::string> wanted = words_of(name);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('[')) continue;
    const std::size_t begin = line.find_first_not_of('[');
    std::size_t found = 0;
    for (const std::string& word : words_of(line.substr(begin, line.find(']') - begin)))
      if (found < wanted.size() && word == wanted[found]) ++found;
    if (found == wanted.size()) return true;
  }
  return false;
}

TEST(Casefile, DocumentationInTheRepositoryIsCurrent) {
  const std::string committed = text_of(std::string(CAROM_SOURCE_DIR) + "/docs/case_format.md");
  const std::string current =
      case_documentation([](const std::string& name) { return text_of(examples + name + ".toml"); });
  const std::string written = testing::TempDir() + "case_format.md";
  if (committed != current) std::ofstream(written) << current;
  EXPECT_TRUE(committed == current) << "the format has changed: copy " << written << " to docs/case_format.md";
}

TEST(Casefile, EverySectionHasAnExampleThatHasTheSection) {
  std::set<std::string> names;
  case_documentation([&](const std::string& name) {
    names.insert(name + ".toml");
    const std::string text = text_of(examples + name + ".toml");
    EXPECT_NO_THROW(parse_case(text, name)) << name;
    if (name == "top") return text;
    EXPECT_TRUE(has_section(text, name)) << "no [" << name << "] in its example";
    return text;
  });
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(examples)) {
    if (entry.path().extension() == ".toml") found.insert(entry.path().filename());
  }
  EXPECT_EQ(found, names);
}

TEST(Units, FactorsFollowFromTheBaseUnits) {
  // 1 MPa = 1e6 Pa, 1 t/mm3 = 1e12 kg/m3, 1 kN = 1e3 N, 1 kg/mm3 = 1e9 kg/m3, 1 mm/ms = 1 m/s by definition.
  const double round_off = 1e-15;  // pow(10, n) may err in the last bit
  const auto factor = [](Dimension d, UnitSystem u) { return si_factor(d, u); };
  EXPECT_NEAR(factor(Dimension::stress, UnitSystem::mm_t_s) / 1e6, 1.0, round_off);
  EXPECT_NEAR(factor(Dimension::density, UnitSystem::mm_t_s) / 1e12, 1.0, round_off);
  EXPECT_NEAR(factor(Dimension::force, UnitSystem::mm_t_s), 1.0, round_off);
  EXPECT_NEAR(factor(Dimension::energy, UnitSystem::mm_t_s) / 1e-3, 1.0, round_off);
  EXPECT_NEAR(factor(Dimension::force, UnitSystem::mm_kg_ms) / 1e3, 1.0, round_off);
  EXPECT_NEAR(factor(Dimension::stress, UnitSystem::mm_kg_ms) / 1e9, 1.0, round_off);
  EXPECT_NEAR(factor(Dimension::density, UnitSystem::mm_kg_ms) / 1e9, 1.0, round_off);
  EXPECT_NEAR(factor(Dimension::velocity, UnitSystem::mm_kg_ms), 1.0, round_off);
  EXPECT_NEAR(factor(Dimension::damping, UnitSystem::mm_kg_ms) / 1e3, 1.0, round_off);
  EXPECT_EQ(factor(Dimension::none, UnitSystem::mm_t_s), 1.0);
  EXPECT_EQ(unit_name(Dimension::stress_per_length, UnitSystem::mm_kg_ms), "GPa/mm");
}

TEST(Plausibility, SteelInSiIsFine) {
  EXPECT_TRUE(plausibility_warnings(parse_case(minimal, "c.toml")).empty());
}

TEST(Plausibility, NamesTheUnitSystemThatWouldFit) {
  const std::string text = with(with(minimal, "7850", "7.85e-9"), "2.1e11", "210000");
  const auto lines = plausibility_warnings(parse_case(text, "c.toml"));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(
      lines[0],
      "c.toml:8: materials.steel: density 7.85e-09 kg/m3 is 1e+12 times below that of steel; it would fit mm-t-s: "
      "did you mean units = \"mm-t-s\"?");
}

TEST(Plausibility, NamesTheValueInAnotherUnit) {
  const auto lines = plausibility_warnings(parse_case(with(minimal, "2.1e11", "210000"), "c.toml"));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(
      lines[0],
      "c.toml:6: materials.steel: wave speed sqrt(E/rho) 5.172 m/s is 1e+03 times below that of steel; is E in MPa?");
}

TEST(Plausibility, SteelInSiUnderMillimetres) {
  const auto lines = plausibility_warnings(parse_case("units = \"mm-t-s\"" + minimal, "c.toml"));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(
      lines[0].substr(lines[0].find(": ")),
      ": did you mean units = \"SI\" instead of \"mm-t-s\"? 2 values show it: materials.steel: density 7850 t/mm3 "
      "is 1e+12 times above that of steel (line 8); materials.steel: Young's modulus 2.1e+11 MPa is 1e+06 times "
      "above that of steel (line 6)");
}

// One unit that is wrong shows in all materials, in gravity and in what others have found.
TEST(Plausibility, OneCauseIsSaidOnce) {
  const std::string wrong =
      with(with(minimal, "7850", "7.85e-9"), "2.1e11", "210000") + "[[load]]\ngravity = [0, 0, -9810]\n";
  const UnitSign further{{"c.toml", 9, 0}, "time: nothing will deform", "are these units?"};
  const auto lines = plausibility_warnings(parse_case(wrong, "c.toml"), {further});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].starts_with("c.toml:8: did you mean units = \"mm-t-s\" instead of \"SI\"? 3 values show it: "))
      << lines[0];
  EXPECT_TRUE(lines[0].ends_with("but in SI that is 9.807 m/s2 (line 18); time: nothing will deform (line 9)"))
      << lines[0];
  // Gravity alone says nothing of the system in which all else makes sense.
  const std::string twice = minimal + "[[load]]\ngravity = [0, 0, -9810]\n[[load]]\ngravity = [0, 0, -9800]\n";
  EXPECT_EQ(plausibility_warnings(parse_case(twice, "c.toml")).size(), 2U);
  EXPECT_EQ(plausibility_warnings(parse_case(minimal, "c.toml"), {further}),
            std::vector<std::string>{"c.toml:9: time: nothing will deform; are these units?"});
}

TEST(Plausibility, SpeedsBeyondElasticImpact) {
  const auto lines =
      plausibility_warnings(parse_case(minimal + "[[initial]]\npart = \"bar\"\nvelocity = [0, 0, -10000]\n", "c.toml"));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], "c.toml:18: initial.velocity: 1e+04 m/s is 1e+04 m/s, faster than elastic impact makes sense");
}

TEST(Plausibility, GravityOfAnotherUnitSystem) {
  const auto lines = plausibility_warnings(parse_case(minimal + "[[load]]\ngravity = [0, 0, -9810]\n", "c.toml"));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0],
            "c.toml:18: load.gravity: 9810 m/s2 is the earth's gravity in mm-t-s, but in SI that is 9.807 m/s2");
}

TEST(Plausibility, ConditionallyStableNewmark) {
  const auto lines = plausibility_warnings(
      parse_case(with(minimal, "kind = \"newmark\"", "kind = \"newmark\"\nbeta = 0.1"), "c.toml"));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("c.toml:13: scheme: Newmark with beta = 0.1 and gamma = 0.5"), std::string::npos) << lines[0];
}

}  // namespace
}  // namespace carom::casefile_test
