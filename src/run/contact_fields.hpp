// Contact at the nodes, and its resultants.
#pragma once

#include <span>
#include <vector>

#include "contact/response.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Means over the rows that a node feels, weighted by how much it feels them: contact pressure (force per area; force
/// on rows that are counted per node), gap (length), status (0 far from contact, 1 open, 2 sticking, 3 sliding; the
/// largest of its rows). A node that rows see from both sides (two passes, self-contact: each carries its part) has the
/// sum of both means of the pressure, and the gap of its own side. Nodes that stand for obstacles have values, too,
/// which mean nothing.
struct NodalContact {
  std::vector<double> pressure, gap, status;
};
NodalContact nodal_contact(const ContactResponse& response, std::span<const double> u);

/// Force of each contact on the body of its group, over both passes where there are two, and its moment about a point
/// (force x length), in the deformed configuration.
struct ContactResultant {
  Vec3 force{}, moment{};
};
/// points: one per contact.
std::vector<ContactResultant> contact_resultants(const ContactResponse& response, const Mesh& mesh,
                                                 std::span<const double> u, const std::vector<Vec3>& points);

}  // namespace carom
