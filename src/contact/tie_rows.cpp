#include "contact/tie_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "contact/contact_kind.hpp"
#include "contact/face_rows.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "surface/box_tree.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/facet_projection.hpp"

namespace carom {
namespace {

/// Points have none.
double tied_size(const PlacedFacet& facet) {
  return facet.size == 1 ? 0.0 : facet_size(facet);
}

/// Where a slave node is on the master.
struct Foot {
  Index facet = -1;
  Projection at;
};

/// The master in the reference configuration.
class Master {
 public:
  Master(std::span<const Vec3> X, const TieContact& given) : X_(X), facets_(given.master.facets), tie_(given) {
    std::vector<Bounds> boxes;
    for (const Facet& facet : facets_) {
      Bounds box;
      for (const Index n : facet) box.include(X[static_cast<std::size_t>(n)]);
      box.grow(reach(facet));
      boxes.push_back(box);
    }
    tree_.build(boxes);
  }

  /// The nearest facet that the node is near enough to; of equally near ones the first.
  std::optional<Foot> near(const Vec3& x) const {
    std::vector<Index> found;
    tree_.find({x, x}, found);
    std::sort(found.begin(), found.end());
    return nearest(x, found, true);
  }
  /// The nearest of all.
  Foot any(const Vec3& x) const {
    std::vector<Index> all(facets_.size());
    for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<Index>(f);
    return *nearest(x, all, false);
  }
  double size(Index f) const { return tied_size(place(facets_[static_cast<std::size_t>(f)], X_)); }
  /// How far from the facet nodes are tied; coincident ones are whatever the tolerance is.
  double reach(const Facet& facet) const {
    double far = 0.0;
    for (const Index n : facet) far = std::max(far, norm(X_[static_cast<std::size_t>(n)]));
    return tie_.distance.value_or(tie_.tolerance * tied_size(place(facet, X_))) + 1e-12 * far;
  }

 private:
  std::optional<Foot> nearest(const Vec3& x, std::span<const Index> candidates, bool within) const {
    std::optional<Foot> best;
    for (const Index f : candidates) {
      const Facet& facet = facets_[static_cast<std::size_t>(f)];
      const Projection at = project(place(facet, X_), x);
      if (within && !(at.distance <= reach(facet))) continue;
      if (!best || at.distance < best->at.distance) best = {f, at};
    }
    return best;
  }

  std::span<const Vec3> X_;
  std::span<const Facet> facets_;
  const TieContact& tie_;
  BoxTree tree_;
};

/// The nodes of the cell of a part behind each of some facets.
class CellsBehind {
 public:
  CellsBehind(const Model& model, std::span<const Facet> facets) {
    std::map<Index, std::vector<std::size_t>> at_node;  // facets by their first node
    for (std::size_t f = 0; f < facets.size(); ++f) at_node[facets[f][0]].push_back(f);
    nodes_.resize(facets.size());
    for (const Part& part : model.parts) {
      const auto size = static_cast<std::size_t>(node_count(part.type));
      const std::span<const Index> all = model.mesh->block(part.type)->connectivity;
      for (const Index cell : part.cells) {
        const auto nodes = all.subspan(size * static_cast<std::size_t>(cell), size);
        const auto holds = [&](Index n) { return std::find(nodes.begin(), nodes.end(), n) != nodes.end(); };
        for (const Index n : nodes) {
          const auto found = at_node.find(n);
          if (found == at_node.end()) continue;
          for (const std::size_t f : found->second)
            if (std::all_of(facets[f].begin(), facets[f].end(), holds)) nodes_[f] = nodes;
        }
      }
    }
  }
  std::span<const Index> of(Index facet) const { return nodes_[static_cast<std::size_t>(facet)]; }

