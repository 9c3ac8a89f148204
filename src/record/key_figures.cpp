#include "record/key_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "math/voigt.hpp"
#include "parallel/threads.hpp"
#include "solid/cell_values.hpp"

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
  const std::vector<Part>& parts = simulation_.model().parts;
  const std::vector<Index> numbers = simulation_.model().part_numbers();
  std::vector<std::array<double, 4>> sums_of;
  std::size_t first = 0;  // the cells stand part after part
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto of_part = parallel_sums<4>(parts[p].cells.size(), [&](std::size_t c, std::array<double, 4>& sums) {
      const auto nodes = solid.cells().nodes_of(first + c);
      const double volume = solid.cells().volumes[first + c], share = volume / static_cast<double>(nodes.size());
      for (const Index n : nodes)
        for (std::size_t i = 0; i < 3; ++i) sums[i] += share * v[3 * static_cast<std::size_t>(n) + i];
      sums[3] += volume;
    });
    if (at(numbers[p]) == sums_of.size()) sums_of.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) sums_of.back()[i] += of_part[i];
    first += parts[p].cells.size();
  }
  std::vector<Vec3> out;
  for (const auto& sums : sums_of) out.push_back(scaled({sums[0], sums[1], sums[2]}, 1.0 / sums[3]));
  return out;
}

void KeyFigures::look_at_stress(const StepView& view) {
  const Solid& solid = simulation_.solid();
  const auto [largest, worst] = largest_stress(solid, view.state.q, view.points(), von_mises);
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
  const auto nodes = solid.cells().nodes_of(worst);
  for (const Index n : nodes)
    stress_.position = add(stress_.position, scaled(mesh.coordinates[static_cast<std::size_t>(n)],
                                                    1.0 / static_cast<double>(nodes.size())));
}

bool KeyFigures::is_static(double t) const {
  const auto& stages = simulation_.stages();
  const double slack = 1e-9 * simulation_.end();
  const auto now = std::find_if(stages.begin(), stages.end(), [&](const auto& s) { return t <= s->end() + slack; });
  return now != stages.end() && !has_inertia((*now)->settings().kind);
}

void KeyFigures::sample(const StepView& view, bool is_last) {
  const bool begins = begin_.empty() && !is_static(view.state.t);
  if (begins || is_last) view.shared.collect_velocities();
  if (begins) begin_ = velocities(view.state.v);
  if (is_last) end_ = velocities(view.state.v);
  if (begins || is_last) view.shared.release();
  if (view.step == last_step_ || !(is_last || view.step % stress_every_ == 0)) return;
  last_step_ = view.step;
  look_at_stress(view);
}

namespace {

/// By part: the mass that its rigid body has over that of the body's cells; 1 where it deforms.
std::vector<double> rigid_shares(const Simulation& s) {
  const Model& model = s.model();
  std::vector<double> of_cells(model.turning_bodies.size(), 0.0), shares;
  auto volume = s.solid().cells().volumes.begin();
  for (const Part& part : model.parts) {
    const auto end = volume + static_cast<std::ptrdiff_t>(part.cells.size());
    if (part.rigid_body >= 0) of_cells[at(part.rigid_body)] += part.material.rho * sum_of({volume, end});
    volume = end;
  }
  for (const Part& part : model.parts)
    shares.push_back(
        part.rigid_body < 0 ? 1.0 : model.turning_bodies[at(part.rigid_body)].mass / of_cells[at(part.rigid_body)]);
  return shares;
}

}  // namespace

std::vector<PartSummary> KeyFigures::parts() const {
  std::vector<PartSummary> out;
  auto volume = simulation_.solid().cells().volumes.begin();
  if (end_.empty()) return out;
  const std::vector<Part>& parts = simulation_.model().parts;
  const std::vector<Index> numbers = simulation_.model().part_numbers();
  const std::vector<double> shares = rigid_shares(simulation_);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::size_t k = at(numbers[p]);
    if (k == out.size()) out.push_back({parts[p].name, 0.0, begin_.empty() ? end_[k] : begin_[k], end_[k]});
    const auto end = volume + static_cast<std::ptrdiff_t>(parts[p].cells.size());
    out[k].mass += shares[p] * parts[p].material.rho * sum_of({volume, end});
    volume = end;
  }
  return out;
}

}  // namespace carom
