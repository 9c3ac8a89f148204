#include "casefile/cross_references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "casefile/document.hpp"
#include "casefile/guide_keys.hpp"
#include "math/vec3.hpp"
#include "output/quantities.hpp"

namespace carom {

namespace {

using Names = std::vector<std::string>;

std::string entry_path(const char* section, std::size_t i, const char* key) {
  return fmt::format("{}[{}].{}", section, i, key);
}

/// An error unless `name` is one of `names`; `what` says what they are, e.g. "the name of a [materials.NAME]".
void check_known(const Located<std::string>& name, const Names& names, const std::string& path, const std::string& what,
                 CaseErrors& errors) {
  if (std::find(names.begin(), names.end(), *name) != names.end()) return;
  // What could not be read is empty, and an error already.
  const bool is_partial = name->empty() || names.empty() || std::find(names.begin(), names.end(), "") != names.end();
  if (is_partial && !errors.empty()) return;
  const std::string known = names.empty() ? "there is none" : fmt::format("{}", fmt::join(names, ", "));
  const std::string near = nearest(*name, names);
  errors.add(CaseError(name.where, path, fmt::format("the unknown name {}", toml_string(*name)),
                       fmt::format("{} ({})", what, known),
                       near.empty() ? "" : fmt::format("Did you mean {}?", toml_string(near))));
}

struct NamedPlace {
  Located<std::string> name;
  std::string path;
};

void check_unique(const std::vector<NamedPlace>& names, CaseErrors& errors) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = *names[i].name;
    const auto first =
        std::find_if(names.begin(), names.end(), [&](const NamedPlace& other) { return *other.name == name; });
    if (first == names.begin() + static_cast<std::ptrdiff_t>(i) || (name.empty() && !errors.empty())) continue;
    errors.add(CaseError(names[i].name.where, names[i].path,
                         fmt::format("the name {} a second time", toml_string(name)), "a name of its own",
                         fmt::format("The first is {} at line {}.", first->path, first->name.where.line)));
  }
}

template <class Section>
void add_places(const std::vector<Section>& sections, const char* path, std::vector<NamedPlace>& places) {
  for (std::size_t i = 0; i < sections.size(); ++i) places.push_back({sections[i].name, entry_path(path, i, "name")});
}

/// A check names probes and contacts alike, so they share their names.
void check_unique_names(const Case& given, CaseErrors& errors) {
  std::vector<NamedPlace> parts;
  add_places(given.parts, "part", parts);
  check_unique(parts, errors);
  std::vector<NamedPlace> rigid;
  add_places(given.rigid_parts, "rigid_body", rigid);
  check_unique(rigid, errors);
  std::vector<NamedPlace> places;
  add_places(given.contacts, "contact", places);
  add_places(given.probes, "probe", places);
  check_unique(places, errors);
}

template <class Sections>
Names names_of(const Sections& sections) {
  Names names;
  for (const auto& section : sections) {
    if constexpr (requires { section.name.value; })
      names.push_back(*section.name);
    else
      names.push_back(section.name);
  }
  return names;
}

void check_functions(const Case& given, CaseErrors& errors) {
  const Names functions = names_of(given.functions);
  const std::string what = "the name of a [functions.NAME]";
  for (std::size_t i = 0; i < given.supports.size(); ++i) {
    for (const CaseSupport::Motion& motion : given.supports[i].motions) {
      if (!motion.function) continue;
      check_known(*motion.function, functions, entry_path("support", i, name(motion.kind)) + ".function", what, errors);
    }
  }
  for (std::size_t i = 0; i < given.loads.size(); ++i) {
    const auto& function = given.loads[i].function;
    if (function) check_known(*function, functions, entry_path("load", i, "function"), what, errors);
  }
  for (std::size_t i = 0; i < given.contacts.size(); ++i) {
    const CaseObstacle* obstacle = given.contacts[i].obstacle();
    if (obstacle == nullptr) continue;
    const auto &function = obstacle->function, &turns = obstacle->angular_function;
    if (function) check_known(*function, functions, entry_path("contact", i, "function"), what, errors);
    if (turns) check_known(*turns, functions, entry_path("contact", i, "angular_function"), what, errors);
  }
}

double end_of_run(const Case& given) {
  return given.stages.empty() ? *given.time.end : *given.stages.back().time.end;
}

