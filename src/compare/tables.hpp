// The table of a comparison to be read, as CSV and as JSON.
#pragma once

#include <string>
#include <vector>

#include "compare/convergence.hpp"
#include "compare/measure.hpp"
#include "compare/observations.hpp"
#include "compare/recommend.hpp"
#include "output/data_table.hpp"

namespace carom::compare {

/// All that a comparison found.
struct Comparison {
  std::string file, title, units;
  std::string common;  ///< what all variants have in common, "" for nothing but the case
  ReferenceKind reference = ReferenceKind::exact;
  std::string quantity;  ///< by which variants are ranked
  std::vector<Result> results;
  Claims claims;
  Recommendation recommendation;

  const Result* finest() const;
  /// What the errors are against, in words.
  std::string reference_text() const;
};

/// Why variants were not compared; those of one reason together.
std::vector<Remark> failures(const Comparison& comparison);
/// What the choices brought with them; likewise.
std::vector<Remark> changes(const Comparison& comparison);
/// What strikes in the numbers (observations.hpp).
std::vector<Remark> observations(const Comparison& comparison);

/// The variants that were compared, with as many digits as are to be read.
DataTable variants_table(const Comparison& comparison);
/// What is said below it: the other variants with their reasons, what strikes in the numbers, what the errors are
/// against, the recommendation.
std::string remarks_text(const Comparison& comparison);
/// One row per variant, also of those that were not run; empty where there is no number.
std::string csv_table(const Comparison& comparison);
/// The same with the errors of every column, orders and recommendation; numbers that are not finite are null.
std::string json_table(const Comparison& comparison);

/// "passed", or the items of the verdict that failed, or why there is none.
std::string status_text(const Result& result);

}  // namespace carom::compare
