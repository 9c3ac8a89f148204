// The sweeps over the cells of the cases that are named on the command line, on one thread, for each instruction set:
// cells per second beside flops and bytes of a cell. "<case>/force/...": what explicit steps call, internal force with
// energies and the history of the points; "<case>/tangent/...": what an iteration of an implicit step calls.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "build/build_mesh.hpp"
#include "build/build_model.hpp"
#include "casefile/read_case.hpp"
#include "flops.hpp"
#include "parallel/threads.hpp"
#include "solid/point_history.hpp"
#include "solid/smallest_cell.hpp"
#include "solid/solid.hpp"

namespace carom {
namespace {

/// The bodies of a case, at rest until the step that ends at u.
struct Bodies {
  Model model;
  std::vector<double> u;
};

/// Displacements that strain the cells by about a hundredth.
Bodies read_bodies(const std::string& path) {
  const Case given = read_case(path);
  Bodies result{build_model(given, std::make_shared<const Mesh>(build_mesh(given))), {}};
  const Solid solid(result.model, Isa::reference);
  result.u.resize(solid.dof_count());
  std::mt19937 generator(1);
  const double h = smallest_cell(solid);
  std::uniform_real_distribution<double> value(-0.005 * h, 0.005 * h);
  for (double& entry : result.u) entry = value(generator);
  return result;
}

/// Bytes of a cell if every array were read once, and what is written once too: node numbers, `vectors` of the nodes
/// (coordinates among them), `histories` of the points.
double bytes_per_cell(const Solid& solid, int vectors, int histories) {
  std::size_t corners = 0;
  for (std::size_t k = 0; k < solid.cells().size(); ++k) corners += solid.cells().nodes_of(k).size();
  const std::size_t doubles =
      static_cast<std::size_t>(vectors) * solid.dof_count() + static_cast<std::size_t>(histories) * history_size(solid);
  return static_cast<double>(sizeof(double) * doubles + sizeof(Index) * corners) /
         static_cast<double>(solid.cells().size());
}

void measure(benchmark::State& state, const Bodies& bodies, Sweep sweep, Isa isa) {
  const Solid solid(bodies.model, isa);
  const std::vector<double> history = initial_history(solid);
  std::vector<double> end(history), f(bodies.u.size());
  const PointStep step{.dt = 1e-6, .history = history};
  for (auto _ : state) {
    if (sweep == Sweep::force)
      benchmark::DoNotOptimize(solid.evaluate(bodies.u, step, f, end));
    else
      solid.tangent_action(bodies.u, bodies.u, f, step);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(solid.cells().size()));
  const bool is_force = sweep == Sweep::force;
  state.counters["flops_per_cell"] = flops_per_cell(bodies.model, bodies.u, sweep);
  state.counters["bytes_per_cell"] = bytes_per_cell(solid, is_force ? 4 : 5, is_force ? 2 : 1);
}

void add_benchmarks(const std::string& path) {
  const auto bodies = std::make_shared<const Bodies>(read_bodies(path));
  const std::string stem = std::filesystem::path(path).stem().string();
  for (const auto& [sweep, text] : {std::pair{Sweep::force, "force"}, {Sweep::tangent, "tangent"}})
    for (const Isa isa : {Isa::reference, Isa::x86_64_v2, Isa::x86_64_v3, Isa::x86_64_v4})
      if (supported(isa))
        benchmark::RegisterBenchmark(
            (stem + "/" + text + "/" + std::string(name(isa))).c_str(),
            [bodies, sweep = sweep, isa](benchmark::State& state) { measure(state, *bodies, sweep, isa); });
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  carom::set_threads(1);
  for (int k = 1; k < argc; ++k) carom::add_benchmarks(argv[k]);
  benchmark::RunSpecifiedBenchmarks();
}
