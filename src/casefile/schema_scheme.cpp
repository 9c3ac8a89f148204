#include <fmt/format.h>

#include <algorithm>

#include "casefile/case_schema.hpp"
#include "casefile/section_rules.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;
using Names = std::vector<std::string>;

template <class Condition>
Names schemes_with(const Condition& condition) {
  Names names;
  for (const SchemeTraits& scheme : scheme_table) {
    if (condition(scheme)) names.emplace_back(scheme.name);
  }
  for (const SchemeAlias& alias : scheme_aliases) {
    if (condition(traits(alias.kind))) names.emplace_back(alias.name);
  }
  return names;
}

Names all_schemes() {
  return schemes_with([](const SchemeTraits&) { return true; });
}
Names implicit_schemes() {
  return schemes_with([](const SchemeTraits& s) { return !is_explicit(s.kind); });
}
Names implicit_dynamics() {
  return schemes_with([](const SchemeTraits& s) { return !is_explicit(s.kind) && s.has_inertia; });
}
Names explicit_schemes() {
  return schemes_with([](const SchemeTraits& s) { return is_explicit(s.kind); });
}

Names schemes_of_lumped_mass() {
  return schemes_with([](const SchemeTraits& s) { return is_explicit(s.kind) && !s.has_massless_contact; });
}

/// `kind`, which brings the parameters of the scheme with it.
template <class S, class Access>
void add_kind(SectionSchema<S>& s, Access scheme_of) {
  std::string doc = "Time scheme.";
  for (const SchemeAlias& alias : scheme_aliases)
    doc +=
        fmt::format(" {}: {} with enforcement = \"{}\".", alias.name, traits(alias.kind).name, name(alias.enforcement));
  const KeyDescription key{"kind", Shape::text, doc, {.choices = all_schemes(), .need = Need::required}, {}, {}};
  typename SectionSchema<S>::Handlers handlers;
  handlers.read = [key, scheme_of](S& section, const Node& node, const ReadContext& at) {
    CaseScheme& scheme = scheme_of(section);
    const std::size_t choice = decode_choice(node, key, at);
    scheme.kind = Located<SchemeKind>{static_cast<SchemeKind>(choice), node.where};
    if (choice >= scheme_count) {
      const SchemeAlias& alias = scheme_aliases[choice - scheme_count];
      scheme.kind.value = alias.kind;
      scheme.enforcement = Located<EnforcementKind>{alias.enforcement, node.where};
    }
    scheme.parameters = traits(*scheme.kind).parameters;
  };
  handlers.write = [key, scheme_of](const S& section, const Node&) {
    return encode(scheme_of(section).kind, key.options);
  };
  s.add(key, handlers);
}

template <class S, class Access>
void add_number(SectionSchema<S>& s, Access scheme_of, const SchemeNumber& number) {
  KeyDescription key{std::string(number.key), Shape::number, std::string(number.meaning), {}, {}, {}};
  key.options.range = range_of(number.range);
  for (const SchemeTraits& scheme : scheme_table) {
    const std::optional<double> initial = number.value(scheme.parameters);
    if (!initial) continue;
    key.options.kinds.emplace_back(scheme.name);
    key.default_value = Node{*initial, {}};
  }
  typename SectionSchema<S>::Handlers handlers;
  handlers.read = [key, number, scheme_of](S& section, const Node& node, const ReadContext& at) {
    decode(node, key, at, *number.in(scheme_of(section).parameters));
  };
  handlers.write = [number, scheme_of](const S& section, const Node&) -> std::optional<Node> {
    return Node{*number.value(scheme_of(section).parameters), {}};
  };
  s.add(key, handlers);
}

