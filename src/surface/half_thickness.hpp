// The thickness of bodies behind the facets of their own skin.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/facet.hpp"

namespace carom {

/// Half of the least of `limit` and the thickness of the body behind each facet of its skin; deeper points would be
/// taken for points of the far side. The thickness is the lesser of
/// - the length of the ray from the facet's centre inwards to the next facet,
/// - the distance of the nearest node of the same body that is behind the facet's plane, whose averaged normal opposes
///   the facet's (n . n_f < 0.3, more than contact asks for, since bodies deform) and whose facets do not hang together
///   with the facet: beside the tip of a wedge that is less than what stands behind the centre.
/// `body`: by node, equal for what hangs together (bodies_of_nodes); -1 or empty: known by the skin alone.
std::vector<double> half_thickness(std::span<const Vec3> coordinates, const std::vector<Facet>& skin,
                                   std::span<const Index> body, double limit);

}  // namespace carom
