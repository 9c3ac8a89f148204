#include "solid/solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/types.hpp"
#include "parallel/threads.hpp"
#include "solid/projected_stiffness.hpp"
#include "solid/solid_impl.hpp"

namespace carom {

const KernelTable& kernels(Isa isa) {
  switch (isa) {
    case Isa::x86_64_v2:
      return kernels_v2();
    case Isa::x86_64_v3:
      return kernels_v3();
    case Isa::x86_64_v4:
      return kernels_v4();
    case Isa::reference:
      break;
  }
  return kernels_reference();
}

namespace {

/// A batch filled up with one cell of a block, a position in it.
struct OneCell {
  std::vector<Index> offset;
  std::vector<double> history, length;
  CellBatches batch;

  OneCell(const SolidCells& cells, const Block& block, Index cell, const PointStep& step)
      : offset(block.places() * block.lanes()), history(cells.repeated_history(block, cell, step)) {
    const std::size_t lanes = block.lanes(), first = at(cell) / lanes * lanes;
    for (std::size_t a = 0; a < block.places(); ++a)
      std::fill_n(offset.begin() + static_cast<std::ptrdiff_t>(a * lanes), lanes,
                  block.offset[(first * block.places()) + a * lanes + at(cell) % lanes]);
    batch = cells.batches(block, 0, 1, step);
    batch.offset = offset.data();
    if (!history.empty()) batch.history = history.data();
    if (!block.length.empty()) length.assign(lanes, block.length[at(cell)]);
    if (!length.empty()) batch.length = length.data();
  }
  OneCell(const OneCell&) = delete;
  OneCell& operator=(const OneCell&) = delete;
};

}  // namespace

Solid::Solid(const Model& model, Isa isa) : impl_(std::make_unique<Impl>(model, isa)) {}
Solid::~Solid() = default;
Solid::Solid(Solid&&) noexcept = default;

std::size_t Solid::node_count() const {
  return impl_->solid.mesh->node_count();
}
std::size_t Solid::cell_count() const {
  return impl_->solid.cells.size();
}
Isa Solid::isa() const {
  return impl_->isa;
}
bool Solid::is_linear() const {
  return impl_->solid.are_linear() && impl_->patches.cells.are_linear() &&
         std::ranges::all_of(impl_->others, [](const Contributor* each) { return each->is_linear(); });
}
bool Solid::has_hourglass() const {
  return impl_->solid.have_modes() || !impl_->patches.empty();
}
const std::vector<Spring>& Solid::springs() const {
  return impl_->springs.all();
}
const CohesiveZones& Solid::cohesive() const {
  return impl_->cohesive;
}
const std::vector<CellRef>& Solid::cells() const {
  return impl_->solid.cells;
}
std::span<const Index> Solid::nodes_of_cell(std::size_t k) const {
  return impl_->solid.nodes_of(k);
}
const std::vector<double>& Solid::cell_volumes() const {
  return impl_->volumes;
}
const std::vector<double>& Solid::cell_lengths() const {
  return impl_->lengths;
}

std::size_t Solid::history_size() const {
  return impl_->points_history_size() + impl_->cohesive.history_size();
}
std::vector<double> Solid::initial_history() const {
  return std::vector<double>(history_size(), 0.0);
}

SolidEnergies Solid::evaluate(std::span<const double> u, const PointStep& step, std::span<double> f,
                              std::span<double> end) const {
  std::vector<SolidEnergies> of_cells(impl_->solid.chunks.size()), of_patches(impl_->patches.cells.chunks.size());
  impl_->sum_over_chunks(
      f, [&](const SolidCells& cells, std::size_t c, const Block& block, std::span<const Chunk> runs, double* sum) {
        SolidEnergies& energies = (&cells == &impl_->solid ? of_cells : of_patches)[c];
        for (const Chunk& run : runs)
          if (!block.is_nodal())
            cells.add_living(run, step, end, std::array{u.data()}, sum,
                             [&](const CellBatches& batch, const std::array<const double*, 1>& own, double* into) {
                               block.kernels.add_internal_force(batch, block.law(), own[0], into, &energies);
                             });
        for (const Chunk& run : runs) energies.distortion += cells.add_distortion_force(run, u, f, step);
      });
  impl_->gather(of_cells, of_patches, end);
  SolidEnergies total;
  for (const std::vector<SolidEnergies>* partial : {&of_cells, &of_patches})
    for (const SolidEnergies& energies : *partial) total.add(energies);
  for (const Contributor* each : impl_->others) each->add_force(u, step, f, &total, end);
  return total;
}

void Solid::internal_force(std::span<const double> u, std::span<double> f, const PointStep& step) const {
  impl_->sum_over_chunks(
      f, [&](const SolidCells& cells, std::size_t, const Block& block, std::span<const Chunk> runs, double* sum) {
        for (const Chunk& run : runs)
          if (!block.is_nodal())
            cells.add_living(run, step, {}, std::array{u.data()}, sum,
                             [&](const CellBatches& batch, const std::array<const double*, 1>& own, double* into) {
                               block.kernels.add_internal_force(batch, block.law(), own[0], into, nullptr);
                             });
        for (const Chunk& run : runs) cells.add_distortion_force(run, u, f, step);
      });
  for (const Contributor* each : impl_->others) each->add_force(u, step, f, nullptr, {});
}

void Solid::add_internal_force_of(std::span<const Index> cells, std::span<const double> u, std::span<double> f,
                                  const PointStep& step, SolidEnergies* energies) const {
  std::vector<Index> of_patches;
  for (const Index cell : cells) {
    const Block& block = impl_->solid.block_of(at(cell));
    if (!block.is_nodal()) {
      const OneCell one(impl_->solid, block, cell - block.first, step);
      block.kernels.add_internal_force(one.batch, block.law(), u.data(), f.data(), energies);
    }
    if (!block.distortion.empty()) {
      const double energy = block.distortion.add_force(at(cell - block.first), u, f);
      if (energies != nullptr) energies->distortion += energy;
    }
    const std::span<const Index> own = impl_->patches.of(at(cell));
    of_patches.insert(of_patches.end(), own.begin(), own.end());
  }
  if (of_patches.empty()) return;
  std::sort(of_patches.begin(), of_patches.end());
  of_patches.erase(std::unique(of_patches.begin(), of_patches.end()), of_patches.end());
  std::vector<Index> wanted(cells.begin(), cells.end());
  std::sort(wanted.begin(), wanted.end());
  for (const Index patch : of_patches) {
    const Block& block = impl_->patches.cells.block_of(at(patch));
    const OneCell one(impl_->patches.cells, block, patch - block.first, step);
    std::array<unsigned char, most_patch_cells> is_wanted{};
    const std::span<const Index> own = impl_->patches.cells_of(at(patch));
    for (std::size_t e = 0; e < own.size(); ++e)
      is_wanted[e] = std::binary_search(wanted.begin(), wanted.end(), own[e]) ? 1 : 0;
    add_internal_force_of_parts(one.batch, block.law(), u.data(), is_wanted.data(), f.data());
  }
}

void Solid::tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                           const PointStep& step) const {
  impl_->sum_over_chunks(
      y, [&](const SolidCells& cells, std::size_t, const Block& block, std::span<const Chunk> runs, double* sum) {
        for (const Chunk& run : runs)
          if (!block.is_nodal())
            cells.add_living(run, step, {}, std::array{u.data(), x.data()}, sum,
                             [&](const CellBatches& batch, const std::array<const double*, 2>& own, double* into) {
                               block.kernels.add_tangent_action(batch, block.law(), own[0], own[1], into);
                             });
        for (const Chunk& run : runs) cells.add_distortion_action(run, u, x, y, step);
      });
  for (const Contributor* each : impl_->others) each->add_tangent_action(u, x, y, step);
}

