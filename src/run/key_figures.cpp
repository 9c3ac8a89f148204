#include "run/key_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "math/vec3.hpp"
#include "math/voigt.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

constexpr long long instants = 200;

long long stress_interval(const Simulation& simulation) {
  const auto is_explicit_stage = [](const auto& stage) { return is_explicit(stage->settings().kind); };
  const auto& stages = simulation.stages();
  const long long least = std::any_of(stages.begin(), stages.end(), is_explicit_stage) ? 10 : 1;
  return std::max(least, (simulation.steps() + instants - 1) / instants);
}

}  // namespace

KeyFigures::KeyFigures(const Simulation& simulation)
    : simulation_(simulation), stress_every_(stress_interval(simulation)) {}

std::vector<Vec3> KeyFigures::velocities(const std::vector<double>& v) const {
  const Solid& solid = simulation_.solid();
  std::vector<Vec3> out;
  std::size_t first = 0;  // the cells stand part after part
  for (const Part& part : simulation_.model().parts) {
    const auto of_part = parallel_sums<4>(part.cells.size(), [&](std::size_t c, std::array<double, 4>& sums) {
      const auto nodes = solid.nodes_of_cell(first + c);
      const double volume = solid.cell_volumes()[first + c], share = volume / static_cast<double>(nodes.size());
      for (const Index n : nodes)
        for (std::size_t i = 0; i < 3; ++i) sums[i] += share * v[3 * static_cast<std::size_t>(n) + i];
      sums[3] += volume;
    });
    out.push_back(scaled({of_part[0], of_part[1], of_part[2]}, 1.0 / of_part[3]));
    first += part.cells.size();
  }
  return out;
}

void KeyFigures::look_at_stress(const StepView& view) {
  const Solid& solid = simulation_.solid();
  const auto [largest, worst] = solid.largest_stress(view.state.q, view.points(), von_mises);
  std::size_t end_of_part = 0;
  ++stress_.instants;
  if (!(largest > stress_.value)) return;
  const Mesh& mesh = simulation_.mesh();
  stress_.value = largest;
  stress_.time = view.state.t;
  for (const Part& part : simulation_.model().parts) {
    end_of_part += part.cells.size();
    stress_.part = part.name;
    if (worst < end_of_part) break;
  }
  const CellRef cell = solid.cells()[worst];
  stress_.cell = mesh.blocks[static_cast<std::size_t>(cell.block)].file_numbers[static_cast<std::size_t>(cell.cell)];
  stress_.position = {};
  const auto nodes = solid.nodes_of_cell(worst);
  for (const Index n : nodes)
    stress_.position = add(stress_.position, scaled(mesh.coordinates[static_cast<std::size_t>(n)],
                                                    1.0 / static_cast<double>(nodes.size())));
}

bool KeyFigures::is_static(double t) const {
  const auto& stages = simulation_.stages();
  const double slack = 1e-9 * simulation_.end();
  const auto now = std::find_if(stages.begin(), stages.end(), [&](const auto& s) { return t <= s->end() + slack; });
  return now != stages.end() && (*now)->settings().kind == SchemeKind::statics;
}

void KeyFigures::sample(const StepView& view, bool is_last) {
  if (begin_.empty() && !is_static(view.state.t)) begin_ = velocities(view.state.v);
  if (is_last) end_ = velocities(view.state.v);
  if (view.step == last_step_ || !(is_last || view.step % stress_every_ == 0)) return;
  last_step_ = view.step;
  look_at_stress(view);
}

std::vector<PartSummary> KeyFigures::parts() const {
  std::vector<PartSummary> out;
  auto volume = simulation_.solid().cell_volumes().begin();
  for (std::size_t p = 0; p < end_.size(); ++p) {
    const Part& part = simulation_.model().parts[p];
    const auto end = volume + static_cast<std::ptrdiff_t>(part.cells.size());
    const double mass = part.material.rho * std::accumulate(volume, end, 0.0);
    out.push_back({part.name, mass, begin_.empty() ? end_[p] : begin_[p], end_[p]});
    volume = end;
  }
  return out;
}

}  // namespace carom
