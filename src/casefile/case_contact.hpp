// [[contact]]: what touches. Every kind has a struct of its own, and all of them one line in a list.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/types.hpp"
#include "casefile/located.hpp"
#include "model/cohesive.hpp"
#include "model/options.hpp"
#include "model/own_contact_law.hpp"

namespace carom {

struct CaseContact;
struct CaseScheme;

/// A contact and its place among the sections, for the rules of its kind.
struct ContactPlace {
  const CaseContact& contact;
  std::string path;  ///< "contact[2]"
};

/// The springs of a contact.
struct CaseStiffness {
  std::optional<Located<double>> stiffness;  ///< eps_N: stress per length (per node: force per length)
  double stiffness_factor = 1.0;             ///< on the stiffness that is chosen where none is given
};

/// How what touches presses and rubs.
struct CaseContactLaw : CaseStiffness {
  Located<std::vector<double>> depths, pressures;    ///< instead of the stiffness
  std::optional<Located<std::string>> friction_law;  ///< "called": a program gives called_friction
  std::shared_ptr<const FrictionLaw> called_friction{};
  std::optional<double> tangential_stiffness;
  double friction = 0.0;        ///< Coulomb mu
  Located<double> restitution;  ///< Newton's coefficient, for impulses
  /// Empty: with [initial_state], where overlaps such as penalties leave are kept, and others refused.
  std::optional<InitialPenetration> initial_penetration;
};

struct CaseInterface {
  static constexpr std::string_view kind = "interface";
  Located<std::string> group;  ///< cells
  CaseContactLaw law;

  const Located<std::string>& own_cells() const { return group; }
  void check_scheme(const CaseScheme& scheme, const ContactPlace& at) const;
};

/// What guides hold a free rigid body by.
struct CaseGuide {
  std::optional<Located<std::array<bool, 3>>> blocked, blocked_turns;  ///< along the axes; about them
  std::optional<Located<Vec3>> blocked_at;                             ///< the point that `blocked` holds

  bool holds() const { return blocked || blocked_turns; }
  bool holds_along(std::size_t axis) const { return blocked && (**blocked)[axis]; }
  bool holds_about(std::size_t axis) const { return blocked_turns && (**blocked_turns)[axis]; }
};

/// A rigid body that moves freely, and turns where it has an inertia; or, without a mass, one that is led to turn.
struct CaseRigidBody {
  std::optional<double> mass;
  std::optional<Located<Vec3>> inertia;  ///< I_xx, I_yy, I_zz about the centre of mass
  std::optional<Vec3> products_of_inertia, centre_of_mass;
  std::optional<Located<Vec3>> angular_velocity;  ///< imposed; at the start with a mass
  std::optional<Vec3> centre_of_rotation;         ///< of one that is led; filled on reading
  std::optional<double> rigidity;                 ///< of the body that turns (TurningBody)
  CaseGuide guide;
};

/// What rigid obstacles of all shapes have. `middle`, where a shape has it, is that of the shape, `middle_about` that
/// for an axis of rotation; `stand` a point of it.
struct CaseObstacle {
  Located<std::string> group;  ///< faces or nodes
  CaseContactLaw law;
  bool per_node = false;                         ///< measure = "node" instead of "area"
  std::optional<Located<double>> bar_radius;     ///< of bars that touch with their sides; empty: sqrt(area / pi)
  std::optional<Vec3> velocity;                  ///< imposed, times function; initial with a mass
  std::optional<Located<std::string>> function;  ///< of all that is imposed
  std::optional<Located<std::string>> angular_function;  ///< of the rotation, instead
  CaseRigidBody body;

  bool moves() const { return velocity || body.mass || turns(); }
  bool turns() const { return body.inertia || (body.angular_velocity && !body.mass); }
  void check_scheme(const CaseScheme& scheme, const ContactPlace& at) const;
};

struct CasePlane : CaseObstacle {
  static constexpr std::string_view kind = "plane";
  Vec3 point{};
  Located<Vec3> normal;  ///< towards the body. Normalised on reading

  Vec3 stand() const { return point; }
};

struct CaseSphere : CaseObstacle {
  static constexpr std::string_view kind = "sphere";
  Vec3 centre{};
  double radius = 0.0;
  bool inside = false;  ///< the body is inside

  Vec3 stand() const { return centre; }
  Vec3 middle() const { return centre; }
};

struct CaseCylinder : CaseObstacle {
  static constexpr std::string_view kind = "cylinder";
  Vec3 point{};
  Located<Vec3> axis;  ///< normalised on reading
  double radius = 0.0;
  bool inside = false;  ///< the body is inside

  Vec3 stand() const { return point; }
  /// Where it turns about itself.
  std::optional<Vec3> middle_about(const Vec3& direction) const;
};

struct CaseBox : CaseObstacle {
  static constexpr std::string_view kind = "box";
  Vec3 lower{};
  Located<Vec3> upper;

  Vec3 stand() const { return {}; }
  Vec3 middle() const;
};

struct CaseRigidSurface : CaseObstacle {
  static constexpr std::string_view kind = "surface";
  Located<std::string> surface;  ///< faces

