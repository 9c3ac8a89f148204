// Broad phase of the contact search: which facets may touch, kept over many steps.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/facet.hpp"
#include "surface/box_tree.hpp"

namespace carom {

/// Candidate pairs (query, target) of a moving configuration. The list is made with boxes that are larger than asked
/// for and stays valid until a node has used up its share of that margin (the list of Verlet, Phys. Rev. 159, 1967, p.
/// 98): between two builds nothing but the positions of the nodes is looked at.
///
/// After every update the list holds each pair whose boxes come within `reach` of each other in every axis, hence each
/// pair of facets at a distance of at most `reach`; with displacements the boxes cover the whole way of the step, so
/// that a facet that crosses another one within the step is paired with it. Facets that share a node are never paired.
class BroadPhase {
 public:
  /// Queries may be points (facets of one node). reach, margin >= 0 (length). A larger margin gives fewer builds and
  /// longer lists.
  BroadPhase(std::vector<Facet> queries, std::vector<Facet> targets, double reach, double margin);

  /// Brings the list up to date for the positions x of all nodes of the mesh, and for their way from x to
  /// x + displacement if that is given (else it has no entries). Builds the list again if some node has left, by more
  /// than margin / 2 along an axis, the box of its own way at the last build; without displacements that is a motion of
  /// more than margin / 2. Returns whether it did. Throws std::domain_error naming the node at a position that is not
  /// finite.
  bool update(std::span<const Vec3> x, std::span<const Vec3> displacement = {});

  /// Candidates of query q, increasing; the same for every number of threads. Valid until the next update.
  std::span<const Index> targets_of(std::size_t q) const;

  const std::vector<Facet>& queries() const { return queries_; }
  const std::vector<Facet>& targets() const { return targets_; }
  std::size_t pair_count() const { return candidate_.size(); }
  long builds() const { return builds_; }

 private:
  bool is_valid(std::span<const Vec3> x, std::span<const Vec3> displacement) const;
  void build(std::span<const Vec3> x, std::span<const Vec3> displacement);

  std::vector<Facet> queries_, targets_;
  double reach_, margin_;
  std::vector<Index> nodes_;     ///< of all facets, each once, increasing
  std::vector<Bounds> allowed_;  ///< where they may go until the next build
  std::vector<Bounds> target_boxes_;
  BoxTree tree_;
  std::vector<std::vector<Index>> chunks_;  ///< candidates found by each range of queries
  std::vector<Index> begin_;                ///< candidates of query q: candidate_[begin_[q]] ... [begin_[q + 1] - 1]
  std::vector<Index> candidate_;
  long builds_ = 0;
};

}  // namespace carom
