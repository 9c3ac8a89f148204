#include "contact/face_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "contact/facet_projection.hpp"
#include "contact/half_thickness.hpp"
#include "contact/pair_rows.hpp"
#include "math/vec3.hpp"
#include "model/bodies.hpp"

namespace carom {
namespace {

constexpr double face_look = 1.5;              // of the facet size: overlaps within count
constexpr double least_facing_of_faces = 0.2;  // c_0
constexpr double going_on = 0.5;               // product of the normals of facets that go on with each other
constexpr double smooth_edge = 0.9;            // the same, of those whose parts at their common edge cancel
constexpr double sideways_depth = 0.02;        // of the facet size: deeper, a facet has to come in from the front

/// s as a function of c.
double facing_factor(double c) {
  const double t = (c - least_facing_of_faces) / (1.0 - least_facing_of_faces);
  return t * t * (3.0 - 2.0 * t);
}

/// a^alpha N_b,alpha at the centre of a facet, by which its normal turns: dn = - sum_b turn_b (n . du_b).
std::array<Vec3, 4> turns_of(const PlacedFacet& facet, const FacetFrame& frame, const ParentPoint& centre) {
  const FacetShape shape = facet_shape(facet.size, centre.xi, centre.eta);
  const TangentDual dual = tangent_dual(frame.a_1, frame.a_2, frame.normal);
  std::array<Vec3, 4> turn{};
  for (std::size_t b = 0; b < 4; ++b)
    turn[b] = add(scaled(dual.dual_1, shape.dN_dxi[b]), scaled(dual.dual_2, shape.dN_deta[b]));
  return turn;
}

/// Facets beside each edge (segment: end) of a facet, -1 where there is none.
std::vector<std::array<Index, 4>> facets_beside(std::span<const Facet> facets) {
  std::map<std::array<Index, 2>, std::vector<std::pair<std::size_t, std::size_t>>> at;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto n = static_cast<std::size_t>(facets[f].size);
    for (std::size_t a = 0; a < n; ++a) {
      const Index p = facets[f][a], q = n == 2 ? p : facets[f][(a + 1) % n];
      at[{std::min(p, q), std::max(p, q)}].emplace_back(f, a);
    }
  }
  std::vector<std::array<Index, 4>> beside(facets.size(), {-1, -1, -1, -1});
  for (const auto& [edge, users] : at) {
    for (const auto& [f, a] : users)
      for (const auto& [g, b] : users)
        if (g != f) beside[f][a] = static_cast<Index>(g);
  }
  return beside;
}

}  // namespace

/// A slave facet at its current position, and its extent along its plane's axes and normal.
struct FaceOverlaps::Slave {
  std::size_t f;
  PlacedFacet placed, reference;
  Vec3 centre, axis_1, axis_2, normal;
  Bounds extent{};

  Slave(std::size_t number, const PlacedFacet& now, const PlacedFacet& before)
      : f(number), placed(now), reference(before) {
    const ParentPoint at = facet_centre(placed.size);
    const FacetFrame frame = facet_frame(placed, at.xi, at.eta);
    centre = frame.position;
    normal = frame.normal;
    axis_1 = normalized(frame.a_1);
    axis_2 = cross(normal, axis_1);
    extent = extent_of(placed);
  }
  /// Reference measure over the current one.
  double measure_at(const ParentPoint& at) const {
    const FacetShape shape = facet_shape(placed.size, at.xi, at.eta);
    const double now = facet_frame(placed, shape).jacobian;
    return now > 0.0 ? facet_frame(reference, shape).jacobian / now : 0.0;
  }
  Bounds extent_of(const PlacedFacet& facet) const {
    Bounds bounds;
    for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) {
      const Vec3 r = subtract(facet.x[a], centre);
      bounds.include(Vec3{dot(r, axis_1), dot(r, axis_2), dot(r, normal)});
    }
    return bounds;
  }
  /// False when the other facet lies nowhere over or under this one, or farther outward than `reach`.
  bool may_overlap(const PlacedFacet& other, double reach) const {
    Bounds column = extent;
    column.low[2] = -INFINITY;
    column.high[2] += reach;
    return column.overlaps(extent_of(other));
  }
};

