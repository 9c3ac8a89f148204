#include "casefile/case_schema.hpp"

namespace carom {

namespace {

using Need = KeyOptions::Need;

/// displacement = { x = ..., y = ..., z = ..., function = "..." }
struct MotionTable {
  Location where;
  std::array<std::optional<Located<double>>, 3> amplitude;
  std::optional<Located<std::string>> function;
};

SectionSchema<MotionTable> motion_section(const std::string& what, Dimension unit) {
  SectionSchema<MotionTable> s("Prescribed " + what + " of single components: amplitude times function.");
  for (std::size_t c = 0; c < 3; ++c) {
    s.key_by(kAxes[c], [c](auto& motion) -> auto& { return motion.amplitude[c]; }, "Amplitude along " + kAxes[c] + ".",
             {.unit = unit});
  }
  s.key("function", &MotionTable::function, "NAME of a [functions.NAME].", {.default_phrase = "constant 1"});
  s.description.alternatives = {{Alternatives::Count::at_least_one, kAxes}};
  return s;
}

void append_motions(const MotionTable& table, MotionKind kind, CaseSupport& support) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (!table.amplitude[c]) continue;
    support.motions.push_back({kind, static_cast<int>(c), *table.amplitude[c], table.function});
  }
}

std::optional<MotionTable> motions_of(const CaseSupport& support, MotionKind kind) {
  std::optional<MotionTable> table;
  for (const CaseSupport::Motion& motion : support.motions) {
    if (motion.kind != kind) continue;
    if (!table) table.emplace();
    table->amplitude.at(static_cast<std::size_t>(motion.component)) = motion.amplitude;
    table->function = motion.function;
  }
  return table;
}

void add_motion(SectionSchema<CaseSupport>& s, const std::string& key, MotionKind kind, Dimension unit) {
  const SectionSchema<MotionTable> motion = motion_section(key, unit);
  SectionSchema<CaseSupport>::Handlers handlers;
  handlers.read = [motion, kind](CaseSupport& support, const Node& node, const ReadContext& at) {
    MotionTable table;
    motion.read(table, node, at);
    append_motions(table, kind, support);
  };
  handlers.write = [motion, kind](const CaseSupport& support, const Node& root) -> std::optional<Node> {
    const std::optional<MotionTable> table = motions_of(support, kind);
    if (!table) return std::nullopt;
    return motion.write(*table, &root);
  };
  s.add({key,
         Shape::section,
         motion.description.doc,
         {},
         {},
         std::make_shared<const SectionDescription>(motion.description)},
        handlers);
}

/// A component may be imposed once only in a support.
void check_components(CaseSupport& support, const Node& node, const ReadContext& at) {
  std::array<std::string, 3> imposed;
  const auto impose = [&](std::size_t c, const std::string& by, const Location& where) {
    if (!imposed[c].empty()) {
      throw CaseError(where, at.at(by).path, "component " + kAxes[c] + " a second time (also in " + imposed[c] + ")",
                      "each component once in a support");
    }
    imposed[c] = by;
  };
  if (support.symmetry)
    impose(static_cast<std::size_t>((**support.symmetry)[0] - 'x'), "symmetry", support.symmetry->where);
  for (std::size_t c = 0; c < 3; ++c) {
    if (support.blocked[c]) impose(c, "blocked", find(node, "blocked")->where);
  }
  for (const CaseSupport::Motion& motion : support.motions) {
    impose(static_cast<std::size_t>(motion.component), name(motion.kind), motion.amplitude.where);
  }
}

}  // namespace

SectionSchema<CaseSupport> support_section() {
  SectionSchema<CaseSupport> s("What is imposed on a group of nodes.");
  s.key("nodes", &CaseSupport::nodes, "Group of nodes or cells, or \"all\".", {.need = Need::required});
  s.key("symmetry", &CaseSupport::symmetry,
        "Symmetry plane with this normal: blocks that component. Where bodies that touch end there, contact sees their "
        "images beyond it.",
        {.choices = kAxes});
  s.key("blocked", &CaseSupport::blocked, "Components that stay where they are.", {.choices = kAxes});
  add_motion(s, "displacement", MotionKind::displacement, Dimension::length);
  add_motion(s, "velocity", MotionKind::velocity, Dimension::velocity);
  add_motion(s, "acceleration", MotionKind::acceleration, Dimension::acceleration);
  s.description.alternatives = {
      {Alternatives::Count::at_least_one, {"symmetry", "blocked", "displacement", "velocity", "acceleration"}}};
  s.finish = check_components;
  return s;
}

}  // namespace carom
