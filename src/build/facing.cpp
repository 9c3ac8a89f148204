#include "build/facing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "model/bodies.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

namespace {

/// Mean position and velocity of the nodes of facets.
struct Motion {
  Vec3 x{}, v{};
};

Motion mean_motion(const Model& model, std::span<const Facet> facets, const State& state) {
  Motion m;
  double count = 0.0;
  for (const Facet& facet : facets) {
    for (const Index n : facet) {
      for (std::size_t c = 0; c < 3; ++c) {
        m.x[c] += model.mesh->coordinates[at(n)][c] + state.q[3 * at(n) + c];
        m.v[c] += state.v[3 * at(n) + c];
      }
      ++count;
    }
  }
  return {scaled(m.x, 1.0 / count), scaled(m.v, 1.0 / count)};
}

/// A facet as something that looks along its normal.
struct Look {
  Vec3 centre{}, normal{};
  double size = 0.0;  ///< from the centre to the farthest node
};

Look look(const Model& model, const Facet& facet, const State& state) {
  PlacedFacet placed = place(facet, model.mesh->coordinates);
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a)
    for (std::size_t c = 0; c < 3; ++c) placed.x[a][c] += state.q[3 * at(facet[a]) + c];
  const ParentPoint middle = facet_centre(facet.size);
  const FacetFrame frame = facet_frame(placed, middle.xi, middle.eta);
  Look seen{frame.position, frame.normal, 0.0};
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a)
    seen.size = std::max(seen.size, norm(subtract(placed.x[a], seen.centre)));
  return seen;
}

/// Ends of bars look out of them.
Vec3 outward_of_bar(const Model& model, Index end, const State& state) {
  const CellBlock* lines = model.mesh->block(CellType::line2);
  const auto x = [&](Index n) {
    Vec3 at_n = model.mesh->coordinates[at(n)];
    for (std::size_t c = 0; c < 3; ++c) at_n[c] += state.q[3 * at(n) + c];
    return at_n;
  };
  for (std::size_t i = 0; lines != nullptr && i < lines->connectivity.size(); ++i)
    if (lines->connectivity[i] == end) return normalized(subtract(x(end), x(lines->connectivity[i ^ 1U])));
  return {};
}

/// Every so manieth facet, so that there are at most `most`.
std::vector<Look> looks(const Model& model, std::span<const Facet> facets, const State& state) {
  constexpr std::size_t most = 1500;
  const std::size_t stride = 1 + facets.size() / most;
  std::vector<Look> list;
  for (std::size_t i = 0; i < facets.size(); i += stride) list.push_back(look(model, facets[i], state));
  return list;
}

bool look_at_each_other(const Look& a, const Look& b) {
  const Vec3 way = subtract(b.centre, a.centre);
  const double slack = a.size + b.size;  // they may overlap a little, and stand beside each other
  return dot(a.normal, b.normal) < 0.0 && dot(a.normal, way) > -slack && dot(b.normal, way) < slack;
}

bool is_touching(const ContactParts& contact) {
  return contact.nature == ContactNature::touches;
}
/// Of two deformable surfaces that touch.
bool is_of_two(const ContactParts& contact) {
  return contact.other != nullptr && !contact.other->facets.empty() && !contact.is_self && is_touching(contact);
}

bool pair_faces_away(const Model& model, const ContactParts& pair, const State& state) {
  if (pair.is_self || pair.own->facets.empty() || pair.own->facets[0].size == 1) return false;
  const std::vector<Look> slave = looks(model, pair.own->facets, state),
                          master = looks(model, pair.other->facets, state);
  return std::none_of(slave.begin(), slave.end(), [&](const Look& a) {
    return std::any_of(master.begin(), master.end(), [&](const Look& b) { return look_at_each_other(a, b); });
  });
}

bool obstacle_faces_away(const Model& model, const ConstraintRows& rows, std::size_t c, const Surface& surface,
                         const State& state) {
  if (surface.facets.empty() || surface.facets[0].size == 1) return false;
  std::map<Index, std::vector<Vec3>> normals;
  for (const Facet& facet : surface.facets) {
    const Vec3 normal = look(model, facet, state).normal;
    for (const Index n : facet) normals[n].push_back(normal);
  }
  bool any = false;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (at(rows.source[r]) != c) continue;
    const auto own = normals.find(rows.node[at(rows.begin[r])]);
    if (own == normals.end()) return false;  // of a rigid body, which rows see instead of the nodes of its faces
    any = true;
    for (const Vec3& normal : own->second)
      if (dot(normal, rows.normal[r]) < 0.0) return false;
  }
  return any;
}

struct Box3 {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()},
      high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
           -std::numeric_limits<double>::infinity()};
};

Box3 box_around(const Model& model, std::span<const Facet> facets, const State& state) {
  Box3 box;
  double size = 0.0;
  for (const Facet& facet : facets) {
    size = std::max(size, look(model, facet, state).size);
    for (const Index n : facet)
      for (std::size_t c = 0; c < 3; ++c) {
        const double x = model.mesh->coordinates[at(n)][c] + state.q[3 * at(n) + c];
        box.low[c] = std::min(box.low[c], x);
        box.high[c] = std::max(box.high[c], x);
      }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] -= size;
    box.high[c] += size;
  }
  return box;
}

}  // namespace

