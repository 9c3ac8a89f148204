#include "contact/obstacle_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "contact/contact_kind.hpp"
#include "contact/rigid_shapes.hpp"
#include "contact/surface_search.hpp"
#include "math/vec3.hpp"
#include "model/outer_facets.hpp"

namespace carom {
namespace {

/// Where an obstacle stands: at rest, shifted with its carrier, or placed by the nodes of its body.
struct Stand {
  Vec3 shift{};
  std::optional<BodyPlacement> placement{};

  /// The position x as the obstacle in its reference position sees it.
  Vec3 seen(const Vec3& x) const { return placement ? placement->reference(x) : subtract(x, shift); }
};

/// What every obstacle has: its nodes with their measures, law and carrier or body.
struct Touching {
  std::span<const Vec3> X;
  std::vector<std::pair<Index, double>> nodes;  ///< node and measure, by increasing node
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
      for (const Index n : contact.nodes) nodes.emplace_back(n, 1.0);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    } else {
      const std::map<Index, double> measures = nodal_measures(X, contact.surface);
      nodes.assign(measures.begin(), measures.end());
    }
  }

  /// Where the obstacle stands for positions x of the nodes.
  Stand stand(std::span<const Vec3> x) const {
    if (body != nullptr) return {{}, BodyPlacement(*body, body_frame(*body, nodal_values(*body, x)))};
    return {carrier < 0 ? Vec3{} : subtract(x[carrier], X[carrier])};
  }

  /// The row of node i at `position`, its distance being that of stand.seen(position); at.normal is the gradient of
  /// at.gap.
  void add_row(std::size_t i, const SignedDistance& at, const Vec3& position, const Stand& stand,
               ConstraintRows& rows) const {
    const auto [n, measure] = nodes[i];
    if (stand.placement) {
      add_turning_row(i, at, position, *stand.placement, rows);
      return;
    }
    rows.add_row(at.gap, normalized(at.normal), position, measure, row_law(law, measure), source);
    const Vec3 t_1 = rows.tangent_1.back(), t_2 = rows.tangent_2.back();
    rows.add_block(n, {at.normal, t_1, t_2});
    if (carrier < 0) return;
    rows.add_block(carrier, {scaled(at.normal, -1.0), scaled(t_1, -1.0), scaled(t_2, -1.0)});
    rows.behind.back() = 1;
  }

 private:
  /// The gap is a function of the point X of the body that is at x now, and x = sum of N_a(X) x_a holds for every
  /// motion of the nodes that leaves X in place. So d gap = grad . (dx - sum of N_a dx_a) with the gradient by x,
  /// exactly; its length differs from 1 by the strain of the body.
  void add_turning_row(std::size_t i, const SignedDistance& at, const Vec3& position, const BodyPlacement& placement,
                       ConstraintRows& rows) const {
    const auto [n, measure] = nodes[i];
    const Vec3 gradient = placement.gradient(at.normal);
    rows.add_row(at.gap, normalized(gradient), position, measure, row_law(law, measure), source);
    const RowBlock block{gradient, rows.tangent_1.back(), rows.tangent_2.back()};
    rows.add_block(n, block);
    const std::array<double, 4> N = placement.weights(position);
    for (std::size_t a = 0; a < 4; ++a)
      rows.add_block(body->nodes[a], {scaled(block[0], -N[a]), scaled(block[1], -N[a]), scaled(block[2], -N[a])});
    rows.behind.back() = 4;
  }
};

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

