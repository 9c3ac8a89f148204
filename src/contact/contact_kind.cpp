#include "contact/contact_kind.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "math/vec3.hpp"

namespace carom {

const ContactKind& kind_of(const ContactDefinition& contact) {
#define CAROM_CONTACT_ROW(Kind, kind) kind##_row(),
  static const std::array rows{CAROM_CONTACTS(CAROM_CONTACT_ROW)};
#undef CAROM_CONTACT_ROW
  return rows[contact.index()];
}

std::size_t shared_places(const ContactDefinition& a, const ContactDefinition& b) {
  if (a.index() == b.index()) return kind_of(a).shared(a, b);
  return shared_facets(parts_of(a), parts_of(b));
}

std::size_t shared_facets(const Surface& a, const Surface& b) {
  const auto keys = [](const Surface& surface) {
    std::set<std::array<Index, 4>> set;
    for (const Facet& facet : surface.facets) {
      std::array<Index, 4> key = facet.node;
      std::sort(key.begin(), key.end());
      set.insert(key);
    }
    return set;
  };
  const auto of_a = keys(a), of_b = keys(b);
  return static_cast<std::size_t>(
      std::count_if(of_a.begin(), of_a.end(), [&](const auto& key) { return of_b.contains(key); }));
}

std::size_t shared_facets(const ContactParts& a, const ContactParts& b) {
  if (a.other == nullptr || b.other == nullptr) return 0;
  const std::size_t along = std::min(shared_facets(*a.own, *b.own), shared_facets(*a.other, *b.other));
  const std::size_t across = std::min(shared_facets(*a.own, *b.other), shared_facets(*a.other, *b.own));
  return std::max(along, across);
}

std::size_t shared_bars(std::span<const BarSide> a, std::span<const BarSide> b) {
  const auto is_same = [](const BarSide& x, const BarSide& y) { return x.node == y.node; };
  return static_cast<std::size_t>(std::count_if(a.begin(), a.end(), [&](const BarSide& x) {
    return std::any_of(b.begin(), b.end(), [&](const BarSide& y) { return is_same(x, y); });
  }));
}

std::size_t shared_bars(const ContactParts& a, const ContactParts& b) {
  const std::size_t along = std::min(shared_bars(a.bars, b.bars), shared_bars(a.other_bars, b.other_bars));
  const std::size_t across = std::min(shared_bars(a.bars, b.other_bars), shared_bars(a.other_bars, b.bars));
  return std::max(along, across);
}

std::size_t shared_numbers(std::span<const Index> a, std::span<const Index> b) {
  return static_cast<std::size_t>(
      std::count_if(a.begin(), a.end(), [&](Index n) { return std::find(b.begin(), b.end(), n) != b.end(); }));
}

bool is_near(const Vec3& a, const Vec3& b) {
  return norm(subtract(a, b)) <= 1e-9 * std::max(norm(a), norm(b));
}

}  // namespace carom
