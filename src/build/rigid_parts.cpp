#include "build/rigid_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "build/attached.hpp"
#include "build/eroding_parts.hpp"
#include "build/guides.hpp"
#include "math/vec3.hpp"
#include "solid/part_inertia.hpp"

namespace carom {

namespace {

constexpr const char* section = "rigid_body";
/// A small heavy body on a soft one strains by 3e-3 at the 0.5 of obstacles (random boxes on plates) and by 1e-4 at
/// this, for which explicit steps become up to twice as many.
constexpr double rigidity_of_parts = 3.0;
constexpr const char* parts_key = "rigid_body.parts";

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// What the case gives of the inertia instead of that of the cells; of a mass alone the cells' inertia times its share.
PartInertia with_given(PartInertia own, const CaseRigidPart& given) {
  if (given.mass) {
    const double share = own.mass > 0.0 ? *given.mass / own.mass : 0.0;
    own.mass = *given.mass;
    own.moments = scaled(own.moments, share);
    own.products = scaled(own.products, share);
  }
  if (given.centre_of_mass) own.centre = **given.centre_of_mass;
  if (given.inertia) {
    own.moments = **given.inertia;
    own.products = given.products_of_inertia.value_or(Vec3{});
  }
  return own;
}

/// A rigid motion v(X) = v_0 + omega x (X - middle), fitted to the vectors at some nodes: with r from their middle,
///   (sum of |r|^2 1 - r r^T) omega = sum of r x v.
struct RigidMotion {
  Vec3 middle{}, mean{}, omega{};

  RigidMotion(std::span<const Vec3> X, std::span<const Vec3> v) {
    const double share = 1.0 / static_cast<double>(X.size());
    for (std::size_t k = 0; k < X.size(); ++k) {
      middle = carom::add(middle, scaled(X[k], share));
      mean = carom::add(mean, scaled(v[k], share));
    }
    std::array<Vec3, 3> J{};
    Vec3 L{};
    for (std::size_t k = 0; k < X.size(); ++k) {
      const Vec3 r = subtract(X[k], middle);
      L = carom::add(L, cross(r, v[k]));
      for (std::size_t i = 0; i < 3; ++i) {
        J[i] = subtract(J[i], scaled(r, r[i]));
        J[i][i] += dot(r, r);
      }
    }
    const double det = dot(J[0], cross(J[1], J[2])), size = J[0][0] + J[1][1] + J[2][2];
    constexpr double singular = 1e-12;  // nodes on a line say nothing of turning about it
    if (det > singular * size * size * size)
      for (std::size_t i = 0; i < 3; ++i)
        omega = carom::add(omega, scaled(cross(J[(i + 1) % 3], J[(i + 2) % 3]), L[i] / det));
  }
  Vec3 at(const Vec3& X) const { return carom::add(mean, cross(omega, subtract(X, middle))); }
};

}  // namespace

RigidParts::RigidParts(const Case& given, const Mesh& mesh, const Groups& groups, const Parts& parts)
    : case_(given),
      mesh_(mesh),
      groups_(groups),
      parts_(parts),
      body_of_part_(parts.parts().size(), -1),
      of_deformable_(mesh.node_count(), 0),
      body_of_node_(mesh.node_count(), -1) {
  if (given.rigid_parts.empty()) return;
  refuse_company();
  for (const CaseRigidPart& body : given.rigid_parts) add(body);
  for (std::size_t p = 0; p < body_of_part_.size(); ++p) {
    if (body_of_part_[p] >= 0) continue;
    const Part& part = parts.parts()[p];
    for (const Index cell : part.cells)
      for (const Index n : mesh.block(part.type)->nodes(cell)) of_deformable_[at(n)] = 1;
  }
  for (Body& body : bodies_) find_nodes(body);
  refuse_attached();
}

/// Springs and masses hang on nodes that move by themselves.
void RigidParts::refuse_attached() const {
  for (const AttachedGroup& attached : attached_groups(case_))
    for (const Index n : groups_.nodes(attached.group, attached.key))
      if (const Index body = body_of_node_[at(n)]; body >= 0)
        throw CaseError(attached.group.where, attached.key,
                        fmt::format("{} at node {} of \"{}\", which rigid body \"{}\" holds", attached.what, number(n),
                                    *attached.group, *bodies_[at(body)].given->name),
                        "nodes that move by themselves", attached.remedy);
}

void RigidParts::refuse_torn(const Model& model) const {
  for (const CohesiveZone& zone : model.cohesive)
    for (const CohesiveRow& row : zone.rows) {
      const auto is_held = [&](const std::pair<Index, double>& share) {
        return model.embedding.find(share.first) != nullptr;
      };
      if (std::ranges::any_of(row.slave, is_held) || std::ranges::any_of(row.master, is_held))
        throw CaseError(case_.contacts[zone.contact].where, "contact",
                        fmt::format("\"{}\", a tie that tears, on a rigid body", zone.name),
                        "a tie that holds, or deformable parts on both sides");
    }
}

/// What knows nothing of nodes that follow others.
void RigidParts::refuse_company() const {
  const Location& where = case_.rigid_parts.front().where;
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw CaseError(where, section, found, expected);
  };
  if (case_.initial_state) refuse("a rigid body beside [initial_state]", "a run that begins by itself");
  if (!has_inertia(*case_.scheme.kind)) refuse("a rigid body, with statics", "a scheme with inertia");
  for (const CaseStage& stage : case_.stages)
    if (!has_inertia(*stage.scheme.kind)) refuse("a rigid body, with a stage of statics", "stages with inertia");
  const auto gives_mass_away = [](const CaseScheme& scheme) { return has_massless_contact(*scheme.kind); };
  if (gives_mass_away(case_.scheme) ||
      std::ranges::any_of(case_.stages, [&](const CaseStage& stage) { return gives_mass_away(stage.scheme); }))
    refuse("a rigid body, with modified_mass",
           "a scheme whose contact nodes keep their mass, as those of rigid bodies do");
  for (const CaseRigidPart& body : case_.rigid_parts)
    for (const Located<std::string>& part : body.parts)
      if (erodes(case_, *part))
        throw CaseError(part.where, parts_key, fmt::format("\"{}\", whose cells go by [[erosion]]", *part),
                        "a part that stays");
}

