// What an evaluation of the solids needs beside the displacement, and what it gives beside the forces.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace carom {

/// The step that ends at the displacement: its length, for laws with rates, and the history of the quadrature points at
/// its beginning (Solid::initial_history). Empty: the points at rest. is_over: the history is that at its end, and the
/// forces and stresses are those that the step has ended with. is_static: a step of statics, in which artificial
/// viscosity rests. alive: by solid cell, 0 where it has gone (Topology::alive; empty: all are there). What has gone
/// takes no part, and its history is that of rest.
struct PointStep {
  double dt = 0.0;
  std::span<const double> history;
  bool is_over = false;
  bool is_static = false;
  std::span<const std::uint8_t> alive{};
};

/// Integrals over the bodies of what is stored (strain, hourglass, distortion), of what their points and hourglass
/// modes have dissipated since the start (plastic, hourglass_loss, viscous), and what of it is heat. Functions of
/// displacement and history: the ledger's terms of these names, or their increments. Aligned to lines of the cache,
/// since threads sum them side by side.
struct alignas(64) SolidEnergies {
  double strain = 0.0, plastic = 0.0, hourglass = 0.0, hourglass_loss = 0.0, viscous = 0.0, heat = 0.0;
  double distortion = 0.0;

  static const std::array<double SolidEnergies::*, 7> terms;
  void add(const SolidEnergies& other) {
    for (double SolidEnergies::*const term : terms) this->*term += other.*term;
  }
};
inline constexpr std::array<double SolidEnergies::*, 7> SolidEnergies::terms{
    &SolidEnergies::strain,  &SolidEnergies::plastic, &SolidEnergies::hourglass, &SolidEnergies::hourglass_loss,
    &SolidEnergies::viscous, &SolidEnergies::heat,    &SolidEnergies::distortion};

}  // namespace carom
