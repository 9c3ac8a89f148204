// Internal force of HEXA8 with gather and scatter, small and finite strain, in cells per second, for each instruction
// set and formulation; and the tangent action.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "mesh/renumber.hpp"
#include "mesh/structured_block.hpp"
#include "parallel/threads.hpp"
#include "solid/element_table.hpp"
#include "solid/solid.hpp"

namespace carom {
namespace {

/// Cube of n^3 cells numbered naturally, inner nodes moved by up to a tenth of an edge: no two cells are alike.
Mesh natural_cube(int n) {
  StructuredBlock block;
  block.size = {1.0, 1.0, 1.0};
  block.divisions = {n, n, n};
  block.face_groups = {};
  Mesh mesh = make_structured_blocks({block});
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> move(-0.1 / n, 0.1 / n);
  for (Vec3& x : mesh.coordinates) {
    const bool inside = std::all_of(x.begin(), x.end(), [](double c) { return c > 0.0 && c < 1.0; });
    for (double& component : x) component += inside ? move(generator) : 0.0;
  }
  return mesh;
}

/// The same mesh with nodes and cells in random order.
Mesh shuffled(Mesh mesh) {
  std::mt19937 generator(2);
  const auto random_order = [&](std::size_t n) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), generator);
    return order;
  };
  const auto node = random_order(mesh.node_count()), cell = random_order(mesh.blocks[0].size());
  Mesh result = mesh;
  for (std::size_t n = 0; n < node.size(); ++n) result.coordinates[node[n]] = mesh.coordinates[n];
  for (std::size_t c = 0; c < cell.size(); ++c)
    for (std::size_t a = 0; a < 8; ++a)
      result.blocks[0].connectivity[8 * cell[c] + a] =
          static_cast<Index>(node[static_cast<std::size_t>(mesh.blocks[0].connectivity[8 * c + a])]);
  result.node_groups.clear();
  result.cell_groups.clear();
  return result;
}

Model one_part(Mesh mesh, const Material& material, Formulation formulation = Formulation::full) {
  Model model;
  Part part{.name = "cube", .cells = {}, .material = material, .formulation = formulation};
  part.cells.resize(mesh.blocks[0].size());
  std::iota(part.cells.begin(), part.cells.end(), Index{0});
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.parts.push_back(std::move(part));
  return model;
}

constexpr LinearElastic steel{{.E = 2.0e11, .nu = 0.3, .rho = 7800.0}};

/// Calls kernel(solid, u, f) again and again with small random displacements u.
template <class Kernel>
void measure(benchmark::State& state, const Model& model, Isa isa, const Kernel& kernel) {
  const Solid solid(model, isa);
  std::vector<double> u(solid.dof_count()), f(solid.dof_count());
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> value(-1e-3, 1e-3);
  for (double& entry : u) entry = value(generator);
  for (auto _ : state) {
    kernel(solid, u, f);
    benchmark::DoNotOptimize(f.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(solid.cell_count()));
}

template <class Kernel>
void add_benchmarks(const std::string& name_of_kernel, const std::shared_ptr<const Model>& model,
                    const Kernel& kernel) {
  for (const Isa isa : {Isa::reference, Isa::x86_64_v2, Isa::x86_64_v3, Isa::x86_64_v4}) {
    if (!supported(isa)) continue;
    benchmark::RegisterBenchmark(
        (name_of_kernel + "/" + std::string(name(isa))).c_str(),
        [model, isa, kernel](benchmark::State& state) { measure(state, *model, isa, kernel); });
  }
}

void add_all_benchmarks() {
  set_threads(1);
  using Dofs = std::vector<double>;
  const auto force = [](const Solid& solid, const Dofs& u, Dofs& f) { solid.internal_force(u, f); };
  const auto tangent = [](const Solid& solid, const Dofs& u, Dofs& f) { solid.tangent_action(u, u, f); };
  const auto discrete = [](const Solid& solid, const Dofs& u, Dofs& f) {
    static const Dofs rest(u.size(), 0.0);
    solid.discrete_gradient_force(rest, u, f);
  };
  const auto model = [](Mesh mesh, const Material& material, Formulation formulation = Formulation::full) {
    return std::make_shared<const Model>(one_part(std::move(mesh), material, formulation));
  };
  add_benchmarks("internal_force/12^3 in cache", model(natural_cube(12), steel), force);
  add_benchmarks("internal_force/64^3 natural", model(natural_cube(64), steel), force);
  add_benchmarks("internal_force/64^3 shuffled, renumbered", model(renumbered(shuffled(natural_cube(64))), steel),
                 force);
  const Material laws[] = {StVenantKirchhoff{steel}, NeoHookean{steel}};
  const std::string law_names[] = {"St. Venant-Kirchhoff", "neo-Hookean"};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto cube = model(natural_cube(12), laws[k]);
    add_benchmarks("internal_force/12^3 in cache/" + law_names[k], cube, force);
    add_benchmarks("tangent_action/12^3 in cache/" + law_names[k], cube, tangent);
    add_benchmarks("discrete_gradient_force/12^3 in cache/" + law_names[k], cube, discrete);
  }
  for (const Formulation formulation : {Formulation::mean_dilatation, Formulation::one_point}) {
    const std::string name_of_formulation(name(formulation));
    for (const Material& law : {Material(steel), Material(NeoHookean{steel})}) {
      const auto cube = model(natural_cube(12), law, formulation);
      const std::string of = "/12^3 in cache/" + name_of_formulation + "/" + law.law->name;
      add_benchmarks("internal_force" + of, cube, force);
      add_benchmarks("tangent_action" + of, cube, tangent);
    }
  }
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  carom::add_all_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
}
