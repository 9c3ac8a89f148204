// Cells that fold while their points see nothing of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "march/folded_cells.hpp"
#include "march/observer.hpp"
#include "output/summary.hpp"

namespace carom {

/// Looks for a cell with a corner whose volume is not positive, of any formulation and law: every step of an implicit
/// stage; explicit ones every 200 steps, or as soon as the flattest corner might fold at twice the rate at which it has
/// been flattened. Once it has found one it looks at cells of small strain alone, until one of them has folded.
class FoldWatch : public Observer {
 public:
  explicit FoldWatch(const Simulation& simulation);

  void see(const StepView& view) override;
  /// One, once a cell has folded.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The most of its volume that a corner of a cell of small strain has lost; none where there are no such cells. What
  /// has lost half of it has strains of that order, which is as far off as small strain is then.
  std::optional<VerdictItem> item() const;

 private:
  template <class A>
  friend void fields(A& archive, FoldWatch& x) {
    archive("share", x.share_);
    archive("rate", x.rate_);
    archive("looked", x.looked_);
    archive("next", x.next_);
    archive("lost", x.lost_);
    archive("warnings", x.warnings_);
  }

  const Simulation& simulation_;
  double share_ = 1.0, rate_ = 0.0;  ///< of the flattest corner at the last look; what it lost per step before it
  bool has_small_strain_ = false;
  double lost_ = 0.0;
  long long looked_ = 0, next_ = 1;  ///< steps
  std::vector<std::string> warnings_;
};

}  // namespace carom
