#include "solid/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "kernels/hourglass_flow.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_size.hpp"
#include "model/wave_modulus.hpp"
#include "solid/colouring.hpp"
#include "solid/element_table.hpp"

namespace carom {
namespace {

CaseError part_error(const Mesh& mesh, const Part& part, std::string found, std::string expected, std::string mend) {
  return {Location{mesh.report.source}, "parts." + part.name, std::move(found), std::move(expected), std::move(mend)};
}

std::span<const Index> connectivity_of(const Mesh& mesh, const CellRef& ref) {
  const CellBlock& block = mesh.blocks[at(ref.block)];
  const auto n = static_cast<std::size_t>(node_count(block.type));
  return {block.connectivity.data() + n * at(ref.cell), n};
}

CellNodes positions(const Mesh& mesh, std::span<const Index> nodes) {
  CellNodes x{};
  for (std::size_t a = 0; a < nodes.size(); ++a) x[a] = mesh.coordinates[at(nodes[a])];
  return x;
}

const Element* element_of(const Part& part) {
  return find_element(part.type, part.section, part.formulation);
}

void check_shape(const Mesh& mesh, const Part& part, const CellNodes& x, std::size_t nodes, const CellRef& cell,
                 double det_J, double largest_radius) {
  if (!(det_J > 0.0))
    throw part_error(mesh, part, fmt::format("Jacobian determinant {:.3g} in cell {}", det_J, mesh.cell_label(cell)),
                     "a positive Jacobian determinant at every Gauss point",
                     "mend the cell in the mesh: it is flat, folded or too distorted");
  if (dimension(part.type) != 2) return;
  constexpr double flat = 1e-9;  // coordinates from a text file have more digits than that
  for (std::size_t a = 1; a < nodes; ++a)
    if (std::abs(x[a][2] - x[0][2]) > flat * std::sqrt(det_J))
      throw part_error(mesh, part,
                       fmt::format("z = {:.6g} and {:.6g} in cell {}", x[0][2], x[a][2], mesh.cell_label(cell)),
                       "plane cells in the x-y plane", "turn the mesh so that z is constant");
  constexpr double on_axis = 1e-9;  // as Parts::axis_tolerance
  for (std::size_t a = 0; a < nodes && part.section == Section::axisymmetric; ++a)
    if (x[a][0] < -on_axis * largest_radius)
      throw part_error(mesh, part, fmt::format("x = {:.6g} in cell {}", x[a][0], mesh.cell_label(cell)),
                       "x >= 0: the radius about the y axis", "move the mesh to the right of the y axis");
}

/// Which part has each cell of each block of the mesh; -1: none.
using Owners = std::vector<std::vector<Index>>;

void check_section(const Mesh& mesh, const Part& part) {
  if (find_element(part.type, part.section, {}) == nullptr)
    throw part_error(mesh, part, fmt::format("{} cells", name(part.type)),
                     fmt::format("{} cells for this section", types_of(part.section)),
                     "mesh the part with cells of one of these types, or give it another section");
  if (element_of(part) == nullptr)
    throw part_error(mesh, part,
                     fmt::format("formulation \"{}\" of {} cells", name(part.formulation.value()), name(part.type)),
                     formulations_of(part.type, part.section) + " for these cells under this section",
                     "leave the formulation out to get the first of these");
  if (!(part.thickness > 0.0))
    throw part_error(mesh, part, fmt::format("thickness or area {:.6g}", part.thickness), "a positive number", "");
}

/// The cells of the part as references.
std::vector<CellRef> cells_of(const Mesh& mesh, const std::vector<Part>& parts, std::size_t p, Owners& owners) {
  const Part& part = parts[p];
  check_section(mesh, part);
  const CellBlock* block = mesh.block(part.type);
  const std::size_t available = block == nullptr ? 0 : block->size();
  std::vector<CellRef> cells;
  cells.reserve(part.cells.size());
  for (const Index cell : part.cells) {
    if (cell < 0 || at(cell) >= available)
      throw part_error(mesh, part, fmt::format("cell index {}", cell),
                       fmt::format("one of the {} {} cells of the mesh", available, name(part.type)),
                       fmt::format("the part is made of {0} cells: mesh it with {0} cells", name(part.type)));
    const CellRef ref{static_cast<Index>(block - mesh.blocks.data()), cell};
    Index& owner = owners[at(ref.block)][at(cell)];
    if (owner >= 0)
      throw part_error(
          mesh, part, fmt::format("cell {}, which is in parts.{} already", mesh.cell_label(ref), parts[at(owner)].name),
          "each cell in one part", "take the cell out of one of the two groups");
    owner = static_cast<Index>(p);
    cells.push_back(ref);
  }
  return cells;
}

std::vector<Index> batch_offsets(const Mesh& mesh, const std::vector<CellRef>& cells, std::size_t nodes_per_cell,
                                 int lanes) {
  const auto n = static_cast<std::size_t>(lanes);
  const std::size_t batches = (cells.size() + n - 1) / n;
  std::vector<Index> offset(batches * nodes_per_cell * n);
  for (std::size_t c = 0; c < batches * n; ++c) {
    const auto nodes = connectivity_of(mesh, cells[std::min(c, cells.size() - 1)]);
    for (std::size_t a = 0; a < nodes_per_cell; ++a) offset[((c / n) * nodes_per_cell + a) * n + c % n] = 3 * nodes[a];
  }
  return offset;
}

/// Lengths of the cells, the last batch filled up with its last one.
std::vector<double> batch_lengths(const Mesh& mesh, const std::vector<CellRef>& cells, CellType type,
                                  std::size_t lanes) {
  std::vector<double> lengths((cells.size() + lanes - 1) / lanes * lanes);
  for (std::size_t c = 0; c < lengths.size(); ++c)
    lengths[c] = cell_length(type, positions(mesh, connectivity_of(mesh, cells[std::min(c, cells.size() - 1)])));
  return lengths;
}

/// Those of stabilised cells. Under plane stress they bend as a beam does, else as a plate.
ModeModuli mode_moduli(const Part& part, double coefficient) {
  const IsotropicElastic at_rest = part.material.at_rest();
  const double E = coefficient * at_rest.E, nu = at_rest.nu;
  return {E / (2.0 * (1.0 + nu)), E, part.section == Section::plane_stress ? E : E / (1.0 - nu * nu), nu};
}

double default_hourglass(Formulation formulation) {
  if (formulation == Formulation::stabilised) return 1.0;
  return formulation == Formulation::nodal ? 0.25 : 0.05;
}

/// The stages of a part: its element chooses whether dilatation is averaged, its law the kinematics.
BatchStages stages_of(const Part& part, const Element& element, const CellStages& cell, bool small_strain,
                      const KernelTable& table) {
  BatchStages stages{table.lanes, &cell, small_strain ? &table.small : &table.finite};
  if (element.dilatation)
    stages.dilatation = (small_strain ? table.small_dilatation : table.finite_dilatation) +
                        static_cast<std::size_t>(*element.dilatation);
  const IsotropicElastic at_rest = part.material.at_rest();
  const double hourglass = part.hourglass.value_or(default_hourglass(element.formulation));
  stages.hourglass = hourglass * at_rest.E / (2.0 * (1.0 + at_rest.nu));
  stages.hourglass_coefficient = hourglass;
  stages.moduli = mode_moduli(part, hourglass);
  if (part.material.law->heating_share != nullptr)
    stages.heating_share = part.material.law->heating_share(part.material);
  stages.viscosity = part.viscosity;
  stages.modulus = at_rest.E / (2.0 * (1.0 + at_rest.nu));
  stages.rho = part.material.rho;
  stages.wave_speed = std::sqrt(wave_modulus(part) / part.material.rho);
  if (part.viscosity.has_bulk()) {
    stages.bulk = small_strain ? &table.small_bulk : &table.finite_bulk;
    stages.memory.resize(MemorySlot::viscosity, bulk_history);
  }
  if (!part.material.law->history.empty() || part.viscosity.hourglass > 0.0)
    stages.memory.resize(MemorySlot::hourglass, hourglass_history(*stages.cell, part.viscosity.hourglass > 0.0));
  return stages;
}

/// Elastic HEXA8 integrated fully have kernels of their own.
CellKernels kernels_of(const Element& element, const Block& block, const KernelTable& table) {
  const bool is_fused = element.kind == CellKind::Hexa8 && !element.dilatation && block.history_per_cell() == 0 &&
                        block.is_linear == block.small_strain;
  if (!is_fused) return staged_kernels;
  return block.small_strain ? table.hexa8_small : table.hexa8_finite;
}

/// The first cell whose shape is not that of a cell that can be computed with.
void check_shapes(const Mesh& mesh, const Part& part, const std::vector<CellRef>& cells, const Block& block) {
  const std::size_t lanes = block.lanes();
  std::vector<double> det_J(block.offset.size() / block.nodes());
  parallel_for(det_J.size(), 64 * lanes, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; c += lanes)
      block.stages.cell->smallest_jacobian(mesh.coordinates.front().data(), block.offset.data() + block.nodes() * c,
                                           &det_J[c]);
  });
  double largest_radius = 0.0;
  for (const CellRef& cell : cells)
    for (const Index n : connectivity_of(mesh, cell))
      largest_radius = std::max(largest_radius, mesh.coordinates[at(n)][0]);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (det_J[c] > 0.0 && dimension(part.type) != 2) continue;
    const auto nodes = connectivity_of(mesh, cells[c]);
    check_shape(mesh, part, positions(mesh, nodes), nodes.size(), cells[c], det_J[c], largest_radius);
  }
}

