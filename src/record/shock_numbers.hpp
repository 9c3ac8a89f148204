// What probes' accelerations do to what they shake, from the tables of a run, after its end.
#pragma once

#include <string>
#include <vector>

#include "base/units.hpp"
#include "output/summary.hpp"

namespace carom {

/// Columns <probe>.<quantity>_x, _y and _z that ask for it.
struct ShockWish {
  std::string probe, quantity;
  double cfc = 0.0;  ///< class of its filter; 0: none
  double quality_factor = 10.0;
};

/// The tables that have them, and the one that is made.
struct ShockTables {
  std::string raw, filtered, spectra;  ///< files
  std::vector<std::string> comments;   ///< the first lines
  UnitSystem units = UnitSystem::si;
};

/// Takes each record filtered where it has been, else as it is, on equal intervals of time. Writes the shock response
/// spectra of its components: natural frequencies, up to the class, or to 10 kHz without one, and to 20 samples to a
/// period (beyond: nan), in cycles per unit of time. Nothing of records of less than three rows.
std::vector<ShockSummary> write_shock(const ShockTables& tables, const std::vector<ShockWish>& wishes);

}  // namespace carom
