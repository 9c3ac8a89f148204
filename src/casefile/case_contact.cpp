#include "casefile/case_contact.hpp"

#include <concepts>

#include "math/vec3.hpp"

namespace carom {

namespace {

/// The kind as the base that several share; null where it is none.
template <class Base, class Contact>
auto as(Contact& contact) {
  using Pointer = std::conditional_t<std::is_const_v<Contact>, const Base*, Base*>;
  return std::visit(
      [](auto& given) -> Pointer {
        if constexpr (std::derived_from<std::remove_cvref_t<decltype(given)>, Base>)
          return &given;
        else
          return nullptr;
      },
      contact.of);
}

template <class Contact>
auto surfaces_of(Contact& contact) {
  using Pointer = std::conditional_t<std::is_const_v<Contact>, const CaseSurfaces*, CaseSurfaces*>;
  return std::visit(
      [](auto& given) -> Pointer {
        if constexpr (std::derived_from<std::remove_cvref_t<decltype(given)>, CaseSurfaces>)
          return &given;
        else if constexpr (requires { given.left_over(); })
          return given.left_over();
        else
          return nullptr;
      },
      contact.of);
}

template <class Contact>
auto law_of(Contact& contact) {
  using Pointer = std::conditional_t<std::is_const_v<Contact>, const CaseContactLaw*, CaseContactLaw*>;
  const auto surfaces = surfaces_of(contact);
  if (surfaces != nullptr) return Pointer{&surfaces->law};
  return std::visit(
      [](auto& given) -> Pointer {
        if constexpr (requires { given.law; })
          return &given.law;
        else
          return nullptr;
      },
      contact.of);
}

}  // namespace

Vec3 CaseBox::middle() const {
  return {0.5 * (lower[0] + (*upper)[0]), 0.5 * (lower[1] + (*upper)[1]), 0.5 * (lower[2] + (*upper)[2])};
}

std::optional<Vec3> CaseCylinder::middle_about(const Vec3& direction) const {
  constexpr double parallel = 1e-9;  // of the sine of the angle: the rounding of what was written with ten digits
  const bool is_own = norm(cross(direction, *axis)) <= parallel * norm(direction) * norm(*axis);
  return is_own ? std::optional(point) : std::nullopt;
}

const Located<std::string>& CaseContact::group() const {
  static const Located<std::string> none;
  return std::visit(
      [](const auto& given) -> const Located<std::string>& {
        if constexpr (requires { given.group; })
          return given.group;
        else
          return none;
      },
      of);
}

const Located<std::string>* CaseContact::master() const {
  return std::visit(
      [](const auto& given) -> const Located<std::string>* {
        if constexpr (requires { given.master; })
          return &given.master;
        else
          return nullptr;
      },
      of);
}

const CaseContactLaw* CaseContact::law() const {
  return law_of(*this);
}
CaseContactLaw* CaseContact::law() {
  return law_of(*this);
}

const CaseStiffness* CaseContact::springs() const {
  const CaseContactLaw* given = law();
  return given != nullptr ? given : as<CaseStiffness>(*this);
}

const CaseObstacle* CaseContact::obstacle() const {
  return as<CaseObstacle>(*this);
}

const CaseSurfaces* CaseContact::surfaces() const {
  return surfaces_of(*this);
}
CaseSurfaces* CaseContact::surfaces() {
  return surfaces_of(*this);
}

const Located<std::string>* CaseContact::own_cells() const {
  return std::visit(
      [](const auto& given) -> const Located<std::string>* {
        if constexpr (requires { given.own_cells(); })
          return &given.own_cells();
        else
          return nullptr;
      },
      of);
}

}  // namespace carom
