#include "contact/smooth_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "math/vec3.hpp"
#include "surface/parent_faces.hpp"

namespace carom {
namespace {

constexpr double least_sharp = 0.5 * std::numbers::sqrt3;  // cosine of 30 degrees, as of feature edges
constexpr double flat = 1e-3;                              // of an edge: bulges below are none
constexpr double longest = 0.25;                           // of an edge: its bulge at most
constexpr double round_off = 1e-12;                        // square of the turn of parallel normals
constexpr double in_plane = 1e-6;                          // of a facet's size: nodes of one plane
constexpr double settled = 1e-8;  // step in parent coordinates after which, shrinking as its square, none is left

/// Shape functions of the edges' vectors and their derivatives.
struct BulgeShape {
  std::array<double, 4> B{}, d1{}, d2{}, d11{}, d12{}, d22{};
};

BulgeShape bulge_shape(int size, const ParentPoint& p) {
  BulgeShape out;
  if (size == 2) {
    out.B[0] = 0.25 * (p.xi * p.xi - 1.0);
    out.d1[0] = 0.5 * p.xi;
    out.d11[0] = 0.5;
  } else if (size == 3) {
    const double L0 = 1.0 - p.xi - p.eta, L1 = p.xi, L2 = p.eta;
    out.B = {-L0 * L1, -L1 * L2, -L2 * L0, 0.0};
    out.d1 = {L1 - L0, -L2, L2, 0.0};
    out.d2 = {L1, -L1, L2 - L0, 0.0};
    out.d11 = {2.0, 0.0, 0.0, 0.0};
    out.d12 = {1.0, -1.0, 1.0, 0.0};
    out.d22 = {0.0, 0.0, 2.0, 0.0};
  } else if (size == 4) {
    const double x = p.xi, y = p.eta, u = 0.25 * (x * x - 1.0), v = 0.25 * (y * y - 1.0);
    const double low_x = 0.5 * (1.0 - x), high_x = 0.5 * (1.0 + x), low_y = 0.5 * (1.0 - y), high_y = 0.5 * (1.0 + y);
    out.B = {u * low_y, v * high_x, u * high_y, v * low_x};
    out.d1 = {0.5 * x * low_y, 0.5 * v, 0.5 * x * high_y, -0.5 * v};
    out.d2 = {-0.5 * u, 0.5 * y * high_x, 0.5 * u, 0.5 * y * low_x};
    out.d11 = {0.5 * low_y, 0.0, 0.5 * high_y, 0.0};
    out.d12 = {-0.25 * x, 0.25 * y, 0.25 * x, -0.25 * y};
    out.d22 = {0.0, 0.5 * high_x, 0.0, 0.5 * low_x};
  }
  return out;
}

std::size_t edge_count(int size) {
  return size == 2 ? 1 : size < 2 ? 0 : static_cast<std::size_t>(size);
}

Vec3 normal_at_centre(const PlacedFacet& facet) {
  const ParentPoint centre = facet_centre(facet.size);
  return facet_frame(facet, centre.xi, centre.eta).normal;
}

/// What corner a adds to the normal there.
Vec3 of_corner(const PlacedFacet& facet, std::size_t a) {
  if (facet.size == 2) return scaled(normal_at_centre(facet), 1.0 / measure(facet));
  const auto n = static_cast<std::size_t>(facet.size);
  const Vec3 e_1 = subtract(facet.x[(a + 1) % n], facet.x[a]), e_2 = subtract(facet.x[(a + n - 1) % n], facet.x[a]);
  const double scale = dot(e_1, e_1) * dot(e_2, e_2);
  return scale > 0.0 ? scaled(cross(e_1, e_2), 1.0 / scale) : Vec3{};
}

/// All facets of a surface and what is beside it, and how they hang together.
class Fans {
 public:
  Fans(const Mesh& mesh, std::span<const Facet> facets, std::span<const Facet> beside,
       std::span<const std::array<bool, 3>> is_held)
      : X_(mesh.coordinates), is_held_(is_held) {
    facets_.assign(facets.begin(), facets.end());
    std::map<std::array<Index, 4>, bool> own;
    for (const Facet& facet : facets) own[key(facet)] = true;
    for (const Facet& facet : beside)
      if (!own.contains(key(facet))) facets_.push_back(facet);
    for (const ParentFace& face : parent_faces(mesh, facets_)) is_linear_.push_back(face.is_linear);
    for (const Facet& facet : facets_) normals_.push_back(normal_at_centre(place(facet, X_)));
    join();
    mirror();
  }

