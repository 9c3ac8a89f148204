// The kinds of contact as a table: one row each, defined beside the rows that it makes.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "contact/row_maker.hpp"
#include "contact/stiffness_choice.hpp"

namespace carom {

/// What is known of a kind but for its line of CAROM_CONTACTS (model/contact.hpp), which says what it consists of. The
/// functions are called on contacts of the kind.
struct ContactKind {
  std::string_view name{};
  /// Its rows; `source` is its index in Model::contacts. Appends what was turned or noticed to the notes. Throws
  /// std::invalid_argument naming the contact.
  std::unique_ptr<RowMaker> (*rows)(const Model& model, const ContactDefinition& contact, Index source,
                                    std::vector<std::string>& notes) = nullptr;
  /// The stiffness of a law that has none; null where springs are given. Throws std::invalid_argument naming the
  /// contact.
  StiffnessChoice (*stiffness)(const PartCells& cells, const ContactDefinition& contact) = nullptr;
  /// How many facets, nodes or cells two contacts of the kind treat in the same way.
  std::size_t (*shared)(const ContactDefinition& a, const ContactDefinition& b) = nullptr;
};

#define CAROM_DECLARE_CONTACT(Kind, kind) ContactKind kind##_row();
CAROM_CONTACTS(CAROM_DECLARE_CONTACT)
#undef CAROM_DECLARE_CONTACT

/// The row of a contact.
const ContactKind& kind_of(const ContactDefinition& contact);

/// How many facets, nodes or cells two contacts treat in the same way, so that one of them is one too many.
std::size_t shared_places(const ContactDefinition& a, const ContactDefinition& b);

/// Facets that are in both surfaces.
std::size_t shared_facets(const Surface& a, const Surface& b);
/// Facets that two contacts between deformable surfaces both see, whichever is the group.
std::size_t shared_facets(const ContactParts& a, const ContactParts& b);
/// Bars that are in both lists.
std::size_t shared_bars(std::span<const BarSide> a, std::span<const BarSide> b);
/// Bars that two contacts between bars both see, whichever are the group.
std::size_t shared_bars(const ContactParts& a, const ContactParts& b);
/// Numbers that are in both lists.
std::size_t shared_numbers(std::span<const Index> a, std::span<const Index> b);
/// Equal but for rounding.
bool is_near(const Vec3& a, const Vec3& b);

}  // namespace carom
