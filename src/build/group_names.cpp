#include "build/group_names.hpp"

#include "build/attached.hpp"
#include "build/groups.hpp"

namespace carom {

namespace {

class Names {
 public:
  Names(const Mesh& mesh, CaseErrors& errors) : groups_(mesh), errors_(errors) {}

  void check(const Located<std::string>& name, const std::string& key) {
    if (!name->empty()) errors_.attempt([&] { groups_.look_up(name, key); });
  }
  void check(const std::optional<Located<std::string>>& name, const std::string& key) {
    if (name) check(*name, key);
  }

 private:
  Groups groups_;
  CaseErrors& errors_;
};

void check_contact(const CaseContact& contact, Names& names) {
  names.check(contact.group(), "contact.group");
  if (const Located<std::string>* master = contact.master()) names.check(*master, "contact.master");
  if (const auto* rigid = std::get_if<CaseRigidSurface>(&contact.of)) names.check(rigid->surface, "contact.surface");
  if (const auto* all = std::get_if<CaseAll>(&contact.of))
    for (const Located<std::string>& group : all->exclude) names.check(group, "contact.exclude");
}

}  // namespace

void check_group_names(const Case& given, const Mesh& mesh, CaseErrors& errors) {
  Names names(mesh, errors);
  for (const CasePart& part : given.parts) names.check(part.cells, "part.cells");
  for (const CaseSupport& support : given.supports) names.check(support.nodes, "support.nodes");
  for (const AttachedGroup& attached : attached_groups(given)) names.check(attached.group, attached.key);
  for (const CaseEquation& equation : given.equations)
    for (const CaseEquation::Term& term : equation.terms) names.check(term.nodes, "equation.terms.nodes");
  for (const CaseLoad& load : given.loads) names.check(load.group, "load.group");
  for (const CaseInitial& initial : given.initial) names.check(initial.nodes, "initial.nodes");
  for (const CaseStage& stage : given.stages)
    for (const CaseInitial& initial : stage.initial) names.check(initial.nodes, "initial.nodes");
  for (const CaseContact& contact : given.contacts) check_contact(contact, names);
  for (const CaseProbe& probe : given.probes) names.check(probe.group, "probe.group");
}

}  // namespace carom
