#include "contact/pair_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "contact/bar_pair_rows.hpp"
#include "contact/contact_kind.hpp"
#include "contact/edge_rows.hpp"
#include "contact/face_rows.hpp"
#include "contact/mirror_images.hpp"
#include "contact/sharp_nodes.hpp"
#include "contact/smooth_points.hpp"
#include "math/vec3.hpp"
#include "model/bodies.hpp"
#include "model/outer_facets.hpp"
#include "surface/facing_facets.hpp"
#include "surface/feature_edges.hpp"
#include "surface/half_thickness.hpp"
#include "surface/surface_search.hpp"
#include "surface/tangent_dual.hpp"

namespace carom {
namespace {

/// Least cosine between a row's normal and its facet's for which the facet can be turned about the row.
constexpr double least_cosine = 0.1;

bool is_points(const Surface& surface) {
  return !surface.facets.empty() && surface.facets.front().size == 1;
}

ContactLaw with_half_stiffness(ContactLaw law) {
  if (law.eps_N) *law.eps_N *= 0.5;
  if (law.eps_T) *law.eps_T *= 0.5;
  return law;
}

std::vector<Index> keys(const std::map<Index, double>& map) {
  std::vector<Index> out;
  for (const auto& [key, value] : map) out.push_back(key);
  return out;
}

/// Adds what the last row sees of one facet to its master nodes: `slope` of its gap, its tangential
/// motion times `factor`, and what the row's gap changes by as the facet's normal does.
void add_foot(ConstraintRows& rows, const FacetFoot& foot, const Facet& facet, const FacetFoot::Slope& slope,
              double factor, const Vec3& of_normal) {
  const FacetShape shape = facet_shape(facet.size, foot.xi, foot.eta);
  const Vec3 n = foot.normal, t_1 = rows.tangent_1.back(), t_2 = rows.tangent_2.back();
  TangentDual dual;
  if (std::abs(dot(foot.facet_normal, n)) >= least_cosine) dual = tangent_dual(foot.a_1, foot.a_2, n);
  const bool turns = of_normal != Vec3{};
  const TangentDual of_facet = turns ? tangent_dual(foot.a_1, foot.a_2, foot.facet_normal) : TangentDual{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) {
    const double w = -factor * foot.weight * foot.N[a];
    const Vec3 tilt = scaled(add(scaled(dual.dual_1, shape.dN_dxi[a]), scaled(dual.dual_2, shape.dN_deta[a])),
                             factor * foot.weight * foot.gap);
    Vec3 of_gap = scaled(add(scaled(slope.gradient, foot.N[a]), scaled(slope.at_closest, foot.N_closest[a])), -1.0);
    if (turns) {
      const double turn =
          dot(of_normal, of_facet.dual_1) * shape.dN_dxi[a] + dot(of_normal, of_facet.dual_2) * shape.dN_deta[a];
      of_gap = subtract(of_gap, scaled(foot.facet_normal, turn));
    }
    rows.add_behind(facet[a], {of_gap, add(scaled(t_1, w), scaled(n, dot(t_1, tilt))),
                               add(scaled(t_2, w), scaled(n, dot(t_2, tilt)))});
  }
}

/// Adds what the last row sees of the facets of a point: its gap's gradient times `gap_factor`, its tangential motion
/// times `factor`, and the slopes of the node's factor times `deep`.
void add_point(ConstraintRows& rows, const SurfacePoint& point, double gap_factor, double factor,
               const NodeStand::OfPoint& of_point, double deep, std::span<const Facet> facets) {
  for (std::size_t k = 0; k < point.feet.size(); ++k) {
    const FacetFoot& foot = point.feet[k];
    FacetFoot::Slope slope = scaled(foot.slope, gap_factor);
    Vec3 of_normal{};
    if (!of_point.normals.empty()) {
      of_normal = scaled(of_point.normals[k], deep);
      slope.gradient = add(slope.gradient, scaled(of_point.weights[k].gradient, deep));
      slope.at_closest = add(slope.at_closest, scaled(of_point.weights[k].at_closest, deep));
    }
    add_foot(rows, foot, facets[foot.facet], slope, factor, of_normal);
  }
}

/// Adds the nodes of the last row, whose gap is that of the point times the node's factor. An open row's factor is
/// held.
void add_nodes(ConstraintRows& rows, Index slave, const SurfacePoint& met, std::span<const SurfacePoint> sides,
               const NodeStand& stand, std::span<const Facet> facets) {
  const double f = stand.factor, deep = std::min(met.gap, 0.0), of_gap = f + deep * stand.of_met.gap;
  rows.add_block(slave, {add(scaled(met.gradient, of_gap), scaled(stand.of_node, deep)),
                         scaled(rows.tangent_1.back(), f), scaled(rows.tangent_2.back(), f)});
  if (deep < 0.0 && !stand.of_others.empty()) {
    RowBlocks others;
    for (const auto& [n, slope] : stand.of_others) others.add(n, scaled(slope, deep), {}, {});
    others.append_to(rows);
  }
  add_point(rows, met, of_gap, f, stand.of_met, deep, facets);
  for (std::size_t k = 0; k < stand.of_sides.size(); ++k)
    if (stand.of_sides[k].gap != 0.0 || !stand.of_sides[k].normals.empty())
      add_point(rows, sides[k], deep * stand.of_sides[k].gap, 0.0, stand.of_sides[k], deep, facets);
}

/// The nodes of one surface against the facets of another.
class NodeRows : public RowMaker {
 public:
  /// self: the two surfaces are one; bodies: by node, see half_thickness, needed for `self` alone. sides: where they
  /// are smooth, else null. sharp: the nodes that have rows, by how they stick out; null: all, wholly. most: that a
  /// node stands for.
  NodeRows(std::span<const Vec3> X, const Surface& slave, const Surface& master, bool self,
           const std::vector<Index>& bodies, const ContactLaw& law, Index source, const SmoothSides* sides,
           std::unique_ptr<const SharpNodes> sharp = nullptr, double most = std::numeric_limits<double>::infinity())
      : sharp_(std::move(sharp)), measures_(measures_of(X, slave, sides)), law_(law), source_(source), search_([&] {
          const double size = mean_facet_size(X, master.facets),
                       reach = std::max(size, mean_facet_size(X, slave.facets));
          SearchRange range{reach, 0.5 * size, std::vector<double>(master.facets.size(), reach),
                            edge_widths(X, master.facets), self ? bodies : std::vector<Index>{}};
          range.fades = law.eps_N && law.hold == RowHold::springs;
          range.moves_sides_out = !range.fades;
          if (self) range.depth = half_thickness(X, master.facets, bodies, reach);
          return SurfaceSearch(keys(measures_), slave.facets, master.facets, std::move(range));
        }()) {
    for (const auto& [n, measure] : measures_) measure_.push_back(std::min(measure, most));
    if (sides == nullptr) return;
    for (const auto& [n, measure] : measures_) is_inner_.push_back(sides->of_slave->is_inner_node(n));
    has_points_ = covered_shares(master.facets, *sides->of_master);
  }
  std::size_t slots() const override { return measure_.size(); }
  void append_keys(SlotKeys& keys) const override {
    for (const Index n : search_.nodes()) keys.add({&n, 1});
    keys.meet(node_keys(search_.facets()));
  }
  void add_moving_nodes(std::vector<Index>& nodes) const override {
    nodes.insert(nodes.end(), search_.nodes().begin(), search_.nodes().end());
  }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override {
    search_.update(motion.x_begin, motion.x, motion.displacement, motion.behind(first_slot, slots()));
    parts_.append(slots(), rows, [&](std::size_t begin, std::size_t end, ConstraintRows& made) {
      SurfaceSearch::Space space;
      for (std::size_t i = begin; i < end; ++i) {
        const SurfacePoint* met = search_.find(i, space);
        if (met == nullptr || leaves_to_points(i, met->facet)) continue;
        const Index n = search_.nodes()[i];
        std::vector<SurfacePoint> sides;
        NodeStand stand;
        if (sharp_) {
          sides = search_.other_sides(i, *met, space);
          stand = sharp_->stand(n, *met, sides, motion.x);
        }
        if (stand.factor == 0.0) continue;
        made.add_row(stand.factor * met->gap, direction(met->gradient), motion.x[n], measure_[i],
                     row_law(law_, measure_[i]), source_);
        made.facet.back() = met->facet;
        made.rounded.back() = met->rounded;
        add_nodes(made, n, *met, sides, stand, search_.facets());
        finish_row(made, motion.u, first_slot + static_cast<Index>(i));
      }
    });
  }

