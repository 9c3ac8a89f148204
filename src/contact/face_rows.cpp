#include "contact/face_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "contact/face_points.hpp"
#include "math/vec3.hpp"

namespace carom {
namespace {

constexpr double round_off = 1e-12;   // of the facet size: faces that lie on each other are seen whole
constexpr double least_share = 1e-9;  // of a node's measure: less is round-off of an edge
// A mean over less of a node's measure that is deeper, of the facet size, is the depth beside a border of a sliver that
// comes in from the side: what is deep there the guards see.
constexpr double sliver = 0.02, deep_sliver = 0.01;

/// Points of one slave facet as one of its corners sees them.
struct CornerOf {
  std::size_t facet, corner;
};

class FaceRows : public RowMaker {
 public:
  FaceRows(std::span<const Vec3> X, const Surface& slave, std::unique_ptr<FacePointFinder> finder,
           const FaceNodes& has_row, const ContactLaw& law, OverlapUse use, Index source);
  std::size_t slots() const override { return nodes_.size(); }
  void append_keys(SlotKeys& keys) const override {
    for (const Node& node : nodes_) keys.add({&node.node, 1});
    keys.meet(node_keys(finder_->masters()));
  }
  bool is_fixed() const override { return false; }
  void append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const override;
  void append_stiffness(ConstraintRows& rows) const override;

 private:
  struct Node {
    Index node;
    double measure;
    std::vector<CornerOf> corners;
  };
  /// What the points about a node amount to.
  struct Sums {
    double area = 0.0, gap = 0.0, force = 0.0, energy = 0.0;  ///< sum of w N^ times 1, s g, f(<S - s g>), e(<S - s g>)
    double depth = 0.0;                                       ///< d_A; 0: open
    double of_facets = 0.0;  ///< the energy if the surfaces did not bulge out of the facets
    double least_gap = INFINITY;
    Index master = -1;  ///< facet of the deepest point

    bool is_closed() const { return depth > 0.0; }
  };

  class Blocks;

  Sums sums_of(const Node& node) const;
  template <class Use>
  void for_each_weight(const Node& node, const Sums& sums, const Use& use) const;
  void add_row(const Node& node, Index slot, const ContactMotion& motion, ConstraintRows& rows) const;
  void add_stiffness(const Node& node, ConstraintRows& rows) const;
  void add_blocks(const Node& node, const Sums& sums, ConstraintRows& rows) const;

  Surface slave_;
  ContactLaw law_;
  bool is_mean_;
  RowLaw unit_;  ///< the spring e(d), f(d) of a unit of area, over eps_N
  Index source_;
  std::vector<Node> nodes_;
  std::unique_ptr<FacePointFinder> finder_;
  mutable RowParts parts_;
  mutable std::vector<FacetPoints> points_;  ///< by slave facet
};

/// Blocks of a row in the making: the sum of those of its points. Points that follow each other on one facet under one
/// master are summed first, since the nodes and normals of all of them are the same.
class FaceRows::Blocks {
 public:
  Blocks(const FaceRows& rows, const Vec3& tangent_1, const Vec3& tangent_2)
      : rows_(rows), tangent_1_(tangent_1), tangent_2_(tangent_2) {}

  /// The block of this node stands first.
  void begin_with(Index node) { own_.add(node, {}, {}, {}); }
  /// w times the gradient of the point's gap, and `mean` times its tangential motion.
  void add(std::size_t facet, const FacePoint& q, double w, double mean);
  /// What the turning of both normals adds to that.
  void add_turning(const FacePoint& q, double w, double mean);
  /// Gives them to the last row, and returns how many are those of the other surface.
  Index append_to(ConstraintRows& rows);

 private:
  /// Sums over points: of what moves a node (along the normal, and the weight of its way along the tangents), and of
  /// what turns a facet.
  struct Moved {
    std::array<Vec3, 9> normal{};
    std::array<double, 9> slide{};
    Vec3 of_turn{};
    double rise = 0.0;

