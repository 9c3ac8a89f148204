// A measured curve of stress over strain, to be laid over that of a law.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace carom {

struct MeasuredCurve {
  std::vector<double> strain, stress;
};

/// Rows "strain,stress"; lines that begin with # and a first line of names are passed over. Throws CaseError with the
/// line.
MeasuredCurve read_measured(const std::string& path);

/// Root mean square of the stress of the law, straight between its points, less the measured one; only where the law's
/// strain rises from the first point on. Nothing measured lies there: not a number.
double rms_difference(const MeasuredCurve& measured, std::span<const double> strain, std::span<const double> stress);

}  // namespace carom