void RigidParts::add(const CaseRigidPart& given) {
  Body& body = bodies_.emplace_back();
  body.given = &given;
  const auto number = static_cast<Index>(bodies_.size()) - 1;
  for (const Located<std::string>& name : given.parts)
    for (std::size_t p = 0; p < body_of_part_.size(); ++p) {
      const Part& part = parts_.parts()[p];
      if (part.name != *name) continue;
      if (part.section != Section::solid)
        throw CaseError(name.where, parts_key,
                        fmt::format("\"{}\" with section = \"{}\"", *name, carom::name(part.section)),
                        "parts of solid cells", "Bodies turn in three dimensions: model it with solid cells.");
      if (body_of_part_[p] >= 0)
        throw CaseError(name.where, parts_key, fmt::format("\"{}\" in two rigid bodies", *name),
                        "each part in one body");
      body_of_part_[p] = number;
    }
  body.turning = turning_body(given);
}

TurningBody RigidParts::turning_body(const CaseRigidPart& given) const {
  std::vector<const Part*> own;
  for (std::size_t p = 0; p < body_of_part_.size(); ++p)
    if (body_of_part_[p] == static_cast<Index>(bodies_.size()) - 1) own.push_back(&parts_.parts()[p]);
  const PartInertia inertia = with_given(own.empty() ? PartInertia{} : inertia_of(mesh_, own), given);
  try {
    TurningBody body = make_turning_body(inertia.mass, inertia.centre, inertia.moments, inertia.products);
    body.name = *given.name;
    body.rigidity = given.rigidity.value_or(rigidity_of_parts);
    return body;
  } catch (const std::invalid_argument& e) {
    throw CaseError(given.inertia ? given.inertia->where : given.where, "rigid_body.inertia", e.what(),
                    "moments about the centre of mass, each smaller than the sum of the two others",
                    "A rod or a disc without thickness has no such body: give it the thickness that it has.");
  }
}

/// Nodes of its cells follow the body; those that deformable cells hold too, and those that the case names, are joined.
void RigidParts::find_nodes(Body& body) {
  const auto number = static_cast<Index>(&body - bodies_.data());
  const auto take = [&](Index n, const Located<std::string>& of, const char* key, std::vector<Index>& list) {
    Index& owner = body_of_node_[at(n)];
    if (owner == number) return;
    if (owner >= 0)
      throw CaseError(of.where, key,
                      fmt::format("node {} of \"{}\", which \"{}\" holds as well", this->number(n), *of,
                                  *bodies_[at(owner)].given->name),
                      "bodies that share no nodes", "One [[rigid_body]] may have several parts.");
    owner = number;
    list.push_back(n);
  };
  for (const Located<std::string>& part : body.given->parts)
    for (const Index n : parts_.nodes_of(*part))
      take(n, part, parts_key, of_deformable_[at(n)] != 0 ? body.joined : body.followers);
  if (body.given->nodes)
    for (const Index n : groups_.nodes(*body.given->nodes, "rigid_body.nodes")) {
      if (!parts_.hold(n))
        throw CaseError(
            body.given->nodes->where, "rigid_body.nodes",
            fmt::format("node {} of \"{}\", which belongs to no part", this->number(n), **body.given->nodes),
            "nodes of parts");
      take(n, *body.given->nodes, "rigid_body.nodes", body.joined);
    }
  if (body.given->points)
    for (const Index n : groups_.nodes(*body.given->points, "rigid_body.points")) {
      if (parts_.hold(n))
        throw CaseError(body.given->points->where, "rigid_body.points",
                        fmt::format("node {} of \"{}\", which a part holds", this->number(n), **body.given->points),
                        "nodes of no part", "Nodes of parts that the body shall hold are its nodes.");
      take(n, *body.given->points, "rigid_body.points", body.points);
    }
  for (std::vector<Index>* list : {&body.followers, &body.joined, &body.points}) std::ranges::sort(*list);
}

