// What an evaluation of the solids gives beside the forces.
#pragma once

#include <array>

namespace carom {

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