void check_stages(const Case& given) {
  double before = *given.time.end;
  for (std::size_t i = 0; i < given.stages.size(); ++i) {
    const Located<double>& end = given.stages[i].time.end;
    if (!(*end > before)) {
      throw CaseError(end.where, entry_path("stage", i, "end"), fmt::format("{}", *end),
                      fmt::format("a time after {}, the end of the stage before", before),
                      "end counts from the start of the run.");
    }
    before = *end;
  }
}

template <class Is>
bool are_all_schemes(const Case& given, const Is& is) {
  return is(given.scheme) &&
         std::all_of(given.stages.begin(), given.stages.end(), [&](const CaseStage& s) { return is(s.scheme); });
}

/// True when all stages enforce contact by springs alone.
bool is_all_penalty(const Case& given) {
  return are_all_schemes(given, [](const CaseScheme& s) { return **s.enforcement == EnforcementKind::penalty; });
}

/// Points of a smooth surface press by springs, in the place of nodes from both sides.
void check_smoothing(const Case& given) {
  const bool is_penalty = is_all_penalty(given);
  for (std::size_t i = 0; i < given.contacts.size(); ++i) {
    const CaseSurfaces* surfaces = given.contacts[i].surfaces();
    if (surfaces == nullptr || !surfaces->smooth || !**surfaces->smooth) continue;
    if (is_penalty && (!surfaces->method || smooths(**surfaces->method))) continue;
    throw CaseError(
        surfaces->smooth->where, entry_path("contact", i, "smooth"),
        is_penalty ? "true with a method that has no rows of both sides"
                   : "true with an enforcement that is not penalty",
        "smooth = true with method = \"two_pass\" or \"faces\", and enforcement = \"penalty\" in every stage",
        "Remove smooth, or take two_pass with penalty; other contact sees the facets themselves.");
  }
}

/// What the contacts cannot do with the scheme of a stage.
void check_scheme(const Case& given, const CaseScheme& scheme) {
  const EnforcementKind enforcement = **scheme.enforcement;
  if (!given.equations.empty() && **scheme.mass == CaseScheme::Mass::modified)
    throw CaseError(given.equations.front().where, entry_path("equation", 0, "terms"),
                    "an equation, with mass = \"modified\"", "a scheme whose nodes keep their mass",
                    "What an equation couples moves by its inertia: take another mass, or another scheme than "
                    "modified_mass.");
  for (std::size_t i = 0; i < given.rigid_parts.size(); ++i)
    check_guide(given.rigid_parts[i].guide, scheme, fmt::format("rigid_body[{}]", i));
  for (std::size_t i = 0; i < given.contacts.size(); ++i) {
    const CaseContact& contact = given.contacts[i];
    const ContactPlace at{contact, fmt::format("contact[{}]", i)};
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.check_scheme(scheme, at); }) kind.check_scheme(scheme, at);
        },
        contact.of);
    const CaseContactLaw* law = contact.law();
    if (law != nullptr && law->friction_law && !given.erosion.empty())
      throw CaseError(law->friction_law->where, entry_path("contact", i, "friction_law"),
                      "a law of friction beside [[erosion]]", "friction, a number",
                      "Where cells go, what pressed on their faces has no faces any more.");
    if (law != nullptr && *law->restitution > 0.0 && enforcement != EnforcementKind::impulse) {
      throw CaseError(law->restitution.where, entry_path("contact", i, "restitution"),
                      fmt::format("{} with enforcement = \"{}\"", *law->restitution, name(enforcement)),
                      "enforcement = \"impulse\" with a restitution",
                      "Deformable bodies rebound by their own waves; remove restitution, or take moreau_jean, "
                      "nonsmooth_generalized_alpha or central_differences.");
    }
  }
}

/// Surfaces in contact with themselves have forces between their parts: "<contact>.<second>_on_<first>".
Names places_between_parts(const Case& given) {
  Names places;
  for (const CaseContact& contact : given.contacts) {
    if (contact.surfaces() == nullptr || !contact.surfaces()->is_self) continue;
    for (std::size_t second = 0; second < given.parts.size(); ++second) {
      for (std::size_t first = 0; first < second; ++first)
        places.push_back(
            fmt::format("{}.{}_on_{}", *contact.name, *given.parts[second].name, *given.parts[first].name));
    }
  }
  return places;
}