  Vec3 stand() const { return {}; }
  const Located<std::string>& own_cells() const { return surface; }
};

/// What deformable surfaces that touch have, two or one with itself.
struct CaseSurfaces {
  bool is_self = false;
  std::optional<Located<PairMethod>> method;  ///< filled on reading
  std::optional<Located<bool>> smooth;        ///< empty: where no edge is sharp; filled where nothing can be smooth
  std::optional<Located<double>> bar_radius;  ///< of bars that touch with their sides; empty: sqrt(area / pi)
  CaseContactLaw law;
};

struct CasePair : CaseSurfaces {
  static constexpr std::string_view kind = "pair";
  Located<std::string> group;   ///< slave faces
  Located<std::string> master;  ///< faces of the other body
};

struct CaseSelf : CaseSurfaces {
  static constexpr std::string_view kind = "self";
  CaseSelf() { is_self = true; }
  Located<std::string> group;  ///< faces
};

struct CaseAll : CaseSurfaces {
  static constexpr std::string_view kind = "all";
  CaseAll() { is_self = true; }
  std::vector<Located<std::string>> exclude;  ///< groups whose faces take no part
};

struct CaseStop {
  static constexpr std::string_view kind = "stop";
  Located<std::string> group;  ///< nodes
  Located<Vec3> normal;        ///< from the stop to the node. Normalised on reading
  double gap = 0.0;
  double stiffness = 0.0;  ///< force per length
  double damping = 0.0;
  DamperActs damper = DamperActs::compression;

  void check_scheme(const CaseScheme& scheme, const ContactPlace& at) const;
};

struct CaseTie : CaseStiffness {
  static constexpr std::string_view kind = "tie";
  CaseTie() { torn.law.initial_penetration = InitialPenetration::strain_free_offset; }
  Located<std::string> group;   ///< slave faces
  Located<std::string> master;  ///< faces of the other body
  TieMethod method = TieMethod::node_to_surface;
  double tolerance = 0.05;         ///< largest distance from the master, in facet sizes
  std::optional<double> distance;  ///< instead of the tolerance
  FarNodes far = FarNodes::refuse;
  /// Where it tears; those of shear are the normal ones where they are absent.
  std::optional<Located<double>> normal_strength, shear_strength, normal_energy, shear_energy;
  CaseSurfaces torn;  ///< what is left of it when it has torn

  bool tears() const { return normal_strength.has_value(); }
  /// Of one that tears; its stiffness is 0 where it is chosen.
  CohesiveLaw tearing() const;
  /// The surfaces that meet where it has torn; null where it never does.
  const CaseSurfaces* left_over() const { return tears() ? &torn : nullptr; }
  CaseSurfaces* left_over() { return tears() ? &torn : nullptr; }

  void check_scheme(const CaseScheme& scheme, const ContactPlace& at) const;
};

/// The kinds there are: one line each. For X(Kind): its struct, above, with its name in case files; its keys,
/// contact_keys(), defined in a source file of its own (contact_keys.hpp).
#define CAROM_CASE_CONTACTS(X) \
  X(CaseInterface)             \
  X(CasePlane)                 \
  X(CaseSphere)                \
  X(CaseCylinder)              \
  X(CaseBox)                   \
  X(CaseRigidSurface)          \
  X(CasePair)                  \
  X(CaseSelf)                  \
  X(CaseAll)                   \
  X(CaseStop)                  \
  X(CaseTie)

namespace detail {
template <class None, class... Kinds>
struct VariantOf {
  using Type = std::variant<Kinds...>;
};
}  // namespace detail

#define CAROM_CASE_CONTACT_TYPE(Kind) , Kind
using CaseContactKind = detail::VariantOf<void CAROM_CASE_CONTACTS(CAROM_CASE_CONTACT_TYPE)>::Type;
#undef CAROM_CASE_CONTACT_TYPE

/// [[contact]]: what all kinds have, and what the one has that it is of.
struct CaseContact {
  Location where;
  Located<std::string> name;
  Located<std::string> kind;
  std::optional<Vec3> moment_point;  ///< about which contact.csv gives the moment
  std::optional<double> cfc;         ///< SAE J211 channel frequency class of its forces and moments
  CaseContactKind of;

  /// What touches, by name; "" where it has none (all).
  const Located<std::string>& group() const;
  /// The faces of the other body, by name; null where it has none.
  const Located<std::string>* master() const;
  /// The law of what touches and lets go; null for kinds without one.
  const CaseContactLaw* law() const;
  CaseContactLaw* law();
  /// The springs as far as they are a choice; null for kinds whose stiffness is all that they are.
  const CaseStiffness* springs() const;
  /// The rigid obstacle; null for other kinds.
  const CaseObstacle* obstacle() const;
  /// The surfaces that deform and touch, those of a torn tie among them; null for other kinds.
  const CaseSurfaces* surfaces() const;
  CaseSurfaces* surfaces();
  /// Cells of the mesh that are the contact's alone; null where it has none.
  const Located<std::string>* own_cells() const;
};

}  // namespace carom
