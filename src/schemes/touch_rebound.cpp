#include "schemes/touch_rebound.hpp"

#include "schemes/generalized_alpha.hpp"

namespace carom {

std::optional<double> touch_rebound(const SchemeSettings& s) {
  if (!traits(s.enforcement).has_multipliers) return std::nullopt;
  const auto of = [](const GeneralizedAlphaParameters& p) { return (1.0 - p.alpha_m) / p.beta - 1.0; };
  switch (s.kind) {
    case SchemeKind::newmark:
    case SchemeKind::wbz:
      return 0.0;
    case SchemeKind::hht:
      return of(hht_parameters(s.alpha));
    case SchemeKind::generalized_alpha:
      return of(chung_hulbert_parameters(s.rho_inf));
    case SchemeKind::bathe:
      return 0.5;
    default:
      return std::nullopt;
  }
}

}  // namespace carom