 private:
  std::map<Index, double> measures_of(std::span<const Vec3> X, const Surface& slave, const SmoothSides* sides) const {
    std::map<Index, double> measures = nodal_measures(X, slave);
    if (sharp_) std::erase_if(measures, [&](const auto& m) { return !sharp_->has(m.first); });
    if (sides != nullptr)
      std::erase_if(measures, [&](const auto& m) { return sides->of_slave->is_smooth_node(m.first); });
    return measures;
  }
  /// True where the points of a smooth master meet the flat face that the node is inside of.
  bool leaves_to_points(std::size_t i, Index facet) const {
    return facet >= 0 && !has_points_.empty() && is_inner_[i] && has_points_[static_cast<std::size_t>(facet)] == 1.0;
  }

  std::unique_ptr<const SharpNodes> sharp_;
  std::map<Index, double> measures_;
  std::vector<double> measure_;
  std::vector<bool> is_inner_;      ///< by slot; empty where nothing is smooth
  std::vector<double> has_points_;  ///< by master facet: the share of it that SmoothPoints stand for
  ContactLaw law_;
  Index source_;
  mutable SurfaceSearch search_;
  mutable RowParts parts_;
};

/// Ends of bars against ends of bars.
class EndRows : public RowMaker {
 public:
  EndRows(const Model& model, const Surface& slave, const Surface& master, const ContactLaw& law, Index source)
      : X_(model.mesh->coordinates), law_(law), measure_(slave.thickness), source_(source) {
    for (const Facet& end : slave.facets) slaves_.push_back(end[0]);
    std::sort(slaves_.begin(), slaves_.end());
    for (const Index s : slaves_) {
      const Vec3 of_slave = outward(*model.mesh, s);
      masters_.push_back({});
      double least = std::numeric_limits<double>::infinity();
      for (const Facet& end : master.facets) {
        const Vec3 n = outward(*model.mesh, end[0]);
        const double distance = norm(subtract(X_[end[0]], X_[s]));
        if (end[0] == s || !(dot(n, of_slave) < 0.0) || distance >= least) continue;
        least = distance;
        masters_.back() = {end[0], n};
      }
    }
  }
  std::size_t slots() const override { return slaves_.size(); }
  void append_keys(SlotKeys& keys) const override {
    for (const Index n : slaves_) keys.add({&n, 1});
    keys.meet({});
  }
  bool is_fixed() const override { return true; }
  void append(const ContactMotion& /*motion*/, Index first_slot, ConstraintRows& rows) const override {
    for (std::size_t i = 0; i < slaves_.size(); ++i) {
      const auto& [master, n] = masters_[i];
      if (master < 0) continue;
      const Vec3& X = X_[slaves_[i]];
      rows.add_row(dot(n, subtract(X, X_[master])), n, X, measure_, row_law(law_, measure_), source_);
      rows.add_node(slaves_[i], 1.0);
      rows.add_node(master, -1.0);
      rows.behind.back() = 1;
      rows.slot.back() = first_slot + static_cast<Index>(i);
    }
  }

