// *MATERIAL and *SOLID SECTION as materials and parts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "deck/keyword_table.hpp"
#include "translate/temperatures.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

/// The keywords of one material, by their names.
struct MaterialKeywords {
  const DeckKeyword* material = nullptr;
  std::map<std::string, const DeckKeyword*> options;
  std::vector<const DeckKeyword*> plastic;  ///< one for each rate

  std::string name() const { return material->required("NAME"); }
  const DeckKeyword* option(const std::string& name) const {
    const auto found = options.find(name);
    return found == options.end() ? nullptr : found->second;
  }
};

std::vector<MaterialKeywords> materials_of(Translation& t) {
  static const std::set<std::string> names{"ELASTIC",
                                           "PLASTIC",
                                           "RATE DEPENDENT",
                                           "DENSITY",
                                           "HYPERELASTIC",
                                           "SPECIFIC HEAT",
                                           "INELASTIC HEAT FRACTION",
                                           "DAMAGE INITIATION",
                                           "DAMAGE EVOLUTION",
                                           "DAMAGE STABILIZATION"};
  std::vector<MaterialKeywords> materials;
  bool is_within = false;
  for (const Statement& s : t.statements.list) {
    const DeckKeyword& keyword = *s.keyword;
    if (keyword.name == "MATERIAL") {
      t.errors.attempt([&] {
        const std::string name = upper_case(keyword.required("NAME"));
        for (const MaterialKeywords& other : materials)
          if (upper_case(other.material->required("NAME")) == name)
            keyword.fail("the material " + name + " a second time", "one *MATERIAL of a name");
      });
      materials.push_back({&keyword, {}, {}});
    }
    if (names.count(keyword.name) == 0) {
      is_within = keyword.name == "MATERIAL" || (is_within && keyword.name != "STEP");
      continue;
    }
    t.errors.attempt([&] {
      if (!is_within) keyword.fail("*" + keyword.name + " of no material", "*MATERIAL before it");
      if (keyword.name == "PLASTIC") materials.back().plastic.push_back(&keyword);
      if (!materials.back().options.emplace(keyword.name, &keyword).second && !keyword.has("RATE"))
        keyword.fail("*" + keyword.name + " a second time", "once in a material");
    });
  }
  return materials;
}

bool is_johnson_cook(const DeckKeyword& damage_initiation) {
  return without_blanks(damage_initiation.required("CRITERION")) == "JOHNSONCOOK";
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

/// *CONDUCTIVITY and *EXPANSION change something where temperatures change.
void refuse_heat(Translation& t, const DeckKeyword& keyword) {
  const auto given = [&](const char* name) {
    return std::any_of(t.statements.list.begin(), t.statements.list.end(),
                       [&](const Statement& s) { return s.keyword->name == name; });
  };
  const bool flows = std::any_of(t.steps.begin(), t.steps.end(), [](const DeckStep& s) { return s.is_coupled(); });
  const bool is_expansion = keyword.name == "EXPANSION";
  if (is_expansion ? t.heats() || given("TEMPERATURE") : flows)
    t.findings.refuse(keyword, keyword.where, "not carried out",
                      is_expansion ? "There would be no thermal strains." : "Heat would not flow.");
  else
    t.findings.note(keyword.where, fmt::format("*{} changes nothing: no step {}", keyword.name,
                                               is_expansion ? "changes temperatures" : "computes temperatures"));
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
    const std::vector<double> values = values_at_start(t, m.name(), *elastic, 1, 2, "Young's modulus, Poisson's ratio");
    return {values[0], values[1], elastic->where};
  }
  const DeckKeyword* hyper = m.option("HYPERELASTIC");
  if (hyper == nullptr)
    m.material->fail("a material without *ELASTIC", "*ELASTIC or *HYPERELASTIC, NEO HOOKE after *MATERIAL");
  if (!hyper->has("NEO HOOKE")) hyper->fail("another potential", "NEO HOOKE");
  const std::vector<double> values = values_at_start(t, m.name(), *hyper, 2, 2, "C10, D1");
  const double G = 2.0 * values[0];
  if (!(values[0] > 0.0) || !(values[1] > 0.0))
    hyper->fail(fmt::format("C10 = {:g}, D1 = {:g}", values[0], values[1]), "both positive",
                "Carom has no incompressible bodies; D1 is 2 over the bulk modulus.");
  const double K = 2.0 / values[1];
  return {9.0 * K * G / (3.0 * K + G), (3.0 * K - 2.0 * G) / (2.0 * (3.0 * K + G)), hyper->where};
}