void Solid::discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1,
                                    std::span<double> f) const {
  impl_->sum_over_chunks(
      f, [&](const SolidCells& cells, std::size_t, const Block& block, std::span<const Chunk> runs, double* sum) {
        for (const Chunk& run : runs)
          if (!block.is_nodal())
            block.kernels.add_discrete_gradient_force(cells.batches(run), block.law(), u_0.data(), u_1.data(), sum);
      });
  for (const Contributor* each : impl_->others) each->add_discrete_gradient_force(u_0, u_1, f);
}

CsrMatrix Solid::tangent(std::span<const double> u, const PointStep& step) const {
  CsrMatrix K = dof_graph(impl_->graph());
  impl_->for_each_stiffness(u, step, [&](std::span<const Index> nodes, std::span<const double> cell) {
    const std::size_t dofs = 3 * nodes.size();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b)
        for (std::size_t i = 0; i < 3; ++i) {
          double* row = K.value.data() + entry(K, 3 * nodes[a] + static_cast<Index>(i), 3 * nodes[b]);
          for (std::size_t j = 0; j < 3; ++j) row[j] += cell[(3 * a + i) * dofs + 3 * b + j];
        }
  });
  for (const Contributor* each : impl_->others) each->add_tangent(u, step, K);
  return K;
}