Block make_block(const Mesh& mesh, const Part& part, const std::vector<CellRef>& cells, const KernelTable& table) {
  Block block = block_of(part, nullptr, table);
  block.cells = static_cast<Index>(cells.size());
  block.mass = cell_mass(element_of(part)->kind);
  block.offset = batch_offsets(mesh, cells, block.nodes(), table.lanes);
  check_shapes(mesh, part, cells, block);
  if (part.viscosity.is_any()) block.length = batch_lengths(mesh, cells, part.type, block.lanes());
  if (element_of(part)->formulation == Formulation::nodal) {  // integrated by its patches
    block.kernels = {};
    block.prepared_law = {};
    block.stages.bulk = nullptr;
    block.stages.memory = {};
    block.length.clear();
  }
  return block;
}

/// At most about 512 chunks: few colours, each of chunks enough for 64 threads, and what a chunk works on stays in the
/// cache of a core; but none so small that starting threads would cost more than it saves.
Index chunk_size(std::size_t cells) {
  constexpr Index smallest = 512, chunks = 512, multiple = 8;
  const auto size = static_cast<Index>((cells + chunks - 1) / chunks);
  return std::max(smallest, (size + multiple - 1) / multiple * multiple);
}

}  // namespace

Block block_of(const Part& part, std::shared_ptr<const CellStages> cell_stages, const KernelTable& table) {
  const Element& element = *element_of(part);
  Block block;
  block.type = part.type;
  block.thickness = part.thickness;
  block.is_ring = part.section == Section::axisymmetric;
  block.rho = part.material.rho;
  block.wave_modulus = part.material.at_rest().p_wave_modulus();
  block.history_names = part.material.history();
  block.small_strain = part.material.law->measure == Measure::small_strain;
  block.distortion_limit = part.distortion_control;
  block.is_linear =
      block.small_strain && part.material.law->is_linear && !part.viscosity.is_any() && part.distortion_control == 0.0;
  block.cell_stages = std::move(cell_stages);
  const CellStages* own = block.cell_stages.get();
  if (own == nullptr) own = &table.cells[static_cast<std::size_t>(element.kind)];
  block.stages = stages_of(part, element, *own, block.small_strain, table);
  block.prepared_law = prepare(part.material, free_directions(part.section), table.laws);
  block.stages.memory.resize(MemorySlot::law, block.stages.cell->points * block.prepared_law.history);
  block.kernels = kernels_of(element, block, table);
  return block;
}

