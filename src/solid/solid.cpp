#include "solid/solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/types.hpp"
#include "mesh/cell_size.hpp"
#include "parallel/threads.hpp"
#include "solid/assembly.hpp"
#include "solid/batch_gradients.hpp"
#include "solid/blocks.hpp"
#include "solid/congruent_cells.hpp"
#include "solid/kernels.hpp"
#include "solid/loads.hpp"
#include "solid/projected_stiffness.hpp"
#include "solid/springs.hpp"
#include "solid/turning_bodies.hpp"

namespace carom {
namespace {

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

}  // namespace

struct Solid::Impl {
  Impl(const Model& model, Isa wanted)
      : isa(wanted),
        solid(make_solid_cells(model, kernels(wanted))),
        loads(make_loads(model)),
        gravity(gravity_loads(model)),
        loaded_nodes(nodes_of_loads()),
        rigid_bodies(model.rigid_bodies),
        point_masses(model.point_masses),
        springs(model.springs),
        cohesive(model.cohesive, model.mesh->coordinates),
        volumes(solid.cells.size()),
        lengths(solid.cells.size()),
        turning_bodies(model.turning_bodies, any_free(model.turning_bodies) ? std::sqrt(largest_bound()) : 0.0) {
    solid.for_each_batch({}, [&](std::size_t first, const Block& block, const CellBatches& batch) {
      const BatchGradients at_rest(batch);
      for (Index l = 0; l < batch.cells; ++l) {
        const std::size_t c = first + at(l);
        volumes[c] = at_rest.volume(static_cast<int>(l));
        lengths[c] = cell_length(block.type, solid.coordinates_of(c));
      }
    });
    bound_damping();
    if (solid.control_distortion(volumes)) bounds_at_rest = frequency_bounds();
    cohesive.place_history(solid.history_size());
  }

