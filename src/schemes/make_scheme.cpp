#include "schemes/make_scheme.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "schemes/bathe.hpp"
#include "schemes/central_differences.hpp"
#include "schemes/contact_stabilized_newmark.hpp"
#include "schemes/energy_momentum.hpp"
#include "schemes/generalized_alpha.hpp"
#include "schemes/hulbert_chung.hpp"
#include "schemes/moreau_jean.hpp"
#include "schemes/noh_bathe.hpp"
#include "schemes/nonsmooth_generalized_alpha.hpp"
#include "schemes/semi_explicit.hpp"
#include "schemes/statics.hpp"
#include "schemes/tchamwa_wielgosz.hpp"

namespace carom {

std::unique_ptr<Scheme> make_scheme(const System& system, const SchemeSettings& s, double dt,
                                    double omega_max_squared) {
  const ImplicitSettings implicit{s.enforcement, s.max_iterations, s.penetration, s.solver};
  const auto alpha_family = [&](const GeneralizedAlphaParameters& p, std::unique_ptr<VelocityImpulses> impulses) {
    return std::make_unique<GeneralizedAlpha>(system, p, implicit, dt, omega_max_squared, std::move(impulses));
  };
  switch (s.kind) {
    case SchemeKind::newmark:
      return alpha_family(newmark_parameters(s.beta, s.gamma), velocity_impulses(system, s.enforcement));
    case SchemeKind::hht:
      return alpha_family(hht_parameters(s.alpha), nullptr);
    case SchemeKind::wbz:
      return alpha_family(wbz_parameters(s.alpha), velocity_impulses(system, s.enforcement));
    case SchemeKind::generalized_alpha:
      return alpha_family(chung_hulbert_parameters(s.rho_inf), nullptr);
    case SchemeKind::bathe:
      return std::make_unique<Bathe>(system, implicit, dt, omega_max_squared);
    case SchemeKind::contact_stabilized_newmark:
      return std::make_unique<ContactStabilizedNewmark>(system, s.gamma, implicit, dt, omega_max_squared);
    case SchemeKind::energy_momentum:
      return std::make_unique<EnergyMomentum>(system, implicit, dt, omega_max_squared);
    case SchemeKind::statics:
      return std::make_unique<Statics>(system, implicit, omega_max_squared);
    case SchemeKind::moreau_jean:
      return std::make_unique<MoreauJean>(system, s.theta, implicit, dt, omega_max_squared);
    case SchemeKind::nonsmooth_generalized_alpha:
      return std::make_unique<NonsmoothGeneralizedAlpha>(system, chung_hulbert_parameters(s.rho_inf), implicit, dt,
                                                         omega_max_squared);
    case SchemeKind::central_differences:
      return std::make_unique<CentralDifferences>(system, penalty_contact(system));
    case SchemeKind::cd_lagrange:
      return std::make_unique<CentralDifferences>(system, impulse_contact(system));
    case SchemeKind::forward_increment:
      return std::make_unique<CentralDifferences>(system, forward_increment_contact(system));
    case SchemeKind::modified_mass:
      return std::make_unique<SemiExplicit>(system, s.max_iterations);
    case SchemeKind::hulbert_chung:
      return std::make_unique<HulbertChung>(system, s.rho_inf);
    case SchemeKind::noh_bathe:
      return std::make_unique<NohBathe>(system, s.p);
    case SchemeKind::tchamwa_wielgosz:
      return std::make_unique<TchamwaWielgosz>(system, s.phi);
  }
  throw std::logic_error("a scheme without a class");
}

std::string describe(const SchemeSettings& s) {
  const std::string_view title = traits(s.kind).title;
  switch (s.kind) {
    case SchemeKind::newmark:
      return fmt::format("{} beta {:g} gamma {:g}", title, s.beta, s.gamma);
    case SchemeKind::contact_stabilized_newmark:
      return fmt::format("{} gamma {:g}", title, s.gamma);
    case SchemeKind::hht:
    case SchemeKind::wbz:
      return fmt::format("{} alpha {:g}", title, s.alpha);
    case SchemeKind::generalized_alpha:
    case SchemeKind::nonsmooth_generalized_alpha:
    case SchemeKind::hulbert_chung:
      return fmt::format("{} rho_inf {:g}", title, s.rho_inf);
    case SchemeKind::moreau_jean:
      return fmt::format("{} theta {:g}", title, s.theta);
    case SchemeKind::tchamwa_wielgosz:
      return fmt::format("{} phi {:g}", title, s.phi);
    case SchemeKind::noh_bathe:
      return fmt::format("{} p {:g}", title, s.p);
    default:
      return std::string(title);
  }
}

}  // namespace carom
