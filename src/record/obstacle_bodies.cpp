#include "record/obstacle_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr std::size_t kAround = 48;  ///< points of a circle

/// Middle and half diagonal of the parts' bounding box.
struct Span {
  Vec3 middle{};
  double half = 0.0;
};

Span span_of(const Simulation& simulation) {
  Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  for (std::size_t k = 0; k < simulation.solid().cells().size(); ++k) {
    for (const Index n : simulation.solid().cells().nodes_of(k)) {
      const Vec3& x = simulation.mesh().coordinates[static_cast<std::size_t>(n)];
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], x[c]);
        high[c] = std::max(high[c], x[c]);
      }
    }
  }
  return {scaled(add(low, high), 0.5), 0.5 * norm(subtract(high, low))};
}

/// Two unit vectors normal to n and to each other.
std::array<Vec3, 2> tangents(const Vec3& n) {
  Vec3 e{};
  e[std::abs(n[0]) < 0.5 ? 0 : 1] = 1.0;
  const Vec3 first = normalized(cross(n, e));
  return {first, cross(n, first)};
}

Vec3 combined(const Vec3& at, double a, const Vec3& x, double b, const Vec3& y) {
  return add(at, add(scaled(x, a), scaled(y, b)));
}

std::vector<Vec3> plane_points(const Plane& plane, const Span& span) {
  const auto [s, t] = tangents(plane.normal);
  const Vec3 at = subtract(span.middle, scaled(plane.normal, dot(subtract(span.middle, plane.point), plane.normal)));
  std::vector<Vec3> points;
  for (const double a : {-span.half, span.half})
    for (const double b : {-span.half, span.half}) points.push_back(combined(at, a, s, b, t));
  return points;
}

double turn(std::size_t i, std::size_t n) {
  return 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
}

std::vector<Vec3> cylinder_points(const Cylinder& cylinder, const Span& span) {
  const auto [s, t] = tangents(cylinder.axis);
  const double along = dot(subtract(span.middle, cylinder.point), cylinder.axis);
  std::vector<Vec3> points;
  for (const double z : {along - span.half, along + span.half})
    for (std::size_t i = 0; i <= kAround; ++i)
      points.push_back(combined(add(cylinder.point, scaled(cylinder.axis, z)),
                                cylinder.radius * std::cos(turn(i, kAround)), s,
                                cylinder.radius * std::sin(turn(i, kAround)), t));
  return points;
}

std::vector<Vec3> sphere_points(const Sphere& sphere) {
  std::vector<Vec3> points;
  for (std::size_t j = 0; j <= kAround / 2; ++j) {
    const double latitude = turn(j, kAround);
    for (std::size_t i = 0; i <= kAround; ++i) {
      const double ring = sphere.radius * std::sin(latitude);
      points.push_back(add(sphere.centre, {ring * std::cos(turn(i, kAround)), ring * std::sin(turn(i, kAround)),
                                           sphere.radius * std::cos(latitude)}));
    }
  }
  return points;
}

}  // namespace

ObstacleBodies::ObstacleBodies(const Simulation& simulation) : model_(simulation.model()) {
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const RigidShape* shape = parts_of(model_.contacts[c]).shape;
    if (shape == nullptr) continue;
    bodies_.push_back({c, points_.size()});
    add_shape(simulation, *shape);
    contact_.resize(cells_.types.size(), static_cast<Index>(c));
  }
}

bool ObstacleBodies::moves() const {
  return std::any_of(bodies_.begin(), bodies_.end(),
                     [this](const Body& b) { return parts_of(model_.contacts[b.contact]).moves(); });
}

