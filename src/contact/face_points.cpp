#include "contact/face_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "math/vec3.hpp"
#include "model/bodies.hpp"
#include "surface/facet_projection.hpp"
#include "surface/half_thickness.hpp"
#include "surface/overlap_column.hpp"

namespace carom {
namespace {

constexpr double face_look = 1.5;              // of the facet size: overlaps within count
constexpr double least_facing_of_faces = 0.2;  // c_0
constexpr double least_facing_of_means = 0.5;  // cosine of 60 degrees
constexpr double smooth_edge = 0.9;            // the same, of those whose parts at their common edge cancel

/// s as a function of c.
double facing_factor(double c) {
  const double t = (c - least_facing_of_faces) / (1.0 - least_facing_of_faces);
  return t * t * (3.0 - 2.0 * t);
}

double radius_about(const Vec3& centre, const PlacedFacet& facet) {
  double most = 0.0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) {
    const Vec3 r = subtract(facet.x[a], centre);
    most = std::max(most, dot(r, r));
  }
  return std::sqrt(most);
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

/// A slave facet's column, and the facet in the reference configuration.
struct FaceOverlaps::Slave : OverlapColumn {
  std::size_t f;
  PlacedFacet reference;
  double radius = 0.0;  ///< of a ball about its centre that holds it
  double bulge;         ///< distance_from_facet

  Slave(std::size_t number, const PlacedFacet& now, const PlacedFacet& before, double from_facet)
      : OverlapColumn(now),
        f(number),
        reference(before),
        radius(radius_about(frame().position, now)),
        bulge(from_facet),
        quotient_(now.size == 4 ? 0.0 : quotient_at(facet_centre(now.size))) {}
  /// Reference measure over the current one; the same everywhere but on quadrilaterals.
  double measure_at(const ParentPoint& at) const { return placed().size == 4 ? quotient_at(at) : quotient_; }

 private:
  double quotient_at(const ParentPoint& at) const {
    const FacetShape shape = facet_shape(placed().size, at.xi, at.eta);
    const auto jacobian = [&](const PlacedFacet& facet) {
      const FacetFrame tangents = facet_tangents(facet, shape);
      return norm(cross(tangents.a_1, tangents.a_2));
    };
    const double now = jacobian(placed());
    return now > 0.0 ? jacobian(reference) / now : 0.0;
  }

