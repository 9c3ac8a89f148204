#include "compare/recommend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::compare {

namespace {

std::string percent(double ratio) {
  return fmt::format("{:.3g} %", 100.0 * ratio);
}

double ranked(const Result& r, const std::string& quantity, ReferenceKind reference) {
  return reference == ReferenceKind::exact ? r.error(quantity) : r.claimed;
}

/// Positions of the variants that may be recommended.
std::vector<std::size_t> candidates(const std::vector<Result>& results, const std::string& quantity,
                                    ReferenceKind reference) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].passed() && std::isfinite(ranked(results[i], quantity, reference))) out.push_back(i);
  return out;
}

std::size_t run_count(const std::vector<Result>& results) {
  return static_cast<std::size_t>(
      std::count_if(results.begin(), results.end(), [](const Result& r) { return r.exit_code != 2; }));
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
std::string doubt(const Result& best, double error, const std::string& quantity, ReferenceKind reference) {
  if (error <= largest_error) return {};
  return fmt::format(
      "The smallest {}error of the {} is {} ({}{}), above {}: the runs differ too much to choose among them. Refine "
      "the mesh and the step.",
      reference == ReferenceKind::exact ? "" : "claimed ", quantity, percent(error), best.variant.label,
      best.basis.empty() ? "" : ": " + best.basis, percent(largest_error));
}

/// What is said where nobody can judge anybody.
Recommendation without_judge(const std::vector<Result>& results, const Claims& claims) {
  Recommendation out;
  const auto has_passed = [](const Result& r) { return r.passed(); };
  const auto has_ended = [](const Result& r) { return r.failure.empty(); };
  if (std::none_of(results.begin(), results.end(), has_ended)) {
    out.headline = "No variant could be compared, so none is recommended.";
  } else if (std::none_of(results.begin(), results.end(), has_passed)) {
    out.headline = "No variant passed every item of its verdict, so none is recommended.";
  } else {
    out.headline = "No run can judge another, so no error is claimed and none is recommended.";
    for (const std::string& missing : claims.missing) out.reasons.push_back("Missing: " + missing + ".");
    if (claims.missing.empty())
      out.reasons.emplace_back("No run on the finest cells passed that has one of the same choice on coarser cells.");
  }
  say_which_failed(results, out.reasons);
  return out;
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

Recommendation recommend(const std::vector<Result>& results, const std::string& quantity, ReferenceKind reference,
                         const Claims& claims) {
  const bool is_exact = reference == ReferenceKind::exact;
  const std::vector<std::size_t> fit = candidates(results, quantity, reference);
  if (fit.empty()) return without_judge(results, claims);
  Recommendation out;
  const auto error = [&](std::size_t i) { return ranked(results[i], quantity, reference); };
  const std::size_t best =
      *std::min_element(fit.begin(), fit.end(), [&](std::size_t a, std::size_t b) { return error(a) < error(b); });
  if (std::string reason = doubt(results[best], error(best), quantity, reference); !reason.empty()) {
    out.headline = is_exact ? "No variant comes close enough to the reference, so none is recommended."
                            : "No variant can be trusted closely enough, so none is recommended.";
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
  const std::string word = is_exact ? "error" : "claimed error";
  out.result = chosen;
  out.headline = r.variant.label;
  out.reasons.push_back(fmt::format("{} of {} variants that were run passed every item of their verdict{}.", fit.size(),
                                    run_count(results), is_exact ? "" : " and can be judged by others"));
  if (chosen == best) {
    out.reasons.push_back(
        fmt::format("Its {} of the {} is the smallest of them, {}, in {:.3g} s of processor time; none that takes "
                    "{:g} times less comes within {:g} times of it.",
                    word, quantity, percent(error(chosen)), r.cpu_seconds(), cheaper, as_good));
  } else {
    out.reasons.push_back(
        fmt::format("Its {} of the {} is {}, {:.3g} times the smallest ({}, {}), and it takes {:.3g} s of processor "
                    "time instead of {:.3g} s: it is the cheapest within {:g} times of the smallest error.",
                    word, quantity, percent(error(chosen)), error(chosen) / error(best), percent(error(best)),
                    b.variant.label, r.cpu_seconds(), b.cpu_seconds(), as_good));
  }
  if (!is_exact) out.reasons.push_back(fmt::format("The claim: {}.", r.basis));
  if (!is_exact && claims.spread > 0.0)
    out.reasons.push_back(
        fmt::format("Enforcements of contact differ by {} on the finest cells, {}: no error below that is claimed.",
                    percent(claims.spread), claims.spread_text));
  out.reasons.push_back(behaviour(r));
  if (!is_exact) out.reasons.emplace_back("What is wrong with all runs does not show in claims.");
  for (const Result& considered : results) {
    if (considered.failure.empty() && considered.has_rounding_only())
      out.reasons.push_back(fmt::format("Considered all the same: {}.", share_of_exceeding(considered)));
  }
  say_which_failed(results, out.reasons);
  return out;
}

}  // namespace carom::compare