/// Quadrangles between points that stand row after row.
void ObstacleBodies::add_grid(std::size_t rows, std::size_t columns, const std::vector<Vec3>& points) {
  const auto first = static_cast<Index>(points_.size());
  points_.insert(points_.end(), points.begin(), points.end());
  const auto at = [&](std::size_t r, std::size_t c) { return first + static_cast<Index>(r * columns + c); };
  for (std::size_t r = 0; r + 1 < rows; ++r)
    for (std::size_t c = 0; c + 1 < columns; ++c)
      cells_.add(std::array{at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)}, CellType::quad4);
}

void ObstacleBodies::add_surface(const Mesh& mesh, const Surface& surface) {
  std::map<Index, Index> point_of;
  for (const Facet& facet : surface.facets) {
    std::vector<Index> points;
    for (const Index n : std::span<const Index>(facet.begin(), facet.end())) {
      const auto [found, is_new] = point_of.try_emplace(n, static_cast<Index>(points_.size()));
      if (is_new) points_.push_back(mesh.coordinates[static_cast<std::size_t>(n)]);
      points.push_back(found->second);
    }
    cells_.add(points, points.size() == 2 ? CellType::line2 : points.size() == 3 ? CellType::tria3 : CellType::quad4);
  }
}

void ObstacleBodies::add_shape(const Simulation& simulation, const RigidShape& shape) {
  const Span span = span_of(simulation);
  if (const auto* plane = std::get_if<Plane>(&shape)) add_grid(2, 2, plane_points(*plane, span));
  if (const auto* sphere = std::get_if<Sphere>(&shape)) add_grid(kAround / 2 + 1, kAround + 1, sphere_points(*sphere));
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) add_grid(2, kAround + 1, cylinder_points(*cylinder, span));
  if (const auto* surface = std::get_if<RigidSurface>(&shape)) add_surface(simulation.mesh(), surface->surface);
  const auto* box = std::get_if<Box>(&shape);
  if (box == nullptr) return;
  const auto first = static_cast<Index>(points_.size());
  const Vec3 &a = box->lower, &b = box->upper;
  points_.insert(points_.end(), {{a[0], a[1], a[2]},
                                 {b[0], a[1], a[2]},
                                 {b[0], b[1], a[2]},
                                 {a[0], b[1], a[2]},
                                 {a[0], a[1], b[2]},
                                 {b[0], a[1], b[2]},
                                 {b[0], b[1], b[2]},
                                 {a[0], b[1], b[2]}});
  std::array<Index, 8> nodes{};
  for (std::size_t i = 0; i < 8; ++i) nodes[i] = first + static_cast<Index>(i);
  cells_.add(nodes, CellType::hexa8);
}

FrameMesh ObstacleBodies::mesh() const {
  return {points_, cells_, {}, {{"contact", 1, contact_}}};
}

FieldFrame ObstacleBodies::frame(const State& state) const {
  std::vector<Vec3> displacement(points_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const ContactParts obstacle = parts_of(model_.contacts[bodies_[b].contact]);
    const std::size_t end = b + 1 < bodies_.size() ? bodies_[b + 1].first : points_.size();
    for (std::size_t p = bodies_[b].first; p < end; ++p) {
      if (obstacle.carrier >= 0) {
        const double* u = state.q.data() + 3 * static_cast<std::size_t>(obstacle.carrier);
        displacement[p] = {u[0], u[1], u[2]};
      }
      if (obstacle.body < 0) continue;
      // The point keeps its components in the body's axes.
      const TurningBody& body = model_.turning_bodies[static_cast<std::size_t>(obstacle.body)];
      const BodyFrame moved = body_frame(body, nodal_values(body, state.q));
      const Vec3 r = subtract(points_[p], body.centre);
      displacement[p] = moved.centre;
      for (std::size_t i = 0; i < 3; ++i)
        displacement[p] = add(displacement[p], scaled(moved.directors[i], dot(body.axes[i], r)));
    }
  }
  std::vector<double> values;
  for (const Vec3& u : displacement) values.insert(values.end(), u.begin(), u.end());
  return {{{"displacement", 3, std::move(values)}}, {}};
}

}  // namespace carom
