#include "contact/contact_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>
#include <utility>

#include "contact/admissible.hpp"
#include "contact/contact_kind.hpp"
#include "contact/equation_rows.hpp"
#include "contact/response.hpp"
#include "contact/row_maker.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

/// Nodes whose positions the rows of a contact ask for.
void add_moving_nodes(const Model& model, const ContactParts& contact, std::vector<Index>& nodes) {
  const std::vector<Index> own = nodes_of(contact, *model.mesh);
  nodes.insert(nodes.end(), own.begin(), own.end());
  if (contact.carrier >= 0) nodes.push_back(contact.carrier);
  if (contact.body < 0) return;
  const TurningBody& body = model.turning_bodies[static_cast<std::size_t>(contact.body)];
  nodes.insert(nodes.end(), body.nodes.begin(), body.nodes.end());
}

/// Middle of the box around all nodes.
Vec3 middle_of(const std::vector<Vec3>& coordinates) {
  Vec3 low{}, high{};
  for (std::size_t c = 0; c < 3 && !coordinates.empty(); ++c) {
    const auto [least, most] = std::ranges::minmax(coordinates, {}, [c](const Vec3& X) { return X[c]; });
    low[c] = least[c];
    high[c] = most[c];
  }
  return scaled(add(low, high), 0.5);
}

}  // namespace

struct ContactGeometry::Impl {
  explicit Impl(const Model& of) : model(of) {}

  const Model& model;
  std::vector<std::unique_ptr<RowMaker>> makers;
  std::vector<Index> first_slot{0};  ///< of each maker, and the number of slots
  std::vector<Index> nodes;          ///< that move and are asked for, each once
  std::vector<double> offset;        ///< by slot, <= 0
  std::vector<std::string> notes;
  std::shared_ptr<const ConstraintRows> fixed;  ///< null when some rows are not fixed
  ConstraintRows bonds, equations;
  Vec3 centre{};                               ///< of all nodes; pairs see positions relative to it
  std::vector<Vec3> x_begin, x, displacement;  ///< scratch of rows_at

  std::vector<std::shared_ptr<ConstraintRows>> made;  ///< rows that were given out; what nobody holds is filled again

  std::shared_ptr<ConstraintRows> empty_rows();
  bool place(const Vec3& origin, std::span<const double> u_begin, std::span<const double> u);
  /// Where a maker takes positions from: gaps of pairs are differences of positions of nodes, which far from the origin
  /// would be known to the rounding of their coordinates only; obstacles stand where the case says.
  Vec3 origin_of(std::size_t maker) const { return parts_of(model.contacts[maker]).other != nullptr ? centre : Vec3{}; }
  std::shared_ptr<ConstraintRows> make(std::span<const double> u_begin, std::span<const double> u,
                                       std::span<const RowHistory> history);
};

/// Rows without entries that nobody else holds.
std::shared_ptr<ConstraintRows> ContactGeometry::Impl::empty_rows() {
  for (const std::shared_ptr<ConstraintRows>& rows : made) {
    if (rows.use_count() > 1) continue;
    std::atomic_thread_fence(std::memory_order_acquire);  // another thread may have let them go
    rows->clear();
    return rows;
  }
  return made.emplace_back(std::make_shared<ConstraintRows>());
}

/// Positions of the nodes; false when one is not finite.
bool ContactGeometry::Impl::place(const Vec3& origin, std::span<const double> u_begin, std::span<const double> u) {
  std::atomic<bool> is_finite = true;
  constexpr std::size_t grain = 512;  // nodes per task: some ten microseconds of work
  parallel_for(nodes.size(), grain, [&](std::size_t begin, std::size_t end) {
    bool all = true;
    for (std::size_t k = begin; k < end; ++k) {
      const Index n = nodes[k];
      const auto i = 3 * static_cast<std::size_t>(n);
      const Vec3 X = subtract(model.mesh->coordinates[n], origin);
      x_begin[n] = add(X, {u_begin[i], u_begin[i + 1], u_begin[i + 2]});
      x[n] = add(X, {u[i], u[i + 1], u[i + 2]});
      displacement[n] = subtract(x[n], x_begin[n]);
      all = all && std::isfinite(dot(displacement[n], displacement[n]));
    }
    if (!all) is_finite.store(false, std::memory_order_relaxed);
  });
  return is_finite;
}

std::shared_ptr<ConstraintRows> ContactGeometry::Impl::make(std::span<const double> u_begin, std::span<const double> u,
                                                            std::span<const RowHistory> history) {
  const std::shared_ptr<ConstraintRows> kept = empty_rows();
  ConstraintRows& rows = *kept;
  for (std::size_t i = 0; i < makers.size(); ++i) {
    if (makers[i]->is_fixed()) {
      makers[i]->append({}, first_slot[i], rows);
      continue;
    }
    const Vec3 origin = origin_of(i);
    if (!place(origin, u_begin, u)) continue;
    const std::size_t before = rows.size();
    makers[i]->append({x_begin, x, displacement, u, history}, first_slot[i], rows);
    for (std::size_t r = before; r < rows.size(); ++r) rows.position[r] = add(rows.position[r], origin);
  }
  for (std::size_t r = 0; r < rows.size(); ++r) rows.gap[r] -= offset[rows.slot[r]];
  return kept;
}

