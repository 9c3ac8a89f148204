// Small systems for the tests of the schemes.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "contact/contact_geometry.hpp"
#include "energy/ledger.hpp"
#include "parallel/threads.hpp"
#include "schemes/central_differences.hpp"
#include "schemes/generalized_alpha.hpp"
#include "schemes/stable_step.hpp"
#include "solid_fixture.hpp"

namespace carom::test {

/// A state at displacement u.
inline State state_at(const std::vector<double>& u) {
  State state;
  state.q = u;
  return state;
}

/// Everything that System refers to.
struct Problem {
  explicit Problem(Model given, MassKind kind = MassKind::consistent, Isa isa = chosen_isa())
      : model(std::move(given)),
        solid(model, isa),
        mass(solid.mass(kind)),
        contact(model),
        supports(model, with_mass(mass)),
        system{*model.mesh, solid, mass, contact, supports} {}
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  static std::vector<bool> with_mass(const Mass& mass) {
    std::vector<bool> flags;
    for (const double m : mass.node_diagonal()) flags.push_back(m > 0.0);
    return flags;
  }

  std::shared_ptr<const ConstraintRows> rows() const {
    const std::vector<double> zero(solid.dof_count(), 0.0);
    return contact.rows_at(zero, zero);
  }

  /// Free nodes of the body at velocity v0; nothing displaced.
  State moving(const Vec3& v0) const {
    State state;
    state.q.assign(solid.dof_count(), 0.0);
    for (std::size_t i = 0; i < solid.dof_count(); ++i) state.v.push_back(v0[i % 3]);
    state.contact.resize(contact.slots());
    return state;
  }

  Model model;
  Solid solid;
  Mass mass;
  ContactGeometry contact;
  Supports supports;
  System system;
};

/// A run of equal steps with its books.
struct History {
  State state;
  EnergyLedger ledger;
  double imbalance = 0.0;  ///< largest over the steps, absolute
  double linear_momentum_error = 0.0, angular_momentum_error = 0.0;
  double shadow_change = 0.0;  ///< largest change of T + U - h^2/8 a.Ma over a step
  int linear_iterations = 0;
  bool converged = true;
  std::string failure{};  ///< of the step that did not converge
};

inline double shadow_energy(const State& state, double h) {
  return state.forces.stored.mechanical() - h * h / 8.0 * state.forces.inertia_power;
}

/// Steps `scheme` from `begin` (before start()) by n steps of h. observe(state) is called after the start and
/// every step. The residual may leave 1e-12 of the energy unbooked over the run, as in a case.
template <class Observe>
History march(Scheme& scheme, const State& begin, double h, int n, const Observe& observe) {
  State state = begin, next;
  scheme.start(state, h);
  History out{state, {state.forces.stored, state.forces.total_momentum, 1.0}};
  double shadow = shadow_energy(state, h);
  observe(state);
  for (int i = 1; i <= n && out.converged; ++i) {
    const double tolerance = 1e-12 * out.ledger.scale() / n;
    const StepReport report = scheme.step(state, {i * h, h, tolerance}, next);
    out.converged = report.converged;
    if (!out.converged) {
      out.failure = report.failure;
      break;
    }
    std::swap(state, next);
    out.linear_iterations += report.linear_iterations;
    out.ledger.add(report.books, state.forces.total_momentum);
    out.imbalance = std::max(out.imbalance, std::abs(out.ledger.imbalance()));
    const Momentum error = out.ledger.momentum_error();
    for (std::size_t c = 0; c < 3; ++c) {
      out.linear_momentum_error = std::max(out.linear_momentum_error, std::abs(error.linear[c]));
      out.angular_momentum_error = std::max(out.angular_momentum_error, std::abs(error.angular[c]));
    }
    const double shadow_now = shadow_energy(state, h);
    out.shadow_change = std::max(out.shadow_change, std::abs(shadow_now - shadow));
    shadow = shadow_now;
    observe(state);
  }
  out.state = state;
  return out;
}

inline History march(Scheme& scheme, const State& begin, double h, int n) {
  return march(scheme, begin, h, n, [](const State& /*state*/) {});
}

inline std::unique_ptr<Scheme> generalized_alpha(const Problem& p, double h,
                                                 const GeneralizedAlphaParameters& parameters,
                                                 const ImplicitSettings& settings = {}) {
  return std::make_unique<GeneralizedAlpha>(p.system, parameters, settings, h,
                                            stable_step(p.system).omega_max_squared_free);
}

inline std::unique_ptr<Scheme> newmark(const Problem& p, double h, const NewmarkParameters& parameters = {},
                                       const ImplicitSettings& settings = {}) {
  return generalized_alpha(p, h, newmark_parameters(parameters.beta, parameters.gamma), settings);
}

inline std::unique_ptr<Scheme> central(const Problem& p) {
  return std::make_unique<CentralDifferences>(p.system);
}

/// Outward QUAD4 faces of a group.
inline std::vector<Facet> faces_of(const Mesh& mesh, const std::string& group) {
  std::vector<Facet> faces;
  for (const CellRef& ref : mesh.cell_groups.at(group)) {
    const CellBlock& quads = mesh.blocks[static_cast<std::size_t>(ref.block)];
    Facet& face = faces.emplace_back(Facet{{}, 4});
    std::copy_n(quads.connectivity.begin() + 4 * static_cast<std::ptrdiff_t>(ref.cell), 4, face.node.begin());
  }
  return faces;
}

/// Blocks the components of all nodes of a group.
inline void block(Model& model, const std::string& group, const std::vector<int>& components) {
  for (const int c : components) model.motions.push_back({group, model.mesh->nodes_of(group), c});
}

struct Friction {
  double eps_T = 0.0, mu = 0.0;
};

/// A plane z = -gap under the group's faces, per area.
inline ObstacleContact plane_below(const Model& model, double gap, double eps_N, const Friction& friction = {}) {
  ObstacleContact plane;
  plane.name = "plane";
  plane.shape = Plane{{0, 0, -gap}, {0, 0, 1}};
  plane.surface.facets = faces_of(*model.mesh, "ZMIN");
  plane.law = {.eps_N = eps_N, .eps_T = friction.eps_T, .mu = friction.mu};
  return plane;
}

}  // namespace carom::test
