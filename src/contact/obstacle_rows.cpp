#include "contact/obstacle_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "contact/contact_kind.hpp"
#include "contact/pair_rows.hpp"
#include "math/vec3.hpp"
#include "model/outer_facets.hpp"
#include "surface/rigid_shapes.hpp"
#include "surface/surface_search.hpp"

namespace carom {
namespace {

/// Where an obstacle stands: at rest, shifted with its carrier, or placed by the nodes of its body.
struct Stand {
  Vec3 shift{};
  std::optional<BodyPlacement> placement{};

  /// The position x as the obstacle in its reference position sees it.
  Vec3 seen(const Vec3& x) const { return placement ? placement->reference(x) : subtract(x, shift); }
  /// Where the point X of the obstacle in its reference position is.
  Vec3 placed(const Vec3& X) const { return placement ? placement->position(X) : add(X, shift); }
};

/// What touches: a node, or a point between the two of a bar, of weight `share` at the second one.
struct TouchingPoint {
  std::array<Index, 2> node{-1, -1};
  double share = 0.0;
  double measure = 0.0;
  double radius = 0.0;  ///< of the bar around the point

  Vec3 at(std::span<const Vec3> x) const {
    const Vec3& a = x[static_cast<std::size_t>(node[0])];
    return share == 0.0 ? a : add(scaled(a, 1.0 - share), scaled(x[static_cast<std::size_t>(node[1])], share));
  }
};

/// The points of a bar: those of its nodes, and `count` between them, which follow each other.
struct TouchingBar {
  std::array<std::size_t, 2> end{};
  std::size_t first = 0, count = 0;
};

/// What every obstacle has: its points with their measures, law and carrier or body.
struct Touching {
  std::span<const Vec3> X;
  std::vector<TouchingPoint> points;  ///< those at nodes by increasing node, then those between the nodes of bars
  std::vector<TouchingBar> bars;
  ContactLaw law;
  Index carrier, source;
  const TurningBody* body;  ///< null: the obstacle does not turn

  Touching(const Model& model, const ObstacleContact& contact, Index contact_source)
      : X(model.mesh->coordinates),
        law(contact.law),
        carrier(contact.carrier),
        source(contact_source),
        body(contact.body < 0 ? nullptr : &model.turning_bodies[static_cast<std::size_t>(contact.body)]) {
    if (contact.measure == RowMeasure::per_node) {
      std::vector<Index> nodes = contact.nodes;
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      for (const Index n : nodes) points.push_back({{n, n}, 0.0, 1.0});
    } else {
      std::map<Index, double> measures = nodal_measures(X, contact.surface);
      measures.merge(nodal_measures(X, contact.loose));
      for (const auto& [n, measure] : measures) points.push_back({{n, n}, 0.0, measure});
    }
    add_bars(contact);
  }

  void add_nodes(std::vector<Index>& nodes) const {
    for (const TouchingPoint& point : points) nodes.insert(nodes.end(), point.node.begin(), point.node.end());
  }
  /// Facets of obstacles keep their numbers.
  void append_keys(SlotKeys& keys) const {
    std::map<std::array<Index, 2>, std::uint64_t> count;
    for (const TouchingPoint& point : points) keys.add(point.node, count[point.node]++);
    keys.meet({});
  }
  /// Where the obstacle stands for positions x of the nodes.
  Stand stand(std::span<const Vec3> x) const {
    if (body != nullptr) return {{}, BodyPlacement(*body, body_frame(*body, nodal_values(*body, x)))};
    return {carrier < 0 ? Vec3{} : subtract(x[carrier], X[carrier])};
  }

