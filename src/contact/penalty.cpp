#include "contact/penalty.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "math/vec3.hpp"

namespace carom {

/// Everything about one row at one configuration, from which force, energies and tangent are read.
struct Penalty::RowForce {
  RowStatus status = RowStatus::open;
  double penetration = 0.0;        ///< <-g>
  bool normal_slope_acts = false;  ///< the normal force is compressive, so that it has a slope
  double damping = 0.0;            ///< slope of the normal force in the velocity
  double pressure = 0.0;           ///< normal force
  std::array<double, 2> trial{};   ///< trial tangential force (on the obstacle's side: eps_T x slip)
  double trial_norm = 0.0;
  std::array<double, 2> elastic_slip{};
  double slip_work = 0.0;
};

Penalty::Penalty(ConstraintRows rows, std::vector<PenaltyParameters> parameters)
    : rows_(std::move(rows)), parameters_(std::move(parameters)) {
  assert(rows_.size() == parameters_.size());
}

Penalty::RowForce Penalty::row_force(std::size_t r, std::span<const double> x_begin, std::span<const double> x,
                                     std::span<const double> v, const RowHistory& history) const {
  const PenaltyParameters& row = parameters_[r];
  RowForce out;
  const Vec3 w = rows_.relative(r, x);
  const double gap = rows_.gap[r] + w[0];
  const bool damped = row.damping > 0.0 && rows_.gap[r] + rows_.relative(r, x_begin)[0] < 0.0;
  out.penetration = std::max(0.0, -gap);
  const double pressure =
      damped ? -row.eps_N * gap - row.damping * rows_.relative(r, v)[0] : row.eps_N * out.penetration;
  out.normal_slope_acts = pressure > 0.0;
  out.damping = damped ? row.damping : 0.0;
  out.pressure = std::max(0.0, pressure);
  if (gap >= 0.0 && out.pressure == 0.0) return out;
  out.status = RowStatus::stick;
  const double limit = rows_.mu[r] * out.pressure;
  if (row.eps_T == 0.0) return out;
  const Vec3 w_begin = rows_.relative(r, x_begin);
  const std::array<double, 2> slip{history.slip_1 + w[1] - w_begin[1], history.slip_2 + w[2] - w_begin[2]};
  out.trial = {row.eps_T * slip[0], row.eps_T * slip[1]};
  out.trial_norm = std::hypot(out.trial[0], out.trial[1]);
  if (out.trial_norm <= limit) {
    out.elastic_slip = slip;
    return out;
  }
  out.status = RowStatus::slip;
  const double keep = limit / out.trial_norm;
  out.elastic_slip = {keep * slip[0], keep * slip[1]};
  out.slip_work = limit * (out.trial_norm - limit) / row.eps_T;
  return out;
}

void Penalty::evaluate(std::span<const double> x_begin, std::span<const double> x, std::span<const double> v,
                       std::span<const RowHistory> history, PenaltyResponse& response) const {
  const std::size_t n = rows_.size();
  assert(history.size() == n);
  response.force.resize(n);
  response.damper.resize(n);
  response.status.resize(n);
  response.history.resize(n);
  response.stored = 0.0;
  response.slip_work = 0.0;
  for (std::size_t r = 0; r < n; ++r) {
    const PenaltyParameters& row = parameters_[r];
    const RowForce out = row_force(r, x_begin, x, v, history[r]);
    const std::array<double, 2>& s = out.elastic_slip;
    response.force[r] = {out.pressure, -row.eps_T * s[0], -row.eps_T * s[1]};
    response.damper[r] = out.pressure - row.eps_N * out.penetration;
    response.status[r] = out.status;
    response.history[r] = {s[0], s[1]};
    response.stored += 0.5 * row.eps_N * out.penetration * out.penetration;
    response.stored += 0.5 * row.eps_T * (s[0] * s[0] + s[1] * s[1]);
    response.slip_work += out.slip_work;
  }
}

void Penalty::add_force(const PenaltyResponse& response, std::span<double> f) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    if (response.status[r] != RowStatus::open) rows_.scatter(r, response.force[r], f);
  }
}

RowTangent Penalty::tangent(std::size_t r, std::span<const double> x_begin, std::span<const double> x,
                            std::span<const double> v, std::span<const RowHistory> history, double dv_dx) const {
  const PenaltyParameters& row = parameters_[r];
  const RowForce out = row_force(r, x_begin, x, v, history[r]);
  RowTangent D{};
  if (out.status == RowStatus::open) return D;
  if (out.normal_slope_acts) D[0] = row.eps_N + out.damping * dv_dx;
  if (out.status == RowStatus::stick) {
    D[4] = D[8] = row.eps_T;
    return D;
  }
  const std::array<double, 2> e{out.trial[0] / out.trial_norm, out.trial[1] / out.trial_norm};
  const double keep = rows_.mu[r] * out.pressure / out.trial_norm;
  for (std::size_t i = 0; i < 2; ++i) {
    D[3 * (i + 1)] = -rows_.mu[r] * D[0] * e[i];  // -d(-mu p e)/dw_N with dp/dw_N = -D[0]
    for (std::size_t j = 0; j < 2; ++j) {
      D[3 * (i + 1) + j + 1] = keep * row.eps_T * ((i == j ? 1.0 : 0.0) - e[i] * e[j]);
    }
  }
  return D;
}

void Penalty::add_closed_stiffness(std::span<const double> x, std::span<double> y) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Vec3 w = rows_.relative(r, x);
    const PenaltyParameters& row = parameters_[r];
    rows_.scatter(r, {row.eps_N * w[0], row.eps_T * w[1], row.eps_T * w[2]}, y);
  }
}

void Penalty::add_closed_diagonal(std::span<double> d) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const PenaltyParameters& row = parameters_[r];
    for (Index k = rows_.begin[r]; k < rows_.begin[r + 1]; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double n = rows_.normal[r][c], t1 = rows_.tangent_1[r][c], t2 = rows_.tangent_2[r][c];
        d[3 * static_cast<std::size_t>(rows_.node[k]) + c] +=
            rows_.weight[k] * rows_.weight[k] * (row.eps_N * n * n + row.eps_T * (t1 * t1 + t2 * t2));
      }
    }
  }
}

namespace {

struct ParametersOf {
  double measure;
  double tangential(const FrictionLaw& friction) const { return friction.mu > 0.0 ? friction.eps_T * measure : 0.0; }
  PenaltyParameters operator()(const InterfaceContact& c) const {
    return {c.eps_N * measure, tangential(c.friction), 0.0};
  }
  PenaltyParameters operator()(const PlaneContact& c) const { return {c.eps_N * measure, tangential(c.friction), 0.0}; }
  PenaltyParameters operator()(const StopContact& c) const { return {c.stiffness, 0.0, c.damping}; }
};

}  // namespace

std::vector<PenaltyParameters> penalty_parameters(const Model& model, const ConstraintRows& rows) {
  std::vector<PenaltyParameters> parameters;
  parameters.reserve(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    parameters.push_back(
        std::visit(ParametersOf{rows.measure[r]}, model.contacts[static_cast<std::size_t>(rows.source[r])]));
  }
  return parameters;
}

}  // namespace carom
