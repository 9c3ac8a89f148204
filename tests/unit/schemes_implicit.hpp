// Every implicit scheme with every enforcement that it takes, for tests that hold for all of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "schemes/bathe.hpp"
#include "schemes/contact_stabilized_newmark.hpp"
#include "schemes/energy_momentum.hpp"
#include "schemes/moreau_jean.hpp"
#include "schemes/nonsmooth_generalized_alpha.hpp"
#include "schemes_fixture.hpp"

namespace carom::test {

struct ImplicitScheme {
  std::string name;
  ImplicitSettings settings;
  /// The problem, the usual step, a bound of the spectrum.
  std::function<std::unique_ptr<Scheme>(const Problem&, const ImplicitSettings&, double, double)> make;

  std::unique_ptr<Scheme> with(const Problem& p, double h) const {
    return make(p, settings, h, stable_step(p.system).omega_max_squared_free);
  }
};

inline ImplicitScheme alpha_scheme(const std::string& title, const GeneralizedAlphaParameters& parameters,
                                   EnforcementKind enforcement) {
  return {title + "_" + std::string(name(enforcement)),
          {.enforcement = enforcement},
          [parameters](const Problem& p, const ImplicitSettings& settings, double h, double omega_squared) {
            return std::make_unique<GeneralizedAlpha>(p.system, parameters, settings, h, omega_squared);
          }};
}

inline ImplicitScheme moreau_jean_scheme(const std::string& title, double theta) {
  return {title,
          {.enforcement = EnforcementKind::impulse},
          [theta](const Problem& p, const ImplicitSettings& settings, double h, double omega_squared) {
            return std::make_unique<MoreauJean>(p.system, MoreauJeanParameters{theta}, settings, h, omega_squared);
          }};
}

inline ImplicitScheme nonsmooth_scheme(const std::string& title, double rho_inf) {
  return {title,
          {.enforcement = EnforcementKind::impulse},
          [rho_inf](const Problem& p, const ImplicitSettings& settings, double h, double omega_squared) {
            return std::make_unique<NonsmoothGeneralizedAlpha>(p.system, chung_hulbert_parameters(rho_inf), settings, h,
                                                               omega_squared);
          }};
}

inline std::vector<ImplicitScheme> implicit_schemes() {
  std::vector<ImplicitScheme> all;
  for (const EnforcementKind e : {EnforcementKind::penalty, EnforcementKind::augmented_lagrangian,
                                  EnforcementKind::lagrange, EnforcementKind::plain}) {
    all.push_back(alpha_scheme("newmark", newmark_parameters(0.28, 0.55), e));
    all.push_back(alpha_scheme("hht", hht_parameters(-0.2), e));
    all.push_back(alpha_scheme("wbz", wbz_parameters(-0.2), e));
    all.push_back(alpha_scheme("generalized_alpha", chung_hulbert_parameters(0.5), e));
    all.push_back({"bathe_" + std::string(name(e)),
                   {.enforcement = e},
                   [](const Problem& p, const ImplicitSettings& settings, double h, double omega_squared) {
                     return std::make_unique<Bathe>(p.system, settings, h, omega_squared);
                   }});
  }
  for (const EnforcementKind e : {EnforcementKind::augmented_lagrangian, EnforcementKind::lagrange}) {
    all.push_back(alpha_scheme("trapezoidal", newmark_parameters(0.25, 0.5), e));
    all.push_back(alpha_scheme("wbz_hardly_damped", wbz_parameters(-0.05), e));
  }
  all.push_back({"contact_stabilized",
                 {.enforcement = EnforcementKind::lagrange},
                 [](const Problem& p, const ImplicitSettings& settings, double h, double omega_squared) {
                   return std::make_unique<ContactStabilizedNewmark>(p.system, ContactStabilizedParameters{0.5},
                                                                     settings, h, omega_squared);
                 }});
  all.push_back({"energy_momentum",
                 {.enforcement = EnforcementKind::penalty},
                 [](const Problem& p, const ImplicitSettings& settings, double h, double omega_squared) {
                   return std::make_unique<EnergyMomentum>(p.system, settings, h, omega_squared);
                 }});
  all.push_back(moreau_jean_scheme("moreau_jean", 0.5));
  all.push_back(moreau_jean_scheme("moreau_jean_dissipative", 0.7));
  all.push_back(nonsmooth_scheme("nonsmooth_generalized_alpha", 0.5));
  all.push_back(nonsmooth_scheme("nonsmooth_generalized_alpha_conserving", 1.0));
  return all;
}

}  // namespace carom::test
