// Are the springs of contact stiff enough for the bodies behind them?
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "march/observer.hpp"
#include "model/model.hpp"
#include "output/summary.hpp"
#include "rows/response.hpp"

namespace carom {

/// The deepest penetration of a run against what it may be there: 5 % of the smallest cell at the nodes of the row, or,
/// where the cells at those nodes are shortened by more along the row's normal, half of that length; never more than a
/// quarter of the cell. The shortening is that of the cells' own displacement (solid/cell_strain.hpp), so that a soft
/// spring cannot allow itself any depth. Both are the largest at a place (slot) so far: a spring answers before the
/// cells behind it do. Springs of discrete stops are physical and do not count.
class PenetrationWatch : public Observer {
 public:
  explicit PenetrationWatch(const Model& model);

  void see(const StepView& view) override {
    if (view.step > 0) look(view.forces.rows, view.state.q);
  }
  /// At displacement u, after each step. Rows below 5 % cost nothing but their gap.
  void look(const ContactResponse& response, std::span<const double> u);
  VerdictItem item() const;

 private:
  template <class A>
  friend void fields(A& archive, PenetrationWatch& x) {
    archive("places", x.places_);
  }

  struct Place {
    double depth = 0.0, shortening = 0.0;  ///< largest so far, over the smallest cell there
    double limit() const;
    template <class A>
    friend void fields(A& archive, Place& x) {
      archive("depth", x.depth);
      archive("shortening", x.shortening);
    }
  };
  void find_cells();
  double cell_at(const ConstraintRows& rows, std::size_t r) const;
  double shortening(const ConstraintRows& rows, std::size_t r, std::span<const double> u);

  const Model& model_;
  std::shared_ptr<const std::vector<double>> node_length_;
  double smallest_;                 ///< of them
  std::vector<char> is_spring_;     ///< by contact: a spring of its own, which may be of any depth
  std::vector<std::size_t> begin_;  ///< by node, in cells_; made when first needed
  std::vector<std::pair<const Part*, Index>> cells_;
  std::vector<Place> places_;  ///< by slot
};

}  // namespace carom
