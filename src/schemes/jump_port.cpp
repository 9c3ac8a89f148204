#include "schemes/jump_port.hpp"

#include <cassert>

namespace carom {

JumpPort::JumpPort(const System& system, double ratio)
    : ImpulsePort(system), ratio_(ratio), mass_solver_(system), compliance_(system.solid.dof_count(), 0) {
  assert(ratio >= 0.0);
  load_.resize(system.solid.dof_count());
  jump_.resize(load_.size());
}

Vec3 JumpPort::value(const ConstraintRows& rows, std::size_t r, std::span<const double> z) const {
  Vec3 w = ImpulsePort::value(rows, r, z);
  if (ratio_ == 0.0) return w;
  const Vec3 jump = rows.relative(r, jump_);
  for (std::size_t c = 0; c < 3; ++c) w[c] += jump[c];
  return w;
}

void JumpPort::add_direct_compliance(const std::shared_ptr<const ConstraintRows>& rows,
                                     std::span<const std::size_t> acting, std::span<const std::size_t> counts,
                                     std::vector<FrameBlock>& W) {
  if (ratio_ == 0.0) return;
  compliance_.use(rows);
  const ContactOperator mass = mass_operator(system_, mass_solver_);
  const std::size_t n = load_.size();
  const std::vector<FrameBlock> direct = compliance_.blocks(acting, counts, [&](std::span<double> b, int columns) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) mass.inverse(b.subspan(k * n, n));
  });
  for (std::size_t i = 0; i < W.size(); ++i)
    for (std::size_t k = 0; k < W[i].size(); ++k) W[i][k] += ratio_ * direct[i][k];
}

void JumpPort::see_forces(const ConstraintRows& rows, std::span<const std::size_t> which, std::span<const Vec3> force) {
  if (ratio_ == 0.0) return;
  load_.assign(load_.size(), 0.0);
  jump_.assign(jump_.size(), 0.0);
  bool acts = false;
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (force[i] == Vec3{}) continue;
    acts = true;
    rows.scatter(which[i], force[i], load_);
  }
  if (!acts) return;
  mass_solver_.solve(load_, jump_);
  for (double& jump : jump_) jump *= ratio_ * slope();
}

}  // namespace carom