  /// The row of point i at `position`, its distance being that of stand.seen(position); at.normal is the gradient of
  /// at.gap.
  void add_row(std::size_t i, const SignedDistance& at, const Vec3& position, const Stand& stand,
               ConstraintRows& rows) const {
    if (stand.placement) {
      add_turning_row(i, at, position, *stand.placement, rows);
      return;
    }
    begin_row(i, at.gap, at.normal, position, rows);
    const Vec3 t_1 = rows.tangent_1.back(), t_2 = rows.tangent_2.back();
    add_own(i, {at.normal, t_1, t_2}, rows);
    if (carrier < 0) return;
    rows.add_block(carrier, {scaled(at.normal, -1.0), scaled(t_1, -1.0), scaled(t_2, -1.0)});
    rows.behind.back() = 1;
  }

 private:
  void begin_row(std::size_t i, double gap, const Vec3& gradient, const Vec3& position, ConstraintRows& rows) const {
    const double measure = points[i].measure;
    rows.add_row(gap - points[i].radius, normalized(gradient), position, measure, row_law(law, measure), source);
  }
  void add_own(std::size_t i, const RowBlock& block, ConstraintRows& rows) const {
    const TouchingPoint& point = points[i];
    if (point.share == 0.0) {
      rows.add_block(point.node[0], block);
      return;
    }
    for (std::size_t a = 0; a < 2; ++a) {
      const double N = a == 0 ? 1.0 - point.share : point.share;
      rows.add_block(point.node[a], {scaled(block[0], N), scaled(block[1], N), scaled(block[2], N)});
    }
  }

  /// The gap is a function of the point X of the body that is at x now, and x = sum of N_a(X) x_a holds for every
  /// motion of the nodes that leaves X in place. So d gap = grad . (dx - sum of N_a dx_a) with the gradient by x,
  /// exactly; its length differs from 1 by the strain of the body.
  void add_turning_row(std::size_t i, const SignedDistance& at, const Vec3& position, const BodyPlacement& placement,
                       ConstraintRows& rows) const {
    const Vec3 gradient = placement.gradient(at.normal);
    begin_row(i, at.gap, gradient, position, rows);
    const RowBlock block{gradient, rows.tangent_1.back(), rows.tangent_2.back()};
    add_own(i, block, rows);
    const std::array<double, 4> N = placement.weights(position);
    for (std::size_t a = 0; a < 4; ++a)
      rows.add_block(body->nodes[a], {scaled(block[0], -N[a]), scaled(block[1], -N[a]), scaled(block[2], -N[a])});
    rows.behind.back() = 4;
  }

  /// Points at the nodes of the bars, and as many between them as the shape asks for; each has its share of the bars'
  /// length times their diameter.
  void add_bars(const ObstacleContact& contact) {
    struct AtNode {
      double measure = 0.0, radius = 0.0;
    };
    std::map<Index, AtNode> at_node;
    std::vector<TouchingPoint> between;
    for (const BarSide& bar : contact.bars) {
      const double length = norm(subtract(X[bar.node[1]], X[bar.node[0]]));
      const std::size_t pieces = bar_pieces(contact, length, bar.radius);
      const double measure = 2.0 * bar.radius * length / static_cast<double>(pieces);
      for (const Index n : bar.node) {
        at_node[n].measure += 0.5 * measure;
        at_node[n].radius = std::max(at_node[n].radius, bar.radius);
      }
      bars.push_back({{}, between.size(), pieces - 1});
      for (std::size_t k = 1; k < pieces; ++k)
        between.push_back({bar.node, static_cast<double>(k) / static_cast<double>(pieces), measure, bar.radius});
    }
    std::map<Index, std::size_t> place;
    for (const auto& [n, at] : at_node) {
      place[n] = points.size();
      points.push_back({{n, n}, 0.0, at.measure, at.radius});
    }
    for (std::size_t b = 0; b < bars.size(); ++b) {
      bars[b].end = {place[contact.bars[b].node[0]], place[contact.bars[b].node[1]]};
      bars[b].first += points.size();
    }
    points.insert(points.end(), between.begin(), between.end());
  }

  /// In how many pieces a bar is looked at: a point of it is at most half a piece away.
  std::size_t bar_pieces(const ObstacleContact& contact, double length, double radius) const;
};

/// What a bar has to be looked at closely for.
struct BarPieces {
  std::span<const Vec3> X;
  double length, radius;

