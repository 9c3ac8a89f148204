// Contact springs between two configurations, for the energy-momentum scheme.
#pragma once

#include <vector>

#include "enforcement/penalty_port.hpp"

namespace carom {

/// Forces over a step from x0 to x on the rows made at its middle (see EnergyMomentum):
///   p = -(Phi(g) - Phi(g0)) / (g - g0), Phi = RowLaw::spring_energy(<-g>); dampers act on the mean velocity where the
///   step begins
/// closed; friction by the return mapping of penalty_response at the middle.
class PotentialPort final : public PenaltyPort {
 public:
  using PenaltyPort::PenaltyPort;

  void begin(const StageStart& start) override;
  void respond(std::span<const double> x, std::span<const double> v, ContactResponse& response) override;
  PortSolve solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                  const ContactResponse& response, std::span<const double> residual, double absolute,
                  std::span<double> dy) override;
  ContactWork work(const State& begin, const State& end, double end_weight) const override;

 private:
  double h_ = 0.0;
  std::vector<double> middle_;
};

}  // namespace carom
