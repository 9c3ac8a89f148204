#include "compare/observations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "compare/convergence.hpp"

namespace carom::compare {

namespace {

bool are_equal(const Result& a, const Result& b, const std::string& quantity) {
  constexpr double nothing = 1e-6;  // not seen in tables
  if (a.curves.rows() == 0 || a.curves.rows() != b.curves.rows()) return false;
  return a.curves.values == b.curves.values || difference(a, b, quantity) <= nothing;
}

/// Groups of at least two.
std::vector<std::vector<const Result*>> equal_groups(const std::vector<Result>& results, const std::string& quantity) {
  std::vector<std::vector<const Result*>> groups;
  for (const Result& r : results) {
    if (!r.failure.empty()) continue;
    const auto same =
        std::ranges::find_if(groups, [&](const auto& group) { return are_equal(*group.front(), r, quantity); });
    (same != groups.end() ? *same : groups.emplace_back()).push_back(&r);
  }
  std::erase_if(groups, [](const auto& group) { return group.size() < 2; });
  return groups;
}

std::string why_equal(const std::vector<const Result*>& group) {
  const Result& first = *group.front();
  const auto differ = [&](const auto& value_of) {
    return std::ranges::any_of(group, [&](const Result* r) { return value_of(*r) != value_of(first); });
  };
  std::vector<std::string> same, idle;
  const auto sort = [&](const char* name, bool differs) { (differs ? idle : same).emplace_back(name); };
  sort("mesh", differ([](const Result& r) { return r.variant.cells; }));
  sort("step", differ([](const Result& r) { return r.step(); }));
  const bool by_enforcement = differ([](const Result& r) { return r.variant.enforcement; });
  if (by_enforcement) idle.emplace_back("enforcement");
  if (differ([](const Result& r) { return r.variant.scheme; })) idle.emplace_back("scheme");
  if (differ([](const Result& r) { return r.variant.choice.stiffness; })) idle.emplace_back("stiffness");
  if (differ([](const Result& r) { return r.variant.choice.courant; })) idle.emplace_back("Courant number");
  std::string text = fmt::format("are equal throughout: they have the same {}", fmt::join(same, " and the same "));
  if (idle.empty()) return text + ", and their choices come to the same case";
  text += fmt::format(", and the {} changes nothing here", fmt::join(idle, " or the "));
  const bool touches = std::ranges::any_of(group, [](const Result* r) { return r->peak_force > 0.0; });
  if (by_enforcement && !first.has_contact()) text += ", since the case has no contact";
  if (by_enforcement && first.has_contact() && !touches) text += ", since nothing touches";
  return text;
}

/// Of the pair of points that begins at k, from coarse to fine.
double order_between(const Point& coarse, const Point& fine) {
  const std::array<double, 2> x{coarse.x, fine.x}, y{coarse.y, fine.y};
  return std::abs(slope(x, y).value_or(0.0)) * (fine.y < coarse.y ? 1.0 : -1.0);
}

std::string worsening(std::vector<Point> points, Along along, const std::string& quantity) {
  constexpr double noise = 0.01;  // of an error, less is none
  if (along == Along::step) std::ranges::reverse(points);
  const Point &coarse = points[points.size() - 2], &fine = points.back();
  const char* what = along == Along::cells ? "cells" : "step";
  const char* other = along == Along::cells
                          ? "something else than the mesh makes it (the step where the case fixes it, which --courant "
                            "lets follow the cells; the stiffness of contact; facets of a round body)"
                          : "something else than the step makes it (the mesh, or waves that it cannot carry and that "
                            "shorter steps damp less)";
  const std::string last = fmt::format("from {} {:.3g} to {:.3g}", what, coarse.x, fine.x);
  if (fine.y > (1.0 + noise) * coarse.y)
    return fmt::format("the error of the {} grows {}, from {:.3g} % to {:.3g} %: {}", quantity, last, 100.0 * coarse.y,
                       100.0 * fine.y, other);
  const double at_first = order_between(points[0], points[1]), at_last = order_between(coarse, fine);
  if (points.size() < 3 || at_first <= 0.0 || at_last >= 0.5 * at_first) return {};
  return fmt::format("the order of the error of the {} falls from {:.2g} ({} {:.3g} to {:.3g}) to {:.2g} ({}): {}",
                     quantity, at_first, what, points[0].x, points[1].x, at_last, last, other);
}

}  // namespace

std::vector<Remark> equal_runs(const std::vector<Result>& results, const std::string& quantity) {
  std::vector<Remark> remarks;
  for (const auto& group : equal_groups(results, quantity)) {
    std::vector<std::string> labels;
    for (const Result* r : group) labels.push_back(r->variant.label);
    remarks.push_back({fmt::format("{}", fmt::join(labels, "; ")), why_equal(group)});
  }
  return remarks;
}

std::vector<Remark> worsening_orders(const std::vector<Result>& results, const std::string& quantity) {
  std::vector<Remark> remarks;
  for (const Along along : {Along::cells, Along::step})
    for (const Series& s : series_along(results, along, quantity))
      if (std::string text = worsening(s.points, along, quantity); !text.empty()) remarks.push_back({s.name, text});
  return remarks;
}

}  // namespace carom::compare
