// How deep a contact was pressed whose law of pressure ends at a depth.
#pragma once

#include <vector>

#include "advise/locking.hpp"
#include "march/observer.hpp"

namespace carom {

/// Beyond the last depth of a table of pressures its last slope goes on, which nobody has measured.
class LawDepthWatch : public Observer {
 public:
  void see(const StepView& view) override;
  /// One for each contact that was deeper at the end of a step than its law goes.
  std::vector<Doubt> doubts(const Simulation& simulation) const;

 private:
  template <class A>
  friend void fields(A& archive, LawDepthWatch& x) {
    archive("depths", x.depths_);
  }

  std::vector<double> depths_;  ///< by contact, the largest so far
};

}  // namespace carom
