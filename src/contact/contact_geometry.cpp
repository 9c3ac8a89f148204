#include "contact/contact_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "contact/contact_kind.hpp"
#include "contact/embedded_rows.hpp"
#include "contact/equation_rows.hpp"
#include "contact/mirror_images.hpp"
#include "contact/row_maker.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"
#include "rows/response.hpp"

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

bool rubs(const Model& model) {
  return std::ranges::any_of(model.contacts, [](const ContactDefinition& contact) {
    const ContactLaw* law = law_of(contact);
    return law != nullptr && law->friction;
  });
}

}  // namespace

/// The makers of a model's rows.
struct RowMakers {
  RowMakers(const Model& of, const MirrorImages& images, std::shared_ptr<const Topology> by);

  const Model& model;
  std::shared_ptr<const Topology> topology;  ///< that the model is of; null: all cells are there
  std::vector<std::unique_ptr<RowMaker>> makers;
  std::vector<Index> first_slot{0};  ///< of each maker, and the number of slots
  std::vector<Index> nodes;          ///< that move and are asked for, each once
  std::vector<double> offset;        ///< by slot, <= 0
  std::vector<std::string> notes;
  std::shared_ptr<const ConstraintRows> fixed;  ///< null when some rows are not fixed, or cells have gone
  ConstraintRows bonds, equations;
  std::vector<bool> has_images;        ///< by maker: its rows are those of the whole
  std::optional<SlotKeys> whole_keys;  ///< where one has images

  std::size_t slots() const { return static_cast<std::size_t>(first_slot.back()); }
  SlotKeys keys() const {
    SlotKeys keys;
    for (std::size_t i = 0; i < makers.size(); ++i) {
      makers[i]->append_keys(keys);
      keys.set_maker(static_cast<std::size_t>(first_slot[i]), i);
    }
    return keys;
  }
};

RowMakers::RowMakers(const Model& of, const MirrorImages& images, std::shared_ptr<const Topology> by)
    : model(of), topology(std::move(by)) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    has_images.push_back(!images.empty() && MirrorImages::has_images(model.contacts[i]));
    const Model& seen = has_images[i] ? images.whole() : model;
    const ContactDefinition& contact = seen.contacts[i];
    const ContactParts parts = parts_of(contact);
    makers.push_back(kind_of(contact).rows(seen, contact, static_cast<Index>(i), notes));
    first_slot.push_back(first_slot.back() + static_cast<Index>(makers.back()->slots()));
    if (parts.nature == ContactNature::bonds) makers.back()->append({}, first_slot[i], bonds);
    if (!makers.back()->is_fixed()) add_moving_nodes(seen, parts, nodes);
    makers.back()->add_moving_nodes(nodes);
  }
  if (!model.equations.empty()) {
    const Index first = first_slot.back();
    makers.push_back(equation_rows(model));
    has_images.push_back(false);
    first_slot.push_back(first + static_cast<Index>(makers.back()->slots()));
    makers.back()->append({}, first, bonds);
    makers.back()->append({}, first, equations);
  }
  embed(model.embedding, bonds);
  embed(model.embedding, equations);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  offset.assign(slots(), 0.0);
  if (std::ranges::find(has_images, true) != has_images.end()) whole_keys = keys();
}

