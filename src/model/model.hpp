// The model: physics on groups of the mesh. No degrees of freedom are numbered here: dof 3 n + c is component c of node
// n.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "element/formulation.hpp"
#include "material/law.hpp"
#include "material/viscosity.hpp"
#include "math/time_function.hpp"
#include "mesh/mesh.hpp"
#include "mesh/skin.hpp"
#include "model/cohesive.hpp"
#include "model/contact.hpp"
#include "model/embedding.hpp"
#include "model/options.hpp"
#include "model/surface.hpp"
#include "model/turning_body.hpp"

namespace carom {

/// Cells of one type and one material. A [[part]] of the case whose group has cells of several types is a Part for each
/// of them: one after the other, of one name.
struct Part {
  std::string name;
  std::vector<Index> cells;  ///< indices into Mesh::block(type)
  Material material;
  CellType type = CellType::hexa8;  ///< which types a section takes says solid/element_table.hpp
  Section section = Section::solid;
  double thickness = 1.0;  ///< plane cells: their thickness; bars: the area of the section; else unused
  std::optional<Formulation> formulation{};  ///< empty: the first that the element table has
  std::optional<double> hourglass{};  ///< coefficient of the hourglass stiffness; empty: 1 of stabilised cells, whose
                                      ///< stiffness is the whole one, 0.05 of one-point cells
  Viscosity viscosity{};
  double distortion_control = 0.0;  ///< share of its volume below which a corner resists (solid/distortion_control.hpp)
  Index rigid_body = -1;  ///< in Model::turning_bodies: its cells have neither forces nor mass, their nodes follow this

  /// True when the forces depend on more than the displacement.
  bool remembers() const { return !material.law->history.empty() || viscosity.is_any(); }
};

/// A rotation about an axis of fixed direction that travels: its angle is the integral of a rate, the way of the centre
/// the integral of a velocity.
struct ImposedRotation {
  Vec3 centre{};                      ///< a point of the axis at the start
  Vec3 axis{};                        ///< of length 1
  TimeFunction travel{{0.0}, {0.0}};  ///< velocity of the centre, of the component of the motion
};

/// What a rotation by the angle a does to the point X beside the way of its centre: (cos a - 1) cosine + sin a sine.
struct RotatedPoint {
  Vec3 cosine{};  ///< from the axis to X
  Vec3 sine{};    ///< axis x cosine
};
RotatedPoint rotated_point(const ImposedRotation& rotation, const Vec3& X);

/// The component (0, 1, 2) of the nodes follows function(t). Blocked components are velocity 0.
struct PrescribedMotion {
  std::string name;
  std::vector<Index> nodes;
  int component = 0;
  MotionKind kind = MotionKind::displacement;
  TimeFunction function{{0.0}, {0.0}};        ///< of a rotation: its rate, radian per time
  std::optional<ImposedRotation> rotation{};  ///< of MotionKind::rotation
};

/// The same force vector on each node of the list, or a share of it, times factor(t).
struct NodalForce {
  std::vector<Index> nodes;
  Vec3 force{};
  TimeFunction factor;
  std::vector<double> shares{};  ///< by node, 1 in all; empty: each node has the whole vector
};

/// Pressure (positive: pushes against the surface), dead load on the reference configuration.
struct Pressure {
  Surface surface;
  double pressure = 0.0;
  TimeFunction factor;
};

/// Acceleration field on all parts, times factor(t).
struct Gravity {
  Vec3 acceleration{};
  TimeFunction factor;
};

using Load = std::variant<NodalForce, Pressure, Gravity>;

/// Initial displacements and velocities of nodes; later entries overwrite earlier ones. The velocities are those at the
/// beginning of a stage, counted from 1 as the first after [scheme]; 0: the first stage with inertia.
struct InitialState {
  std::vector<Index> nodes;
  std::vector<Vec3> displacement;  ///< one for each of the nodes, one for all of them, or empty
  std::vector<Vec3> velocity;      ///< likewise
  std::size_t stage = 0;

  /// The displacement of the node at a position in `nodes`. Precondition: displacements are given.
  const Vec3& displacement_of(std::size_t k) const {
    return displacement.size() == 1 ? displacement[0] : displacement[k];
  }
  const Vec3& velocity_of(std::size_t k) const { return velocity.size() == 1 ? velocity[0] : velocity[k]; }
};

/// A linear homogeneous equation between displacements: sum over the terms of coefficient x u_component(node) = 0. The
/// first term's is the dependent one.
struct LinearEquation {
  struct Term {
    Index node = -1;
    int component = 0;
    double coefficient = 0.0;
  };
  std::string name;
  std::vector<Term> terms;
  Location where{};  ///< of the section of the case that it comes from
};

/// A rigid body that moves without turning: a node of its own with a mass.
struct RigidBody {
  std::string name;
  Index node = -1;
  double mass = 0.0;
};

/// A mass at each of the nodes, besides that of their cells.
struct PointMass {
  std::vector<Index> nodes;
  double mass = 0.0;
};

/// A linear spring between two nodes: the force stiffness x (u_0 - u_1) acts on the second and its opposite on the
/// first. The stiffness is symmetric, positive semi-definite and that of the reference configuration. A spring to the
/// ground ends in a node of its own that stands where the first does and never moves.
struct Spring {
  std::array<Index, 2> nodes{-1, -1};
  std::array<Vec3, 3> stiffness{};
};

/// Cells that go when something is reached: of the next step on they have no forces, their mass stays with their nodes.
struct Erosion {
  std::string name;                        ///< of the cells, for messages
  std::vector<Index> cells;                ///< positions among all solid cells, part after part
  std::optional<double> plastic_strain{};  ///< the largest of the cell's points
  std::optional<double> damage{};          ///< the same
  std::optional<double> distortion{};      ///< the least share of its volume at rest that a corner keeps
  std::optional<double> time{};
};

/// Everything the discrete bodies and the contact are made from.
struct Model {
  std::shared_ptr<const Mesh> mesh;
  std::vector<Part> parts;
  std::vector<PrescribedMotion> motions;
  std::vector<Load> loads;
  std::vector<InitialState> initial;
  std::vector<ContactDefinition> contacts;
  std::vector<PointMass> point_masses;
  std::vector<Spring> springs;
  std::vector<LinearEquation> equations;
  std::vector<CohesiveZone> cohesive;
  std::vector<Erosion> erosion;
  std::vector<RigidBody> rigid_bodies;
  std::vector<TurningBody> turning_bodies;
  Embedding embedding;                                      ///< of nodes in turning bodies
  std::shared_ptr<const std::vector<double>> node_lengths;  ///< of model/node_lengths.hpp, once the parts are complete
  std::shared_ptr<const std::vector<OuterFacet>> outer_facets;  ///< of the mesh (mesh/skin.hpp), where they are known
  bool is_eroded = false;          ///< cells have gone, and surfaces have facets that were inside before (Topology)
  std::vector<std::string> notes;  ///< what the log says of it

  /// The part that a cell belongs to; null: none.
  const Part* part_of(const CellRef& cell) const;
  /// The same for all cells: per block and cell the position in `parts`, or -1.
  std::vector<std::vector<Index>> part_of_cells() const;
  /// Of each of `parts` the position of its [[part]] in the case, from 0.
  std::vector<Index> part_numbers() const;
};

}  // namespace carom