Node rows_of(const HardeningCurve& curve, double factor, const Location& where) {
  List rows;
  for (const auto& [strain, stress] : curve) rows.push_back(numbers_node({strain, factor * stress}, where));
  return {std::move(rows), where};
}

/// Curves by their rates.
struct RateCurves {
  std::vector<double> rates;
  List rows;

  void add(double rate, const HardeningCurve& curve, double factor, const Location& where) {
    rates.push_back(rate);
    const Node more = rows_of(curve, factor, where);
    const List& list = std::get<List>(more.value);
    rows.insert(rows.end(), list.begin(), list.end());
  }
};

/// The curve times 1 + (rate / D)^(1 / n) (G. R. Cowper and P. S. Symonds, 1957), at rates that double from 1e-9 to 1e4
/// times D; between them it is below by less than 1.5 % of what the rate adds, the most at n = 2.
void add_power_law(Translation& t, const std::string& material, const DeckKeyword& dependent,
                   const HardeningCurve& curve, const Location& where, RateCurves& to) {
  const std::vector<double> v = values_at_start(t, material, dependent, 2, 2, "the multiplier D, the exponent n");
  if (!(v[0] > 0.0) || !(v[1] >= 1.0))
    dependent.fail(fmt::format("D = {:g}, n = {:g}", v[0], v[1]), "D > 0 and n of at least 1");
  to.add(0.0, curve, 1.0, where);
  for (double ratio = 1e-9; ratio < 1e4; ratio *= 2.0)
    to.add(ratio * v[0], curve, 1.0 + std::pow(ratio, 1.0 / v[1]), where);
}

void add_yield_ratios(const DeckKeyword& dependent, const HardeningCurve& curve, const Location& where,
                      RateCurves& to) {
  for (DeckCursor at(dependent); at.next_line();) {
    const double ratio = at.real("the ratio of yield stresses"), rate = at.real("the rate");
    if (at.real_or(0.0, "a temperature") != 0.0) at.fail("ratios that depend on the temperature", "one table");
    to.add(rate, curve, ratio, where);
  }
}

RateCurves rate_curves_of(Translation& t, const MaterialKeywords& m) {
  RateCurves curves;
  if (const DeckKeyword* dependent = m.option("RATE DEPENDENT")) {
    const std::string* type = dependent->parameter("TYPE");
    const std::string kind = type == nullptr ? "POWERLAW" : without_blanks(*type);
    const HardeningCurve curve = curve_at_start(t, m.name(), *m.plastic.front());
    const Location& where = m.plastic.front()->where;
    if (kind == "POWERLAW")
      add_power_law(t, m.name(), *dependent, curve, where, curves);
    else if (kind == "YIELDRATIO")
      add_yield_ratios(*dependent, curve, where, curves);
    else
      dependent->fail("TYPE=" + *type, "POWER LAW, YIELD RATIO or JOHNSON COOK");
    return curves;
  }
  for (const DeckKeyword* plastic : m.plastic) {
    const std::string* rate = plastic->parameter("RATE");
    const auto value = rate == nullptr ? std::optional(0.0) : as_real(*rate);
    if (!value) plastic->fail("RATE=" + *rate, "a rate");
    curves.add(*value, curve_at_start(t, m.name(), *plastic), 1.0, plastic->where);
  }
  return curves;
}

bool depends_on_rate(const MaterialKeywords& m) {
  return m.option("RATE DEPENDENT") != nullptr || m.plastic.size() > 1;
}

