#include "contact/smooth_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/vec3.hpp"
#include "model/bodies.hpp"
#include "parallel/threads.hpp"
#include "surface/facet_projection.hpp"
#include "surface/feature_edges.hpp"
#include "surface/half_thickness.hpp"
#include "surface/overlap_column.hpp"

namespace carom {
namespace {

constexpr int halvings = 3;          // of parts that the surface of the gap 0 goes through
constexpr int halvings_at_pole = 5;  // of those that the normals there are nearly opposite in
constexpr double least_facing = 0.2;
constexpr double same_way = 0.5;  // product of the normals of the slave and of what is the far side of the master
constexpr double look = 0.1;      // of the facet size: how far before each other facets are looked at
constexpr double reach = 1.5;     // of the facet size: of the lists
constexpr double beyond = 0.01;   // in parent coordinates: feet beyond a smooth edge
constexpr double on_edge = 1e-10;
constexpr double safety = 1.5;  // on the curvature that parts are ruled out by

ParentFace linear_face(const Facet& facet) {
  ParentFace face;
  face.size = facet.size;
  std::copy(facet.begin(), facet.end(), face.node.begin());
  return face;
}

std::vector<ParentFace> linear_faces(std::span<const Facet> facets) {
  std::vector<ParentFace> faces;
  for (const Facet& facet : facets) faces.push_back(linear_face(facet));
  return faces;
}

/// How far a point is inside of each edge of its facet, in parent coordinates; by edge, of a segment by end.
std::array<double, 4> inside_of_edges(int size, const ParentPoint& p) {
  if (size == 2) return {p.xi + 1.0, 1.0 - p.xi, 1.0, 1.0};
  if (size == 3) return {p.eta, 1.0 - p.xi - p.eta, p.xi, 1.0};
  return {p.eta + 1.0, 1.0 - p.xi, 1.0 - p.eta, p.xi + 1.0};
}

}  // namespace

/// A master facet that may be met.
struct SmoothPoints::Near {
  Index facet;
  const SmoothPatch* patch;
  Bounds box;
  double depth;            ///< that counts
  double shallow;          ///< that counts whatever was before
  bool faces;              ///< the slave
  bool is_way_out;         ///< from behind
  std::size_t number = 0;  ///< in FacetPoints::masters, plus one; 0: not there yet
};

/// A part of the slave facet: its corners in parent coordinates.
struct SmoothPoints::Part {
  std::array<ParentPoint, 4> corner;
  int level = 0;

  ParentPoint middle(int size) const {
    ParentPoint p;
    for (std::size_t a = 0; a < static_cast<std::size_t>(size); ++a) {
      p.xi += corner[a].xi / size;
      p.eta += corner[a].eta / size;
    }
    return p;
  }
};

std::vector<SmoothPoints::Part> SmoothPoints::halved(const Part& part, int size) {
  const auto n = static_cast<std::size_t>(size);
  const ParentPoint middle = part.middle(size);
  std::array<ParentPoint, 4> between{};
  for (std::size_t a = 0; a < n; ++a) {
    const ParentPoint &p = part.corner[a], &q = part.corner[(a + 1) % n];
    between[a] = {0.5 * (p.xi + q.xi), 0.5 * (p.eta + q.eta)};
  }
  const int level = part.level + 1;
  if (size == 2) return {{{part.corner[0], middle}, level}, {{middle, part.corner[1]}, level}};
  std::vector<Part> parts;
  for (std::size_t a = 0; a < n; ++a) {
    const ParentPoint& last = between[(a + n - 1) % n];
    if (size == 4)
      parts.push_back({{part.corner[a], between[a], middle, last}, level});
    else
      parts.push_back({{part.corner[a], between[a], last}, level});
  }
  if (size == 3) parts.push_back({{between[0], between[1], between[2]}, level});
  return parts;
}

struct SmoothPoints::Work {
  std::size_t f;
  SmoothPatch slave;
  PlacedFacet reference;
  double radius;     ///< of the slave about its middle
  double curvature;  ///< of both sides together
  bool is_bent;      ///< the master has edges that are not smooth, or is seen from several sides
  std::span<const Vec3> x_begin;
  std::vector<Near> near;
  FacetPoints& found;
};

struct SmoothPoints::Foot {
  std::size_t near;
  ParentPoint at;
  FacetFrame frame;
  double gap;
};

SmoothPoints::SmoothPoints(const Model& model, SmoothSides sides)
    : X_(model.mesh->coordinates),
      sides_(std::move(sides)),
      size_(std::max(mean_facet_size(X_, sides_.slave.facets), mean_facet_size(X_, sides_.master.facets))),
      bodies_(bodies_of_nodes(model)),
      depth_(sides_.self ? half_thickness(X_, sides_.master.facets, bodies_, size_)
                         : std::vector<double>(sides_.master.facets.size(), size_)),
      factor_(covered_shares(sides_.master.facets, *sides_.of_master)),
      slave_faces_(linear_faces(sides_.slave.facets)),
      master_faces_(linear_faces(sides_.master.facets)),
      is_open_(has_open_edges(sides_.master.facets)),
      broad_phase_(sides_.slave.facets, sides_.master.facets, reach * size_,
                   0.5 * mean_facet_size(X_, sides_.master.facets)) {
  for (double& factor : factor_) factor = 2.0 - factor;
}

namespace {

/// Of a patch.
Bounds box_of(const SmoothPatch& patch, double more) {
  Bounds box;
  for (int a = 0; a < patch.facet().size; ++a) box.include(patch.facet().x[static_cast<std::size_t>(a)]);
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] -= patch.rise() + more;
    box.high[c] += patch.rise() + more;
  }
  return box;
}

}  // namespace

