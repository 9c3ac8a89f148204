#include "march/energy_guard.hpp"

#include <algorithm>
#include <cmath>

#include "rows/admissible.hpp"

namespace carom {

namespace {

constexpr double by_contact = 2e-4, otherwise = 2e-3, lent = 1e-2, in_all = 5e-4;  // of the energy scale
constexpr double shortest_cut = 1.0 / 16.0, least_share = 1.0 / 16.0;

/// Energy that rows misplace which close or open within this fraction of the step, their gaps changing evenly.
double misplaced(const ConstraintRows& rows, const State& begin, const State& end, double fraction) {
  double sum = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (is_bond(rows.law[r])) continue;
    const double before = rows.gap_at(r, begin.q), after = before + fraction * (rows.gap_at(r, end.q) - before);
    if (before * after < 0.0) sum += (before < 0.0 ? 1.0 : -1.0) * 0.5 * rows.law[r].eps_N * std::abs(before * after);
  }
  return std::abs(sum);
}

/// True when the step has made energy that no change of contact explains, or is not finite.
bool is_unstable(const EnergyGuard::Books& books) {
  return !(-books.quadrature <= otherwise * books.scale) || !(-books.algorithmic <= lent * books.scale);
}

}  // namespace

void EnergyGuard::shorten() {
  share_ = std::max(least_share, share_ * std::sqrt(0.5));
  if (has_grown_) wait_ *= 2;
  has_grown_ = false;
  quiet_ = 0;
}

void EnergyGuard::grow() {
  if (share_ == 1.0 || ++quiet_ < wait_) return;
  share_ = std::min(1.0, share_ * std::sqrt(std::sqrt(2.0)));
  has_grown_ = true;
  quiet_ = 0;
}

std::optional<double> EnergyGuard::cut(const State& begin, const State& end, const ContactResponse& response,
                                       const Books& books) {
  constexpr int most_cuts = 8;
  if (cuts_ == most_cuts || !(books.scale > 0.0)) return std::nullopt;
  double fraction = 1.0;
  if (std::abs(books.quadrature) > by_contact * books.scale) {
    while (fraction > shortest_cut && misplaced(*response.rows, begin, end, fraction) > 0.5 * by_contact * books.scale)
      fraction *= 0.8;
  }
  const bool by_closing = fraction < 1.0 && cuts_ == 0;  // once: what is left comes from rows that others push
  if (!by_closing && !is_unstable(books)) return std::nullopt;
  if (!by_closing) {
    fraction = 0.5;
    if (!shortened_) shorten();
    shortened_ = true;
  }
  ++cuts_;
  return fraction;
}

bool EnergyGuard::gains_too_much(const Books& books) {
  constexpr int most_cuts = 4;
  const double gain = -books.quadrature, allowed = in_all * books.scale;
  if (cuts_ == most_cuts || gain <= allowed || net_ + gain <= allowed_ + allowed) return false;
  ++cuts_;
  return true;
}

void EnergyGuard::accept(const Books& books) {
  cuts_ = 0;
  shortened_ = false;
  net_ -= books.quadrature;
  if (net_ <= allowed_ + in_all * books.scale) {
    grow();
    return;
  }
  allowed_ = net_;
  shorten();
}

}  // namespace carom