std::vector<Vec3> RigidParts::positions() const {
  std::vector<Vec3> positions;
  for (const Body& body : bodies_)
    for (std::size_t a = 0; a < 4; ++a) positions.push_back(corner(body.turning, a));
  return positions;
}

void RigidParts::add_to(Model& model, Index first) {
  for (std::size_t p = 0; p < body_of_part_.size(); ++p) {
    if (body_of_part_[p] < 0) continue;
    Part& part = model.parts[p];
    const IsotropicElastic moduli = part.material.at_rest();
    part.material = Material(LinearElastic{moduli.E, moduli.nu, part.material.rho});
    part.formulation.reset();
    part.hourglass.reset();
    part.viscosity = {};
    part.distortion_control = 0.0;
    part.rigid_body = static_cast<Index>(model.turning_bodies.size()) + body_of_part_[p];
  }
  for (Body& body : bodies_) {
    for (Index& node : body.turning.nodes) node = first++;
    const auto number = static_cast<Index>(model.turning_bodies.size());
    std::vector<Index> followers;
    std::ranges::merge(body.followers, body.points, std::back_inserter(followers));
    model.embedding.add(number, body.turning, followers, mesh_.coordinates);
    for (const Index n : body.joined) {
      const std::array<double, 4> N = corner_weights(body.turning, mesh_.coordinates[at(n)]);
      for (int c = 0; c < 3; ++c) {
        LinearEquation equation;
        equation.name = fmt::format("rigid body \"{}\" at node {}", body.turning.name, this->number(n));
        equation.where = body.given->where;
        equation.terms.push_back({n, c, 1.0});
        for (std::size_t a = 0; a < 4; ++a) equation.terms.push_back({body.turning.nodes[a], c, -N[a]});
        model.equations.push_back(std::move(equation));
      }
    }
    add_guide(body.given->guide, body.turning, body.given->where, model);
    model.turning_bodies.push_back(body.turning);
  }
}

std::vector<Index> RigidParts::carried(std::vector<Index> nodes, const Located<std::string>& group,
                                       const std::string& key) const {
  if (bodies_.empty()) return nodes;
  std::vector<std::size_t> found(bodies_.size(), 0);
  for (const Index n : nodes)
    if (const Index body = body_of_node_[at(n)]; body >= 0) ++found[at(body)];
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Body& body = bodies_[b];
    if (found[b] == 0) continue;
    const std::set<Index> there(nodes.begin(), nodes.end());
    const auto missing = std::ranges::count_if(body.own(), [&](Index n) { return !there.contains(n); });
    if (missing > 0)
      throw CaseError(
          group.where, key,
          fmt::format("{} of the {} nodes of rigid body \"{}\" in \"{}\"", found[b],
                      body.followers.size() + body.joined.size() + body.points.size(), body.turning.name, *group),
          "all nodes of a rigid body, or none",
          "What holds a body as a whole names a group of the cells of all of its parts.");
    if (body.given->guide.holds())
      throw CaseError(
          group.where, key,
          fmt::format("\"{}\", the nodes of rigid body \"{}\", which has a guide", *group, body.turning.name),
          "blocked and blocked_turns of the [[rigid_body]], or supports of its nodes",
          "A support of all nodes along an axis also holds the turns about the two others.");
    std::erase_if(nodes, [&](Index n) { return body_of_node_[at(n)] == static_cast<Index>(b); });
    nodes.insert(nodes.end(), body.turning.nodes.begin(), body.turning.nodes.end());
  }
  return nodes;
}