  std::span<const Facet> facets() const { return facets_; }
  bool goes_on(std::size_t f, std::size_t edge) const { return next_[f][edge] >= 0 || across_[f][edge] >= 0; }
  /// The facets that hang together around corner a of facet f, f among them.
  std::vector<std::pair<std::size_t, std::size_t>> around(std::size_t f, std::size_t a) const {
    std::vector<std::pair<std::size_t, std::size_t>> fan{{f, a}};
    const Index node = facets_[f][a];
    const auto add = [&](Index g) {
      if (g < 0) return;
      const Facet& facet = facets_[static_cast<std::size_t>(g)];
      const std::pair<std::size_t, std::size_t> corner{
          static_cast<std::size_t>(g),
          static_cast<std::size_t>(std::find(facet.begin(), facet.end(), node) - facet.begin())};
      if (std::find(fan.begin(), fan.end(), corner) == fan.end()) fan.push_back(corner);
    };
    for (std::size_t i = 0; i < fan.size(); ++i) {  // NOLINT(modernize-loop-convert): it grows
      const auto [g, b] = fan[i];
      for (const std::size_t edge : edges_at(g, b)) add(next_[g][edge]);
    }
    return fan;
  }
  Vec3 normal(std::size_t f, std::size_t a) const {
    Vec3 sum{};
    std::array<bool, 3> is_mirrored{};
    for (const auto& [g, b] : around(f, a)) {
      sum = add(sum, of_corner(place(facets_[g], X_), b));
      for (const std::size_t edge : edges_at(g, b))
        if (across_[g][edge] >= 0) is_mirrored[static_cast<std::size_t>(across_[g][edge])] = true;
    }
    for (std::size_t c = 0; c < 3; ++c)
      if (is_mirrored[c]) sum[c] = 0.0;  // what the image adds takes it away
    const Vec3 n = direction(sum);
    return dot(n, n) > 0.0 ? n : normals_[f];
  }

 private:
  static std::array<Index, 4> key(const Facet& facet) {
    std::array<Index, 4> nodes = facet.node;
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }
  /// Finds the facets across smooth edges.
  void join() {
    std::map<std::array<Index, 2>, std::vector<std::pair<std::size_t, std::size_t>>> at;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const auto n = static_cast<std::size_t>(facets_[f].size);
      for (std::size_t a = 0; n > 1 && a < n; ++a) {
        const Index p = facets_[f][a], q = n == 2 ? p : facets_[f][(a + 1) % n];
        at[{std::min(p, q), std::max(p, q)}].emplace_back(f, a);
      }
    }
    next_.assign(facets_.size(), {-1, -1, -1, -1});
    for (const auto& [edge, users] : at) {
      if (users.size() != 2) continue;
      const auto& [f, a] = users[0];
      const auto& [g, b] = users[1];
      // Of segments one has its end here and the other its beginning.
      const bool is_turned = facets_[f].size == 2 ? a == b : facets_[f][a] == facets_[g][b];
      if (is_turned || !is_linear_[f] || !is_linear_[g] || !(dot(normals_[f], normals_[g]) > least_sharp)) continue;
      next_[f][a] = static_cast<Index>(g);
      next_[g][b] = static_cast<Index>(f);
    }
  }

  /// The edges of facet f that meet its corner a.
  std::vector<std::size_t> edges_at(std::size_t f, std::size_t a) const {
    const auto n = static_cast<std::size_t>(facets_[f].size);
    if (n <= 2) return {a};
    return {a, (a + n - 1) % n};
  }
  /// Finds the edges in planes of symmetry.
  void mirror() {
    across_.assign(facets_.size(), {-1, -1, -1, -1});
    if (is_held_.empty()) return;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const auto n = static_cast<std::size_t>(facets_[f].size);
      const double size = std::sqrt(measure(place(facets_[f], X_)));
      for (std::size_t a = 0; n > 1 && a < n; ++a) {
        const auto p = static_cast<std::size_t>(facets_[f][a]);
        const auto q = n == 2 ? p : static_cast<std::size_t>(facets_[f][(a + 1) % n]);
        if (next_[f][a] >= 0 || !is_linear_[f]) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          const auto is_in_plane = [&](auto node) { return std::abs(X_[node][c] - X_[p][c]) < in_plane * size; };
          const bool ends_there = is_held_[p][c] && is_held_[q][c] && is_in_plane(q) &&
                                  !std::all_of(facets_[f].begin(), facets_[f].end(), is_in_plane);
          if (ends_there && 1.0 - 2.0 * normals_[f][c] * normals_[f][c] > least_sharp)
            across_[f][a] = static_cast<int>(c);
        }
      }
    }
  }

  std::span<const Vec3> X_;
  std::span<const std::array<bool, 3>> is_held_;
  std::vector<Facet> facets_;
  std::vector<bool> is_linear_;
  std::vector<Vec3> normals_;
  std::vector<std::array<Index, 4>> next_;  ///< by facet and edge (segment: end): the facet that goes on, -1: none
  std::vector<std::array<int, 4>> across_;  ///< the component of the plane of symmetry that the edge is in, -1: none
};

}  // namespace

