// Parameters of a von Mises body that own what they point to.
#pragma once

#include <memory>
#include <utility>

#include "material/law.hpp"
#include "material/plastic_law.hpp"

namespace carom {

/// The PlasticLaw of a material.
template <class Yield>
std::shared_ptr<const void> prepare_plastic(const Material& material, double elastic_limit, Yield yield) {
  return std::make_shared<PlasticLaw<Yield>>(
      PlasticLaw<Yield>{material.at_rest().lame(), elastic_limit, std::move(yield)});
}

}  // namespace carom
