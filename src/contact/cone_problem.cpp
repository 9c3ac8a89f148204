#include "contact/cone_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/coulomb_block.hpp"

namespace carom::cone {

namespace {

/// Motions caused by forces count into the scale of errors up to this multiple of the given ones.
constexpr double most_amplified = 1e6;

}  // namespace

Problem::Problem(const Delassus& operator_W, std::span<const Vec3> given, std::span<const double> friction,
                 std::vector<Vec3>& force)
    : W(operator_W), b(given), mu(friction), r(force), centre_(operator_W.size()) {
  if (std::ranges::all_of(mu, [](double m) { return m == 0.0; })) {
    normal_.reserve(W.block.size());
    for (const FrameBlock& block : W.block) normal_.push_back(block[0]);
  }
  for (std::size_t i = 0; i < W.size(); ++i) {
    for (std::size_t k = W.begin[i]; k < W.begin[i + 1]; ++k) {
      if (W.column[k] == i) own_.push_back(W.block[k]);
    }
    const FrameBlock& block = own_.back();
    const double of_tangents = mu[i] > 0.0 ? std::max(block[4], block[8]) : 0.0;
    tangential_.push_back(of_tangents > 0.0 ? of_tangents : block[0]);
    compliance_.push_back(std::max(block[0], of_tangents));
  }
}

void Problem::regularise(const RowList& rows, double strength) {
  rho_ = strength;
  for (const std::size_t i : rows) centre_[i] = r[i];
}

Vec3 Problem::sum_of_blocks(std::size_t i, std::size_t left_out) const {
  Vec3 w = b[i];
  if (!normal_.empty()) {
    for (std::size_t k = W.begin[i]; k < W.begin[i + 1]; ++k)
      if (W.column[k] != left_out) w[0] += normal_[k] * r[W.column[k]][0];
    return w;
  }
  for (std::size_t k = W.begin[i]; k < W.begin[i + 1]; ++k) {
    if (W.column[k] == left_out) continue;
    const FrameBlock& B = W.block[k];
    const Vec3& s = r[W.column[k]];
    for (std::size_t a = 0; a < 3; ++a) w[a] += B[3 * a] * s[0] + B[3 * a + 1] * s[1] + B[3 * a + 2] * s[2];
  }
  return w;
}

Vec3 Problem::motion(std::size_t i) const {
  Vec3 w = sum_of_blocks(i, W.size());
  const std::size_t count = mu[i] > 0.0 ? 3 : 1;
  for (std::size_t a = 0; a < count; ++a) w[a] += added(i) * (r[i][a] - centre_[i][a]);
  return w;
}

FrameBlock Problem::own_block(std::size_t i) const {
  FrameBlock block = own_[i];
  const std::size_t count = mu[i] > 0.0 ? 3 : 1;
  for (std::size_t a = 0; a < count; ++a) block[4 * a] += added(i);
  return block;
}

double Problem::violation(std::size_t i, const Vec3& w) const {
  const double of_normal = own_[i][0];
  if (of_normal == 0.0) return std::max(0.0, -w[0]);
  const double normal = std::abs(std::min(w[0], of_normal * r[i][0]));
  if (mu[i] == 0.0) return normal;
  const double of_tangents = tangential_[i], radius = mu[i] * std::max(0.0, r[i][0]);
  const double p_1 = r[i][1] - w[1] / of_tangents, p_2 = r[i][2] - w[2] / of_tangents;
  const double length = std::hypot(p_1, p_2), keep = length > radius ? radius / length : 1.0;
  return normal + of_tangents * std::hypot(r[i][1] - keep * p_1, r[i][2] - keep * p_2);
}

double Problem::scale_of_given(const RowList& rows) const {
  double given = 0.0;
  for (const std::size_t i : rows)
    given = std::max({given, std::abs(b[i][0]), mu[i] > 0.0 ? std::hypot(b[i][1], b[i][2]) : 0.0});
  return given;
}

std::size_t Problem::worst(const RowList& rows) const {
  std::size_t where = rows.front();
  double most = -1.0;
  for (const std::size_t i : rows) {
    const double v = violation(i, sum_of_blocks(i, W.size()));
    if (v <= most) continue;
    most = v;
    where = i;
  }
  return where;
}

double Problem::scale(const RowList& rows) const {
  const double given = scale_of_given(rows);
  double caused = 0.0;
  for (const std::size_t i : rows) {
    caused = std::max(caused, own_[i][0] * r[i][0]);
    if (mu[i] > 0.0) caused = std::max(caused, tangential_[i] * std::hypot(r[i][1], r[i][2]));
  }
  return std::max(given, std::min(caused, most_amplified * given));
}

template <class Motion>
double Problem::relative_error(const RowList& rows, const Motion& motion_of) const {
  double worst = 0.0;
  for (const std::size_t i : rows) {
    const double v = violation(i, motion_of(i));
    if (!std::isfinite(v)) return infinity;
    worst = std::max(worst, v);
  }
  if (worst == 0.0) return 0.0;
  const double s = scale(rows);
  return s > 0.0 ? worst / s : infinity;
}

double Problem::error(const RowList& rows) const {
  return relative_error(rows, [this](std::size_t i) { return sum_of_blocks(i, W.size()); });
}

double Problem::proximal_error(const RowList& rows) const {
  return relative_error(rows, [this](std::size_t i) { return motion(i); });
}

double Problem::merit(const RowList& rows) const {
  double sum = 0.0;
  for (const std::size_t i : rows) {
    const double v = violation(i, motion(i));
    sum += v * v;
  }
  return sum;
}

std::vector<Vec3> Problem::forces(const RowList& rows) const {
  std::vector<Vec3> out;
  out.reserve(rows.size());
  for (const std::size_t i : rows) out.push_back(r[i]);
  return out;
}

void Problem::sweep(const RowList& rows, bool forwards) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t i = rows[forwards ? k : rows.size() - 1 - k];
    if (own_[i][0] == 0.0) continue;
    Vec3 by_others = sum_of_blocks(i, i);
    const std::size_t count = mu[i] > 0.0 ? 3 : 1;
    for (std::size_t a = 0; a < count; ++a) by_others[a] -= added(i) * centre_[i][a];
    r[i] = solve_coulomb(own_block(i), by_others, mu[i]);
  }
}

std::vector<RowList> coupled_sets(const Delassus& W) {
  std::vector<RowList> sets;
  std::vector<bool> seen(W.size(), false);
  for (std::size_t first = 0; first < W.size(); ++first) {
    if (seen[first]) continue;
    RowList set{first};
    seen[first] = true;
    for (std::size_t next = 0; next < set.size(); ++next) {
      for (std::size_t k = W.begin[set[next]]; k < W.begin[set[next] + 1]; ++k) {
        if (seen[W.column[k]] || W.block[k] == FrameBlock{}) continue;
        seen[W.column[k]] = true;
        set.push_back(W.column[k]);
      }
    }
    std::ranges::sort(set);
    sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace carom::cone