void cut_and_colour(SolidCells& solid) {
  std::vector<Chunk> chunks;
  std::vector<std::vector<Index>> chunk_nodes;
  const Index size = chunk_size(solid.size());
  for (std::size_t b = 0; b < solid.blocks.size(); ++b) {
    const Block& block = solid.blocks[b];
    if (block.is_rigid) {
      solid.rigid_chunks.push_back({static_cast<Index>(b), 0, block.cells});
      continue;
    }
    for (Index first = 0; first < block.cells; first += size) {
      chunks.push_back({static_cast<Index>(b), first, std::min(size, block.cells - first)});
      std::vector<Index>& nodes = chunk_nodes.emplace_back();
      for (Index c = 0; c < chunks.back().cells; ++c)
        for (const Index n : solid.nodes_of(at(block.first + first + c))) nodes.push_back(n);
    }
  }
  const std::vector<int> colour = colour_chunks(solid.mesh->node_count(), chunk_nodes);
  solid.colour_begin.assign(1, 0);
  const int last = colour.empty() ? -1 : *std::max_element(colour.begin(), colour.end());
  for (int k = 0; k <= last; ++k) {
    for (std::size_t c = 0; c < chunks.size(); ++c)
      if (colour[c] == k) solid.chunks.push_back(chunks[c]);
    if (solid.chunks.size() > solid.colour_begin.back()) solid.colour_begin.push_back(solid.chunks.size());
  }
}

