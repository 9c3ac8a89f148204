// *MATERIAL and *SOLID SECTION as materials and parts.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "deck/keyword_table.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// The keywords of one material, by their names.
struct MaterialKeywords {
  const DeckKeyword* material = nullptr;
  std::map<std::string, const DeckKeyword*> options;

  const DeckKeyword* option(const std::string& name) const {
    const auto found = options.find(name);
    return found == options.end() ? nullptr : found->second;
  }
};

std::vector<MaterialKeywords> materials_of(const Statements& statements) {
  static const std::set<std::string> names{"ELASTIC",      "PLASTIC",       "RATE DEPENDENT",         "DENSITY",
                                           "HYPERELASTIC", "SPECIFIC HEAT", "INELASTIC HEAT FRACTION"};
  std::vector<MaterialKeywords> materials;
  bool is_within = false;
  for (const Statement& s : statements.list) {
    const DeckKeyword& keyword = *s.keyword;
    if (keyword.name == "MATERIAL") materials.push_back({&keyword, {}});
    if (names.count(keyword.name) == 0) {
      is_within = keyword.name == "MATERIAL" || (is_within && keyword.name != "STEP");
      continue;
    }
    if (!is_within) keyword.fail("*" + keyword.name + " of no material", "*MATERIAL before it");
    if (!materials.back().options.emplace(keyword.name, &keyword).second)
      keyword.fail("*" + keyword.name + " a second time", "once in a material");
  }
  return materials;
}

/// The values of the first data line, at least `least` of them.
std::vector<double> values_of(const DeckKeyword& keyword, std::size_t least, const std::string& what) {
  std::vector<double> values;
  DeckCursor at(keyword);
  if (at.next_line())
    while (!at.at_end()) values.push_back(at.real_or(0.0, what));
  if (values.size() < least) keyword.fail(fmt::format("{} values", values.size()), what);
  return values;
}

void refuse_second_line(Translation& t, const DeckKeyword& keyword) {
  DeckCursor at(keyword);
  if (at.next_line() && at.next_line())
    t.findings.refuse(keyword, at.where(), "values that depend on the temperature", "The first line would hold.");
}

/// Young's modulus and Poisson's ratio.
struct Elasticity {
  double E = 0.0, nu = 0.0;
  Location where;
};

Elasticity elasticity(Translation& t, const MaterialKeywords& m) {
  if (const DeckKeyword* elastic = m.option("ELASTIC")) {
    const std::string* type = elastic->parameter("TYPE");
    if (type != nullptr && upper_case(*type) != "ISOTROPIC" && upper_case(*type) != "ISO")
      elastic->fail("TYPE=" + *type, "TYPE=ISOTROPIC", "Carom's laws are isotropic.");
    refuse_second_line(t, *elastic);
    const std::vector<double> values = values_of(*elastic, 1, "Young's modulus, Poisson's ratio");
    return {values[0], values.size() > 1 ? values[1] : 0.0, elastic->where};
  }
  const DeckKeyword* hyper = m.option("HYPERELASTIC");
  if (hyper == nullptr)
    m.material->fail("a material without *ELASTIC", "*ELASTIC or *HYPERELASTIC, NEO HOOKE after *MATERIAL");
  if (!hyper->has("NEO HOOKE")) hyper->fail("another potential", "NEO HOOKE");
  refuse_second_line(t, *hyper);
  const std::vector<double> values = values_of(*hyper, 2, "C10, D1");
  const double G = 2.0 * values[0];
  if (!(values[0] > 0.0) || !(values[1] > 0.0))
    hyper->fail(fmt::format("C10 = {:g}, D1 = {:g}", values[0], values[1]), "both positive",
                "Carom has no incompressible bodies; D1 is 2 over the bulk modulus.");
  const double K = 2.0 / values[1];
  return {9.0 * K * G / (3.0 * K + G), (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G)), hyper->where};
}

void add_table(const DeckKeyword& plastic, Translation& t, TableMaker& to) {
  List rows;
  std::set<double> temperatures;
  for (DeckCursor at(plastic); at.next_line();) {
    const double stress = at.real("the yield stress"), strain = at.real_or(0.0, "the plastic strain");
    rows.push_back(numbers_node({strain, stress}, at.where()));
    temperatures.insert(at.real_or(0.0, "the temperature"));
    at.end_line("yield stress, plastic strain, temperature");
  }
  if (rows.empty()) plastic.fail("no data", "lines of yield stress, plastic strain");
  std::set<double> strains;
  for (const Node& row : rows) strains.insert(std::get<double>(std::get<List>(row.value)[0].value));
  if (strains.size() < rows.size() || temperatures.size() > 1)
    t.findings.refuse(plastic, plastic.where, "several curves, one for each temperature or rate",
                      "Only one is carried.");
  if (rows.size() == 1)
    to.number("yield_stress", std::get<double>(std::get<List>(rows[0].value)[1].value));
  else
    to.add("hardening_table", {std::move(rows), plastic.where});
}

