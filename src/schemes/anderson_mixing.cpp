#include "schemes/anderson_mixing.hpp"

#include <cmath>
#include <utility>

#include "parallel/threads.hpp"

namespace carom {

namespace {

constexpr std::size_t depth = 5;

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
  std::vector<double> d(a.size());
  parallel_each(d.size(), [&](std::size_t i) { d[i] = a[i] - b[i]; });
  return d;
}

}  // namespace

bool AndersonMixing::is_slow(std::span<const double> f) const {
  constexpr double quick = 0.1;
  return !f_.empty() && dot(f, f) > quick * quick * dot(f_, f_);
}

void AndersonMixing::push(std::span<const double> y, std::span<const double> f) {
  if (dy_.size() == depth) {
    dy_.erase(dy_.begin());
    df_.erase(df_.begin());
  }
  dy_.push_back(difference(y, y_));
  df_.push_back(difference(f, f_));
}

/// c of each difference, by Gram-Schmidt from the newest to the oldest; those that the newer ones nearly span get none.
std::vector<double> AndersonMixing::combination(std::span<const double> f) const {
  constexpr double independent = 1e-6;
  const std::size_t m = df_.size();
  if (m == 0) return {};
  std::vector<std::vector<double>> q;
  std::vector<std::size_t> of;         // difference of each column of q
  std::vector<std::vector<double>> r;  // r[j][i] = q_i . df_(of[j])
  std::vector<double> rest(f.begin(), f.end()), projected;
  for (std::size_t k = m; k-- > 0;) {
    std::vector<double> column = df_[k], on(q.size());
    const double size = std::sqrt(dot(column, column));
    for (std::size_t i = 0; i < q.size(); ++i) {
      on[i] = dot(q[i], column);
      parallel_each(column.size(), [&](std::size_t n) { column[n] -= on[i] * q[i][n]; });
    }
    const double length = std::sqrt(dot(column, column));
    if (!(length > independent * size)) continue;
    parallel_each(column.size(), [&](std::size_t n) { column[n] /= length; });
    on.push_back(length);
    projected.push_back(dot(column, rest));
    parallel_each(rest.size(), [&](std::size_t n) { rest[n] -= projected.back() * column[n]; });
    q.push_back(std::move(column));
    r.push_back(std::move(on));
    of.push_back(k);
  }
  std::vector<double> c(m, 0.0);
  for (std::size_t j = q.size(); j-- > 0;) {
    double left = projected[j];
    for (std::size_t k = j + 1; k < q.size(); ++k) left -= r[k][j] * c[of[k]];
    c[of[j]] = left / r[j][j];
  }
  return c;
}

void AndersonMixing::advance(std::span<double> y, std::span<double> f) {
  if (!dy_.empty() || is_slow(f)) push(y, f);
  const std::vector<double> c = combination(f);
  y_.assign(y.begin(), y.end());
  f_.assign(f.begin(), f.end());
  parallel_each(y.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < c.size(); ++k) f[i] -= c[k] * (dy_[k][i] + df_[k][i]);
    y[i] += f[i];
  });
}

}  // namespace carom
