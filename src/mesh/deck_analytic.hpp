// Analytical rigid surfaces of a deck (*SURFACE, TYPE=SEGMENTS, CYLINDER or REVOLUTION) as faces.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "deck/deck.hpp"

namespace carom {

struct AnalyticFaces {
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> faces;  ///< two, three or four points each, in the order of Facet
  double roundness = 0.0;                       ///< largest distance of a face from the surface
};

/// The profile of lines and arcs, arcs in pieces of 3 degrees at most; along the generator by `half_length` on both
/// sides, or around the axis in pieces of 5 degrees. The outward normal is that of Abaqus: a quarter turn
/// counter-clockwise from the start to the end of a segment. Throws CaseError.
AnalyticFaces analytic_faces(const DeckKeyword& surface, const std::string& type, double half_length);

}  // namespace carom
