#include "record/contact_fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "math/vec3.hpp"

namespace carom {

namespace {

/// The entries of a row's nodes: of its own side, or of the other one.
struct Entries {
  std::size_t begin, end;
};
Entries entries_of_side(const ConstraintRows& rows, std::size_t r, bool is_other) {
  const auto first = static_cast<std::size_t>(rows.begin[r]), last = static_cast<std::size_t>(rows.begin[r + 1]);
  const std::size_t split = last - static_cast<std::size_t>(rows.behind[r]);
  return is_other ? Entries{split, last} : Entries{first, split};
}

/// The nodes that rows stand at, in ascending order, and their numbers in it.
class NodesOfRows {
 public:
  explicit NodesOfRows(const ConstraintRows& rows) : nodes_(rows.node.begin(), rows.node.end()) {
    std::ranges::sort(nodes_);
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  }
  std::size_t size() const { return nodes_.size(); }
  std::size_t number(Index node) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(nodes_, node) - nodes_.begin());
  }
  std::vector<Index> take() && { return std::move(nodes_); }

 private:
  std::vector<Index> nodes_;
};

/// Nodes with a row of their own in a contact of two passes by multipliers. What each pass carries there is one of many
/// answers (the rows depend on each other), but the force on a node is unique: it balances the cells. So it makes the
/// pressure. Where nodes are guards, means have the pressure. Springs, which store energy, have no such nodes: the
/// force of each row follows from its own gap.
class TwoPassNodes {
 public:
  explicit TwoPassNodes(const ContactResponse& response) : response_(response) {
    const ConstraintRows& rows = *response.rows;
    if (response.stored > 0.0) return;
    std::set<Index> sources;
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (rows.is_back[r]) sources.insert(rows.source[r]);
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (rows.allowed[r] > 0.0) sources.erase(rows.source[r]);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto [begin, end] = entries_of_side(rows, r, false);
      if (end - begin == 1 && sources.contains(rows.source[r]))
        own_[{rows.source[r], rows.node[begin]}] = {rows.measure[r], rows.normal[r]};
    }
  }
  bool has(std::size_t r, Index node) const { return own_.contains({response_.rows->source[r], node}); }

  /// Adds the normal forces of all rows on these nodes, over the areas that their own rows stand for.
  void add_to(std::vector<double>& pressure, const NodesOfRows& nodes) const {
    const ConstraintRows& rows = *response_.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (std::int64_t k = rows.begin[r]; k < rows.begin[r + 1]; ++k) {
        const Index node = rows.node[static_cast<std::size_t>(k)];
        const auto own = own_.find({rows.source[r], node});
        if (own == own_.end()) continue;
        pressure[nodes.number(node)] += response_.force[r][0] *
                                        dot(rows.block[static_cast<std::size_t>(k)][0], own->second.normal) /
                                        own->second.area;
      }
    }
  }

 private:
  struct Own {
    double area;
    Vec3 normal;
  };
  const ContactResponse& response_;
  std::map<std::pair<Index, Index>, Own> own_;  ///< by source and node
};

/// Means over the rows that see a node from one side, by their weights along the normal; pressures without the nodes of
/// two passes. What guards press comes on top.
struct SideMeans {
  std::vector<double> pressure, gap, slip_rate, weight, closed;
  std::vector<std::uint8_t> status;

  SideMeans(const ContactResponse& response, const NodesOfRows& nodes, const TwoPassNodes& two_pass,
            std::span<const double> u, std::span<const double> v, bool is_other)
      : pressure(nodes.size(), 0.0),
        gap(pressure),
        slip_rate(pressure),
        weight(pressure),
        closed(pressure),
        status(weight.size(), 0) {
    const ConstraintRows& rows = *response.rows;
    std::vector<double> pressing = weight, guarded = weight;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (rows.source[r] < 0) continue;  // an equation
      const auto [begin, end] = entries_of_side(rows, r, is_other);
      const bool is_closed = response.status[r] != RowStatus::open;
      const Vec3 rate = is_closed ? rows.relative(r, v) : Vec3{};
      for (std::size_t k = begin; k < end; ++k) {
        const double w = (is_other ? -1.0 : 1.0) * dot(rows.block[k][0], rows.normal[r]);
        if (w <= 0.0) continue;
        const std::size_t n = nodes.number(rows.node[k]);
        status[n] = std::max(status[n], static_cast<std::uint8_t>(1 + static_cast<int>(response.status[r])));
        if (rows.allowed[r] > 0.0) {
          guarded[n] += w * response.force[r][0] / rows.measure[r];
          continue;
        }
        weight[n] += w;
        gap[n] += w * rows.gap_at(r, u);
        if (is_closed) {
          closed[n] += w;
          slip_rate[n] += w * std::hypot(rate[1], rate[2]);
        }
        if (two_pass.has(r, rows.node[k])) continue;
        pressing[n] += w;
        pressure[n] += w * response.force[r][0] / rows.measure[r];
      }
    }
    for (std::size_t n = 0; n < weight.size(); ++n) {
      if (pressing[n] > 0.0) pressure[n] /= pressing[n];
      pressure[n] += guarded[n];
      if (weight[n] > 0.0) gap[n] /= weight[n];
      if (closed[n] > 0.0) slip_rate[n] /= closed[n];
    }
  }
};

}  // namespace

NodalContact nodal_contact(const ContactResponse& response, std::span<const double> u, std::span<const double> v) {
  NodesOfRows nodes(*response.rows);
  const TwoPassNodes two_pass(response);
  SideMeans own(response, nodes, two_pass, u, v, false);
  const SideMeans other(response, nodes, two_pass, u, v, true);
  for (std::size_t n = 0; n < own.weight.size(); ++n) {
    own.pressure[n] += other.pressure[n];
    own.status[n] = std::max(own.status[n], other.status[n]);
    if (own.weight[n] == 0.0) own.gap[n] = other.gap[n];
    if (own.closed[n] == 0.0) own.slip_rate[n] = other.slip_rate[n];
  }
  two_pass.add_to(own.pressure, nodes);
  return {std::move(nodes).take(), std::move(own.pressure), std::move(own.gap), std::move(own.slip_rate),
          std::move(own.status)};
}

}  // namespace carom