void RigidParts::refuse_rigid_contacts(const Model& model) const {
  const auto is_exact = [](const CaseScheme& scheme) { return traits(**scheme.enforcement).is_exact; };
  if (bodies_.empty() || !(is_exact(case_.scheme) || std::ranges::any_of(case_.stages, [&](const CaseStage& stage) {
                             return is_exact(stage.scheme);
                           })))
    return;
  const auto all_follow = [&](const Surface* surface) {
    return surface != nullptr && !surface->facets.empty() &&
           std::ranges::all_of(surface->facets, [&](const Facet& facet) {
             return std::all_of(facet.begin(), facet.end(),
                                [&](Index n) { return model.embedding.find(n) != nullptr; });
           });
  };
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    const ContactParts contact = parts_of(model.contacts[c]);
    if (contact.nature != ContactNature::touches) continue;
    const bool has_rigid_pair =
        contact.is_self ? bodies_.size() > 1
                        : all_follow(contact.own) && (contact.shape != nullptr || all_follow(contact.other));
    if (has_rigid_pair)
      throw CaseError(
          case_.contacts[c].where, "contact",
          fmt::format("\"{}\" between sides neither of which deforms, with exact contact", name_of(model.contacts[c])),
          "enforcement = \"penalty\"",
          "What would be lost or kept in the hit of two rigid bodies is what their contact stores: springs.");
  }
}

void RigidParts::carry(std::vector<InitialState>& all, std::size_t stage) const {
  constexpr double rounding = 1e-9;
  using Values = std::vector<Vec3> InitialState::*;
  // What the nodes of a body have been given, the last of several.
  const auto given_of = [&](const std::vector<Index>& nodes, Values values) {
    std::map<Index, Vec3> given;
    for (const InitialState& initial : all) {
      if (initial.stage != stage || (initial.*values).empty()) continue;
      for (std::size_t k = 0; k < initial.nodes.size(); ++k)
        if (std::ranges::binary_search(nodes, initial.nodes[k]))
          given[initial.nodes[k]] = (initial.*values)[(initial.*values).size() == 1 ? 0 : k];
    }
    return given;
  };
  for (const Body& body : bodies_) {
    const std::vector<Index>& own = body.own();
    for (const Values values : {&InitialState::displacement, &InitialState::velocity}) {
      const bool may_turn = values == &InitialState::velocity;
      const std::map<Index, Vec3> given = given_of(own, values);
      const bool has_points = !given_of(body.points, values).empty();
      if (given.empty() && !has_points && given_of(body.joined, values).empty()) continue;
      const auto refuse = [&](const std::string& found, const std::string& expected) {
        throw CaseError(body.given->where, "initial", fmt::format("{} of rigid body \"{}\"", found, body.turning.name),
                        expected);
      };
      if ((has_points || (!body.followers.empty() && !given.empty())) && given.size() < own.size())
        refuse(fmt::format("{} for {} of the {} nodes", may_turn ? "velocities" : "displacements", given.size(),
                           own.size()),
               "all nodes of a rigid body, or none: name all of its parts");
      std::optional<RigidMotion> motion;  // none: at rest
      if (given.size() == own.size()) {
        std::vector<Vec3> X, v;
        double largest = 0.0, off = 0.0;
        for (const auto& [node, value] : given) {
          X.push_back(mesh_.coordinates[at(node)]);
          v.push_back(value);
          largest = std::max(largest, norm(value));
        }
        motion.emplace(X, v);
        if (!may_turn) motion->omega = {};
        for (std::size_t k = 0; k < X.size(); ++k) off = std::max(off, norm(subtract(v[k], motion->at(X[k]))));
        if (off > rounding * largest)
          refuse(fmt::format("{} that no rigid body has, by {:.3g},", may_turn ? "velocities" : "displacements", off),
                 may_turn ? "velocities of a translation and a rotation" : "one displacement for all nodes");
      }
      if (may_turn && motion)
        refuse_guided_motion(body.given->guide, section, body.turning.name, body.turning.centre,
                             motion->at(body.turning.centre), motion->omega);
      InitialState& carried = all.emplace_back();
      carried.stage = stage;
      const auto add = [&](Index node, const Vec3& place) {
        carried.nodes.push_back(node);
        (carried.*values).push_back(motion ? motion->at(place) : Vec3{});
      };
      for (std::size_t a = 0; a < 4; ++a) add(body.turning.nodes[a], corner(body.turning, a));
      for (const Index n : body.joined) add(n, mesh_.coordinates[at(n)]);  // they begin as the body does
    }
  }
}

std::size_t rigid_nodes(const Case& given) {
  return 4 * given.rigid_parts.size();
}

std::vector<Vec3> rigid_positions(const Case& given, const Mesh& mesh) {
  if (given.rigid_parts.empty()) return {};
  const Groups groups(mesh);
  return RigidParts(given, mesh, groups, Parts(given, mesh, groups)).positions();
}

}  // namespace carom
