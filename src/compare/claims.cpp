#include "compare/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace carom::compare {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool differ_by_cells_alone(const Result& a, const Result& b) {
  Choice one = a.variant.varied, other = b.variant.varied;
  one.cells = other.cells;
  one.refine = other.refine;
  return one == other && a.variant.scheme == b.variant.scheme && a.variant.cells != b.variant.cells;
}

class Judge {
 public:
  Judge(std::vector<Result>& results, const std::string& quantity) : quantity_(quantity) {
    for (Result& r : results) {
      r.claimed = unknown;
      r.basis.clear();
      if (!r.passed() || r.curves.rows() == 0) continue;
      runs_.push_back(&r);
      finest_ = std::max(finest_, r.variant.cells);
      coarsest_ = std::min(coarsest_, r.variant.cells);
    }
  }

  Claims run() {
    Claims claims;
    if (runs_.empty()) return claims;
    measure_spread(claims);
    if (finest_ == coarsest_)
      claims.missing.emplace_back("all runs have the same cells: add --refine 0,1,2, or --cells of several sizes");
    if (runs_.front()->has_contact() && std::isnan(claims.spread))
      claims.missing.emplace_back(
          "contact is enforced in one way on the finest cells: add --enforcement, or a --scheme that takes another "
          "one");
    if (!claims.missing.empty()) return claims;
    for (Result* r : runs_)
      if (r->variant.cells == finest_) claim_by_own_meshes(*r, claims.spread);
    for (Result* r : runs_)
      if (r->variant.cells != finest_) claim_by_others(*r, claims.spread);
    return claims;
  }

 private:
  double difference_between(const Result& a, const Result& b) {
    const auto [entry, is_new] = differences_.try_emplace({&a, &b}, 0.0);
    if (is_new) entry->second = difference(a, b, quantity_);
    return entry->second;
  }

  void measure_spread(Claims& claims) {
    claims.spread = runs_.front()->has_contact() ? unknown : 0.0;
    std::map<std::set<std::string>, std::pair<double, std::string>> nearest;
    for (const Result* a : runs_)
      for (const Result* b : runs_) {
        if (a->variant.cells != finest_ || b->variant.cells != finest_) continue;
        if (!a->has_contact() || a->variant.enforcement == b->variant.enforcement) continue;
        const double d = difference_between(*a, *b);
        if (!std::isfinite(d)) continue;
        auto& least = nearest.try_emplace({a->variant.enforcement, b->variant.enforcement}, INFINITY, "").first->second;
        if (d < least.first)
          least = {d, fmt::format("{} ({}) and {} ({})", a->variant.enforcement, a->variant.label,
                                  b->variant.enforcement, b->variant.label)};
      }
    for (const auto& [names, least] : nearest) {
      if (claims.spread >= least.first) continue;
      claims.spread = least.first;
      claims.spread_text = least.second;
    }
  }

  /// The farthest of the other enforcements, each by its nearest run.
  double disagreement(const Result& r) {
    std::map<std::string, double> nearest;
    for (const Result* other : runs_) {
      if (other->variant.cells != finest_ || !r.has_contact()) continue;
      if (other->variant.enforcement == r.variant.enforcement) continue;
      double& least = nearest.try_emplace(other->variant.enforcement, INFINITY).first->second;
      least = std::fmin(least, difference_between(r, *other));
    }
    double most = 0.0;
    for (const auto& [name, least] : nearest) most = std::max(most, least);
    return most;
  }

  void claim_by_own_meshes(Result& r, double spread) {
    std::vector<const Result*> own;
    for (const Result* other : runs_)
      if (differ_by_cells_alone(*other, r)) own.push_back(other);
    if (own.empty()) return;
    std::sort(own.begin(), own.end(),
              [](const Result* a, const Result* b) { return a->variant.cells > b->variant.cells; });
    const double change = difference_between(*own[0], r);
    const double ratio = static_cast<double>(r.variant.cells) / own[0]->variant.cells;
    double order = 1.0, safety = 3.0;
    if (own.size() > 1) {
      const double coarser = static_cast<double>(own[0]->variant.cells) / own[1]->variant.cells;
      order = std::log(difference_between(*own[1], *own[0]) / change) / std::log(coarser);
      safety = order > 0.0 ? 1.25 : 3.0;
      order = order > 0.0 ? std::clamp(order, 0.5, 1.0) : 0.5;
    }
    const double by_cells = safety * change / (std::pow(ratio, order) - 1.0), apart = disagreement(r);
    r.claimed = std::max({by_cells, apart, spread});
    r.basis = fmt::format("it changes by {:.3g} % from {} to {} cells, taken {:.3g} times", 100.0 * change,
                          own[0]->variant.cells, r.variant.cells, safety / (std::pow(ratio, order) - 1.0));
    if (by_cells < r.claimed) r.basis = fmt::format("other enforcements are {:.3g} % away", 100.0 * r.claimed);
  }

  void claim_by_others(Result& r, double spread) {
    const bool is_named = std::any_of(runs_.begin(), runs_.end(), [](const Result* other) { return other->is_named; });
    for (const Result* judge : runs_) {
      if (!shares_nothing(r, *judge) || (is_named ? !judge->is_named : judge->variant.cells != finest_)) continue;
      if (!is_named && !std::isfinite(judge->claimed)) continue;
      const double own = std::isfinite(judge->claimed) ? judge->claimed : 0.0;
      const double apart = difference_between(r, *judge), claim = std::max(apart + own, spread);
      if (!std::isfinite(claim) || claim >= r.claimed) continue;  // nothing is below a claim that is not there
      r.claimed = claim;
      r.basis = fmt::format("it is {:.3g} % away from {}, which claims {:.3g} % itself", 100.0 * apart,
                            judge->variant.label, 100.0 * own);
    }
  }

  const std::string quantity_;
  std::vector<Result*> runs_;
  std::map<std::pair<const Result*, const Result*>, double> differences_;
  int finest_ = 0, coarsest_ = std::numeric_limits<int>::max();
};

}  // namespace

Claims claim_errors(std::vector<Result>& results, const std::string& quantity) {
  return Judge(results, quantity).run();
}

}  // namespace carom::compare