    void add(const Vec3& along, double mean, std::span<const double> N, std::span<const double> N_slide);
  };

  void close();
  void give(const ParentFace& face, const Facet& corners, const Vec3& normal, const std::array<Vec3, 4>& turn,
            const Moved& moved, RowBlocks& blocks) const;

  const FaceRows& rows_;
  Vec3 tangent_1_, tangent_2_;
  std::size_t facet_ = 0, master_ = 0;
  bool is_open_ = false;  ///< some points are summed that no block has yet
  Moved slave_, other_;
  RowBlocks own_, others_;
};

void FaceRows::Blocks::Moved::add(const Vec3& along, double mean, std::span<const double> N,
                                  std::span<const double> N_slide) {
  for (std::size_t b = 0; b < N.size(); ++b) {
    normal[b] = carom::add(normal[b], scaled(along, N[b]));
    slide[b] += mean * N_slide[b];
  }
}

void FaceRows::Blocks::add(std::size_t facet, const FacePoint& q, double w, double mean) {
  if (is_open_ && (facet != facet_ || q.master != master_)) close();
  is_open_ = true;
  facet_ = facet;
  master_ = q.master;
  const auto size = static_cast<std::size_t>(rows_.finder_->slave_face(facet).size);
  const Index g = rows_.points_[facet].masters[q.master].facet;
  const auto others = static_cast<std::size_t>(rows_.finder_->master_face(g).size);
  const std::span<const double> N_master(q.N_master.data(), others);
  slave_.add(scaled(q.along, -w), mean, {q.N.data(), size}, {q.N_slide.data(), size});
  other_.add(scaled(q.along, w), -mean, N_master, N_master);
}

void FaceRows::Blocks::add_turning(const FacePoint& q, double w, double mean) {
  slave_.of_turn = carom::add(slave_.of_turn, scaled(q.of_turn, w));
  slave_.rise -= mean * q.rise;
  other_.of_turn = carom::add(other_.of_turn, scaled(q.of_master_turn, w));
  other_.rise += mean * q.master_rise;
}

void FaceRows::Blocks::close() {
  const FacetPoints& facet = rows_.points_[facet_];
  const FacetPoints::Master& master = facet.masters[master_];
  const FacePointFinder& finder = *rows_.finder_;
  give(finder.slave_face(facet_), rows_.slave_.facets[facet_], facet.normal, facet.turn, slave_, own_);
  give(finder.master_face(master.facet), finder.master_facet(master.facet), master.normal, master.turn, other_,
       others_);
  slave_ = other_ = {};
  is_open_ = false;
}

void FaceRows::Blocks::give(const ParentFace& face, const Facet& corners, const Vec3& normal,
                            const std::array<Vec3, 4>& turn, const Moved& moved, RowBlocks& blocks) const {
  for (std::size_t b = 0; b < static_cast<std::size_t>(face.size); ++b)
    blocks.add(face.node[b], moved.normal[b], scaled(tangent_1_, moved.slide[b]), scaled(tangent_2_, moved.slide[b]));
  if (moved.of_turn == Vec3{} && moved.rise == 0.0) return;
  for (std::size_t b = 0; b < static_cast<std::size_t>(corners.size); ++b) {
    const auto turned = [&](const Vec3& v) { return scaled(normal, dot(v, turn[b])); };
    blocks.add(corners[b], turned(moved.of_turn), turned(scaled(tangent_1_, moved.rise)),
               turned(scaled(tangent_2_, moved.rise)));
  }
}

Index FaceRows::Blocks::append_to(ConstraintRows& rows) {
  if (is_open_) close();
  own_.append_to(rows);
  others_.append_to(rows);
  return static_cast<Index>(others_.size());
}

FaceRows::FaceRows(std::span<const Vec3> X, const Surface& slave, std::unique_ptr<FacePointFinder> finder,
                   const FaceNodes& has_row, const ContactLaw& law, OverlapUse use, Index source)
    : slave_(slave),
      law_(law),
      is_mean_(use == OverlapUse::means),
      unit_{.eps_N = 1.0, .linear_depth = law.linear_depth},
      source_(source),
      finder_(std::move(finder)),
      points_(slave.facets.size()) {
  std::map<Index, std::size_t> number;
  for (const auto& [n, measure] : nodal_measures(X, slave_)) {
    if (has_row && !has_row(n)) continue;
    number[n] = nodes_.size();
    nodes_.push_back({n, measure, {}});
  }
  for (std::size_t f = 0; f < slave_.facets.size(); ++f)
    for (std::size_t a = 0; a < static_cast<std::size_t>(slave_.facets[f].size); ++a)
      if (const auto at = number.find(slave_.facets[f][a]); at != number.end())
        nodes_[at->second].corners.push_back({f, a});
}

void FaceRows::append(const ContactMotion& motion, Index first_slot, ConstraintRows& rows) const {
  std::vector<std::array<Index, 4>> behind(points_.size(), {-1, -1, -1, -1});
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (const CornerOf& at : nodes_[i].corners)
      behind[at.facet][at.corner] = motion.behind(first_slot + static_cast<Index>(i));
  finder_->update(motion, std::move(behind));
  constexpr std::size_t grain = 16;  // facets per task: some hundred microseconds of work
  parallel_for(points_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) finder_->find(f, motion, points_[f]);
  });
  parts_.append(nodes_.size(), rows, [&](std::size_t begin, std::size_t end, ConstraintRows& made) {
    for (std::size_t i = begin; i < end; ++i) add_row(nodes_[i], first_slot + static_cast<Index>(i), motion, made);
  });
}

