#include "enforcement/held_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rows/admissible.hpp"

namespace carom {

namespace {

/// What the springs answer more than the rest of the operator.
constexpr double stiffer = 1e3;
/// What is left of w, over the largest displacement, when an update no longer halves it.
constexpr double rounding_of_displacements = 1e-10;

}  // namespace

HeldRows::HeldRows(const System& system) : system_(system), size_(system.contact.equations().size()) {
  if (size_ == 0) return;
  first_slot_ = system.contact.equations().slot.front();
  diagonal_ = system.solid.diagonal_at_rest();
  stiffness_.resize(size_);
  multiplier_.resize(size_);
}

void HeldRows::begin(const StageStart& start) {
  const ConstraintRows& rows = system_.contact.equations();
  miss_.assign(size_, std::numeric_limits<double>::infinity());
  for (std::size_t r = 0; r < size_; ++r) {
    double compliance = 0.0;
    for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k) {
      const auto n = static_cast<std::size_t>(rows.node[k]);
      for (std::size_t c = 0; c < 3; ++c) {
        const double b = rows.block[k][0][c];
        if (b == 0.0 || system_.supports.fixed()[3 * n + c]) continue;
        compliance += start.s * b * b / (start.m * system_.mass.node_diagonal()[n] + start.c * diagonal_[3 * n + c]);
      }
    }
    stiffness_[r] = compliance > 0.0 ? stiffer / compliance : 0.0;
    const auto slot = static_cast<std::size_t>(rows.slot[r]);
    multiplier_[r] = rows.to_frame(r, start.begin->contact[slot].multiplier)[0];
  }
}

void HeldRows::respond(std::span<const double> x, ContactResponse& response) const {
  if (!any()) return;
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!is_equation(rows.law[r])) continue;
    const std::size_t k = place(rows, r);
    response.force[r] = {multiplier_[k] - stiffness_[k] * rows.relative(r, x)[0], 0.0, 0.0};
    response.status[r] = RowStatus::stick;
    response.history[static_cast<std::size_t>(rows.slot[r])].multiplier = rows.to_space(r, response.force[r]);
  }
}

void HeldRows::add_rounding(std::span<const double> x, const ContactResponse& response,
                            std::span<double> rounding) const {
  if (!any()) return;
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!is_equation(rows.law[r])) continue;
    const double force = stiffness(rows, r) * rows.rounding(r, x);
    for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        rounding[3 * static_cast<std::size_t>(rows.node[k]) + c] += force * std::abs(rows.block[k][0][c]);
  }
}

bool HeldRows::settle(std::span<const double> x, const ContactResponse& response) {
  if (!any()) return true;
  const ConstraintRows& rows = *response.rows;
  double largest = 0.0;
  for (const double u : x) largest = std::max(largest, std::abs(u));
  bool is_met = true;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!is_equation(rows.law[r])) continue;
    const std::size_t k = place(rows, r);
    const double miss = std::abs(rows.relative(r, x)[0]), before = miss_[k];
    const bool is_rounding = miss > 0.5 * before && miss <= rounding_of_displacements * largest;
    if (stiffness_[k] == 0.0 || miss <= 4.0 * rows.rounding(r, x) || is_rounding) continue;
    is_met = false;
    miss_[k] = miss;
  }
  if (is_met) return true;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (is_equation(rows.law[r])) multiplier_[place(rows, r)] = response.force[r][0];
  return false;
}

}  // namespace carom
