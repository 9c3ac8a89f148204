#include "model/contact.hpp"

#include <type_traits>

namespace carom {

ContactParts ObstacleContact::parts() const {
  ContactParts parts{.bars = bars, .shape = &shape, .carrier = carrier, .body = body};
  if (measure == RowMeasure::per_node)
    parts.nodes = nodes;
  else
    parts.own = &surface;
  if (const auto* plane = std::get_if<Plane>(&shape)) parts.direction = plane->normal;
  return parts;
}

ContactParts parts_of(const ContactDefinition& contact) {
  return std::visit([](const auto& kind) { return kind.parts(); }, contact);
}

const std::string& name_of(const ContactDefinition& contact) {
  return std::visit([](const auto& kind) -> const std::string& { return kind.name; }, contact);
}

namespace {

template <class Law, class Contact>
Law* law_in(Contact& contact) {
  return std::visit(
      [](auto& kind) -> Law* {
        if constexpr (requires { kind.law; })
          return &kind.law;
        else
          return nullptr;
      },
      contact);
}

}  // namespace

const ContactLaw* law_of(const ContactDefinition& contact) {
  return law_in<const ContactLaw>(contact);
}
ContactLaw* law_of(ContactDefinition& contact) {
  return law_in<ContactLaw>(contact);
}

InitialPenetration initial_of(const ContactDefinition& contact) {
  return std::visit(
      [](const auto& kind) {
        if constexpr (requires { kind.initial; })
          return kind.initial;
        else
          return InitialPenetration::refuse;
      },
      contact);
}

std::vector<Index> nodes_of(const ContactParts& contact, const Mesh& mesh) {
  std::vector<Index> nodes(contact.nodes.begin(), contact.nodes.end());
  for (const Surface* surface : {contact.own, contact.other}) {
    if (surface == nullptr || (surface == contact.other && contact.is_self)) continue;
    for (const Facet& facet : surface->facets) nodes.insert(nodes.end(), facet.begin(), facet.end());
  }
  for (const std::span<const BarSide> bars : {contact.bars, contact.other_bars})
    for (const BarSide& bar : bars) nodes.insert(nodes.end(), bar.node.begin(), bar.node.end());
  for (const Index cell : contact.cells) {
    const std::span<const Index> corners = mesh.block(CellType::hexa8)->nodes(cell);
    nodes.insert(nodes.end(), corners.begin(), corners.end());
  }
  return nodes;
}

}  // namespace carom
