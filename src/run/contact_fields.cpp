#include "run/contact_fields.hpp"

#include <algorithm>

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

NodalContact nodal_contact(const ContactResponse& response, std::span<const double> u) {
  const std::size_t nodes = u.size() / 3;
  NodalContact out{std::vector<double>(nodes, 0.0), std::vector<double>(nodes, 0.0), std::vector<double>(nodes, 0.0)};
  const ConstraintRows& rows = *response.rows;
  std::vector<double> weights(nodes, 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto [begin, end] = entries_of_side(rows, r, false);
    for (std::size_t k = begin; k < end; ++k) {
      const double weight = dot(rows.block[k][0], rows.normal[r]);
      if (weight <= 0.0) continue;
      const auto n = static_cast<std::size_t>(rows.node[k]);
      weights[n] += weight;
      out.pressure[n] += weight * response.force[r][0] / rows.measure[r];
      out.gap[n] += weight * rows.gap_at(r, u);
      out.status[n] = std::max(out.status[n], 1.0 + static_cast<double>(response.status[r]));
    }
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    if (weights[n] == 0.0) continue;
    out.pressure[n] /= weights[n];
    out.gap[n] /= weights[n];
  }
  return out;
}

std::vector<ContactResultant> contact_resultants(const ContactResponse& response, const Mesh& mesh,
                                                 std::span<const double> u, const std::vector<Vec3>& points) {
  std::vector<ContactResultant> out(points.size());
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (response.status[r] == RowStatus::open) continue;
    const auto c = static_cast<std::size_t>(rows.source[r]);
    const Vec3& s = response.force[r];
    const auto [begin, end] = entries_of_side(rows, r, rows.is_back[r]);
    for (std::size_t k = begin; k < end; ++k) {
      const auto n = static_cast<std::size_t>(rows.node[k]);
      const RowBlock& b = rows.block[k];
      const Vec3 force = add(scaled(b[0], s[0]), add(scaled(b[1], s[1]), scaled(b[2], s[2])));
      const Vec3 x = add(mesh.coordinates[n], {u[3 * n], u[3 * n + 1], u[3 * n + 2]});
      out[c].force = add(out[c].force, force);
      out[c].moment = add(out[c].moment, cross(subtract(x, points[c]), force));
    }
  }
  return out;
}

}  // namespace carom
