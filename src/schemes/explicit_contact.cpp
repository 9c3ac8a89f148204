#include "schemes/explicit_contact.hpp"

namespace carom {

namespace {

class PenaltyContact final : public ExplicitContact {
 public:
  explicit PenaltyContact(const System& system) : system_(system) {}

  std::string respond(const ExplicitPoint& at, Forces& forces) override {
    penalty_response(system_.contact.rows_at(at.u_begin, at.u, at.history), at.u_begin, at.u, at.v, at.history,
                     forces.rows);
    forces.contact.assign(at.u.size(), 0.0);
    forces.rows.add_force(forces.contact);
    return {};
  }
  void book(const State&, const State&, EnergyTerms&) const override {}

 private:
  const System& system_;
};

}  // namespace

std::unique_ptr<ExplicitContact> penalty_contact(const System& system) {
  return std::make_unique<PenaltyContact>(system);
}

}  // namespace carom
