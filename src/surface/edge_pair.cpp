#include "surface/edge_pair.hpp"

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"
#include "surface/fade.hpp"

namespace carom {
namespace {

constexpr double flat = 0.05;             // w: b . n of a facet that is 2.9 degrees from lying flat
constexpr double nearly_parallel = 1e-2;  // sin^2 of the angle between the edges
constexpr double least_factor = 1e-4;     // smaller ones make no row: 1e-8 of the force

}  // namespace

/// A vector by each of those that the pair is a function of: r = a_1 - a_2, d_1, d_2, and per edge and facet the way
/// from the edge's first node to the mean of the facet's other nodes.
struct PairGradient {
  Vec3 r{}, d_1{}, d_2{};
  std::array<std::array<Vec3, 2>, 2> e{};

  /// Of w . (d_1 x d_2)
  void add_cross(const Vec3& w, const Vec3& of_1, const Vec3& of_2) {
    d_1 = carom::add(d_1, cross(of_2, w));
    d_2 = carom::add(d_2, cross(w, of_1));
  }
  std::array<EdgeShares, 2> shares() const {
    std::array<EdgeShares, 2> out;
    for (std::size_t i = 0; i < 2; ++i) {
      const Vec3& d = i == 0 ? d_1 : d_2;
      out[i] = {{subtract(scaled(r, i == 0 ? 1.0 : -1.0), carom::add(d, carom::add(e[i][0], e[i][1]))), d}, e[i]};
    }
    return out;
  }
};

/// How an edge stands to the other body.
struct EdgeStand {
  double out = 1.0, flat = 1.0;                 ///< s and t
  std::array<double, 2> out_slope, flat_slope;  ///< of log s and log t, by z of each facet
};

namespace {

void add_to(Vec3& sum, const Vec3& v, double w) {
  sum = add(sum, scaled(v, w));
}

EdgeStand stand_of(const std::array<double, 2>& z) {
  EdgeStand stand;
  for (std::size_t f = 0; f < 2; ++f) {
    const Fade out = fade(z[f] / flat), half = fade((z[f] + flat) / (2.0 * flat));
    stand.out *= out.value;
    stand.flat *= half.value;
    stand.out_slope[f] = 2.0 * out.slope / flat;
    stand.flat_slope[f] = half.slope / flat;
  }
  return stand;
}

/// F, and its slopes by s and t of both edges.
struct StandFactor {
  double value;
  std::array<double, 2> of_out{}, of_flat{};
};

StandFactor stand_factor(const std::array<EdgeStand, 2>& stand, PairFactor factor) {
  const auto& [a, b] = stand;
  switch (factor) {
    case PairFactor::held:
    case PairFactor::fold:
      return {a.out * b.out, {b.out, a.out}, {}};
    case PairFactor::stopped:
    case PairFactor::moves:
      return {a.out * b.flat + a.flat * b.out - a.out * b.out, {b.flat - b.out, a.flat - a.out}, {b.out, a.out}};
    case PairFactor::border:
      break;
  }
  return {a.flat * b.flat, {}, {b.flat, a.flat}};
}

/// Where the closest points of the lines are; c = d_1 x d_2, r = a_1 - a_2.
std::array<double, 2> closest(const Vec3& r, const std::array<Vec3, 2>& d, const Vec3& c, double cc) {
  return {-dot(cross(r, d[1]), c) / cc, -dot(cross(r, d[0]), c) / cc};
}

/// y of an end, for the closest point at a distance `from` from it, as a part of the segment.
double passed(const EdgeEnd& end, double from) {
  return ((end.goes_on ? end.width : 0.0) + from) / (2.0 * end.width);
}

}  // namespace

/// Makes one pair.
class EdgePairing {
 public:
  EdgePairing(const PlacedEdge& first, const PlacedEdge& second)
      : edges_{&first, &second},
        r_(subtract(first.x[0], second.x[0])),
        d_{subtract(first.x[1], first.x[0]), subtract(second.x[1], second.x[0])},
        c_(cross(d_[0], d_[1])),
        cc_(dot(c_, c_)) {}

  std::optional<EdgePair> make(const std::array<EdgeEnd, 2>& ends_1, const std::array<EdgeEnd, 2>& ends_2,
                               PairFactor factor);

 private:
  bool take_angle();
  bool take_end(const std::array<EdgeEnd, 2>& ends, std::size_t edge);
  bool take_facets(PairFactor factor);
  void add_factor();
  /// Takes a part of f^2.
  bool take(double part) {
    pair_.factor *= std::sqrt(std::max(0.0, part));
    return pair_.factor > least_factor;
  }
  /// Adds w times the gradients of s or t, of sin^2, and of b . n.
  void add_parameter(std::size_t edge, double w);
  void add_angle(double w);
  void add_facet(std::size_t edge, std::size_t facet, double w);

