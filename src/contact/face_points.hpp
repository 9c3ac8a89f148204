// Points of the overlaps of one facet with the facets that face it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact/row_maker.hpp"
#include "surface/broad_phase.hpp"
#include "surface/clipping.hpp"
#include "surface/parent_faces.hpp"

namespace carom {

/// Product of the normals of facets that go on with each other.
inline constexpr double going_on = 0.5;
/// Of the facet size: deeper, a facet or a point has to come in from the front.
inline constexpr double sideways_depth = 0.02;

/// One point of a slave facet: its gap, and what the gap's gradient is made of, see face_rows.hpp. The gradient is
///   - along N_b(x_s): -along,   along N_c(x_m): along,
/// and with the turning of the facets' normals
///   slave corner b: n_s (turn_b . of_turn),   master corner c: n_m (turn_c . of_master_turn).
/// Tangentially the point where both sides touch each other moves with the slave by N_slide_b and - rise turn_b n_s,
/// and with the master by N_c and - master_rise turn_c n_m.
struct FacePoint {
  double weight = 0.0;            ///< reference measure
  double bulge = 0.0;             ///< how far the surfaces stand out of their facets there
  double gap = 0.0;               ///< of overlaps s g
  double rise = 0.0;              ///< of overlaps g, from x_s along n_s to x_m
  double master_rise = 0.0;       ///< of overlaps 0
  std::size_t master = 0;         ///< number in FacetPoints::masters
  std::array<double, 4> share{};  ///< N^ of the slave facet's corners
  std::array<double, 9> N{}, N_master{}, N_slide{};
  Vec3 along{}, of_turn{}, of_master_turn{};
  Vec3 position{};  ///< x_s
};

/// The points of one slave facet. Points of `border` stand where an overlap ends under it at a border of the other
/// surface: their gradient is that of the way of the border outward over the slave, their weight the reference measure
/// that a unit of that way gains.
struct FacetPoints {
  /// A facet of the other surface that some of the points lie on.
  struct Master {
    Index facet;
    Vec3 normal;               ///< n_m
    std::array<Vec3, 4> turn;  ///< turn_c
  };
  Vec3 normal{};               ///< n_s
  std::array<Vec3, 4> turn{};  ///< dn_s = - sum_b turn_b (n_s . du_b)
  double least_gap = 0.0;      ///< of all of them
  std::vector<Master> masters;
  std::vector<FacePoint> points, border;
};

/// Finds the points of a slave surface at which faces integrate.
class FacePointFinder {
 public:
  virtual ~FacePointFinder() = default;
  /// Brings the candidates up to date; behind: by slave facet, the facets that its corners were behind at x_begin, -1
  /// for none.
  virtual void update(const ContactMotion& motion, std::vector<std::array<Index, 4>> behind) = 0;
  /// The points of slave facet f at motion.x. May be called from many threads.
  virtual void find(std::size_t f, const ContactMotion& motion, FacetPoints& found) const = 0;

  virtual double size() const = 0;  ///< the larger mean facet size
  virtual const ParentFace& slave_face(std::size_t f) const = 0;
  virtual const ParentFace& master_face(Index g) const = 0;
  virtual std::span<const Facet> masters() const = 0;
  const Facet& master_facet(Index g) const { return masters()[static_cast<std::size_t>(g)]; }
};

/// The use that is made of the points of overlaps.
enum class OverlapUse {
  springs,  ///< the energy of what is behind: points there alone, and those of borders
  means,    ///< mean gaps: points everywhere, of facets that face each other within 60 degrees; s = 1
};

/// Two surfaces whose facets are laid over each other.
class FaceOverlaps : public FacePointFinder {
 public:
  /// `self`: see PairContact; thin parts are then looked into half as deep as they are thick.
  FaceOverlaps(const Model& model, const Surface& slave, const Surface& master, bool self, OverlapUse use);

  void update(const ContactMotion& motion, std::vector<std::array<Index, 4>> behind) override;
  void find(std::size_t f, const ContactMotion& motion, FacetPoints& found) const override;

  double size() const override { return size_; }
  const ParentFace& slave_face(std::size_t f) const override { return slave_faces_[f]; }
  const ParentFace& master_face(Index g) const override { return master_faces_[static_cast<std::size_t>(g)]; }
  std::span<const Facet> masters() const override { return broad_phase_.targets(); }

 private:
  struct Slave;
  struct Met;
  /// A master facet at motion.x: its middle, its normal there, a ball about the middle that holds it, and how far its
  /// face is from it.
  struct Look {
    Vec3 centre{}, normal{};
    double radius = 0.0, bulge = 0.0;
  };
  struct Work;
  void add_master(const Slave& slave, Index g, const ContactMotion& motion, Work& work) const;
  bool was_behind(const Slave& slave, Index g) const;
  bool stands_beyond(const Slave& slave, const ContactMotion& motion, const ParentPoint& at, double gap) const;
  bool goes_on(Index g, const Work& work) const;
  double most_steep(Index g, double facing) const;
  double nearer_by(const Slave& slave, Index g, double facing) const;
  void add_borders(const Slave& slave, const Work& work, std::size_t k, const ContactMotion& motion,
                   FacetPoints& found) const;
  double width_at(const Slave& slave, const ParentPoint& at) const;
  bool ends_at(Index master, std::size_t edge) const;
  void add_point(const Slave& slave, const PlacedFacet& placed_master, double facing, const OverlapPoint& at,
                 const ContactMotion& motion, FacetPoints& found) const;

  std::span<const Vec3> X_;
  Surface slave_;
  double size_;
  OverlapUse use_;
  std::vector<double> depth_;  ///< by master facet: how far behind it overlaps count
  std::vector<ParentFace> slave_faces_, master_faces_;
  std::vector<std::array<Index, 4>> beside_;  ///< by master facet and edge (segment: end): the facet there, -1: none
  BroadPhase broad_phase_;
  std::vector<std::array<Index, 4>> behind_;
  std::vector<Look> looks_;  ///< of the master facets
};

}  // namespace carom
