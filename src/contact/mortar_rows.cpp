#include "contact/mortar_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "contact/box_tree.hpp"
#include "contact/broad_phase.hpp"
#include "contact/clipping.hpp"
#include "contact/facet_projection.hpp"
#include "contact/half_thickness.hpp"
#include "contact/overlap_column.hpp"
#include "contact/pair_rows.hpp"
#include "contact/surface_search.hpp"
#include "math/vec3.hpp"
#include "model/bodies.hpp"

namespace carom {
namespace {

constexpr double least_coverage = 1e-6;  // of a node's measure
constexpr double look = 1.5;             // of the facet size: overlaps within count

constexpr double least_facing = -0.5;  // n_s . n_m below: at most 60 degrees from facing each other

using NodePairs = std::array<std::array<double, 4>, 4>;
using NodePairVectors = std::array<std::array<Vec3, 4>, 4>;

/// Integrals over the overlaps of one slave facet: entries [A][b] with the slave's node A. m: see mortar_rows.hpp.
struct FacetSums {
  struct Master {
    Index facet;
    NodePairs NN{};         ///< w N_A N_c
    NodePairVectors mNN{};  ///< w N_A N_c m
  };
  Vec3 normal{};
  std::array<Vec3, 4> turn{};  ///< a^alpha N_b,alpha at the centre
  double least_gap = std::numeric_limits<double>::infinity();
  std::array<double, 4> D{}, gap{};  ///< w N_A, w N_A g
  std::array<Vec3, 4> m{}, m_gap{};  ///< w N_A m, w N_A g m
  NodePairs NN{};                    ///< w N_A N_b
  NodePairVectors mNN{};             ///< w N_A N_b m
  std::vector<Master> masters;

  /// Adds a point of weight w to these sums and to those with its master.
  void add_point(double w, double point_gap, const Vec3& m_point, const std::array<double, 4>& N,
                 const std::array<double, 4>& N_master, Master& master);
  void clear() {
    std::vector<Master> kept = std::move(masters);
    kept.clear();
    *this = {};
    masters = std::move(kept);
  }
};

void FacetSums::add_point(double w, double point_gap, const Vec3& m_point, const std::array<double, 4>& N,
                          const std::array<double, 4>& N_master, Master& master) {
  least_gap = std::min(least_gap, point_gap);
  for (std::size_t A = 0; A < 4; ++A) {
    const double wN = w * N[A];
    D[A] += wN;
    gap[A] += wN * point_gap;
    m[A] = add(m[A], scaled(m_point, wN));
    m_gap[A] = add(m_gap[A], scaled(m_point, wN * point_gap));
    for (std::size_t b = 0; b < 4; ++b) {
      NN[A][b] += wN * N[b];
      mNN[A][b] = add(mNN[A][b], scaled(m_point, wN * N[b]));
      master.NN[A][b] += wN * N_master[b];
      master.mNN[A][b] = add(master.mNN[A][b], scaled(m_point, wN * N_master[b]));
    }
  }
}

class MortarRows : public RowMaker {
 public:
  MortarRows(const Model& model, const PairContact& contact, const ContactLaw& law, Index source);
  std::size_t slots() const override { return nodes_.size(); }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override;

 private:
  /// A slave node, its share of the surface, and its facets with its number there.
  struct Node {
    Index node;
    double measure;
    std::vector<std::pair<std::size_t, std::size_t>> facets;
  };

  void integrate(std::size_t f, const ContactMotion& motion, FacetSums& sums) const;
  bool add_points(std::size_t f, Index g, const OverlapColumn& slave, const ContactMotion& motion,
                  std::vector<OverlapPoint>& points) const;
  void add_row(const Node& node, Index slot, const ContactMotion& motion, ConstraintRows& rows) const;

