// The rigid motions of bodies that neither supports nor their own stiffness resist: only contact can hold them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "linalg/dense.hpp"
#include "rows/response.hpp"
#include "system/effective_solver.hpp"
#include "system/system.hpp"

namespace carom {

/// The kernel of K on the free dofs. A body is a set of cells joined by nodes, springs or ties that tear (a free rigid
/// body: its node); its six candidates are the translations and the turns about its centre, each with a largest
/// displacement of 1, and its modes are the combinations that neither K(0) nor a prescribed dof resists (eigenvalue
/// below 1e-9 of the largest).
class FreeModes {
 public:
  /// Costs six actions of K. Allocates.
  explicit FreeModes(const System& system);

  bool empty() const { return size_ == 0; }
  /// Number of modes of all bodies.
  std::size_t size() const { return size_; }
  /// The nodes of each body that has modes.
  std::vector<std::vector<Index>> free_bodies() const;
  /// Displacement of a node in mode k, about the configuration x = X + u (dof vector; small strain: X).
  Vec3 displacement(std::size_t k, Index node, std::span<const double> u) const;
  /// Springs on as many dofs as there are modes, so chosen that they hold every mode. Each has `share` of the smallest
  /// stiffness that a node of its body has on the diagonal of K.
  std::vector<DofSpring> pins(double share = 1.0) const;

  /// m of the inertia m M that makes up for what stresses take away from the free motions: a body that is compressed
  /// between contacts resists its turning by less than nothing (u . K_sigma u = - p V per square of the angle under a
  /// pressure p on two faces), although the contacts hold it. 1.25 times the least eigenvalue of R^T K(u) R by R^T M R,
  /// M lumped, where it is negative; 0 for linear bodies. Six actions of K.
  double inertia_for_turns(std::span<const double> u, const PointStep& step) const;

  /// The part of a force that no tangent of the rows resists, as coefficients rho of the modes, with (T + e) alpha =
  /// R^T f, rho = e alpha, T = R^T G^T D G R and e 1e-12 of the stiffness of pins(), or 1e-14 of the largest of T.
  /// Coefficients below 1e-8 of what the parts of the force in `magnitude` could do, whatever their direction, are
  /// zero: rounding.
  std::vector<double> unheld(const ConstraintRows& rows, const std::vector<RowTangent>& D, std::span<const double> u,
                             std::span<const double> force, std::span<const double> magnitude) const;
  /// The part of the springs of pins() that rows with these tangents make needless, as a matrix N over the pins: the
  /// stiffness of a pin times the projector on the pins' displacements in motions that the symmetric part of T resists
  /// by more than 1e-4 of that stiffness. Motions that are resisted by less are left to the pins, since the turning of
  /// normals, which tangents of rows leave out, may take that much away again. Empty when nothing is held.
  std::vector<double> needless(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                               std::span<const double> u) const;
  /// Takes from a force what loads the weak motions, which rows with these tangents resist too little for their pins to
  /// be needless, spread over the nodes of each body as its rigid motions are. Returns what it has taken, as
  /// coefficients of the modes.
  std::vector<double> relieve(const ConstraintRows& rows, const std::vector<RowTangent>& D, std::span<const double> u,
                              std::span<double> force) const;
  /// False where loads of weak motions are below 1e-9 of what the parts of the force in `magnitude` could do: nothing
  /// stands against so little, so that no displacement would balance it.
  bool are_loads(std::span<const double> weak, std::span<const double> u, std::span<const double> magnitude) const;
  /// Makes the weak motions of a displacement those that springs as stiff as the pins would allow under these loads of
  /// the modes: a body that is pressed then stays where it is in the mean, and not at the nodes of its pins.
  void move_weakly(const ConstraintRows& rows, const std::vector<RowTangent>& D, std::span<const double> u,
                   std::span<const double> weak, std::span<double> dy) const;
  /// Relative displacement of row r in its frame in the motion sum over k of coefficient_k x mode k.
  Vec3 relative(const ConstraintRows& rows, std::size_t r, std::span<const double> coefficient,
                std::span<const double> u) const;
  /// Names the body that the largest coefficient of a load belongs to, and its direction there.
  std::string describe(std::span<const double> load) const;

 private:
  /// Translations and turns: coefficients of the six candidates.
  using Candidate = std::array<double, 6>;
  struct Body {
    std::vector<Index> nodes;
    Vec3 centre{};
    double radius = 1.0, stiffness = 0.0;
    std::vector<Candidate> modes;
    std::size_t first = 0;  ///< number of its first mode
    std::vector<std::size_t> pins;
  };

  void find_bodies();
  void find_modes();
  void choose_pins(Body& body) const;
  Vec3 candidate(const Body& body, std::size_t j, const Vec3& x) const;
  /// R^T f.
  std::vector<double> on_modes(std::span<const double> u, std::span<const double> field) const;
  /// The largest load of one mode that the parts of a force could make, whatever their directions.
  double largest_load(std::span<const double> u, std::span<const double> magnitude) const;
  /// Eigenvalues and vectors of the symmetric part of T, each mode scaled by the root of the stiffness of its pin.
  SymmetricEigen resistance(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                            std::span<const double> u) const;
  /// S^a V V^T S^-a of coefficients, V the weak eigenvectors of resistance(), S the stiffnesses of the pins.
  std::vector<double> weak_part(const ConstraintRows& rows, const std::vector<RowTangent>& D, std::span<const double> u,
                                std::span<const double> c, double a) const;
  /// Coefficients (R^T R)^-1 c of each body, R its modes at its nodes.
  std::vector<double> per_square(std::span<const double> u, std::span<const double> c) const;
  /// field -= R c.
  void take_motion(std::span<const double> u, std::span<const double> c, std::span<double> field) const;
  double pin_stiffness(std::size_t mode) const { return bodies_[body_of_mode_[mode]].stiffness; }
  std::vector<double> stiffness_of_rows(const ConstraintRows& rows, const std::vector<RowTangent>& D,
                                        std::span<const double> u) const;
  Vec3 combine(const Body& body, const Candidate& c, Index node, std::span<const double> u) const;

  const System& system_;
  std::vector<Body> bodies_;
  std::vector<int> body_of_;  ///< of each node, -1: none
  std::vector<std::size_t> body_of_mode_;
  std::size_t size_ = 0;
};

}  // namespace carom
