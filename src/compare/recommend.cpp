#include "compare/recommend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/convergence.hpp"

namespace carom::compare {

namespace {

std::string percent(double ratio) {
  return fmt::format("{:.3g} %", 100.0 * ratio);
}

/// Positions of the variants that may be recommended.
std::vector<std::size_t> candidates(const std::vector<Result>& results, const std::string& quantity) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].compared() && results[i].passed() && std::isfinite(results[i].error(quantity))) out.push_back(i);
  }
  return out;
}

/// Variants that were run, the reference apart.
std::size_t run_count(const std::vector<Result>& results) {
  return static_cast<std::size_t>(std::count_if(results.begin(), results.end(),
                                                [](const Result& r) { return r.exit_code != 2 && !r.is_reference; }));
}

void say_which_failed(const std::vector<Result>& results, std::vector<std::string>& reasons) {
  for (const Result& r : results) {
    if (!r.failure.empty() || r.passed()) continue;
    reasons.push_back(
        fmt::format("Not considered: {}; its verdict fails ({}).", r.variant.label, fmt::join(r.failed_items(), ", ")));
  }
}

std::string share_of_exceeding(const Result& r) {
  return fmt::format("{}; its verdict fails by rounding alone ({})", r.variant.label,
                     fmt::join(r.failed_items(), ", "));
}

/// Why the smallest error speaks for nothing; "" when it does.
std::string doubt(const std::vector<Result>& results, std::size_t best, const std::string& quantity,
                  ReferenceKind reference) {
  const double error = results[best].error(quantity);
  if (error > largest_error)
    return fmt::format(
        "The smallest error of the {} is {} ({}), above {}: the runs differ too much from the reference to "
        "choose among them. Refine the mesh and the step, or name another reference.",
        quantity, percent(error), results[best].variant.label, percent(largest_error));
  if (error <= small_error || reference == ReferenceKind::exact) return {};
  for (const Series& s : series_along(results, Along::cells, quantity)) {
    const auto is_best = [best](const Point& p) { return p.result == best; };
    if (std::none_of(s.points.begin(), s.points.end(), is_best) || *s.order >= least_order) continue;
    return fmt::format(
        "The smallest error of the {} is {} ({}) and does not fall with the cells (order {:.2g}): the runs "
        "do not converge to the reference.",
        quantity, percent(error), results[best].variant.label, *s.order);
  }
  return {};
}

std::string behaviour(const Result& r) {
  std::string text = fmt::format("It keeps {:.5g} % of the energy", 100.0 * r.energy_kept);
  if (r.reference_peak_force > 0.0)
    text +=
        fmt::format(", its peak force is {:.3g} times that of the reference", r.peak_force / r.reference_peak_force);
  for (const VerdictItem& item : r.summary->verdict) {
    if (item.name == "penetration")
      text += fmt::format(", its largest penetration {} of the smallest cell", percent(item.value));
  }
  return text + ".";
}

}  // namespace

Recommendation recommend(const std::vector<Result>& results, const std::string& quantity, ReferenceKind reference) {
  Recommendation out;
  const std::vector<std::size_t> fit = candidates(results, quantity);
  if (fit.empty()) {
    out.headline = std::none_of(results.begin(), results.end(), [](const Result& r) { return r.compared(); })
                       ? "No variant could be compared, so none is recommended."
                       : "No variant passed every item of its verdict, so none is recommended.";
    say_which_failed(results, out.reasons);
    return out;
  }
  const auto error = [&](std::size_t i) { return results[i].error(quantity); };
  const std::size_t best =
      *std::min_element(fit.begin(), fit.end(), [&](std::size_t a, std::size_t b) { return error(a) < error(b); });
  if (std::string reason = doubt(results, best, quantity, reference); !reason.empty()) {
    out.headline = "No variant comes close enough to the reference, so none is recommended.";
    out.reasons.push_back(std::move(reason));
    say_which_failed(results, out.reasons);
    return out;
  }
  std::size_t chosen = best;
  for (const std::size_t i : fit) {
    const double cost = results[i].cpu_seconds();
    if (error(i) <= as_good * error(best) && cheaper * cost <= results[best].cpu_seconds() &&
        cost < results[chosen].cpu_seconds())
      chosen = i;
  }
  const Result &r = results[chosen], &b = results[best];
  out.result = chosen;
  out.headline = r.variant.label;
  out.reasons.push_back(fmt::format("{} of {} variants that were run passed every item of their verdict.", fit.size(),
                                    run_count(results)));
  if (chosen == best) {
    out.reasons.push_back(
        fmt::format("Its error of the {} is the smallest of them, {}, in {:.3g} s of processor time; none that takes "
                    "{:g} times less comes within {:g} times of it.",
                    quantity, percent(error(chosen)), r.cpu_seconds(), cheaper, as_good));
  } else {
    out.reasons.push_back(
        fmt::format("Its error of the {} is {}, {:.3g} times the smallest ({}, {}), and it takes {:.3g} s of processor "
                    "time instead "
                    "of {:.3g} s: it is the cheapest within {:g} times of the smallest error.",
                    quantity, percent(error(chosen)), error(chosen) / error(best), percent(error(best)),
                    b.variant.label, r.cpu_seconds(), b.cpu_seconds(), as_good));
  }
  out.reasons.push_back(behaviour(r));
  if (reference != ReferenceKind::exact) {
    out.reasons.emplace_back(
        "Errors are differences to the reference run: what is wrong with that run too does not show in them.");
  }
  for (const Result& considered : results) {
    if (considered.failure.empty() && considered.has_rounding_only())
      out.reasons.push_back(fmt::format("Considered all the same: {}.", share_of_exceeding(considered)));
  }
  say_which_failed(results, out.reasons);
  return out;
}

}  // namespace carom::compare