 private:
  std::vector<std::span<const Index>> nodes_;
};

/// Solves the symmetric positive definite S x = b by L D L^T; nothing where S is singular.
std::optional<Vec3> solved(std::array<Vec3, 3> S, Vec3 b) {
  const double scale = std::max({S[0][0], S[1][1], S[2][2]});
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(S[k][k] > 1e-12 * scale)) return std::nullopt;
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = S[i][k] / S[k][k];
      for (std::size_t j = k; j < 3; ++j) S[i][j] -= factor * S[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = 3; k-- > 0;) {
    for (std::size_t j = k + 1; j < 3; ++j) b[k] -= S[k][j] * b[j];
    b[k] /= S[k][k];
  }
  return b;
}

/// Of coordinates.
constexpr double place_rounding = 8.0 * std::numeric_limits<double>::epsilon();

using Weights = std::vector<std::pair<Index, double>>;

/// Adds the least change d of weights, sum of d = 0, sum of d_a X_a = o:
///   d_a = (X_a - X) . S^-1 o,  X the mean of the nodes, S = sum of (X_a - X)(X_a - X)^T.
/// False where the nodes do not span the direction of o.
bool add_offset(std::span<const Vec3> X, std::span<const Index> nodes, const Vec3& o, Weights& weights) {
  if (nodes.empty()) return false;
  Vec3 mean{};
  for (const Index n : nodes) mean = add(mean, scaled(X[static_cast<std::size_t>(n)], 1.0 / nodes.size()));
  std::array<Vec3, 3> S{};
  for (const Index n : nodes) {
    const Vec3 d = subtract(X[static_cast<std::size_t>(n)], mean);
    for (std::size_t i = 0; i < 3; ++i) S[i] = add(S[i], scaled(d, d[i]));
  }
  if (S[2][2] == 0.0) S[2][2] = S[0][0] + S[1][1];  // in the plane, where o is as well
  const std::optional<Vec3> y = solved(S, o);
  if (!y) return false;
  for (const Index n : nodes) {
    const double change = dot(subtract(X[static_cast<std::size_t>(n)], mean), *y);
    const auto known = std::ranges::find(weights, n, &Weights::value_type::first);
    if (known != weights.end())
      known->second += change;
    else
      weights.emplace_back(n, change);
  }
  return true;
}

/// Makes the bonds and counts what is too far away.
class TieMaker {
 public:
  TieMaker(const Model& model, const TieContact& contact, Index source)
      : model_(model),
        contact_(contact),
        source_(source),
        X_(model.mesh->coordinates),
        master_(X_, contact),
        behind_(model, contact.master.facets) {}

  void add(Index slave, double share) {
    const Vec3& x = X_[static_cast<std::size_t>(slave)];
    const std::optional<Foot> foot = master_.near(x);
    if (!foot || !tie(slave, share, *foot)) note_far(slave);
  }

  /// Row r of mean_rows, whose first node it belongs to, as a bond.
  void add_mean(const ConstraintRows& means, std::size_t r) {
    const auto begin = static_cast<std::size_t>(means.begin[r]), end = static_cast<std::size_t>(means.begin[r + 1]);
    const std::size_t split = end - static_cast<std::size_t>(means.behind[r]);
    const Vec3& t = means.tangent_1[r];
    Weights own, others;
    for (std::size_t k = begin; k < split; ++k) own.emplace_back(means.node[k], dot(means.block[k][1], t));
    for (std::size_t k = split; k < end; ++k) others.emplace_back(means.node[k], -dot(means.block[k][1], t));
    const Index slave = means.node[begin];
    const Vec3 o = subtract(mean_place(own), mean_place(others));
    const Vec3 place = mean_place(others);
    const std::optional<Foot> near = master_.near(place);
    const Foot foot = near ? *near : master_.any(place);
    const double rounding = place_rounding * norm(means.position[r]);
    const bool is_near = norm(o) <= master_.reach(contact_.master.facets[static_cast<std::size_t>(foot.facet)]);
    if (!is_near || (norm(o) > rounding && !add_offset(X_, behind_.of(foot.facet), o, others))) {
      note_far(slave, norm(o), foot.facet);
      return;
    }
    add_bond(means.normal[r], means.position[r], means.measure[r], own, others);
    rows.facet.back() = foot.facet;
  }
  void note_far(Index slave) {
    const Foot foot = master_.any(X_[static_cast<std::size_t>(slave)]);
    note_far(slave, foot.at.distance, foot.facet);
  }

