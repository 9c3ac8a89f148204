// Rigid bodies made of cells, and nodes that are joined to them.
#pragma once

#include <string>
#include <vector>

#include "build/groups.hpp"
#include "build/parts.hpp"
#include "casefile/case.hpp"
#include "model/model.hpp"

namespace carom {

/// The [[rigid_body]] sections of a case on its mesh. Nodes of the cells follow the four nodes of the body (Embedding);
/// those of them that other parts hold too, and the nodes that the case joins, keep their mass and are held to the body
/// by equations u_n = sum of N_a u_a.
class RigidParts {
 public:
  /// Throws CaseError for parts that are no solids or of two bodies, nodes that no part holds or two bodies have, an
  /// inertia that no body has, and what cannot stand beside rigid bodies.
  RigidParts(const Case& given, const Mesh& mesh, const Groups& groups, const Parts& parts);

  /// Where the nodes of the bodies stand, four for each. build_mesh appends them before those of obstacles.
  std::vector<Vec3> positions() const;
  /// Makes the parts rigid, and adds bodies, followers and equations; the first of the appended nodes is given.
  void add_to(Model& model, Index first);

  /// Has a body the node?
  bool hold(Index node) const { return body_of_node_[static_cast<std::size_t>(node)] >= 0; }

  /// Throws CaseError where a tie that tears ends at a rigid body. Precondition: the contacts are complete.
  void refuse_torn(const Model& model) const;
  /// Throws CaseError where two sides that do not deform meet in a contact of impulses or multipliers: what the four
  /// nodes of a body hold each other by would take the hit. Precondition: the contacts are complete.
  void refuse_rigid_contacts(const Model& model) const;

  /// What is imposed on these nodes, as imposed on unknowns: all nodes of a body give way to the four that it hangs on.
  /// Throws CaseError where some nodes of its cells, or of a body without cells, are there and others are not.
  std::vector<Index> carried(std::vector<Index> nodes, const Located<std::string>& group, const std::string& key) const;
  /// Gives what all nodes of a body begin a stage with to its four nodes and to those that are joined to it. Throws
  /// CaseError where a body would not begin as a whole or as a rigid one.
  void carry(std::vector<InitialState>& all, std::size_t stage) const;

 private:
  struct Body {
    const CaseRigidPart* given;
    TurningBody turning;
    std::vector<Index> followers, joined, points;  ///< increasing
    /// Those that stand for all of it.
    const std::vector<Index>& own() const { return !followers.empty() ? followers : !joined.empty() ? joined : points; }
  };
  void refuse_company() const;
  void refuse_attached() const;
  void add(const CaseRigidPart& given);
  void find_nodes(Body& body);
  TurningBody turning_body(const CaseRigidPart& given) const;
  std::string number(Index node) const { return mesh_.node_label(node); }

  const Case& case_;
  const Mesh& mesh_;
  const Groups& groups_;
  const Parts& parts_;
  std::vector<Index> body_of_part_;   ///< by part of the mesh, -1: deformable
  std::vector<Index> of_deformable_;  ///< by node: how many deformable parts hold it
  std::vector<Index> body_of_node_;   ///< by node, -1: none
  std::vector<Body> bodies_;
};

/// How many nodes build_mesh appends for rigid bodies.
std::size_t rigid_nodes(const Case& given);
/// Their positions. Throws CaseError as RigidParts does.
std::vector<Vec3> rigid_positions(const Case& given, const Mesh& mesh);

}  // namespace carom