  std::span<const Vec3> X_;
  Surface slave_;
  ContactLaw law_;
  Index source_;
  double size_;  ///< the larger mean facet size
  std::vector<double> depth_;
  std::vector<Node> nodes_;
  mutable BroadPhase broad_phase_;
  mutable RowParts parts_;
  mutable std::vector<FacetSums> sums_;
  /// By slave facet: all its nodes were behind the master at x_begin. One is not enough: the facets beside a rim would
  /// see the far side of the body that the rim touches.
  mutable std::vector<bool> was_behind_;
};

MortarRows::MortarRows(const Model& model, const PairContact& contact, const ContactLaw& law, Index source)
    : X_(model.mesh->coordinates),
      slave_(contact.slave),
      law_(law),
      source_(source),
      size_(std::max(mean_facet_size(X_, contact.slave.facets), mean_facet_size(X_, contact.master.facets))),
      depth_(contact.self ? half_thickness(X_, contact.master.facets, bodies_of_nodes(model), size_)
                          : std::vector<double>(contact.master.facets.size(), size_)),
      broad_phase_(contact.slave.facets, contact.master.facets, look * size_,
                   0.5 * mean_facet_size(X_, contact.master.facets)),
      sums_(contact.slave.facets.size()) {
  std::map<Index, std::size_t> number;
  for (const auto& [n, measure] : nodal_measures(X_, slave_)) {
    number[n] = nodes_.size();
    nodes_.push_back({n, measure, {}});
  }
  for (std::size_t f = 0; f < slave_.facets.size(); ++f)
    for (std::size_t a = 0; a < static_cast<std::size_t>(slave_.facets[f].size); ++a)
      nodes_[number.at(slave_.facets[f][a])].facets.emplace_back(f, a);
}

void MortarRows::append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const {
  broad_phase_.update(motion.x_begin, motion.displacement);
  was_behind_.assign(sums_.size(), true);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (motion.behind(first_slot + static_cast<Index>(i)) < 0)
      for (const auto& [f, a] : nodes_[i].facets) was_behind_[f] = false;
  constexpr std::size_t grain = 16;  // facets per task: some hundred microseconds of work
  parallel_for(sums_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) integrate(f, motion, sums_[f]);
  });
  parts_.append(nodes_.size(), rows, [&](std::size_t begin, std::size_t end, ConstraintRows& made) {
    for (std::size_t i = begin; i < end; ++i) add_row(nodes_[i], first_slot + static_cast<Index>(i), motion, made);
  });
}

/// Appends the points of the overlap with master g, if it counts.
bool MortarRows::add_points(std::size_t f, Index g, const OverlapColumn& slave, const ContactMotion& motion,
                            std::vector<OverlapPoint>& points) const {
  const PlacedFacet master = place(broad_phase_.targets()[g], motion.x), seen = slave.seen(master);
  if (!slave.may_overlap(seen, look * size_)) return false;
  const ParentPoint centre = facet_centre(master.size);
  if (dot(facet_frame(master, centre.xi, centre.eta).normal, slave.normal()) >= least_facing) return false;
  const std::size_t before = points.size();
  add_overlap(slave, seen, {}, points);
  if (points.size() == before) return false;
  const auto nearest = std::min_element(points.begin() + static_cast<std::ptrdiff_t>(before), points.end(),
                                        [](const OverlapPoint& a, const OverlapPoint& b) { return a.gap < b.gap; });
  const bool is_deep = nearest->gap < -depth_[g];
  const auto was_in_front = [&] {
    return is_in_front(place(slave_.facets[f], motion.x_begin), place(broad_phase_.targets()[g], motion.x_begin),
                       *nearest, size_);
  };
  if (nearest->gap <= look * size_ && (!is_deep || was_behind_[f] || was_in_front())) return true;
  points.resize(before);
  return false;
}

