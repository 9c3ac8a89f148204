// The energy ledger: typed increments of every energy, closed at every step.
#pragma once

#include <array>
#include <cmath>

#include "base/types.hpp"
#include "energy/energy_terms.hpp"

namespace carom {

/// The same books in Code_Aster's terms (U4.84 ENERGIE), accumulated from zero at the start.
struct AsterTerms {
  double ENER_CIN = 0.0;   ///< sum of v_bar . M dv
  double ENER_TOT = 0.0;   ///< sum of F_int_bar . du
  double TRAV_EXT = 0.0;   ///< sum of F_ext_bar . du, reactions of imposed motions included
  double TRAV_AMOR = 0.0;  ///< work of structural damping
  double TRAV_LIAI = 0.0;  ///< work of contact forces, counted on the internal side

  AsterTerms& operator+=(const AsterTerms& o) {
    ENER_CIN += o.ENER_CIN;
    ENER_TOT += o.ENER_TOT;
    TRAV_EXT += o.TRAV_EXT;
    TRAV_AMOR += o.TRAV_AMOR;
    TRAV_LIAI += o.TRAV_LIAI;
    return *this;
  }
  /// Dissipated by the scheme: TRAV_EXT - ENER_CIN - ENER_TOT - TRAV_AMOR - TRAV_LIAI.
  double DISS_SCH() const { return TRAV_EXT - ENER_CIN - ENER_TOT - TRAV_AMOR - TRAV_LIAI; }
};

template <class A>
void fields(A& archive, AsterTerms& x) {
  archive("ENER_CIN", x.ENER_CIN);
  archive("ENER_TOT", x.ENER_TOT);
  archive("TRAV_EXT", x.TRAV_EXT);
  archive("TRAV_AMOR", x.TRAV_AMOR);
  archive("TRAV_LIAI", x.TRAV_LIAI);
}

/// As columns and entries of the summary.
inline constexpr std::array<std::string_view, 6> aster_names{"ENER_CIN",  "ENER_TOT",  "TRAV_EXT",
                                                             "TRAV_AMOR", "TRAV_LIAI", "DISS_SCH"};
inline std::array<double, 6> aster_values(const AsterTerms& a) {
  return {a.ENER_CIN, a.ENER_TOT, a.TRAV_EXT, a.TRAV_AMOR, a.TRAV_LIAI, a.DISS_SCH()};
}

/// Linear momentum, and angular momentum about the origin: of the reference positions where all bodies are linear, else
/// of the current ones.
struct Momentum {
  Vec3 linear{};
  Vec3 angular{};
  friend bool operator==(const Momentum&, const Momentum&) = default;
};

template <class A>
void fields(A& archive, Momentum& x) {
  archive("linear", x.linear);
  archive("angular", x.angular);
}

/// What one step adds to the books.
struct LedgerIncrement {
  EnergyTerms energy;
  AsterTerms aster;
  Momentum impulse;  ///< of external, contact and support forces, in the scheme's weights
  /// Of the free dofs: the impulse of their forces by the trapezoidal rule less the change of their momentum. Who moves
  /// at the velocity w sees algorithmic - w . lag.
  Vec3 lag{};
};

/// The running totals of a run.
class EnergyLedger {
 public:
  /// initial: stored energies and momentum at the start; the other terms start at zero. reach: largest distance of a
  /// node from the origin, the arm with which errors of angular momentum are judged.
  EnergyLedger(const EnergyTerms& initial, const Momentum& momentum, double reach)
      : initial_(initial), initial_momentum_(momentum), momentum_(momentum), reach_(reach) {}

  /// Adds a step; `momentum` is that of the new state.
  void add(const LedgerIncrement& step, const Momentum& momentum) {
    total_ += step.energy;
    aster_ += step.aster;
    for (std::size_t c = 0; c < 3; ++c) {
      impulse_.linear[c] += step.impulse.linear[c];
      impulse_.angular[c] += step.impulse.angular[c];
    }
    momentum_ = momentum;
    supplied_peak_ = std::fmax(supplied_peak_, std::fabs(total_.supplied()));
  }

  /// Velocities that the case gives to a stage count as if they had been there from the start.
  void give(double kinetic, const Momentum& momentum) {
    initial_.kinetic += kinetic;
    for (std::size_t c = 0; c < 3; ++c) {
      initial_momentum_.linear[c] += momentum.linear[c];
      initial_momentum_.angular[c] += momentum.angular[c];
    }
  }

  /// Stored energies as they stand, and the sums of all others.
  EnergyTerms now() const {
    EnergyTerms terms = total_;
    terms += initial_;
    return terms;
  }
  const EnergyTerms& initial() const { return initial_; }
  const AsterTerms& aster() const { return aster_; }
  const Momentum& momentum() const { return momentum_; }
  const Momentum& initial_momentum() const { return initial_momentum_; }
  const Momentum& impulse() const { return impulse_; }
  double reach() const { return reach_; }

  /// Residual of the balance of powers since the start.
  double imbalance() const { return total_.imbalance(); }
  /// The larger of the initial energy and the largest supplied energy so far: what errors are compared with.
  double scale() const { return std::fmax(initial_.mechanical(), supplied_peak_); }
  /// Mechanical energy above what was there and what was supplied.
  double growth() const { return total_.mechanical() - total_.supplied(); }
  /// Change of momentum minus the impulses.
  Momentum momentum_error() const {
    Momentum error;
    for (std::size_t c = 0; c < 3; ++c) {
      error.linear[c] = momentum_.linear[c] - initial_momentum_.linear[c] - impulse_.linear[c];
      error.angular[c] = momentum_.angular[c] - initial_momentum_.angular[c] - impulse_.angular[c];
    }
    return error;
  }

 private:
  template <class A>
  friend void fields(A& archive, EnergyLedger& x) {
    archive("initial", x.initial_);
    archive("total", x.total_);
    archive("aster", x.aster_);
    archive("initial_momentum", x.initial_momentum_);
    archive("momentum", x.momentum_);
    archive("impulse", x.impulse_);
    archive("reach", x.reach_);
    archive("supplied_peak", x.supplied_peak_);
  }

  EnergyTerms initial_, total_;
  AsterTerms aster_;
  Momentum initial_momentum_, momentum_, impulse_;
  double reach_ = 0.0;
  double supplied_peak_ = 0.0;
};

}  // namespace carom