  /// Pieces of an eighth of the curvature's diameter go into a round shape by a 128th of its radius.
  double round(double of_shape, bool inside) const { return inside ? 1.0 : 4.0 * length / (of_shape + radius); }
  double operator()(const Plane&) const { return 1.0; }
  double operator()(const Sphere& sphere) const { return round(sphere.radius, sphere.inside); }
  double operator()(const Cylinder& cylinder) const { return round(cylinder.radius, cylinder.inside); }
  double operator()(const Box& box) const {
    const Vec3 size = subtract(box.upper, box.lower);
    return std::max(8.0, 4.0 * length / std::min({size[0], size[1], size[2]}));
  }
  double operator()(const RigidSurface& rigid) const {
    return std::max(4.0, 4.0 * length / mean_facet_size(X, rigid.surface.facets));
  }
};

std::size_t Touching::bar_pieces(const ObstacleContact& contact, double length, double radius) const {
  constexpr double most = 64.0;
  const double pieces = std::ceil(std::visit(BarPieces{X, length, radius}, contact.shape));
  if (pieces <= most) return static_cast<std::size_t>(pieces);
  throw std::invalid_argument(
      fmt::format("contact \"{}\": a bar of length {:.4g} is too long to see so small an obstacle between its nodes; "
                  "divide the bars (mesh.refine)",
                  contact.name, length));
}

/// The distance of x from a shape, and the face it is taken from.
struct FaceDistance {
  SignedDistance distance;
  Index face = 0;
};

/// A point that was behind a face of a box, or -1, stays behind that face, through the whole box and beyond, until it
/// comes out in front or leaves it sideways.
FaceDistance distance(const Box& box, const Vec3& x, Index behind) {
  const auto axis = static_cast<std::size_t>(behind / 2);
  bool stays = behind >= 0 && distance_to_face(box, x, behind).gap < 0.0;
  for (std::size_t c = 0; c < 3 && stays; ++c) stays = c == axis || (x[c] >= box.lower[c] && x[c] <= box.upper[c]);
  if (stays) return {distance_to_face(box, x, behind), behind};
  return {signed_distance(box, x), nearest_face(box, x)};
}
template <class Shape>
FaceDistance distance(const Shape& shape, const Vec3& x, Index /*behind*/) {
  return {signed_distance(shape, x)};
}

/// Flags of the points that have rows; empty: all. Multipliers hold a bar at its nodes and at one point between them at
/// most: that which is deepest below the line between the gaps of the nodes. More rows than that on two nodes would
/// depend on each other.
template <class Gap>
std::vector<char> held_points(const Touching& touching, const Gap& gap) {
  if (touching.law.hold == RowHold::springs || touching.bars.empty()) return {};
  std::vector<char> held(touching.points.size(), 1);
  for (const TouchingBar& bar : touching.bars) {
    const double at_a = gap(bar.end[0]), at_b = gap(bar.end[1]);
    constexpr double least = 1e-4;  // of the length: what is straight sags by rounding alone
    double deepest = least * norm(subtract(touching.X[touching.points[bar.end[1]].node[0]],
                                           touching.X[touching.points[bar.end[0]].node[0]]));
    std::size_t chosen = bar.first + bar.count;
    for (std::size_t i = bar.first; i < bar.first + bar.count; ++i) {
      held[i] = 0;
      const double share = touching.points[i].share;
      const double sag = (1.0 - share) * at_a + share * at_b - gap(i);
      if (!(sag > deepest)) continue;
      deepest = sag;
      chosen = i;
    }
    if (chosen < bar.first + bar.count) held[chosen] = 1;
  }
  return held;
}

class PlaneRows : public RowMaker {
 public:
  PlaneRows(Touching touching, const Plane& plane) : touching_(std::move(touching)), plane_(plane) {}
  std::size_t slots() const override { return touching_.points.size(); }
  void append_keys(SlotKeys& keys) const override { touching_.append_keys(keys); }
  bool is_fixed() const override { return true; }
  void append(const ContactMotion& /*motion*/, Index first_slot, ConstraintRows& rows) const override {
    for (std::size_t i = 0; i < slots(); ++i) {
      const Vec3 X = touching_.points[i].at(touching_.X);
      touching_.add_row(i, signed_distance(plane_, X), X, {}, rows);
      rows.slot.back() = first_slot + static_cast<Index>(i);
    }
  }

