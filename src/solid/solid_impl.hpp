// What a Solid is made of, for the files that define it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "kernels/batch_gradients.hpp"
#include "mesh/cell_size.hpp"
#include "solid/assembly.hpp"
#include "solid/frequency_bounds.hpp"
#include "solid/loads.hpp"
#include "solid/node_patches.hpp"
#include "solid/rank_share.hpp"
#include "solid/solid.hpp"
#include "solid/springs.hpp"
#include "solid/turning_bodies.hpp"

namespace carom {

struct Solid::Parts {
  Parts(const Model& model, Isa wanted)
      : isa(wanted),
        part_numbers(model.part_numbers()),
        part_count(part_numbers.empty() ? 0 : at(part_numbers.back()) + 1),
        solid(make_solid_cells(model, kernels(wanted))),
        patches(make_node_patches(model, solid, kernels(wanted))),
        loads(model),
        rigid_bodies(model.rigid_bodies),
        point_masses(model.point_masses),
        springs(model.springs),
        cohesive(model.cohesive, model.mesh->coordinates),
        share_of_cells(rank_share(solid)),
        share_of_patches(rank_share(patches.cells)),
        all_nodes(solid.mesh->node_count()),
        shared_nodes(held_nodes(model)),
        damping(damping_bounds(solid)),
        patch_damping(damping_bounds(patches.cells)),
        turning_bodies(model.turning_bodies, any_free(model.turning_bodies) ? highest_frequency() : 0.0) {
    BodyCells& cells = solid.cells;
    cells.volumes.resize(cells.size());
    cells.lengths.resize(cells.size());
    const auto measure = [&](std::size_t first, const Block& block, const CellBatches& batch) {
      const BatchGradients at_rest(batch);
      for (Index l = 0; l < batch.cells; ++l) {
        const std::size_t c = first + at(l);
        cells.volumes[c] = at_rest.volume(static_cast<int>(l));
        cells.lengths[c] = cell_length(block.type, solid.coordinates_of(c));
      }
    };
    solid.for_each_batch({}, measure);
    solid.for_each_rigid_batch(measure);
    if (solid.control_distortion(cells.volumes)) bounds_at_rest = cell_frequency_bounds();
    cohesive.place_history(points_history_size());
    others = contributors();
  }

  /// What ranks hold in the steps of schemes that share the nodes out: those of the cells that they compute, and, all
  /// of them, those that anything else acts on. All nodes where what acts goes through the whole body.
  Holding held_nodes(const Model& model) const {
    const std::size_t count = ranks().count(), all = solid.mesh->node_count(), loaded = loads.nodes().size();
    const auto is_damped = [](const Part& part) { return part.viscosity.is_any(); };
    const auto is_bond = [](const ContactDefinition& contact) {
      return parts_of(contact).nature == ContactNature::bonds;
    };
    const auto moves = [](const PrescribedMotion& motion) {
      const std::vector<double>& values = motion.function.value;
      return motion.rotation || motion.function.called || !is_zero(values);
    };
    const bool acts_through = !patches.empty() || !cohesive.empty() || !model.erosion.empty() ||
                              !model.turning_bodies.empty() || (4 * loaded > all && loaded < all) ||
                              std::ranges::any_of(model.parts, is_damped) ||
                              std::ranges::any_of(model.motions, moves) || !model.equations.empty() ||
                              std::ranges::any_of(model.contacts, is_bond);
    if (count == 1 || acts_through) return Holding(all);
    std::vector<std::uint8_t> of_all(all, 0);
    const auto add = [&](std::span<const Index> some) {
      for (const Index n : some) of_all[at(n)] = 1;
    };
    for (const ContactDefinition& contact : model.contacts) {
      const ContactParts parts = parts_of(contact);
      add(nodes_of(parts, *model.mesh));
      if (parts.carrier >= 0) add(std::array{parts.carrier});
    }
    for (const PrescribedMotion& motion : model.motions) add(motion.nodes);
    for (const Spring& spring : model.springs) add(spring.nodes);
    for (const RigidBody& body : model.rigid_bodies) add(std::array{body.node});
    if (loaded < all) add(loads.nodes());
    std::vector<std::uint8_t> held = of_all;
    mark_computed(solid, *share_of_cells, held);
    return {std::move(held), of_all};
  }
  /// What ranks have found in the chunks that they look at becomes known to all.
  template <class Found, class Position>
  void gather_by_chunk(std::span<Found> of_chunks, double Found::*value, Position Found::*position) const {
    if (!share_of_cells || shared_nodes.is_whole()) return;
    std::vector<double> values;
    for (const Found& found : of_chunks)
      values.insert(values.end(), {found.*value, static_cast<double>(found.*position)});
    share_of_cells->by_chunk.gather(values, 2);
    for (std::size_t c = 0; c < of_chunks.size(); ++c) {
      of_chunks[c].*value = values[2 * c];
      of_chunks[c].*position = static_cast<Position>(values[2 * c + 1]);
    }
  }
  /// On several ranks, whether this one looks at a chunk for all of them.
  bool looks_at(std::size_t chunk) const {
    return !share_of_cells || shared_nodes.is_whole() || share_of_cells->is_own[chunk] != 0;
  }