void Solid::project_tangent(std::span<const double> u, const PointStep& step, const Interpolation& P,
                            std::span<const std::uint8_t> fixed, BlockMatrix& coarse, BlockMatrix* fine) const {
  if (fine != nullptr && fine->column.empty()) {
    CsrMatrix graph = impl_->graph();
    fine->row_begin = std::move(graph.row_begin);
    fine->column = std::move(graph.column);
  }
  project_stiffness(std::array<const SolidCells*, 2>{&impl_->solid, &impl_->patches.cells}, u, step, P, fixed, coarse,
                    fine);
  if (impl_->others.empty()) return;
  CsrMatrix ties = impl_->tangent_of_others(u, step);
  if (fine != nullptr) {
    const BlockMatrix blocks = by_points(ties);
    for_each_block(blocks, [&](Index n, Index m, const double* block) {
      float* sum = fine->single_block(n, m);
      for (std::size_t c = 0; c < 9; ++c) sum[c] += static_cast<float>(block[c]);
    });
  }
  const auto is_fixed = [&](Index dof) { return (fixed[at(dof / 3)] >> (dof % 3) & 1U) != 0; };
  for (Index i = 0; i < ties.size; ++i)
    for (auto k = static_cast<std::size_t>(ties.row_begin[at(i)]);
         k < static_cast<std::size_t>(ties.row_begin[at(i) + 1]); ++k)
      if (is_fixed(i) || is_fixed(ties.column[k])) ties.value[k] = 0.0;
  BlockMatrix projected;
  galerkin(by_points(ties), P, projected);
  coarse = sum(coarse, projected);
}

double Solid::largest_change(std::span<const double> u_0, std::span<const double> u_1) const {
  const auto of_cell = [&](std::size_t k) {
    const auto nodes = nodes_of_cell(k);
    const auto moved = [&](Index n, std::size_t c) { return u_1[3 * at(n) + c] - u_0[3 * at(n) + c]; };
    double most = 0.0;
    for (const Index n : nodes) {
      double square = 0.0;
      for (std::size_t c = 0; c < 3; ++c) square += std::pow(moved(n, c) - moved(nodes[0], c), 2);
      most = std::max(most, square);
    }
    return std::sqrt(most) / impl_->lengths[k];
  };
  double of_others = 0.0;
  for (const Contributor* each : impl_->others) of_others = std::max(of_others, each->largest_change(u_0, u_1));
  return parallel_max(cells().size(), of_others, of_cell);
}

std::vector<double> Solid::tangent_diagonal(std::span<const double> u, const PointStep& step) const {
  std::vector<double> diagonal(dof_count(), 0.0);
  impl_->for_each_stiffness(u, step, [&](std::span<const Index> nodes, std::span<const double> cell) {
    const std::size_t dofs = 3 * nodes.size();
    for (std::size_t r = 0; r < dofs; ++r) diagonal[3 * at(nodes[r / 3]) + r % 3] += cell[r * (dofs + 1)];
  });
  for (const Contributor* each : impl_->others) each->add_tangent_diagonal(u, step, diagonal);
  return diagonal;
}