  double quotient_;
};

/// How a master facet in the column faces the slave.
struct FaceOverlaps::Met {
  double facing;          ///< c
  double area;            ///< of the overlap
  bool may_stand_beyond;  ///< has not come in from the front within the step
};

/// The overlaps of a column in the making.
struct FaceOverlaps::Work {
  std::vector<ColumnMaster> masters;
  std::vector<Met> met;  ///< of each of them
  std::vector<OverlapPoint> points;
  std::vector<Index> slivers;  ///< masters with an overlap that is too deep for its width, and left out
};

FaceOverlaps::FaceOverlaps(const Model& model, const Surface& slave, const Surface& master, bool self, OverlapUse use)
    : X_(model.mesh->coordinates),
      slave_(slave),
      size_(std::max(mean_facet_size(X_, slave.facets), mean_facet_size(X_, master.facets))),
      use_(use),
      depth_(self ? half_thickness(X_, master.facets, bodies_of_nodes(model), size_)
                  : std::vector<double>(master.facets.size(), size_)),
      slave_faces_(parent_faces(*model.mesh, slave.facets)),
      master_faces_(parent_faces(*model.mesh, master.facets)),
      beside_(facets_beside(master.facets)),
      broad_phase_(slave.facets, master.facets, face_look * size_, 0.5 * mean_facet_size(X_, master.facets)) {}

void FaceOverlaps::update(const ContactMotion& motion, std::vector<std::array<Index, 4>> behind) {
  broad_phase_.update(motion.x_begin, motion.displacement);
  behind_ = std::move(behind);
  looks_.resize(broad_phase_.pair_count() > 0 ? master_faces_.size() : 0);
  parallel_each(looks_.size(), [&](std::size_t g) {
    const PlacedFacet facet = place(master_facet(static_cast<Index>(g)), motion.x);
    const ParentPoint centre = facet_centre(facet.size);
    const FacetFrame frame = facet_frame(facet, centre.xi, centre.eta);
    looks_[g] = {frame.position, frame.normal, radius_about(frame.position, facet),
                 distance_from_facet(master_faces_[g], master_facet(static_cast<Index>(g)), motion.x)};
  });
}

/// True when a corner of the slave facet was behind this facet or one beside it that goes on with it, and that faced
/// the slave: what is deep under it has gone in there, and is not the far side of a thin part.
bool FaceOverlaps::was_behind(const Slave& slave, Index g) const {
  const Facet& facet = master_facet(g);
  return std::any_of(behind_[slave.f].begin(), behind_[slave.f].end(), [&](Index met) {
    if (met < 0 || met == g) return met == g;
    const Facet& other = master_facet(met);
    const bool is_beside = std::any_of(
        other.begin(), other.end(), [&](Index n) { return std::find(facet.begin(), facet.end(), n) != facet.end(); });
    if (!is_beside) return false;
    const Vec3& n = looks_[static_cast<std::size_t>(met)].normal;
    return dot(n, looks_[static_cast<std::size_t>(g)].normal) > going_on &&
           -dot(n, slave.normal()) > least_facing_of_faces;
  });
}

/// True where a facet beside an edge of g, turned by little, is among the masters.
bool FaceOverlaps::goes_on(Index g, const Work& work) const {
  const std::array<Index, 4>& beside = beside_[static_cast<std::size_t>(g)];
  return std::any_of(work.masters.begin(), work.masters.end(), [&](const ColumnMaster& master) {
    const auto edge = std::find(beside.begin(), beside.end(), master.facet);
    return edge != beside.end() && !ends_at(g, static_cast<std::size_t>(edge - beside.begin()));
  });
}

/// True where a deep point stands outside of the other body: the way from there along the slave's inward normal leads
/// into that body, through a facet that shows its back, before it comes out at the master.
bool FaceOverlaps::stands_beyond(const Slave& slave, const ContactMotion& motion, const ParentPoint& at,
                                 double gap) const {
  constexpr double at_the_edge = 0.999;  // there the back begins where the master ends
  if (!(gap < -sideways_depth * size_)) return false;
  const Vec3 x = facet_position(slave.placed(), at.xi, at.eta);
  const std::span<const Index> candidates = broad_phase_.targets_of(slave.f);
  return std::any_of(candidates.begin(), candidates.end(), [&](Index h) {
    if (!(dot(looks_[static_cast<std::size_t>(h)].normal, slave.normal()) > least_facing_of_faces)) return false;
    const std::optional<RayHit> hit = intersect(place(master_facet(h), motion.x), x, slave.normal());
    return hit && hit->distance < 0.0 && hit->distance > at_the_edge * gap;
  });
}

/// How many times as deep as wide an overlap with master g may be to have come in from the front. One that ends at a
/// border of the other surface is deep by the width times the tangent of the angle that the facets are turned by
/// against each other (twice that is allowed, since the width is a mean), or it is what two edges leave that cross, and
/// which their own rows hold. In the plane there are none.
double FaceOverlaps::most_steep(Index g, double facing) const {
  constexpr double most = 10.0;
  const auto edges = static_cast<std::size_t>(master_facet(g).size);
  bool has_border = false;
  for (std::size_t edge = 0; edge < edges; ++edge) has_border = has_border || ends_at(g, edge);
  if (!has_border || edges == 2) return most;
  return std::clamp(2.0 * std::sqrt(std::max(0.0, 1.0 - facing * facing)) / facing, 1.0, most);
}

/// By how much, along the slave's normal, two faces may be nearer to each other than their facets.
double FaceOverlaps::nearer_by(const Slave& slave, Index g, double facing) const {
  return (slave.bulge + looks_[static_cast<std::size_t>(g)].bulge) / facing;
}

/// Enters master g and appends its points, if it counts.
void FaceOverlaps::add_master(const Slave& slave, Index g, const ContactMotion& motion, Work& work) const {
  const Look& look = looks_[static_cast<std::size_t>(g)];
  const double facing = -dot(look.normal, slave.normal());
  if (facing <= (use_ == OverlapUse::means ? least_facing_of_means : least_facing_of_faces)) return;
  const Vec3 away = subtract(look.centre, slave.frame().position);
  const double height = dot(away, slave.normal()), reach = slave.radius + look.radius;
  if (dot(away, away) - height * height > reach * reach || height > face_look * size_ + reach) return;
  const PlacedFacet master = place(master_facet(g), motion.x), seen = slave.seen(master);
  if (!slave.may_overlap(seen, face_look * size_)) return;
  const bool are_means = use_ == OverlapUse::means;
  const bool is_high = !slave_faces_[slave.f].is_linear || !master_face(g).is_linear;
  const std::size_t before = work.points.size();
  const double nearer = are_means ? 0.0 : nearer_by(slave, g, facing);
  const OverlapExtent extent = add_overlap(slave, seen, {is_high || are_means, !are_means, nearer}, work.points);
  if (work.points.size() == before) return;
  const bool is_deep = extent.least_gap < -sideways_depth * size_;
  // A sliver too deep for its width belongs to what passes by the border of the other facet; at the start not where
  // that goes on.
  const double length = slave.placed().size == 2 ? 1.0 : std::sqrt(slave.measure());
  const bool is_wide = !is_deep || most_steep(g, facing) * extent.area >= -extent.least_gap * length ||
                       (motion.history.empty() && goes_on(g, work));
  // Without a history, at the start, all that is wide counts, but the far side of a thin part.
  const auto has_been_behind = [&] {
    return motion.history.empty() ? extent.least_gap >= -depth_[static_cast<std::size_t>(g)] : was_behind(slave, g);
  };
  const auto was_in_front = [&] {
    return is_in_front(place(slave_.facets[slave.f], motion.x_begin), place(master_facet(g), motion.x_begin),
                       work.points[before], size_);
  };
  const bool has_come_in = !is_deep || (is_wide && has_been_behind());
  if (extent.least_gap > face_look * size_ || (!has_come_in && !was_in_front())) {
    work.points.resize(before);
    if (!is_wide) work.slivers.push_back(g);
    return;
  }
  const bool may_stand_beyond = is_deep && has_come_in;
  if (may_stand_beyond) {
    const auto first = work.points.begin() + static_cast<std::ptrdiff_t>(before);
    const auto is_out = [&](const OverlapPoint& q) { return stands_beyond(slave, motion, q.slave, q.gap); };
    work.points.erase(std::remove_if(first, work.points.end(), is_out), work.points.end());
  }
  work.masters.push_back({g, master, seen, before, work.points.size()});
  work.met.push_back({facing, extent.area, may_stand_beyond});
}

void FaceOverlaps::find(std::size_t f, const ContactMotion& motion, FacetPoints& found) const {
  found.points.clear();
  found.border.clear();
  found.masters.clear();
  found.least_gap = INFINITY;
  const std::span<const Index> candidates = broad_phase_.targets_of(f);
  if (candidates.empty()) return;
  const Slave slave(f, place(slave_.facets[f], motion.x), place(slave_.facets[f], X_),
                    distance_from_facet(slave_faces_[f], slave_.facets[f], motion.x));
  Work work;
  for (const Index g : candidates) add_master(slave, g, motion, work);
  for (const Index g : std::exchange(work.slivers, {})) add_master(slave, g, motion, work);
  double covered = 0.0;
  for (const Met& met : work.met) covered += met.area;
  if (covered > slave.measure() * (1.0 + 1e-6)) hide_layers(slave, work.masters, work.points);
  found.normal = slave.normal();
  found.turn = turn_of_normal(slave.placed(), slave.frame());
  for (std::size_t k = 0; k < work.masters.size(); ++k) {
    const ColumnMaster& master = work.masters[k];
    const ParentPoint centre = facet_centre(master.placed.size);
    const FacetFrame frame = facet_frame(master.placed, centre.xi, centre.eta);
    found.masters.push_back({master.facet, frame.normal, turn_of_normal(master.placed, frame)});
    for (std::size_t q = master.begin; q < master.end; ++q)
      if (work.points[q].weight > 0.0)
        add_point(slave, master.placed, work.met[k].facing, work.points[q], motion, found);
  }
  if (use_ != OverlapUse::springs || !(found.least_gap < 0.0)) return;
  for (std::size_t k = 0; k < work.masters.size(); ++k) add_borders(slave, work, k, motion, found);
}

/// Reference thickness of the slave at a point: 1 in three dimensions.
double FaceOverlaps::width_at(const Slave& slave, const ParentPoint& at) const {
  if (slave.placed().size > 2) return 1.0;
  if (slave_.section != Section::axisymmetric) return slave_.thickness;
  return 2.0 * std::numbers::pi * facet_position(slave.reference, at.xi, at.eta)[0];
}

/// True when the master's surface does not go on beyond an edge with a facet that is turned by little: there the parts
/// of both facets cancel.
bool FaceOverlaps::ends_at(Index master, std::size_t edge) const {
  const Index next = beside_[static_cast<std::size_t>(master)][edge];
  const auto normal = [&](Index g) { return looks_[static_cast<std::size_t>(g)].normal; };
  return next < 0 || dot(normal(next), normal(master)) < smooth_edge;
}

namespace {

/// A point of a face where the line from x along n meets it, from a near point on: Newton's method in the plane normal
/// to n. The near point where the line passes by the face, whose shape functions say nothing out there.
ParentPoint on_line(const ParentFace& face, std::span<const Vec3> x_nodes, const Vec3& x, const Vec3& n,
                    const ParentPoint& near) {
  constexpr double beyond = 0.25;  // of the parent square: linear pieces are less far from their faces
  const bool is_segment = dimension(face.type) == 1;
  ParentPoint at = near;
  for (int i = 0; i < 4; ++i) {
    const FacetFrame frame = face_frame(face, face_shape(face, at), x_nodes);
    const Vec3 away = subtract(x, frame.position), r = subtract(away, scaled(n, dot(away, n)));
    const Vec3 p = subtract(frame.a_1, scaled(n, dot(frame.a_1, n)));
    const Vec3 q = subtract(frame.a_2, scaled(n, dot(frame.a_2, n)));
    const double pp = dot(p, p), qq = dot(q, q), pq = is_segment ? 0.0 : dot(p, q), det = pp * qq - pq * pq;
    if (!(det > 0.0)) return near;
    at.xi += (qq * dot(p, r) - pq * dot(q, r)) / det;
    if (!is_segment) at.eta += (pp * dot(q, r) - pq * dot(p, r)) / det;
    if (!(std::abs(at.xi - near.xi) < beyond && std::abs(at.eta - near.eta) < beyond)) return near;
  }
  return at;
}

/// Two points that lie over each other along the slave's normal, on the faces that the facets are pieces of.
struct FacesMeet {
  FaceShape own, other;
  Vec3 position, other_normal;  ///< of the slave's point, and of the master's face
  double gap = 0.0;
};

/// own_at and other_at: in the parent elements of the faces, the latter near the point looked for.
FacesMeet faces_meet(const ParentFace& own, const ParentPoint& own_at, const ParentFace& other,
                     const ParentPoint& other_at, const Vec3& normal, std::span<const Vec3> x) {
  FacesMeet out;
  out.own = face_shape(own, own_at);
  out.position = face_frame(own, out.own, x).position;
  out.other = face_shape(other, on_line(other, x, out.position, normal, other_at));
  const FacetFrame there = face_frame(other, out.other, x);
  out.other_normal = there.normal;
  out.gap = dot(subtract(there.position, out.position), normal);
  return out;
}

}  // namespace

void FaceOverlaps::add_borders(const Slave& slave, const Work& work, std::size_t k, const ContactMotion& motion,
                               FacetPoints& found) const {
  const ColumnMaster& master = work.masters[k];
  const ParentFace &own = slave_faces_[slave.f], &other = master_face(master.facet);
  const double s = facing_factor(work.met[k].facing);
  std::vector<BorderPoint> border;
  for (std::size_t edge = 0; edge < static_cast<std::size_t>(master.placed.size); ++edge) {
    if (!ends_at(master.facet, edge)) continue;
    border.clear();
    add_border(slave, master.seen, edge, nearer_by(slave, master.facet, work.met[k].facing), border);
    for (const BorderPoint& at : border) {
      if (work.met[k].may_stand_beyond && stands_beyond(slave, motion, at.slave, at.gap)) continue;
      const ParentPoint own_at = in_parent(own, slave_.facets[slave.f], at.slave),
                        other_at = in_parent(other, master_facet(master.facet), at.master);
      FacePoint point;
      point.rise = at.gap;
      if (!own.is_linear || !other.is_linear)
        point.rise = faces_meet(own, own_at, other, other_at, slave.normal(), motion.x).gap;
      if (!(point.rise < 0.0)) continue;
      point.weight = at.length * slave.measure_at(at.slave) * width_at(slave, at.slave);
      point.gap = s * point.rise;
      point.master = k;
      point.share = facet_shape(slave.placed().size, at.slave.xi, at.slave.eta).N;
      point.N = point.N_slide = face_shape(own, own_at).N;
      point.N_master = face_shape(other, other_at).N;
      point.along = at.outward;
      point.of_turn = scaled(at.outward, point.rise);
      found.border.push_back(point);
    }
  }
}

/// A point of the last master found, which is at placed_master.
void FaceOverlaps::add_point(const Slave& slave, const PlacedFacet& placed_master, double facing,
                             const OverlapPoint& at, const ContactMotion& motion, FacetPoints& found) const {
  const FacetPoints::Master& master = found.masters.back();
  const ParentFace &own = slave_faces_[slave.f], &other = master_face(master.facet);
  const Facet& facet = slave_.facets[slave.f];
  const FacetShape facet_N = facet_shape(facet.size, at.slave.xi, at.slave.eta);
  FacePoint point;
  point.share = facet_N.N;
  Vec3 other_normal;
  double g = at.gap;
  if (own.is_linear && other.is_linear) {
    const FacetShape other_N = facet_shape(placed_master.size, at.master.xi, at.master.eta);
    for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) {
      point.N[a] = facet_N.N[a];
      point.position = add(point.position, scaled(slave.placed().x[a], facet_N.N[a]));
    }
    std::copy(other_N.N.begin(), other_N.N.end(), point.N_master.begin());
    other_normal = placed_master.size == 4 ? facet_frame(placed_master, other_N).normal : master.normal;
  } else {
    const FacesMeet meet =
        faces_meet(own, in_parent(own, facet, at.slave), other, in_parent(other, master_facet(master.facet), at.master),
                   slave.normal(), motion.x);
    point.N = meet.own.N;
    point.N_master = meet.other.N;
    point.position = meet.position;
    other_normal = meet.other_normal;
    g = meet.gap;
  }
  point.N_slide = point.N;
  const double cosine = dot(other_normal, slave.normal());
  const bool is_mean = use_ == OverlapUse::means;
  if (!(cosine < (is_mean ? -least_facing_of_means : -0.5 * least_facing_of_faces))) return;
  const double t = is_mean ? 1.0 : (facing - least_facing_of_faces) / (1.0 - least_facing_of_faces);
  const double s = is_mean ? 1.0 : facing_factor(facing);
  const double of_facing = g * 6.0 * t * (1.0 - t) / (1.0 - least_facing_of_faces);  // dg~ / dc
  const Vec3 m = scaled(other_normal, 1.0 / cosine);
  point.weight = at.weight * slave.measure_at(at.slave) * width_at(slave, at.slave);
  point.gap = s * g;
  point.rise = g;
  point.master = found.masters.size() - 1;
  point.along = scaled(m, s);
  point.of_turn = add(scaled(m, s * g), scaled(master.normal, of_facing));
  point.of_master_turn = scaled(slave.normal(), of_facing);
  found.least_gap = std::min(found.least_gap, point.gap);
  found.points.push_back(point);
}

}  // namespace carom