/// A master facet that the slave meets, and its points.
struct FaceOverlaps::Met {
  Index master;
  PlacedFacet placed;
  FacetFrame frame;  ///< at its centre
  double facing;     ///< c
  double area;       ///< of the overlap
  std::size_t begin, end;
};

FaceOverlaps::FaceOverlaps(const Model& model, const Surface& slave, const Surface& master, bool self)
    : X_(model.mesh->coordinates),
      slave_(slave),
      size_(std::max(mean_facet_size(X_, slave.facets), mean_facet_size(X_, master.facets))),
      depth_(self ? half_thickness(X_, master.facets, bodies_of_nodes(model), size_)
                  : std::vector<double>(master.facets.size(), size_)),
      slave_faces_(parent_faces(*model.mesh, slave.facets)),
      master_faces_(parent_faces(*model.mesh, master.facets)),
      beside_(facets_beside(master.facets)),
      broad_phase_(slave.facets, master.facets, face_look * size_, 0.5 * mean_facet_size(X_, master.facets)) {}

void FaceOverlaps::update(const ContactMotion& motion, std::vector<std::array<Index, 4>> behind) {
  broad_phase_.update(motion.x_begin, motion.displacement);
  behind_ = std::move(behind);
}

/// True when a corner of the slave facet was behind this facet or one beside it that goes on with it, and that faced
/// the slave: what is deep under it has gone in there, and is not the far side of a thin part.
bool FaceOverlaps::was_behind(const Slave& slave, Index g, const ContactMotion& motion) const {
  const auto normal = [&](Index f) {
    const PlacedFacet facet = place(master_facet(f), motion.x);
    const ParentPoint centre = facet_centre(facet.size);
    return facet_frame(facet, centre.xi, centre.eta).normal;
  };
  const Facet& facet = master_facet(g);
  return std::any_of(behind_[slave.f].begin(), behind_[slave.f].end(), [&](Index met) {
    if (met < 0 || met == g) return met == g;
    const Facet& other = master_facet(met);
    const bool is_beside = std::any_of(
        other.begin(), other.end(), [&](Index n) { return std::find(facet.begin(), facet.end(), n) != facet.end(); });
    if (!is_beside) return false;
    const Vec3 n = normal(met);
    return dot(n, normal(g)) > going_on && -dot(n, slave.normal) > least_facing_of_faces;
  });
}

/// The point and the master's point over it, in the slave's frame at the beginning of the step.
bool FaceOverlaps::was_in_front(std::size_t f, Index g, const OverlapPoint& point, const ContactMotion& motion) const {
  const PlacedFacet slave = place(slave_.facets[f], motion.x_begin), master = place(master_facet(g), motion.x_begin);
  const Vec3 way = subtract(facet_position(master, point.master.xi, point.master.eta),
                            facet_position(slave, point.slave.xi, point.slave.eta));
  return dot(way, facet_frame(slave, point.slave.xi, point.slave.eta).normal) >= 0.0;
}

/// Enters master g and appends its points, if it counts.
bool FaceOverlaps::add_master(const Slave& slave, Index g, const ContactMotion& motion, std::vector<Met>& met,
                              std::vector<OverlapPoint>& overlap) const {
  const PlacedFacet master = place(master_facet(g), motion.x);
  if (!slave.may_overlap(master, face_look * size_)) return false;
  const ParentPoint centre = facet_centre(master.size);
  const FacetFrame frame = facet_frame(master, centre.xi, centre.eta);
  const double facing = -dot(frame.normal, slave.normal);
  if (facing <= least_facing_of_faces) return false;
  const bool is_high = !slave_faces_[slave.f].is_linear || !master_face(g).is_linear;
  const std::size_t before = overlap.size();
  const OverlapExtent extent = add_overlap(slave.placed, master, {is_high, true}, overlap);
  if (overlap.size() == before) return false;
  // Without a history, at the start, all counts that is not the far side of a thin part.
  const double most = motion.history.empty() ? depth_[static_cast<std::size_t>(g)] : sideways_depth * size_;
  const bool is_deep = extent.least_gap < -most;
  // A sliver ten times as deep as wide belongs to what passes by the border of the other facet.
  const double length = slave.placed.size == 2 ? 1.0 : std::sqrt(measure(slave.placed));
  const bool is_wide = extent.area >= -0.1 * extent.least_gap * length;
  if (extent.least_gap <= face_look * size_ &&
      (!is_deep || (is_wide && was_behind(slave, g, motion)) || was_in_front(slave.f, g, overlap[before], motion))) {
    met.push_back({g, master, frame, facing, extent.area, before, overlap.size()});
    return true;
  }
  overlap.resize(before);
  return false;
}

