#include "enforcement/velocity_impulses.hpp"

#include <algorithm>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"

namespace carom {

VelocityImpulses::VelocityImpulses(const System& system)
    : system_(system),
      mass_(system),
      bonds_(system, mass_),
      operator_(bonds_.contact_operator()),
      push_(system.solid.dof_count()) {
  if (system.mass.kind() == MassKind::lumped) return;
  operator_.delassus = [this, otherwise = operator_.delassus](const ConstraintRows& rows,
                                                              const std::vector<std::size_t>& chosen) {
    Delassus W = of_consistent_mass(rows, chosen);
    return W.rows.empty() ? otherwise(rows, chosen) : W;
  };
}

void VelocityImpulses::invert(std::span<double> b, int columns) {
  const std::size_t dofs = push_.size();
  for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) operator_.inverse(b.subspan(k * dofs, dofs));
}

InverseOperator VelocityImpulses::inverse() {
  InverseOperator out{[this](std::span<double> b, int columns) { invert(b, columns); }};
  if (!bonds_.any()) out.half = mass_.halves();
  return out;
}

/// From the compliances of the nodes; no rows where there are too many nodes.
Delassus VelocityImpulses::of_consistent_mass(const ConstraintRows& rows, const std::vector<std::size_t>& chosen) {
  if (!nodes_.extend(rows, chosen, push_.size(), inverse())) return {};
  std::vector<std::size_t> components;
  for (const std::size_t r : chosen) components.push_back(carom::components(rows.law[r]));
  return nodes_.compliance(rows, chosen, components);
}

bool VelocityImpulses::accelerations(const ContactResponse& response, std::span<double> a) {
  std::fill(a.begin(), a.end(), 0.0);
  const std::vector<double> contact = force_of_contact(response, a.size());
  if (is_zero(contact)) return true;
  mass_.factorise();
  if (!bonds_.any()) return mass_.solve(contact, a) >= 0;
  std::copy(contact.begin(), contact.end(), a.begin());
  operator_.inverse(a);
  return true;
}

std::string VelocityImpulses::settle_bonds(State& state, std::span<const double> besides) {
  return bonds_.balance(state.a, state.forces, besides);
}

std::string VelocityImpulses::respond(double k, const ContactResponse& closed, Growth& nodes, std::span<double> v) {
  const ConstraintRows& rows = *closed.rows;
  open_response(closed.rows, closed.history.size(), response_);
  closing_.clear();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (closed.status[r] != RowStatus::open && !is_bond(rows.law[r]))
      closing_.push_back({r, scaled(rows.relative(r, v), 1.0 / k), rows.rounding(r, v) / k});
  }
  if (closing_.empty()) {
    std::fill(push_.begin(), push_.end(), 0.0);
    return {};
  }
  mass_.factorise();
  nodes_.grow_as(nodes, push_.size(), inverse());
  std::string failure = close_rows(system_.contact, closing_, closed.history, operator_, response_, push_);
  nodes = nodes_.growth();
  if (failure.empty()) parallel_each(v.size(), [&](std::size_t i) { v[i] += k * push_[i]; });
  return failure;
}

std::unique_ptr<VelocityImpulses> velocity_impulses(const System& system, EnforcementKind enforcement) {
  if (!traits(enforcement).stops_touches) return nullptr;
  const std::vector<double>& mass = system.mass.node_diagonal();
  const std::vector<bool>& fixed = system.supports.fixed();
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    if (mass[i / 3] == 0.0 && !fixed[i]) return nullptr;
  }
  return std::make_unique<VelocityImpulses>(system);
}

}  // namespace carom
