// Keys of slots, by which histories find their slots again when surfaces have lost and gained facets.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/facet.hpp"
#include "rows/row_history.hpp"

namespace carom {

/// The nodes of a facet, an edge, or one node, in increasing order.
using NodeKey = std::array<Index, 4>;

inline NodeKey node_key(std::span<const Index> nodes) {
  NodeKey key{-1, -1, -1, -1};
  std::copy_n(nodes.begin(), std::min<std::size_t>(nodes.size(), 4), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}
inline NodeKey node_key(const Facet& facet) {
  return node_key(std::span<const Index>(facet.begin(), facet.end()));
}

inline std::vector<NodeKey> node_keys(std::span<const Facet> facets) {
  std::vector<NodeKey> keys;
  for (const Facet& facet : facets) keys.push_back(node_key(facet));
  return keys;
}

/// For each slot the nodes that it belongs to, and the facets that its history may refer to (RowHistory::facet).
class SlotKeys {
 public:
  /// Adds one slot: its nodes, and its number among the slots of the same nodes.
  void add(std::span<const Index> nodes, std::uint64_t place = 0) {
    own_.push_back({node_key(nodes), place});
    list_.push_back(met_.size());
  }
  /// The facets that the slots since the last call count, by number; none where the numbers never change.
  void meet(std::vector<NodeKey> met) { met_.push_back(std::move(met)); }
  /// From the slot `first` on they are those of number `maker` among several makers.
  void set_maker(std::size_t first, std::uint64_t maker) {
    constexpr std::uint64_t most_makers = 65536;
    for (std::size_t s = first; s < own_.size(); ++s) own_[s].place = most_makers * own_[s].place + maker;
  }
  std::size_t size() const { return own_.size(); }
  /// The nodes of a slot, and of a facet that its history may refer to.
  const NodeKey& nodes(std::size_t slot) const { return own_[slot].nodes; }
  const NodeKey& met(std::size_t slot, Index facet) const { return met_[list_[slot]][static_cast<std::size_t>(facet)]; }

  /// For each slot the slot of `before` that it was, or -1.
  std::vector<std::ptrdiff_t> places_in(const SlotKeys& before) const {
    std::map<Own, std::size_t> place_of;
    for (std::size_t s = 0; s < before.own_.size(); ++s) place_of.emplace(before.own_[s], s);
    std::vector<std::ptrdiff_t> places(own_.size(), -1);
    for (std::size_t s = 0; s < own_.size(); ++s)
      if (const auto found = place_of.find(own_[s]); found != place_of.end())
        places[s] = static_cast<std::ptrdiff_t>(found->second);
    return places;
  }
  /// The history of these slots from that of the slots `before`, with places = places_in(before). New slots have no
  /// history, and a slot that was behind a facet that has gone is behind none.
  std::vector<RowHistory> carry(const SlotKeys& before, std::span<const std::ptrdiff_t> places,
                                std::span<const RowHistory> history) const {
    std::vector<std::map<NodeKey, Index>> number(met_.size());
    for (std::size_t list = 0; list < met_.size(); ++list)
      for (std::size_t k = 0; k < met_[list].size(); ++k) number[list].emplace(met_[list][k], static_cast<Index>(k));
    std::vector<RowHistory> carried(own_.size());
    for (std::size_t s = 0; s < own_.size(); ++s) {
      if (places[s] < 0) continue;
      const auto place = static_cast<std::size_t>(places[s]);
      carried[s] = history[place];
      const std::vector<NodeKey>& met = before.met_[before.list_[place]];
      if (carried[s].facet < 0 || met.empty()) continue;
      const auto now = number[list_[s]].find(met[static_cast<std::size_t>(carried[s].facet)]);
      if (now == number[list_[s]].end())
        carried[s] = {};
      else
        carried[s].facet = now->second;
    }
    return carried;
  }

 private:
  struct Own {
    NodeKey nodes;
    std::uint64_t place;
    auto operator<=>(const Own&) const = default;
  };
  std::vector<Own> own_;
  std::vector<std::size_t> list_;  ///< by slot: position in met_
  std::vector<std::vector<NodeKey>> met_;
};

}  // namespace carom
