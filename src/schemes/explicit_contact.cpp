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

void book_multipliers(const State& begin, const State& end, EnergyTerms& energy) {
  double normal = 0.0, tangential = 0.0;
  for (const Forces* forces : {&begin.forces, &end.forces}) {
    const ConstraintRows& rows = *forces->rows.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (forces->rows.status[r] == RowStatus::open) continue;
      const Vec3& f = forces->rows.force[r];
      const Vec3 before = rows.relative(r, begin.q), after = rows.relative(r, end.q);
      normal -= 0.5 * f[0] * (after[0] - before[0]);
      tangential -= 0.5 * (f[1] * (after[1] - before[1]) + f[2] * (after[2] - before[2]));
    }
  }
  energy.impact += normal;
  energy.friction += tangential;
  energy.quadrature -= normal + tangential;
}

}  // namespace carom
