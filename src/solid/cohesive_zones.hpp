// Cohesive zones: what glued surfaces bear until they have torn apart.
#pragma once

#include <span>
#include <vector>

#include "model/cohesive.hpp"
#include "solid/contributor.hpp"

namespace carom {

/// The zones of a model, whose rows bear the traction
///   t = (1 - d) k w
/// on the area A of each, w being what the sides part by and d in [0, 1] the damage, which grows with the separation
///   lambda = |w - <-w_n> n|
/// (pressing apart counts, pressing together does not) by
///   d = max(d before, lambda_f (lambda - lambda_0) / (lambda (lambda_f - lambda_0))),
/// so that |t| falls linearly from the strength at lambda_0 to zero at lambda_f. With the share c = <w_n> / lambda of
/// the normal, s = w_T / lambda of the shear, strengths S_n, S_s and energies per area G_n, G_s,
///   lambda_0 = 1 / (k ((c / S_n)^2 + (s / S_s)^2)^1/2)    (quadratic criterion of stress),
///   lambda_f = 2 G / (k lambda_0),  1 / G = c^2 / G_n + s^2 / G_s    (linear criterion of energies)
/// (Camanho and Davila, NASA/TM-2002-211737, eqs. 6 to 21 with the power law's exponent 1). A separation that keeps its
/// direction dissipates G per area, whatever the steps. Unloading goes straight back to zero. The traction lies along
/// w: it has neither resultant nor moment. The normal is that of the master's facet where it stands.
///
/// What is stored, 1/2 (1 - d) k |w|^2 A, feeds `strain`; what has been dissipated,
///   A x integral of 1/2 k |w|^2 dd = A x 1/2 k lambda_0 lambda_f / (lambda_f - lambda_0) x lambda_0 x change of
///   lambda,
/// `fracture`. Two numbers of history per row: d and what has been dissipated per area.
class CohesiveZones : public Contributor {
 public:
  explicit CohesiveZones(std::vector<CohesiveZone> zones, std::span<const Vec3> coordinates);

  bool empty() const override { return rows_.empty(); }
  bool is_linear() const override { return rows_.empty(); }
  /// The nodes of each row.
  std::vector<std::vector<Index>> links() const override { return links_; }
  std::size_t history_size() const override { return 2 * rows_.size(); }
  void place_history(std::size_t first) override { first_ = first; }
  void add_force(std::span<const double> u, const PointStep& step, std::span<double> f, SolidEnergies* energies,
                 std::span<double> end) const override;
  /// Nothing: energy-momentum schemes take no zones.
  void add_discrete_gradient_force(std::span<const double> /*u_0*/, std::span<const double> /*u_1*/,
                                   std::span<double> /*f*/) const override {}
  /// Adds the action of the tangent, the symmetric part of it while damage grows.
  void add_tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                          const PointStep& step) const override;
  void add_tangent(std::span<const double> u, const PointStep& step, CsrMatrix& K) const override;
  void add_tangent_diagonal(std::span<const double> u, const PointStep& step,
                            std::span<double> diagonal) const override;
  /// Largest change of separation from u_0 to u_1, over the separation at which nothing is borne any more.
  double largest_change(std::span<const double> u_0, std::span<const double> u_1) const override;

  /// What all rows have dissipated.
  double dissipated(std::span<const double> history) const;
  /// Calls visit(contact, row, force on the slave side) at u, the history being that of the state.
  template <class Visit>
  void for_each_force(std::span<const double> u, std::span<const double> history, const Visit& visit) const {
    for (std::size_t r = 0; r < rows_.size(); ++r)
      visit(zones_[rows_[r].zone].contact, *rows_[r].row, force_on_slave(r, u, history));
  }
  /// Damage of nodes, the largest of the rows that see them; -1: none does.
  std::vector<double> nodal_damage(std::span<const double> history, std::size_t nodes) const;

 private:
  struct Row {
    const CohesiveRow* row;
    std::size_t zone;
    double side;  ///< 1 or -1: the facet's normal by its nodes' order is with the row's, or against it
  };
  /// A row at a displacement.
  struct Answer {
    Vec3 w{}, opening{};                    ///< what the sides part by, and that without pressing
    double damage = 0.0, dissipated = 0.0;  ///< per area
    double slope = 0.0;                     ///< of the damage in lambda, while it grows; over lambda
  };
  struct Mode {
    double lambda = 0.0, start = 0.0, full = 0.0;  ///< lambda, lambda_0, lambda_f
  };
  const CohesiveLaw& law(std::size_t r) const { return zones_[rows_[r].zone].law; }
  static Vec3 parted(const CohesiveRow& row, std::span<const double> x);
  Vec3 normal(std::size_t r, std::span<const double> u) const;
  Mode mode(std::size_t r, const Vec3& opening, const Vec3& n) const;
  Answer answer(std::size_t r, std::span<const double> u, const PointStep& step) const;
  /// 3 x 3: dt/dw x area.
  std::array<Vec3, 3> tangent_of(std::size_t r, const Answer& a) const;
  Vec3 force_on_slave(std::size_t r, std::span<const double> u, std::span<const double> history) const;
  std::span<const double> own(std::size_t r, std::span<const double> history) const {
    return history.empty() ? std::span<const double>() : history.subspan(first_ + 2 * r, 2);
  }
  template <class Add>
  static void for_each_weight(const CohesiveRow& row, const Add& add) {
    for (const auto& [n, weight] : row.slave) add(n, weight);
    for (const auto& [n, weight] : row.master) add(n, weight);
  }

  std::vector<CohesiveZone> zones_;
  std::span<const Vec3> X_;
  std::vector<Row> rows_;
  std::vector<std::vector<Index>> links_;
  std::size_t first_ = 0;
};

}  // namespace carom