void check_places(const Case& given, CaseErrors& errors) {
  Names places = names_of(given.probes);
  for (const Names& more : {names_of(given.contacts), places_between_parts(given)})
    places.insert(places.end(), more.begin(), more.end());
  for (std::size_t i = 0; i < given.checks.size(); ++i)
    if (const auto& place = given.checks[i].place)
      check_known(*place, places, entry_path("check", i, "place"), "the name of a [[probe]] or [[contact]]", errors);
}

/// Those of the table, and the variables that the laws of the case remember.
void check_quantities(const Case& given, const Names& parts, CaseErrors& errors) {
  Names fields, probed, of_parts;
  for (const Quantity& q : quantities()) {
    if (is_field(q)) fields.emplace_back(q.name);
    if (is_probed(q)) (q.place == Place::part ? of_parts : probed).emplace_back(q.name);
  }
  for (const CaseMaterial& material : given.materials)
    for (Names* names : {&fields, &probed}) {
      if (const Law* law = material.row()) names->insert(names->end(), law->history.begin(), law->history.end());
      if (material.row() == nullptr && !errors.empty()) names->emplace_back();  // what it remembers is not known
    }
  for (std::size_t i = 0; i < given.output.fields.size(); ++i)
    check_known(given.output.fields[i], fields, fmt::format("output.fields[{}]", i),
                "a field, or a variable that points remember", errors);
  for (std::size_t i = 0; i < given.probes.size(); ++i) {
    const CaseProbe& probe = given.probes[i];
    for (std::size_t k = 0; k < probe.quantities.size(); ++k)
      if (find_quantity(*probe.quantities[k]) == nullptr)  // else check_probe has said whether it is one of a part
        check_known(probe.quantities[k], probe.part ? of_parts : probed,
                    fmt::format("{}[{}]", entry_path("probe", i, "quantities"), k),
                    probe.part ? "a quantity of parts" : "a quantity, or a variable that points remember", errors);
    if (probe.part) check_known(*probe.part, parts, entry_path("probe", i, "part"), "the name of a [[part]]", errors);
  }
}

void check_check(const Case& given, std::size_t i) {
  const CaseCheck& check = given.checks[i];
  if (check.time && **check.time > end_of_run(given)) {
    throw CaseError(check.time->where, entry_path("check", i, "time"), fmt::format("{}", **check.time),
                    fmt::format("a time of at most {}, the end of the run", end_of_run(given)));
  }
  if (check.exact && !given.exact) {
    throw CaseError(check.where, entry_path("check", i, "reference"), "\"exact\" without a section [exact]",
                    "a section [exact] that says which solution", "Add [exact], or give value instead of reference.");
  }
}

/// The displacements are those of the state.
void check_initial_state(const Case& given) {
  for (std::size_t i = 0; given.initial_state && i < given.initial.size(); ++i) {
    if (!given.initial[i].displacement) continue;
    throw CaseError(given.initial[i].where, entry_path("initial", i, "displacement"),
                    "a displacement beside [initial_state]", "velocities alone, which replace those of the state",
                    "Leave it out, or begin without [initial_state].");
  }
}

}  // namespace

void check_names(const Case& given, CaseErrors& errors) {
  check_unique_names(given, errors);
  const Names materials = names_of(given.materials);
  for (std::size_t i = 0; i < given.parts.size(); ++i) {
    check_known(given.parts[i].material, materials, entry_path("part", i, "material"), "the name of a [materials.NAME]",
                errors);
  }
  const Names parts = names_of(given.parts);
  const auto check_initial = [&](const std::vector<CaseInitial>& list, const std::string& path) {
    for (std::size_t i = 0; i < list.size(); ++i)
      if (list[i].part)
        check_known(*list[i].part, parts, entry_path(path.c_str(), i, "part"), "the name of a [[part]]", errors);
  };
  for (std::size_t i = 0; i < given.erosion.size(); ++i)
    check_known(given.erosion[i].part, parts, entry_path("erosion", i, "part"), "the name of a [[part]]", errors);
  check_quantities(given, parts, errors);
  for (std::size_t i = 0; i < given.rigid_parts.size(); ++i)
    for (const Located<std::string>& part : given.rigid_parts[i].parts)
      check_known(part, parts, entry_path("rigid_body", i, "parts"), "names of [[part]]s", errors);
  check_initial(given.initial, "initial");
  for (std::size_t i = 0; i < given.stages.size(); ++i)
    check_initial(given.stages[i].initial, entry_path("stage", i, "initial"));
  check_functions(given, errors);
  check_places(given, errors);
}

