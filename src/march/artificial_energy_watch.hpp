// Energy that goes into what keeps cells in shape, not into what the material does.
#pragma once

#include <string>
#include <vector>

#include "build/simulation.hpp"
#include "march/observer.hpp"

namespace carom {

/// Watches the hourglass modes of `one_point` cells and artificial viscosity. A part answers too softly, or folds along
/// its cells, where what its hourglass modes have stored and lost is more than a tenth of its internal energy (strain
/// and plastic), the largest of the run each: the bound that is customary among users of explicit programs. `hourglass`
/// of stabilised cells is the bending that they stand for, and is not judged.
class ArtificialEnergyWatch : public Observer {
 public:
  explicit ArtificialEnergyWatch(const Simulation& simulation);

  void see(const StepView& view) override;
  /// One for each part of one-point cells beyond a tenth, one for all of them, one for viscosity beyond a tenth of the
  /// larger of initial and supplied energy.
  std::vector<std::string> warnings() const;

 private:
  /// Largest of the run.
  struct Peaks {
    double hourglass = 0.0, internal = 0.0;
    void see(const EnergyTerms& terms);

    template <class A>
    friend void fields(A& archive, Peaks& x) {
      archive("hourglass", x.hourglass);
      archive("internal", x.internal);
    }
  };
  template <class A>
  friend void fields(A& archive, ArtificialEnergyWatch& x) {
    archive("parts", x.parts_);
    archive("all", x.all_);
    archive("viscous", x.viscous_);
    archive("scale", x.scale_);
  }

  std::vector<std::string> names_;    ///< of the parts of the case that have one-point cells
  std::vector<std::size_t> numbers_;  ///< of them, in Forces::of_parts
  std::vector<Peaks> parts_;
  Peaks all_;
  double viscous_ = 0.0, scale_ = 0.0;
};

}  // namespace carom
