#include "mesh/deck_elements.hpp"

#include <algorithm>
#include <array>

namespace carom {

namespace {

using Kind = DeckElementType::Kind;

/// The deck has the centre of the cell before those of its faces, which it numbers as it does its faces.
constexpr std::array<LocalNode, 27> kHexa27{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                            14, 15, 16, 17, 18, 19, 26, 24, 23, 25, 21, 22, 20};
constexpr std::array<LocalNode, 3> kMiddleSecond{0, 2, 1};

constexpr const char* kStabilised =
    "stabilised, so that it locks less than theirs; formulation = \"full\" integrates as CalculiX does";

constexpr const char* kNodal =
    "at its nodes where it yields or nu > 0.4, so that it locks less than theirs; formulation = \"full\" integrates as "
    "CalculiX does";

constexpr const char* kVolume = "with mean dilatation where it yields or nu > 0.4; formulation = \"full\" has none";

const std::array<DeckElementType, 65> kTypes{
    {{"C3D4", Kind::cell, CellType::tetra4, 4, {}, "solid", "", kNodal},
     {"C3D5", Kind::cell, CellType::pyra5, 5, {}, "solid", "", ""},
     {"C3D6", Kind::cell, CellType::penta6, 6, {}, "solid", "", ""},
     {"C3D8", Kind::cell, CellType::hexa8, 8, {}, "solid", "", kStabilised},
     {"C3D8I", Kind::cell, CellType::hexa8, 8, {}, "solid", "", "with enhanced strains in closed form (stabilised)"},
     {"C3D8R",
      Kind::cell,
      CellType::hexa8,
      8,
      {},
      "solid",
      "one_point",
      "one point with Carom's own hourglass control"},
     {"C3D10", Kind::cell, CellType::tetra10, 10, {}, "solid", "", ""},
     {"C3D10M",
      Kind::cell,
      CellType::tetra10,
      10,
      {},
      "solid",
      "",
      "not the modified element of Abaqus, but one with mean dilatation"},
     {"C3D15", Kind::cell, CellType::penta15, 15, {}, "solid", "", ""},
     {"C3D20", Kind::cell, CellType::hexa20, 20, {}, "solid", "", kVolume},
     {"C3D20R", Kind::cell, CellType::hexa20, 20, {}, "solid", "reduced", ""},
     {"C3D27", Kind::cell, CellType::hexa27, 27, kHexa27, "solid", "", kVolume},
     {"CPE3", Kind::cell, CellType::tria3, 3, {}, "plane_strain", "", kNodal},
     {"CPE4", Kind::cell, CellType::quad4, 4, {}, "plane_strain", "", kStabilised},
     {"CPE4R",
      Kind::cell,
      CellType::quad4,
      4,
      {},
      "plane_strain",
      "one_point",
      "one point with Carom's own hourglass control"},
     {"CPE4I",
      Kind::cell,
      CellType::quad4,
      4,
      {},
      "plane_strain",
      "",
      "with enhanced strains in closed form (stabilised)"},
     {"CPE6", Kind::cell, CellType::tria6, 6, {}, "plane_strain", "", ""},
     {"CPE8", Kind::cell, CellType::quad8, 8, {}, "plane_strain", "", kVolume},
     {"CPE8R", Kind::cell, CellType::quad8, 8, {}, "plane_strain", "reduced", ""},
     {"CPS3", Kind::cell, CellType::tria3, 3, {}, "plane_stress", "", ""},
     {"CPS4", Kind::cell, CellType::quad4, 4, {}, "plane_stress", "", kStabilised},
     {"CPS4R",
      Kind::cell,
      CellType::quad4,
      4,
      {},
      "plane_stress",
      "one_point",
      "one point with Carom's own hourglass control"},
     {"CPS4I",
      Kind::cell,
      CellType::quad4,
      4,
      {},
      "plane_stress",
      "",
      "with enhanced strains in closed form (stabilised)"},
     {"CPS6", Kind::cell, CellType::tria6, 6, {}, "plane_stress", "", ""},
     {"CPS8", Kind::cell, CellType::quad8, 8, {}, "plane_stress", "", ""},
     {"CPS8R", Kind::cell, CellType::quad8, 8, {}, "plane_stress", "reduced", ""},
     {"CAX3", Kind::cell, CellType::tria3, 3, {}, "axisymmetric", "", kNodal},
     {"CAX4", Kind::cell, CellType::quad4, 4, {}, "axisymmetric", "", kStabilised},
     {"CAX4R",
      Kind::cell,
      CellType::quad4,
      4,
      {},
      "axisymmetric",
      "one_point",
      "one point with Carom's own hourglass control"},
     {"CAX6", Kind::cell, CellType::tria6, 6, {}, "axisymmetric", "", ""},
     {"CAX8", Kind::cell, CellType::quad8, 8, {}, "axisymmetric", "", kVolume},
     {"CAX8R", Kind::cell, CellType::quad8, 8, {}, "axisymmetric", "reduced", ""},
     {"T2D2", Kind::cell, CellType::line2, 2, {}, "bar", "", ""},
     {"T3D2", Kind::cell, CellType::line2, 2, {}, "bar", "", ""},
     {"S3", Kind::cell, CellType::tria3, 3, {}, "", "", ""},
     {"S3R", Kind::cell, CellType::tria3, 3, {}, "", "", ""},
     {"M3D3", Kind::cell, CellType::tria3, 3, {}, "", "", ""},
     {"R3D3", Kind::cell, CellType::tria3, 3, {}, "", "", ""},
     {"SFM3D3", Kind::cell, CellType::tria3, 3, {}, "", "", ""},
     {"S6", Kind::cell, CellType::tria6, 6, {}, "", "", ""},
     {"M3D6", Kind::cell, CellType::tria6, 6, {}, "", "", ""},
     {"STRI65", Kind::cell, CellType::tria6, 6, {}, "", "", ""},
     {"SFM3D6", Kind::cell, CellType::tria6, 6, {}, "", "", ""},
     {"S4", Kind::cell, CellType::quad4, 4, {}, "", "", ""},
     {"S4R", Kind::cell, CellType::quad4, 4, {}, "", "", ""},
     {"M3D4", Kind::cell, CellType::quad4, 4, {}, "", "", ""},
     {"M3D4R", Kind::cell, CellType::quad4, 4, {}, "", "", ""},
     {"R3D4", Kind::cell, CellType::quad4, 4, {}, "", "", ""},
     {"SFM3D4", Kind::cell, CellType::quad4, 4, {}, "", "", ""},
     {"SFM3D4R", Kind::cell, CellType::quad4, 4, {}, "", "", ""},
     {"S8", Kind::cell, CellType::quad8, 8, {}, "", "", ""},
     {"S8R", Kind::cell, CellType::quad8, 8, {}, "", "", ""},
     {"M3D8", Kind::cell, CellType::quad8, 8, {}, "", "", ""},
     {"M3D8R", Kind::cell, CellType::quad8, 8, {}, "", "", ""},
     {"SFM3D8", Kind::cell, CellType::quad8, 8, {}, "", "", ""},
     {"B31", Kind::cell, CellType::line2, 2, {}, "", "", ""},
     {"R2D2", Kind::cell, CellType::line2, 2, {}, "", "", ""},
     {"RAX2", Kind::cell, CellType::line2, 2, {}, "", "", ""},
     {"T3D3", Kind::cell, CellType::line3, 3, kMiddleSecond, "", "", ""},
     {"B32", Kind::cell, CellType::line3, 3, kMiddleSecond, "", "", ""},
     {"B32R", Kind::cell, CellType::line3, 3, kMiddleSecond, "", "", ""},
     {"MASS", Kind::mass, CellType::point1, 1, {}, "", "", ""},
     {"ROTARYI", Kind::inertia, CellType::point1, 1, {}, "", "", ""},
     {"SPRINGA", Kind::spring, CellType::line2, 2, {}, "", "", ""},
     {"SPRING1", Kind::ground_spring, CellType::point1, 1, {}, "", "", ""}}};

}  // namespace

std::span<const DeckElementType> deck_element_types() {
  return kTypes;
}

const DeckElementType* deck_element_type(std::string_view name) {
  const auto found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const DeckElementType& t) { return t.name == name; });
  return found == kTypes.end() ? nullptr : &*found;
}

}  // namespace carom
