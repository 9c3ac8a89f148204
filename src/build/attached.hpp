// What hangs on nodes of bodies: point masses and springs.
#pragma once

#include <vector>

#include "build/groups.hpp"
#include "build/parts.hpp"
#include "casefile/case.hpp"
#include "mesh/mesh.hpp"
#include "model/model.hpp"

namespace carom {

/// Where springs to the ground end: at the reference positions of their nodes, in the order of the springs. build_mesh
/// appends one node for each, before those of the obstacles. Throws CaseError for groups that the mesh does not have.
std::vector<Vec3> ground_positions(const Case& given, const Mesh& mesh);

/// Adds the point masses and springs of the case to the model, the springs' ground nodes being those from `ground` on.
/// Throws CaseError for nodes without mass and for springs whose ends coincide or do not match in number.
void add_attached(const Case& given, const Mesh& mesh, const Groups& groups, const Parts& parts, Index ground,
                  Model& model);

/// A group of nodes that something attached hangs on.
struct AttachedGroup {
  const Located<std::string>& group;
  const char* key;     ///< of the case, for messages
  const char* what;    ///< hangs there: "a spring"
  const char* remedy;  ///< where a rigid body holds the nodes
};

/// Those of all attached things, in the order of the case.
std::vector<AttachedGroup> attached_groups(const Case& given);

/// True when a point mass of the model stands at the node.
bool has_point_mass(const Model& model, Index node);

}  // namespace carom
