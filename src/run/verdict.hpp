// Can the numbers be trusted?
#pragma once

#include <cstdint>
#include <vector>

#include "energy/ledger.hpp"
#include "output/summary.hpp"

namespace carom {

/// Largest errors over a run, collected step by step, each relative to what it is an error of.
class RunMonitor {
 public:
  /// `mass` of all parts, and Stage::reversible_energy().
  /// Which components of momentum are balanced: all, or along y alone (axisymmetric parts).
  enum class Momenta : std::uint8_t { all, axial };
  RunMonitor(const EnergyLedger& ledger, double mass, double reversible, Momenta momenta)
      : ledger_(ledger), mass_(mass), reversible_(reversible), momenta_(momenta) {}

  /// Another scheme goes on.
  void begin_stage(double reversible) { reversible_ = reversible; }

  void update();

  /// Why the run must stop now: mechanical energy grown, or the balance of powers off, by more than 5 % of the larger
  /// of initial and supplied energy; "" while all is well. Growth that the scheme lends and takes back is none, unless
  /// it is for two steps in a row more than a stable step can lend.
  std::string alarm() const;

  /// balance of powers, quadrature, algorithmic, linear and angular momentum, penetration.
  /// angular_limit: what the error of angular momentum may be with the schemes of the run.
  std::vector<VerdictItem> items(double worst_relative_penetration, double angular_limit) const;
  double linear_momentum_error() const;
  double angular_momentum_error() const;
  /// Imbalance now, relative to the energy scale.
  double relative_imbalance() const;

 private:
  double growth() const;

  const EnergyLedger& ledger_;
  double mass_, reversible_;
  Momenta momenta_;
  double lent_ = 0.0, lent_before_ = 0.0;  ///< energy lent by the scheme, after this step and the one before
  double imbalance_ = 0.0, quadrature_ = 0.0, algorithmic_ = 0.0;  ///< largest so far, energies
  double linear_error_ = 0.0, angular_error_ = 0.0;                ///< largest so far, momenta
  double linear_scale_ = 0.0, angular_scale_ = 0.0;                ///< largest momentum or impulse so far
};

}  // namespace carom