void MortarRows::integrate(std::size_t f, const ContactMotion& motion, FacetSums& sums) const {
  sums.clear();
  const std::span<const Index> candidates = broad_phase_.targets_of(f);
  if (candidates.empty()) return;
  const OverlapColumn slave(place(slave_.facets[f], motion.x));
  std::vector<OverlapPoint> points;
  std::vector<ColumnMaster> overlaps;
  for (const Index g : candidates) {
    const std::size_t begin = points.size();
    if (add_points(f, g, slave, motion, points))
      overlaps.push_back({g, place(broad_phase_.targets()[g], motion.x), {}, begin, points.size()});
  }
  if (points.empty()) return;
  double covered = 0.0;
  for (const OverlapPoint& point : points) covered += point.weight;
  const double area = slave.measure();
  if (covered > area * (1.0 + 1e-6)) hide_layers(slave, overlaps, points);
  const PlacedFacet reference = place(slave_.facets[f], X_);
  const double stretch = measure(reference) / area, width = reference.size == 2 ? slave_.thickness : 1.0;
  const bool is_ring = slave_.section == Section::axisymmetric;
  sums.normal = slave.normal();
  sums.turn = turn_of_normal(slave.placed(), slave.frame());
  for (const ColumnMaster& overlap : overlaps) {
    sums.masters.push_back({overlap.facet});
    for (std::size_t q = overlap.begin; q < overlap.end; ++q) {
      const auto& [at, on_master, weight, gap] = points[q];
      const Vec3 n = facet_frame(overlap.placed, on_master.xi, on_master.eta).normal;
      const double facing_cosine = dot(n, slave.normal());
      if (weight == 0.0 || facing_cosine >= least_facing) continue;
      const double around = is_ring ? 2.0 * std::numbers::pi * facet_position(reference, at.xi, at.eta)[0] : width;
      sums.add_point(weight * stretch * around, gap, scaled(n, 1.0 / facing_cosine),
                     facet_shape(reference.size, at.xi, at.eta).N,
                     facet_shape(overlap.placed.size, on_master.xi, on_master.eta).N, sums.masters.back());
    }
  }
}

void MortarRows::add_row(const Node& node, Index slot, const ContactMotion& motion, ConstraintRows& rows) const {
  double D = 0.0, gap = 0.0, least_gap = std::numeric_limits<double>::infinity();
  Vec3 direction{};
  for (const auto& [f, A] : node.facets) {
    const FacetSums& sums = sums_[f];
    if (sums.D[A] == 0.0) continue;
    D += sums.D[A];
    gap += sums.gap[A];
    direction = subtract(direction, sums.m[A]);
    least_gap = std::min(least_gap, sums.least_gap);
  }
  const double length = norm(direction);
  if (!(D > least_coverage * node.measure) || least_gap > size_ || !(length > 0.0)) return;
  rows.add_row(gap / D, scaled(direction, 1.0 / length), motion.x[node.node], D, row_law(law_, D), source_);
  const Vec3 t_1 = rows.tangent_1.back(), t_2 = rows.tangent_2.back();
  RowBlocks own, others;
  own.add(node.node, {}, {}, {});  // first of all
  for (const auto& [f, A] : node.facets) {
    const FacetSums& sums = sums_[f];
    const Facet& facet = slave_.facets[f];
    for (std::size_t b = 0; b < static_cast<std::size_t>(facet.size); ++b) {
      const double w = sums.NN[A][b] / D;
      const auto turned = [&](const Vec3& force) { return scaled(sums.normal, dot(force, sums.turn[b]) / D); };
      own.add(facet[b], subtract(turned(sums.m_gap[A]), scaled(sums.mNN[A][b], 1.0 / D)),
              subtract(scaled(t_1, w), turned(scaled(t_1, sums.gap[A]))),
              subtract(scaled(t_2, w), turned(scaled(t_2, sums.gap[A]))));
    }
    for (const FacetSums::Master& master : sums.masters) {
      const Facet& other = broad_phase_.targets()[master.facet];
      for (std::size_t c = 0; c < static_cast<std::size_t>(other.size); ++c) {
        const double w = master.NN[A][c] / D;
        if (w != 0.0) others.add(other[c], scaled(master.mNN[A][c], 1.0 / D), scaled(t_1, -w), scaled(t_2, -w));
      }
    }
  }
  own.append_to(rows);
  others.append_to(rows);
  rows.behind.back() = static_cast<Index>(others.size());
  finish_row(rows, motion.u, slot);
}

}  // namespace

std::unique_ptr<RowMaker> mortar_rows(const Model& model, const PairContact& contact, const ContactLaw& law,
                                      Index source) {
  return std::make_unique<MortarRows>(model, contact, law, source);
}

}  // namespace carom
