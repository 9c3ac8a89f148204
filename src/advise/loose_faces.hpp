// Bodies that begin face to face with nothing between them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// Faces of two bodies that lie on each other, and that no contact, tie, spring or equation knows of.
struct LooseFaces {
  std::array<Index, 2> part{-1, -1};  ///< indices in Model::parts, the smaller first
  std::size_t count = 0;              ///< facets of the skin that have such a neighbour
  Vec3 position{};                    ///< where the gap is the smallest
  double gap = 0.0;                   ///< there; negative where they overlap
  double size = 0.0;                  ///< of the smaller facet there, from the centre to the farthest node
};

/// One for each two parts (or one part with several bodies in it). Facets lie on each other where their normals are
/// opposed to 25 degrees and a point inside of one has its perpendicular foot on the other, not farther than 0.05 of
/// the smaller one's size, which is how far ties reach. Facets that part at the start and those whose nodes are all led
/// along the normal are left out. Ends of bars have no normal and do not count.
std::vector<LooseFaces> loose_faces(const Simulation& simulation, const State& state);

/// The same as sentences for the user: where, how far apart, and what can be done.
std::vector<std::string> loose_face_warnings(const Simulation& simulation);

}  // namespace carom