void FaceRows::append_stiffness(ConstraintRows& rows) const {
  parts_.append(nodes_.size(), rows, [&](std::size_t begin, std::size_t end, ConstraintRows& made) {
    for (std::size_t i = begin; i < end; ++i) add_stiffness(nodes_[i], made);
  });
}

/// The depth at which a spring of this law has the energy `energy`: Newton's method from above, where the energy is
/// convex.
double depth_of_energy(const RowLaw& law, double energy) {
  if (!(energy > 0.0)) return 0.0;
  double d = std::sqrt(2.0 * energy / law.eps_N);
  for (int i = 0; i < 60; ++i) {
    const double step = (law.spring_energy(d) - energy) / law.spring_force(d);
    d -= step;
    if (!(step > 1e-15 * d)) break;
  }
  return d;
}

FaceRows::Sums FaceRows::sums_of(const Node& node) const {
  Sums sums;
  for (const CornerOf& at : node.corners) {
    for (const FacePoint& q : points_[at.facet].points) {
      const double w = q.weight * q.share[at.corner], depth = std::max(0.0, -q.gap);
      if (!(w > 0.0)) continue;
      sums.area += w;
      sums.gap += w * q.gap;
      sums.force += w * unit_.spring_force(depth);
      sums.energy += w * unit_.spring_energy(depth);
      sums.of_facets += w * unit_.spring_energy(std::max(0.0, depth - q.bulge));
      if (q.gap >= sums.least_gap) continue;
      sums.least_gap = q.gap;
      sums.master = points_[at.facet].masters[q.master].facet;
    }
  }
  if (!is_mean_ && sums.least_gap < -round_off * finder_->size())
    sums.depth = depth_of_energy(unit_, sums.energy / node.measure);
  return sums;
}

/// Calls use(facet, point, weight of the point's gap in the gradient of the row's).
template <class Use>
void FaceRows::for_each_weight(const Node& node, const Sums& sums, const Use& use) const {
  const double whole = node.measure * unit_.spring_force(sums.depth);
  for (const CornerOf& at : node.corners) {
    const FacetPoints& facet = points_[at.facet];
    for (const FacePoint& q : facet.points) {
      const double w = q.weight * q.share[at.corner];
      if (!(w > 0.0)) continue;
      if (!sums.is_closed()) {
        use(at.facet, facet, q, w / sums.area);
      } else if (const double depth = std::max(0.0, -q.gap); depth > 0.0) {
        use(at.facet, facet, q, w * unit_.spring_force(depth) / whole);
      }
    }
  }
}

