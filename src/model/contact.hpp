// Contact of a model: what touches, whatever it is, and the kinds that there are.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/types.hpp"
#include "mesh/mesh.hpp"
#include "model/options.hpp"
#include "model/own_contact_law.hpp"
#include "model/surface.hpp"

namespace carom {

/// What holds the rows of a contact, by what it asks of them.
enum class RowHold : std::uint8_t {
  springs,      ///< forces that grow with the gap
  impulses,     ///< what is closed does not close on
  increments,   ///< multipliers of explicit steps: the gap of the next step is closed
  multipliers,  ///< of implicit steps, beside springs or without
};

/// The law of one contact. Stiffnesses are stress per length (force per length on rows that are counted per node); an
/// absent one is chosen from the material and the size of the cells (contact/stiffness.hpp). They serve the penalty and
/// the augmented Lagrangian; exact enforcements need none.
struct ContactLaw {
  std::optional<double> eps_N;    ///< normal
  std::optional<double> eps_T;    ///< tangential (regularised friction); absent: as eps_N
  double stiffness_factor = 1.0;  ///< multiplies the chosen stiffness
  double linear_depth = std::numeric_limits<double>::infinity();  ///< below, the spring of the penalty hardens
  double mu = 0.0;                                                ///< Coulomb's coefficient
  double restitution = 0.0;                                       ///< Newton's coefficient e, for impulses
  RowHold hold = RowHold::springs;                                ///< of the stages that ask most
  std::shared_ptr<const PressureTable> pressure{};  ///< takes the place of the spring; eps_N is its largest slope
  std::shared_ptr<const FrictionLaw> friction{};    ///< multiplies mu, which is 1 then
};

/// What a row stands for: the area of its node, or the node itself (stiffness is then force per length).
enum class RowMeasure : std::uint8_t { per_area, per_node };

/// Rigid shapes in their reference position. Bodies stay outside of them (of a sphere or cylinder with `inside` set,
/// inside), or on the side of a plane to which the normal points.
struct Plane {
  Vec3 point{};
  Vec3 normal{0.0, 0.0, 1.0};
};
struct Sphere {
  Vec3 centre{};
  double radius = 0.0;
  bool inside = false;
};
struct Cylinder {  ///< endless
  Vec3 point{};
  Vec3 axis{0.0, 0.0, 1.0};
  double radius = 0.0;
  bool inside = false;
};
struct Box {  ///< axis-aligned
  Vec3 lower{}, upper{};
};
struct RigidSurface {
  Surface surface;
};
using RigidShape = std::variant<Plane, Sphere, Cylinder, Box, RigidSurface>;

/// What a contact is, beside what it consists of.
enum class ContactNature : std::uint8_t {
  touches,  ///< bodies that press on each other and let go
  bonds,    ///< what holds together: nothing is to meet, and nothing penetrates
  springs   ///< springs that are the contact itself, of any depth and in schemes that take springs alone
};

/// What a contact consists of, whatever its kind: how the rest of the program sees it.
struct ContactParts {
  ContactNature nature = ContactNature::touches;
  const Surface* own = nullptr;     ///< the facets of its group
  const Surface* other = nullptr;   ///< the deformable facets that they meet
  bool is_self = false;             ///< own and other are the same
  bool sees_both_sides = false;     ///< both sides of a pair have rows of their own, each with half of the stiffness
  std::span<const Index> nodes{};   ///< of its group where that is no surface
  std::span<const Index> cells{};   ///< HEXA8 of zero thickness
  std::span<const BarSide> bars{};  ///< of its group
  std::span<const BarSide> other_bars{};  ///< that they meet
  const RigidShape* shape = nullptr;      ///< the rigid obstacle
  Index carrier = -1, body = -1;          ///< see ObstacleContact
  std::optional<Vec3> direction{};        ///< the normal that all rows have at the start

  bool moves() const { return carrier >= 0 || body >= 0; }
};

/// Contact by HEXA8 cells whose two opposite faces coincide: traction = eps_N x penetration (force per area).
struct InterfaceContact {
  std::string name;
  std::vector<Index> cells;  ///< indices into Mesh::block(hexa8)
  ContactLaw law;
  InitialPenetration initial = InitialPenetration::refuse;