 private:
  Touching touching_;
  Plane plane_;
};

/// Shapes with a distance in closed form that are curved, or turn.
template <class Shape>
class ShapeRows : public RowMaker {
 public:
  ShapeRows(Touching touching, const Shape& shape) : touching_(std::move(touching)), shape_(shape) {}
  std::size_t slots() const override { return touching_.points.size(); }
  void append_keys(SlotKeys& keys) const override { touching_.append_keys(keys); }
  void add_moving_nodes(std::vector<Index>& nodes) const override { touching_.add_nodes(nodes); }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override {
    const Stand stand = touching_.stand(motion.x);
    const std::vector<char> held = held_points(touching_, [&](std::size_t i) {
      return signed_distance(shape_, stand.seen(touching_.points[i].at(motion.x))).gap;
    });
    parts_.append(slots(), rows, [&](std::size_t begin, std::size_t end, ConstraintRows& made) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!held.empty() && held[i] == 0) continue;
        const Vec3 x = touching_.points[i].at(motion.x);
        const FaceDistance at = distance(shape_, stand.seen(x), motion.behind(first_slot + static_cast<Index>(i)));
        touching_.add_row(i, at.distance, x, stand, made);
        made.facet.back() = at.face;
        finish_row(made, motion.u, first_slot + static_cast<Index>(i));
      }
    });
  }

 private:
  Touching touching_;
  Shape shape_;
  mutable RowParts parts_;
};

/// Points against the facets of a rigid surface, seen from the surface: points 0 ... n - 1 are those that may touch,
/// the rest are the surface's own, which rest there.
class RigidSurfaceRows : public RowMaker {
 public:
  RigidSurfaceRows(Touching touching, const Surface& own, const Surface& rigid)
      : touching_(std::move(touching)), search_(make_search(own, rigid)) {}
  std::size_t slots() const override { return touching_.points.size(); }
  void append_keys(SlotKeys& keys) const override { touching_.append_keys(keys); }
  void add_moving_nodes(std::vector<Index>& nodes) const override { touching_.add_nodes(nodes); }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override {
    const Stand begin = touching_.stand(motion.x_begin), stand = touching_.stand(motion.x);
    for (std::size_t i = 0; i < slots(); ++i) {
      x_begin_[i] = begin.seen(touching_.points[i].at(motion.x_begin));
      x_[i] = stand.seen(touching_.points[i].at(motion.x));
      displacement_[i] = subtract(x_[i], x_begin_[i]);
    }
    std::vector<Index> behind = motion.behind(first_slot, slots());
    for (std::size_t i = 0; i < behind.size(); ++i)
      if (touching_.points[i].radius > 0.0) behind[i] = -1;  // it penetrates while its middle is in front
    search_.update(x_begin_, x_, displacement_, std::move(behind));
    const std::vector<char> held = held_points(touching_, [&](std::size_t i) {
      SurfaceSearch::Space space;
      const SurfacePoint* met = search_.find(i, space);
      return met != nullptr ? met->gap : reach_;
    });
    parts_.append(slots(), rows, [&](std::size_t from, std::size_t to, ConstraintRows& made) {
      SurfaceSearch::Space space;
      for (std::size_t i = from; i < to; ++i) {
        if (!held.empty() && held[i] == 0) continue;
        const SurfacePoint* met = search_.find(i, space);
        if (met == nullptr) continue;
        touching_.add_row(i, {met->gradient, met->gap}, touching_.points[i].at(motion.x), stand, made);
        made.facet.back() = met->facet;
        finish_row(made, motion.u, first_slot + static_cast<Index>(i));
      }
    });
  }

