#include "solid/solid.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "element/hexa8.hpp"
#include "parallel/threads.hpp"
#include "solid/assembly.hpp"
#include "solid/blocks.hpp"
#include "solid/cell_matrices.hpp"
#include "solid/kernels.hpp"
#include "solid/loads.hpp"

namespace carom {
namespace {

std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

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
      : mesh(model.mesh),
        isa(wanted),
        kernel(kernels(wanted)),
        solid(make_solid_cells(model, kernel.lanes)),
        loads(make_loads(model)),
        gravity(gravity_loads(model)),
        volumes(solid.cells.size()),
        lengths(solid.cells.size()) {
    for (std::size_t c = 0; c < solid.cells.size(); ++c) {
      const auto x = cell_coordinates(*mesh, solid.cells[c]);
      volumes[c] = hexa8::volume(x).volume;
      lengths[c] = hexa8::length(x);
    }
  }

  CellBatches batches(const Chunk& chunk) const {
    return {mesh->coordinates.front().data(), block(chunk).offset.data() + 8 * at(chunk.first), chunk.cells};
  }
  const Block& block(const Chunk& chunk) const { return solid.blocks[at(chunk.block)]; }
  BatchLaw law(const Block& b) const { return {kernel.linear_elastic, &b.lame}; }
  CellStiffness stiffness(std::size_t c, const Block& b) const {
    return cell_stiffness(cell_coordinates(*mesh, solid.cells[c]), carom::tangent(b.material));
  }

  std::shared_ptr<const Mesh> mesh;
  Isa isa;
  const KernelTable& kernel;
  SolidCells solid;
  std::vector<LoadVector> loads;
  std::vector<Gravity> gravity;
  std::vector<double> volumes, lengths;
};

Solid::Solid(const Model& model, Isa isa) : impl_(std::make_unique<Impl>(model, isa)) {}
Solid::~Solid() = default;
Solid::Solid(Solid&&) noexcept = default;

std::size_t Solid::node_count() const {
  return impl_->mesh->node_count();
}
std::size_t Solid::cell_count() const {
  return impl_->solid.cells.size();
}
Isa Solid::isa() const {
  return impl_->isa;
}
const std::vector<Index>& Solid::cells() const {
  return impl_->solid.cells;
}
const std::vector<double>& Solid::cell_volumes() const {
  return impl_->volumes;
}
const std::vector<double>& Solid::cell_lengths() const {
  return impl_->lengths;
}

void Solid::internal_force(std::span<const double> u, std::span<double> f) const {
  constexpr std::size_t zeros_per_task = 1 << 15;
  parallel_for(f.size(), zeros_per_task,
               [&](std::size_t begin, std::size_t end) { std::fill(f.data() + begin, f.data() + end, 0.0); });
  impl_->solid.for_each_chunk([&](const Chunk& chunk) {
    impl_->kernel.add_internal_force(impl_->batches(chunk), impl_->law(impl_->block(chunk)), u.data(), f.data());
  });
}

void Solid::add_internal_force_of(std::span<const Index> cells, std::span<const double> u, std::span<double> f) const {
  const auto n = at(impl_->kernel.lanes);
  std::array<Index, 64> offset{};  // one batch of at most 8 lanes, filled up with one cell
  for (const Index cell : cells) {
    const Block& block = *std::find_if(impl_->solid.blocks.begin(), impl_->solid.blocks.end(),
                                       [&](const Block& b) { return cell < b.first + b.cells; });
    const std::size_t c = at(cell - block.first);
    for (std::size_t a = 0; a < 8; ++a)
      std::fill_n(offset.begin() + static_cast<std::ptrdiff_t>(a * n), n, block.offset[((c / n) * 8 + a) * n + c % n]);
    impl_->kernel.add_internal_force({impl_->mesh->coordinates.front().data(), offset.data(), 1}, impl_->law(block),
                                     u.data(), f.data());
  }
}

void Solid::tangent_action(std::span<const double>, std::span<const double> x, std::span<double> y) const {
  internal_force(x, y);  // every law so far is linear: K x = F(x) at any u
}

CsrMatrix Solid::tangent(std::span<const double>) const {
  CsrMatrix K = dof_graph(node_graph(*impl_->mesh, impl_->solid));
  impl_->solid.for_each_cell([&](std::size_t c, const Block& block) {
    const CellStiffness cell = impl_->stiffness(c, block);
    const auto nodes = cell_nodes(*impl_->mesh, impl_->solid.cells[c]);
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b < 8; ++b)
        for (std::size_t i = 0; i < 3; ++i) {
          double* row = K.value.data() + entry(K, 3 * nodes[a] + static_cast<Index>(i), 3 * nodes[b]);
          for (std::size_t j = 0; j < 3; ++j) row[j] += cell[3 * a + i][3 * b + j];
        }
  });
  return K;
}

