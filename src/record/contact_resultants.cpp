#include "record/contact_resultants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/types.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

bool is_ring(const ContactParts& contact) {
  return contact.own != nullptr && contact.own->section == Section::axisymmetric;
}

/// The numbers of the parts of every node, ascending.
std::vector<std::vector<Index>> parts_of_nodes(const Model& model) {
  std::vector<std::vector<Index>> parts(model.mesh->node_count());
  const std::vector<Index> numbers = model.part_numbers();
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    const auto n = at(node_count(part.type));
    const std::vector<Index>& connectivity = model.mesh->block(part.type)->connectivity;
    for (const Index cell : part.cells) {
      for (std::size_t a = 0; a < n; ++a) {
        std::vector<Index>& of_node = parts[at(connectivity[n * at(cell) + a])];
        if (of_node.empty() || of_node.back() != numbers[p]) of_node.push_back(numbers[p]);
      }
    }
    if (part.rigid_body < 0) continue;
    for (const Index carrier :
         model.turning_bodies[at(part.rigid_body)].nodes)  // rows have them for those of its cells
      if (parts[at(carrier)].empty()) parts[at(carrier)].push_back(numbers[p]);
  }
  return parts;
}

/// The nodes of a row's own side, and those of the other one.
struct Sides {
  std::size_t begin, split, end;
};
Sides sides(const ConstraintRows& rows, std::size_t r) {
  const auto first = at(rows.begin[r]), last = at(rows.begin[r + 1]);
  return {first, last - at(rows.behind[r]), last};
}

}  // namespace

ContactResultants::ContactResultants(const Model& model, std::vector<std::optional<Vec3>> moment_points)
    : model_(model), mesh_(*model.mesh), moment_points_(std::move(moment_points)) {
  const std::vector<Index> numbers = model.part_numbers();
  const auto name = [&](Index number) {
    return model.parts[at(std::find(numbers.begin(), numbers.end(), number) - numbers.begin())].name;
  };
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    first_place_.push_back(places_.size());
    const ContactParts contact = parts_of(model.contacts[c]);
    if (!contact.is_self) {
      places_.push_back({name_of(model.contacts[c]), c, std::nullopt, is_ring(contact)});
      continue;
    }
    if (parts_of_node_.empty()) parts_of_node_ = parts_of_nodes(model);
    std::set<Index> held;
    for (const BarSide& bar : contact.bars) held.insert(numbers[at(bar.part)]);
    for (const Facet& facet : contact.own->facets) held.insert(part_of_side({facet.begin(), facet.end()}));
    for (auto first = held.begin(); first != held.end(); ++first) {
      for (auto second = std::next(first); second != held.end(); ++second) {
        places_.push_back({fmt::format("{}.{}_on_{}", name_of(model.contacts[c]), name(*second), name(*first)), c,
                           std::pair{*first, *second}, is_ring(contact)});
      }
    }
  }
  first_place_.push_back(places_.size());
}

/// The part that most of the nodes belong to, the first of those of equal number: nodes where two parts meet belong to
/// both, their facets to one.
Index ContactResultants::part_of_side(std::span<const Index> nodes) const {
  std::map<Index, int> votes;
  for (const Index n : nodes)
    for (const Index part : parts_of_node_[at(n)]) ++votes[part];
  const auto most =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? -1 : most->first;
}

Index ContactResultants::part_of_node(Index node, Index preferred) const {
  const std::vector<Index>& parts = parts_of_node_[at(node)];
  if (parts.empty()) return -1;
  return std::find(parts.begin(), parts.end(), preferred) != parts.end() ? preferred : parts.front();
}

std::size_t ContactResultants::place_of(std::size_t contact, std::pair<Index, Index> parts) const {
  std::size_t place = first_place_[contact];
  while (place < first_place_[contact + 1] && places_[place].parts != parts) ++place;
  return place;
}