/// The keys of a scheme, in [scheme] and in [[stage]]; scheme_of(section) is the CaseScheme.
template <class S, class Access>
void add_scheme_keys(SectionSchema<S>& s, Access scheme_of) {
  s.description.selector = "kind";
  add_kind(s, scheme_of);
  s.key_by("enforcement", [scheme_of](auto& section) -> auto& { return scheme_of(section).enforcement; },
           "How contact is enforced; the table of the manual says which scheme takes which. plain: multipliers as "
           "published, which throw back what lagrange stops.",
           {.choices = Names(enforcement_names.begin(), enforcement_names.end()),
            .default_phrase =
                "the first that the scheme takes; of statics, where no stage takes springs and no contact gives "
                "its stiffness or is a stop, augmented_lagrangian"});
  for (const SchemeNumber& number : scheme_numbers) add_number(s, scheme_of, number);
  const auto augmented = [](const SchemeTraits& t) { return takes(t.kind, EnforcementKind::augmented_lagrangian); };
  s.key_by("penetration", [scheme_of](auto& section) -> auto& { return scheme_of(section).penetration; },
           "With enforcement = \"augmented_lagrangian\": largest penetration, relative to the smallest cell.",
           {.range = greater_than(0.0), .kinds = schemes_with(augmented), .default_phrase = "1e-3"});
  s.key_by(
      "mass", [scheme_of](auto& section) -> auto& { return scheme_of(section).mass; },
      "Mass matrix; modified: no inertia on contact nodes (of pairs: of the faces that look at the other side at the "
      "start), theirs given to their neighbours.",
      {.choices = {"consistent", "lumped", "modified"},
       .default_phrase = "implicit: consistent; explicit: lumped; modified_mass: modified; statics, which has only its "
                         "weight: that of the next stage with inertia"});
  s.key_by("layers", [scheme_of](auto& section) -> auto& { return scheme_of(section).layers; },
           "With a modified mass: layers of nodes that take the mass of the contact nodes.",
           {.range = at_least(1.0), .default_phrase = "4"});
  s.key_by("redistribution", [scheme_of](auto& section) -> auto& { return scheme_of(section).redistribution; },
           "With a modified mass: evenly over the layers, or by least squares over the body, centre and inertia kept.",
           {.choices = {"layers", "least_squares"}, .default_phrase = "layers"});
  s.key_by("mass_scaling_step", [scheme_of](auto& section) -> auto& { return scheme_of(section).mass_scaling_step; },
           "Cells whose own stable step is below this become as heavy as it takes; with a lumped mass.",
           {.unit = Dimension::time,
            .range = greater_than(0.0),
            .kinds = schemes_of_lumped_mass(),
            .default_phrase = "no mass is added"});
  s.key_by("mass_scaling_limit", [scheme_of](auto& section) -> auto& { return scheme_of(section).mass_scaling_limit; },
           "Largest mass that may be added, as a fraction of the total mass.",
           {.range = greater_than(0.0),
            .kinds = schemes_of_lumped_mass(),
            .default_phrase = "0.05, beside mass_scaling_step"});
}

[[noreturn]] void refuse_enforcement(const CaseScheme& scheme, const ReadContext& at) {
  const SchemeTraits& line = traits(*scheme.kind);
  Names taken;
  for (std::size_t e = 0; e < enforcement_count; ++e) {
    if (line.takes[e]) taken.emplace_back(enforcement_names[e]);
  }
  throw CaseError(scheme.enforcement->where, at.at("enforcement").path,
                  fmt::format("\"{}\" with the scheme {}", name(**scheme.enforcement), line.name),
                  fmt::format("{}{}, since {}", taken.size() > 1 ? "one of " : "", quoted_list(taken), line.why_not),
                  "Choose another enforcement or another scheme; docs/compatibility.md has the whole table.");
}

/// An enforcement beside a name that stands for another one.
void check_alias(const CaseScheme& scheme, const Node& node, const ReadContext& at) {
  const std::string& given = std::get<std::string>(find(node, "kind")->value);
  for (const SchemeAlias& alias : scheme_aliases) {
    if (alias.name != given || alias.enforcement == **scheme.enforcement) continue;
    throw CaseError(
        scheme.enforcement->where, at.at("enforcement").path,
        fmt::format("\"{}\" with the scheme {}", name(**scheme.enforcement), alias.name),
        fmt::format("\"{}\", which this name of {} stands for", name(alias.enforcement), traits(alias.kind).name),
        fmt::format("Leave enforcement out, or choose kind = \"{}\".", traits(alias.kind).name));
  }
}

void check_mass(CaseScheme& scheme, const Node& node, const ReadContext& at) {
  using Mass = CaseScheme::Mass;
  const bool must_be_modified = has_massless_contact(*scheme.kind);
  if (!scheme.mass) {
    const Mass usual = must_be_modified ? Mass::modified : is_explicit(*scheme.kind) ? Mass::lumped : Mass::consistent;
    scheme.mass = Located<Mass>{usual, scheme.where};
    scheme.is_mass_chosen = true;
  }
  const bool is_modified = **scheme.mass == Mass::modified;
  const bool is_weight_alone = !has_inertia(*scheme.kind);
  const bool may_be_modified = must_be_modified || is_weight_alone ||
                               (!is_explicit(*scheme.kind) && **scheme.enforcement == EnforcementKind::lagrange &&
                                *scheme.kind != SchemeKind::contact_stabilized_newmark);
  if (is_modified && !may_be_modified) {
    throw CaseError(scheme.mass->where, at.at("mass").path,
                    fmt::format("\"modified\" with scheme {} and enforcement {}", traits(*scheme.kind).name,
                                name(**scheme.enforcement)),
                    "modified_mass, statics, or newmark, hht, wbz, generalized_alpha or bathe with enforcement = "
                    "\"lagrange\"");
  }
  if (!is_modified && must_be_modified) {
    throw CaseError(scheme.mass->where, at.at("mass").path, "another mass than \"modified\"",
                    "\"modified\", on which the scheme modified_mass is built", "Leave mass out.");
  }
  if (is_modified) {
    using Redistribution = CaseScheme::Redistribution;
    if (!scheme.redistribution) scheme.redistribution = Redistribution::layers;
    if (!scheme.layers && *scheme.redistribution == Redistribution::layers) scheme.layers = 4;
  }
  for (const char* key : {"layers", "redistribution"}) {
    const Node* given = find(node, key);
    if (given == nullptr || is_modified) continue;
    throw CaseError(given->where, at.at(key).path, "a key of the modified mass", "it only beside mass = \"modified\"",
                    fmt::format("Remove {}, or choose mass = \"modified\".", key));
  }
  if (scheme.layers && *scheme.redistribution == CaseScheme::Redistribution::least_squares) {
    throw CaseError(find(node, "layers")->where, at.at("layers").path,
                    "layers beside redistribution = \"least_squares\"", "one of the two", "Remove layers.");
  }
}

