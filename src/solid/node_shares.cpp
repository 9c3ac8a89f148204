#include "solid/node_shares.hpp"

#include <array>
#include <map>
#include <utility>

#include "solid/solid_impl.hpp"

namespace carom {

std::vector<GroupShare> node_shares(const Solid& solid, const Model& model) {
  const SolidCells& cells = solid.parts().solid;
  const std::vector<Index> numbers = model.part_numbers();
  std::vector<double> of_node(solid.node_count(), 0.0), of_first(solid.node_count(), 0.0);
  std::vector<Index> first_part(solid.node_count(), -1);
  std::map<std::pair<Index, Index>, double> of_others;  // by node and part: few
  const auto add = [&](Index node, std::size_t part, double mass) {
    const Index number = numbers[part];
    of_node[at(node)] += mass;
    if (first_part[at(node)] < 0) first_part[at(node)] = number;
    (first_part[at(node)] == number ? of_first[at(node)] : of_others[{node, number}]) += mass;
  };
  const auto add_batch = [&](std::size_t first, const Block& block, const CellBatches& batch) {
    const Index body = model.parts[block.part].rigid_body;
    block.for_each_lumped_mass(batch, [&](std::size_t lane, std::span<const double> m) {
      for (std::size_t a = 0; a < m.size(); ++a) {
        if (body < 0) add(cells.nodes_of(first + lane)[a], block.part, m[a]);
        if (body >= 0)
          for (const Index corner : model.turning_bodies[at(body)].nodes) add(corner, block.part, m[a]);
      }
    });
  };
  for (const std::vector<Chunk>* chunks : {&cells.chunks, &cells.rigid_chunks})
    for (const Chunk& chunk : *chunks) cells.each_batch_of(chunk, {}, add_batch);
  std::vector<GroupShare> shares;
  for (std::size_t n = 0; n < of_node.size(); ++n)
    if (of_first[n] > 0.0) shares.push_back({static_cast<Index>(n), first_part[n], of_first[n] / of_node[n]});
  for (const auto& [place, mass] : of_others)
    if (mass > 0.0) shares.push_back({place.first, place.second, mass / of_node[at(place.first)]});
  return shares;
}

}  // namespace carom
