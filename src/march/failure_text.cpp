#include "march/failure_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "march/folded_cells.hpp"
#include "march/inside_out.hpp"
#include "math/vec3.hpp"
#include "schemes/scheme_table.hpp"

namespace carom {

std::string worst_place(const System& s, const State& state) {
  std::size_t worst = 0;
  double fastest = -1.0;
  std::vector<double> v = state.v;
  s.solid.shared_nodes().complete(v);
  for (std::size_t n = 0; n < s.mesh.node_count(); ++n) {
    const double speed = norm(vector_at(v, n));
    if (speed <= fastest) continue;
    worst = n;
    fastest = speed;
    if (!std::isfinite(speed)) break;
  }
  const Vec3& x = s.mesh.coordinates[worst];
  std::string text = fmt::format("worst node {} at ({:.4g}, {:.4g}, {:.4g}), speed {:.4g}",
                                 s.mesh.node_label(static_cast<Index>(worst)), x[0], x[1], x[2], fastest);
  for (std::size_t k = 0; k < s.solid.cells().size(); ++k) {
    const auto nodes = s.solid.cells().nodes_of(k);
    if (std::find(nodes.begin(), nodes.end(), static_cast<Index>(worst)) == nodes.end()) continue;
    const CellRef cell = s.solid.cells()[k];
    return text + fmt::format(", in cell {}", s.mesh.cell_label(cell));
  }
  return text;
}

std::string energy_remedy(const Stage& stage) {
  const SchemeSettings& scheme = stage.settings();
  const bool has_springs = traits(scheme.enforcement).adds_stiffness && stage.system().contact.slots() > 0;
  std::string text = !stage.time().step ? "Lower time.safety"
                     : is_explicit(scheme.kind)
                         ? "Leave time.step out, so that steps follow the stable one, or lower it"
                         : "Lower time.step";
  if (has_springs) text += " or contact.stiffness (contact.stiffness_factor)";
  if (!is_explicit(scheme.kind)) text += ", or choose a scheme that dissipates or conserves energy";
  return text;
}

std::string touch_remedy(const Stage& stage) {
  const std::optional<double> rebound = touch_rebound(stage.settings());
  if (!rebound || *rebound <= largest_touch_rebound) return {};
  return fmt::format(
      "{} with plain multipliers throws a node that touches for one step back with up to {:.3g} times its speed, and "
      "so makes energy where touches are short; enforcement = \"lagrange\", which stops what touches, does not",
      describe(stage.settings()), *rebound);
}

std::string with_cell(const std::string& failure, const Simulation& s, std::span<const double> u,
                      std::span<const std::uint8_t> alive) {
  if (std::string inverted = inside_out(s, u, alive); !inverted.empty()) return inverted;
  if (u.size() != s.solid().dof_count()) return failure;
  const FlattestCorner corner = flattest_corner(s, u, alive);
  return corner.is_folded() ? failure + "; on the way " + describe_fold(s, corner, u) : failure;
}

std::string place_and_remedy(const Simulation& s, const Stage& stage, const State& state) {
  if (const FlattestCorner corner = flattest_corner(s, state.q, state.alive()); corner.is_folded())
    return describe_fold(s, corner, state.q);
  const std::string remedy = s.given().contacts.empty() ? "" : touch_remedy(stage);
  return worst_place(stage.system(), state) + ". " + (remedy.empty() ? energy_remedy(stage) : remedy);
}

}  // namespace carom
