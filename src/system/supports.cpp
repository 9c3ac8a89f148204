#include "system/supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace carom {

namespace {

bool same_motion(const PrescribedMotion& a, const PrescribedMotion& b) {
  const auto is_blocked = [](const PrescribedMotion& m) {
    for (const double value : m.function.value) {
      if (value != 0.0) return false;
    }
    return true;
  };
  if (is_blocked(a) && is_blocked(b)) return true;
  return a.kind == b.kind && a.function.time == b.function.time && a.function.value == b.function.value &&
         a.function.called == b.function.called;
}

}  // namespace

Supports::Supports(const Model& model, const std::vector<bool>& has_mass) {
  std::map<Index, const PrescribedMotion*> owner;
  for (const PrescribedMotion& motion : model.motions) {
    for (const Index n : motion.nodes) {
      const auto [entry, is_new] = owner.emplace(3 * n + motion.component, &motion);
      if (is_new || same_motion(*entry->second, motion)) continue;
      throw std::invalid_argument(fmt::format("node {} has two different motions along {}: from \"{}\" and from \"{}\"",
                                              model.mesh->node_label(n), "xyz"[motion.component],
                                              entry -> second -> name, motion.name));
    }
  }
  fixed_.assign(3 * has_mass.size(), false);
  prescribed_flag_ = fixed_;
  for (std::size_t n = 0; n < has_mass.size(); ++n) {
    for (std::size_t c = 0; c < 3; ++c) fixed_[3 * n + c] = !has_mass[n];
  }
  for (const PrescribedMotion& motion : model.motions) {
    motions_.push_back({motion.kind, motion.function});
    if (motion.rotation) motions_.back().travel = motion.rotation->travel;
  }
  for (const auto& [dof, motion] : owner) {
    prescribed_.push_back({dof, static_cast<std::size_t>(motion - model.motions.data())});
    if (motion->rotation) {
      const auto c = static_cast<std::size_t>(motion->component);
      const RotatedPoint point =
          rotated_point(*motion->rotation, model.mesh->coordinates[static_cast<std::size_t>(dof / 3)]);
      prescribed_.back().cosine = point.cosine[c];
      prescribed_.back().sine = point.sine[c];
    }
    fixed_[static_cast<std::size_t>(dof)] = prescribed_flag_[static_cast<std::size_t>(dof)] = true;
  }
  fixed_components_.assign(has_mass.size(), 0);
  for (std::size_t i = 0; i < fixed_.size(); ++i)
    if (fixed_[i]) fixed_components_[i / 3] |= static_cast<std::uint8_t>(1U << (i % 3));
  const bool has_acceleration =
      std::any_of(motions_.begin(), motions_.end(), [](const Motion& m) { return m.kind == MotionKind::acceleration; });
  for (const InitialState& initial : model.initial) {
    if (initial.velocity.empty() || !has_acceleration) continue;
    std::map<Index, Vec3> velocity;
    for (std::size_t k = 0; k < initial.nodes.size(); ++k) velocity[initial.nodes[k]] = initial.velocity_of(k);
    for (PrescribedDof& p : prescribed_) {
      if (motions_[p.motion].kind != MotionKind::acceleration) continue;
      const auto given = velocity.find(p.dof / 3);
      if (given != velocity.end()) p.start_velocity = given->second[static_cast<std::size_t>(p.dof % 3)];
    }
  }
}

}  // namespace carom