void check_mass_scaling(CaseScheme& scheme, const Node& node, const ReadContext& at) {
  const Node* limit = find(node, "mass_scaling_limit");
  if (limit != nullptr && !scheme.mass_scaling_step) {
    throw CaseError(limit->where, at.at("mass_scaling_limit").path, "a limit of mass scaling without a step",
                    "it only beside mass_scaling_step", "Add mass_scaling_step, or remove the limit.");
  }
  if (!scheme.mass_scaling_step) return;
  if (**scheme.mass != CaseScheme::Mass::lumped) {
    throw CaseError(scheme.mass_scaling_step->where, at.at("mass_scaling_step").path,
                    "mass scaling with another mass than \"lumped\"", "mass = \"lumped\"",
                    "Remove mass_scaling_step, or take a scheme with a lumped mass.");
  }
  if (!scheme.mass_scaling_limit) scheme.mass_scaling_limit = 0.05;
}

void check_alpha(const CaseScheme& scheme, const Node& node, const ReadContext& at) {
  if (*scheme.kind != SchemeKind::hht) return;
  const double alpha = std::get<AlphaParameters>(scheme.parameters).alpha;
  if (alpha >= least_alpha_of_hht) return;
  throw CaseError(find(node, "alpha")->where, at.at("alpha").path, fmt::format("{:g} with scheme hht", alpha),
                  "a number >= -1/3 and <= 0", "Below, HHT dissipates less again: choose -1/3, or scheme wbz.");
}

void finish_scheme(CaseScheme& scheme, const Node& node, const ReadContext& at) {
  const Node* penetration = find(node, "penetration");
  if (!scheme.enforcement) {
    const bool is_augmented = !has_inertia(*scheme.kind) && penetration != nullptr;
    scheme.is_enforcement_chosen = !is_augmented;
    scheme.enforcement = Located<EnforcementKind>{
        is_augmented ? EnforcementKind::augmented_lagrangian : default_enforcement(*scheme.kind), scheme.where};
  }
  if (!takes(*scheme.kind, **scheme.enforcement)) refuse_enforcement(scheme, at);
  check_alias(scheme, node, at);
  const bool is_augmented = **scheme.enforcement == EnforcementKind::augmented_lagrangian;
  if (is_augmented && !scheme.penetration) scheme.penetration = default_penetration;
  if (penetration != nullptr && !is_augmented) {
    throw CaseError(penetration->where, at.at("penetration").path, "a key of the augmented Lagrangian",
                    "it only beside enforcement = \"augmented_lagrangian\"", "Remove it.");
  }
  check_mass(scheme, node, at);
  check_mass_scaling(scheme, node, at);
  check_alpha(scheme, node, at);
}

/// `safety` is written only where it acts: beside no step.
template <class S, class Access>
void add_safety(SectionSchema<S>& s, Access time_of) {
  const KeyDescription key{
      "safety",
      Shape::number,
      "Fraction of the stable step; not beside `step`.",
      {.range = {Bound{0.0, Bound::Side::open}, Bound{1.0, Bound::Side::closed}}, .kinds = explicit_schemes()},
      Node{CaseTime{}.safety, {}},
      {}};
  typename SectionSchema<S>::Handlers handlers;
  handlers.read = [key, time_of](S& section, const Node& node, const ReadContext& at) {
    decode(node, key, at, time_of(section).safety);
  };
  handlers.write = [time_of](const S& section, const Node&) -> std::optional<Node> {
    if (time_of(section).step) return std::nullopt;
    return Node{time_of(section).safety, {}};
  };
  s.add(key, handlers);
}

