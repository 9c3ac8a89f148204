// *NODE PRINT and *NODE OUTPUT of a set as probes.
#include <fmt/format.h>

#include <map>
#include <set>
#include <vector>

#include "translate/rigid_body.hpp"
#include "translate/translation.hpp"
#include "translate/tree.hpp"

namespace carom {

namespace {

struct Asked {
  std::set<std::string> quantities;
  Location where;
};

/// U, V and A; the others are in other files of the results.
std::set<std::string> quantities_of(Translation& t, const DeckKeyword& keyword) {
  static const std::map<std::string, std::string> known{
      {"U", "displacement"}, {"V", "velocity"}, {"VELO", "velocity"}, {"A", "acceleration"}};
  std::set<std::string> asked;
  for (DeckCursor at(keyword); at.next_line();)
    while (!at.at_end()) {
      const std::string name = upper_case(at.field());
      const bool is_component = name.size() == 2 && name[1] >= '1' && name[1] <= '3';  // probes have all three
      const auto found = known.find(is_component ? name.substr(0, 1) : name);
      if (found != known.end())
        asked.insert(found->second);
      else if (!name.empty())
        t.findings.note(at.where(), name + ": no probe; see the fields and curves of the results");
    }
  return asked;
}

void write_probes(Translation& t, const std::string& group, const Asked& asked) {
  constexpr std::size_t most = 16;
  std::vector<Index> nodes = t.mesh.mesh.nodes_of(group);
  const std::size_t in_group = nodes.size();
  for (const DeckRigidBody& body : t.rigid_bodies) {
    if (!body.is_obstacle()) continue;
    const auto is_its = [&](Index n) { return n == body.reference || n == body.turning; };
    if (std::erase_if(nodes, is_its) > 0)
      t.findings.note(asked.where,
                      fmt::format("{}: no probe of the reference node of {}, a rigid surface; its motion is "
                                  "among the curves of its contacts",
                                  group, body.name));
  }
  if (nodes.empty() || (nodes.size() < in_group && nodes.size() > most)) return;
  const std::vector<std::string> quantities(asked.quantities.begin(), asked.quantities.end());
  const auto add = [&](TableMaker& probe) {
    t.append("probe", probe.add("quantities", texts_node(quantities, asked.where)).node());
  };
  if (in_group == 1 || nodes.size() > most) {
    TableMaker probe(asked.where);
    probe.text("name", group).text("group", group);
    if (nodes.size() > most) t.findings.note(asked.where, group + " has many nodes: one probe of their mean");
    add(probe);
    return;
  }
  for (const Index n : nodes) {
    const std::int64_t number = t.mesh.mesh.node_numbers[at(n)];
    TableMaker probe(asked.where);
    probe.text("name", fmt::format("{}.{}", group, number)).add("node", {number, asked.where});
    add(probe);
  }
}

}  // namespace

void translate_probes(Translation& t) {
  std::map<std::string, Asked> asked;
  for (const Statement& s : t.statements.list) {
    const DeckKeyword& keyword = *s.keyword;
    if ((keyword.name != "NODE PRINT" && keyword.name != "NODE OUTPUT") || !keyword.has("NSET")) continue;
    t.errors.attempt([&] {
      const std::string key = key_of(t.mesh.names.node_sets, t.scope(s), *keyword.parameter("NSET"));
      if (key.empty()) keyword.fail("NSET=" + *keyword.parameter("NSET"), "the name of a node set");
      Asked& entry = asked[t.mesh.names.node_sets.at(key)];
      for (const std::string& quantity : quantities_of(t, keyword)) entry.quantities.insert(quantity);
      entry.where = keyword.where;
    });
  }
  for (const auto& [group, entry] : asked)
    if (!entry.quantities.empty()) write_probes(t, group, entry);
}

}  // namespace carom