  std::vector<Index> nodes_of_loads() const {
    std::vector<Index> nodes;
    if (!gravity.empty()) {
      nodes.resize(solid.mesh->node_count());
      std::iota(nodes.begin(), nodes.end(), Index{0});
      return nodes;
    }
    for (const LoadVector& load : loads) nodes.insert(nodes.end(), load.nodes.begin(), load.nodes.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  /// What springs, cohesive zones and turning bodies add to the tangent.
  CsrMatrix tangent_of_ties(std::span<const double> u, const PointStep& step) const {
    SolidCells no_cells;
    no_cells.mesh = solid.mesh;
    CsrMatrix graph = node_graph(no_cells, springs.all(), cohesive.links());
    turning_bodies.add_rows(graph);
    CsrMatrix ties = dof_graph(graph);
    springs.add_tangent(ties);
    cohesive.add_tangent(u, step, ties);
    turning_bodies.add_tangent(u, ties);
    return ties;
  }

  /// Calls add(node, mass) for the masses of points and rigid bodies.
  template <class Add>
  void for_each_body_mass(const Add& add) const {
    for (const PointMass& point : point_masses)
      for (const Index node : point.nodes) add(node, point.mass);
    for (const RigidBody& body : rigid_bodies) add(body.node, body.mass);
    for (const auto& [node, mass] : turning_bodies.masses()) add(node, mass);
  }
  /// Lumped mass, that of cell c times factor(c).
  template <class Factor>
  Mass lumped_mass(const Factor& factor) const {
    std::vector<double> m(solid.mesh->node_count(), 0.0);
    solid.for_each_lumped_mass([&](std::size_t c, const Block&, std::span<const double> of_cell) {
      const auto nodes = solid.nodes_of(c);
      for (std::size_t a = 0; a < nodes.size(); ++a) m[at(nodes[a])] += factor(c) * of_cell[a];
    });
    for_each_body_mass([&](Index node, double mass) { m[at(node)] += mass; });
    return Mass(std::move(m));
  }
  const Block& block(const Chunk& chunk) const { return solid.blocks[at(chunk.block)]; }
  CellBatches batches(const Chunk& chunk, const PointStep& step = {}, std::span<double> end = {}) const {
    return solid.batches(block(chunk), chunk.first, chunk.cells, step, end);
  }

  /// Upper bounds of the eigenvalues of M_e^-1 K_e (power_bound), K as batch_stiffness gives it.
  void batch_bounds(const CellBatches& batch, const Block& block, std::span<const double> K,
                    std::span<double> bounds) const {
    const std::size_t n = 3 * block.nodes(), lanes = block.lanes();
    std::array<double, most_nodes * most_lanes> root;
    block.stages.cell->lumped_mass(batch.x, batch.offset, block.thickness, block.rho, root.data());
    for (std::size_t k = 0; k < block.nodes() * lanes; ++k) root[k] = 1.0 / std::sqrt(root[k]);
    std::vector<double> A(K.size()), work(K.size());
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t r = 0; r < n; ++r)
        for (std::size_t s = 0; s < n; ++s)
          A[(n * r + s) * lanes + l] = root[r / 3 * lanes + l] * K[(n * l + r) * n + s] * root[s / 3 * lanes + l];
    std::array<double, most_lanes> bound{};
    kernels(isa).power_bound(static_cast<int>(n), A.data(), work.data(), bound.data());
    std::copy_n(bound.begin(), at(batch.cells), bounds.begin());
  }
  /// Of some cells of a block, positions in it.
  std::vector<double> frequency_bounds_of(const Block& block, std::span<const std::size_t> cells) const {
    const std::size_t lanes = block.lanes(), nodes = block.nodes();
    std::vector<double> bounds(cells.size()), K;
    std::array<Index, most_nodes * most_lanes> offset{};
    for (std::size_t begin = 0; begin < cells.size(); begin += lanes) {
      const std::size_t count = std::min(lanes, cells.size() - begin);
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t c = cells[begin + std::min(l, count - 1)];
        for (std::size_t a = 0; a < nodes; ++a)
          offset[a * lanes + l] = block.offset[(c / lanes * nodes + a) * lanes + c % lanes];
      }
      CellBatches batch = solid.batches(block, 0, static_cast<Index>(count));
      batch.offset = offset.data();
      batch_stiffness(batch, block.kernels, block.law(), block.is_symmetric, nullptr, K);
      batch_bounds(batch, block, K, std::span<double>(bounds).subspan(begin));
    }
    return bounds;
  }
  /// One for all cells of a chunk that have the same shape.
  std::vector<double> frequency_bounds() const {
    std::vector<double> bounds(solid.cells.size());
    solid.for_each_chunk([&](const Chunk& chunk) {
      const Block& own = block(chunk);
      CongruentCells shapes = congruent_cells(solid, own, chunk.first, chunk.cells);
      for (std::size_t& c : shapes.first) c += at(chunk.first);
      const std::vector<double> of_shape = frequency_bounds_of(own, shapes.first);
      for (std::size_t k = 0; k < shapes.of.size(); ++k)
        bounds[at(own.first + chunk.first) + k] = of_shape[shapes.of[k]];
    });
    return bounds;
  }
  /// Bounds of the eigenvalues of M^-1 C per cell: of a linear bulk viscosity of coefficient 1, and of the viscosity of
  /// hourglass modes. C is what the tangent of a step has more than that without one, times its length.
  void bound_damping() {
    const auto is_viscous = [](const Block& block) { return !block.length.empty(); };
    if (std::none_of(solid.blocks.begin(), solid.blocks.end(), is_viscous)) return;
    bulk_damping.assign(solid.cells.size(), 0.0);
    hourglass_damping = bulk_damping;
    solid.for_each_batch({}, [&](std::size_t first, const Block& block, const CellBatches& batch) {
      if (!is_viscous(block)) return;
      const auto bound = [&](const Viscosity& viscosity, std::vector<double>& bounds) {
        BatchStages stages = block.stages;
        stages.viscosity = viscosity;
        CellBatches viscous = batch;
        viscous.stages = &stages;
        std::vector<double> C, K;
        batch_stiffness(viscous, block.kernels, block.law(), block.is_symmetric, nullptr, K);
        viscous.viscous_dt = batch.length[0] / stages.wave_speed;
        batch_stiffness(viscous, block.kernels, block.law(), block.is_symmetric, nullptr, C);
        for (std::size_t k = 0; k < C.size(); ++k) C[k] = (C[k] - K[k]) * viscous.viscous_dt;
        batch_bounds(batch, block, C, std::span<double>(bounds).subspan(first));
      };
      if (block.stages.bulk != nullptr) bound({.linear = 1.0}, bulk_damping);
      if (block.stages.viscosity.hourglass > 0.0)
        bound({.hourglass = block.stages.viscosity.hourglass}, hourglass_damping);
    });
  }
  double largest_bound() const {
    const std::vector<double> bounds = frequency_bounds();
    return parallel_max(bounds.size(), 0.0, [&](std::size_t k) { return bounds[k]; });
  }

