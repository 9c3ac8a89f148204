// What the energy ledger is made of: one line per term.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace carom {

/// How a term enters the balance of powers:
///   d(stored + spent) + dissipated + scheme = supplied.
/// Stored energies are functions of the state, never accumulated work, and so is what the bodies have spent, which
/// their points remember; all others are sums over the steps. Stored, spent and dissipated energies are positive when
/// the bodies hold or lose them, supplied ones when they come in, those of the scheme when it takes them out. A memo
/// says what has become of other terms and is no part of the balance.
enum class TermKind : std::uint8_t { stored, spent, dissipated, supplied, scheme, memo };

/// name, kind, definition. Members of EnergyTerms, columns of energy.csv, entries of the summary, curves of the report,
/// units of columns and the manual's table (docs/architecture.md) follow, in this order.
#define CAROM_ENERGY_TERMS(TERM)                                                                                      \
  TERM(kinetic, stored, "1/2 v.M v")                                                                                  \
  TERM(strain, stored, "integral of the stored energy density, and what springs store")                               \
  TERM(hourglass, stored, "what the stabilisation of cells with one point stores")                                    \
  TERM(distortion, stored, "what the corners of cells with distortion control store")                                 \
  TERM(contact_stored, stored, "sum over closed rows of 1/2 eps_N g^2 + 1/2 eps_T s_e^2")                             \
  TERM(plastic, spent, "integral of the dissipated energy density, a function of the points' history")                \
  TERM(fracture, spent, "what ties that tear have dissipated, a function of their damage")                            \
  TERM(hourglass_loss, spent, "what the stabilisation of yielding cells with one point has dissipated")               \
  TERM(viscous, spent, "what bulk viscosity and the viscosity of hourglass modes have dissipated")                    \
  TERM(friction, dissipated, "sum over sliding rows of friction force times slip")                                    \
  TERM(damping, dissipated, "work of the dampers of discrete stops, pulling ones included")                           \
  TERM(impact, dissipated, "what contact enforced by multipliers or impulses takes out along the normals")            \
  TERM(eroded, dissipated,                                                                                            \
       "what cells that have gone had stored and spent, and what springs of contact lost with them")                  \
  TERM(external_work, supplied, "work of forces, pressure and gravity by the trapezoidal rule")                       \
  TERM(support_work, supplied,                                                                                        \
       "work of the reactions of imposed motions: their inertia by the mean velocity times the change of momentum, "  \
       "the rest by the trapezoidal rule")                                                                            \
  TERM(algorithmic, scheme,                                                                                           \
       "what the scheme takes out, from its own discrete energy identity (Krenk, Computer Methods in Applied "        \
       "Mechanics and Engineering 195, 2006); never by subtraction")                                                  \
  TERM(quadrature, scheme,                                                                                            \
       "trapezoidal work of internal and contact forces minus the change of what they store and dissipate: zero for " \
       "linear bodies while contact does not change, O(dt^2) otherwise")                                              \
  TERM(heat, memo, "the part of plastic that has heated the bodies where it was spent, a function of the state")

/// Energies, or their increments over a step, in the unit of energy.
struct EnergyTerms {
#define CAROM_MEMBER(name, kind, definition) double name = 0.0;
  CAROM_ENERGY_TERMS(CAROM_MEMBER)
#undef CAROM_MEMBER

  EnergyTerms& operator+=(const EnergyTerms& other);
  friend bool operator==(const EnergyTerms&, const EnergyTerms&) = default;
  /// Of the terms of one kind.
  double sum(TermKind kind) const;
  /// What the bodies and the contact springs hold.
  double mechanical() const {
    return sum(TermKind::stored);
  }
  double supplied() const {
    return sum(TermKind::supplied);
  }
  double lost() const {
    return sum(TermKind::spent) + sum(TermKind::dissipated);
  }
  /// Residual of the balance of powers; zero when forces, solves and formulas agree.
  double imbalance() const {
    return mechanical() + lost() + sum(TermKind::scheme) - supplied();
  }
};

struct EnergyTerm {
  std::string_view name;
  TermKind kind;
  double EnergyTerms::*value;
  std::string_view definition;
};

inline constexpr std::array energy_terms{
#define CAROM_ROW(name, kind, definition) EnergyTerm{#name, TermKind::kind, &EnergyTerms::name, definition},
    CAROM_ENERGY_TERMS(CAROM_ROW)
#undef CAROM_ROW
};

inline EnergyTerms& EnergyTerms::operator+=(const EnergyTerms& other) {
  for (const EnergyTerm& term : energy_terms) this->*term.value += other.*term.value;
  return *this;
}

inline double EnergyTerms::sum(TermKind kind) const {
  double sum = 0.0;
  for (const EnergyTerm& term : energy_terms)
    if (term.kind == kind) sum += this->*term.value;
  return sum;
}

template <class A>
void fields(A& archive, EnergyTerms& x) {
  for (const EnergyTerm& term : energy_terms) archive(term.name, x.*term.value);
}

/// after - before of what is a function of the state, all that is stored, spent or a memo; the other terms are zero.
inline EnergyTerms change_of_state(const EnergyTerms& before, const EnergyTerms& after) {
  EnergyTerms change;
  for (const EnergyTerm& term : energy_terms)
    if (term.kind == TermKind::stored || term.kind == TermKind::spent || term.kind == TermKind::memo)
      change.*term.value = after.*term.value - before.*term.value;
  return change;
}

}  // namespace carom