  /// All that acts between nodes beside the cells.
  std::vector<const Contributor*> contributors() const {
    std::vector<const Contributor*> all;
    for (const Contributor* each : std::initializer_list<const Contributor*>{&springs, &turning_bodies, &cohesive})
      if (!each->empty()) all.push_back(each);
    return all;
  }
  std::vector<std::vector<Index>> links() const {
    std::vector<std::vector<Index>> all;
    for (const Contributor* each : others)
      for (std::vector<Index>& nodes : each->links()) all.push_back(std::move(nodes));
    return all;
  }
  /// What they add to the tangent.
  CsrMatrix tangent_of_others(std::span<const double> u, const PointStep& step) const {
    SolidCells no_cells;
    no_cells.mesh = solid.mesh;
    CsrMatrix sum = dof_graph(node_graph(std::array<const SolidCells*, 1>{&no_cells}, links()));
    for (const Contributor* each : others) each->add_tangent(u, step, sum);
    return sum;
  }

  /// Calls add(node, mass) for the masses of points and rigid bodies.
  template <class Add>
  void for_each_body_mass(const Add& add) const {
    for (const PointMass& point : point_masses)
      for (const Index node : point.nodes) add(node, point.mass);
    for (const RigidBody& body : rigid_bodies) add(body.node, body.mass);
    for (const Contributor* each : others)
      for (const auto& [node, mass] : each->masses()) add(node, mass);
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
  std::size_t points_history_size() const { return solid.history_size() + patches.cells.history_size(); }
  const Block& block(const Chunk& chunk) const { return solid.blocks[at(chunk.block)]; }
  /// Calls body(nodes, stiffness matrix at u) for all that is integrated, in the order of for_each_chunk.
  template <class Body>
  void for_each_stiffness(std::span<const double> u, const PointStep& step, const Body& body) const {
    for (const SolidCells* cells : {&solid, &patches.cells})
      cells->for_each_stiffness(
          u, step, [&](std::size_t c, const Block&, std::span<const double> K) { body(cells->nodes_of(c), K); });
  }
  /// stress[6 k + c] of the cells k of a chunk; zero of those that have gone.
  void mean_stress(const Chunk& chunk, const Block& block, std::span<const double> u, const PointStep& step,
                   double* stress) const {
    solid.for_each_living(chunk, step, {}, std::array{u.data()},
                          [&](Index first, const CellBatches& batch, const std::array<const double*, 1>& own,
                              std::span<const std::uint8_t>) {
                            block.kernels.mean_stress(batch, block.law(), own[0], stress + 6 * at(first));
                          });
  }
  CsrMatrix graph() const { return node_graph(std::array<const SolidCells*, 2>{&solid, &patches.cells}, links()); }

  /// Of cells that patches are integrated for, the largest of a value of these.
  void largest_of_patches(std::span<const double> of_patch, std::span<double> of_cell) const {
    for (std::size_t k = 0; k < of_cell.size(); ++k)
      for (const Index patch : patches.of(k)) of_cell[k] = std::max(of_cell[k], of_patch[at(patch)]);
  }
  /// Adds to the values of a cell the means over its patches, if it has any.
  void add_mean_of_patches(std::size_t cell, std::size_t components, std::span<const double> of_patch,
                           double* of_cell) const {
    const std::span<const Index> own = patches.of(cell);
    for (const Index patch : own)
      for (std::size_t c = 0; c < components; ++c)
        of_cell[c] += of_patch[at(patch) * components + c] / static_cast<double>(own.size());
  }
  std::vector<double> cell_frequency_bounds() const {
    std::vector<double> bounds = frequency_bounds(solid);
    largest_of_patches(frequency_bounds(patches.cells), bounds);
    for (std::size_t k = 0; k < bounds.size(); ++k)
      if (!std::isfinite(bounds[k]))
        throw std::runtime_error(
            fmt::format("the stiffness of cell {} at rest is not a number: its size and the numbers "
                        "of its material are too far apart",
                        solid.mesh->cell_label(solid.cells[k])));
    return bounds;
  }
  /// Of the deformable cells; where all are rigid, what theirs would be about, 2 c / length.
  double highest_frequency() const {
    double highest = std::sqrt(largest_bound());
    if (highest > 0.0) return highest;
    solid.for_each_rigid_batch([&](std::size_t first, const Block& block, const CellBatches& batch) {
      const double c = std::sqrt(block.wave_modulus / block.rho);
      for (std::size_t k = first; k < first + at(batch.cells); ++k)
        highest = std::max(highest, 2.0 * c / cell_length(block.type, solid.coordinates_of(k)));
    });
    return highest;
  }
  double largest_bound() const {
    const std::vector<double> bounds = cell_frequency_bounds();
    return parallel_max(bounds.size(), 0.0, [&](std::size_t k) { return bounds[k]; });
  }

  /// Overwrites f with the sum over all that is integrated of add(cells, number of a chunk, block, its runs of cells,
  /// f), colour by colour; every rank adds what it computes, and has all of f afterwards.
  template <class Add>
  void sum_over_chunks(std::span<double> f, const Holding* held, const Add& add) const {
    constexpr std::size_t zeros_per_task = 1 << 15;
    if (held != nullptr)
      held->each_range(
          [&](std::size_t first, std::size_t last) { std::fill(f.data() + 3 * first, f.data() + 3 * last, 0.0); });
    else
      parallel_for(f.size(), zeros_per_task,
                   [&](std::size_t first, std::size_t last) { std::fill(f.data() + first, f.data() + last, 0.0); });
    const auto add_all = [&](const SolidCells& cells, const std::optional<RankShare>& share) {
      for_each_duty(cells, share, [&](std::size_t c, std::span<const Chunk> runs) {
        add(cells, c, cells.blocks[at(runs[0].block)], runs, f.data());
      });
    };
    add_all(solid, share_of_cells);
    add_all(patches.cells, share_of_patches);
    if (!share_of_cells) return;
    (held != nullptr ? *held : all_nodes).update(f);
  }
  /// Overwrites f with the internal force of all that is integrated. energies_of(cells, number of a chunk): what takes
  /// its energies, null where they are not wanted.
  template <class EnergiesOf>
  void sum_forces(std::span<const double> u, const PointStep& step, std::span<double> f, std::span<double> end,
                  const EnergiesOf& energies_of) const {
    sum_over_chunks(
        f, step.nodes,
        [&](const SolidCells& cells, std::size_t c, const Block& block, std::span<const Chunk> runs, double* sum) {
          SolidEnergies* const energies = energies_of(cells, c);
          for (const Chunk& run : runs)
            if (!block.is_nodal())
              cells.add_living(run, step, end, std::array{u.data()}, sum,
                               [&](const CellBatches& batch, const std::array<const double*, 1>& own, double* into) {
                                 block.kernels.add_internal_force(batch, block.law(), own[0], into, energies);
                               });
          for (const Chunk& run : runs) {
            const double energy = cells.add_distortion_force(run, u, f, step);
            if (energies != nullptr) energies->distortion += energy;
          }
        });
  }
  /// Calls body(number of a chunk, runs of its cells) for what the rank has to do, colour by colour.
  template <class Body>
  static void for_each_duty(const SolidCells& cells, const std::optional<RankShare>& share, const Body& body) {
    if (!share)
      return cells.for_each_chunk(
          [&](const Chunk& chunk) { body(at(&chunk - cells.chunks.data()), std::span(&chunk, 1)); });
    for (std::size_t k = 0; k + 1 < share->colour_begin.size(); ++k)
      parallel_for(share->colour_begin[k + 1] - share->colour_begin[k], 1, [&](std::size_t begin, std::size_t) {
        const ChunkDuty& duty = share->duties[share->colour_begin[k] + begin];
        body(duty.chunk, duty.runs);
      });
  }
  /// The energies of chunks, and the history of their points, which every rank has of its own, become those of all.
  /// The history stays with its rank where the nodes do.
  void gather(std::span<SolidEnergies> of_cells, std::span<SolidEnergies> of_patches, std::span<double> points,
              const Holding* held) const {
    if (!share_of_cells) return;
    const bool stays = held != nullptr && !held->is_whole();
    for (const auto& [share, energies] : {std::pair{&*share_of_cells, of_cells}, {&*share_of_patches, of_patches}}) {
      std::vector<double> values;
      for (const SolidEnergies& chunk : energies)
        for (double SolidEnergies::*const term : SolidEnergies::terms) values.push_back(chunk.*term);
      share->by_chunk.gather(values, SolidEnergies::terms.size());
      auto next = values.begin();
      for (SolidEnergies& chunk : energies)
        for (double SolidEnergies::*const term : SolidEnergies::terms) chunk.*term = *next++;
      if (!points.empty() && !stays) share->history.gather(points);
    }
  }

  Isa isa;
  std::vector<Index> part_numbers;  ///< Model::part_numbers
  std::size_t part_count;           ///< of the case
  SolidCells solid;
  NodePatches patches;
  Loads loads;
  std::vector<RigidBody> rigid_bodies;
  std::vector<PointMass> point_masses;
  Springs springs;
  CohesiveZones cohesive;
  std::optional<RankShare> share_of_cells, share_of_patches;  ///< of this rank; none where it is the only one
  Holding all_nodes, shared_nodes;                            ///< held by each rank: all, and what held_nodes says
  DampingBounds damping, patch_damping;
  std::vector<double> bounds_at_rest;  ///< cell_frequency_bounds(), for distortion control
  TurningBodies turning_bodies;
  std::vector<const Contributor*> others;
  std::vector<double> diagonal_at_rest;  ///< where it has been asked for
  std::once_flag is_diagonal_made;
};

}  // namespace carom
