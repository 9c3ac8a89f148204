#include "contact/meeting_edges.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <numbers>
#include <span>

#include "contact/row_maker.hpp"
#include "model/bodies.hpp"
#include "model/outer_facets.hpp"
#include "surface/half_thickness.hpp"

namespace carom {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double turn_of_sharp = 5.0 * degree, no_notch = -5.0 * degree;  // sharp edges, and what they meet
constexpr double sharp_for_multipliers = 30.0 * degree;                   // both
constexpr double deepest_crossing = 0.75;                                 // of the facet size
// EdgeEnd::width where rows of overlaps hold corners, too: there pairs that fade in less bring blocks that are crushed
// at their wave speed deeper, 0.30 of a cell for 0.20.
constexpr double ending_beside_overlaps = 0.05;

EdgeRule rule_of(const PairContact& contact, bool is_eroded) {
  switch (contact.law.hold) {
    case RowHold::springs:
      if (!contact.law.eps_N) break;
      return {contact.method == PairMethod::faces ? PairFactor::moves : PairFactor::border, 0.0, is_eroded, 0.25, 0.25};
    case RowHold::impulses:
      return {PairFactor::stopped, 0.1, false, 1.0, 0.5};
    case RowHold::increments:
      return {PairFactor::stopped, 0.1, true, 1.0, 0.5};
    case RowHold::multipliers:
      break;
  }
  return {PairFactor::held, 0.5, true, 1.0, 0.5};
}

/// The least half thickness behind the facets of each node, at most `limit`.
std::map<Index, double> depths_by_node(const Model& model, const std::vector<Facet>& skin, double limit) {
  const std::vector<double> half = half_thickness(model.mesh->coordinates, skin, bodies_of_nodes(model), 2.0 * limit);
  std::map<Index, double> depths;
  for (std::size_t f = 0; f < skin.size(); ++f) {
    for (const Index n : skin[f]) {
      const auto [at, is_new] = depths.try_emplace(n, half[f]);
      if (!is_new) at->second = std::min(at->second, half[f]);
    }
  }
  return depths;
}

std::vector<FeatureEdge> edges_that(const std::vector<FeatureEdge>& edges, bool are_sharp) {
  std::vector<FeatureEdge> some;
  std::ranges::copy_if(edges, std::back_inserter(some),
                       [&](const FeatureEdge& edge) { return edge.is_sharp == are_sharp; });
  return some;
}

class Meetings {
 public:
  Meetings(const Model& model, const PairContact& contact, const SmoothSides* smooth)
      : model_(model), contact_(contact), smooth_(smooth), rule_(rule_of(contact, model.is_eroded)) {
    const std::span<const Vec3> X = model.mesh->coordinates;
    if (has_open_edges(contact.slave.facets) || has_open_edges(contact.master.facets)) beside_ = skin(model);
    size_ = std::max(mean_facet_size(X, contact.slave.facets), mean_facet_size(X, contact.master.facets));
  }
  std::vector<MeetingEdges> find() && {
    if (rule_.factor == PairFactor::held)
      find_sharp();
    else
      find_all();
    if (!found_.empty() && rule_.factor != PairFactor::held) find_depths();
    return std::move(found_);
  }

 private:
  /// Those that the surface is smooth across are not sharp.
  std::vector<FeatureEdge> edges_of(const Surface& surface, double least_turn) const {
    std::vector<FeatureEdge> edges = feature_edges(model_.mesh->coordinates, surface.facets, beside_, least_turn);
    const SmoothSurface* smooth = smooth_of(surface);
    for (FeatureEdge& edge : edges)
      edge.is_sharp = edge.turn > turn_of_sharp && (smooth == nullptr || !smooth->is_smooth_across(edge.node));
    return edges;
  }
  const SmoothSurface* smooth_of(const Surface& surface) const {
    if (smooth_ == nullptr) return nullptr;
    return (&surface == &contact_.slave ? smooth_->of_slave : smooth_->of_master).get();
  }
  void add(std::vector<FeatureEdge> first, std::vector<FeatureEdge> second, bool is_back = false) {
    if (first.empty() || second.empty()) return;
    found_.push_back({rule_, size_, contact_.self, is_back, std::move(first), std::move(second), {}, {}});
  }
  void find_sharp() {
    std::vector<FeatureEdge> first = edges_of(contact_.slave, sharp_for_multipliers);
    add(first, contact_.self ? first : edges_of(contact_.master, sharp_for_multipliers));
  }
  std::vector<FeatureEdge> edges_and_folds_of(const Surface& surface) const {
    std::vector<FeatureEdge> edges = edges_of(surface, no_notch);
    std::ranges::copy(fold_edges(model_.mesh->coordinates, surface.facets), std::back_inserter(edges));
    if (contact_.method != PairMethod::faces) return edges;
    for (FeatureEdge& edge : edges)
      for (EdgeEnd& end : edge.end)
        if (!end.goes_on) end.width = ending_beside_overlaps;
    return edges;
  }
  void find_all() {
    const std::vector<FeatureEdge> first = edges_and_folds_of(contact_.slave),
                                   second = contact_.self ? first : edges_and_folds_of(contact_.master);
    add(edges_that(first, true), second);
    if (!contact_.self) add(edges_that(second, true), edges_that(first, false), true);
  }
  void find_depths() {
    const double limit = deepest_crossing * size_;
    const std::map<Index, double> by_node =
        beside_.empty() ? depths_of_surfaces(limit) : depths_by_node(model_, beside_, limit);
    // Faces of a rigid surface that are sides of no cell are not in the skin: nothing is behind them.
    const auto depth = [&](Index node) {
      const auto found = by_node.find(node);
      return found == by_node.end() ? limit : found->second;
    };
    const auto depths = [&](const std::vector<FeatureEdge>& edges) {
      std::vector<double> by_edge;
      for (const FeatureEdge& edge : edges) by_edge.push_back(std::min(depth(edge.node[0]), depth(edge.node[1])));
      return by_edge;
    };
    for (MeetingEdges& lists : found_) {
      lists.depth_1 = depths(lists.first);
      lists.depth_2 = depths(lists.second);
    }
  }
  std::map<Index, double> depths_of_surfaces(double limit) const {
    std::vector<Facet> facets = contact_.slave.facets;
    if (!contact_.self) facets.insert(facets.end(), contact_.master.facets.begin(), contact_.master.facets.end());
    return depths_by_node(model_, facets, limit);
  }

  const Model& model_;
  const PairContact& contact_;
  const SmoothSides* smooth_;
  EdgeRule rule_;
  std::vector<Facet> beside_;  ///< the skin, where a surface ends
  double size_;
  std::vector<MeetingEdges> found_;
};

}  // namespace

std::vector<MeetingEdges> meeting_edges(const Model& model, const PairContact& contact, const SmoothSides* smooth) {
  return Meetings(model, contact, smooth).find();
}

}  // namespace carom