  /// Overwrites f with the sum over the chunks of add(chunk, block, f), colour by colour.
  template <class Add>
  void sum_over_chunks(std::span<double> f, const Add& add) const {
    constexpr std::size_t zeros_per_task = 1 << 15;
    parallel_for(f.size(), zeros_per_task,
                 [&](std::size_t begin, std::size_t end) { std::fill(f.data() + begin, f.data() + end, 0.0); });
    solid.for_each_chunk([&](const Chunk& chunk) { add(chunk, block(chunk), f.data()); });
  }

  Isa isa;
  SolidCells solid;
  std::vector<LoadVector> loads;
  std::vector<Gravity> gravity;
  std::vector<Index> loaded_nodes;
  std::vector<RigidBody> rigid_bodies;
  std::vector<PointMass> point_masses;
  Springs springs;
  CohesiveZones cohesive;
  std::vector<double> volumes, lengths;
  std::vector<double> bounds_at_rest;                   ///< frequency_bounds(), for distortion control
  std::vector<double> bulk_damping, hourglass_damping;  ///< empty without viscosity
  TurningBodies turning_bodies;
};

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
  return impl_->turning_bodies.empty() && impl_->cohesive.empty() && impl_->solid.are_linear();
}
bool Solid::has_hourglass() const {
  return impl_->solid.have_modes();
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
  return impl_->solid.history_size() + impl_->cohesive.history_size();
}
std::vector<double> Solid::initial_history() const {
  return std::vector<double>(history_size(), 0.0);
}

SolidEnergies Solid::evaluate(std::span<const double> u, const PointStep& step, std::span<double> f,
                              std::span<double> end) const {
  std::vector<SolidEnergies> partial(impl_->solid.chunks.size());
  impl_->sum_over_chunks(f, [&](const Chunk& chunk, const Block& block, double* sum) {
    SolidEnergies& energies = partial[at(&chunk - impl_->solid.chunks.data())];
    block.kernels.add_internal_force(impl_->batches(chunk, step, end), block.law(), u.data(), sum, &energies);
    energies.distortion = impl_->solid.add_distortion_force(chunk, u, f);
  });
  SolidEnergies total;
  for (const SolidEnergies& energies : partial) total.add(energies);
  impl_->springs.add_force(1.0, u, f);
  impl_->turning_bodies.add_internal_force(u, f);
  impl_->cohesive.add_force(u, step, f, &total, end);
  total.strain = total.strain + impl_->springs.energy(u) + impl_->turning_bodies.energy(u);
  return total;
}

void Solid::internal_force(std::span<const double> u, std::span<double> f, const PointStep& step) const {
  impl_->sum_over_chunks(f, [&](const Chunk& chunk, const Block& block, double* sum) {
    block.kernels.add_internal_force(impl_->batches(chunk, step), block.law(), u.data(), sum, nullptr);
    impl_->solid.add_distortion_force(chunk, u, f);
  });
  impl_->springs.add_force(1.0, u, f);
  impl_->cohesive.add_force(u, step, f, nullptr, {});
  impl_->turning_bodies.add_internal_force(u, f);
}

void Solid::add_internal_force_of(std::span<const Index> cells, std::span<const double> u, std::span<double> f,
                                  const PointStep& step) const {
  std::array<Index, most_nodes * most_lanes> offset{};  // one batch, filled up with one cell
  for (const Index cell : cells) {
    const Block& block = impl_->solid.block_of(at(cell));
    const auto nodes = impl_->solid.nodes_of(at(cell));
    for (std::size_t a = 0; a < nodes.size(); ++a)
      std::fill_n(offset.begin() + static_cast<std::ptrdiff_t>(a * block.lanes()), block.lanes(), 3 * nodes[a]);
    CellBatches batch = impl_->solid.batches(block, 0, 1, step);
    batch.offset = offset.data();
    const std::vector<double> history = impl_->solid.repeated_history(block, cell - block.first, step);
    if (!history.empty()) batch.history = history.data();
    const std::vector<double> length(block.length.empty() ? 0 : block.lanes(), impl_->lengths[at(cell)]);
    if (!length.empty()) batch.length = length.data();
    block.kernels.add_internal_force(batch, block.law(), u.data(), f.data(), nullptr);
    if (!block.distortion.empty()) block.distortion.add_force(at(cell - block.first), u, f);
  }
}

void Solid::tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                           const PointStep& step) const {
  impl_->sum_over_chunks(y, [&](const Chunk& chunk, const Block& block, double* sum) {
    block.kernels.add_tangent_action(impl_->batches(chunk, step), block.law(), u.data(), x.data(), sum);
    impl_->solid.add_distortion_action(chunk, u, x, y);
  });
  impl_->springs.add_force(1.0, x, y);
  impl_->cohesive.add_tangent_action(u, x, y, step);
  impl_->turning_bodies.add_tangent_action(u, x, y);
}

