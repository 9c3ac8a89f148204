// Two surfaces that are glued until they tear apart: a cohesive zone.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "mesh/facet.hpp"

namespace carom {

/// Bilinear law of traction and separation (Camanho and Davila, NASA/TM-2002-211737). Stresses, energies per area, and
/// a stiffness: stress per distance that the sides part, the same in all directions.
struct CohesiveLaw {
  double normal_strength = 0.0, shear_strength = 0.0;
  double normal_energy = 0.0, shear_energy = 0.0;
  double stiffness = 0.0;
};

/// One place of the zone: w = sum of weight x displacement is what the sides part by, those of the slave side having
/// positive weights and those of the master negative ones.
struct CohesiveRow {
  std::vector<std::pair<Index, double>> slave, master;
  double area = 0.0;
  Facet facet;    ///< of the master, whose turning the normal follows
  Vec3 normal{};  ///< at rest, from the master to the slave
};

/// The zone of a contact whose surfaces are glued until they tear apart, and touch afterwards.
struct CohesiveZone {
  std::size_t contact = 0;  ///< index in Model::contacts, a PairContact of the same surfaces
  std::string name;
  CohesiveLaw law;
  double stiffness_factor = 1.0;  ///< on the stiffness that is chosen where the law has none
  std::vector<CohesiveRow> rows;
  std::vector<std::string> notes;
};

}  // namespace carom
