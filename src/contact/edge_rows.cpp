#include "contact/edge_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "contact/kept_slots.hpp"
#include "contact/meeting_edges.hpp"
#include "math/vec3.hpp"
#include "surface/broad_phase.hpp"

namespace carom {
namespace {

constexpr std::size_t slots_per_segment = 8;
// Of the facet size: depths at which a pair may begin that has not come from the front. Where its factor grows from
// nothing its force does, too; else this depth is what it jumps by.
constexpr double shallow = 0.002, shallow_from_nothing = 0.05;

std::vector<Facet> segments_of(const std::vector<FeatureEdge>& edges) {
  std::vector<Facet> segments;
  for (const FeatureEdge& edge : edges) segments.push_back({{edge.node[0], edge.node[1], -1, -1}, 2});
  return segments;
}

bool share_a_node(const Facet& a, const Facet& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

bool are_neighbours(const FeatureEdge& a, const FeatureEdge& b) {
  for (const Facet& of_a : a.facet)
    for (const Facet& of_b : b.facet)
      if (share_a_node(of_a, of_b)) return true;
  return false;
}

/// Of a surface with itself two sharp edges are both of the first and of the second: the pair stands once.
bool stands_elsewhere(const FeatureEdge& first, const FeatureEdge& second) {
  return second.is_sharp && second.node <= first.node;
}

/// True of an edge and itself, and of edges that share a node at which they turn by less than 60 degrees.
bool go_on(const FeatureEdge& a, const FeatureEdge& b, std::span<const Vec3> x) {
  if (a.node == b.node) return true;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      if (a.node[i] != b.node[j]) continue;
      const Vec3 arrives = subtract(x[a.node[i]], x[a.node[1 - i]]), leaves = subtract(x[b.node[1 - j]], x[b.node[j]]);
      return dot(arrives, leaves) > 0.5 * norm(arrives) * norm(leaves);
    }
  }
  return false;
}

/// Mean of the nodes of a facet of the edge that are not on it.
Vec3 far_of(const FeatureEdge& edge, const Facet& facet, std::span<const Vec3> x) {
  Vec3 sum{};
  int count = 0;
  for (const Index n : facet) {
    if (n == edge.node[0] || n == edge.node[1]) continue;
    sum = add(sum, x[n]);
    ++count;
  }
  return scaled(sum, 1.0 / count);
}

PlacedEdge place(const FeatureEdge& edge, std::span<const Vec3> x) {
  return {{x[edge.node[0]], x[edge.node[1]]}, {far_of(edge, edge.facet[0], x), far_of(edge, edge.facet[1], x)}};
}

/// Calls f(node, vector) for the shares of an edge's nodes.
template <class F>
void for_each_share(const FeatureEdge& edge, const EdgeShares& shares, const F& f) {
  for (std::size_t a = 0; a < 2; ++a) f(edge.node[a], shares.x[a]);
  for (std::size_t i = 0; i < 2; ++i) {
    if (shares.far[i] == Vec3{}) continue;
    std::array<Index, 4> others{};
    std::size_t count = 0;
    for (const Index n : edge.facet[i])
      if (n != edge.node[0] && n != edge.node[1]) others[count++] = n;
    for (std::size_t k = 0; k < count; ++k) f(others[k], scaled(shares.far[i], 1.0 / static_cast<double>(count)));
  }
}

class EdgeRows : public RowMaker {
 public:
  EdgeRows(MeetingEdges edges, const ContactLaw& law, Index source)
      : edges_(std::move(edges)),
        law_(law),
        source_(source),
        broad_phase_(segments_of(edges_.first), segments_of(edges_.second), edges_.rule.reach * edges_.size,
                     edges_.rule.margin * edges_.size) {}
  std::size_t slots() const override { return slots_per_segment * edges_.first.size(); }
  void append_keys(SlotKeys& keys) const override {
    for (const FeatureEdge& edge : edges_.first)
      for (std::size_t k = 0; k < slots_per_segment; ++k) keys.add(edge.node, k);
    std::vector<NodeKey> met;
    for (const FeatureEdge& edge : edges_.second) met.push_back(node_key(edge.node));
    keys.meet(std::move(met));
  }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override;
  void add_moving_nodes(std::vector<Index>& nodes) const override {
    for (const std::vector<FeatureEdge>* edges : {&edges_.first, &edges_.second})
      for (const FeatureEdge& edge : *edges)
        for (const Facet& facet : edge.facet) nodes.insert(nodes.end(), facet.begin(), facet.end());
  }

 private:
  /// A pair of segments that were behind each other at the beginning of the step, and where among its first segment's
  /// slots it stands.
  struct Behind {
    Index first, second;
    std::size_t place;
  };
  struct Found {
    Index other;
    EdgePair pair;
  };
  /// By place among a segment's slots; -1: none.
  using Places = std::array<std::ptrdiff_t, slots_per_segment>;