void Solid::discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1,
                                    std::span<double> f) const {
  impl_->sum_over_chunks(f, [&](const Chunk& chunk, const Block& block, double* sum) {
    block.kernels.add_discrete_gradient_force(impl_->batches(chunk), block.law(), u_0.data(), u_1.data(), sum);
  });
  impl_->springs.add_force(0.5, u_0, f);
  impl_->springs.add_force(0.5, u_1, f);
  impl_->turning_bodies.add_discrete_gradient_force(u_0, u_1, f);
}

CsrMatrix Solid::tangent(std::span<const double> u, const PointStep& step) const {
  CsrMatrix graph = node_graph(impl_->solid, impl_->springs.all(), impl_->cohesive.links());
  impl_->turning_bodies.add_rows(graph);
  CsrMatrix K = dof_graph(graph);
  impl_->solid.for_each_stiffness(u, step, [&](std::size_t c, const Block&, std::span<const double> cell) {
    const auto nodes = impl_->solid.nodes_of(c);
    const std::size_t dofs = 3 * nodes.size();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b)
        for (std::size_t i = 0; i < 3; ++i) {
          double* row = K.value.data() + entry(K, 3 * nodes[a] + static_cast<Index>(i), 3 * nodes[b]);
          for (std::size_t j = 0; j < 3; ++j) row[j] += cell[(3 * a + i) * dofs + 3 * b + j];
        }
  });
  impl_->springs.add_tangent(K);
  impl_->cohesive.add_tangent(u, step, K);
  impl_->turning_bodies.add_tangent(u, K);
  return K;
}

void Solid::project_tangent(std::span<const double> u, const PointStep& step, const Interpolation& P,
                            std::span<const std::uint8_t> fixed, BlockMatrix& coarse, BlockMatrix* fine) const {
  if (fine != nullptr && fine->column.empty()) {
    CsrMatrix graph = node_graph(impl_->solid, impl_->springs.all(), impl_->cohesive.links());
    impl_->turning_bodies.add_rows(graph);
    fine->row_begin = std::move(graph.row_begin);
    fine->column = std::move(graph.column);
  }
  project_stiffness(impl_->solid, u, step, P, fixed, coarse, fine);
  if (impl_->springs.empty() && impl_->turning_bodies.empty() && impl_->cohesive.empty()) return;
  CsrMatrix ties = impl_->tangent_of_ties(u, step);
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
  const double of_others =
      std::max(impl_->turning_bodies.largest_change(u_0, u_1), impl_->cohesive.largest_change(u_0, u_1));
  return parallel_max(cells().size(), of_others, of_cell);
}

std::vector<double> Solid::tangent_diagonal(std::span<const double> u, const PointStep& step) const {
  std::vector<double> diagonal(dof_count(), 0.0);
  impl_->solid.for_each_stiffness(u, step, [&](std::size_t c, const Block&, std::span<const double> cell) {
    const auto nodes = impl_->solid.nodes_of(c);
    const std::size_t dofs = 3 * nodes.size();
    for (std::size_t r = 0; r < dofs; ++r) diagonal[3 * at(nodes[r / 3]) + r % 3] += cell[r * (dofs + 1)];
  });
  impl_->springs.add_tangent_diagonal(diagonal);
  impl_->cohesive.add_tangent_diagonal(u, step, diagonal);
  impl_->turning_bodies.add_tangent_diagonal(u, diagonal);
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

Rotation Solid::largest_rotation(std::span<const double> u) const {
  std::vector<Rotation> partial(impl_->solid.chunks.size());
  parallel_for(partial.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    if (!block.small_strain) return;
    for (Index first = 0; first < chunk.cells; first += block.stages.lanes) {
      const BatchGradients gradients(impl_->solid.batches(block, chunk.first + first, 1), u.data());
      const Index count = std::min<Index>(block.stages.lanes, chunk.cells - first);
      follow_rotation(gradients, block.type, block.stages.lanes, static_cast<int>(count),
                      block.first + chunk.first + first, partial[c]);
    }
  });
  Rotation largest;
  for (const Rotation& rotation : partial)
    if (rotation.angle > largest.angle) largest = rotation;
  return largest;
}

