#include "contact/bar_pair_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "contact/kept_slots.hpp"
#include "math/vec3.hpp"
#include "surface/broad_phase.hpp"

namespace carom {

namespace {

double clamped(double x) {
  return std::clamp(x, 0.0, 1.0);
}

/// In the middle of what lies side by side of two parallel segments; a_0 - b_0 = r.
double middle(const Vec3& d, const Vec3& e, const Vec3& r) {
  const double begin = -dot(r, d) / dot(d, d), end = begin + dot(e, d) / dot(d, d);
  return 0.5 * (clamped(begin) + clamped(end));
}

}  // namespace

SegmentPair closest_points(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  constexpr double parallel = 1e-10;  // square of the sine
  const Vec3 d = subtract(a[1], a[0]), e = subtract(b[1], b[0]), r = subtract(a[0], b[0]);
  const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
  const double crossing = dd * ee - de * de;
  SegmentPair pair;
  pair.s = crossing > parallel * dd * ee ? clamped((de * er - dr * ee) / crossing) : middle(d, e, r);
  pair.t = (de * pair.s + er) / ee;
  if (pair.t < 0.0 || pair.t > 1.0) {
    pair.t = clamped(pair.t);
    pair.s = clamped((de * pair.t - dr) / dd);
  }
  const Vec3 way = subtract(add(r, scaled(d, pair.s)), scaled(e, pair.t));
  pair.distance = norm(way);
  const Vec3 across = cross(d, e);
  pair.normal = pair.distance > 0.0 ? scaled(way, 1.0 / pair.distance)
                : norm(across) > 0.0
                    ? normalized(across)
                    : normalized(cross(d, std::abs(d[0]) < std::abs(d[1]) ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  return pair;
}

namespace {

constexpr std::size_t slots_per_bar = 8;

std::vector<Facet> segments_of(std::span<const BarSide> bars) {
  std::vector<Facet> segments;
  for (const BarSide& bar : bars) segments.push_back({{bar.node[0], bar.node[1], -1, -1}, 2});
  return segments;
}

double length_of(std::span<const Vec3> X, const BarSide& bar) {
  return norm(subtract(X[bar.node[1]], X[bar.node[0]]));
}

/// The first of the bars at each of their nodes.
std::map<Index, Index> owners(std::span<const BarSide> bars) {
  std::map<Index, Index> owner;
  for (std::size_t i = 0; i < bars.size(); ++i)
    for (const Index n : bars[i].node) owner.try_emplace(n, static_cast<Index>(i));
  return owner;
}

/// Of a bar, the bars of the other list that it hangs together with by less than twice the sum of their radii.
class Joined {
 public:
  Joined(std::span<const Vec3> X, std::span<const BarSide> first, std::span<const BarSide> second, double most_radius)
      : X_(X), most_radius_(most_radius) {
    for (const std::span<const BarSide> bars : {first, second})
      for (const BarSide& bar : bars) {
        const double length = length_of(X, bar);
        beside_[bar.node[0]].emplace_back(bar.node[1], length);
        beside_[bar.node[1]].emplace_back(bar.node[0], length);
      }
    for (std::size_t j = 0; j < second.size(); ++j)
      for (const Index n : second[j].node) at_node_[n].push_back(static_cast<Index>(j));
  }

  std::set<Index> to(const BarSide& bar) const {
    std::map<Index, double> way;  // from the bar to nodes
    std::set<std::pair<double, Index>> next;
    for (const Index n : bar.node) next.insert({0.0, n});
    std::set<Index> joined;
    while (!next.empty()) {
      const auto [far, n] = *next.begin();
      next.erase(next.begin());
      if (!way.try_emplace(n, far).second) continue;
      if (const auto found = at_node_.find(n); found != at_node_.end())
        joined.insert(found->second.begin(), found->second.end());
      for (const auto& [other, length] : beside_.at(n))
        if (far + length < 2.0 * (bar.radius + most_radius_)) next.insert({far + length, other});
    }
    return joined;
  }

 private:
  std::span<const Vec3> X_;
  double most_radius_;
  std::map<Index, std::vector<std::pair<Index, double>>> beside_;
  std::map<Index, std::vector<Index>> at_node_;
};

class BarPairRows : public RowMaker {
 public:
  BarPairRows(std::span<const Vec3> X, const PairContact& contact, double size, double radius, Index source)
      : first_(contact.slave_bars),
        second_(contact.master_bars),
        self_(contact.self),
        size_(size),
        law_(contact.law),
        source_(source),
        owner_1_(owners(first_)),
        owner_2_(owners(second_)),
        broad_phase_(segments_of(first_), segments_of(second_), size + 2.0 * radius, 0.5 * size) {
    const Joined joined(X, first_, second_, radius);
    for (const BarSide& bar : first_) joined_.push_back(joined.to(bar));
    for (const BarSide& bar : first_) measure_1_.push_back(2.0 * bar.radius * length_of(X, bar));
    for (const BarSide& bar : second_) measure_2_.push_back(2.0 * bar.radius * length_of(X, bar));
  }
  std::size_t slots() const override { return slots_per_bar * first_.size(); }
  void append_keys(SlotKeys& keys) const override {
    for (const BarSide& bar : first_)
      for (std::size_t k = 0; k < slots_per_bar; ++k) keys.add(bar.node, k);
    std::vector<NodeKey> met;
    for (const BarSide& bar : second_) met.push_back(node_key(bar.node));
    keys.meet(std::move(met));
  }
  bool is_fixed() const override { return false; }

  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override {
    broad_phase_.update(motion.x_begin, motion.displacement);
    if (broad_phase_.pair_count() == 0) return;
    parts_.append(first_.size(), rows, [&](std::size_t begin, std::size_t end, ConstraintRows& made) {
      std::vector<Found> found;
      for (std::size_t i = begin; i < end; ++i) {
        find(i, motion.x, found);
        const Index slot = first_slot + static_cast<Index>(slots_per_bar * i);
        const Places places = places_of(found, motion, slot);
        for (std::size_t k = 0; k < slots_per_bar; ++k)
          if (places[k] >= 0)
            add_row(i, found[static_cast<std::size_t>(places[k])], motion, slot + static_cast<Index>(k), made);
      }
    });
  }

 private:
  struct Found {
    Index other = -1;
    SegmentPair pair;
    double gap = 0.0;
  };
  /// By slot of a bar; -1: none.
  using Places = std::array<std::ptrdiff_t, slots_per_bar>;

  static std::array<Vec3, 2> placed(const BarSide& bar, std::span<const Vec3> x) {
    return {x[bar.node[0]], x[bar.node[1]]};
  }

  /// The closest point is a node that another bar answers for.
  static bool is_left(const BarSide& bar, std::size_t i, double share, const std::map<Index, Index>& owner) {
    if (share > 0.0 && share < 1.0) return false;
    return owner.at(bar.node[share > 0.0 ? 1 : 0]) != static_cast<Index>(i);
  }

  void find(std::size_t i, std::span<const Vec3> x, std::vector<Found>& found) const {
    found.clear();
    for (const Index j : broad_phase_.targets_of(i)) {
      const auto other = static_cast<std::size_t>(j);
      if ((self_ && other <= i) || joined_[i].contains(j)) continue;
      const SegmentPair pair = closest_points(placed(first_[i], x), placed(second_[other], x));
      const double gap = pair.distance - first_[i].radius - second_[other].radius;
      if (gap > size_) continue;
      if (law_.hold != RowHold::springs &&
          (is_left(first_[i], i, pair.s, owner_1_) || is_left(second_[other], other, pair.t, owner_2_)))
        continue;
      found.push_back({j, pair, gap});
    }
  }

  static Places places_of(const std::vector<Found>& found, const ContactMotion& motion, Index first_slot) {
    return kept_slots<slots_per_bar>(found, motion.behind(first_slot, slots_per_bar), &Found::gap);
  }

  void add_row(std::size_t i, const Found& found, const ContactMotion& motion, Index slot, ConstraintRows& rows) const {
    const auto j = static_cast<std::size_t>(found.other);
    const BarSide &bar = first_[i], &other = second_[j];
    const SegmentPair& pair = found.pair;
    const std::array<Vec3, 2> x = placed(bar, motion.x);
    const Vec3 at = add(scaled(x[0], 1.0 - pair.s), scaled(x[1], pair.s));
    const double measure = std::min(measure_1_[i], measure_2_[j]);
    rows.add_row(found.gap, pair.normal, at, measure, row_law(law_, measure), source_);
    rows.facet.back() = found.other;
    Index behind = 0;
    const auto add_end = [&](Index n, double weight) {
      if (weight == 0.0) return;
      rows.add_node(n, weight);
      if (weight < 0.0) ++behind;
    };
    add_end(bar.node[0], 1.0 - pair.s);
    add_end(bar.node[1], pair.s);
    add_end(other.node[0], pair.t - 1.0);
    add_end(other.node[1], -pair.t);
    rows.behind.back() = behind;
    finish_row(rows, motion.u, slot);
  }

  std::vector<BarSide> first_, second_;
  bool self_;
  double size_;
  ContactLaw law_;
  Index source_;
  std::map<Index, Index> owner_1_, owner_2_;
  std::vector<double> measure_1_, measure_2_;
  std::vector<std::set<Index>> joined_;  ///< of each first bar: second ones that it does not see
  mutable BroadPhase broad_phase_;
  mutable RowParts parts_;
};

}  // namespace

std::unique_ptr<RowMaker> bar_pair_rows(const Model& model, const PairContact& contact, Index source) {
  if (contact.law.mu > 0.0) {
    throw std::invalid_argument("contact \"" + contact.name +
                                "\": bars rub on obstacles alone, not on each other, since a force at their sides "
                                "would turn them about their axes; remove friction");
  }
  const std::span<const Vec3> X = model.mesh->coordinates;
  double radius = 0.0, size = 0.0;
  for (const std::vector<BarSide>* bars : {&contact.slave_bars, &contact.master_bars}) {
    double sum = 0.0;
    for (const BarSide& bar : *bars) {
      radius = std::max(radius, bar.radius);
      sum += length_of(X, bar);
    }
    size = std::max(size, sum / static_cast<double>(bars->size()));
  }
  return std::make_unique<BarPairRows>(X, contact, size, radius, source);
}

}  // namespace carom