Vec3 edge_bulge(const Vec3& d, const Vec3& n_0, const Vec3& n_1) {
  const Vec3 sum = add(n_0, n_1), difference = subtract(n_0, n_1);
  const double length = norm(d), of_sum = dot(sum, d), of_difference = dot(difference, d);
  Vec3 c = scaled(sum, of_difference / dot(sum, sum));
  const double square = dot(difference, difference);
  if (square > round_off && std::abs(of_sum) < 0.5 * std::abs(of_difference))
    c = add(c, scaled(difference, of_sum / square));
  const double size = norm(c);
  return size > longest * length ? scaled(c, longest * length / size) : c;
}

SmoothSurface::SmoothSurface(const Mesh& mesh, std::span<const Facet> facets, std::span<const Facet> beside,
                             std::span<const std::array<bool, 3>> is_held)
    : is_curved_(facets.size()),
      bulges_(facets.size()),
      goes_on_(facets.size(), {false, false, false, false}),
      nodes_(mesh.coordinates.size(), none) {
  const std::span<const Vec3> X = mesh.coordinates;
  const Fans fans(mesh, facets, beside, is_held);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const PlacedFacet facet = place(facets[f], X);
    const auto n = static_cast<std::size_t>(facet.size);
    if (n < 2) continue;
    std::array<Vec3, 4> normals{};
    for (std::size_t a = 0; a < n; ++a) {
      goes_on_[f][a] = fans.goes_on(f, a);
      normals[a] = fans.normal(f, a);
    }
    const SmoothPatch frame(facet, {});
    for (std::size_t k = 0; k < edge_count(facet.size); ++k) {
      const Vec3 d = subtract(facet.x[(k + 1) % n], facet.x[k]);
      const Vec3 c = edge_bulge(d, normals[k], normals[(k + 1) % n]);
      if (norm(c) > flat * norm(d)) is_curved_[f] = true;
      bulges_[f].edge[k] = frame.components(c);
    }
    if (is_curved_[f])
      has_curved_ = true;
    else
      bulges_[f] = {};
  }
  if (!has_curved_) return;
  find_inner_edges(facets);
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const Index n : facets[f]) {
      State& state = nodes_[static_cast<std::size_t>(n)];
      if (state != curved_inside) state = is_curved_[f] ? curved_inside : inside;
    }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto n = static_cast<std::size_t>(facets[f].size);
    for (std::size_t a = 0; a < n; ++a) {
      if (goes_on_[f][a]) continue;
      nodes_[static_cast<std::size_t>(facets[f][a])] = ends;
      if (n > 2) nodes_[static_cast<std::size_t>(facets[f][(a + 1) % n])] = ends;
    }
  }
}

void SmoothSurface::find_inner_edges(std::span<const Facet> facets) {
  const auto add = [&](Index a, Index b) { inner_edges_.push_back({std::min(a, b), std::max(a, b)}); };
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Facet& facet = facets[f];
    const auto n = static_cast<std::size_t>(facet.size);
    if (!is_curved_[f] || n < 3) continue;
    for (std::size_t a = 0; a < n; ++a)
      if (goes_on_[f][a]) add(facet[a], facet[(a + 1) % n]);
    if (n != 4) continue;
    add(facet[0], facet[2]);
    add(facet[1], facet[3]);
  }
  std::ranges::sort(inner_edges_);
}

SmoothPatch::SmoothPatch(const PlacedFacet& facet, const Bulge& bulge) : facet_(facet) {
  const ParentPoint middle = facet_centre(facet.size);
  centre_ = facet_frame(facet, middle.xi, middle.eta);
  dual_ = tangent_dual(centre_.a_1, centre_.a_2, centre_.normal);
  for (std::size_t k = 0; k < edge_count(facet.size); ++k) {
    const Vec3& c = bulge.edge[k];
    edge_[k] = add(add(scaled(centre_.a_1, c[0]), scaled(centre_.a_2, c[1])), scaled(centre_.normal, c[2]));
    // The shape functions of all edges together are at most 1/3 (triangle), 1/4 (segment), 1/2 (quadrilateral).
    rise_ = std::max(rise_, (facet.size == 4 ? 0.5 : 1.0 / 3.0) * norm(edge_[k]));
  }
}

