#include "translate/amplitudes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "deck/keyword_table.hpp"

namespace carom {

namespace {

/// x^3 (10 - 15 x + 6 x^2) between each two points: first and second derivative vanish at both.
Points smooth(const Points& points) {
  constexpr int pieces = 32;
  Points result{points.front()};
  for (std::size_t i = 1; i < points.size(); ++i)
    for (int k = 1; k <= pieces; ++k) {
      const double x = static_cast<double>(k) / pieces, s = x * x * x * (10.0 + x * (6.0 * x - 15.0));
      const auto [t0, a0] = points[i - 1];
      const auto [t1, a1] = points[i];
      if (a0 == a1 && k < pieces) continue;
      result.emplace_back(k == pieces ? t1 : t0 + x * (t1 - t0), k == pieces ? a1 : a0 + s * (a1 - a0));
    }
  return result;
}

/// The lines of TABULAR and SMOOTH STEP.
Points pairs_of(const DeckKeyword& keyword) {
  Points points;
  for (DeckCursor at(keyword); at.next_line();)
    while (!at.at_end()) {
      const double time = at.real("a time");
      if (at.at_end()) at.fail("a time without a value", "pairs of time and value");
      const double value = at.real("a value");
      if (!points.empty() && time < points.back().first)
        at.fail(fmt::format("time {:g} after {:g}", time, points.back().first), "times in increasing order");
      points.emplace_back(time, value);
    }
  if (points.empty()) keyword.fail("no data", "pairs of time and value");
  return points;
}

double number_of(const DeckKeyword& keyword, const char* parameter, double otherwise) {
  const std::string* given = keyword.parameter(parameter);
  if (given == nullptr) return otherwise;
  const auto value = as_real(*given);
  if (!value) keyword.fail(fmt::format("{}={}", parameter, *given), "a time");
  return *value;
}

/// The lines of EQUALLY SPACED: values alone.
Points spaced_of(const DeckKeyword& keyword) {
  const double interval = number_of(keyword, "FIXED INTERVAL", 0.0), begin = number_of(keyword, "BEGIN", 0.0);
  if (!(interval > 0.0)) keyword.fail("no FIXED INTERVAL", "FIXED INTERVAL=TIME between the values");
  Points points;
  for (DeckCursor at(keyword); at.next_line();)
    while (!at.at_end()) points.emplace_back(begin + interval * static_cast<double>(points.size()), at.real("a value"));
  if (points.empty()) keyword.fail("no data", "values");
  return points;
}

Amplitude read_amplitude(const DeckKeyword& keyword) {
  Amplitude amplitude{&keyword, {}, false};
  const std::string* definition = keyword.parameter("DEFINITION");
  const std::string kind = definition == nullptr ? "TABULAR" : without_blanks(*definition);
  if (kind == "TABULAR")
    amplitude.points = pairs_of(keyword);
  else if (kind == "SMOOTHSTEP")
    amplitude.points = smooth(pairs_of(keyword));
  else if (kind == "EQUALLYSPACED")
    amplitude.points = spaced_of(keyword);
  else
    keyword.fail("DEFINITION=" + *definition, "TABULAR, EQUALLY SPACED or SMOOTH STEP", "Write it as a table.");
  if (const std::string* value = keyword.parameter("VALUE"); value != nullptr && upper_case(*value) != "RELATIVE")
    keyword.fail("VALUE=" + *value, "VALUE=RELATIVE", "Write the values as multiples of those of the loads.");
  if (const std::string* time = keyword.parameter("TIME")) {
    const std::string which = without_blanks(*time);
    if (which != "TOTALTIME" && which != "STEPTIME") keyword.fail("TIME=" + *time, "STEP TIME or TOTAL TIME");
    amplitude.is_total = which == "TOTALTIME";
  }
  return amplitude;
}

/// Appends a point; what lies in a straight line with its neighbours is left out.
void add_point(Points& points, double t, double value) {
  if (!points.empty() && points.back() == std::pair(t, value)) return;
  const std::size_t n = points.size();
  const bool holds = n > 1 && points[n - 1].second == value && points[n - 2].second == value;
  const bool jumps_twice = n > 1 && points[n - 1].first == t && points[n - 2].first == t;
  if (holds || jumps_twice)
    points.back() = {t, value};
  else
    points.emplace_back(t, value);
}

/// By a share of the step, and no less than what a function of time takes for rounding.
double just_after_start(const DeckStep& step) {
  return step.start + std::max(1e-9 * step.period, 1e-11 * step.start);
}

/// The value at the beginning of a step. The step before ends with its own, so that a jump between two steps comes just
/// after their common time; at the start of the run it is there from the beginning.
void begin_step(Points& points, const DeckStep& step, double before, double value) {
  if (step.start == 0.0) return add_point(points, 0.0, value);
  add_point(points, step.start, before);
  if (value != before) add_point(points, just_after_start(step), value);
}

void follow_amplitude(Points& points, const Action& action, const DeckStep& step, double before) {
  const double shift = action.amplitude->is_total ? 0.0 : step.start;
  const Points& of = action.amplitude->points;
  begin_step(points, step, before, action.value * value_at(of, step.start - shift));
  const double begun = points.back().first;
  for (const auto& [time, value] : of) {
    const double t = time + shift;
    if (t > begun && t <= step.finish()) add_point(points, t, action.value * value);
  }
  add_point(points, step.finish(), action.value * value_at(of, step.finish() - shift));
}

}  // namespace

std::map<std::string, Amplitude> amplitudes_of(const Statements& statements, CaseErrors& errors) {
  std::map<std::string, Amplitude> amplitudes;
  for (const Statement& s : statements.list) {
    if (s.keyword->name != "AMPLITUDE") continue;
    errors.attempt([&] {
      const std::string name = s.keyword->required("NAME");
      const auto [place, is_new] = amplitudes.emplace(name, Amplitude{s.keyword, {{0.0, 0.0}}, false});
      if (!is_new) s.keyword->fail("the amplitude " + name + " a second time", "a name of its own");
      place->second = read_amplitude(*s.keyword);
    });
  }
  return amplitudes;
}

double value_at(const Points& points, double t) {
  const auto after =
      std::upper_bound(points.begin(), points.end(), t, [](double x, const auto& point) { return x < point.first; });
  if (after == points.begin()) return points.front().second;
  const auto before = after - 1;
  if (after == points.end() || after->first == before->first) return before->second;
  const double x = (t - before->first) / (after->first - before->first);
  return before->second + x * (after->second - before->second);
}

Points history(const std::vector<Action>& actions, const std::vector<DeckStep>& steps) {
  Points points;
  double now = 0.0;
  Action acting;
  auto next = actions.begin();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const DeckStep& step = steps[k];
    const bool is_said = next != actions.end() && next->step == k;
    if (is_said) acting = *next++;
    const bool goes_on = acting.amplitude != nullptr && acting.amplitude->is_total;
    if (!is_said && !goes_on) continue;
    if (acting.amplitude != nullptr) {
      follow_amplitude(points, acting, step, now);
    } else {
      begin_step(points, step, now, step.ramps ? now : acting.value);
      add_point(points, step.finish(), acting.value);
    }
    now = points.back().second;
  }
  return points;
}

std::optional<double> first_jump(const Points& points, const std::vector<DeckStep>& steps) {
  double largest = 0.0;
  for (const auto& [time, value] : points) largest = std::max(largest, std::abs(value));
  const auto differ = [&](double a, double b) { return std::abs(a - b) > 1e-9 * largest; };  // beyond round-off
  if (!points.empty() && points.front().first == 0.0 && differ(points.front().second, 0.0)) return 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double before = points[i - 1].first, now = points[i].first;
    const bool is_between_steps =
        std::ranges::any_of(steps, [&](const DeckStep& step) { return now == just_after_start(step); });
    if ((now == before || is_between_steps) && differ(points[i].second, points[i - 1].second)) return before;
  }
  return std::nullopt;
}

}  // namespace carom