std::optional<double> middle_approach(const Model& model, std::size_t c, const State& state) {
  const ContactParts pair = parts_of(model.contacts[c]);
  if (!is_of_two(pair)) return std::nullopt;
  const Motion slave = mean_motion(model, pair.own->facets, state),
               master = mean_motion(model, pair.other->facets, state);
  const Vec3 way = subtract(master.x, slave.x);
  return norm(way) > 0.0 ? std::optional(dot(subtract(slave.v, master.v), way) / norm(way)) : std::nullopt;
}

bool shows_its_back(const Model& model, std::size_t c, const State& state) {
  const ContactParts obstacle = parts_of(model.contacts[c]);
  const auto* rigid = obstacle.shape == nullptr ? nullptr : std::get_if<RigidSurface>(obstacle.shape);
  if (rigid == nullptr || obstacle.own == nullptr || obstacle.own->facets.empty()) return false;
  const Vec3 middle = mean_motion(model, obstacle.own->facets, state).x;
  const auto distance = [&](const Facet& facet) { return norm(subtract(look(model, facet, state).centre, middle)); };
  const auto nearer = [&](const Facet& a, const Facet& b) { return distance(a) < distance(b); };
  const std::vector<Facet>&own = obstacle.own->facets, &others = rigid->surface.facets;
  const Facet& nearest = *std::min_element(own.begin(), own.end(), nearer);
  Look here = look(model, nearest, state);
  if (nearest.size == 1) here.normal = outward_of_bar(model, nearest[0], state);
  const Look there = look(model, *std::min_element(others.begin(), others.end(), nearer), state);
  return dot(here.normal, there.normal) > 0.5 && dot(subtract(there.centre, here.centre), there.normal) > 0.0;
}

bool goes_through_its_back(const Model& model, std::size_t c, const State& state) {
  if (!shows_its_back(model, c, state)) return false;
  const ContactParts obstacle = parts_of(model.contacts[c]);
  const auto& rigid = std::get<RigidSurface>(*obstacle.shape);
  Vec3 normal{};
  for (const Facet& facet : rigid.surface.facets) normal = add(normal, look(model, facet, state).normal);
  const Motion own = mean_motion(model, obstacle.own->facets, state);
  Vec3 v = own.v;
  if (obstacle.carrier >= 0) v = subtract(v, vector_at(state.v, at(obstacle.carrier)));
  if (obstacle.body >= 0) {
    const TurningBody& body = model.turning_bodies[at(obstacle.body)];
    const std::array<Vec3, 4> nodal = nodal_values(body, state.v);
    const std::array<double, 4> N = place_body(body, state.q).weights(own.x);
    for (std::size_t a = 0; a < 4; ++a) v = subtract(v, scaled(nodal[a], N[a]));
  }
  return dot(v, normal) > 0.0;
}

bool faces_away(const Model& model, const ConstraintRows& rows, std::size_t c, const State& state) {
  const ContactParts contact = parts_of(model.contacts[c]);
  if (contact.other != nullptr) return is_touching(contact) && pair_faces_away(model, contact, state);
  return contact.shape != nullptr && contact.own != nullptr && obstacle_faces_away(model, rows, c, *contact.own, state);
}

namespace {

/// Do boxes that move at a velocity relative to each other stay apart until the end?
bool stay_apart(const Box3& a, const Box3& b, const Vec3& v, double end) {
  double enter = 0.0, leave = end;
  for (std::size_t i = 0; i < 3; ++i) {
    if (v[i] == 0.0) {
      if (a.high[i] < b.low[i] || a.low[i] > b.high[i]) return true;
      continue;
    }
    const double first = (b.low[i] - a.high[i]) / v[i], second = (b.high[i] - a.low[i]) / v[i];
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter > leave;
}

}  // namespace

bool passes_by(const Model& model, std::size_t c, const State& state, double end) {
  const ContactParts pair = parts_of(model.contacts[c]);
  if (!is_of_two(pair)) return false;
  const std::vector<Facet>&own = pair.own->facets, &other = pair.other->facets;
  const Box3 a = box_around(model, own, state), b = box_around(model, other, state);
  const Vec3 v = subtract(mean_motion(model, own, state).v, mean_motion(model, other, state).v);
  return stay_apart(a, b, v, end);
}

bool all_stay_apart(const Model& model, std::size_t c, const State& state, double end) {
  const ContactParts pair = parts_of(model.contacts[c]);
  if (!pair.is_self) return false;
  const std::vector<Index> body_of = bodies_of_nodes(model);
  std::map<Index, std::vector<Facet>> skins;
  for (const Facet& facet : pair.own->facets) skins[body_of[at(facet[0])]].push_back(facet);
  std::vector<std::pair<Box3, Vec3>> bodies;
  for (const auto& [body, facets] : skins)
    bodies.emplace_back(box_around(model, facets, state), mean_motion(model, facets, state).v);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!stay_apart(bodies[i].first, bodies[j].first, subtract(bodies[i].second, bodies[j].second), end))
        return false;
  return bodies.size() > 1;
}

}  // namespace carom