namespace {

/// How fast the two sides of a row slide.
double slip_rate(const ConstraintRows& rows, std::size_t r, std::span<const double> v) {
  const Vec3 w = rows.relative(r, v);
  return std::hypot(w[1], w[2]);
}

/// Gives the rows of contacts with a law of friction their coefficients, from what pressed and slid at the beginning of
/// the step; of rows that were not there: nothing pressed.
void rub(const RowMakers& all, std::span<const double> u_begin, const ContactPast& past, ConstraintRows& rows) {
  constexpr double least = 1e-12;    // so that a row has friction, or not, for the whole run
  std::map<Index, std::size_t> was;  // by slot
  for (std::size_t r = 0; past.pressed != nullptr && r < past.pressed->status.size(); ++r)
    was[past.pressed->rows->slot[r]] = r;
  for (std::size_t c = 0; c < all.model.contacts.size(); ++c) {
    const ContactLaw* law = law_of(all.model.contacts[c]);
    if (law == nullptr || !law->friction) continue;
    std::vector<std::size_t> of_contact;
    RubbingRows seen;
    seen.time = past.time;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (rows.source[r] != static_cast<Index>(c)) continue;
      of_contact.push_back(r);
      const auto before = was.find(rows.slot[r]);
      const bool is_known = before != was.end();
      seen.pressure.push_back(is_known ? std::max(0.0, past.pressed->force[before->second][0]) /
                                             past.pressed->rows->measure[before->second]
                                       : 0.0);
      seen.slip_rate.push_back(is_known ? slip_rate(*past.pressed->rows, before->second, past.velocity) : 0.0);
      // Rows that are fixed stand where they were made, others where they were at the beginning, if they were there.
      seen.position.push_back(all.makers[c]->is_fixed()
                                  ? add(rows.position[r], rows.to_space(r, rows.relative(r, u_begin)))
                              : is_known ? past.pressed->rows->position[before->second]
                                         : rows.position[r]);
    }
    if (of_contact.empty()) continue;
    const std::vector<double> mu = (*law->friction)(seen);
    for (std::size_t i = 0; i < of_contact.size(); ++i) rows.law[of_contact[i]].mu *= std::max(least, mu[i]);
  }
}

}  // namespace

struct ContactGeometry::Impl {
  explicit Impl(const Model& of)
      : model(of),
        has_friction_law(rubs(of)),
        images(of),
        whole(of, images, nullptr),
        centre(middle_of(of.mesh->coordinates)) {
    for (const Vec3& X : of.mesh->coordinates)
      for (std::size_t c = 0; c < 3; ++c) extent = std::max(extent, std::abs(X[c] - centre[c]));
  }

  const Model& model;
  const bool has_friction_law;
  MirrorImages images;
  RowMakers whole;                             ///< of all cells
  std::unique_ptr<RowMakers> eroded;           ///< of the topology that was asked for last
  Vec3 centre{};                               ///< of all nodes; pairs see positions relative to it
  double extent = 0.0;                         ///< of all nodes from the centre
  std::vector<Vec3> x_begin, x, displacement;  ///< scratch of rows_at
  std::vector<double> spread_begin, spread;    ///< displacements with those of followers or images; scratch of rows_at
  ConstraintRows seen;                         ///< of the whole, before they are folded; scratch of make

  std::vector<std::shared_ptr<ConstraintRows>> made;  ///< rows that were given out; what nobody holds is filled again

  RowMakers& of(const std::shared_ptr<const Topology>& topology);
  void make_room(const RowMakers& all);
  void fix(RowMakers& all);
  std::shared_ptr<ConstraintRows> empty_rows();
  bool place(std::span<const Index> nodes, const Vec3& origin, std::span<const double> u_begin,
             std::span<const double> u);
  /// Where a maker takes positions from: gaps of pairs are differences of positions of nodes, which far from the origin
  /// would be known to the rounding of their coordinates only; obstacles stand where the case says.
  Vec3 origin_of(std::size_t maker) const { return parts_of(model.contacts[maker]).other != nullptr ? centre : Vec3{}; }
  std::shared_ptr<ConstraintRows> make(const RowMakers& all, std::span<const double> u_begin, std::span<const double> u,
                                       const ContactPast& past);
};

/// Those of a topology, which are kept while it is the same. Rows of what was closed at the start have no offset any
/// more where cells have gone.
RowMakers& ContactGeometry::Impl::of(const std::shared_ptr<const Topology>& topology) {
  if (!topology) return whole;
  if (!eroded || (eroded->topology != topology && !(*eroded->topology == *topology))) {
    eroded = std::make_unique<RowMakers>(topology->model, images, topology);
    make_room(*eroded);
  }
  return *eroded;
}

void ContactGeometry::Impl::make_room(const RowMakers& all) {
  if (x.empty() && !all.nodes.empty())
    x_begin = x = displacement = std::vector<Vec3>(images.whole().mesh->node_count());
}

