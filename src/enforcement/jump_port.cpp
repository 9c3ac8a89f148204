#include "enforcement/jump_port.hpp"

#include <cassert>
#include <utility>

#include "rows/admissible.hpp"

namespace carom {

JumpPort::JumpPort(const System& system, double ratio, std::shared_ptr<MassSolver> mass,
                   std::shared_ptr<BondedMass> bonds)
    : ImpulsePort(system),
      ratio_(ratio),
      mass_(std::move(mass)),
      bonds_(std::move(bonds)),
      operator_(bonds_->contact_operator()) {
  assert(ratio >= 0.0);
  load_.resize(system.solid.dof_count());
  jump_.resize(load_.size());
}

void JumpPort::leave(StageMemory& memory) const {
  ImpulsePort::leave(memory);
  if (is_solved_) memory.mass_nodes = nodes_.growth();
}

void JumpPort::invert(std::span<double> b, int columns) {
  const std::size_t dofs = load_.size();
  for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) operator_.inverse(b.subspan(k * dofs, dofs));
}

InverseOperator JumpPort::inverse() {
  InverseOperator out{[this](std::span<double> b, int columns) { invert(b, columns); }};
  if (!bonds_->any()) out.half = mass_->halves();
  return out;
}

bool JumpPort::go_on_directly() {
  const Growth& grown = start_.memory->mass_nodes;
  if (!grown.entries.empty()) mass_->factorise();
  return nodes_.grow_as(grown, load_.size(), inverse());
}

Vec3 JumpPort::value(const ConstraintRows& rows, std::size_t r, std::span<const double> z) const {
  Vec3 w = ImpulsePort::value(rows, r, z);
  if (ratio_ == 0.0) return w;
  const Vec3 jump = rows.relative(r, jump_);
  for (std::size_t c = 0; c < 3; ++c) w[c] += jump[c];
  return w;
}

void JumpPort::add_direct_compliance(const std::shared_ptr<const ConstraintRows>& rows,
                                     std::span<const std::size_t> all, std::span<const std::size_t> components,
                                     Delassus& W) {
  if (ratio_ == 0.0) return;
  std::vector<std::size_t> acting, counts, place;  // of the rows that are no bonds
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_bond(rows->law[all[i]])) continue;
    acting.push_back(all[i]);
    counts.push_back(components[i]);
    place.push_back(i);
  }
  if (acting.empty()) return;
  mass_->factorise();
  const bool is_by_nodes =
      system_.mass.kind() != MassKind::lumped && nodes_.extend(*rows, acting, load_.size(), inverse());
  const Delassus direct = is_by_nodes ? nodes_.compliance(*rows, acting, counts) : operator_.delassus(*rows, acting);
  for (std::size_t i = 0; i < acting.size(); ++i) {
    direct.each(i, [&](std::size_t j, std::size_t entry) {
      FrameBlock more = direct.block_at(entry);
      for (double& value : more) value *= ratio_;
      W.add(place[i] * all.size() + place[j], more);
    });
  }
}

void JumpPort::see_forces(const ConstraintRows& rows, std::span<const std::size_t> which, std::span<const Vec3> force) {
  if (ratio_ == 0.0) return;
  load_.assign(load_.size(), 0.0);
  jump_.assign(jump_.size(), 0.0);
  bool acts = false;
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (force[i] == Vec3{} || is_bond(rows.law[which[i]])) continue;
    acts = true;
    rows.scatter(which[i], force[i], load_);
  }
  if (!acts) return;
  mass_->factorise();
  if (bonds_->any()) {
    jump_ = load_;
    operator_.inverse(jump_);
  } else {
    mass_->solve(load_, jump_);
  }
  for (double& jump : jump_) jump *= ratio_ * slope();
}

}  // namespace carom
