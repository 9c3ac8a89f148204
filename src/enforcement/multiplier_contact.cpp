#include <algorithm>
#include <optional>
#include <vector>

#include "contact/closing_rows.hpp"
#include "enforcement/contact_work.hpp"
#include "enforcement/explicit_contact.hpp"
#include "enforcement/stopped_rows.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"
#include "system/bonded_mass.hpp"
#include "system/mass_solver.hpp"

namespace carom {

namespace {

/// What a row asks of v_next: (G v_next)_n + bias >= 0.
struct Bias {
  double value = 0.0, round_off = 0.0;
};
/// Nothing when the row takes no part.
using RowBias = std::optional<Bias> (*)(const ContactGeometry& contact, const ConstraintRows& rows, std::size_t r,
                                        const ExplicitPoint& at);

std::optional<Bias> increment_bias(const ContactGeometry& /*contact*/, const ConstraintRows& rows, std::size_t r,
                                   const ExplicitPoint& at) {
  return Bias{rows.gap_at(r, at.u) / at.h, rows.gap_rounding(r, at.u) / at.h};
}

std::optional<Bias> impulse_bias(const ContactGeometry& contact, const ConstraintRows& rows, std::size_t r,
                                 const ExplicitPoint& at) {
  if (!rows.is_closed(r, at.u, contact.extent())) {
    if (!is_stopped_before(contact, rows.law[r])) return std::nullopt;
    return increment_bias(contact, rows, r, at);
  }
  const double e = rows.law[r].restitution;
  return Bias{e == 0.0 ? 0.0 : e * std::min(0.0, rows.relative(r, at.v)[0]), 0.0};
}

/// Multipliers that keep v_next on the right side of every row: w = (G v_next + bias) / weight, A = M.
class MultiplierContact final : public ExplicitContact {
 public:
  MultiplierContact(const System& system, RowBias bias)
      : system_(system), bias_(bias), mass_(system), bonds_(system, mass_), operator_(bonds_.contact_operator()) {}
  MultiplierContact(const MultiplierContact&) = delete;

  std::string respond(const ExplicitPoint& at, Forces& forces) override {
    forces.contact.clear(at.u.size());
    open_response(system_.contact.rows_at(at.u_begin, at.u, at.past), at.past.history.size(), forces.rows);
    const ConstraintRows& rows = *forces.rows.rows;
    const BondMotion motion{at.h, at.u, at.v, at.a};
    std::string failure = bonds_.hold(motion, forces);
    if (!failure.empty()) return failure;
    closing_.clear();
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (is_bond(rows.law[r])) continue;
      if (const auto bias = bias_(system_.contact, rows, r, at))
        closing_.push_back({r, {bias->value, 0.0, 0.0}, bias->round_off});
    }
    if (closing_.empty()) return {};
    if (!free_velocity(at, forces)) return MassSolver::failure;
    for (ClosingRow& c : closing_) {
      const Vec3 w = rows.relative(c.row, v_free_);
      c.w = {(c.w[0] + w[0]) / at.weight, w[1] / at.weight, w[2] / at.weight};
      c.round_off = (c.round_off + rows.rounding(c.row, v_free_)) / at.weight;
    }
    push_.resize(at.u.size());
    failure = close_rows(system_.contact, closing_, at.past.history, operator_, forces.rows, push_);
    if (!failure.empty()) return failure;
    forces.contact.clear(at.u.size());
    forces.rows.add_force(forces.contact);
    return bonds_.hold(motion, forces);  // what the others do to them
  }

  ContactWork work(const State& begin, const State& end) const override { return multiplier_work(begin, end, 0.5); }

 private:
  /// v_next without contact.
  bool free_velocity(const ExplicitPoint& at, const Forces& forces) {
    v_free_.assign(at.a.begin(), at.a.end());
    rhs_.resize(v_free_.size());
    force_sum(forces, rhs_);
    if (mass_.solve(rhs_, v_free_) < 0) return false;
    parallel_each(v_free_.size(), [&](std::size_t i) { v_free_[i] = at.v[i] + at.weight * v_free_[i]; });
    return true;
  }

  const System& system_;
  RowBias bias_;
  MassSolver mass_;
  BondedMass bonds_;
  ContactOperator operator_;
  std::vector<ClosingRow> closing_;
  std::vector<double> v_free_, push_, rhs_;
};

}  // namespace

std::unique_ptr<ExplicitContact> impulse_contact(const System& system) {
  return std::make_unique<MultiplierContact>(system, impulse_bias);
}
std::unique_ptr<ExplicitContact> forward_increment_contact(const System& system) {
  return std::make_unique<MultiplierContact>(system, increment_bias);
}

}  // namespace carom
