#include "rows/cone_problem.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "rows/coulomb_block.hpp"

namespace carom::cone {

namespace {

/// Motions caused by forces count into the scale of errors up to this multiple of the given ones.
constexpr double most_amplified = 1e6;
/// Of the largest of a bond's compliances: what is below is rounding.
constexpr double least_share = 1e-12;

/// Sum of a_k b_k in an order that vector units can follow.
double inner(std::span<const double> a, std::span<const double> b) {
  constexpr std::size_t lanes = 16;
  std::array<double, lanes> sum{};
  std::size_t k = 0;
  for (; k + lanes <= a.size(); k += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) sum[lane] += a[k + lane] * b[k + lane];
  double rest = 0.0;
  for (; k < a.size(); ++k) rest += a[k] * b[k];
  for (const double part : sum) rest += part;
  return rest;
}

}  // namespace

Problem::Problem(const Delassus& operator_W, std::span<const Vec3> given, std::span<const Admissible> sets_of_rows,
                 std::vector<Vec3>& force)
    : W(operator_W),
      b(given),
      sets(sets_of_rows),
      r_(force),
      w_(operator_W.size()),
      is_full_(operator_W.entries() == operator_W.size() * operator_W.size()),
      centre_(operator_W.size()) {
  if (std::ranges::all_of(sets, [](const Admissible& set) { return set.components() == 1; })) {
    normal_made_.reserve(W.block.size());
    for (const FrameBlock& block : W.block) normal_made_.push_back(block[0]);
    normal_ = W.normal.empty() ? normal_made_ : W.normal;
  }
  assert(!normal_.empty() || W.size() == 0 || W.normal.empty());
  for (std::size_t i = 0; i < W.size(); ++i) {
    const FrameBlock& block = own_.emplace_back(W.block_at(W.own_entry(i)));
    const double of_tangents = components(i) > 1 ? std::max(block[4], block[8]) : 0.0;
    unit_.push_back(1.0 / std::sqrt(is_bond(i) ? std::max(block[0], of_tangents) : block[0]));
    tangential_.push_back(of_tangents > 0.0 ? of_tangents : block[0]);
    compliance_.push_back(std::max(block[0], of_tangents));
  }
}

void Problem::select(const RowList& rows) {
  rows_ = rows;
  is_stale_ = true;
}

void Problem::set_force(std::size_t i, const Vec3& force) {
  r_[i] = force;
  is_stale_ = true;
}

std::vector<Vec3> Problem::forces() const {
  std::vector<Vec3> out;
  out.reserve(rows_.size());
  for (const std::size_t i : rows_) out.push_back(r_[i]);
  return out;
}

void Problem::set_forces(const std::vector<Vec3>& forces) {
  for (std::size_t k = 0; k < forces.size(); ++k) set_force(rows_[k], forces[k]);
}

void Problem::regularise(double strength) {
  rho_ = strength;
  for (const std::size_t i : rows_) centre_[i] = r_[i];
}

/// w += what the forces of the rows do to row i, but for one of them
void Problem::add_blocks(std::size_t i, std::size_t left_out, const std::vector<Vec3>& force, Vec3& w) const {
  if (!normal_.empty()) {
    W.each(i, [&](std::size_t j, std::size_t k) {
      if (j != left_out) w[0] += normal_[k] * force[j][0];
    });
    return;
  }
  W.each(i, [&](std::size_t j, std::size_t k) {
    if (j == left_out) return;
    const FrameBlock& B = W.block[k];
    const Vec3& s = force[j];
    for (std::size_t a = 0; a < 3; ++a) w[a] += B[3 * a] * s[0] + B[3 * a + 1] * s[1] + B[3 * a + 2] * s[2];
  });
}

Vec3 Problem::sum_of_blocks(std::size_t i, std::size_t left_out) const {
  Vec3 w = b[i];
  add_blocks(i, left_out, r_, w);
  return w;
}

double Problem::normal_motion(std::size_t i, std::span<const double> x) const {
  if (is_full_ && !normal_.empty()) return inner(normal_.subspan(W.first_entry(i), x.size()), x);
  double sum = 0.0;
  if (normal_.empty())
    W.each(i, [&](std::size_t j, std::size_t k) { sum += W.block[k][0] * x[j]; });
  else
    W.each(i, [&](std::size_t j, std::size_t k) { sum += normal_[k] * x[j]; });
  return sum;
}

/// w_i of the given problem: the motions of all rows are made when one is asked for after forces have changed.
const Vec3& Problem::given_motion(std::size_t i) const {
  if (is_stale_) {
    normal_force_.assign(W.size(), 0.0);
    for (const std::size_t row : rows_) normal_force_[row] = r_[row][0];
    each_of(rows_, [&](std::size_t row) {
      if (normal_.empty())
        w_[row] = sum_of_blocks(row, W.size());
      else
        w_[row] = {b[row][0] + normal_motion(row, normal_force_), b[row][1], b[row][2]};
    });
    is_stale_ = false;
  }
  return w_[i];
}

Vec3 Problem::motion(std::size_t i) const {
  Vec3 w = given_motion(i);
  const std::size_t count = components(i);
  for (std::size_t a = 0; a < count; ++a) w[a] += added(i) * (r_[i][a] - centre_[i][a]);
  return w;
}

Vec3 Problem::change_of_motion(std::size_t i, const std::vector<Vec3>& change) const {
  Vec3 w{};
  add_blocks(i, W.size(), change, w);
  const std::size_t count = components(i);
  for (std::size_t a = 0; a < count; ++a) w[a] += added(i) * change[i][a];
  return w;
}

FrameBlock Problem::own_block(std::size_t i) const {
  FrameBlock block = own_[i];
  const std::size_t count = components(i);
  for (std::size_t a = 0; a < count; ++a) block[4 * a] += added(i);
  return block;
}

double Problem::violation(std::size_t i, const Vec3& w) const {
  if (is_bond(i)) {
    double sum = 0.0;
    for (std::size_t a = 0; a < 3; ++a) sum += own_[i][4 * a] > least_share * compliance_[i] ? w[a] * w[a] : 0.0;
    return std::sqrt(sum);
  }
  const double of_normal = own_[i][0];
  if (of_normal == 0.0) return std::max(0.0, -w[0]);
  const double normal = std::abs(std::min(w[0], of_normal * r_[i][0]));
  if (mu(i) == 0.0) return normal;
  const double of_tangents = tangential_[i], radius = mu(i) * std::max(0.0, r_[i][0]);
  const double p_1 = r_[i][1] - w[1] / of_tangents, p_2 = r_[i][2] - w[2] / of_tangents;
  const double length = std::hypot(p_1, p_2), keep = length > radius ? radius / length : 1.0;
  return normal + of_tangents * std::hypot(r_[i][1] - keep * p_1, r_[i][2] - keep * p_2);
}

double Problem::scale_of_given() const {
  double given = 0.0;
  for (const std::size_t i : rows_)
    given = std::max({given, std::abs(b[i][0]), components(i) > 1 ? std::hypot(b[i][1], b[i][2]) : 0.0});
  return given;
}

std::size_t Problem::worst() const {
  std::size_t where = rows_.front();
  double most = -1.0;
  for (const std::size_t i : rows_) {
    const double v = violation(i, given_motion(i));
    if (v <= most) continue;
    most = v;
    where = i;
  }
  return where;
}

double Problem::scale() const {
  const double given = scale_of_given();
  double caused = 0.0;
  for (const std::size_t i : rows_) {
    caused = std::max(caused, own_[i][0] * std::abs(r_[i][0]));
    if (components(i) > 1) caused = std::max(caused, tangential_[i] * std::hypot(r_[i][1], r_[i][2]));
  }
  return std::max(given, std::min(caused, most_amplified * given));
}

template <class Motion>
double Problem::relative_error(const Motion& motion_of) const {
  double worst = 0.0;
  for (const std::size_t i : rows_) {
    const double v = violation(i, motion_of(i));
    if (!std::isfinite(v)) return infinity;
    worst = std::max(worst, v);
  }
  if (worst == 0.0) return 0.0;
  const double s = scale();
  return s > 0.0 ? worst / s : infinity;
}

double Problem::error() const {
  return relative_error([this](std::size_t i) { return given_motion(i); });
}

double Problem::proximal_error() const {
  return relative_error([this](std::size_t i) { return motion(i); });
}

double Problem::merit() const {
  double sum = 0.0;
  for (const std::size_t i : rows_) {
    const double v = violation(i, motion(i));
    sum += v * v;
  }
  return sum;
}

void Problem::sweep(bool forwards) {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const std::size_t i = rows_[forwards ? k : rows_.size() - 1 - k];
    if (!gives_way(i)) continue;
    Vec3 by_others = sum_of_blocks(i, i);
    const std::size_t count = components(i);
    for (std::size_t a = 0; a < count; ++a) by_others[a] -= added(i) * centre_[i][a];
    set_force(i, is_bond(i) ? solve_bond(own_block(i), by_others) : solve_coulomb(own_block(i), by_others, mu(i)));
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
      W.each(set[next], [&](std::size_t j, std::size_t k) {
        if (seen[j] || W.block_at(k) == FrameBlock{}) return;
        seen[j] = true;
        set.push_back(j);
      });
    }
    std::ranges::sort(set);
    sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace carom::cone