std::span<const Index> SolidCells::nodes_of(std::size_t position) const {
  if (!node_begin.empty())
    return std::span<const Index>(node_list).subspan(node_begin[position],
                                                     node_begin[position + 1] - node_begin[position]);
  return cells.nodes_of(position);
}

CellNodes SolidCells::coordinates_of(std::size_t position) const {
  return positions(*mesh, nodes_of(position));
}

CellNodes SolidCells::coordinates_of(std::size_t position, std::span<const double> u) const {
  CellNodes x = coordinates_of(position);
  const auto nodes = nodes_of(position);
  for (std::size_t a = 0; a < nodes.size(); ++a) x[a] = add(x[a], vector_at(u, at(nodes[a])));
  return x;
}

CellBatches SolidCells::batches(const Block& block, Index first, Index count, const PointStep& step,
                                std::span<double> end) const {
  CellBatches view;
  view.stages = &block.stages;
  view.x = mesh->coordinates.front().data();
  view.offset = block.offset.data() + block.places() * at(first);
  view.cells = count;
  view.thickness = block.thickness;
  view.dt = step.dt;
  view.viscous_dt = step.is_static ? 0.0 : step.dt;
  view.is_over = step.is_over;
  view.history_variables = block.prepared_law.history;
  const std::size_t begin = block.history_first + block.history_per_cell() * at(first);
  if (!block.length.empty()) view.length = block.length.data() + at(first);
  if (block.history_per_cell() == 0) return view;
  if (!step.history.empty()) view.history = step.history.data() + begin;
  if (!end.empty()) view.new_history = end.data() + begin;
  return view;
}

std::span<const std::uint8_t> SolidCells::gone_among(const Block& block, Index first, Index count,
                                                     const PointStep& step) const {
  if (step.alive.empty() || !node_begin.empty()) return {};
  const std::span<const std::uint8_t> own = step.alive.subspan(at(block.first + first), at(count));
  return std::all_of(own.begin(), own.end(), [](std::uint8_t is_there) { return is_there != 0; })
             ? std::span<const std::uint8_t>{}
             : own;
}

void SolidCells::stiffness(const Block& block, Index first, const CellBatches& batch, std::span<const double> u,
                           const PointStep& step, std::vector<double>& K) const {
  const std::size_t size = 9 * block.nodes() * block.nodes();
  const std::span<const std::uint8_t> alive = gone_among(block, first, batch.cells, step);
  if (block.is_nodal())
    K.assign(size * block.lanes(), 0.0);
  else
    batch_stiffness(batch, block.kernels, block.law(), u.empty() ? nullptr : u.data(), alive, K);
  if (block.distortion.empty() || u.empty()) return;
  for (std::size_t l = 0; l < at(batch.cells); ++l)
    if (alive.empty() || alive[l] != 0)
      block.distortion.add_stiffness(at(first) + l, u, std::span<double>(K).subspan(size * l, size));
}

bool SolidCells::control_distortion(std::span<const double> volumes) {
  bool is_any = false;
  for (Block& block : blocks) {
    if (block.distortion_limit == 0.0) continue;
    is_any = true;
    std::vector<Index> nodes;
    for (Index c = block.first; c < block.first + block.cells; ++c) {
      const auto of_cell = nodes_of(at(c));
      nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
    }
    block.distortion =
        DistortionControl(mesh, block.type, std::move(nodes), volumes.subspan(at(block.first), at(block.cells)),
                          block.distortion_limit, block.wave_modulus);
  }
  return is_any;
}

double SolidCells::add_distortion_force(const Chunk& chunk, std::span<const double> u, std::span<double> f,
                                        const PointStep& step) const {
  const DistortionControl& distortion = blocks[at(chunk.block)].distortion;
  double energy = 0.0;
  if (distortion.empty()) return energy;
  for (Index c = chunk.first; c < chunk.first + chunk.cells; ++c)
    if (is_there(blocks[at(chunk.block)].first + c, step)) energy += distortion.add_force(at(c), u, f);
  return energy;
}

