// Parameters of a von Mises body that own what they point to.
#pragma once

#include <memory>
#include <utility>

#include "material/law.hpp"
#include "material/plastic_law.hpp"

namespace carom {

/// A PlasticLaw whose parameters are a Yield.
template <class Yield>
std::shared_ptr<const void> prepare_plastic(const Material& material, PlasticLaw law, Yield yield) {
  struct Owner {
    PlasticLaw law;
    Yield yield;
  };
  const auto owner = std::make_shared<Owner>(Owner{law, std::move(yield)});
  owner->law.lame = material.at_rest().lame();
  owner->law.parameters = &owner->yield;
  return {owner, &owner->law};
}

}  // namespace carom
