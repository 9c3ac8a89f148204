#include "casefile/case_schema.hpp"

namespace carom {

namespace {

/// A key that also says what kind of load it is.
template <class Access>
void add_kind(SectionSchema<CaseLoad>& s, const KeyDescription& key, CaseLoad::Kind kind, Access access) {
  SectionSchema<CaseLoad>::Handlers handlers;
  handlers.read = [=](CaseLoad& load, const Node& node, const ReadContext& at) {
    decode(node, key, at, access(load));
    load.kind = kind;
  };
  handlers.write = [=](const CaseLoad& load, const Node&) -> std::optional<Node> {
    if (load.kind != kind) return std::nullopt;
    return encode(access(load), key.options);
  };
  s.add(key, handlers);
}

void check_group(CaseLoad& load, const Node& node, const ReadContext& at) {
  const bool gravity = load.kind == CaseLoad::Kind::gravity;
  if (load.group.has_value() != gravity) return;
  const std::string path = at.at("group").path;
  if (gravity) {
    throw CaseError(load.group->where, path, toml_string(**load.group), "no group", "Gravity acts on all parts.");
  }
  const bool pressure = load.kind == CaseLoad::Kind::pressure;
  throw CaseError(
      node.where, path, "nothing",
      pressure ? "the group of faces that the pressure acts on" : "the group of nodes that the force acts on");
}

}  // namespace

SectionSchema<CaseLoad> load_section() {
  const auto vector = [](auto& load) -> auto& {
    return load.vector;
  };
  const auto pressure = [](auto& load) -> auto& {
    return load.pressure;
  };
  SectionSchema<CaseLoad> s(
      "A load: a force on each node of a group or on all of it together, a pressure on faces, or gravity.");
  add_kind(s, {"force", Shape::vector, "Force on each node of the group.", {.unit = Dimension::force}, {}, {}},
           CaseLoad::Kind::force, vector);
  add_kind(
      s,
      {"total_force",
       Shape::vector,
       "Force on the group in all, which its nodes share: by their areas where it is a group of faces or of all nodes "
       "of faces (a uniform traction), else by the masses of the cells at them (of bars of one section: by lengths). "
       "Axisymmetric: over the whole circumference; x is what pushes outward, summed. `check` prints the sum.",
       {.unit = Dimension::force},
       {},
       {}},
      CaseLoad::Kind::total_force, vector);
  add_kind(s,
           {"pressure",
            Shape::number,
            "Pressure on the faces of the group; positive pushes against the face.",
            {.unit = Dimension::stress},
            {},
            {}},
           CaseLoad::Kind::pressure, pressure);
  add_kind(
      s,
      {"gravity", Shape::vector, "Acceleration of gravity, on all parts.", {.unit = Dimension::acceleration}, {}, {}},
      CaseLoad::Kind::gravity, vector);
  s.key("group", &CaseLoad::group, "Group of nodes (force), of faces (pressure), or of either (total_force).");
  s.key("function", &CaseLoad::function, "NAME of a [functions.NAME] that multiplies the load.",
        {.default_phrase = "constant 1"});
  s.description.alternatives = {{Alternatives::Count::exactly_one, {"force", "total_force", "pressure", "gravity"}}};
  s.finish = check_group;
  return s;
}

}  // namespace carom
