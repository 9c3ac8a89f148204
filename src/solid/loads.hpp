// External forces as fixed vectors times functions of time.
#pragma once

#include <vector>

#include "model/model.hpp"
#include "solid/blocks.hpp"

namespace carom {

/// factor(t) x force on the dofs of some nodes.
struct LoadVector {
  std::vector<Index> nodes;
  std::vector<Vec3> force;  ///< one per node
  TimeFunction factor;
};

/// One vector per load of the model. Nodal forces as they are; pressure: f_a = -p integral of N_a n dA over the
/// reference faces (2 x 2 Gauss, exact); gravity: f_a = sum over b of M_ab g with the consistent mass.
std::vector<LoadVector> make_loads(const Model& model, const SolidCells& solid);

}  // namespace carom