void check_references(const Case& given, CaseErrors& errors) {
  errors.attempt([&] { check_initial_state(given); });
  errors.attempt([&] { check_stages(given); });
  errors.attempt([&] { check_smoothing(given); });
  errors.attempt([&] { check_scheme(given, given.scheme); });
  for (const CaseStage& stage : given.stages) errors.attempt([&] { check_scheme(given, stage.scheme); });
  for (std::size_t i = 0; i < given.checks.size(); ++i) errors.attempt([&] { check_check(given, i); });
}

void choose_enforcement(Case& given) {
  const auto is_open = [](const CaseScheme& scheme) {
    return !has_inertia(*scheme.kind) && scheme.is_enforcement_chosen;
  };
  const auto needs_springs = [](const CaseContact& contact) {
    const CaseSurfaces* surfaces = contact.surfaces();
    return contact.springs() == nullptr || contact.springs()->stiffness.has_value() ||
           (surfaces != nullptr && surfaces->smooth && **surfaces->smooth);
  };
  if (given.contacts.empty() || std::any_of(given.contacts.begin(), given.contacts.end(), needs_springs)) return;
  const auto has_springs = [&](const CaseScheme& scheme) {
    return !is_open(scheme) && **scheme.enforcement == EnforcementKind::penalty;
  };
  if (!are_all_schemes(given, std::not_fn(has_springs))) return;
  const auto choose = [&](CaseScheme& scheme) {
    if (!is_open(scheme)) return;
    scheme.enforcement->value = EnforcementKind::augmented_lagrangian;
    scheme.penetration = default_penetration;
  };
  choose(given.scheme);
  for (CaseStage& stage : given.stages) choose(stage.scheme);
}

void find_falls(Case& given) {
  Vec3 gravity{};
  for (const CaseLoad& load : given.loads)
    if (load.kind == CaseLoad::Kind::gravity) gravity = add(gravity, load.vector);
  const double g = norm(gravity);
  const auto find = [&](std::vector<CaseInitial>& list, const std::string& path) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!list[i].drop_height) continue;
      const double height = **list[i].drop_height;
      const double earth = standard_gravity / si_factor(Dimension::acceleration, given.units);
      if (!(g > 0.0))
        throw CaseError(list[i].drop_height->where, entry_path(path.c_str(), i, "drop_height"),
                        "a fall without gravity",
                        fmt::format("[[load]] gravity = [0.0, 0.0, {:.6g}] or the like", -earth),
                        fmt::format("Or give velocity = [0.0, 0.0, {:.6g}] instead of the height.",
                                    -std::sqrt(2.0 * earth * height)));
      list[i].fall = scaled(gravity, std::sqrt(2.0 * height / g));
    }
  };
  find(given.initial, "initial");
  for (std::size_t i = 0; i < given.stages.size(); ++i)
    find(given.stages[i].initial, entry_path("stage", i, "initial"));
}

void choose_weights(Case& given) {
  const CaseScheme* next = nullptr;
  const auto choose = [&](CaseScheme& scheme) {
    if (has_inertia(*scheme.kind)) next = &scheme;
    if (!scheme.is_mass_chosen || has_inertia(*scheme.kind) || next == nullptr) return;
    scheme.mass->value = **next->mass;
    scheme.redistribution = next->redistribution;
    scheme.layers = next->layers;
  };
  for (std::size_t i = given.stages.size(); i-- > 0;) choose(given.stages[i].scheme);
  choose(given.scheme);
}

void choose_methods(Case& given) {
  for (CaseContact& contact : given.contacts) {
    CaseSurfaces* surfaces = contact.surfaces();
    if (surfaces == nullptr) continue;
    const bool is_smooth = surfaces->smooth && **surfaces->smooth;
    if (!surfaces->method) {
      const PairMethod method = is_smooth ? PairMethod::two_pass : PairMethod::faces;
      surfaces->method = Located<PairMethod>{method, contact.where};
    }
    if (!surfaces->smooth && !(smooths(**surfaces->method) && is_all_penalty(given)))
      surfaces->smooth = Located<bool>{false, contact.where};
  }
}

}  // namespace carom