ContactGeometry::ContactGeometry(const Model& model) : impl_(std::make_unique<Impl>(model)) {
  Impl& impl = *impl_;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const ContactDefinition& contact = model.contacts[i];
    const ContactParts parts = parts_of(contact);
    impl.makers.push_back(kind_of(contact).rows(model, contact, static_cast<Index>(i), impl.notes));
    impl.first_slot.push_back(impl.first_slot.back() + static_cast<Index>(impl.makers.back()->slots()));
    if (parts.nature == ContactNature::bonds) impl.makers.back()->append({}, impl.first_slot[i], impl.bonds);
    if (!impl.makers.back()->is_fixed()) add_moving_nodes(model, parts, impl.nodes);
    impl.makers.back()->add_moving_nodes(impl.nodes);
  }
  if (!model.equations.empty()) {
    const Index first = impl.first_slot.back();
    impl.makers.push_back(equation_rows(model));
    impl.first_slot.push_back(first + static_cast<Index>(impl.makers.back()->slots()));
    impl.makers.back()->append({}, first, impl.bonds);
    impl.makers.back()->append({}, first, impl.equations);
  }
  std::sort(impl.nodes.begin(), impl.nodes.end());
  impl.nodes.erase(std::unique(impl.nodes.begin(), impl.nodes.end()), impl.nodes.end());
  impl.offset.assign(slots(), 0.0);
  impl.centre = middle_of(model.mesh->coordinates);
  if (!impl.nodes.empty()) impl.x_begin = impl.x = impl.displacement = std::vector<Vec3>(model.mesh->node_count());
  const bool is_fixed =
      std::all_of(impl.makers.begin(), impl.makers.end(), [](const auto& m) { return m->is_fixed(); });
  if (is_fixed) impl.fixed = impl.make({}, {}, {});
}
ContactGeometry::~ContactGeometry() = default;
ContactGeometry::ContactGeometry(ContactGeometry&&) noexcept = default;

double ContactGeometry::reach() const {
  double reach = 0.0;
  for (std::size_t i = 0; i < impl_->makers.size(); ++i) {
    if (impl_->makers[i]->is_fixed()) continue;
    const Vec3 origin = impl_->origin_of(i);
    for (const Vec3& X : impl_->model.mesh->coordinates)
      for (std::size_t c = 0; c < 3; ++c) reach = std::max(reach, std::abs(X[c] - origin[c]));
  }
  return reach;
}
std::size_t ContactGeometry::slots() const {
  return static_cast<std::size_t>(impl_->first_slot.back());
}
bool ContactGeometry::is_fixed() const {
  return impl_->fixed != nullptr;
}
const ConstraintRows& ContactGeometry::bonds() const {
  return impl_->bonds;
}
const ConstraintRows& ContactGeometry::equations() const {
  return impl_->equations;
}
std::shared_ptr<const ConstraintRows> ContactGeometry::rows_at(std::span<const double> u_begin,
                                                               std::span<const double> u,
                                                               std::span<const RowHistory> history) const {
  return impl_->fixed ? impl_->fixed : impl_->make(u_begin, u, history);
}

ConstraintRows ContactGeometry::stiffness_rows() const {
  ConstraintRows rows;
  for (const auto& maker : impl_->makers) maker->append_stiffness(rows);
  return rows;
}

std::vector<Penetration> ContactGeometry::initial_penetrations(std::span<const double> u) const {
  const auto rows = rows_at(u, u);
  std::vector<Penetration> found;
  for (std::size_t r = 0; r < rows->size(); ++r) {
    const double gap = rows->gap_at(r, u);
    if (gap < 0.0 && !is_bond(rows->law[r]))
      found.push_back({rows->slot[r], rows->source[r], rows->position[r], -gap, std::min(-gap, rows->rounded[r])});
  }
  std::sort(found.begin(), found.end(), [](const Penetration& a, const Penetration& b) {
    return std::tuple(-a.depth, a.slot) < std::tuple(-b.depth, b.slot);
  });
  return found;
}

std::vector<RowHistory> ContactGeometry::first_history(std::span<const double> u) const {
  std::vector<RowHistory> history(slots());
  mark_behind(*rows_at(u, u), u, history);
  return history;
}

void ContactGeometry::set_initial(std::span<const double> u) {
  impl_->offset.assign(slots(), 0.0);
  if (impl_->fixed) impl_->fixed = impl_->make({}, {}, {});
  for (const Penetration& p : initial_penetrations(u))
    impl_->offset[p.slot] =
        initial_of(impl_->model.contacts[p.contact]) == InitialPenetration::strain_free_offset ? -p.depth : -p.rounded;
  if (impl_->fixed) impl_->fixed = impl_->make({}, {}, {});
}

std::string ContactGeometry::describe(const ConstraintRows& rows, std::size_t r) const {
  if (rows.source[r] < 0) return impl_->model.equations[static_cast<std::size_t>(-1 - rows.source[r])].name;
  const std::string& name = name_of(impl_->model.contacts[static_cast<std::size_t>(rows.source[r])]);
  const Vec3& x = rows.position[r];
  const Index node = rows.begin[r] < rows.begin[r + 1] ? rows.node[static_cast<std::size_t>(rows.begin[r])] : -1;
  const std::string at = node < 0 ? "" : fmt::format("node {} ", impl_->model.mesh->node_numbers[node]);
  return fmt::format("contact \"{}\", {}at ({:.4g}, {:.4g}, {:.4g})", name, at, x[0], x[1], x[2]);
}

const std::vector<std::string>& ContactGeometry::notes() const {
  return impl_->notes;
}

}  // namespace carom
