// The model: physics on groups of the mesh. No degrees of freedom are numbered here: dof 3 n + c is component c of node
// n.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/types.hpp"
#include "material/linear_elastic.hpp"
#include "math/time_function.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Parameters of a material law; one alternative per law.
using Material = std::variant<LinearElastic>;

/// Cells of one material. The cells are HEXA8; indices into Mesh::block(hexa8).
struct Part {
  std::string name;
  std::vector<Index> cells;
  Material material;
};

/// What is imposed on one component of a group of nodes.
enum class MotionKind : std::uint8_t { displacement, velocity, acceleration };

/// The component (0, 1, 2) of the nodes follows function(t). Blocked components are velocity 0.
struct PrescribedMotion {
  std::string name;
  std::vector<Index> nodes;
  int component = 0;
  MotionKind kind = MotionKind::displacement;
  TimeFunction function{{0.0}, {0.0}};
};

/// The same force vector on each node of the list, times factor(t).
struct NodalForce {
  std::vector<Index> nodes;
  Vec3 force{};
  TimeFunction factor;
};

/// Pressure (positive: pushes against the face) on QUAD4 faces, dead load on the reference configuration.
/// Faces are four node indices, their normal (right-hand rule) pointing out of the body.
struct Pressure {
  std::vector<std::array<Index, 4>> faces;
  double pressure = 0.0;
  TimeFunction factor;
};

/// Acceleration field on all parts, times factor(t).
struct Gravity {
  Vec3 acceleration{};
  TimeFunction factor;
};

using Load = std::variant<NodalForce, Pressure, Gravity>;

/// Initial displacement and velocity of nodes; later entries overwrite earlier ones.
struct InitialState {
  std::vector<Index> nodes;
  std::optional<Vec3> displacement, velocity;
};

/// Regularised Coulomb friction: tangential stiffness eps_T and coefficient mu; none when either is 0.
struct FrictionLaw {
  double eps_T = 0.0;
  double mu = 0.0;
};

/// Contact by HEXA8 cells whose two opposite faces coincide: traction = eps_N x penetration (force per area).
struct InterfaceContact {
  std::string name;
  std::vector<Index> cells;  ///< indices into Mesh::block(hexa8)
  double eps_N = 0.0;        ///< stress per length
  FrictionLaw friction;      ///< eps_T: stress per length
};

/// What a penalty stiffness is counted per: stress per length on faces, or force per length on each node.
enum class PenaltyMeasure : std::uint8_t { per_area, per_node };

/// Rigid plane through `point`; the body is on the side to which `normal` points.
struct PlaneContact {
  std::string name;
  Vec3 point{};
  Vec3 normal{0.0, 0.0, 1.0};
  PenaltyMeasure measure = PenaltyMeasure::per_area;
  std::vector<Index> nodes;                 ///< nodes that may touch (per_node)
  std::vector<std::array<Index, 4>> faces;  ///< faces that may touch (per_area)
  double eps_N = 0.0;
  FrictionLaw friction;
};

/// Discrete stop on nodes: force stiffness x penetration + damping x closing speed, never tensile.
/// The gap of a node is gap + direction . u: the node touches when it has moved by `gap` against `direction`.
struct StopContact {
  std::string name;
  std::vector<Index> nodes;
  Vec3 direction{};  ///< unit vector from the stop towards the node
  double gap = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
};

using ContactDefinition = std::variant<InterfaceContact, PlaneContact, StopContact>;

/// Everything the discrete bodies and the contact are made from.
struct Model {
  std::shared_ptr<const Mesh> mesh;
  std::vector<Part> parts;
  std::vector<PrescribedMotion> motions;
  std::vector<Load> loads;
  std::vector<InitialState> initial;
  std::vector<ContactDefinition> contacts;
};

}  // namespace carom