std::vector<double> Solid::tangent_diagonal(std::span<const double>) const {
  std::vector<double> diagonal(dof_count(), 0.0);
  impl_->solid.for_each_cell([&](std::size_t c, const Block& block) {
    const CellStiffness cell = impl_->stiffness(c, block);
    const auto nodes = cell_nodes(*impl_->mesh, impl_->solid.cells[c]);
    for (std::size_t r = 0; r < 24; ++r) diagonal[3 * at(nodes[r / 3]) + r % 3] += cell[r][r];
  });
  return diagonal;
}

double Solid::strain_energy(std::span<const double> u) const {
  const std::vector<Chunk>& chunks = impl_->solid.chunks;
  std::vector<double> partial(chunks.size());
  parallel_for(chunks.size(), 1, [&](std::size_t c, std::size_t) {
    partial[c] = impl_->kernel.strain_energy(impl_->batches(chunks[c]), impl_->law(impl_->block(chunks[c])), u.data());
  });
  return std::accumulate(partial.begin(), partial.end(), 0.0);
}

Mass Solid::mass(MassKind kind) const {
  CsrMatrix M = node_graph(*impl_->mesh, impl_->solid);
  impl_->solid.for_each_cell([&](std::size_t c, const Block& block) {
    const Index number = impl_->solid.cells[c];
    const CellMass cell = cell_mass(cell_coordinates(*impl_->mesh, number), block.material.rho);
    const auto nodes = cell_nodes(*impl_->mesh, number);
    const auto diagonal = lumped(cell);
    for (std::size_t a = 0; a < 8; ++a) {
      if (kind == MassKind::lumped) M.value[entry(M, nodes[a], nodes[a])] += diagonal[a];
      for (std::size_t b = 0; b < 8 && kind == MassKind::consistent; ++b)
        M.value[entry(M, nodes[a], nodes[b])] += cell[a][b];
    }
  });
  return Mass(kind, std::move(M));
}

std::vector<double> Solid::cell_frequency_bounds() const {
  std::vector<double> bounds(cell_count());
  impl_->solid.for_each_cell([&](std::size_t c, const Block& block) {
    const CellMass M = cell_mass(cell_coordinates(*impl_->mesh, impl_->solid.cells[c]), block.material.rho);
    bounds[c] = frequency_bound(impl_->stiffness(c, block), lumped(M));
  });
  return bounds;
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

bool Solid::has_loads() const {
  return !impl_->loads.empty() || !impl_->gravity.empty();
}

std::vector<std::array<double, 6>> Solid::cell_stress(std::span<const double> u) const {
  std::vector<std::array<double, 6>> stress(cell_count());
  parallel_for(impl_->solid.chunks.size(), 1, [&](std::size_t c, std::size_t) {
    const Chunk& chunk = impl_->solid.chunks[c];
    double* first = stress[at(impl_->block(chunk).first + chunk.first)].data();
    impl_->kernel.mean_stress(impl_->batches(chunk), impl_->law(impl_->block(chunk)), u.data(), first);
  });
  return stress;
}

}  // namespace carom