void SmoothPoints::update(const ContactMotion& motion, std::vector<std::array<Index, 4>> behind) {
  broad_phase_.update(motion.x_begin, motion.displacement);
  behind_ = std::move(behind);
  place_masters(motion);
}

/// The patches of all masters on the lists.
void SmoothPoints::place_masters(const ContactMotion& motion) {
  if (active_since_ != broad_phase_.builds()) {
    active_since_ = broad_phase_.builds();
    std::vector<bool> is_active(master_faces_.size());
    for (std::size_t f = 0; f < slave_faces_.size(); ++f)
      for (const Index g : broad_phase_.targets_of(f)) is_active[static_cast<std::size_t>(g)] = true;
    active_.clear();
    for (std::size_t g = 0; g < is_active.size(); ++g)
      if (is_active[g]) active_.push_back(static_cast<Index>(g));
    placed_.resize(master_faces_.size());
  }
  constexpr std::size_t grain = 64;  // facets per task: some ten microseconds of work
  parallel_for(active_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index g = active_[i];
      const SmoothPatch patch(place(master_facet(g), motion.x), sides_.of_master->bulge(g));
      placed_[static_cast<std::size_t>(g)] = Placed{patch, box_of(patch, 0.0)};
    }
  });
}

void SmoothPoints::find(std::size_t f, const ContactMotion& motion, FacetPoints& found) const {
  found.points.clear();
  found.border.clear();
  found.masters.clear();
  found.least_gap = INFINITY;
  if (broad_phase_.targets_of(f).empty()) return;
  const Facet& facet = sides_.slave.facets[f];
  Work work{f,
            SmoothPatch(place(facet, motion.x), sides_.of_slave->bulge(static_cast<Index>(f))),
            place(facet, X_),
            0.0,
            0.0,
            false,
            motion.x_begin,
            {},
            found};
  find_near(f, motion, work);
  if (work.near.empty()) return;
  found.normal = work.slave.centre().normal;
  found.turn = turn_of_normal(work.slave.facet(), work.slave.centre());
  Part whole;
  if (facet.size == 2)
    whole.corner = {{{-1.0, 0.0}, {1.0, 0.0}}};
  else if (facet.size == 3)
    whole.corner = {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
  else
    whole.corner = {{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};
  visit(whole, work);
}

/// The masters whose boxes come near that of the slave and that face it.
void SmoothPoints::find_near(std::size_t f, const ContactMotion& motion, Work& work) const {
  const SmoothPatch& slave = work.slave;
  const Bounds own = box_of(slave, look * size_);
  double of_master = 0.0;
  for (const Index g : broad_phase_.targets_of(f)) {
    const auto& [patch, box] = *placed_[static_cast<std::size_t>(g)];
    const double cosine = dot(patch.centre().normal, slave.centre().normal);
    // Other faces of the slave's own body are no ways out.
    const bool faces = -cosine > least_facing, is_own = body_of(sides_.slave.facets[f]) == body_of(master_facet(g));
    if (is_own && !faces) continue;
    // What is behind a facet is looked for from as deep as it counts.
    const bool was_met = was_behind(f, g, motion);
    const double most = was_met ? reach * size_ : depth_[static_cast<std::size_t>(g)];
    Bounds wide = box;
    for (std::size_t c = 0; c < 3; ++c) {
      const double n = patch.centre().normal[c];
      wide.low[c] -= std::max(0.0, n) * most;
      wide.high[c] += std::max(0.0, -n) * most;
    }
    bool is_apart = false;
    for (std::size_t c = 0; c < 3; ++c) is_apart = is_apart || own.low[c] > wide.high[c] || wide.low[c] > own.high[c];
    if (is_apart) continue;
    of_master = std::max(of_master, patch.curvature());
    for (std::size_t k = 0; k < static_cast<std::size_t>(patch.facet().size); ++k)
      work.is_bent = work.is_bent || !sides_.of_master->goes_on(g, k);
    const bool any_depth = was_met || motion.history.empty() || !(is_open_ || is_own);
    work.near.push_back({g, &patch, wide, most, any_depth ? most : sideways_depth * size_, faces, cosine < same_way});
  }
  const Vec3 middle = slave.centre().position;
  for (int a = 0; a < slave.facet().size; ++a)
    work.radius = std::max(work.radius, norm(subtract(slave.facet().x[static_cast<std::size_t>(a)], middle)));
  work.radius += slave.rise();
  work.curvature = safety * (slave.curvature() + of_master);
}

/// True when a corner of slave facet f was behind master facet g or one beside it that goes on with it.
bool SmoothPoints::was_behind(std::size_t f, Index g, const ContactMotion& motion) const {
  const auto normal = [&](Index of) { return SmoothPatch(place(master_facet(of), motion.x), {}).centre().normal; };
  const Facet& facet = master_facet(g);
  return std::any_of(behind_[f].begin(), behind_[f].end(), [&](Index met) {
    if (met < 0 || met == g) return met == g;
    const Facet& other = master_facet(met);
    return std::find_first_of(other.begin(), other.end(), facet.begin(), facet.end()) != other.end() &&
           dot(normal(met), normal(g)) > going_on;
  });
}

/// True when the slave's point was in front of the master's at the beginning of the step, or hardly behind.
bool SmoothPoints::was_in_front(const ParentPoint& of_slave, const ParentPoint& of_master, const Near& near,
                                const Work& work) const {
  const SmoothPatch slave(place(sides_.slave.facets[work.f], work.x_begin),
                          sides_.of_slave->bulge(static_cast<Index>(work.f)));
  const SmoothPatch master(place(master_facet(near.facet), work.x_begin), sides_.of_master->bulge(near.facet));
  const FacetFrame foot = master.at(of_master);
  return dot(foot.normal, subtract(slave.at(of_slave).position, foot.position)) > -near.shallow;
}

std::optional<SmoothPoints::Foot> SmoothPoints::foot_of(const ParentPoint& point, const FacetFrame& at,
                                                        const Work& work) const {
  std::optional<Foot> best;
  double least = INFINITY;
  for (std::size_t i = 0; i < work.near.size(); ++i) {
    const Near& near = work.near[i];
    bool is_apart = false;
    for (std::size_t c = 0; c < 3; ++c)
      is_apart = is_apart || at.position[c] > near.box.high[c] + look * size_ ||
                 at.position[c] < near.box.low[c] - look * size_;
    if (is_apart) continue;
    const std::optional<ParentPoint> p = near.patch->foot(at.position);
    if (!p) continue;
    const std::array<double, 4> inside = inside_of_edges(near.patch->facet().size, *p);
    bool is_inside = true;
    for (std::size_t k = 0; k < 4; ++k)
      is_inside = is_inside && inside[k] >= (sides_.of_master->goes_on(near.facet, k) ? -beyond : -on_edge);
    if (!is_inside) continue;
    const FacetFrame frame = near.patch->at(*p);
    const double gap = dot(subtract(at.position, frame.position), frame.normal);
    if (std::abs(gap) >= least) continue;
    const double cosine = dot(frame.normal, at.normal);
    if (gap < 0.0 && (gap < -near.depth || !near.is_way_out || !(cosine < same_way))) continue;
    if (gap < -near.shallow && !was_in_front(point, *p, near, work)) continue;
    least = std::abs(gap);
    best.reset();  // what is in front of the nearest facet is outside
    if (gap < 0.0 || (near.faces && cosine < 0.0)) best = Foot{i, *p, frame, gap};
  }
  if (best && best->gap < 0.0 && work.is_bent && is_outside(at.position, -best->gap, work)) return std::nullopt;
  return best;
}

/// True of a point that is in front of a facet, nearer than `depth`, also where that is at an edge or a corner.
bool SmoothPoints::is_outside(const Vec3& x, double depth, const Work& work) const {
  return std::ranges::any_of(work.near, [&](const Near& near) {
    const Projection p = project(near.patch->facet(), x);
    const FacetFrame there = near.patch->at({p.xi, p.eta});
    const Vec3 way = subtract(x, there.position);
    return dot(way, there.normal) > 0.0 && norm(way) < depth;
  });
}

/// Reference measure of a part, by its density at p.
double SmoothPoints::measure_of(const Part& part, const ParentPoint& p, const Work& work) const {
  const int size = work.reference.size;
  const double parts = std::ldexp(1.0, size == 2 ? part.level : 2 * part.level);
  const double of_parent = size == 2 ? 2.0 : size == 3 ? 0.5 : 4.0;
  double w = facet_frame(work.reference, p.xi, p.eta).jacobian * of_parent / parts;
  if (size == 2)
    w *= sides_.slave.section == Section::axisymmetric
             ? 2.0 * std::numbers::pi * facet_position(work.reference, p.xi, p.eta)[0]
             : sides_.slave.thickness;
  return w;
}

/// Halves a part of the slave facet until it cannot be met, is met everywhere, or is small.
void SmoothPoints::visit(const Part& part, Work& work) const {
  const int size = work.reference.size;
  const FacetFrame at = work.slave.at(part.middle(size));
  const std::optional<Foot> foot = foot_of(part.middle(size), at, work);
  int most = halvings;
  if (foot) {
    const double radius = std::ldexp(work.radius, -part.level), turn = work.curvature * radius;
    const double sine = norm(cross(at.normal, foot->frame.normal));
    const double change = radius * (work.is_bent ? 1.0 : std::min(1.0, sine + turn));
    if (foot->gap < -change && part.level > 0) {
      add_rule(part, work);
      return;
    }
    if (sine < 2.0 * turn) most = halvings_at_pole;
    if (foot->gap > change) most = part.level;
  }
  if (part.level < most) {
    for (const Part& half : halved(part, size)) visit(half, work);
  } else if (foot) {
    add_point(part.middle(size), measure_of(part, part.middle(size), work), at, *foot, work);
  }
}

/// The points of a part that is met everywhere: degree 2 or 3, by which what presses linearly is exact.
void SmoothPoints::add_rule(const Part& part, Work& work) const {
  const int size = work.reference.size;
  const auto n = static_cast<std::size_t>(size);
  // Triangle: the middles between corners and centre. Segment and quadrilateral: Gauss points.
  const double along = size == 3 ? 0.5 : 1.0 / std::numbers::sqrt3;
  const ParentPoint middle = part.middle(size);
  for (std::size_t a = 0; a < n; ++a) {
    const ParentPoint& corner = part.corner[a];
    const ParentPoint p{middle.xi + along * (corner.xi - middle.xi), middle.eta + along * (corner.eta - middle.eta)};
    const FacetFrame at = work.slave.at(p);
    if (const std::optional<Foot> foot = foot_of(p, at, work))
      add_point(p, measure_of(part, p, work) / size, at, *foot, work);
  }
}

void SmoothPoints::add_point(const ParentPoint& p, double measure, const FacetFrame& at, const Foot& foot,
                             Work& work) const {
  FacetPoints& found = work.found;
  Near& near = work.near[foot.near];
  if (near.number == 0) {
    found.masters.push_back(
        {near.facet, near.patch->centre().normal, turn_of_normal(near.patch->facet(), near.patch->centre())});
    near.number = found.masters.size();
  }
  const Vec3 below = facet_position(work.slave.facet(), p.xi, p.eta);
  const Vec3 own_offset = subtract(at.position, below);
  const Vec3 other_offset = subtract(foot.frame.position, facet_position(near.patch->facet(), foot.at.xi, foot.at.eta));
  const Vec3 own = work.slave.components(own_offset);
  const Vec3 met = work.slave.components(subtract(foot.frame.position, below));
  const Vec3 other = near.patch->components(other_offset);
  const std::array<double, 4> N = work.slave.weights(p, own), N_slide = work.slave.weights(p, met);
  const std::array<double, 4> N_master = near.patch->weights(foot.at, other);
  FacePoint point;
  point.weight = measure * factor_[static_cast<std::size_t>(near.facet)];
  point.gap = foot.gap;
  point.bulge = std::max(0.0, dot(at.normal, own_offset)) + std::max(0.0, dot(foot.frame.normal, other_offset));
  point.rise = met[2];
  point.master_rise = other[2];
  point.master = near.number - 1;
  point.share = facet_shape(work.reference.size, p.xi, p.eta).N;
  std::copy(N.begin(), N.end(), point.N.begin());
  std::copy(N_slide.begin(), N_slide.end(), point.N_slide.begin());
  std::copy(N_master.begin(), N_master.end(), point.N_master.begin());
  point.along = scaled(foot.frame.normal, -1.0);
  point.of_turn = scaled(foot.frame.normal, -own[2]);
  point.of_master_turn = scaled(foot.frame.normal, other[2]);
  point.position = at.position;
  found.least_gap = std::min(found.least_gap, point.gap);
  found.points.push_back(point);
}

std::vector<double> covered_shares(std::span<const Facet> facets, const SmoothSurface& surface) {
  std::vector<double> shares;
  for (const Facet& facet : facets) {
    const auto smooth = std::count_if(facet.begin(), facet.end(), [&](Index n) { return surface.is_smooth_node(n); });
    shares.push_back(static_cast<double>(smooth) / facet.size);
  }
  return shares;
}

}  // namespace carom