/// Sets the weight of every point to zero that has another master nearer along the normal.
void FaceOverlaps::hide_layers(const Slave& slave, std::span<const Met> met, std::vector<OverlapPoint>& overlap) const {
  for (const Met& own : met) {
    for (std::size_t q = own.begin; q < own.end; ++q) {
      const Vec3 x = facet_position(slave.placed, overlap[q].slave.xi, overlap[q].slave.eta);
      for (const Met& other : met) {
        if (other.master == own.master) continue;
        const std::optional<RayHit> hit = intersect(other.placed, x, slave.normal);
        if (hit && std::abs(hit->distance) < std::abs(overlap[q].gap)) overlap[q].weight = 0.0;
      }
    }
  }
}

void FaceOverlaps::find(std::size_t f, const ContactMotion& motion, FacetPoints& found) const {
  found.points.clear();
  found.border.clear();
  found.least_gap = INFINITY;
  const std::span<const Index> candidates = broad_phase_.targets_of(f);
  if (candidates.empty()) return;
  const Slave slave(f, place(slave_.facets[f], motion.x), place(slave_.facets[f], X_));
  std::vector<OverlapPoint> overlap;
  std::vector<Met> met;
  for (const Index g : candidates) add_master(slave, g, motion, met, overlap);
  if (met.empty()) return;
  double covered = 0.0;
  for (const Met& one : met) covered += one.area;
  if (covered > measure(slave.placed) * (1.0 + 1e-6)) hide_layers(slave, met, overlap);
  found.normal = slave.normal;
  const ParentPoint centre = facet_centre(slave.placed.size);
  found.turn = turns_of(slave.placed, facet_frame(slave.placed, centre.xi, centre.eta), centre);
  for (const Met& one : met)
    for (std::size_t q = one.begin; q < one.end; ++q)
      if (overlap[q].weight > 0.0) add_point(slave, one, overlap[q], motion, found);
  if (found.least_gap < 0.0)
    for (const Met& one : met) add_borders(slave, one, motion, found);
}

/// Reference thickness of the slave at a point: 1 in three dimensions.
double FaceOverlaps::width_at(const Slave& slave, const ParentPoint& at) const {
  if (slave.placed.size > 2) return 1.0;
  if (slave_.section != Section::axisymmetric) return slave_.thickness;
  return 2.0 * std::numbers::pi * facet_position(slave.reference, at.xi, at.eta)[0];
}

/// True when the master's surface does not go on beyond an edge with a facet that is turned by little: there the parts
/// of both facets cancel.
bool FaceOverlaps::ends_at(const Met& met, std::size_t edge, const ContactMotion& motion) const {
  const Index next = beside_[static_cast<std::size_t>(met.master)][edge];
  if (next < 0) return true;
  const PlacedFacet facet = place(master_facet(next), motion.x);
  const ParentPoint centre = facet_centre(facet.size);
  return dot(facet_frame(facet, centre.xi, centre.eta).normal, met.frame.normal) < smooth_edge;
}