  void find_behind(const ContactMotion& motion, Index first_slot) const;
  std::span<const Behind> behind_of(Index i) const;
  bool was_behind(Index i, Index j, std::span<const Vec3> x) const;
  PairFactor factor_of(Index i, Index j) const;
  bool counts(Index i, Index j, const EdgePair& pair, const ContactMotion& motion) const;
  bool stood_at_begin(Index i, Index j, const ContactMotion& motion) const;
  double depth_at_start(Index i, Index j) const;
  bool has_come_from_the_front(Index i, Index j, const EdgePair& pair, const ContactMotion& motion) const;
  void find(Index i, const ContactMotion& motion, std::vector<Found>& found) const;
  Places places_of(Index i, const std::vector<Found>& found) const;
  void add_row(Index i, const Found& found, const ContactMotion& motion, Index slot, ConstraintRows& rows) const;

  MeetingEdges edges_;
  ContactLaw law_;
  Index source_;
  mutable BroadPhase broad_phase_;
  mutable RowParts parts_;
  mutable std::vector<Behind> behind_;  ///< by increasing first segment
};

void EdgeRows::find_behind(const ContactMotion& motion, Index first_slot) const {
  behind_.clear();
  if (motion.history.empty()) return;
  for (std::size_t s = 0; s < slots(); ++s) {
    const Index other = motion.behind(first_slot + static_cast<Index>(s));
    if (other >= 0) behind_.push_back({static_cast<Index>(s / slots_per_segment), other, s % slots_per_segment});
  }
}

std::span<const EdgeRows::Behind> EdgeRows::behind_of(Index i) const {
  const auto begin = std::lower_bound(behind_.begin(), behind_.end(), i,
                                      [](const Behind& behind, Index first) { return behind.first < first; });
  const auto end =
      std::upper_bound(begin, behind_.end(), i, [](Index first, const Behind& behind) { return first < behind.first; });
  return {begin, end};
}

/// True when the segments, or those that go on with them, were behind each other. Not others at a corner: what those
/// meet from the front says nothing of this one.
bool EdgeRows::was_behind(Index i, Index j, std::span<const Vec3> x) const {
  const FeatureEdge &first = edges_.first[i], &second = edges_.second[j];
  return std::any_of(behind_.begin(), behind_.end(), [&](const Behind& was) {
    const FeatureEdge &was_first = edges_.first[was.first], &was_second = edges_.second[was.second];
    return (go_on(was_first, first, x) && go_on(was_second, second, x)) ||
           (edges_.is_self && go_on(was_second, first, x) && go_on(was_first, second, x));
  });
}

PairFactor EdgeRows::factor_of(Index i, Index j) const {
  const PairFactor factor = edges_.rule.factor;
  if (edges_.second[j].is_fold) return factor == PairFactor::stopped ? PairFactor::held : PairFactor::fold;
  const bool may_be_border = edges_.first[i].is_sharp && edges_.second[j].is_sharp;
  return factor == PairFactor::border && !may_be_border ? PairFactor::moves : factor;
}

bool EdgeRows::counts(Index i, Index j, const EdgePair& pair, const ContactMotion& motion) const {
  const EdgeRule& rule = edges_.rule;
  if (pair.gap > rule.reach * edges_.size) return false;
  if (pair.factor < rule.least_factor && !stood_at_begin(i, j, motion)) return false;
  if (rule.from_the_front) return has_come_from_the_front(i, j, pair, motion);
  if (pair.gap <= -std::min(edges_.depth_1[i], edges_.depth_2[j])) return false;
  // The search lists those within reach; of what is deeper it depends on the axes.
  return pair.gap > -rule.reach * edges_.size || was_behind(i, j, motion.x);
}

/// True of a pair that multipliers hold, if its factor was large enough when the step began: its force must not be able
/// to push it out of the rows within the step, where no forces would be in balance.
bool EdgeRows::stood_at_begin(Index i, Index j, const ContactMotion& motion) const {
  if (edges_.rule.factor != PairFactor::held) return false;
  const auto pair = edge_pair(place(edges_.first[i], motion.x_begin), edges_.first[i].end,
                              place(edges_.second[j], motion.x_begin), edges_.second[j].end, factor_of(i, j));
  return pair && pair->factor >= edges_.rule.least_factor;
}

/// Where one edge alone sticks out, what is deeper than that may be the far side of either body.
double EdgeRows::depth_at_start(Index i, Index j) const {
  return edges_.rule.factor == PairFactor::held ? edges_.size : std::min(edges_.depth_1[i], edges_.depth_2[j]);
}

bool EdgeRows::has_come_from_the_front(Index i, Index j, const EdgePair& pair, const ContactMotion& motion) const {
  const double size = edges_.size;
  if (pair.gap > -shallow * size || was_behind(i, j, motion.x)) return true;
  if (motion.history.empty() && pair.gap > -depth_at_start(i, j)) return true;
  const PlacedEdge first = place(edges_.first[i], motion.x_begin), second = place(edges_.second[j], motion.x_begin);
  if (pair.line_gap(first, second) > -shallow * size) return true;
  return pair.gap > -shallow_from_nothing * size &&
         !edge_pair(first, edges_.first[i].end, second, edges_.second[j].end, factor_of(i, j));
}

/// The pairs of segment i that count, by increasing segment of the other side.
void EdgeRows::find(Index i, const ContactMotion& motion, std::vector<Found>& found) const {
  found.clear();
  const std::span<const Index> near = broad_phase_.targets_of(static_cast<std::size_t>(i));
  std::vector<Index> candidates(near.begin(), near.end());
  for (const Behind& was : behind_of(i)) candidates.push_back(was.second);
  if (candidates.empty()) return;
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  const PlacedEdge placed = place(edges_.first[i], motion.x);
  for (const Index j : candidates) {
    const FeatureEdge &first = edges_.first[i], &second = edges_.second[j];
    if (!may_cross(placed.x, first.end, {motion.x[second.node[0]], motion.x[second.node[1]]}, second.end)) continue;
    if ((edges_.is_self && stands_elsewhere(first, second)) || are_neighbours(first, second)) continue;
    const auto pair = edge_pair(placed, first.end, place(second, motion.x), second.end, factor_of(i, j));
    if (pair && counts(i, j, *pair, motion)) found.push_back({j, *pair});
  }
}

EdgeRows::Places EdgeRows::places_of(Index i, const std::vector<Found>& found) const {
  std::array<Index, slots_per_segment> kept;
  kept.fill(-1);
  for (const Behind& was : behind_of(i)) kept[was.place] = was.second;
  return kept_slots<slots_per_segment>(found, kept, [](const Found& pair) { return pair.pair.gap; });
}

void EdgeRows::add_row(Index i, const Found& found, const ContactMotion& motion, Index slot,
                       ConstraintRows& rows) const {
  const FeatureEdge &first = edges_.first[i], &second = edges_.second[found.other];
  const EdgePair& pair = found.pair;
  const double measure = std::min(first.measure, second.measure);
  rows.add_row(pair.factor * pair.gap, pair.normal, pair.point, measure, row_law(law_, measure), source_);
  rows.facet.back() = found.other;
  const std::array<std::array<EdgeShares, 2>, 3> shares{pair.of_gap, pair.along(rows.tangent_1.back()),
                                                        pair.along(rows.tangent_2.back())};
  for (std::size_t side = 0; side < 2; ++side) {
    RowBlocks blocks;
    const FeatureEdge& edge = side == 0 ? first : second;
    for_each_share(edge, shares[0][side], [&](Index n, const Vec3& v) { blocks.add(n, v, {}, {}); });
    for_each_share(edge, shares[1][side], [&](Index n, const Vec3& v) { blocks.add(n, {}, v, {}); });
    for_each_share(edge, shares[2][side], [&](Index n, const Vec3& v) { blocks.add(n, {}, {}, v); });
    blocks.append_to(rows);
    if (side == 1) rows.behind.back() = static_cast<Index>(blocks.size());
  }
  finish_row(rows, motion.u, slot);
}

void EdgeRows::append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const {
  broad_phase_.update(motion.x_begin, motion.displacement);
  find_behind(motion, first_slot);
  if (broad_phase_.pair_count() == 0 && behind_.empty()) return;
  parts_.append(edges_.first.size(), rows, [&](std::size_t begin, std::size_t end, ConstraintRows& made) {
    std::vector<Found> found;
    for (std::size_t i = begin; i < end; ++i) {
      find(static_cast<Index>(i), motion, found);
      const Places places = places_of(static_cast<Index>(i), found);
      for (std::size_t k = 0; k < slots_per_segment; ++k)
        if (places[k] >= 0)
          add_row(static_cast<Index>(i), found[static_cast<std::size_t>(places[k])], motion,
                  first_slot + static_cast<Index>(slots_per_segment * i + k), made);
    }
  });
}

bool is_solid(const Surface& surface) {
  return !surface.facets.empty() && surface.facets.front().size > 2;
}

}  // namespace

std::unique_ptr<RowMaker> edge_rows(const Model& model, const PairContact& contact, Index source,
                                    const SmoothSides* smooth) {
  if (!is_solid(contact.slave) || !is_solid(contact.master)) return nullptr;
  auto all = std::make_unique<MakersInOrder>();
  for (MeetingEdges& edges : meeting_edges(model, contact, smooth)) {
    const bool is_back = edges.is_back;
    all->add(std::make_unique<EdgeRows>(std::move(edges), contact.law, source), is_back);
  }
  return all->slots() == 0 ? nullptr : std::move(all);
}

}  // namespace carom
