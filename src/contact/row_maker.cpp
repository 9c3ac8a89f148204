#include "contact/row_maker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "element/quad4.hpp"
#include "math/vec3.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {
namespace {

/// Appends the rows [begin, end) of `from`, their slots moved by first_slot.
void append_range(ConstraintRows& rows, const ConstraintRows& from, std::size_t begin, std::size_t end,
                  Index first_slot) {
  const auto append = [](auto& to, const auto& list, std::size_t first, std::size_t last) {
    to.insert(to.end(), list.begin() + static_cast<std::ptrdiff_t>(first),
              list.begin() + static_cast<std::ptrdiff_t>(last));
  };
  const auto first = static_cast<std::size_t>(from.begin[begin]), last = static_cast<std::size_t>(from.begin[end]);
  const Index moved = rows.begin.back() - from.begin[begin];
  for (std::size_t r = begin; r < end; ++r) {
    rows.begin.push_back(from.begin[r + 1] + moved);
    rows.slot.push_back(from.slot[r] + first_slot);
  }
  append(rows.node, from.node, first, last);
  append(rows.block, from.block, first, last);
  append(rows.gap, from.gap, begin, end);
  append(rows.is_back, from.is_back, begin, end);
  append(rows.allowed, from.allowed, begin, end);
  append(rows.offset, from.offset, begin, end);
  append(rows.rounded, from.rounded, begin, end);
  append(rows.has_entered, from.has_entered, begin, end);
  append(rows.normal, from.normal, begin, end);
  append(rows.tangent_1, from.tangent_1, begin, end);
  append(rows.tangent_2, from.tangent_2, begin, end);
  append(rows.position, from.position, begin, end);
  append(rows.reach, from.reach, begin, end);
  append(rows.measure, from.measure, begin, end);
  append(rows.law, from.law, begin, end);
  append(rows.source, from.source, begin, end);
  append(rows.behind, from.behind, begin, end);
  append(rows.facet, from.facet, begin, end);
}

/// Shares of the nodes of one facet in its measure.
std::array<double, 4> shares(const PlacedFacet& facet, const Surface& surface) {
  std::array<double, 4> share{};
  if (facet.size == 4) {
    for (const quad4::FacePoint& point : quad4::face_points(facet.x))
      for (std::size_t a = 0; a < 4; ++a) share[a] += point.N[a] * norm(point.normal_dA);
  } else if (facet.size == 3) {
    share.fill(measure(facet) / 3.0);
  } else if (facet.size == 2) {
    const bool is_ring = surface.section == Section::axisymmetric;
    for (std::size_t a = 0; a < 2; ++a) {
      const double width =
          is_ring ? 2.0 * std::numbers::pi / 3.0 * (2.0 * facet.x[a][0] + facet.x[1 - a][0]) : surface.thickness;
      share[a] = 0.5 * measure(facet) * width;
    }
  } else {
    share[0] = surface.thickness;
  }
  return share;
}

}  // namespace

void FixedRows::append(const ContactMotion& /*motion*/, Index first_slot, ConstraintRows& rows) const {
  append_rows(rows, rows_, first_slot);
}

/// Fixed rows are those of joints, whose nodes stay: in their order.
void FixedRows::append_keys(SlotKeys& keys) const {
  for (std::size_t r = 0; r < rows_.size(); ++r) keys.add({}, r);
  keys.meet({});
}

void MakersInOrder::append_keys(SlotKeys& keys) const {
  for (std::size_t i = 0; i < makers_.size(); ++i) {
    const std::size_t first = keys.size();
    makers_[i].maker->append_keys(keys);
    keys.set_maker(first, i);
  }
}

std::size_t MakersInOrder::slots() const {
  std::size_t sum = 0;
  for (const Entry& entry : makers_) sum += entry.maker->slots();
  return sum;
}

bool MakersInOrder::is_fixed() const {
  return std::all_of(makers_.begin(), makers_.end(), [](const Entry& entry) { return entry.maker->is_fixed(); });
}

void MakersInOrder::append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const {
  for (const Entry& entry : makers_) {
    const std::size_t before = rows.size();
    entry.maker->append(motion, first_slot, rows);
    first_slot += static_cast<Index>(entry.maker->slots());
    if (entry.is_back) std::fill(rows.is_back.begin() + static_cast<std::ptrdiff_t>(before), rows.is_back.end(), true);
  }
}

void MakersInOrder::append_stiffness(ConstraintRows& rows) const {
  for (const Entry& entry : makers_) entry.maker->append_stiffness(rows);
}

void MakersInOrder::add_moving_nodes(std::vector<Index>& nodes) const {
  for (const Entry& entry : makers_) entry.maker->add_moving_nodes(nodes);
}

void RowBlocks::add(Index n, const Vec3& normal, const Vec3& tangent_1, const Vec3& tangent_2) {
  auto entry = std::find_if(entries_.begin(), entries_.end(), [n](const auto& e) { return e.first == n; });
  if (entry == entries_.end()) entry = entries_.insert(entry, {n, {}});
  RowBlock& block = entry->second;
  block = {carom::add(block[0], normal), carom::add(block[1], tangent_1), carom::add(block[2], tangent_2)};
}

void RowBlocks::append_to(ConstraintRows& rows) const {
  for (const auto& [n, block] : entries_) rows.add_block(n, block);
}

RowLaw row_law(const ContactLaw& law, double measure) {
  const double eps_N = law.eps_N.value_or(0.0) * measure, eps_T = law.eps_T.value_or(0.0) * measure;
  RowLaw out{eps_N, law.mu > 0.0 ? eps_T : 0.0, 0.0, law.mu, law.restitution};
  out.linear_depth = law.linear_depth;
  out.own = {law.pressure.get(), measure};
  return out;
}

std::map<Index, double> nodal_measures(std::span<const Vec3> coordinates, const Surface& surface) {
  std::map<Index, double> sums;
  for (const Facet& facet : surface.facets) {
    const std::array<double, 4> share = shares(place(facet, coordinates), surface);
    for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) sums[facet[a]] += share[a];
  }
  return sums;
}

double mean_facet_size(std::span<const Vec3> coordinates, std::span<const Facet> facets) {
  double sum = 0.0;
  for (const Facet& facet : facets) {
    if (facet.size == 1) continue;
    const double extent = measure(place(facet, coordinates));
    sum += facet.size == 2 ? extent : std::sqrt(extent);
  }
  return facets.empty() ? 0.0 : sum / static_cast<double>(facets.size());
}

void finish_row(ConstraintRows& rows, std::span<const double> u, Index slot) {
  rows.gap.back() -= rows.relative(rows.size() - 1, u)[0];
  rows.slot.back() = slot;
}

void append_rows(ConstraintRows& rows, const ConstraintRows& from, Index first_slot) {
  append_range(rows, from, 0, from.size(), first_slot);
}

void append_row(ConstraintRows& rows, const ConstraintRows& from, std::size_t r) {
  append_range(rows, from, r, r + 1, 0);
}

}  // namespace carom
