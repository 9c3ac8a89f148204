// The kinds of contact as a table: one row each, defined beside the rows that it makes.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "contact/row_maker.hpp"
#include "contact/stiffness_choice.hpp"

namespace carom {

/// The row of a kind of contact. What a contact consists of, its line in CAROM_CONTACTS (model/contact.hpp) says. The
/// functions are called with contacts of the kind only.
struct ContactKind {
  std::string_view name{};
  /// Makes the maker of its rows; `source` is its index in Model::contacts. Appends to the notes what was turned or
  /// noticed. Throws std::invalid_argument naming the contact.
  std::unique_ptr<RowMaker> (*rows)(const Model& model, const ContactDefinition& contact, Index source,
                                    std::vector<std::string>& notes) = nullptr;
  /// Chooses the stiffness of a law that has none; null for kinds whose springs are always given. Throws
  /// std::invalid_argument naming the contact.
  StiffnessChoice (*stiffness)(const PartCells& cells, const ContactDefinition& contact) = nullptr;
  /// Counts the facets, nodes or cells that two contacts of the kind treat in the same way.
  std::size_t (*shared)(const ContactDefinition& a, const ContactDefinition& b) = nullptr;
};

#define CAROM_DECLARE_CONTACT(Kind, kind) ContactKind kind##_row();
CAROM_CONTACTS(CAROM_DECLARE_CONTACT)
#undef CAROM_DECLARE_CONTACT

/// The row of a contact.
const ContactKind& kind_of(const ContactDefinition& contact);

/// The number of facets, nodes or cells that two contacts treat in the same way; where it is not 0, one of the two is
/// one too many.
std::size_t shared_places(const ContactDefinition& a, const ContactDefinition& b);

/// The number of facets that are in both surfaces.
std::size_t shared_facets(const Surface& a, const Surface& b);
/// The number of facets that two contacts between deformable surfaces both see, whichever is the group.
std::size_t shared_facets(const ContactParts& a, const ContactParts& b);
/// The number of bars that are in both lists.
std::size_t shared_bars(std::span<const BarSide> a, std::span<const BarSide> b);
/// The number of bars that two contacts between bars both see, whichever are the group.
std::size_t shared_bars(const ContactParts& a, const ContactParts& b);
/// The number of entries that are in both lists.
std::size_t shared_numbers(std::span<const Index> a, std::span<const Index> b);
/// True when two vectors are equal but for rounding.
bool is_near(const Vec3& a, const Vec3& b);

}  // namespace carom
