#include "mesh/deck_elements.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace carom {

namespace {

using Kind = DeckElementType::Kind;

/// The deck has the centre of the cell before those of its faces, which it numbers as it does its faces.
constexpr std::array<LocalNode, 27> kHexa27InDecks{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                                   14, 15, 16, 17, 18, 19, 26, 24, 23, 25, 21, 22, 20};
constexpr std::array<LocalNode, 3> kMiddleSecond{0, 2, 1};

constexpr const char* kStabilised =
    "stabilised, so that it locks less than theirs; formulation = \"full\" integrates as CalculiX does";

constexpr const char* kNodal =
    "at its nodes where it yields or nu > 0.4, so that it locks less than theirs; formulation = \"full\" integrates as "
    "CalculiX does";

constexpr const char* kVolume = "with mean dilatation where it yields or nu > 0.4; formulation = \"full\" has none";

const std::array<DeckElementType, 65> kOwn{
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
     {"C3D15", Kind::cell, CellType::penta15, 15, {}, "solid", "", kVolume},
     {"C3D20", Kind::cell, CellType::hexa20, 20, {}, "solid", "", kVolume},
     {"C3D20R", Kind::cell, CellType::hexa20, 20, {}, "solid", "reduced", ""},
     {"C3D27", Kind::cell, CellType::hexa27, 27, kHexa27InDecks, "solid", "", kVolume},
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

/// The types that also have the temperature of their nodes; without it they are those whose name lacks the T.
constexpr std::array kWithTemperature{"C3D4T",   "C3D6T",  "C3D8T",  "C3D8RT", "C3D10T", "C3D10MT", "C3D20T",
                                      "C3D20RT", "CPE3T",  "CPE4T",  "CPE4RT", "CPE6T",  "CPE8T",   "CPE8RT",
                                      "CPS3T",   "CPS4T",  "CPS4RT", "CPS6T",  "CPS8T",  "CPS8RT",  "CAX3T",
                                      "CAX4T",   "CAX4RT", "CAX6T",  "CAX8T",  "CAX8RT"};

std::vector<DeckElementType> all_types() {
  static std::array<std::string, kWithTemperature.size()> remarks;
  std::vector<DeckElementType> types(kOwn.begin(), kOwn.end());
  for (std::size_t i = 0; i < kWithTemperature.size(); ++i) {
    std::string_view twin = kWithTemperature[i];
    twin.remove_suffix(1);
    DeckElementType type = *std::find_if(kOwn.begin(), kOwn.end(), [&](const auto& own) { return own.name == twin; });
    type.name = kWithTemperature[i];
    remarks[i] = std::string("its nodes have no temperatures") + (type.remark.empty() ? "" : "; ");
    remarks[i] += type.remark;
    type.remark = remarks[i];
    types.push_back(type);
  }
  return types;
}

}  // namespace

std::span<const DeckElementType> deck_element_types() {
  static const std::vector<DeckElementType> types = all_types();
  return types;
}

const DeckElementType* deck_element_type(std::string_view name) {
  const std::span<const DeckElementType> types = deck_element_types();
  const auto found = std::find_if(types.begin(), types.end(), [&](const DeckElementType& t) { return t.name == name; });
  return found == types.end() ? nullptr : &*found;
}

const DeckElementType& unknown_element_type() {
  static const DeckElementType unknown{"?", Kind::unknown, CellType::point1, 0, {}, "", "", ""};
  return unknown;
}

}  // namespace carom
