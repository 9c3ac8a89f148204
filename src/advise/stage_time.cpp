#include "advise/stage_time.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "base/page_memory.hpp"
#include "base/types.hpp"
#include "model/model.hpp"
#include "parallel/threads.hpp"
#include "schemes/scheme_table.hpp"
#include "solid/point_history.hpp"
#include "solid/stability.hpp"

namespace carom {

bool has_factor(const Stage& stage) {
  if (is_explicit(stage.settings().kind)) return false;
  const SchemeSettings& settings = stage.settings();
  const double ratio = !has_inertia(settings.kind) ? infinity : 0.25 * stage.dt() * stage.dt();
  const double omega_squared = largest_frequency_bound(stage.system().solid);
  const SolverKind kind = chosen_solver(stage.system(), settings.solver, settings.enforcement, ratio, omega_squared);
  return kind == SolverKind::cholesky || kind == SolverKind::ldlt;
}

namespace {

bool has_friction(const Model& model) {
  return std::ranges::any_of(model.contacts, [](const ContactDefinition& c) {
    const ContactLaw* law = law_of(c);
    return law != nullptr && law->mu > 0.0;
  });
}

/// Of one evaluation of the forces at rest; the second, which finds everything in its place.
double seconds_of_bodies(const Solid& solid) {
  const std::vector<double> u = unwritten_zeros(solid.dof_count()), history = initial_history(solid);
  std::vector<double> f;
  solid.shared_nodes().resize(f);
  double least = std::numeric_limits<double>::infinity();
  const ThreadScope one(1);
  for (int i = 0; i < 2; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    solid.internal_force(u, f, {.history = history, .nodes = &solid.shared_nodes()});
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return least;
}

/// Of surfaces that move over each other, of both sides; the others cost next to nothing.
double contact_nodes(const Simulation& s) {
  if (s.contact().is_fixed()) return 0.0;
  std::vector<bool> touches(s.mesh().node_count());
  for (const ContactDefinition& contact : s.model().contacts) {
    const ContactParts parts = parts_of(contact);
    for (const Surface* surface : {parts.own, parts.other})
      if (surface != nullptr)
        for (const Facet& facet : surface->facets)
          for (const Index n : facet) touches[static_cast<std::size_t>(n)] = true;
  }
  return static_cast<double>(std::count(touches.begin(), touches.end(), true));
}

bool is_plane(const Model& model) {
  return std::ranges::none_of(model.parts, [](const Part& p) { return p.section == Section::solid; });
}

struct Factor {
  double bytes, operations;
};

Factor factor_of(double nodes, bool is_plane) {
  constexpr double block = 72.0;
  if (is_plane) return {8.0 * nodes * std::log2(nodes + 1.0) * block, 30.0 * std::pow(nodes, 1.5)};
  return {8.0 * std::pow(nodes, 4.0 / 3.0) * block, 25.0 * nodes * nodes};
}

double iteration_seconds(const Stage& stage, const Simulation& s, double bodies) {
  constexpr double bytes_a_second = 5e9, operations_a_second = 8e9;
  const bool is_linear = s.solid().is_linear();
  const double nodes = static_cast<double>(s.mesh().node_count());
  if (!has_factor(stage)) return 100.0 * bodies;
  const Factor factor = factor_of(nodes, is_plane(stage.model()));
  const double solve = 2.0 * factor.bytes / bytes_a_second;
  return bodies + solve + (is_linear ? 0.0 : 60.0 * bodies + factor.operations / operations_a_second);
}

}  // namespace

double contact_cut(const Stage& stage, const Simulation& s) {
  const SchemeSettings& settings = stage.settings();
  const bool is_cut = is_explicit(settings.kind) && traits(settings.enforcement).adds_stiffness && !stage.time().step &&
                      s.contact().slots() > 0 && !s.contact().is_fixed();
  if (!is_cut) return 1.0;
  return has_friction(s.model()) ? 2.1 : 1.2;
}

long long expected_steps(const Stage& stage, const Simulation& s) {
  return std::llround(static_cast<double>(stage.steps()) * contact_cut(stage, s));
}

double stage_seconds(const Stage& stage, const Simulation& s) {
  const double bodies = seconds_of_bodies(s.solid()), touching = contact_nodes(s);
  const double steps =
      static_cast<double>(expected_steps(stage, s)) * static_cast<double>(parts_of_step(stage.settings().kind));
  if (is_explicit(stage.settings().kind)) {
    const double per_node = traits(stage.settings().enforcement).adds_stiffness ? 8e-6 : 2e-5;
    return steps * (bodies + 3e-8 * static_cast<double>(s.mesh().node_count()) + per_node * touching);
  }
  const double iterations = s.solid().is_linear() && touching == 0.0 ? 1.0 : 4.0;
  return steps * iterations * (iteration_seconds(stage, s, bodies) + 1.5e-5 * touching);
}

}  // namespace carom
