#include "model/turning_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "math/principal_axes.hpp"
#include "math/vec3.hpp"

namespace carom {

TurningBody make_turning_body(double mass, const Vec3& centre, const Vec3& inertia, const Vec3& products) {
  const PrincipalAxes principal = principal_axes(inertia, products);
  const Vec3& I = principal.values;
  TurningBody body;
  body.mass = mass;
  body.centre = centre;
  body.axes = principal.axes;
  Vec3 euler{};
  for (std::size_t i = 0; i < 3; ++i) euler[i] = 0.5 * (I[(i + 1) % 3] + I[(i + 2) % 3] - I[i]);
  const double largest = *std::max_element(euler.begin(), euler.end());
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(euler[i] > 1e-6 * largest)) {
      throw std::invalid_argument(fmt::format(
          "principal moments of inertia {:.6g}, {:.6g}, {:.6g}, of which one is not smaller than the sum of the others",
          I[0], I[1], I[2]));
    }
    body.radii[i] = std::sqrt(euler[i] / mass);
  }
  return body;
}

TurningBody make_led_body(const Vec3& centre, const Vec3& axis, double size) {
  const Vec3 other = std::abs(axis[0]) < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  TurningBody body;
  body.centre = centre;
  body.axes[0] = normalized(cross(axis, other));
  body.axes[1] = cross(axis, body.axes[0]);
  body.axes[2] = axis;
  body.radii.fill(size / std::sqrt(3.0));
  return body;
}

bool any_free(std::span<const TurningBody> bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [](const TurningBody& body) { return !body.is_led(); });
}

Vec3 corner(const TurningBody& body, std::size_t a) {
  Vec3 x = body.centre;
  for (std::size_t i = 0; i < 3; ++i) x = add(x, scaled(body.axes[i], corner_signs[a][i] * body.radii[i]));
  return x;
}

namespace {

/// N_a of a point with these coordinates along the body's own axes.
std::array<double, 4> weights_at(const TurningBody& body, const Vec3& X) {
  std::array<double, 4> N{};
  for (std::size_t a = 0; a < 4; ++a) {
    N[a] = 0.25;
    for (std::size_t i = 0; i < 3; ++i) N[a] += 0.25 * corner_signs[a][i] * X[i] / body.radii[i];
  }
  return N;
}

}  // namespace

std::array<double, 4> corner_weights(const TurningBody& body, const Vec3& X) {
  const Vec3 r = subtract(X, body.centre);
  return weights_at(body, {dot(body.axes[0], r), dot(body.axes[1], r), dot(body.axes[2], r)});
}

BodyFrame body_frame(const TurningBody& body, const std::array<Vec3, 4>& nodal) {
  BodyFrame frame;
  for (std::size_t a = 0; a < 4; ++a) {
    frame.centre = add(frame.centre, scaled(nodal[a], 0.25));
    for (std::size_t i = 0; i < 3; ++i)
      frame.directors[i] = add(frame.directors[i], scaled(nodal[a], 0.25 * corner_signs[a][i] / body.radii[i]));
  }
  return frame;
}

std::array<Vec3, 4> nodal_values(const TurningBody& body, std::span<const Vec3> values) {
  std::array<Vec3, 4> nodal{};
  for (std::size_t a = 0; a < 4; ++a) nodal[a] = values[static_cast<std::size_t>(body.nodes[a])];
  return nodal;
}

std::array<Vec3, 4> nodal_values(const TurningBody& body, std::span<const double> values) {
  std::array<Vec3, 4> nodal{};
  for (std::size_t a = 0; a < 4; ++a) {
    const std::size_t first = 3 * static_cast<std::size_t>(body.nodes[a]);
    nodal[a] = {values[first], values[first + 1], values[first + 2]};
  }
  return nodal;
}

Vec3 angular_velocity(const BodyFrame& position, const BodyFrame& velocity) {
  Vec3 omega{};
  for (std::size_t i = 0; i < 3; ++i)
    omega = add(omega, scaled(cross(position.directors[i], velocity.directors[i]), 0.5));
  return omega;
}

double body_strain(const BodyFrame& position) {
  const auto& d = position.directors;
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      largest = std::max(largest, 0.5 * std::abs(dot(d[i], d[j]) - (i == j ? 1.0 : 0.0)));
  return largest;
}

BodyPlacement::BodyPlacement(const TurningBody& body, const BodyFrame& frame) : body_(&body), centre_(frame.centre) {
  const auto& d = frame.directors;
  const double volume = dot(d[0], cross(d[1], d[2]));
  for (std::size_t i = 0; i < 3; ++i) duals_[i] = scaled(cross(d[(i + 1) % 3], d[(i + 2) % 3]), 1.0 / volume);
  seen_ = duals_;
  basis_ = d;
  if (!body.is_led()) return;
  for (std::size_t i = 0; i < 3; ++i) basis_[i] = seen_[i] = normalized(d[i]);
}

Vec3 BodyPlacement::reference(const Vec3& x) const {
  const Vec3 r = subtract(x, centre_);
  Vec3 at = body_->centre;
  for (std::size_t i = 0; i < 3; ++i) at = add(at, scaled(body_->axes[i], dot(seen_[i], r)));
  return at;
}

Vec3 BodyPlacement::position(const Vec3& X) const {
  const Vec3 R = subtract(X, body_->centre);
  Vec3 x = centre_;
  for (std::size_t i = 0; i < 3; ++i) x = add(x, scaled(basis_[i], dot(body_->axes[i], R)));
  return x;
}

Vec3 BodyPlacement::gradient(const Vec3& g) const {
  Vec3 out{};
  for (std::size_t i = 0; i < 3; ++i) out = add(out, scaled(seen_[i], dot(body_->axes[i], g)));
  return out;
}

std::array<double, 4> BodyPlacement::weights(const Vec3& x) const {
  const Vec3 r = subtract(x, centre_);
  return weights_at(*body_, {dot(duals_[0], r), dot(duals_[1], r), dot(duals_[2], r)});
}

BodyPlacement place_body(const TurningBody& body, std::span<const double> u) {
  BodyFrame frame = body_frame(body, nodal_values(body, u));
  frame.centre = add(frame.centre, body.centre);
  for (std::size_t i = 0; i < 3; ++i) frame.directors[i] = add(frame.directors[i], body.axes[i]);
  return {body, frame};
}

}  // namespace carom