/// Makes the rows that never change, if all of them are such.
void ContactGeometry::Impl::fix(RowMakers& all) {
  make_room(all);
  if (!has_friction_law &&
      std::all_of(all.makers.begin(), all.makers.end(), [](const auto& m) { return m->is_fixed(); }))
    all.fixed = make(all, {}, {}, {});
}

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
bool ContactGeometry::Impl::place(std::span<const Index> nodes, const Vec3& origin, std::span<const double> u_begin,
                                  std::span<const double> u) {
  std::atomic<bool> is_finite = true;
  constexpr std::size_t grain = 512;  // nodes per task: some ten microseconds of work
  parallel_for(nodes.size(), grain, [&](std::size_t begin, std::size_t end) {
    bool all = true;
    for (std::size_t k = begin; k < end; ++k) {
      const Index n = nodes[k];
      const auto i = 3 * static_cast<std::size_t>(n);
      const Vec3 X = subtract(images.whole().mesh->coordinates[static_cast<std::size_t>(n)], origin);
      x_begin[n] = add(X, {u_begin[i], u_begin[i + 1], u_begin[i + 2]});
      x[n] = add(X, {u[i], u[i + 1], u[i + 2]});
      displacement[n] = subtract(x[n], x_begin[n]);
      all = all && std::isfinite(dot(displacement[n], displacement[n]));
    }
    if (!all) is_finite.store(false, std::memory_order_relaxed);
  });
  return is_finite;
}

std::shared_ptr<ConstraintRows> ContactGeometry::Impl::make(const RowMakers& all, std::span<const double> u_begin,
                                                            std::span<const double> u, const ContactPast& past) {
  const std::span<const RowHistory> history = past.history;
  const std::shared_ptr<ConstraintRows> kept = empty_rows();
  ConstraintRows& rows = *kept;
  for (std::size_t i = 0; i < all.makers.size(); ++i) {
    if (all.makers[i]->is_fixed()) {
      all.makers[i]->append({}, all.first_slot[i], rows);
      continue;
    }
    const Vec3 origin = origin_of(i);
    if (!place(all.nodes, origin, u_begin, u)) continue;
    const std::size_t before = rows.size();
    const ContactMotion motion{x_begin, x, displacement, u, history};
    if (all.has_images[i]) {
      seen.clear();
      all.makers[i]->append(motion, all.first_slot[i], seen);
      for (std::size_t r = 0; r < seen.size(); ++r)
        images.fold(
            seen, r,
            images.share(all.whole_keys->nodes(static_cast<std::size_t>(seen.slot[r])), add(seen.position[r], origin)),
            rows);
    } else {
      all.makers[i]->append(motion, all.first_slot[i], rows);
    }
    for (std::size_t r = before; r < rows.size(); ++r) rows.position[r] = add(rows.position[r], origin);
  }
  embed(all.model.embedding, rows);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows.gap[r] -= all.offset[rows.slot[r]];
    if (history.empty()) continue;
    rows.offset[r] = history[rows.slot[r]].offset;
    rows.gap[r] -= rows.offset[r];
  }
  if (has_friction_law) rub(all, u_begin, past, rows);
  return kept;
}

ContactGeometry::ContactGeometry(const Model& model) : impl_(std::make_unique<Impl>(model)) {
  impl_->fix(impl_->whole);
  if (!impl_->images.empty()) impl_->whole.notes.push_back(impl_->images.note());
}
ContactGeometry::~ContactGeometry() = default;
ContactGeometry::ContactGeometry(ContactGeometry&&) noexcept = default;

