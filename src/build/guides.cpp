#include "build/guides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "math/vec3.hpp"

namespace carom {

namespace {

using Weights = std::array<double, 4>;
constexpr const char* axis_names = "xyz";

/// Of the nodes in the material direction that is e_k at first.
Weights direction_weights(const TurningBody& body, std::size_t k) {
  Weights w{};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t i = 0; i < 3; ++i) w[a] += body.axes[i][k] * corner_signs[a][i] / (4.0 * body.radii[i]);
  return w;
}

Weights opposite(Weights w) {
  for (double& each : w) each = -each;
  return w;
}

}  // namespace

void add_guide(const CaseGuide& guide, const TurningBody& body, const Location& where, Model& model) {
  // A sum over the weighted nodes of each component; the dependent displacement has the largest coefficient.
  const auto hold = [&](const std::string& held, std::initializer_list<std::pair<std::size_t, Weights>> components) {
    LinearEquation equation;
    equation.name = fmt::format("the guide of rigid body \"{}\" {}", body.name, held);
    equation.where = where;
    for (const auto& [c, w] : components)
      for (std::size_t a = 0; a < 4; ++a)
        if (w[a] != 0.0) equation.terms.push_back({body.nodes[a], static_cast<int>(c), w[a]});
    const auto size = [](const LinearEquation::Term& term) { return std::abs(term.coefficient); };
    std::iter_swap(equation.terms.begin(), std::ranges::max_element(equation.terms, {}, size));
    model.equations.push_back(std::move(equation));
  };
  if (guide.blocked) {
    const Weights point = corner_weights(body, guide.blocked_at ? **guide.blocked_at : body.centre);
    for (std::size_t c = 0; c < 3; ++c)
      if (guide.holds_along(c)) hold(fmt::format("along {}", axis_names[c]), {{c, point}});
  }
  if (!guide.blocked_turns) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    if (!guide.holds_about(k)) {  // the one axis that it may turn about
      const Weights axis = direction_weights(body, k);
      hold(fmt::format("about {}", axis_names[j]), {{i, axis}});
      hold(fmt::format("about {}", axis_names[i]), {{j, axis}});
      return;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    hold(fmt::format("about {}", axis_names[k]),
         {{j, direction_weights(body, i)}, {i, opposite(direction_weights(body, j))}});
  }
}

void refuse_guided_motion(const CaseGuide& guide, const std::string& section, const std::string& name,
                          const Vec3& centre, const Vec3& velocity, const Vec3& angular_velocity) {
  constexpr double rounding = 1e-9;
  const auto refuse = [&](const Location& where, const char* key, const char* way, std::size_t c, double speed) {
    throw CaseError(
        where, section + "." + key,
        fmt::format("\"{}\" held {} {}, where its initial velocities give it {:.4g}", name, way, axis_names[c], speed),
        "velocities that its guide allows",
        fmt::format("Give it none {} {}, or let it move there.", way, axis_names[c]));
  };
  const Vec3 arm = guide.blocked_at ? subtract(**guide.blocked_at, centre) : Vec3{};
  const Vec3 v = add(velocity, cross(angular_velocity, arm));
  const double largest = norm(velocity) + norm(angular_velocity) * norm(arm);
  for (std::size_t c = 0; c < 3; ++c) {
    if (guide.holds_along(c) && std::abs(v[c]) > rounding * largest)
      refuse(guide.blocked->where, "blocked", "along", c, v[c]);
    if (guide.holds_about(c) && std::abs(angular_velocity[c]) > rounding * norm(angular_velocity))
      refuse(guide.blocked_turns->where, "blocked_turns", "about", c, angular_velocity[c]);
  }
}

}  // namespace carom