double SmoothPatch::curvature() const {
  double most = 0.0;
  const auto n = static_cast<std::size_t>(facet_.size);
  for (std::size_t k = 0; k < edge_count(facet_.size); ++k) {
    const Vec3 d = subtract(facet_.x[(k + 1) % n], facet_.x[k]);
    most = std::max(most, 2.0 * norm(edge_[k]) / dot(d, d));
  }
  if (facet_.size == 4) {
    const Vec3 twist = subtract(add(facet_.x[0], facet_.x[2]), add(facet_.x[1], facet_.x[3]));
    most += 0.25 * std::abs(dot(twist, centre_.normal)) / centre_.jacobian;
  }
  return most;
}

FacetFrame SmoothPatch::at(const ParentPoint& p) const {
  FacetFrame frame = facet_tangents(facet_, facet_shape(facet_.size, p.xi, p.eta));
  const BulgeShape shape = bulge_shape(facet_.size, p);
  for (std::size_t k = 0; k < edge_count(facet_.size); ++k) {
    frame.position = add(frame.position, scaled(edge_[k], shape.B[k]));
    frame.a_1 = add(frame.a_1, scaled(edge_[k], shape.d1[k]));
    if (facet_.size > 2) frame.a_2 = add(frame.a_2, scaled(edge_[k], shape.d2[k]));
  }
  const Vec3 area = cross(frame.a_1, frame.a_2);
  frame.jacobian = norm(area);
  frame.normal = frame.jacobian > 0.0 ? scaled(area, 1.0 / frame.jacobian) : centre_.normal;
  return frame;
}

std::optional<ParentPoint> SmoothPatch::foot(const Vec3& x) const {
  const ParentPoint middle = facet_centre(facet_.size);
  const Vec3 away = subtract(x, centre_.position);
  const bool is_segment = facet_.size == 2;
  ParentPoint p{middle.xi + dot(dual_.dual_1, away), is_segment ? 0.0 : middle.eta + dot(dual_.dual_2, away)};
  if (std::abs(p.xi) > 2.0 || std::abs(p.eta) > 2.0) return std::nullopt;
  Vec3 twist{};
  if (facet_.size == 4) twist = scaled(subtract(add(facet_.x[0], facet_.x[2]), add(facet_.x[1], facet_.x[3])), 0.25);
  for (int i = 0; i < 12; ++i) {
    const FacetFrame frame = at(p);
    const BulgeShape shape = bulge_shape(facet_.size, p);
    Vec3 x_11{}, x_12 = twist, x_22{};
    for (std::size_t k = 0; k < edge_count(facet_.size); ++k) {
      x_11 = add(x_11, scaled(edge_[k], shape.d11[k]));
      x_12 = add(x_12, scaled(edge_[k], shape.d12[k]));
      x_22 = add(x_22, scaled(edge_[k], shape.d22[k]));
    }
    const Vec3 r = subtract(x, frame.position);
    const double a_11 = dot(frame.a_1, frame.a_1) - dot(r, x_11), b_1 = dot(frame.a_1, r);
    double d_xi = b_1 / a_11, d_eta = 0.0, det = a_11;
    if (!is_segment) {
      const double a_12 = dot(frame.a_1, frame.a_2) - dot(r, x_12), a_22 = dot(frame.a_2, frame.a_2) - dot(r, x_22);
      const double b_2 = dot(frame.a_2, r);
      det = a_11 * a_22 - a_12 * a_12;
      d_xi = (a_22 * b_1 - a_12 * b_2) / det;
      d_eta = (a_11 * b_2 - a_12 * b_1) / det;
    }
    if (!(det > 0.0) || !(a_11 > 0.0)) return std::nullopt;
    p.xi += d_xi;
    p.eta += d_eta;
    if (std::abs(p.xi) > 2.0 || std::abs(p.eta) > 2.0) return std::nullopt;
    if (std::abs(d_xi) + std::abs(d_eta) < settled) return p;
  }
  return std::nullopt;
}

std::array<double, 4> SmoothPatch::weights(const ParentPoint& p, const Vec3& c) const {
  const ParentPoint middle = facet_centre(facet_.size);
  const FacetShape there = facet_shape(facet_.size, p.xi, p.eta);
  const FacetShape centre = facet_shape(facet_.size, middle.xi, middle.eta);
  std::array<double, 4> w{};
  for (std::size_t a = 0; a < 4; ++a) w[a] = there.N[a] + c[0] * centre.dN_dxi[a] + c[1] * centre.dN_deta[a];
  return w;
}

}  // namespace carom
