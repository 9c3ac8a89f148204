// Points of the facets of a smooth surface, and their gaps to another surface.
#pragma once

#include <optional>
#include <vector>

#include "contact/face_points.hpp"
#include "contact/smooth_surface.hpp"

namespace carom {

/// Points of the slave's facets, which are halved in each direction over and over: parts that cannot touch as the gap,
/// its slope and the curvature of both sides have it have one point, parts that are met everywhere a rule of degree 2
/// (triangles: 3 points) or 3 (2 x 2 Gauss points), others one when they have been halved three times; where the
/// normals are nearly opposite, as at the pole of a ball, five times: a pole then is seen to a thirtieth of a cell.
///
/// With x_s the point of the smooth slave there, the gap is that from its foot x_m on the smooth master,
///   g = n . (x_s - x_m),   n the master's normal at the foot:
/// the distance from the surface, whose gradient is n by x_s and -n by x_m, exactly. Of several feet the nearest
/// counts, if it is behind its facet or that faces the slave's, - n_f . n_g > 0.2; feet behind facets that look the
/// same way as the slave's, n_f . n_g > 0.5, are those on the far side of a thin part and left out. So a point that
/// comes in over a rim begins at the side, which is the nearest way out, and no deeper. Of the slave's own body only
/// facets that face it count, and facets that share a node never meet. Feet lie inside of their facets, a hundredth of
/// the facet beyond smooth edges.
///
/// Behind the master they count to the larger facet size, with `self` to half_thickness; to 1.5 sizes where a corner of
/// the slave facet was behind the same facet or one that goes on with it. Sides are not known of a master that ends
/// within its body, nor of the slave's own body: there what is deeper than 0.02 sizes counts if it was in front at
/// x_begin, or behind as said; without a history all counts.
///
/// The points of what the other side has no points of its own for (flat facets) weigh twice.
class SmoothPoints : public FacePointFinder {
 public:
  SmoothPoints(const Model& model, SmoothSides sides);

  void update(const ContactMotion& motion, std::vector<std::array<Index, 4>> behind) override;
  void find(std::size_t f, const ContactMotion& motion, FacetPoints& found) const override;

  double size() const override { return size_; }
  const ParentFace& slave_face(std::size_t f) const override { return slave_faces_[f]; }
  const ParentFace& master_face(Index g) const override { return master_faces_[static_cast<std::size_t>(g)]; }
  std::span<const Facet> masters() const override { return broad_phase_.targets(); }

 private:
  struct Near;
  struct Part;
  struct Work;
  struct Foot;
  /// A master facet at its current position.
  struct Placed {
    SmoothPatch patch;
    Bounds box;
  };
  void place_masters(const ContactMotion& motion);
  void find_near(std::size_t f, const ContactMotion& motion, Work& work) const;
  void visit(const Part& part, Work& work) const;
  bool was_behind(std::size_t f, Index g, const ContactMotion& motion) const;
  bool was_in_front(const ParentPoint& of_slave, const ParentPoint& of_master, const Near& near,
                    const Work& work) const;
  std::optional<Foot> foot_of(const ParentPoint& point, const FacetFrame& at, const Work& work) const;
  bool is_outside(const Vec3& x, double depth, const Work& work) const;
  void add_rule(const Part& part, Work& work) const;
  void add_point(const ParentPoint& p, double measure, const FacetFrame& at, const Foot& foot, Work& work) const;
  double measure_of(const Part& part, const ParentPoint& p, const Work& work) const;
  Index body_of(const Facet& facet) const { return bodies_[static_cast<std::size_t>(facet[0])]; }
  static std::vector<Part> halved(const Part& part, int size);

  std::span<const Vec3> X_;
  SmoothSides sides_;
  double size_;
  std::vector<Index> bodies_;   ///< by node
  std::vector<double> depth_;   ///< by master facet
  std::vector<double> factor_;  ///< by master facet: of the points that meet it
  std::vector<ParentFace> slave_faces_, master_faces_;
  bool is_open_;  ///< the master ends somewhere: what has come in there is not known by its way out
  BroadPhase broad_phase_;
  std::vector<std::array<Index, 4>> behind_;
  std::vector<Index> active_;  ///< masters on the lists
  long active_since_ = -1;     ///< the build of the lists that they belong to
  std::vector<std::optional<Placed>> placed_;
};

/// Share of each facet, 0 to 1, that the points of its own side stand for.
std::vector<double> covered_shares(std::span<const Facet> facets, const SmoothSurface& surface);

}  // namespace carom