double Solid::energy_at_rest(std::size_t k, std::span<const Vec3> u) const {
  return impl_->solid.energy_at_rest(k, u);
}
double Solid::square_integral(std::size_t k, std::span<const double> f) const {
  return impl_->solid.square_integral(k, f);
}
double Solid::strain_energy(std::span<const double> u) const {
  std::vector<double> f(dof_count());
  return evaluate(u, {}, f, {}).strain;
}

double Solid::body_strain(std::span<const double> u) const {
  return impl_->turning_bodies.largest_strain(u);
}
void Solid::add_body_force_scale(std::span<double> f) const {
  impl_->turning_bodies.add_force_scale(f);
}

Index Solid::first_inverted_cell(std::span<const double> u, std::span<const std::uint8_t> alive) const {
  std::vector<double> f(dof_count(), 0.0);
  for (std::size_t k = 0; k < cell_count(); ++k) {
    if (!alive.empty() && alive[k] == 0) continue;
    const std::array<Index, 1> one{static_cast<Index>(k)};
    add_internal_force_of(one, u, f);
    bool is_finite = true;
    for (const Index n : nodes_of_cell(k))
      for (std::size_t c = 0; c < 3; ++c) is_finite = is_finite && std::isfinite(f[3 * at(n) + c]);
    if (!is_finite) return one[0];
  }
  return -1;
}

Mass Solid::mass(MassKind kind) const {
  if (kind == MassKind::lumped) return impl_->lumped_mass([](std::size_t) { return 1.0; });
  CsrMatrix M = node_graph(std::array<const SolidCells*, 1>{&impl_->solid});
  impl_->solid.for_each_cell([&](std::size_t c, const Block& block) {
    const NodeMatrix cell = block.mass(impl_->solid.coordinates_of(c), block.thickness, block.rho);
    const auto nodes = impl_->solid.nodes_of(c);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b)
        M.value[entry(M, nodes[a], nodes[b])] += cell[a * nodes.size() + b];
  });
  impl_->for_each_body_mass([&](Index node, double mass) { add_diagonal(M, node, mass); });
  return Mass(std::move(M));
}

Mass Solid::lumped_mass(std::span<const double> cell_factors) const {
  return impl_->lumped_mass([&](std::size_t c) { return cell_factors[c]; });
}

std::vector<double> Solid::cell_masses() const {
  std::vector<double> masses(cell_count());
  const auto add_up = [&](std::size_t c, std::span<const double> m) {
    masses[c] = std::accumulate(m.begin(), m.end(), 0.0);
  };
  impl_->solid.for_each_lumped_mass([&](std::size_t c, const Block&, std::span<const double> m) { add_up(c, m); });
  impl_->solid.for_each_rigid_batch([&](std::size_t first, const Block& block, const CellBatches& batch) {
    block.for_each_lumped_mass(batch, [&](std::size_t lane, std::span<const double> m) { add_up(first + lane, m); });
  });
  return masses;
}

std::vector<double> Solid::cell_frequency_bounds() const {
  return impl_->cell_frequency_bounds();
}

double Solid::largest_frequency_bound() const {
  return impl_->largest_bound();
}

double Solid::largest_damping(std::span<const double> history) const {
  return std::max(carom::largest_damping(impl_->solid, impl_->damping, history),
                  carom::largest_damping(impl_->patches.cells, impl_->patch_damping, history));
}

void Solid::external_force(double t, const Mass& mass, std::span<double> f) const {
  std::fill(f.begin(), f.end(), 0.0);
  for (const LoadVector& load : impl_->loads) {
    const double factor = load.factor(t);
    for (std::size_t k = 0; k < load.nodes.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) f[3 * at(load.nodes[k]) + i] += factor * load.force[k][i];
  }
  for (const Gravity& gravity : impl_->gravity) {
    const double factor = gravity.factor(t);
    const Vec3& g = gravity.acceleration;
    mass.add_gravity({factor * g[0], factor * g[1], factor * g[2]}, f);
  }
}

const std::vector<Index>& Solid::loaded_nodes() const {
  return impl_->loaded_nodes;
}

}  // namespace carom