Index Solid::first_inverted_cell(std::span<const double> u) const {
  std::vector<double> f(dof_count(), 0.0);
  for (std::size_t k = 0; k < cell_count(); ++k) {
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
  CsrMatrix M = node_graph(impl_->solid);
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
  impl_->solid.for_each_lumped_mass([&](std::size_t c, const Block&, std::span<const double> m) {
    masses[c] = std::accumulate(m.begin(), m.end(), 0.0);
  });
  return masses;
}

std::vector<double> Solid::cell_frequency_bounds() const {
  return impl_->frequency_bounds();
}

double Solid::largest_frequency_bound() const {
  return impl_->largest_bound();
}

void Solid::frequency_growth(std::span<const double> u, const PointStep& step, std::span<double> growth) const {
  parallel_for(impl_->solid.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    const std::span<double> own = growth.subspan(at(block.first + chunk.first), at(chunk.cells));
    if (block.small_strain) return std::fill(own.begin(), own.end(), 1.0);
    wave_modulus(impl_->batches(chunk, step), block.law(), u.data(), own.data());
    for (std::size_t k = 0; k < own.size(); ++k) {
      const std::size_t cell = at(block.first + chunk.first) + k;
      const CellNodes x = impl_->solid.coordinates_of(cell, u);
      const double shortening =
          impl_->lengths[cell] / cell_length(block.type, std::span<const Vec3>(x).first(block.nodes()));
      own[k] *= shortening * shortening / block.wave_modulus;
    }
    impl_->solid.add_distortion_growth(chunk, u, impl_->bounds_at_rest, own);
  });
}

double Solid::largest_damping(std::span<const double> history) const {
  double largest = 0.0;
  for (const Block& block : impl_->solid.blocks) {
    if (block.length.empty()) continue;
    const Viscosity& viscosity = block.stages.viscosity;
    const double quadratic = 2.0 * viscosity.quadratic * viscosity.quadratic / block.stages.wave_speed;
    const auto of_cell = [&](std::size_t c) {
      double closing = 0.0;
      if (block.stages.bulk != nullptr && !history.empty()) closing = std::max(0.0, -block.bulk_speed(c, history));
      const std::size_t position = at(block.first) + c;
      return impl_->bulk_damping[position] * (viscosity.linear + quadratic * closing) +
             impl_->hourglass_damping[position];
    };
    largest = std::max(largest, parallel_max(at(block.cells), 0.0, of_cell));
  }
  return largest;
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

std::vector<std::array<double, 6>> Solid::cell_stress(std::span<const double> u, const PointStep& step) const {
  std::vector<std::array<double, 6>> stress(cell_count());
  parallel_for(impl_->solid.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    double* first = stress[at(block.first + chunk.first)].data();
    block.kernels.mean_stress(impl_->batches(chunk, step), block.law(), u.data(), first);
  });
  return stress;
}

std::pair<double, std::size_t> Solid::largest_stress(std::span<const double> u, const PointStep& step,
                                                     double (*measure)(const Voigt& stress)) const {
  using Largest = std::pair<double, std::size_t>;
  const auto is_less = [](const Largest& a, const Largest& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  };
  std::vector<Largest> of_chunk(impl_->solid.chunks.size(), {-1.0, 0});
  parallel_for(of_chunk.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    const Block& block = impl_->block(chunk);
    std::vector<Voigt> stress(at(chunk.cells));
    block.kernels.mean_stress(impl_->batches(chunk, step), block.law(), u.data(), stress.front().data());
    for (std::size_t k = 0; k < stress.size(); ++k)
      of_chunk[c] = std::max(of_chunk[c], {measure(stress[k]), at(block.first + chunk.first) + k}, is_less);
  });
  return of_chunk.empty() ? Largest{-1.0, 0} : *std::max_element(of_chunk.begin(), of_chunk.end(), is_less);
}

std::vector<double> Solid::cell_history(std::string_view variable, std::span<const double> history) const {
  const auto position = [&](const Block& block) {
    const std::vector<std::string>& names = block.law_row->history;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), variable) - names.begin());
  };
  const auto has_it = [&](const Block& block) { return position(block) < block.law_row->history.size(); };
  if (std::none_of(impl_->solid.blocks.begin(), impl_->solid.blocks.end(), has_it)) return {};
  std::vector<double> means(cell_count());
  impl_->solid.for_each_batch({0.0, history}, [&](std::size_t first, const Block& block, const CellBatches& batch) {
    if (!has_it(block)) return;
    const BatchGradients gradients(batch);
    const std::size_t lanes = block.lanes(), variables = at(batch.history_variables), variable_of_law = position(block);
    for (int l = 0; l < batch.cells; ++l) {
      double& mean = means[first + at(l)];
      for (int p = 0; p < gradients.points(); ++p)
        mean += gradients.weight(p, l) * batch.history[(variables * at(p) + variable_of_law) * lanes + at(l)];
      mean /= gradients.volume(l);
    }
  });
  return means;
}

}  // namespace carom
