#include "exact/solution.hpp"

#include <algorithm>
#include <cassert>

namespace carom {

namespace {

constexpr Interval above_zero{.low = 0.0}, from_zero{.low = 0.0, .is_closed_low = true};

}  // namespace

const std::vector<ExactSolution>& exact_solutions() {
#define CAROM_SOLUTION_ROW(solution) solution##_row(),
  static const std::vector<ExactSolution> rows{CAROM_EXACT_SOLUTIONS(CAROM_SOLUTION_ROW)};
#undef CAROM_SOLUTION_ROW
  return rows;
}

const ExactSolution& exact_solution(std::string_view name) {
  const auto found = std::ranges::find(exact_solutions(), name, &ExactSolution::name);
  assert(found != exact_solutions().end());
  return *found;
}

ExactParameter positive(std::string key, std::string meaning, Dimension unit) {
  return {.key = std::move(key), .meaning = std::move(meaning), .unit = unit, .range = above_zero};
}

ExactParameter not_negative(std::string key, std::string meaning, Dimension unit) {
  return {.key = std::move(key), .meaning = std::move(meaning), .unit = unit, .range = from_zero, .initial = 0.0};
}

std::vector<ExactParameter> bar_parameters() {
  return {positive("length", "Length of the bar.", Dimension::length),
          positive("area", "Section of the bar.", Dimension::area),
          positive("modulus",
                   "Stress per axial strain, E for nu = 0 or free sides, E (1 - nu) / ((1 + nu) (1 - 2 nu)) for "
                   "blocked sides.",
                   Dimension::stress),
          positive("density", "Density.", Dimension::density)};
}

ExactParameter gap_parameter() {
  return not_negative("gap", "Distance to the wall, or between the bars, at the start.", Dimension::length);
}

ExactParameter gravity_parameter() {
  return not_negative("gravity", "Acceleration of gravity.", Dimension::acceleration);
}

ElasticBar bar_of(const ExactValues& values, const std::string& section) {
  const auto value = [&](const char* key) { return values.at(section.empty() ? key : section + "." + key); };
  return {.length = value("length"),
          .modulus = value("modulus"),
          .density = value("density"),
          .area = value("area"),
          .velocity = value("speed")};
}

}  // namespace carom