void SolidCells::add_distortion_action(const Chunk& chunk, std::span<const double> u, std::span<const double> x,
                                       std::span<double> y, const PointStep& step) const {
  const DistortionControl& distortion = blocks[at(chunk.block)].distortion;
  if (distortion.empty()) return;
  for (Index c = chunk.first; c < chunk.first + chunk.cells; ++c)
    if (is_there(blocks[at(chunk.block)].first + c, step)) distortion.add_tangent_action(at(c), u, x, y);
}

void SolidCells::add_distortion_growth(const Chunk& chunk, std::span<const double> u,
                                       std::span<const double> bounds_at_rest, std::span<double> own,
                                       const PointStep& step) const {
  const Block& block = blocks[at(chunk.block)];
  if (block.distortion.empty()) return;
  for (Index first = 0; first < chunk.cells; first += block.stages.lanes) {
    const Index count = std::min<Index>(block.stages.lanes, chunk.cells - first);
    block.for_each_lumped_mass(
        batches(block, chunk.first + first, count), [&](std::size_t l, std::span<const double> mass) {
          const std::size_t k = at(first) + l, cell = at(chunk.first) + k;
          if (!is_there(block.first + static_cast<Index>(cell), step)) return;
          own[k] += block.distortion.frequency_bound(cell, u, mass) / bounds_at_rest[at(block.first) + cell];
        });
  }
}

std::vector<double> SolidCells::repeated_history(const Block& block, Index cell, const PointStep& step) const {
  if (step.history.empty()) return {};
  const std::size_t lanes = block.lanes(), size = block.history_per_cell();
  const double* batch = step.history.data() + block.history_first + size * (at(cell) / lanes * lanes);
  std::vector<double> history;
  for (std::size_t k = 0; k < size; ++k) history.insert(history.end(), lanes, batch[k * lanes + at(cell) % lanes]);
  return history;
}

void SolidCells::lengths(const Block& block, Index first, std::span<const double> u, std::span<double> length) const {
  const CellStages& stages = *block.stages.cell;
  const std::size_t begin = at(block.first + first), n = stages.lengths == nullptr ? 1 : block.lanes();
  for (std::size_t k = 0; k < length.size(); k += n) {
    double of_batch[most_lanes];
    if (stages.lengths != nullptr) {
      stages.lengths(mesh->coordinates.front().data(), u.data(), block.offset.data() + block.nodes() * (at(first) + k),
                     of_batch);
    } else {
      const CellNodes x = coordinates_of(begin + k, u);
      of_batch[0] = cell_length(block.type, std::span<const Vec3>(x).first(block.nodes()));
    }
    std::copy_n(of_batch, std::min(n, length.size() - k), length.data() + k);
  }
}

std::size_t SolidCells::history_size() const {
  std::size_t size = 0;
  for (const Block& block : blocks) size += block.history_size();
  return size;
}

bool SolidCells::are_linear() const {
  return std::all_of(blocks.begin(), blocks.end(),
                     [](const Block& block) { return block.is_linear || block.is_rigid; });
}
bool SolidCells::have_modes() const {
  return std::any_of(blocks.begin(), blocks.end(),
                     [](const Block& block) { return block.stages.cell->modes > 0 && !block.is_rigid; });
}

bool SolidCells::is_there(Index position, const PointStep& step) const {
  return step.alive.empty() || !node_begin.empty() || step.alive[at(position)] != 0;
}

const Block& SolidCells::block_of(std::size_t position) const {
  const auto holds = [&](const Block& block) { return at(block.first) + at(block.cells) > position; };
  return *std::find_if(blocks.begin(), blocks.end(), holds);
}

SolidCells make_solid_cells(const Model& model, const KernelTable& table) {
  const Mesh& mesh = *model.mesh;
  Owners owners;
  for (const CellBlock& block : mesh.blocks) owners.emplace_back(block.size(), -1);
  SolidCells solid;
  solid.mesh = solid.cells.mesh = model.mesh;
  solid.power_bound = table.power_bound;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const std::vector<CellRef> cells = cells_of(mesh, model.parts, p, owners);
    if (cells.empty()) continue;
    const std::size_t history_first = solid.history_size();
    solid.blocks.push_back(make_block(mesh, model.parts[p], cells, table));
    solid.blocks.back().part = p;
    solid.blocks.back().is_rigid = model.parts[p].rigid_body >= 0;
    solid.blocks.back().history_first = history_first;
    solid.blocks.back().first = static_cast<Index>(solid.cells.size());
    solid.cells.refs.insert(solid.cells.refs.end(), cells.begin(), cells.end());
  }
  cut_and_colour(solid);
  return solid;
}

}  // namespace carom
