// What the runs of a comparison reached, in numbers.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/variant.hpp"
#include "output/summary.hpp"
#include "report/csv_table.hpp"

namespace carom::compare {

/// Integrals over time by the trapezoidal rule on the rows; errors are quotients of them.
struct Deviation {
  double square = 0.0, reference_square = 0.0;  ///< of u - r, of r
  double magnitude = 0.0, reference_magnitude = 0.0;

  Deviation& operator+=(const Deviation& o);
  /// sqrt(int (u - r)^2 dt / int r^2 dt); NaN where the reference is zero throughout.
  double l2() const;
  /// int |u - r| dt / int |r| dt; NaN as l2.
  double l1() const;
};

/// All spans of one length.
Deviation deviation(std::span<const double> time, std::span<const double> values, std::span<const double> reference);

/// Values at the times `to`, linear between the rows, constant beyond them. Precondition: `from` does not decrease and
/// is not empty.
std::vector<double> interpolated(std::span<const double> from, std::span<const double> values,
                                 std::span<const double> to);

/// 1 minus the energy that the computation has lost (negative: made), over the larger of the initial and the largest
/// supplied energy: (mechanical(0) + supplied - friction - damping - plastic - hourglass_loss - mechanical(end)) of
/// energy.csv, where a column that is not there is zero. NaN without energy.
double energy_kept(const CsvTable& energy);

/// Errors of one column, or of all columns of one quantity together.
struct NamedError {
  std::string name;
  double l2 = 0.0, l1 = 0.0;
};

/// One variant after its run.
struct Result {
  Variant variant;
  int exit_code = -1;
  std::string failure;             ///< why there is nothing to compare; "" when the run reached its end
  std::optional<Summary> summary;  ///< when the run wrote one
  CsvTable curves;                 ///< columns of probes.csv, contact.csv and energy.csv
  std::optional<CsvTable> exact;   ///< exact.csv

  bool is_reference = false;  ///< the finest run, or the one that was named, which the others are compared with
  bool is_named = false;      ///< the one that was named
  bool is_judged = false;     ///< the reference is exact, or a run that shares nothing with this one
  std::vector<NamedError> columns, quantities;
  double peak_force = 0.0, reference_peak_force = 0.0;  ///< largest magnitude over the compared force columns
  double energy_kept = 0.0;
  double penetration = 0.0;  ///< largest over contacts and rows
  double claimed =
      std::numeric_limits<double>::quiet_NaN();  ///< what the other runs say of the error (claims.hpp); NaN: nothing
  std::string basis;                             ///< of the claim

  bool has_contact() const;
  bool compared() const { return failure.empty() && !is_reference; }
  /// Every item of the verdict, but for books that are off by rounding: they say nothing against the curves.
  bool passed() const;
  bool has_rounding_only() const;                 ///< such books are all that failed
  std::vector<std::string> failed_items() const;  ///< "quadrature 0.12 > 0.05"
  double step() const { return summary ? summary->scheme.dt_largest : 0.0; }
  double cpu_seconds() const { return summary ? summary->cost.cpu_seconds : 0.0; }
  /// The L2 error of a quantity; NaN where there is none.
  double error(const std::string& quantity) const;
};

/// What the curves are compared with: the exact solution, the run that the user named, or the finest run of the least
/// noisy scheme.
enum class ReferenceKind { exact, named, finest };

/// How much the contact forces go up and down: the sum over their steps of |f_(i+1) - f_i| over twice the largest
/// magnitude, 1 for a single rise and fall; the largest over the columns of force (of velocity where there is none).
double variation(const CsvTable& curves);

/// Reads what a run left in its folder; `log` is what it printed.
Result read_result(const Variant& variant, const std::string& folder, int exit_code, const std::string& log);

/// True where two runs have neither cells nor step, nor, where there is contact, enforcement in common.
bool shares_nothing(const Result& a, const Result& b);

/// The relative L2 difference of a quantity, on the rows of the second run; NaN where the two cannot be compared.
double difference(const Result& of, const Result& against, const std::string& quantity);

/// Fills in the errors, against exact.csv where every run that reached its end has one and `named` is empty; else
/// against the run of most cells whose label contains `named`, of those of one number of cells the one of least
/// variation (runs that passed their verdict before others), and of those the one of most steps: on its rows, the
/// others linear between theirs. Columns that are below 1e-9 of the largest of their quantity in the reference are left
/// out. Throws CaseError when no run that reached its end has the name.
ReferenceKind measure(std::vector<Result>& results, const std::string& named = "");

/// The quantity by which variants are ranked: force, else velocity, else the first that was compared; "" for none.
std::string ranking_quantity(const std::vector<Result>& results);

}  // namespace carom::compare