void add_table(Translation& t, const MaterialKeywords& m, TableMaker& to) {
  const Location& where = m.plastic.front()->where;
  if (depends_on_rate(m)) {
    RateCurves curves = rate_curves_of(t, m);
    to.add("rates", numbers_node(curves.rates, where)).add("hardening_tables", {std::move(curves.rows), where});
    t.findings.note(where, "the yield stress is linear in the rate between two curves");
    return;
  }
  const HardeningCurve curve = curve_at_start(t, m.name(), *m.plastic.front());
  if (curve.size() == 1)
    to.number("yield_stress", curve.front().second);
  else
    to.add("hardening_table", rows_of(curve, 1.0, where));
}

/// The law knows differences of temperatures alone, the case absolute ones.
void add_temperatures(Translation& t, const MaterialKeywords& m, double melting, double transition, TableMaker& to) {
  double initial = initial_temperature(t, m.name());
  const bool is_given = std::ranges::any_of(t.statements.list, [](const Statement& s) {
    return s.keyword->name == "INITIAL CONDITIONS" && s.keyword->required("TYPE") == "TEMPERATURE";
  });
  if (!is_given && !t.heats()) initial = transition;  // below it all temperatures are the same
  if (!is_given)
    t.findings.note(m.material->where, fmt::format("no initial temperature: the body begins at {:g}", initial));
  const bool is_celsius = transition <= 0.0 || initial <= 0.0;
  const double shift = is_celsius ? 273.15 : 0.0;
  if (is_celsius)
    t.findings.note(m.material->where, "temperatures of 0 or below: 273.15 is added to all of the material");
  to.number("melting_temperature", melting + shift).number("reference_temperature", transition + shift);
  to.number("initial_temperature", initial + shift);
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
  add_temperatures(t, m, v[4], v[5], to);
  const bool is_adiabatic = t.heats();
  const DeckKeyword* heat = m.option("SPECIFIC HEAT");
  const DeckKeyword* fraction = m.option("INELASTIC HEAT FRACTION");
  if (is_adiabatic && heat == nullptr)
    plastic.fail("ADIABATIC without *SPECIFIC HEAT", "*SPECIFIC HEAT in the material");
  to.number("specific_heat", heat == nullptr ? 1.0 : values_at_start(t, m.name(), *heat, 1, 1, "the specific heat")[0]);
  to.number("taylor_quinney", !is_adiabatic         ? 0.0
                              : fraction == nullptr ? 0.9
                                                    : values_of(*fraction, 1, "the fraction")[0]);
  t.findings.note(plastic.where,
                  is_adiabatic ? "the body is heated by its plastic work" : "no heating: no step is ADIABATIC");
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
  if (kind != "ISOTROPIC")
    t.findings.refuse(*plastic, plastic->where, "HARDENING=" + *hardening, "Hardening would be isotropic.");
  const std::string law = depends_on_rate(m) ? "j2_rate" : "j2";
  if (t.heats()) t.findings.note(plastic->where, "no heating: only Johnson and Cook's law heats");
  to.text("law", is_finite ? law : law + "_small_strain");
  add_table(t, m, to);
}

/// Do cells of the material go where their damage reaches 1? Where nothing more is needed to separate them.
bool breaks(Translation& t, const MaterialKeywords& m) {
  const DeckKeyword *initiation = m.option("DAMAGE INITIATION"), *evolution = m.option("DAMAGE EVOLUTION");
  if (evolution == nullptr) return false;
  if (initiation == nullptr) evolution->fail("*DAMAGE EVOLUTION alone", "*DAMAGE INITIATION before it");
  if (!is_johnson_cook(*initiation)) return false;
  if (values_of(*evolution, 1, "the displacement or energy of fracture").front() != 0.0)
    t.findings.refuse(*evolution, evolution->where, "damage that softens the stress until the cell goes",
                      "Cells would go as soon as their damage is 1.");
  return true;
}