void FaceRows::add_row(const Node& node, Index slot, const ContactMotion& motion, ConstraintRows& rows) const {
  const Sums sums = sums_of(node);
  if (!(sums.area > least_share * node.measure) || sums.least_gap > finder_->size()) return;
  if (is_mean_ && sums.area < sliver * node.measure && sums.gap < -deep_sliver * finder_->size() * sums.area) return;
  Vec3 along{}, position{};
  double weight = 0.0;
  for_each_weight(node, sums, [&](std::size_t /*f*/, const FacetPoints& /*facet*/, const FacePoint& q, double w) {
    along = subtract(along, scaled(q.along, w));
    position = add(position, scaled(q.position, w));
    weight += w;
  });
  const double length = norm(along);
  if (!(length > 1e-6 * weight)) return;
  // Where nothing penetrates the row stands for what is covered.
  const double measure = sums.is_closed() ? node.measure : std::min(sums.area, node.measure);
  const double gap = sums.is_closed() ? -sums.depth : is_mean_ ? sums.gap / sums.area : sums.least_gap;
  RowLaw law = row_law(law_, measure);
  if (sums.is_closed())
    law.mu *=
        std::min(std::max(1.0, sums.area / node.measure), sums.force / (node.measure * unit_.spring_force(sums.depth)));
  const Vec3 at = is_mean_ ? motion.x[node.node] : scaled(position, 1.0 / weight);
  rows.add_row(gap, scaled(along, 1.0 / length), at, measure, law, source_);
  rows.facet.back() = sums.master;
  rows.has_entered.back() = is_mean_ && sums.least_gap < 0.0;
  if (sums.is_closed() && sums.of_facets < sums.energy)
    rows.rounded.back() = sums.depth - depth_of_energy(unit_, sums.of_facets / node.measure);
  add_blocks(node, sums, rows);
  finish_row(rows, motion.u, slot);
}

/// The normal blocks are the gradient of the gap, of open rows without what the facets' turning moves across it, which
/// is gone when they close; the tangents see the mean of the points' motions, in which the
/// slave's turning takes the way between x_s and x_m along.
void FaceRows::add_blocks(const Node& node, const Sums& sums, ConstraintRows& rows) const {
  double total = 0.0;
  for_each_weight(node, sums, [&](std::size_t, const FacetPoints&, const FacePoint&, double w) { total += w; });
  Blocks blocks(*this, rows.tangent_1.back(), rows.tangent_2.back());
  blocks.begin_with(node.node);
  const auto add = [&](std::size_t f, const FacePoint& q, double w, double mean) {
    blocks.add(f, q, w, mean);
    if (sums.is_closed() || is_mean_) blocks.add_turning(q, w, mean);
  };
  for_each_weight(node, sums,
                  [&](std::size_t f, const FacetPoints&, const FacePoint& q, double w) { add(f, q, w, w / total); });
  if (sums.is_closed()) {
    const double whole = node.measure * unit_.spring_force(sums.depth);
    for (const CornerOf& at : node.corners)
      for (const FacePoint& q : points_[at.facet].border)
        add(at.facet, q, -q.weight * unit_.spring_energy(-q.gap) * q.share[at.corner] / whole, 0.0);
  }
  rows.behind.back() = blocks.append_to(rows);
}

