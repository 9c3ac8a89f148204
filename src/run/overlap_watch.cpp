#include "run/overlap_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace carom {

namespace {

/// Which nodes a contact knows.
struct MarkNodes {
  const Mesh& mesh;
  std::vector<bool>& known;

  void add(const Surface& surface) const {
    for (const Facet& facet : surface.facets)
      for (const Index n : facet) known[static_cast<std::size_t>(n)] = true;
  }
  void operator()(const PairContact& contact) const {
    add(contact.slave);
    add(contact.master);
  }
  void operator()(const TieContact& contact) const {
    add(contact.slave);
    add(contact.master);
  }
  void operator()(const InterfaceContact& contact) const {
    const CellBlock& block = *mesh.block(CellType::hexa8);
    for (const Index c : contact.cells)
      for (std::size_t a = 0; a < 8; ++a)
        known[static_cast<std::size_t>(block.connectivity[8 * static_cast<std::size_t>(c) + a])] = true;
  }
  template <class Contact>
  void operator()(const Contact& /*contact*/) const {}
};

bool has_one_of(const Model& model, const Part& part, const std::vector<bool>& known) {
  const CellBlock& block = *model.mesh->block(part.type);
  const auto n = static_cast<std::size_t>(node_count(part.type));
  return std::any_of(part.cells.begin(), part.cells.end(), [&](Index c) {
    const auto* first = block.connectivity.data() + n * static_cast<std::size_t>(c);
    return std::any_of(first, first + n, [&](Index node) { return known[static_cast<std::size_t>(node)]; });
  });
}

bool are_in_contact(const Model& model, const Part& a, const Part& b) {
  return std::any_of(model.contacts.begin(), model.contacts.end(), [&](const ContactDefinition& contact) {
    std::vector<bool> known(model.mesh->node_count(), false);
    std::visit(MarkNodes{*model.mesh, known}, contact);
    return has_one_of(model, a, known) && has_one_of(model, b, known);
  });
}

}  // namespace

OverlapWatch::OverlapWatch(const Simulation& simulation, const State& start)
    : simulation_(simulation),
      overlap_(simulation.model(), start.q),
      next_(simulation.end() / 50.0),
      every_(simulation.end() / 50.0) {}

void OverlapWatch::see(const StepView& view) {
  const State& state = view.state;
  if (view.step == 0 || (state.t < next_ && !view.is_last())) return;
  while (next_ <= state.t) next_ += every_;
  const Overlap now = overlap_.deepest(state.q);
  if (now.depth <= worst_.depth) return;
  worst_ = now;
  time_ = state.t;
}

/// The two that overlap.
std::string OverlapWatch::names() const {
  const Model& model = simulation_.model();
  const auto part = [&](Index p) -> const Part& { return model.parts[static_cast<std::size_t>(p)]; };
  const Index own = overlap_.part_of(worst_.node);
  const std::string node = fmt::format(
      "node {} of part \"{}\"", simulation_.mesh().node_numbers[static_cast<std::size_t>(worst_.node)], part(own).name);
  if (worst_.contact >= 0) {
    const std::string& contact = std::visit([](const auto& c) -> const std::string& { return c.name; },
                                            model.contacts[static_cast<std::size_t>(worst_.contact)]);
    return fmt::format("{} inside of the obstacle of \"{}\"", node, contact);
  }
  const Index other = overlap_.part_of(worst_.cell);
  const bool is_known = are_in_contact(model, part(own), part(other));
  return fmt::format("{} inside of part \"{}\"{}", node, part(other).name,
                     is_known ? "" : ", between which no contact is defined");
}

VerdictItem OverlapWatch::item() const {
  constexpr double limit = 0.25;
  std::string explanation =
      "how deep nodes of a body's skin are inside of another body or obstacle, in cells, more than at the start";
  if (worst_.node >= 0 && worst_.depth > 0.01) {
    explanation += fmt::format(": {} at ({:.4g}, {:.4g}, {:.4g}), t = {:.4g}", names(), worst_.position[0],
                               worst_.position[1], worst_.position[2], time_);
  }
  return {"overlap of bodies", worst_.depth, limit, worst_.depth <= limit, explanation};
}

}  // namespace carom