double ContactGeometry::reach() const {
  double reach = 0.0;
  for (std::size_t i = 0; i < impl_->whole.makers.size(); ++i) {
    if (impl_->whole.makers[i]->is_fixed()) continue;
    const Vec3 origin = impl_->origin_of(i);
    for (const Vec3& X : impl_->model.mesh->coordinates)
      for (std::size_t c = 0; c < 3; ++c) reach = std::max(reach, std::abs(X[c] - origin[c]));
  }
  return reach;
}
double ContactGeometry::extent() const {
  return impl_->extent;
}
std::size_t ContactGeometry::slots(const std::shared_ptr<const Topology>& topology) const {
  return impl_->of(topology).slots();
}
bool ContactGeometry::is_fixed() const {
  return impl_->whole.fixed != nullptr;
}
const ConstraintRows& ContactGeometry::bonds() const {
  return impl_->whole.bonds;
}
const ConstraintRows& ContactGeometry::equations() const {
  return impl_->whole.equations;
}
std::shared_ptr<const ConstraintRows> ContactGeometry::rows_at(std::span<const double> u_begin,
                                                               std::span<const double> u,
                                                               const ContactPast& past) const {
  const RowMakers& all = impl_->of(past.topology);
  if (all.fixed) return all.fixed;
  const MirrorImages& images = impl_->images;
  if (all.model.embedding.empty() && images.empty()) return impl_->make(all, u_begin, u, past);
  const auto with_others = [&](std::span<const double> values, std::vector<double>& own) {
    own.assign(values.begin(), values.end());
    all.model.embedding.spread(own);
    images.spread(own);
  };
  with_others(u_begin, impl_->spread_begin);
  with_others(u, impl_->spread);
  return impl_->make(all, impl_->spread_begin, impl_->spread, past);
}

ConstraintRows ContactGeometry::stiffness_rows() const {
  ConstraintRows rows;
  const RowMakers& all = impl_->whole;
  for (std::size_t i = 0; i < all.makers.size(); ++i) {
    if (!all.has_images[i]) {
      all.makers[i]->append_stiffness(rows);
      continue;
    }
    ConstraintRows seen;
    all.makers[i]->append_stiffness(seen);
    for (std::size_t r = 0; r < seen.size(); ++r) impl_->images.fold(seen, r, impl_->images.even_share(), rows);
  }
  embed(impl_->model.embedding, rows);
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

std::vector<RowHistory> ContactGeometry::carried_history(const ContactPast& before, const ConstraintRows& rows,
                                                         std::span<const double> u,
                                                         const std::shared_ptr<const Topology>& after) const {
  const SlotKeys keys_before = impl_->of(before.topology).keys(), keys = impl_->of(after).keys();
  const std::vector<std::ptrdiff_t> places = keys.places_in(keys_before);
  std::vector<RowHistory> history = keys.carry(keys_before, places, before.history);
  std::vector<double> depth(keys_before.size(), 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r)
    depth[static_cast<std::size_t>(rows.slot[r])] = std::min(0.0, rows.gap_at(r, u));
  const auto now = rows_at(u, u, {history, after});
  for (std::size_t r = 0; r < now->size(); ++r) {
    if (is_bond(now->law[r])) continue;
    const auto slot = static_cast<std::size_t>(now->slot[r]);
    const double was = places[slot] < 0 ? 0.0 : depth[static_cast<std::size_t>(places[slot])];
    history[slot].offset += std::min(0.0, now->gap_at(r, u) - was);
  }
  return history;
}

std::vector<RowHistory> ContactGeometry::first_history(std::span<const double> u) const {
  std::vector<RowHistory> history(slots());
  mark_behind(*rows_at(u, u), u, history);
  return history;
}

void ContactGeometry::set_initial(std::span<const double> u) {
  RowMakers& all = impl_->whole;
  all.offset.assign(slots(), 0.0);
  impl_->fix(all);
  for (const Penetration& p : initial_penetrations(u))
    all.offset[p.slot] =
        initial_of(impl_->model.contacts[p.contact]) == InitialPenetration::strain_free_offset ? -p.depth : -p.rounded;
  impl_->fix(all);
}

std::string ContactGeometry::describe(const ConstraintRows& rows, std::size_t r) const {
  if (rows.source[r] < 0) return impl_->model.equations[static_cast<std::size_t>(-1 - rows.source[r])].name;
  const std::string& name = name_of(impl_->model.contacts[static_cast<std::size_t>(rows.source[r])]);
  const Vec3& x = rows.position[r];
  const Index node = rows.begin[r] < rows.begin[r + 1] ? rows.node[static_cast<std::size_t>(rows.begin[r])] : -1;
  const std::string at = node < 0 ? "" : fmt::format("node {} ", impl_->model.mesh->node_label(node));
  return fmt::format("contact \"{}\", {}at ({:.4g}, {:.4g}, {:.4g})", name, at, x[0], x[1], x[2]);
}

const std::vector<std::string>& ContactGeometry::notes() const {
  return impl_->whole.notes;
}

}  // namespace carom