/// Takes what the functions before have of each one from it, in the product sum_q k_q a_q b_q, and makes its square 1;
/// one of which less than 1e-6 is left becomes empty.
void make_orthonormal(std::span<const double> k, std::span<std::vector<double>> functions) {
  constexpr double least = 1e-6;
  const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t q = 0; q < k.size(); ++q) sum += k[q] * a[q] * b[q];
    return sum;
  };
  for (std::size_t i = 0; i < functions.size(); ++i) {
    std::vector<double>& own = functions[i];
    const double before = product(own, own);
    for (std::size_t j = 0; j < i; ++j) {
      if (functions[j].empty()) continue;
      const double share = product(own, functions[j]);
      for (std::size_t q = 0; q < k.size(); ++q) own[q] -= share * functions[j][q];
    }
    const double square = product(own, own);
    if (square > least * before) {
      for (double& value : own) value /= std::sqrt(square);
    } else {
      own.clear();
    }
  }
}

/// The springs of the points stand against all that moves them, with eps_N sum_q k_q grad g_q grad g_q^T, k = w N^
/// f'(d). The row has the part of phi = f / f' (along its gap's gradient). Here are those of phi = 1, x, y and z,
/// orthonormal in the k: rows sum_q k_q phi_q grad g_q.
void FaceRows::add_stiffness(const Node& node, ConstraintRows& rows) const {
  const Sums sums = sums_of(node);
  if (!sums.is_closed() || !(sums.area > least_share * node.measure)) return;
  std::vector<std::pair<std::size_t, const FacePoint*>> points;  // and their slave facets
  std::vector<double> k;
  std::array<std::vector<double>, 5> phi;
  for (const CornerOf& at : node.corners) {
    for (const FacePoint& q : points_[at.facet].points) {
      const double depth = std::max(0.0, -q.gap), slope = unit_.spring_slope(depth);
      const double weight = q.weight * q.share[at.corner] * slope;
      if (!(depth > 0.0 && weight > 0.0)) continue;
      points.emplace_back(at.facet, &q);
      k.push_back(weight);
      const Vec3 x = subtract(q.position, points.front().second->position);
      const std::array<double, 5> value{unit_.spring_force(depth) / slope, 1.0, x[0], x[1], x[2]};
      for (std::size_t i = 0; i < phi.size(); ++i) phi[i].push_back(value[i]);
    }
  }
  make_orthonormal(k, phi);
  for (std::size_t i = 1; i < phi.size(); ++i) {
    if (phi[i].empty()) continue;
    Blocks blocks(*this, {}, {});
    for (std::size_t q = 0; q < points.size(); ++q) {
      blocks.add(points[q].first, *points[q].second, k[q] * phi[i][q], 0.0);
      blocks.add_turning(*points[q].second, k[q] * phi[i][q], 0.0);
    }
    rows.add_row(0.0, {1.0, 0.0, 0.0}, points.front().second->position, 1.0, row_law(law_, 1.0), source_);
    blocks.append_to(rows);
  }
}

std::unique_ptr<RowMaker> rows_over(const Model& model, const Surface& slave, const Surface& master, bool self,
                                    const ContactLaw& law, OverlapUse use, Index source) {
  return std::make_unique<FaceRows>(model.mesh->coordinates, slave,
                                    std::make_unique<FaceOverlaps>(model, slave, master, self, use), FaceNodes{}, law,
                                    use, source);
}

}  // namespace

std::unique_ptr<RowMaker> face_rows(const Model& model, const Surface& slave, const Surface& master, bool self,
                                    const ContactLaw& law, Index source) {
  return rows_over(model, slave, master, self, law, OverlapUse::springs, source);
}

std::unique_ptr<RowMaker> face_rows(std::span<const Vec3> X, const Surface& slave,
                                    std::unique_ptr<FacePointFinder> finder, const FaceNodes& has_row,
                                    const ContactLaw& law, Index source) {
  return std::make_unique<FaceRows>(X, slave, std::move(finder), has_row, law, OverlapUse::springs, source);
}

std::unique_ptr<RowMaker> mean_rows(const Model& model, const Surface& slave, const Surface& master, bool self,
                                    const ContactLaw& law, Index source) {
  return rows_over(model, slave, master, self, law, OverlapUse::means, source);
}

}  // namespace carom