/// theta of the damage is that of the law: D5, unless the deck has other temperatures for it.
double of_temperature(Translation& t, const DeckKeyword& initiation, const DeckKeyword& plastic,
                      const std::vector<double>& v) {
  const std::string* hardening = plastic.parameter("HARDENING");
  if (v[4] == 0.0) return 0.0;
  if (hardening == nullptr || without_blanks(*hardening) != "JOHNSONCOOK") {
    t.findings.refuse(initiation, initiation.where, fmt::format("d5 = {:g} without HARDENING=JOHNSON COOK", v[4]),
                      "The strain at fracture would not depend on the temperature.");
    return 0.0;
  }
  const std::vector<double> p = values_of(plastic, 6, "A, B, n, m, melting temperature, transition temperature");
  if (v[5] != p[4] || v[6] != p[5])
    initiation.fail(fmt::format("melting and transition temperatures {:g}, {:g}", v[5], v[6]),
                    fmt::format("those of *PLASTIC, {:g} and {:g}", p[4], p[5]), "A body has one melting temperature.");
  return v[4];
}

/// Returns whether cells go by it.
bool add_damage(Translation& t, const MaterialKeywords& m, TableMaker& to) {
  const DeckKeyword *initiation = m.option("DAMAGE INITIATION"), *plastic = m.option("PLASTIC");
  const bool cells_go = breaks(t, m);
  if (initiation == nullptr) return false;
  if (!is_johnson_cook(*initiation)) {
    t.findings.refuse(*initiation, initiation->where, "CRITERION=" + initiation->required("CRITERION"),
                      "Nothing would break.");
    return false;
  }
  if (plastic == nullptr) initiation->fail("*DAMAGE INITIATION without *PLASTIC", "*PLASTIC in the material");
  const char* const what = "d1, d2, d3, d4, d5, melting temperature, transition temperature, reference rate";
  const std::vector<double> v = values_of(*initiation, 8, what);
  DeckCursor at(*initiation);
  if (at.next_line() && at.next_line()) at.fail("a second line", "one line of Abaqus' values");
  TableMaker damage(initiation->where);
  damage.number("D1", v[0]).number("D2", v[1]).number("D3", -v[2]).number("D4", v[3]);
  damage.number("D5", of_temperature(t, *initiation, *plastic, v)).number("reference_rate", v[7]);
  to.add("damage", damage.node());
  t.findings.note(initiation->where, cells_go ? "cells go where their damage is 1"
                                              : "no *DAMAGE EVOLUTION: the damage is computed, and no cell goes");
  return cells_go;
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

/// Adds it to those whose cells go by their damage, where they do.
void translate_material(Translation& t, const MaterialKeywords& m, std::set<std::string>& breaking) {
  TableMaker table(m.material->where);
  add_law(t, m, table);
  const std::string name = m.name();
  if (add_damage(t, m, table)) breaking.insert(name);
  const Elasticity elastic = elasticity(t, m);
  table.add("E", number_node(elastic.E, elastic.where)).add("nu", number_node(elastic.nu, elastic.where));
  if (const DeckKeyword* density = m.option("DENSITY")) {
    table.add("rho", number_node(values_at_start(t, m.name(), *density, 1, 1, "the density")[0], density->where));
  } else if (needs_density(t)) {
    m.material->fail("a material without *DENSITY", "*DENSITY after *MATERIAL", "Bodies in motion have a mass.");
  } else {
    table.number("rho", 1.0);
    t.findings.note(m.material->where, "no *DENSITY, which statics does not need; 1 is written");
  }
  t.define("materials", name, table.node());
}

/// That of the last step; one goes on in later steps. Abaqus' explicit program has one where none is given.
std::array<double, 2> bulk_viscosity(Translation& t) {
  constexpr std::array<double, 2> without_keyword{0.06, 1.2};
  std::vector<std::array<double, 2>> given;
  const DeckKeyword* last = nullptr;
  const bool has_own = t.is_explicit_abaqus();
  for (std::size_t i = 0; i < t.statements.list.size(); ++i) {
    const DeckKeyword& keyword = *t.statements.list[i].keyword;
    if (keyword.name != "BULK VISCOSITY") continue;
    if (given.empty() && has_own && t.steps.size() > 1 && i > t.steps[1].begin) given.push_back(without_keyword);
    DeckCursor at(keyword);
    at.next_line();
    const double linear = at.real_or(without_keyword[0], "the linear bulk viscosity");
    given.push_back({linear, at.real_or(without_keyword[1], "the quadratic bulk viscosity")});
    last = &keyword;
  }
  if (std::ranges::adjacent_find(given, std::ranges::not_equal_to{}) != given.end())
    t.findings.refuse(*last, last->where, "another bulk viscosity than in a step before",
                      "It would be that of the whole run.");
  if (!given.empty() || !has_own) return given.empty() ? std::array<double, 2>{} : given.back();
  t.findings.note(t.steps.front().procedure->where,
                  "bulk viscosity 0.06 and 1.2, which Abaqus has where none is given");
  return without_keyword;
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

/// Cells may be told to stay when their damage is 1.
void refuse_staying(Translation& t, const DeckKeyword& section) {
  const std::string* name = section.parameter("CONTROLS");
  for (const Statement& s : t.statements.list) {
    const DeckKeyword& controls = *s.keyword;
    if (name == nullptr || controls.name != "SECTION CONTROLS" || controls.required("NAME") != upper_case(*name))
      continue;
    const std::string* deletion = controls.parameter("ELEMENT DELETION");
    if (deletion != nullptr && upper_case(*deletion) == "NO")
      t.findings.refuse(controls, controls.where, "ELEMENT DELETION=NO", "Cells would go where their damage is 1.");
  }
}

/// What the fourth and the fifth number of the *SECTION CONTROLS that a section names are: factors of the linear and
/// the quadratic bulk viscosity.
std::array<double, 2> viscosity_factors(const Translation& t, const DeckKeyword& section) {
  std::array<double, 2> factors{1.0, 1.0};
  const std::string* name = section.parameter("CONTROLS");
  for (const Statement& s : t.statements.list) {
    const DeckKeyword& controls = *s.keyword;
    if (name == nullptr || controls.name != "SECTION CONTROLS" || controls.required("NAME") != upper_case(*name))
      continue;
    DeckCursor at(controls);
    if (!at.next_line()) continue;
    for (int i = 0; i < 3; ++i) at.field();  // of hourglass control
    for (double& factor : factors) factor = at.real_or(1.0, "a factor of the bulk viscosity");
  }
  return factors;
}

/// Can one part have the elements of all types of a set? Its formulation is for the cells that have it.
bool are_of_one_part(const std::vector<DeckNames::Cells>& set) {
  const auto may_stand_beside = [](const DeckElementType& a, const DeckElementType& b) {
    if (a.section != b.section) return false;
    return a.formulation == b.formulation || (a.type != b.type && (a.formulation.empty() || b.formulation.empty()));
  };
  return std::all_of(set.begin(), set.end(), [&](const DeckNames::Cells& a) {
    return std::all_of(set.begin(), set.end(),
                       [&](const DeckNames::Cells& b) { return may_stand_beside(*a.type, *b.type); });
  });
}

/// The one that some of them have.
std::string_view formulation_of(const std::vector<DeckNames::Cells>& set) {
  const auto named = std::find_if(set.begin(), set.end(), [](const auto& c) { return !c.type->formulation.empty(); });
  return named == set.end() ? std::string_view{} : named->type->formulation;
}

/// What the sections of a deck share.
struct OfSections {
  std::array<double, 2> viscosity{};  ///< linear and quadratic
  std::set<std::string> breaking;     ///< materials whose cells go by their damage
};

/// The thickness or area in the data line.
std::optional<double> size_of(DeckCursor& at) {
  if (!at.next_line()) return std::nullopt;
  DeckCursor ahead = at;
  if (ahead.field().empty()) return std::nullopt;
  return at.real("thickness or area");
}

std::string near_of(const std::string& name, const std::vector<std::string>& known) {
  const std::string near = nearest(name, known);
  return near.empty() ? "" : "Did you mean " + near + "?";
}

void translate_section(Translation& t, const Statement& s, const OfSections& shared) {
  std::array<double, 2> viscosity = viscosity_factors(t, *s.keyword);
  for (std::size_t i = 0; i < viscosity.size(); ++i) viscosity[i] *= shared.viscosity[i];
  const DeckKeyword& keyword = *s.keyword;
  const std::string set = keyword.required("ELSET"), material = keyword.required("MATERIAL");
  const std::string key = key_of(t.mesh.names.element_sets, t.scope(s), set);
  if (key.empty()) keyword.fail("ELSET=" + set, "the name of a set of cells");
  const bool lacks_all = t.materials.empty() && !t.errors.empty();  // of which something has been said
  if (!lacks_all &&
      std::ranges::none_of(t.materials, [&](const std::string& name) { return upper_case(name) == material; }))
    keyword.fail("the unknown material " + material,
                 t.materials.empty() ? "the NAME of a *MATERIAL; the deck has none"
                                     : fmt::format("the NAME of a *MATERIAL ({})", fmt::join(t.materials, ", ")),
                 near_of(material, t.materials));
  DeckCursor at(keyword);
  const std::optional<double> keeps = distortion_control(t, keyword);
  const std::optional<double> size = size_of(at);
  const std::vector<DeckNames::Cells>& all = t.mesh.names.element_sets.at(key);
  if (all.empty()) return;  // elements of no known type, which have been said
  for (const DeckNames::Cells& cells : all) {
    if (cells.type->section.empty())
      keyword.fail(fmt::format("elements of type {} in {}", cells.type->name, set), "solids, plane cells or bars");
    if (!cells.type->remark.empty())
      t.findings.note(keyword.where, fmt::format("{}: {}", cells.type->name, cells.type->remark));
  }
  const auto add_part = [&](const std::string& group, std::string_view section, std::string_view formulation) {
    TableMaker part(keyword.where);
    part.text("name", group).text("cells", group).text("material", material);
    if (section != "solid") part.text("section", std::string(section));
    if (section == "plane_strain" || section == "plane_stress") {
      if (size && !(*size > 0.0))
        at.fail(fmt::format("a thickness of {:g}", *size), "a thickness > 0, or no data line for one of 1",
                "Masses and forces are those of cells so thick.");
      part.number("thickness", size.value_or(1.0));
      if (!size) t.findings.note(keyword.where, "no thickness in a data line: it is 1");
    }
    if (section == "bar") {
      if (!size || !(*size > 0.0)) keyword.fail("no area of the bars", "their area in the data line");
      part.number("area", *size);
    }
    if (!formulation.empty()) part.text("formulation", std::string(formulation));
    if (keeps) part.number("distortion_control", *keeps);
    if (viscosity[0] != 0.0) part.number("linear_bulk_viscosity", viscosity[0]);
    if (viscosity[1] != 0.0) part.number("quadratic_bulk_viscosity", viscosity[1]);
    t.append("part", part.node());
    if (shared.breaking.contains(material)) refuse_staying(t, keyword);
    if (shared.breaking.contains(material))
      t.append("erosion", TableMaker(keyword.where).text("part", group).number("damage", 1.0).node());
  };
  if (are_of_one_part(all))
    add_part(key, all.front().type->section, formulation_of(all));
  else
    for (const DeckNames::Cells& cells : all) add_part(cells.group, cells.type->section, cells.type->formulation);
}

}  // namespace

void translate_bodies(Translation& t) {
  OfSections shared;
  for (const MaterialKeywords& m : materials_of(t))
    t.errors.attempt([&] { translate_material(t, m, shared.breaking); });
  for (const Statement& s : t.statements.list)
    if (s.keyword->name == "CONDUCTIVITY" || s.keyword->name == "EXPANSION") refuse_heat(t, *s.keyword);
  t.errors.attempt([&] { shared.viscosity = bulk_viscosity(t); });
  if (!t.mesh.is_whole) return;
  for (const Statement& s : t.statements.list)
    if (s.keyword->name == "SOLID SECTION") t.errors.attempt([&] { translate_section(t, s, shared); });
  if (t.root.find("part") == nullptr && t.errors.empty())
    t.errors.add(CaseError({t.mesh.mesh.report.source, 0, 0}, "",
                           t.materials.empty() ? "no *MATERIAL and no *SOLID SECTION" : "no *SOLID SECTION",
                           "a *SOLID SECTION of the elements, with its ELSET and the NAME of a *MATERIAL",
                           "Elements that are to move have a material by their section."));
}

}  // namespace carom