class PlaneRows : public RowMaker {
 public:
  PlaneRows(Touching touching, const Plane& plane) : touching_(std::move(touching)), plane_(plane) {}
  std::size_t slots() const override { return touching_.nodes.size(); }
  bool is_fixed() const override { return true; }
  void append(const ContactMotion& /*motion*/, Index first_slot, ConstraintRows& rows) const override {
    for (std::size_t i = 0; i < slots(); ++i) {
      const Vec3& X = touching_.X[touching_.nodes[i].first];
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
  std::size_t slots() const override { return touching_.nodes.size(); }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override {
    const Stand stand = touching_.stand(motion.x);
    parts_.append(slots(), rows, [&](std::size_t begin, std::size_t end, ConstraintRows& made) {
      for (std::size_t i = begin; i < end; ++i) {
        const Vec3& x = motion.x[touching_.nodes[i].first];
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

/// Nodes against the facets of a rigid surface, seen from the surface: points 0 ... n - 1 are the nodes that may touch,
/// the rest are the surface's own, which rest there.
class RigidSurfaceRows : public RowMaker {
 public:
  RigidSurfaceRows(Touching touching, const Surface& own, const Surface& rigid)
      : touching_(std::move(touching)), search_(make_search(own, rigid)) {}
  std::size_t slots() const override { return touching_.nodes.size(); }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override {
    const Stand begin = touching_.stand(motion.x_begin), stand = touching_.stand(motion.x);
    for (std::size_t i = 0; i < slots(); ++i) {
      const Index n = touching_.nodes[i].first;
      x_begin_[i] = begin.seen(motion.x_begin[n]);
      x_[i] = stand.seen(motion.x[n]);
      displacement_[i] = subtract(x_[i], x_begin_[i]);
    }
    search_.update(x_begin_, x_, displacement_, motion.behind(first_slot, slots()));
    parts_.append(slots(), rows, [&](std::size_t from, std::size_t to, ConstraintRows& made) {
      SurfaceSearch::Space space;
      for (std::size_t i = from; i < to; ++i) {
        const SurfacePoint* met = search_.find(i, space);
        if (met == nullptr) continue;
        touching_.add_row(i, {met->gradient, met->gap}, motion.x[touching_.nodes[i].first], stand, made);
        made.facet.back() = met->facet;
        finish_row(made, motion.u, first_slot + static_cast<Index>(i));
      }
    });
  }

 private:
  SurfaceSearch make_search(const Surface& own, const Surface& rigid) {
    std::map<Index, Index> own_point, rigid_point;
    std::vector<Index> points;
    for (const auto& [n, measure] : touching_.nodes) points.push_back(own_point[n] = add_point(n));
    for (const Facet& facet : rigid.facets)
      for (const Index n : facet)
        if (!rigid_point.contains(n)) rigid_point[n] = add_point(n);
    const std::vector<Facet> own_facets = renumbered(own.facets, own_point);
    const std::vector<Facet> facets = renumbered(rigid.facets, rigid_point);
    const double size = mean_facet_size(x_, facets), reach = std::max(size, mean_facet_size(x_, own_facets));
    return {points,
            own_facets,
            facets,
            {reach, 0.5 * size, std::vector<double>(facets.size(), reach), edge_widths(x_, facets)}};
  }
  static std::vector<Facet> renumbered(std::vector<Facet> facets, const std::map<Index, Index>& point) {
    for (Facet& facet : facets)
      for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) facet.node[a] = point.at(facet[a]);
    return facets;
  }
  Index add_point(Index n) {
    x_.push_back(touching_.X[n]);
    x_begin_.push_back(touching_.X[n]);
    displacement_.push_back({});
    return static_cast<Index>(x_.size()) - 1;
  }

  Touching touching_;
  mutable std::vector<Vec3> x_begin_, x_, displacement_;
  mutable SurfaceSearch search_;
  mutable RowParts parts_;
};

/// The maker for each shape.
struct ShapeRowMaker {
  const ObstacleContact& contact;
  Touching touching;

  std::unique_ptr<RowMaker> operator()(const Plane& plane) {
    if (touching.body != nullptr) return std::make_unique<ShapeRows<Plane>>(touching, plane);
    return std::make_unique<PlaneRows>(touching, plane);
  }
  std::unique_ptr<RowMaker> operator()(const RigidSurface& rigid) {
    const bool has_normals = contact.measure == RowMeasure::per_area;
    return std::make_unique<RigidSurfaceRows>(touching, has_normals ? contact.surface : Surface{}, rigid.surface);
  }
  template <class Shape>
  std::unique_ptr<RowMaker> operator()(const Shape& shape) {
    return std::make_unique<ShapeRows<Shape>>(touching, shape);
  }
};

}  // namespace

std::unique_ptr<RowMaker> obstacle_rows(const Model& model, const ObstacleContact& contact, Index source) {
  return std::visit(ShapeRowMaker{contact, Touching(model, contact, source)}, contact.shape);
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

std::size_t shared_with(const ContactDefinition& first, const ContactDefinition& second) {
  const auto &a = std::get<ObstacleContact>(first), &b = std::get<ObstacleContact>(second);
  const bool at_rest = a.carrier < 0 && b.carrier < 0 && a.body < 0 && b.body < 0;
  if (!at_rest || !same_shape(a.shape, b.shape)) return 0;
  return std::max(shared_numbers(a.nodes, b.nodes), shared_facets(a.surface, b.surface));
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
                return StiffnessChoice{{side_of(cells, contact.surface.facets, contact.name)}};
              },
          .shared = shared_with};
}

}  // namespace carom
