#include "rows/penalty.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/vec3.hpp"
#include "rows/admissible.hpp"

namespace carom {

namespace {

/// Everything about one row at one configuration, from which force, energies and tangent are read.
struct RowForce {
  RowStatus status = RowStatus::open;
  double penetration = 0.0;               ///< <-g>
  double stiffness = 0.0;                 ///< slope of the normal force in the penetration
  double damping = 0.0;                   ///< slope of the normal force in the closing velocity
  double pressure = 0.0;                  ///< normal force
  double share = 1.0, share_slope = 0.0;  ///< share of the step's sliding that is in contact, and its slope in the gap
  std::array<double, 2> sliding{};        ///< over the step
  std::array<double, 2> trial{};          ///< trial tangential force (on the obstacle's side: eps_T x slip)
  double trial_norm = 0.0;
  std::array<double, 2> elastic_slip{};
  double slip_work = 0.0;
};

RowForce row_force(const ConstraintRows& rows, std::size_t r, std::span<const double> x_begin,
                   std::span<const double> x, std::span<const double> v, const RowHistory& history,
                   CountedSlip counted) {
  const RowLaw& law = rows.law[r];
  RowForce out;
  if (is_bond(law)) return out;
  const Vec3 w = rows.relative(r, x);
  const double gap = rows.gap[r] + w[0];
  const bool damped = law.damping > 0.0 && rows.gap_at(r, x_begin) < 0.0;
  const bool pulls = damped && law.damper_acts == DamperActs::two_sided;
  out.penetration = std::max(0.0, -gap);
  const double damper = damped ? -law.damping * rows.relative(r, v)[0] : 0.0;
  out.pressure = (damped && !pulls && gap > 0.0 ? -law.eps_N * gap : law.spring_force(out.penetration)) + damper;
  if (!pulls) out.pressure = std::max(0.0, out.pressure);
  if (pulls ? gap < 0.0 : out.pressure > 0.0) out.stiffness = law.spring_slope(out.penetration);
  if (pulls || (damped && out.pressure > 0.0)) out.damping = law.damping;
  if (gap >= 0.0 && out.pressure == 0.0) return out;
  out.status = RowStatus::stick;
  const double limit = law.mu * out.pressure;
  if (law.eps_T == 0.0) return out;
  const Vec3 w_begin = rows.relative(r, x_begin), kept = rows.to_frame(r, history.slip);
  const double gap_begin = rows.gap[r] + w_begin[0];
  if (counted == CountedSlip::after_touch && gap_begin > 0.0 && gap < 0.0) {
    out.share = gap / (gap - gap_begin);
    out.share_slope = -gap_begin / ((gap - gap_begin) * (gap - gap_begin));
  }
  out.sliding = {w[1] - w_begin[1], w[2] - w_begin[2]};
  const std::array<double, 2> slip{kept[1] + out.share * out.sliding[0], kept[2] + out.share * out.sliding[1]};
  out.trial = {law.eps_T * slip[0], law.eps_T * slip[1]};
  out.trial_norm = std::hypot(out.trial[0], out.trial[1]);
  if (out.trial_norm <= limit) {
    out.elastic_slip = slip;
    return out;
  }
  out.status = RowStatus::slip;
  const double keep = limit / out.trial_norm;
  out.elastic_slip = {keep * slip[0], keep * slip[1]};
  out.slip_work = limit * (out.trial_norm - limit) / law.eps_T;
  return out;
}

}  // namespace

void penalty_response(std::shared_ptr<const ConstraintRows> given, std::span<const double> x_begin,
                      std::span<const double> x, std::span<const double> v, std::span<const RowHistory> history,
                      ContactResponse& response, CountedSlip slip) {
  response.rows = std::move(given);
  const ConstraintRows& rows = *response.rows;
  const std::size_t n = rows.size();
  response.force.resize(n);
  response.damper.resize(n);
  response.status.resize(n);
  response.history.assign(history.size(), {});
  response.stored = 0.0;
  response.slip_work = 0.0;
  for (std::size_t r = 0; r < n; ++r) {
    const RowLaw& law = rows.law[r];
    const auto slot = static_cast<std::size_t>(rows.slot[r]);
    const RowForce out = row_force(rows, r, x_begin, x, v, history[slot], slip);
    const std::array<double, 2>& s = out.elastic_slip;
    response.force[r] = {out.pressure, -law.eps_T * s[0], -law.eps_T * s[1]};
    response.damper[r] = out.pressure - law.spring_force(out.penetration);
    response.status[r] = out.status;
    response.history[slot].slip = rows.to_space(r, {0.0, s[0], s[1]});
    response.stored += law.spring_energy(out.penetration);
    response.stored += 0.5 * law.eps_T * (s[0] * s[0] + s[1] * s[1]);
    response.slip_work += out.slip_work;
  }
}

RowTangent penalty_tangent(const ConstraintRows& rows, std::size_t r, std::span<const double> x_begin,
                           std::span<const double> x, std::span<const double> v, std::span<const RowHistory> history,
                           double dv_dx, CountedSlip slip) {
  const RowLaw& law = rows.law[r];
  const RowForce out = row_force(rows, r, x_begin, x, v, history[static_cast<std::size_t>(rows.slot[r])], slip);
  RowTangent D{};
  if (out.status == RowStatus::open) return D;
  D[0] = out.stiffness + out.damping * dv_dx;
  const double along = out.share * law.eps_T;  // slope of the trial force in the sliding
  const std::array<double, 2> through_gap{law.eps_T * out.share_slope * out.sliding[0],
                                          law.eps_T * out.share_slope * out.sliding[1]};
  if (out.status == RowStatus::stick) {
    D[3] = through_gap[0];
    D[6] = through_gap[1];
    D[4] = D[8] = along;
    return D;
  }
  const std::array<double, 2> e{out.trial[0] / out.trial_norm, out.trial[1] / out.trial_norm};
  const double keep = law.mu * out.pressure / out.trial_norm;
  for (std::size_t i = 0; i < 2; ++i) {
    D[3 * (i + 1)] = -law.mu * D[0] * e[i];  // -d(-mu p e)/dw_N with dp/dw_N = -D[0]
    for (std::size_t j = 0; j < 2; ++j) {
      const double across = (i == j ? 1.0 : 0.0) - e[i] * e[j];
      D[3 * (i + 1)] += keep * across * through_gap[j];
      D[3 * (i + 1) + j + 1] = keep * along * across;
    }
  }
  return D;
}

void add_closed_stiffness(const ConstraintRows& rows, std::span<const double> x, std::span<double> y) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Vec3 w = rows.relative(r, x);
    const RowLaw& law = rows.law[r];
    if (is_bond(law)) continue;
    rows.scatter(r, {law.eps_N * w[0], law.eps_T * w[1], law.eps_T * w[2]}, y);
  }
}

void add_closed_diagonal(const ConstraintRows& rows, std::span<double> d) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const RowLaw& law = rows.law[r];
    const double eps_T = is_bond(law) ? law.eps_N : law.eps_T;
    for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const RowBlock& b = rows.block[k];
        d[3 * static_cast<std::size_t>(rows.node[k]) + c] +=
            law.eps_N * b[0][c] * b[0][c] + eps_T * (b[1][c] * b[1][c] + b[2][c] * b[2][c]);
      }
    }
  }
}

}  // namespace carom