void add_johnson_cook(Translation& t, const MaterialKeywords& m, const DeckKeyword& plastic, TableMaker& to) {
  const std::vector<double> v = values_of(plastic, 6, "A, B, n, m, melting temperature, transition temperature");
  to.number("A", v[0]).number("B", v[1]).number("n", v[2]).number("m", v[3]);
  double C = 0.0, rate = 1.0;
  if (const DeckKeyword* dependent = m.option("RATE DEPENDENT")) {
    const std::string* type = dependent->parameter("TYPE");
    if (type == nullptr || without_blanks(*type) != "JOHNSONCOOK")
      dependent->fail(type == nullptr ? "no TYPE" : "TYPE=" + *type, "TYPE=JOHNSON COOK");
    const std::vector<double> r = values_of(*dependent, 2, "C, the reference rate");
    C = r[0], rate = r[1];
  }
  to.number("C", C).number("reference_rate", rate);
  to.number("melting_temperature", v[4]).number("reference_temperature", v[5]).number("initial_temperature", v[5]);
  const bool is_adiabatic =
      std::any_of(t.steps.begin(), t.steps.end(), [](const DeckStep& s) { return s.procedure->has("ADIABATIC"); });
  const DeckKeyword* heat = m.option("SPECIFIC HEAT");
  const DeckKeyword* fraction = m.option("INELASTIC HEAT FRACTION");
  if (is_adiabatic && heat == nullptr)
    plastic.fail("ADIABATIC without *SPECIFIC HEAT", "*SPECIFIC HEAT in the material");
  to.number("specific_heat", heat == nullptr ? 1.0 : values_of(*heat, 1, "the specific heat")[0]);
  to.number("taylor_quinney", !is_adiabatic         ? 0.0
                              : fraction == nullptr ? 0.9
                                                    : values_of(*fraction, 1, "the fraction")[0]);
  t.findings.note(plastic.where, is_adiabatic ? "the body begins at the transition temperature and is heated by its "
                                                "plastic work"
                                              : "no heating: no step is ADIABATIC");
}

/// The law, and what it has besides the elastic constants.
void add_law(Translation& t, const MaterialKeywords& m, TableMaker& to) {
  const bool is_finite = t.is_finite();
  const DeckKeyword* plastic = m.option("PLASTIC");
  if (plastic == nullptr) {
    const bool is_hyper = m.option("HYPERELASTIC") != nullptr && is_finite;
    if (is_hyper)
      t.findings.refuse(
          *m.option("HYPERELASTIC"), m.option("HYPERELASTIC")->where,
          "another potential than that of Carom's neo_hookean",
          "Equal at small strains; where the volume changes by a tenth, stresses differ by some per cent.");
    to.text("law", is_hyper ? "neo_hookean" : is_finite ? "st_venant_kirchhoff" : "linear_elastic");
    return;
  }
  const std::string* hardening = plastic->parameter("HARDENING");
  const std::string kind = hardening == nullptr ? "ISOTROPIC" : without_blanks(*hardening);
  if (kind == "JOHNSONCOOK") {
    to.text("law", "johnson_cook");
    add_johnson_cook(t, m, *plastic, to);
    return;
  }
  if (m.option("RATE DEPENDENT") != nullptr)
    t.findings.refuse(*m.option("RATE DEPENDENT"), m.option("RATE DEPENDENT")->where, "rates with a table of hardening",
                      "The yield stress would not depend on the rate.");
  if (kind != "ISOTROPIC")
    t.findings.refuse(*plastic, plastic->where, "HARDENING=" + *hardening, "Hardening would be isotropic.");
  to.text("law", is_finite ? "j2" : "j2_small_strain");
  add_table(*plastic, t, to);
}

/// Statics without gravity needs no density.
bool needs_density(const Translation& t) {
  const bool is_dynamic =
      std::any_of(t.steps.begin(), t.steps.end(), [](const DeckStep& s) { return s.kind != DeckStep::Kind::statics; });
  return is_dynamic || std::any_of(t.statements.list.begin(), t.statements.list.end(), [](const Statement& s) {
           DeckCursor at(*s.keyword);
           if (s.keyword->name != "DLOAD" || !at.next_line()) return false;
           at.field();
           return upper_case(at.field()) == "GRAV";
         });
}

void translate_material(Translation& t, const MaterialKeywords& m) {
  TableMaker table(m.material->where);
  add_law(t, m, table);
  const Elasticity elastic = elasticity(t, m);
  table.add("E", number_node(elastic.E, elastic.where)).add("nu", number_node(elastic.nu, elastic.where));
  if (const DeckKeyword* density = m.option("DENSITY")) {
    refuse_second_line(t, *density);
    table.add("rho", number_node(values_of(*density, 1, "the density")[0], density->where));
  } else if (needs_density(t)) {
    m.material->fail("a material without *DENSITY", "*DENSITY after *MATERIAL", "Bodies in motion have a mass.");
  } else {
    table.number("rho", 1.0);
    t.findings.note(m.material->where, "no *DENSITY, which statics does not need; 1 is written");
  }
  t.define("materials", m.material->required("NAME"), table.node());
}