  ConstraintRows rows;
  std::size_t joined = 0, far = 0;

  /// "12 of 40 slave nodes, the farthest of them ...".
  std::string far_ones() const {
    const Vec3& x = X_[static_cast<std::size_t>(farthest_)];
    const std::string limit = contact_.distance ? fmt::format("{:.4g}", *contact_.distance)
                                                : fmt::format("{:.4g} facet sizes", contact_.tolerance);
    return fmt::format(
        "{} of {} slave nodes are farther from the master than {}, the farthest, node {} at ({:.4g}, {:.4g}, {:.4g}), "
        "by {:.4g}, which is {:.3g} facet sizes",
        far, far + joined + rows.size(), limit, model_.mesh->node_label(farthest_), x[0], x[1], x[2], distance_,
        size_ > 0.0 ? distance_ / size_ : std::numeric_limits<double>::infinity());
  }

 private:
  /// False when the nodes of the cell behind cannot carry what the slave node is away from the facet.
  bool tie(Index slave, double share, const Foot& foot) {
    const Facet& facet = contact_.master.facets[static_cast<std::size_t>(foot.facet)];
    if (std::find(facet.begin(), facet.end(), slave) != facet.end()) {
      ++joined;
      return true;
    }
    const Vec3& x = X_[static_cast<std::size_t>(slave)];
    Weights weights;
    for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) weights.emplace_back(facet[a], foot.at.N[a]);
    const Vec3 o = subtract(x, foot.at.point);
    if (norm(o) > place_rounding * norm(x) && !add_offset(X_, behind_.of(foot.facet), o, weights)) return false;
    add_bond(norm(foot.at.normal) > 0.0 ? foot.at.normal : Vec3{1.0, 0.0, 0.0}, x, share, {{slave, 1.0}}, weights);
    rows.facet.back() = foot.facet;
    return true;
  }

  void add_bond(const Vec3& normal, const Vec3& x, double share, const Weights& own, const Weights& others) {
    RowLaw law = row_law(contact_.law, share);
    law.set = AdmissibleSet::bond;
    rows.add_row(0.0, normal, x, share, law, source_);
    rows.reach.back() = 0.0;  // it sees displacements, no places
    for (const auto& [n, w] : own) rows.add_node(n, w);
    for (const auto& [n, w] : others) rows.add_node(n, -w);
    rows.behind.back() = static_cast<Index>(others.size());
  }

  Vec3 mean_place(const Weights& weights) const {
    Vec3 x{};
    for (const auto& [n, w] : weights) x = carom::add(x, scaled(X_[static_cast<std::size_t>(n)], w));
    return x;
  }

  void note_far(Index slave, double distance, Index facet) {
    ++far;
    if (distance < distance_) return;
    distance_ = distance;
    size_ = master_.size(facet);
    farthest_ = slave;
  }

  const Model& model_;
  const TieContact& contact_;
  Index source_;
  std::span<const Vec3> X_;
  Master master_;
  CellsBehind behind_;
  Index farthest_ = -1;
  double distance_ = 0.0, size_ = 0.0;
};

/// By the rows of the same surfaces in contact, where they stand.
void add_means(const Model& model, const TieContact& contact, Index source, const std::map<Index, double>& slaves,
               TieMaker& made) {
  const std::vector<Vec3>& X = model.mesh->coordinates;
  const std::vector<Vec3> at_rest(X.size());
  const std::vector<double> zero(3 * X.size(), 0.0);
  ConstraintRows means;
  mean_rows(model, contact.slave, contact.master, false, {}, source)->append({X, X, at_rest, zero}, 0, means);
  std::size_t r = 0;
  for (const auto& [node, share] : slaves) {
    if (r < means.size() && means.node[static_cast<std::size_t>(means.begin[r])] == node)
      made.add_mean(means, r++);
    else
      made.note_far(node);
  }
}

