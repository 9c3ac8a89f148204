#include "enforcement/explicit_contact.hpp"

#include <stdexcept>
#include <utility>

#include "system/bonded_mass.hpp"

namespace carom {

namespace {

class PenaltyContact final : public ExplicitContact {
 public:
  explicit PenaltyContact(const System& system) : system_(system), mass_(system), bonds_(system, mass_) {}
  PenaltyContact(const PenaltyContact&) = delete;

  std::string respond(const ExplicitPoint& at, Forces& forces) override {
    forces.contact.clear(at.u.size());
    penalty_response(system_.contact.rows_at(at.u_begin, at.u, at.past), at.u_begin, at.u, at.v, at.past.history,
                     forces.rows);
    forces.rows.add_force(forces.contact);
    return bonds_.hold({at.h, at.u, at.v, at.a}, forces);
  }
  ContactWork work(const State& begin, const State& end) const override { return spring_work(begin, end); }
  bool is_local() const override { return true; }

 private:
  const System& system_;
  MassSolver mass_;
  BondedMass bonds_;
};

}  // namespace

std::string ExplicitContact::evaluate(const System& system, const State& begin, double h, std::span<const double> v,
                                      State& end) {
  evaluate_bodies(system, step_from(begin, h), end);
  return respond({h, h, begin.q, end.q, v, end.a, past_of(begin)}, end.forces);
}

void ExplicitContact::start(const System& system, double dt, double weight, State& state, const Holding* shared) {
  const std::vector<double> points = std::exchange(state.points, {});
  PointStep step = start_step(dt, points, state);
  step.nodes = shared;
  evaluate_bodies(system, step, state);
  const std::string failure = respond({dt, weight, state.q, state.q, state.v, state.a, past_of(state)}, state.forces);
  if (!failure.empty()) throw std::runtime_error("at the start: " + failure);
}

std::unique_ptr<ExplicitContact> penalty_contact(const System& system) {
  return std::make_unique<PenaltyContact>(system);
}

}  // namespace carom