/// The last *BULK VISCOSITY, or what Abaqus' explicit program has without one.
std::array<double, 2> bulk_viscosity(const Translation& t) {
  std::optional<std::array<double, 2>> given;
  for (const Statement& s : t.statements.list) {
    if (s.keyword->name != "BULK VISCOSITY") continue;
    const std::vector<double> v = values_of(*s.keyword, 1, "linear, quadratic bulk viscosity");
    given = {v[0], v.size() > 1 ? v[1] : 0.0};
  }
  if (given || !t.is_explicit_abaqus()) return given.value_or(std::array<double, 2>{});
  t.findings.note(t.steps.front().procedure->where,
                  "bulk viscosity 0.06 and 1.2, which Abaqus has where none is given");
  return {0.06, 1.2};
}

/// Where the *SECTION CONTROLS that a section names keeps its cells from folding: the share that they keep.
std::optional<double> distortion_control(Translation& t, const DeckKeyword& section) {
  const std::string* name = section.parameter("CONTROLS");
  if (name == nullptr) return std::nullopt;
  std::optional<double> share;
  for (const Statement& s : t.statements.list) {
    const DeckKeyword& controls = *s.keyword;
    if (controls.name != "SECTION CONTROLS" || upper_case(controls.required("NAME")) != upper_case(*name)) continue;
    const std::string* wanted = controls.parameter("DISTORTION CONTROL");
    if (wanted == nullptr || upper_case(*wanted) == "NO") continue;
    const std::string* ratio = controls.parameter("LENGTH RATIO");
    constexpr double without_ratio = 0.1;
    share = ratio == nullptr ? without_ratio : as_real(*ratio);
    if (!share) controls.fail("LENGTH RATIO=" + *ratio, "a number between 0 and 1");
  }
  if (!share || t.is_finite()) return share;
  t.findings.note(section.where, "DISTORTION CONTROL changes nothing at small strain");
  return std::nullopt;
}

void translate_section(Translation& t, const Statement& s, const std::array<double, 2>& viscosity) {
  const DeckKeyword& keyword = *s.keyword;
  const std::string set = keyword.required("ELSET"), material = keyword.required("MATERIAL");
  const std::string key = key_of(t.mesh.names.element_sets, t.scope(s), set);
  if (key.empty()) keyword.fail("ELSET=" + set, "the name of a set of cells");
  DeckCursor at(keyword);
  const std::optional<double> keeps = distortion_control(t, keyword);
  const double size = at.next_line() ? at.real_or(0.0, "thickness or area") : 0.0;
  for (const DeckNames::Cells& cells : t.mesh.names.element_sets.at(key)) {
    const DeckElementType& type = *cells.type;
    if (type.section.empty())
      keyword.fail(fmt::format("elements of type {} in {}", type.name, set), "solids, plane cells or bars");
    TableMaker part(keyword.where);
    part.text("name", cells.group).text("cells", cells.group).text("material", material);
    if (type.section != "solid") part.text("section", std::string(type.section));
    if (type.section == "plane_strain" || type.section == "plane_stress")
      part.number("thickness", size > 0.0 ? size : 1.0);
    if (type.section == "bar") {
      if (!(size > 0.0)) keyword.fail("no area of the bars", "their area in the data line");
      part.number("area", size);
    }
    if (!type.formulation.empty()) part.text("formulation", std::string(type.formulation));
    if (keeps) part.number("distortion_control", *keeps);
    if (viscosity[0] != 0.0) part.number("linear_bulk_viscosity", viscosity[0]);
    if (viscosity[1] != 0.0) part.number("quadratic_bulk_viscosity", viscosity[1]);
    if (!type.remark.empty()) t.findings.note(keyword.where, fmt::format("{}: {}", type.name, type.remark));
    t.append("part", part.node());
  }
}

}  // namespace

void translate_bodies(Translation& t) {
  for (const MaterialKeywords& m : materials_of(t.statements)) translate_material(t, m);
  const std::array<double, 2> viscosity = bulk_viscosity(t);
  for (const Statement& s : t.statements.list)
    if (s.keyword->name == "SOLID SECTION") translate_section(t, s, viscosity);
  const Location top{t.mesh.mesh.report.source, 0, 0};
  if (t.root.find("materials") == nullptr || t.root.find("part") == nullptr) {
    t.findings.check(top.file);
    throw CaseError(top, "", "no *MATERIAL with a *SOLID SECTION", "at least one of both");
  }
}

}  // namespace carom
