#include "run/redundant_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

using FacetKey = std::array<Index, 4>;
using FacetSet = std::set<FacetKey>;

FacetSet keys(const Surface& surface) {
  FacetSet set;
  for (const Facet& facet : surface.facets) {
    FacetKey key = facet.node;
    std::sort(key.begin(), key.end());
    set.insert(key);
  }
  return set;
}

std::size_t shared(const FacetSet& a, const FacetSet& b) {
  return static_cast<std::size_t>(
      std::count_if(a.begin(), a.end(), [&](const FacetKey& key) { return b.contains(key); }));
}

std::size_t shared(const std::vector<Index>& a, const std::vector<Index>& b) {
  return static_cast<std::size_t>(
      std::count_if(a.begin(), a.end(), [&](Index n) { return std::find(b.begin(), b.end(), n) != b.end(); }));
}

bool near(const Vec3& a, const Vec3& b) {
  return norm(subtract(a, b)) <= 1e-9 * std::max(norm(a), norm(b));
}

bool same(const Plane& a, const Plane& b) {
  const double scale = std::max(norm(a.point), norm(b.point));
  return near(a.normal, b.normal) && std::abs(dot(subtract(a.point, b.point), a.normal)) <= 1e-9 * scale;
}
bool same(const Sphere& a, const Sphere& b) {
  return near(a.centre, b.centre) && a.radius == b.radius && a.inside == b.inside;
}
bool same(const Cylinder& a, const Cylinder& b) {
  return near(a.point, b.point) && near(a.axis, b.axis) && a.radius == b.radius && a.inside == b.inside;
}
bool same(const Box& a, const Box& b) {
  return near(a.lower, b.lower) && near(a.upper, b.upper);
}
bool same(const RigidSurface& a, const RigidSurface& b) {
  return shared(keys(a.surface), keys(b.surface)) > 0;
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

/// How many facets, nodes or cells two contacts treat in the same way.
struct SharedNodes {
  template <class A, class B>
  std::size_t met(const A& a, const B& b) const {
    const FacetSet a_slave = keys(a.slave), a_master = keys(a.master), b_slave = keys(b.slave),
                   b_master = keys(b.master);
    const std::size_t along = std::min(shared(a_slave, b_slave), shared(a_master, b_master));
    const std::size_t across = std::min(shared(a_slave, b_master), shared(a_master, b_slave));
    return std::max(along, across);
  }
  std::size_t operator()(const PairContact& a, const PairContact& b) const {
    const std::size_t both = met(a, b);
    return a.self && b.self && both == 1 ? 0 : both;  // one facet does not touch itself
  }
  std::size_t operator()(const ObstacleContact& a, const ObstacleContact& b) const {
    const bool at_rest = a.carrier < 0 && b.carrier < 0 && a.body < 0 && b.body < 0;
    if (!at_rest || !same_shape(a.shape, b.shape)) return 0;
    return std::max(shared(a.nodes, b.nodes), shared(keys(a.surface), keys(b.surface)));
  }
  std::size_t operator()(const InterfaceContact& a, const InterfaceContact& b) const {
    return shared(a.cells, b.cells);
  }
  std::size_t operator()(const TieContact& a, const TieContact& b) const { return met(a, b); }
  std::size_t operator()(const TieContact& a, const PairContact& b) const { return met(a, b); }
  std::size_t operator()(const PairContact& a, const TieContact& b) const { return met(a, b); }
  std::size_t operator()(const StopContact& a, const StopContact& b) const {
    return near(a.direction, b.direction) && a.gap == b.gap ? shared(a.nodes, b.nodes) : 0;
  }
  template <class A, class B>
  std::size_t operator()(const A&, const B&) const {
    return 0;
  }
};

/// Nodes of parts of which some component can move.
std::vector<char> moving_nodes(const Model& model) {
  std::vector<char> free_components(model.mesh->node_count(), 0);
  for (const Part& part : model.parts) {
    const auto n = static_cast<std::size_t>(node_count(part.type));
    const std::vector<Index>& connectivity = model.mesh->block(part.type)->connectivity;
    for (const Index cell : part.cells)
      for (std::size_t a = 0; a < n; ++a)
        free_components[static_cast<std::size_t>(connectivity[n * static_cast<std::size_t>(cell) + a])] = 7;
  }
  for (const PrescribedMotion& motion : model.motions) {
    const auto& value = motion.function.value;
    if (std::any_of(value.begin(), value.end(), [](double v) { return v != 0.0; })) continue;
    for (const Index n : motion.nodes) {
      char& free = free_components[static_cast<std::size_t>(n)];
      free = static_cast<char>(static_cast<unsigned>(free) & ~(1U << static_cast<unsigned>(motion.component)));
    }
  }
  return free_components;
}

}  // namespace

void refuse_redundant_contacts(const Case& given, const Model& model) {
  for (std::size_t j = 1; j < model.contacts.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const std::size_t overlap = std::visit(SharedNodes{}, model.contacts[i], model.contacts[j]);
      if (overlap == 0) continue;
      const CaseContact &first = given.contacts[i], &second = given.contacts[j];
      throw CaseError(second.where, "contact",
                      fmt::format("\"{}\" between surfaces that \"{}\" (line {}) sees already, on {} of their pieces",
                                  *second.name, *first.name, first.where.line, overlap),
                      "every pair of surfaces in one contact",
                      "Twice the same contact is twice as stiff, and multipliers have no single value: remove one, or "
                      "`exclude` its faces from kind = \"all\".");
    }
  }
}

void refuse_faces_of_parts(const Case& given, const Model& model) {
  const std::vector<char> moves = moving_nodes(model);
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const auto* obstacle = std::get_if<ObstacleContact>(&model.contacts[c]);
    const auto* rigid = obstacle == nullptr ? nullptr : std::get_if<RigidSurface>(&obstacle->shape);
    if (rigid == nullptr) continue;
    for (const Facet& facet : rigid->surface.facets) {
      const auto is_free = [&](Index n) { return moves[static_cast<std::size_t>(n)] != 0; };
      if (!std::all_of(facet.begin(), facet.end(), is_free)) continue;
      const Located<std::string>& surface = *given.contacts[c].own_cells();
      throw CaseError(surface.where, "contact.surface",
                      fmt::format("faces of a part that can move in \"{}\", such as that of node {}", *surface,
                                  model.mesh->node_numbers[static_cast<std::size_t>(facet[0])]),
                      "faces that belong to no part, or to one that is held",
                      "A rigid surface stays where it is; contact with a part is kind = \"pair\".");
    }
  }
}

}  // namespace carom
