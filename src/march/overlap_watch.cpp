#include "march/overlap_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

namespace carom {

namespace {

constexpr const char* no_contact = ", between which no contact is defined";

/// Has a part, which may have cells of several types, one of the nodes?
bool has_one_of(const Model& model, const std::string& name, const std::vector<bool>& known) {
  return std::any_of(model.parts.begin(), model.parts.end(), [&](const Part& part) {
    return part.name == name && std::any_of(part.cells.begin(), part.cells.end(), [&](Index c) {
             const std::span<const Index> nodes = model.mesh->block(part.type)->nodes(c);
             return std::any_of(nodes.begin(), nodes.end(),
                                [&](Index node) { return known[static_cast<std::size_t>(node)]; });
           });
  });
}

/// The first part of the node, which has one.
const Part& part_at(const Model& model, Index node) {
  const auto has_node = [&](const Part& part) {
    return std::any_of(part.cells.begin(), part.cells.end(), [&](Index cell) {
      const std::span<const Index> nodes = model.mesh->block(part.type)->nodes(cell);
      return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
    });
  };
  return *std::find_if(model.parts.begin(), model.parts.end(), has_node);
}

bool are_in_contact(const Model& model, const Part& a, const Part& b) {
  return std::any_of(model.contacts.begin(), model.contacts.end(), [&](const ContactDefinition& contact) {
    const ContactParts parts = parts_of(contact);
    if (parts.other == nullptr && parts.cells.empty()) return false;  // none between bodies
    std::vector<bool> known(model.mesh->node_count(), false);
    for (const Index n : nodes_of(parts, *model.mesh)) known[static_cast<std::size_t>(n)] = true;
    return has_one_of(model, a.name, known) && has_one_of(model, b.name, known);
  });
}

}  // namespace

OverlapWatch::OverlapWatch(const Simulation& simulation, const State& start)
    : simulation_(simulation),
      q_start_(simulation.model().erosion.empty() ? std::vector<double>() : start.q),
      overlap_(std::make_unique<BodyOverlap>(simulation.model(), start.q)),
      surfaces_(std::make_unique<SurfaceCrossings>(simulation.model(), start.q)),
      motion_(std::make_unique<SkinMotion>(surfaces_->skin())),
      next_(simulation.end() / 50.0),
      every_(simulation.end() / 50.0) {
  overlap_->each_at_start([&](Index node, double depth) { surfaces_->add_start(node, depth); });
  motion_->looked(start.q, true);
}

/// Looks at what is there where cells have gone, from there on.
void OverlapWatch::follow(const State& state) {
  topology_ = state.topology;
  overlap_ = std::make_unique<BodyOverlap>(model(), q_start_);
  surfaces_ = std::make_unique<SurfaceCrossings>(model(), q_start_);
  overlap_->each_at_start([&](Index node, double depth) { surfaces_->add_start(node, depth); });
  motion_ = std::make_unique<SkinMotion>(surfaces_->skin());
  look(state, Folds::seen);
}

void OverlapWatch::see(const StepView& view) {
  const State& state = view.state;
  if (view.step == 0) return;
  if (state.topology != topology_) follow(state);
  const bool is_regular = state.t >= next_ || view.is_last();
  const bool asks = is_regular || motion_->looks_next();
  if (asks) view.shared.complete_displacements(surfaces_->skin().nodes);
  look_if_due(view, is_regular);
  if (asks) view.shared.release();  // nodes of the skin lie in pages all over the body
}

void OverlapWatch::look_if_due(const StepView& view, bool is_regular) {
  const State& state = view.state;
  const LookDue due = motion_->due(simulation_.mesh().coordinates, state.q, view.iterations);
  const bool sees_folds = due == LookDue::folds || view.is_last() || (is_regular && motion_->may_see_folds());
  if (is_regular || due != LookDue::none) look(state, sees_folds ? Folds::seen : Folds::left_out);
  if (!is_regular) return;
  while (next_ <= state.t) next_ += every_;
  const Overlap now = overlap_->deepest(state.q);
  if (now.depth <= worst_.depth) return;
  worst_ = now;
  time_ = state.t;
}

/// For surfaces that cross.
void OverlapWatch::look(const State& state, Folds folds) {
  motion_->looked(state.q, folds == Folds::seen);
  const SurfaceCrossing now = surfaces_->deepest(state.q, folds);
  if (now.depth <= crossing_.depth) return;
  crossing_ = now;
  crossing_time_ = state.t;
}

/// The two that overlap, as they were before any cell went.
std::string OverlapWatch::names() const {
  const Model& model = simulation_.model();
  const Part& own = part_at(model, worst_.node);
  const std::string node = fmt::format("node {} of part \"{}\"", simulation_.mesh().node_label(worst_.node), own.name);
  if (worst_.contact >= 0) {
    const std::string& contact = std::visit([](const auto& c) -> const std::string& { return c.name; },
                                            model.contacts[static_cast<std::size_t>(worst_.contact)]);
    return fmt::format("{} inside of the obstacle of \"{}\"", node, contact);
  }
  const Part& other = *model.part_of(worst_.cell);
  return fmt::format("{} inside of part \"{}\"{}", node, other.name,
                     are_in_contact(model, own, other) ? "" : no_contact);
}

std::string OverlapWatch::crossing_names() const {
  const Model& model = simulation_.model();
  const Part &own = *model.part_of(crossing_.edge_cell), &other = *model.part_of(crossing_.cell);
  const std::string what = dimension(own.type) == 1 ? "a bar" : "an edge";
  const bool is_fold = own.name == other.name;
  const std::string who =
      is_fold ? fmt::format("{} of part \"{}\" goes through another face of it", what, own.name)
              : fmt::format("{} of part \"{}\" goes through a face of part \"{}\"", what, own.name, other.name);
  return who + (are_in_contact(model, own, other) ? "" : is_fold ? ", which no contact knows" : no_contact);
}

/// What helps where surfaces cross.
std::string OverlapWatch::remedy() const {
  const Model& model = simulation_.model();
  const bool is_known = are_in_contact(model, *model.part_of(crossing_.edge_cell), *model.part_of(crossing_.cell));
  return is_known ? ": shorter cells, a stiffer contact or another method of it" : ": define a contact there";
}

VerdictItem OverlapWatch::item() const {
  constexpr double limit = 0.25, named = 0.01;
  const bool is_crossing = crossing_.depth > worst_.depth;
  const double depth = is_crossing ? crossing_.depth : worst_.depth;
  const Vec3& place = is_crossing ? crossing_.position : worst_.position;
  std::string explanation =
      "how deep bodies are inside of each other, of a fold of their own or of an obstacle, in cells, more than at the "
      "start: nodes inside of cells, edges through faces";
  if (depth > named) {
    explanation += fmt::format(": {} at ({:.4g}, {:.4g}, {:.4g}), t = {:.4g}", is_crossing ? crossing_names() : names(),
                               place[0], place[1], place[2], is_crossing ? crossing_time_ : time_);
    if (is_crossing && depth > limit) explanation += remedy();
  }
  return {"overlap of bodies", depth, limit, depth <= limit, explanation};
}

}  // namespace carom