void FaceOverlaps::add_borders(const Slave& slave, const Met& met, const ContactMotion& motion,
                               FacetPoints& found) const {
  const ParentFace &own = slave_faces_[slave.f], &other = master_face(met.master);
  const double s = facing_factor(met.facing);
  std::vector<BorderPoint> border;
  for (std::size_t edge = 0; edge < static_cast<std::size_t>(met.placed.size); ++edge) {
    if (!ends_at(met, edge, motion)) continue;
    border.clear();
    add_border(slave.placed, met.placed, edge, border);
    for (const BorderPoint& at : border) {
      const double gap = s * at.gap;
      FacePoint point;
      point.weight = at.length * slave.measure_at(at.slave) * width_at(slave, at.slave);
      point.gap = gap;
      point.distance = at.gap;
      point.master = met.master;
      point.share = facet_shape(slave.placed.size, at.slave.xi, at.slave.eta).N;
      point.N = face_shape(own, in_parent(own, slave_.facets[slave.f], at.slave)).N;
      point.N_master = face_shape(other, in_parent(other, master_facet(met.master), at.master)).N;
      point.along = at.outward;
      point.of_turn = scaled(at.outward, at.gap);
      found.border.push_back(point);
    }
  }
}

namespace {

/// A point of a face where the line from x along n meets it, from a near point on: Newton's method in the plane normal
/// to n.
ParentPoint on_line(const ParentFace& face, std::span<const Vec3> x_nodes, const Vec3& x, const Vec3& n,
                    ParentPoint at) {
  const bool is_segment = dimension(face.type) == 1;
  for (int i = 0; i < 4; ++i) {
    const FacetFrame frame = face_frame(face, face_shape(face, at), x_nodes);
    const Vec3 away = subtract(x, frame.position), r = subtract(away, scaled(n, dot(away, n)));
    const Vec3 p = subtract(frame.a_1, scaled(n, dot(frame.a_1, n)));
    const Vec3 q = subtract(frame.a_2, scaled(n, dot(frame.a_2, n)));
    const double pp = dot(p, p), qq = dot(q, q), pq = is_segment ? 0.0 : dot(p, q), det = pp * qq - pq * pq;
    if (!(det > 0.0)) break;
    at.xi += (qq * dot(p, r) - pq * dot(q, r)) / det;
    if (!is_segment) at.eta += (pp * dot(q, r) - pq * dot(p, r)) / det;
  }
  return at;
}

}  // namespace

void FaceOverlaps::add_point(const Slave& slave, const Met& met, const OverlapPoint& at, const ContactMotion& motion,
                             FacetPoints& found) const {
  const ParentFace &own = slave_faces_[slave.f], &other = master_face(met.master);
  const Facet& facet = slave_.facets[slave.f];
  const FaceShape shape = face_shape(own, in_parent(own, facet, at.slave));
  FacePoint point;
  point.position = face_frame(own, shape, motion.x).position;
  ParentPoint on_other = in_parent(other, master_facet(met.master), at.master);
  if (!own.is_linear || !other.is_linear) on_other = on_line(other, motion.x, point.position, slave.normal, on_other);
  const FaceShape other_shape = face_shape(other, on_other);
  const FacetFrame there = face_frame(other, other_shape, motion.x);
  const double cosine = dot(there.normal, slave.normal);
  if (!(cosine < -0.5 * least_facing_of_faces)) return;
  const double g = dot(subtract(there.position, point.position), slave.normal);
  const double t = (met.facing - least_facing_of_faces) / (1.0 - least_facing_of_faces);
  const double s = facing_factor(met.facing);
  const double of_facing = g * 6.0 * t * (1.0 - t) / (1.0 - least_facing_of_faces);  // dg~ / dc
  const Vec3 m = scaled(there.normal, 1.0 / cosine);
  point.weight = at.weight * slave.measure_at(at.slave) * width_at(slave, at.slave);
  point.gap = s * g;
  point.distance = g;
  point.master = met.master;
  point.share = facet_shape(facet.size, at.slave.xi, at.slave.eta).N;
  point.N = shape.N;
  point.N_master = other_shape.N;
  point.along = scaled(m, s);
  point.of_turn = add(scaled(m, s * g), scaled(met.frame.normal, of_facing));
  point.master_turn = of_facing;
  point.master_normal = met.frame.normal;
  point.turn_of_master = turns_of(met.placed, met.frame, facet_centre(met.placed.size));
  found.least_gap = std::min(found.least_gap, point.gap);
  found.points.push_back(point);
}

}  // namespace carom
