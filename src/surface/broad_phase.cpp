#include "surface/broad_phase.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {
namespace {

constexpr std::size_t query_grain = 256;  // queries or boxes per task: some ten microseconds of work

Bounds way_of(Index node, std::span<const Vec3> x, std::span<const Vec3> displacement) {
  Bounds box;
  box.include(x[node]);
  if (!displacement.empty()) box.include(add(x[node], displacement[node]));
  return box;
}

Bounds box_of(const Facet& facet, std::span<const Vec3> x, std::span<const Vec3> displacement) {
  Bounds box;
  for (const Index node : facet) box.include(way_of(node, x, displacement));
  return box;
}

bool share_a_node(const Facet& a, const Facet& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

bool is_finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

}  // namespace

BroadPhase::BroadPhase(std::vector<Facet> queries, std::vector<Facet> targets, double reach, double margin)
    : queries_(std::move(queries)), targets_(std::move(targets)), reach_(reach), margin_(margin) {
  for (const std::vector<Facet>* facets : {&queries_, &targets_})
    for (const Facet& facet : *facets) nodes_.insert(nodes_.end(), facet.begin(), facet.end());
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  begin_.assign(queries_.size() + 1, 0);
}

bool BroadPhase::update(std::span<const Vec3> x, std::span<const Vec3> displacement) {
  if (builds_ > 0 && is_valid(x, displacement)) return false;
  build(x, displacement);
  return true;
}

bool BroadPhase::is_valid(std::span<const Vec3> x, std::span<const Vec3> displacement) const {
  std::atomic<bool> valid = true;
  parallel_each(nodes_.size(), [&](std::size_t i) {
    const Bounds& allowed = allowed_[i];
    const Vec3& from = x[nodes_[i]];
    const bool inside =
        allowed.contains(from) && (displacement.empty() || allowed.contains(add(from, displacement[nodes_[i]])));
    if (!inside) valid.store(false, std::memory_order_relaxed);
  });
  return valid;
}

void BroadPhase::build(std::span<const Vec3> x, std::span<const Vec3> displacement) {
  allowed_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Index node = nodes_[i];
    if (!is_finite(x[node]) || !(displacement.empty() || is_finite(displacement[node])))
      throw std::domain_error(fmt::format("contact search: the position of node {} is not finite", node));
    allowed_[i] = way_of(node, x, displacement);
    allowed_[i].grow(0.5 * margin_);
  }
  target_boxes_.resize(targets_.size());
  parallel_for(targets_.size(), query_grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) target_boxes_[t] = box_of(targets_[t], x, displacement);
  });
  tree_.build(target_boxes_);

  chunks_.resize((queries_.size() + query_grain - 1) / query_grain);
  parallel_for(queries_.size(), query_grain, [&](std::size_t first, std::size_t last) {
    std::vector<Index>& found = chunks_[first / query_grain];
    found.clear();
    for (std::size_t q = first; q < last; ++q) {
      const auto before = static_cast<std::ptrdiff_t>(found.size());
      Bounds box = box_of(queries_[q], x, displacement);
      box.grow(reach_ + margin_);
      tree_.find(box, found);
      found.erase(std::remove_if(found.begin() + before, found.end(),
                                 [&](Index t) { return share_a_node(queries_[q], targets_[t]); }),
                  found.end());
      std::sort(found.begin() + before, found.end());
      begin_[q + 1] = static_cast<Index>(found.size()) - static_cast<Index>(before);
    }
  });
  for (std::size_t q = 0; q < queries_.size(); ++q) begin_[q + 1] += begin_[q];
  candidate_.clear();
  for (const std::vector<Index>& chunk : chunks_) candidate_.insert(candidate_.end(), chunk.begin(), chunk.end());
  ++builds_;
}

std::span<const Index> BroadPhase::targets_of(std::size_t q) const {
  return {candidate_.data() + begin_[q], candidate_.data() + begin_[q + 1]};
}

}  // namespace carom