  std::array<const PlacedEdge*, 2> edges_;
  Vec3 r_;
  std::array<Vec3, 2> d_;
  Vec3 c_;
  double cc_, sin_squared_ = 0.0;
  std::array<std::array<Vec3, 2>, 2> b_{};
  std::array<std::array<double, 2>, 2> away_{};  ///< how far the means are from the edge
  double angle_slope_ = 0.0;                     ///< slopes of log f
  std::array<double, 2> parameter_slope_{};
  std::array<std::array<double, 2>, 2> facet_slope_{};
  EdgePair pair_;
  PairGradient gradient_;
};

bool EdgePairing::take_angle() {
  const double product = dot(d_[0], d_[0]) * dot(d_[1], d_[1]);
  if (!(cc_ > 0.0) || !(product > 0.0)) return false;
  sin_squared_ = cc_ / product;
  const double y = sin_squared_ / nearly_parallel;
  if (y >= 1.0) return true;
  angle_slope_ = 0.5 * (1.0 / y - 1.0 / (2.0 - y)) / nearly_parallel;
  return take(y * (2.0 - y));
}

bool EdgePairing::take_end(const std::array<EdgeEnd, 2>& ends, std::size_t edge) {
  const double at = edge == 0 ? pair_.s : pair_.t;
  for (std::size_t end = 0; end < 2; ++end) {
    const Fade part = fade(passed(ends[end], end == 0 ? at : 1.0 - at));
    if (!take(part.value)) return false;
    parameter_slope_[edge] += (end == 0 ? 1.0 : -1.0) * part.slope / (2.0 * ends[end].width);
  }
  return true;
}

bool EdgePairing::take_facets(PairFactor factor) {
  double side = 0.0;
  const Vec3 n = scaled(c_, 1.0 / std::sqrt(cc_));
  for (std::size_t i = 0; i < 2; ++i) {
    const double dd = dot(d_[i], d_[i]);
    for (std::size_t f = 0; f < 2; ++f) {
      const Vec3 e = subtract(edges_[i]->far[f], edges_[i]->x[0]);
      const Vec3 q = subtract(e, scaled(d_[i], dot(e, d_[i]) / dd));
      away_[i][f] = norm(q);
      if (!(away_[i][f] > 0.0)) return false;
      b_[i][f] = scaled(q, 1.0 / away_[i][f]);
      side += (i == 0 ? 1.0 : -1.0) * dot(b_[i][f], n);
    }
  }
  pair_.normal = scaled(n, side > 0.0 ? 1.0 : -1.0);
  pair_.turning_ = (side > 0.0 ? 1.0 : -1.0) / std::sqrt(cc_);
  std::array<EdgeStand, 2> stand;
  for (std::size_t i = 0; i < 2; ++i) {
    const double sign = i == 0 ? 1.0 : -1.0;
    stand[i] = stand_of({sign * dot(b_[i][0], pair_.normal), sign * dot(b_[i][1], pair_.normal)});
  }
  const StandFactor all = stand_factor(stand, factor);
  if (!take(all.value)) return false;
  for (std::size_t i = 0; i < 2; ++i) {
    const double scale = (i == 0 ? 0.5 : -0.5) / all.value, of_out = scale * all.of_out[i] * stand[i].out,
                 of_flat = scale * all.of_flat[i] * stand[i].flat;
    for (std::size_t f = 0; f < 2; ++f)
      facet_slope_[i][f] = of_out * stand[i].out_slope[f] + of_flat * stand[i].flat_slope[f];
  }
  return true;
}

void EdgePairing::add_parameter(std::size_t edge, double w) {
  const Vec3& other = d_[1 - edge];
  const double at = edge == 0 ? pair_.s : pair_.t;
  const Vec3 v = add(scaled(cross(r_, other), -w / cc_), scaled(c_, -2.0 * at * w / cc_));
  add_to(gradient_.r, cross(other, c_), -w / cc_);
  add_to(edge == 0 ? gradient_.d_2 : gradient_.d_1, cross(c_, r_), -w / cc_);
  gradient_.add_cross(v, d_[0], d_[1]);
}

void EdgePairing::add_angle(double w) {
  gradient_.add_cross(scaled(c_, 2.0 * w * sin_squared_ / cc_), d_[0], d_[1]);
  add_to(gradient_.d_1, d_[0], -2.0 * w * sin_squared_ / dot(d_[0], d_[0]));
  add_to(gradient_.d_2, d_[1], -2.0 * w * sin_squared_ / dot(d_[1], d_[1]));
}

void EdgePairing::add_facet(std::size_t edge, std::size_t facet, double w) {
  const Vec3 &b = b_[edge][facet], &n = pair_.normal, &d = d_[edge];
  const double z = dot(b, n);
  const Vec3 of_e = scaled(subtract(n, scaled(b, z)), w / away_[edge][facet]);
  const Vec3 e = subtract(edges_[edge]->far[facet], edges_[edge]->x[0]);
  add_to(gradient_.e[edge][facet], of_e, 1.0);
  add_to(edge == 0 ? gradient_.d_1 : gradient_.d_2, of_e, -dot(e, d) / dot(d, d));
  gradient_.add_cross(scaled(subtract(b, scaled(n, z)), w * pair_.turning_), d_[0], d_[1]);
}

/// g times the gradient of f.
void EdgePairing::add_factor() {
  const double scale = pair_.gap * pair_.factor;
  if (angle_slope_ != 0.0) add_angle(scale * angle_slope_);
  for (std::size_t i = 0; i < 2; ++i) {
    if (parameter_slope_[i] != 0.0) add_parameter(i, scale * parameter_slope_[i]);
    for (std::size_t f = 0; f < 2; ++f)
      if (facet_slope_[i][f] != 0.0) add_facet(i, f, scale * facet_slope_[i][f]);
  }
}

std::optional<EdgePair> EdgePairing::make(const std::array<EdgeEnd, 2>& ends_1, const std::array<EdgeEnd, 2>& ends_2,
                                          PairFactor factor) {
  pair_.factor = 1.0;
  if (!take_angle()) return std::nullopt;
  const std::array<double, 2> at = closest(r_, d_, c_, cc_);
  pair_.s = at[0];
  pair_.t = at[1];
  if (!take_end(ends_1, 0) || !take_end(ends_2, 1) || !take_facets(factor)) return std::nullopt;
  pair_.d_1_ = d_[0];
  pair_.d_2_ = d_[1];
  pair_.gap = dot(pair_.normal, r_);
  pair_.point = add(edges_[0]->x[0], scaled(d_[0], pair_.s));
  gradient_.r = scaled(pair_.normal, pair_.factor);
  gradient_.d_1 = scaled(pair_.normal, pair_.factor * pair_.s);
  gradient_.d_2 = scaled(pair_.normal, -pair_.factor * pair_.t);
  const bool is_held = factor == PairFactor::held || factor == PairFactor::stopped;
  if (!is_held && pair_.gap < 0.0) add_factor();
  pair_.of_gap = gradient_.shares();
  return pair_;
}

std::array<EdgeShares, 2> EdgePair::along(const Vec3& m) const {
  PairGradient gradient;
  gradient.r = scaled(m, factor);
  gradient.d_1 = scaled(m, factor * s);
  gradient.d_2 = scaled(m, -factor * t);
  gradient.add_cross(scaled(m, -factor * gap * turning_), d_1_, d_2_);
  return gradient.shares();
}

std::optional<EdgePair> edge_pair(const PlacedEdge& first, const std::array<EdgeEnd, 2>& ends_1,
                                  const PlacedEdge& second, const std::array<EdgeEnd, 2>& ends_2, PairFactor factor) {
  return EdgePairing(first, second).make(ends_1, ends_2, factor);
}

bool may_cross(const std::array<Vec3, 2>& first, const std::array<EdgeEnd, 2>& ends_1,
               const std::array<Vec3, 2>& second, const std::array<EdgeEnd, 2>& ends_2) {
  const std::array<Vec3, 2> d{subtract(first[1], first[0]), subtract(second[1], second[0])};
  const Vec3 c = cross(d[0], d[1]);
  const double cc = dot(c, c);
  if (!(cc > 0.0)) return false;
  const std::array<double, 2> at = closest(subtract(first[0], second[0]), d, c, cc);
  const auto is_on = [](const std::array<EdgeEnd, 2>& ends, double s) {
    return passed(ends[0], s) > 0.0 && passed(ends[1], 1.0 - s) > 0.0;
  };
  return is_on(ends_1, at[0]) && is_on(ends_2, at[1]);
}

double EdgePair::line_gap(const PlacedEdge& first, const PlacedEdge& second) const {
  const Vec3 c = cross(subtract(first.x[1], first.x[0]), subtract(second.x[1], second.x[0]));
  return std::copysign(1.0, turning_) * dot(c, subtract(first.x[0], second.x[0])) / std::sqrt(dot(c, c));
}

}  // namespace carom