  ContactParts parts() const { return {.cells = cells}; }
};

/// A rigid obstacle. A moving one hangs on `carrier`, a node of its own whose displacement it follows (imposed by a
/// PrescribedMotion, or free with the mass of a RigidBody); -1: at rest. One that turns as well hangs on the
/// TurningBody `body`, an index in Model::turning_bodies; -1: it does not turn.
struct ObstacleContact {
  std::string name;
  RigidShape shape;
  Index carrier = -1;
  Index body = -1;
  RowMeasure measure = RowMeasure::per_area;
  std::vector<Index> nodes;   ///< nodes that may touch (per_node)
  Surface surface;            ///< facets that may touch (per_area)
  Surface loose;              ///< points: nodes that all cells have left (Topology)
  std::vector<BarSide> bars;  ///< bars that may touch with their sides (per_area)
  ContactLaw law;
  InitialPenetration initial = InitialPenetration::refuse;

  ContactParts parts() const;
};

/// Two deformable surfaces, or one with itself (`self`: slave and master are then the same facets).
struct PairContact {
  std::string name;
  Surface slave, master;
  Surface loose_slave, loose_master;             ///< points: nodes of either side that all cells have left (Topology)
  std::vector<BarSide> slave_bars, master_bars;  ///< bars instead of facets
  bool self = false;
  PairMethod method = PairMethod::two_pass;
  Smoothing smooth = Smoothing::none;  ///< with smooths(method) and springs alone
  ContactLaw law;
  InitialPenetration initial = InitialPenetration::refuse;

  ContactParts parts() const {
    return {.own = &slave,
            .other = &master,
            .is_self = self,
            .sees_both_sides = has_both_passes(method),
            .bars = slave_bars,
            .other_bars = master_bars};
  }
};

/// Discrete stop on nodes: force stiffness x penetration + damping x closing speed, tensile as far as damper_acts says.
/// The gap of a node is gap + direction . u: the node touches when it has moved by `gap` against `direction`.
struct StopContact {
  std::string name;
  std::vector<Index> nodes;
  Vec3 direction{};  ///< unit vector from the stop towards the node
  double gap = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
  DamperActs damper_acts = DamperActs::compression;

  ContactParts parts() const { return {.nature = ContactNature::springs, .nodes = nodes, .direction = direction}; }
};

/// Two surfaces that stay together, glued, as far as they are within `tolerance` (in facet sizes) of each other.
struct TieContact {
  std::string name;
  Surface slave, master;
  TieMethod method = TieMethod::node_to_surface;
  double tolerance = 0.05;
  std::optional<double> distance;  ///< takes the place of the tolerance
  FarNodes far = FarNodes::refuse;
  ContactLaw law;  ///< its stiffness alone, for schemes that tie by springs

  ContactParts parts() const { return {.nature = ContactNature::bonds, .own = &slave, .other = &master}; }
};

/// The kinds there are: one line each. For X(Kind, kind): its struct, above, with a name and its parts; its row
/// kind_row() of the table of contact/contact_kind.hpp, defined in a source file of its own.
#define CAROM_CONTACTS(X)                \
  X(InterfaceContact, interface_contact) \
  X(ObstacleContact, obstacle_contact)   \
  X(PairContact, pair_contact)           \
  X(StopContact, stop_contact)           \
  X(TieContact, tie_contact)

namespace detail {
template <class None, class... Kinds>
struct ContactVariant {
  using Type = std::variant<Kinds...>;
};
}  // namespace detail

#define CAROM_CONTACT_TYPE(Kind, kind) , Kind
using ContactDefinition = detail::ContactVariant<void CAROM_CONTACTS(CAROM_CONTACT_TYPE)>::Type;
#undef CAROM_CONTACT_TYPE

ContactParts parts_of(const ContactDefinition& contact);
const std::string& name_of(const ContactDefinition& contact);
/// Null for kinds without one.
const ContactLaw* law_of(const ContactDefinition& contact);
ContactLaw* law_of(ContactDefinition& contact);
/// What is done about overlaps at the start; `refuse` for kinds that have none.
InitialPenetration initial_of(const ContactDefinition& contact);
/// Every node of the group and of what it meets, some of them several times.
std::vector<Index> nodes_of(const ContactParts& contact, const Mesh& mesh);

}  // namespace carom