 private:
  SurfaceSearch make_search(const Surface& own, const Surface& rigid) {
    std::map<Index, Index> own_point, rigid_point;
    std::vector<Index> points;
    double radius = 0.0;
    for (const TouchingPoint& point : touching_.points) {
      points.push_back(add_point(point.at(touching_.X)));
      if (point.share == 0.0) own_point[point.node[0]] = points.back();
      radius = std::max(radius, point.radius);
    }
    for (const Facet& facet : rigid.facets)
      for (const Index n : facet)
        if (!rigid_point.contains(n)) rigid_point[n] = add_point(touching_.X[n]);
    const std::vector<Facet> own_facets = renumbered(own.facets, own_point);
    const std::vector<Facet> facets = renumbered(rigid.facets, rigid_point);
    const double size = mean_facet_size(x_, facets), reach = std::max(size, mean_facet_size(x_, own_facets));
    reach_ = reach + radius;
    return {points,
            own_facets,
            facets,
            {reach_, 0.5 * size, std::vector<double>(facets.size(), reach), edge_widths(x_, facets)}};
  }
  static std::vector<Facet> renumbered(std::vector<Facet> facets, const std::map<Index, Index>& point) {
    for (Facet& facet : facets)
      for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) facet.node[a] = point.at(facet[a]);
    return facets;
  }
  Index add_point(const Vec3& x) {
    x_.push_back(x);
    x_begin_.push_back(x);
    displacement_.push_back({});
    return static_cast<Index>(x_.size()) - 1;
  }

  Touching touching_;
  double reach_ = 0.0;
  mutable std::vector<Vec3> x_begin_, x_, displacement_;
  mutable SurfaceSearch search_;
  mutable RowParts parts_;
};

/// The rows of a pair whose other side is a rigid surface, on the nodes that this hangs on.
class RigidPairRows : public RowMaker {
 public:
  RigidPairRows(Touching touching, const Mesh& mesh, const Surface& own, const Surface& rigid,
                std::unique_ptr<RowMaker> pair)
      : touching_(std::move(touching)), pair_(std::move(pair)), x_begin_(mesh.coordinates), is_rigid_(x_begin_.size()) {
    x_ = x_begin_;
    displacement_.resize(x_.size());
    add_nodes(rigid, rigid_nodes_);
    for (const Index n : rigid_nodes_) is_rigid_[n] = true;
    pair_->add_moving_nodes(own_nodes_);
    add_nodes(own, own_nodes_);
    std::erase_if(own_nodes_, [&](Index n) { return is_rigid_[n]; });
  }
  std::size_t slots() const override { return pair_->slots(); }
  void append_keys(SlotKeys& keys) const override { pair_->append_keys(keys); }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override {
    const Stand begin = touching_.stand(motion.x_begin), now = touching_.stand(motion.x);
    for (const Index n : own_nodes_) place(n, motion.x_begin[n], motion.x[n]);
    for (const Index n : rigid_nodes_) place(n, begin.placed(touching_.X[n]), now.placed(touching_.X[n]));
    ContactMotion seen = motion;
    seen.x_begin = x_begin_;
    seen.x = x_;
    seen.displacement = displacement_;
    of_pair_.clear();
    pair_->append(seen, first_slot, of_pair_);
    for (std::size_t r = 0; r < of_pair_.size(); ++r) add_row(r, motion.u, now, rows);
  }
  void add_moving_nodes(std::vector<Index>& nodes) const override {
    nodes.insert(nodes.end(), own_nodes_.begin(), own_nodes_.end());
  }