Vec3 ContactResultants::moment_point(std::size_t contact, std::span<const double> u) const {
  if (moment_points_[contact]) return *moment_points_[contact];
  const Index body = parts_of(model_.contacts[contact]).body;
  if (body < 0 || !model_.turning_bodies[at(body)].is_led()) return {};
  const TurningBody& led = model_.turning_bodies[at(body)];
  return carom::add(led.centre, body_frame(led, nodal_values(led, u)).centre);
}

/// Adds sign times the force of the row on the node of an entry.
void ContactResultants::add(const ContactResponse& response, std::size_t r, std::size_t entry, double sign,
                            std::size_t place, std::span<const double> u, ContactResultant& sum) const {
  const ConstraintRows& rows = *response.rows;
  const Vec3 s = scaled(response.force[r], sign);
  const RowBlock& b = rows.block[entry];
  const std::size_t n = at(rows.node[entry]);
  Vec3 force = carom::add(scaled(b[0], s[0]), carom::add(scaled(b[1], s[1]), scaled(b[2], s[2])));
  Vec3 x = carom::add(mesh_.coordinates[n], {u[3 * n], u[3 * n + 1], u[3 * n + 2]});
  sum.force = carom::add(sum.force, force);
  if (places_[place].is_ring) x[0] = x[2] = force[0] = force[2] = 0.0;
  sum.moment = carom::add(sum.moment, cross(subtract(x, moment_point(places_[place].contact, u)), force));
}

/// A row of a surface in self-contact: its forces on the nodes of the other side, by their parts.
void ContactResultants::add_between_parts(const ContactResponse& response, std::size_t r, std::span<const double> u,
                                          std::vector<ContactResultant>& out) const {
  const ConstraintRows& rows = *response.rows;
  const auto c = at(rows.source[r]);
  const auto [begin, split, end] = sides(rows, r);
  const std::span<const Index> nodes(rows.node);
  const Index own = part_of_side(nodes.subspan(begin, split - begin));
  const Index other = part_of_side(nodes.subspan(split, end - split));
  for (std::size_t k = split; k < end; ++k) {
    const Index part = part_of_node(rows.node[k], other);
    const std::size_t place = place_of(c, std::minmax(own, part));
    if (place == first_place_[c + 1]) continue;  // of one part
    add(response, r, k, part < own ? 1.0 : -1.0, place, u, out[place]);
  }
}

std::vector<ContactResultant> ContactResultants::of(const ContactResponse& response, std::span<const double> u) const {
  std::vector<ContactResultant> out(places_.size());
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (response.status[r] == RowStatus::open || rows.source[r] < 0) continue;
    const std::size_t place = first_place_[at(rows.source[r])];
    if (place == first_place_[at(rows.source[r]) + 1]) continue;
    if (places_[place].parts) {
      add_between_parts(response, r, u, out);
      continue;
    }
    const auto [begin, split, end] = sides(rows, r);
    const bool is_back = rows.is_back[r];
    for (std::size_t k = is_back ? split : begin; k < (is_back ? end : split); ++k)
      add(response, r, k, 1.0, place, u, out[place]);
  }
  return out;
}

void ContactResultants::add_cohesive(const CohesiveZones& zones, std::span<const double> u,
                                     std::span<const double> history, std::vector<ContactResultant>& to) const {
  zones.for_each_force(u, history, [&](std::size_t contact, const CohesiveRow& row, const Vec3& force) {
    const std::size_t place = first_place_[contact];
    ContactResultant& sum = to[place];
    for (const auto& [node, weight] : row.slave) {
      const std::size_t n = at(node);
      Vec3 share = scaled(force, weight);
      sum.force = carom::add(sum.force, share);
      Vec3 x = carom::add(mesh_.coordinates[n], {u[3 * n], u[3 * n + 1], u[3 * n + 2]});
      if (places_[place].is_ring) x[0] = x[2] = share[0] = share[2] = 0.0;
      sum.moment = carom::add(sum.moment, cross(subtract(x, moment_point(contact, u)), share));
    }
  });
}

}  // namespace carom
