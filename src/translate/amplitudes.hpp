// *AMPLITUDE as tables over time, and what several steps do with one load as one table.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "translate/translation.hpp"

namespace carom {

/// Points (time, value), linear between them; the same time twice is a jump.
using Points = std::vector<std::pair<double, double>>;

struct Amplitude {
  const DeckKeyword* keyword = nullptr;
  Points points;
  bool is_total = false;  ///< TIME=TOTAL TIME: counts from the start of the run, not of the step
};

/// All of the deck by name in upper case; one that is wrong is 0.
std::map<std::string, Amplitude> amplitudes_of(const Statements& statements, CaseErrors& errors);

/// What a step says of a load or motion.
struct Action {
  std::size_t step = 0;
  double value = 0.0;
  const Amplitude* amplitude = nullptr;
  bool is_removed = false;
};

/// The value over time that the actions make, in the order of the steps: from 0, held where a step says nothing of it
/// unless its amplitude counts in total time, which goes on.
Points history(const std::vector<Action>& actions, const std::vector<DeckStep>& steps);

/// The value of a polygon at t; the first and last hold outside.
double value_at(const Points& points, double t);

/// When the value jumps: from 0 at the start, where a step begins with another value than that of the step before it,
/// or within an amplitude.
std::optional<double> first_jump(const Points& points, const std::vector<DeckStep>& steps);

}  // namespace carom