 private:
  static void add_nodes(const Surface& surface, std::vector<Index>& nodes) {
    for (const Facet& facet : surface.facets) nodes.insert(nodes.end(), facet.begin(), facet.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  void place(Index n, const Vec3& begin, const Vec3& now) const {
    x_begin_[n] = begin;
    x_[n] = now;
    displacement_[n] = subtract(now, begin);
  }
  /// The same row, whose rigid nodes follow the obstacle.
  void add_row(std::size_t r, std::span<const double> u, const Stand& stand, ConstraintRows& rows) const {
    const ConstraintRows& of = of_pair_;
    rows.add_row(of.gap_at(r, u), of.normal[r], of.position[r], of.measure[r], of.law[r], of.source[r]);
    rows.is_back.back() = of.is_back[r];
    rows.allowed.back() = of.allowed[r];
    rows.rounded.back() = of.rounded[r];
    rows.facet.back() = of.facet[r];
    const auto end = static_cast<std::size_t>(of.begin[r + 1]);
    const std::size_t behind = end - static_cast<std::size_t>(of.behind[r]);
    std::array<RowBlocks, 2> sides;
    for (auto k = static_cast<std::size_t>(of.begin[r]); k < end; ++k)
      add_block(of.node[k], of.block[k], stand, sides[k < behind ? 0 : 1]);
    for (const RowBlocks& side : sides) side.append_to(rows);
    rows.behind.back() = static_cast<Index>(sides[1].size());
    finish_row(rows, u, of.slot[r]);
  }
  void add_block(Index n, const RowBlock& block, const Stand& stand, RowBlocks& to) const {
    if (!is_rigid_[n]) return to.add(n, block[0], block[1], block[2]);
    if (stand.placement) {
      const std::array<double, 4> N = stand.placement->weights(x_[n]);
      for (std::size_t a = 0; a < 4; ++a)
        to.add(touching_.body->nodes[a], scaled(block[0], N[a]), scaled(block[1], N[a]), scaled(block[2], N[a]));
    } else if (touching_.carrier >= 0) {
      to.add(touching_.carrier, block[0], block[1], block[2]);
    }
  }

  Touching touching_;
  std::unique_ptr<RowMaker> pair_;
  std::vector<Index> own_nodes_, rigid_nodes_;
  mutable std::vector<Vec3> x_begin_, x_, displacement_;  ///< of all nodes
  std::vector<char> is_rigid_;
  mutable ConstraintRows of_pair_;
};

/// The maker for each shape.
struct ShapeRowMaker {
  const Model& model;
  const ObstacleContact& contact;
  Touching touching;

  std::unique_ptr<RowMaker> operator()(const Plane& plane) {
    if (touching.body != nullptr) return std::make_unique<ShapeRows<Plane>>(touching, plane);
    return std::make_unique<PlaneRows>(touching, plane);
  }
  std::unique_ptr<RowMaker> operator()(const RigidSurface& rigid) {
    const bool has_normals = contact.measure == RowMeasure::per_area;
    if (has_normals && contact.bars.empty() && contact.law.hold == RowHold::springs && contact.law.eps_N)
      return std::make_unique<RigidPairRows>(touching, *model.mesh, contact.surface, rigid.surface, pair(rigid));
    return std::make_unique<RigidSurfaceRows>(touching, has_normals ? contact.surface : Surface{}, rigid.surface);
  }
  template <class Shape>
  std::unique_ptr<RowMaker> operator()(const Shape& shape) {
    return std::make_unique<ShapeRows<Shape>>(touching, shape);
  }
  std::unique_ptr<RowMaker> pair(const RigidSurface& rigid) const {
    PairContact pair;
    pair.name = contact.name;
    pair.slave = pair.master = contact.surface;
    pair.master.facets = rigid.surface.facets;
    pair.method = PairMethod::faces;
    pair.law = contact.law;
    return rigid_pair_rows(model, pair, touching.source);
  }
};

}  // namespace

std::unique_ptr<RowMaker> obstacle_rows(const Model& model, const ObstacleContact& contact, Index source) {
  return std::visit(ShapeRowMaker{model, contact, Touching(model, contact, source)}, contact.shape);
}

namespace {

/// Of obstacles that are counted per node: of the facets whose nodes are all listed, or of all that have some.
StiffnessChoice per_node_stiffness(const PartCells& cells, const ObstacleContact& contact) {
  std::vector<bool> listed(cells.model().mesh->node_count(), false);
  for (const Index n : contact.nodes) listed[static_cast<std::size_t>(n)] = true;
  const auto on_list = [&](Index n) { return listed[static_cast<std::size_t>(n)]; };
  std::vector<Facet> whole, touched;
  const auto skin = outer_facets(cells.model());
  for (const OuterFacet& outer : *skin) {
    const Facet& facet = outer.facet;
    if (std::all_of(facet.begin(), facet.end(), on_list)) whole.push_back(facet);
    if (std::any_of(facet.begin(), facet.end(), on_list)) touched.push_back(facet);
  }
  const std::vector<Facet>& facets = whole.empty() ? touched : whole;
  StiffnessChoice choice{{side_of(cells, facets, contact.name)}};
  double sum = 0.0;
  for (const Facet& facet : facets) {
    const auto backing = cells.behind(facet);
    if (!backing) continue;
    const auto shares = static_cast<double>(std::count_if(facet.begin(), facet.end(), on_list));
    sum += backing->measure * shares / facet.size;
  }
  choice.node_measure = sum / static_cast<double>(std::ranges::count(listed, true));
  return choice;
}

bool same(const Plane& a, const Plane& b) {
  const double scale = std::max(norm(a.point), norm(b.point));
  return is_near(a.normal, b.normal) && std::abs(dot(subtract(a.point, b.point), a.normal)) <= 1e-9 * scale;
}
bool same(const Sphere& a, const Sphere& b) {
  return is_near(a.centre, b.centre) && a.radius == b.radius && a.inside == b.inside;
}
bool same(const Cylinder& a, const Cylinder& b) {
  return is_near(a.point, b.point) && is_near(a.axis, b.axis) && a.radius == b.radius && a.inside == b.inside;
}
bool same(const Box& a, const Box& b) {
  return is_near(a.lower, b.lower) && is_near(a.upper, b.upper);
}
bool same(const RigidSurface& a, const RigidSurface& b) {
  return shared_facets(a.surface, b.surface) > 0;
}

bool same_shape(const RigidShape& a, const RigidShape& b) {
  return std::visit(
      [](const auto& x, const auto& y) {
        if constexpr (std::is_same_v<decltype(x), decltype(y)>)
          return same(x, y);
        else
          return false;
      },
      a, b);
}

std::size_t shared_obstacles(const ContactDefinition& first, const ContactDefinition& second) {
  const auto &a = std::get<ObstacleContact>(first), &b = std::get<ObstacleContact>(second);
  const bool at_rest = a.carrier < 0 && b.carrier < 0 && a.body < 0 && b.body < 0;
  if (!at_rest || !same_shape(a.shape, b.shape)) return 0;
  const std::size_t bars = shared_bars(a.bars, b.bars);
  return std::max({shared_numbers(a.nodes, b.nodes), shared_facets(a.surface, b.surface), bars});
}

}  // namespace

ContactKind obstacle_contact_row() {
  return {.name = "obstacle",
          .rows =
              [](const Model& model, const ContactDefinition& contact, Index source, std::vector<std::string>&) {
                return obstacle_rows(model, std::get<ObstacleContact>(contact), source);
              },
          .stiffness =
              [](const PartCells& cells, const ContactDefinition& definition) {
                const auto& contact = std::get<ObstacleContact>(definition);
                if (contact.measure == RowMeasure::per_node) return per_node_stiffness(cells, contact);
                if (!contact.bars.empty()) return bar_choice(cells.model(), {contact.bars});
                return StiffnessChoice{{side_of(cells, contact.surface.facets, contact.name)}};
              },
          .shared = shared_obstacles};
}

}  // namespace carom