 private:
  struct End {
    Index node = -1;
    Vec3 outward{};
  };
  /// Unit direction out of the bar at its end n; zero where n is the end of no bar.
  static Vec3 outward(const Mesh& mesh, Index n) {
    const CellBlock* lines = mesh.block(CellType::line2);
    if (lines == nullptr) return {};
    for (std::size_t i = 0; i < lines->connectivity.size(); ++i) {
      if (lines->connectivity[i] != n) continue;
      return normalized(subtract(mesh.coordinates[n], mesh.coordinates[lines->connectivity[i ^ 1U]]));
    }
    return {};
  }

  std::span<const Vec3> X_;
  ContactLaw law_;
  double measure_;
  Index source_;
  std::vector<Index> slaves_;
  std::vector<End> masters_;
};

bool has_sharp_edges(const Model& model, const Surface& surface) {
  constexpr double sharp = std::numbers::pi / 6.0;
  return !feature_edges(model.mesh->coordinates, surface.facets, {}, sharp).empty();
}

/// Null where the contact is to be seen as facets, or is flat.
std::optional<SmoothSides> smooth_sides(const Model& model, const PairContact& contact) {
  if (contact.smooth == Smoothing::none || !smooths(contact.method) || contact.law.hold != RowHold::springs ||
      !contact.law.eps_N)
    return std::nullopt;
  if (is_points(contact.slave) || is_points(contact.master)) return std::nullopt;
  if (contact.smooth == Smoothing::round &&
      (has_sharp_edges(model, contact.slave) || has_sharp_edges(model, contact.master)))
    return std::nullopt;
  const std::vector<Facet> beside = skin(model);
  const std::vector<std::array<bool, 3>> held = held_nodes(model);
  const auto of = [&](const Surface& surface) {
    return std::make_shared<const SmoothSurface>(*model.mesh, surface.facets, beside, held);
  };
  SmoothSides sides{contact.slave, contact.master, of(contact.slave), nullptr, contact.self};
  sides.of_master = contact.self ? sides.of_slave : of(contact.master);
  if (!sides.of_slave->has_curved() && !sides.of_master->has_curved()) return std::nullopt;
  return sides;
}

SmoothSides turned(const SmoothSides& sides) {
  return {sides.master, sides.slave, sides.of_master, sides.of_slave, sides.self};
}

/// Rows of the nodes amid curved facets. Their springs harden at half of the depth, since a pole presses on a part of
/// the area alone that the spring of a node stands for.
std::unique_ptr<RowMaker> smooth_rows(const Model& model, const SmoothSides& sides, ContactLaw law, Index source) {
  const std::shared_ptr<const SmoothSurface> surface = sides.of_slave;
  law.linear_depth *= 0.5;
  return face_rows(
      model.mesh->coordinates, sides.slave, std::make_unique<SmoothPoints>(model, sides),
      [surface](Index n) { return surface->is_smooth_node(n); }, law, source);
}

/// The rows of a maker with gaps that are larger by a distance.
class RowsWithAllowance : public RowMaker {
 public:
  RowsWithAllowance(std::unique_ptr<RowMaker> rows, double allowance) : rows_(std::move(rows)), allowance_(allowance) {}
  std::size_t slots() const override { return rows_->slots(); }
  void append_keys(SlotKeys& keys) const override { rows_->append_keys(keys); }
  bool is_fixed() const override { return rows_->is_fixed(); }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override {
    const std::size_t first = rows.size();
    rows_->append(motion, first_slot, rows);
    for (std::size_t r = first; r < rows.size(); ++r) {
      rows.gap[r] += allowance_;
      rows.allowed[r] = allowance_;
    }
  }
  void append_stiffness(ConstraintRows& rows) const override { rows_->append_stiffness(rows); }
  void add_moving_nodes(std::vector<Index>& nodes) const override { rows_->add_moving_nodes(nodes); }