template <class S, class Access>
void add_time_keys(SectionSchema<S>& s, Access time_of, const std::string& end_doc) {
  s.key_by("end", [time_of](auto& section) -> auto& { return time_of(section).end; }, end_doc,
           {.unit = Dimension::time, .range = greater_than(0.0), .need = Need::required, .aliases = {"duration"}});
  s.key_by(
      "step", [time_of](auto& section) -> auto& { return time_of(section).step; },
      "Time step. To begin with, a hundredth of the time that an impact takes; `carom check` says what it is in Courant "
      "numbers.",
      {.unit = Dimension::time,
       .range = greater_than(0.0),
       .required_for = implicit_schemes(),
       .aliases = {"dt"},
       .default_phrase = "implicit schemes: required; explicit ones: from the stable step"});
  s.key_by(
      "fixed", [time_of](auto& section) -> auto& { return time_of(section).fixed; },
      "Never shorten the step, neither where contact springs make energy nor where a step fails, which ends the run.",
      {.kinds = implicit_schemes()});
  s.key_by(
      "event_tolerance", [time_of](auto& section) -> auto& { return time_of(section).event_tolerance; },
      "A step in which contact closes is made again so that it ends at the touch, to this fraction of the step; the "
      "steps after it start as small and grow. Not beside fixed = true.",
      {.range = {Bound{0.0, Bound::Side::open}, Bound{1.0, Bound::Side::open}},
       .kinds = implicit_dynamics(),
       .default_phrase = "contact does not cut steps"});
  add_safety(s, time_of);
}

void finish_time(CaseTime& time, const Node& node, const ReadContext& at) {
  const Node* safety = find(node, "safety");
  if (time.step && safety != nullptr) {
    throw CaseError(safety->where, at.at("safety").path, "a fraction of the stable step beside a step",
                    "step or safety", "Leave out step to have it chosen.");
  }
  if (time.fixed && time.event_tolerance) {
    throw CaseError(find(node, "event_tolerance")->where, at.at("event_tolerance").path,
                    "a tolerance for contact events beside fixed = true", "one of the two",
                    "A fixed step cannot end where contact closes: remove fixed or event_tolerance.");
  }
  if (time.step && **time.step > *time.end) {
    throw CaseError(time.step->where, at.at("step").path, toml_number(**time.step),
                    "a step of at most time.end = " + toml_number(*time.end));
  }
}

}  // namespace

SectionSchema<CaseScheme> scheme_section() {
  SectionSchema<CaseScheme> s("Time integration and the enforcement of contact.");
  add_scheme_keys(
      s, [](auto& scheme) -> auto& { return scheme; });
  s.finish = finish_scheme;
  return s;
}

SectionSchema<CaseTime> time_section() {
  SectionSchema<CaseTime> s("Duration and time step.");
  s.description.selector = "scheme.kind";
  add_time_keys(
      s, [](auto& time) -> auto& { return time; }, "The run goes from 0 to here.");
  s.finish = finish_time;
  return s;
}

SectionSchema<CaseStage> stage_section() {
  SectionSchema<CaseStage> s(
      "What follows [scheme] and [time], in the order of the file: the state goes on with another scheme.");
  add_scheme_keys(
      s, [](auto& stage) -> auto& { return stage.scheme; });
  add_time_keys(
      s, [](auto& stage) -> auto& { return stage.time; }, "The stage goes from the end of the one before to here.");
  s.tables("initial", &CaseStage::initial, stage_initial_section());
  s.finish = [](CaseStage& stage, const Node& node, const ReadContext& at) {
    stage.scheme.where = stage.time.where = stage.where;
    if (!has_inertia(*stage.scheme.kind) && !stage.initial.empty())
      throw CaseError(stage.initial.front().where, at.at("initial").path, "a velocity in statics",
                      "velocities in stages with inertia", "Give it to the stage after this one.");
    finish_scheme(stage.scheme, node, at);
    finish_time(stage.time, node, at);
  };
  return s;
}

SectionSchema<CaseSolver> solver_section() {
  SectionSchema<CaseSolver> s("Solvers of implicit steps.");
  s.description.selector = "scheme.kind";
  s.key("kind", &CaseSolver::kind,
        "Linear solver: conjugate gradients, preconditioned by the diagonal or by a multigrid cycle; CHOLMOD for "
        "positive definite operators, MUMPS from the first on that is not; MUMPS from the start; or chosen from the "
        "estimated conditioning and the size.",
        {.choices = {"auto", "cg", "multigrid", "cholmod", "mumps"}, .kinds = implicit_schemes()});
  s.key("max_contact_iterations", &CaseSolver::max_contact_iterations,
        "A step whose contact state needs more iterations has failed.",
        {.range = at_least(1.0), .kinds = implicit_schemes()});
  return s;
}

}  // namespace carom
