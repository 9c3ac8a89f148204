// Contact at the nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "rows/response.hpp"

namespace carom {

/// Means over the rows that a node feels, weighted by how much it feels them: contact pressure (force per area; force
/// on rows that are counted per node), gap (length), slip rate (size of the tangential relative velocity of closed
/// rows; 0 without any), status (0 far from contact, 1 open, 2 sticking, 3 sliding; the largest of its rows). A node
/// that rows see from both sides has the sum of both means of the pressure, and the gap and slip rate of its own side.
/// Where two passes by multipliers have a row of the node's own, the pressure is the normal force of all rows on the
/// node over the area that its own row stands for: that is unique, the share of each pass is not. Nodes that stand for
/// obstacles have values, too, which mean nothing.
struct NodalContact {
  std::vector<Index> nodes;  ///< those that rows stand at, in ascending order: all values are theirs, and 0 elsewhere
  std::vector<double> pressure, gap, slip_rate;
  std::vector<std::uint8_t> status;

  /// One of the values for each of `count` nodes.
  template <class Value>
  std::vector<double> at_all(const std::vector<Value>& values, std::size_t count) const {
    std::vector<double> all(count, 0.0);
    for (std::size_t i = 0; i < nodes.size(); ++i) all[at(nodes[i])] = static_cast<double>(values[i]);
    return all;
  }
};
NodalContact nodal_contact(const ContactResponse& response, std::span<const double> u, std::span<const double> v);

}  // namespace carom