ConstraintRows bonds_of(const Model& model, const TieContact& contact, Index source, std::vector<std::string>& notes) {
  TieMaker made(model, contact, source);
  const std::map<Index, double> slaves = nodal_measures(model.mesh->coordinates, contact.slave);
  if (contact.method == TieMethod::node_to_surface)
    for (const auto& [node, share] : slaves) made.add(node, share);
  else
    add_means(model, contact, source, slaves, made);
  if (made.far > 0 && (contact.far == FarNodes::refuse || made.rows.size() + made.joined == 0)) {
    throw std::invalid_argument(fmt::format(
        "contact \"{}\": {}; mend the groups (is the finer surface the group, and the master as wide as it is?), raise "
        "`tolerance`, or leave such nodes free with far = \"leave\"",
        contact.name, made.far_ones()));
  }
  notes.push_back(fmt::format("contact \"{}\": {} nodes tied{}", contact.name, made.rows.size(),
                              made.far > 0 ? "; left free: " + made.far_ones() : ""));
  return std::move(made.rows);
}

/// What is one node on both sides never tears.
void refuse_shared_nodes(const Model& model, const TieContact& contact) {
  std::set<Index> master;
  for (const Facet& facet : contact.master.facets) master.insert(facet.begin(), facet.end());
  std::set<Index> shared;
  for (const Facet& facet : contact.slave.facets)
    std::copy_if(facet.begin(), facet.end(), std::inserter(shared, shared.end()),
                 [&](Index n) { return master.contains(n); });
  if (shared.empty()) return;
  throw std::invalid_argument(fmt::format(
      "contact \"{}\": {} nodes that both surfaces have, such as node {}, which would hold when the tie has "
      "torn; give each body nodes of its own there",
      contact.name, shared.size(), model.mesh->node_label(*shared.begin())));
}

}  // namespace

std::vector<Index> nodes_near_master(std::span<const Vec3> X, const TieContact& contact) {
  const Master master(X, contact);
  std::set<Index> near;
  for (const Facet& facet : contact.slave.facets)
    for (const Index n : facet)
      if (!near.contains(n) && master.near(X[static_cast<std::size_t>(n)])) near.insert(n);
  return {near.begin(), near.end()};
}

std::unique_ptr<RowMaker> tie_rows(const Model& model, const TieContact& contact, Index source,
                                   std::vector<std::string>& notes) {
  return std::make_unique<FixedRows>(bonds_of(model, contact, source, notes));
}

std::vector<CohesiveRow> cohesive_rows(const Model& model, const TieContact& contact, std::vector<std::string>& notes) {
  refuse_shared_nodes(model, contact);
  const ConstraintRows rows = bonds_of(model, contact, 0, notes);
  std::vector<CohesiveRow> places;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    CohesiveRow& place = places.emplace_back();
    const auto begin = static_cast<std::size_t>(rows.begin[r]), end = static_cast<std::size_t>(rows.begin[r + 1]);
    for (std::size_t k = begin; k < end; ++k) {
      const bool is_master = k >= end - static_cast<std::size_t>(rows.behind[r]);
      (is_master ? place.master : place.slave).emplace_back(rows.node[k], dot(rows.block[k][0], rows.normal[r]));
    }
    place.area = rows.measure[r];
    place.facet = contact.master.facets[static_cast<std::size_t>(rows.facet[r])];
    place.normal = rows.normal[r];
  }
  return places;
}

ContactKind tie_contact_row() {
  return {.name = "tie",
          .rows =
              [](const Model& model, const ContactDefinition& contact, Index source, std::vector<std::string>& notes) {
                return tie_rows(model, std::get<TieContact>(contact), source, notes);
              },
          .stiffness =
              [](const PartCells& cells, const ContactDefinition& definition) {
                const auto& tie = std::get<TieContact>(definition);
                return StiffnessChoice{
                    {side_of(cells, tie.slave.facets, tie.name), side_of(cells, tie.master.facets, tie.name)}};
              },
          .shared = [](const ContactDefinition& a,
                       const ContactDefinition& b) { return shared_facets(parts_of(a), parts_of(b)); }};
}

}  // namespace carom
