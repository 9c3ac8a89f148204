#include "run/contact_fields.hpp"

#include <algorithm>
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

}  // namespace

namespace {

/// Means over the rows that see a node from one side, by their weights along the normal.
struct SideMeans {
  std::vector<double> pressure, gap, status, weight;

  SideMeans(const ContactResponse& response, std::span<const double> u, bool is_other)
      : pressure(u.size() / 3, 0.0), gap(pressure), status(pressure), weight(pressure) {
    const ConstraintRows& rows = *response.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto [begin, end] = entries_of_side(rows, r, is_other);
      for (std::size_t k = begin; k < end; ++k) {
        const double w = (is_other ? -1.0 : 1.0) * dot(rows.block[k][0], rows.normal[r]);
        if (w <= 0.0) continue;
        const auto n = static_cast<std::size_t>(rows.node[k]);
        weight[n] += w;
        pressure[n] += w * response.force[r][0] / rows.measure[r];
        gap[n] += w * rows.gap_at(r, u);
        status[n] = std::max(status[n], 1.0 + static_cast<double>(response.status[r]));
      }
    }
    for (std::size_t n = 0; n < weight.size(); ++n) {
      if (weight[n] == 0.0) continue;
      pressure[n] /= weight[n];
      gap[n] /= weight[n];
    }
  }
};

}  // namespace

NodalContact nodal_contact(const ContactResponse& response, std::span<const double> u) {
  SideMeans own(response, u, false);
  const SideMeans other(response, u, true);
  for (std::size_t n = 0; n < own.weight.size(); ++n) {
    own.pressure[n] += other.pressure[n];
    own.status[n] = std::max(own.status[n], other.status[n]);
    if (own.weight[n] == 0.0) own.gap[n] = other.gap[n];
  }
  return {std::move(own.pressure), std::move(own.gap), std::move(own.status)};
}

}  // namespace carom
