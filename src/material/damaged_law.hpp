// Laws with Johnson and Cook's damage: what belongs to no number type.
#pragma once

#include <memory>
#include <optional>

#include "material/law.hpp"
#include "material/law_kernels.hpp"

namespace carom {

/// A law that yields, whose points remember their damage behind the law's own variables: the parameters of the kernels
/// in material/damaged_update.hpp. The stress does not depend on the damage.
struct DamagedLaw {
  LawKernels kernels;                  ///< of the law without damage
  const void* parameters = nullptr;    ///< of the same
  std::shared_ptr<const void> holder;  ///< keeps them
  int history = 0;                     ///< variables of the same
  int plastic_strain = 0;              ///< places among them
  std::optional<int> temperature_rise{};
  bool is_finite = false;
  JohnsonCookDamage values{};
  double reference_rate = 0.0;            ///< 0: no influence of the rate
  double theta = 0.0, theta_by_rise = 0;  ///< at the start, and with the rise of the temperature
};

/// Does a point of the law remember the equivalent plastic strain?
bool yields(const Law& law);

/// The law of a material with damage, of the law without it.
PreparedLaw with_damage(const Material& material, const PreparedLaw& law, const LawKernels& damaged);

/// Rules between the values of the damage and the law, the keys those of JohnsonCookDamage; nothing when all is well.
std::optional<LawProblem> check_damage(const Material& material);

}  // namespace carom