 private:
  std::unique_ptr<RowMaker> rows_;
  double allowance_;
};

/// The rows of one pair by its method.
class MethodRows {
 public:
  MethodRows(const Model& model, const PairContact& contact, Index source, const SmoothSides* smooth)
      : model_(model), contact_(contact), source_(source), smooth_(smooth) {}

  std::unique_ptr<RowMaker> make() const;

 private:
  std::unique_ptr<RowMaker> of_nodes(const Surface& slave, const Surface& master, const ContactLaw& law,
                                     const SmoothSides* seen) const;
  std::unique_ptr<RowMaker> of_faces_and_corners() const;
  std::unique_ptr<RowMaker> of_means_and_guards() const;
  /// Of each node, where nodes may touch their own body; else empty.
  std::vector<Index> bodies() const { return contact_.self ? bodies_of_nodes(model_) : std::vector<Index>{}; }
  /// One way, or both ways with half of the stiffness each: make(slave, master, law, is_back).
  template <class Make>
  std::unique_ptr<RowMaker> both_ways(const Make& make) const;

  const Model& model_;
  const PairContact& contact_;
  Index source_;
  const SmoothSides* smooth_;
};

template <class Make>
std::unique_ptr<RowMaker> MethodRows::both_ways(const Make& make) const {
  const ContactLaw half = with_half_stiffness(contact_.law);
  if (contact_.self) return make(contact_.slave, contact_.master, half, false);
  auto both = std::make_unique<MakersInOrder>();
  both->add(make(contact_.slave, contact_.master, half, false));
  both->add(make(contact_.master, contact_.slave, half, true), true);
  return both;
}

std::unique_ptr<RowMaker> MethodRows::of_nodes(const Surface& slave, const Surface& master, const ContactLaw& law,
                                               const SmoothSides* seen) const {
  auto rows =
      std::make_unique<NodeRows>(model_.mesh->coordinates, slave, master, contact_.self, bodies(), law, source_, seen);
  if (seen == nullptr || !seen->of_slave->has_curved()) return rows;
  auto all = std::make_unique<MakersInOrder>();
  all->add(std::move(rows));
  all->add(smooth_rows(model_, *seen, law, source_));
  return all;
}

std::unique_ptr<RowMaker> MethodRows::of_faces_and_corners() const {
  return both_ways([this](const Surface& slave, const Surface& master, const ContactLaw& law, bool /*is_back*/) {
    auto all = std::make_unique<MakersInOrder>();
    all->add(face_rows(model_, slave, master, contact_.self, law, source_));
    all->add(std::make_unique<NodeRows>(model_.mesh->coordinates, slave, master, contact_.self, bodies(), law, source_,
                                        nullptr, std::make_unique<const SharpNodes>(model_, slave.facets)));
    return all;
  });
}

/// Means over the finer side, which carry the pressure, and nodes of both sides, which see what means do not: the pole
/// of a ball amid a coarse facet. They have an allowance, so that flat faces touch by their means alone.
std::unique_ptr<RowMaker> MethodRows::of_means_and_guards() const {
  constexpr double allowed = 0.01;  // of the facet size: above what means leave on flat faces, below what a user sees
  const std::span<const Vec3> X = model_.mesh->coordinates;
  const double own = mean_facet_size(X, contact_.slave.facets), other = mean_facet_size(X, contact_.master.facets);
  const bool is_finer = own <= other;
  const Surface &fine = is_finer ? contact_.slave : contact_.master,
                &coarse = is_finer ? contact_.master : contact_.slave;
  const ContactLaw law = contact_.self ? with_half_stiffness(contact_.law) : contact_.law;
  auto all = std::make_unique<MakersInOrder>();
  all->add(mean_rows(model_, fine, coarse, contact_.self, law, source_), !is_finer);
  all->add(std::make_unique<RowsWithAllowance>(
      both_ways([this](const Surface& slave, const Surface& master, const ContactLaw& half, bool /*is_back*/) {
        return of_nodes(slave, master, half, nullptr);
      }),
      allowed * std::min(own, other)));
  return all;
}

std::unique_ptr<RowMaker> MethodRows::make() const {
  const Surface &slave = contact_.slave, &master = contact_.master;
  const bool has_points = is_points(slave), both_points = has_points && is_points(master);
  if (!has_points && is_points(master)) {
    throw std::invalid_argument("contact \"" + contact_.name +
                                "\": the ends of bars cannot be the master of facets; exchange group and master");
  }
  const ContactLaw one_way = contact_.self ? with_half_stiffness(contact_.law) : contact_.law;
  if (both_points) return std::make_unique<EndRows>(model_, slave, master, one_way, source_);
  if (has_points) return of_nodes(slave, master, one_way, nullptr);
  switch (contact_.method) {
    case PairMethod::surface_to_surface:
      return mean_rows(model_, slave, master, contact_.self, one_way, source_);
    case PairMethod::faces:
      return contact_.law.hold == RowHold::springs ? of_faces_and_corners() : of_means_and_guards();
    case PairMethod::node_to_surface:
      return of_nodes(slave, master, one_way, smooth_);
    case PairMethod::two_pass:
      break;
  }
  const std::optional<SmoothSides> back = smooth_ != nullptr ? std::optional(turned(*smooth_)) : std::nullopt;
  return both_ways([&](const Surface& own, const Surface& other, const ContactLaw& half, bool is_back) {
    return of_nodes(own, other, half, !is_back ? smooth_ : back ? &*back : nullptr);
  });
}

}  // namespace

namespace {

/// Nodes that all cells have left.
std::unique_ptr<RowMaker> rows_of_points(const Model& model, const Surface& points, const Surface& master,
                                         const ContactLaw& law, Index source) {
  return std::make_unique<NodeRows>(model.mesh->coordinates, points, master, false, std::vector<Index>{}, law, source,
                                    nullptr);
}

}  // namespace

std::unique_ptr<RowMaker> pair_rows(const Model& model, const PairContact& contact, Index source) {
  if (!contact.slave_bars.empty()) return bar_pair_rows(model, contact, source);
  const std::optional<SmoothSides> smooth = smooth_sides(model, contact);
  if (smooth && contact.method == PairMethod::faces) {  // the rows of curved facets stand in the place of nodes
    PairContact by_nodes = contact;
    by_nodes.method = PairMethod::two_pass;
    return pair_rows(model, by_nodes, source);
  }
  const SmoothSides* const sides = smooth ? &*smooth : nullptr;
  std::unique_ptr<RowMaker> of_method = MethodRows(model, contact, source, sides).make(),
                            of_edges = edge_rows(model, contact, source, sides);
  const bool has_loose = !contact.loose_slave.facets.empty() || !contact.loose_master.facets.empty();
  if (!of_edges && !has_loose) return of_method;
  auto all = std::make_unique<MakersInOrder>();
  all->add(std::move(of_method));
  if (of_edges) all->add(std::move(of_edges));
  if (has_loose) {
    all->add(rows_of_points(model, contact.loose_slave, contact.master, contact.law, source));
    all->add(rows_of_points(model, contact.loose_master, contact.slave, contact.law, source), true);
  }
  return all;
}

std::unique_ptr<RowMaker> rigid_pair_rows(const Model& model, const PairContact& contact, Index source) {
  const std::span<const Vec3> X = model.mesh->coordinates;
  double area = 0.0;
  for (const auto& [n, measure] : nodal_measures(X, contact.slave)) area += measure;
  const double most = area / static_cast<double>(contact.slave.facets.size());
  const auto corners = [&](const Surface& of, const Surface& against) {
    return std::make_unique<NodeRows>(X, of, against, false, std::vector<Index>{}, contact.law, source, nullptr,
                                      std::make_unique<const SharpNodes>(model, of.facets), most);
  };
  auto all = std::make_unique<MakersInOrder>();
  all->add(face_rows(model, contact.slave, contact.master, false, contact.law, source));
  all->add(corners(contact.slave, contact.master));
  all->add(corners(contact.master, contact.slave), true);
  if (auto of_edges = edge_rows(model, contact, source, nullptr)) all->add(std::move(of_edges));
  return all;
}

namespace {

StiffnessChoice pair_stiffness(const PartCells& cells, const ContactDefinition& definition) {
  const auto& pair = std::get<PairContact>(definition);
  if (!pair.slave_bars.empty()) return bar_choice(cells.model(), {pair.slave_bars, pair.master_bars});
  const FacingFacets facing = facing_facets(cells.model(), pair);
  return {{side_of(cells, facing.slave, pair.name), side_of(cells, facing.master, pair.name)}};
}

std::size_t shared_pairs(const ContactDefinition& first, const ContactDefinition& second) {
  const ContactParts a = parts_of(first), b = parts_of(second);
  const std::size_t both = shared_facets(a, b) + shared_bars(a, b);
  return a.is_self && b.is_self && both == 1 ? 0 : both;  // one facet does not touch itself
}

}  // namespace

ContactKind pair_contact_row() {
  return {.name = "pair",
          .rows = [](const Model& model, const ContactDefinition& contact, Index source,
                     std::vector<std::string>&) { return pair_rows(model, std::get<PairContact>(contact), source); },
          .stiffness = pair_stiffness,
          .shared = shared_pairs};
}

}  // namespace carom
