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
    {{.name = "C3D4", .type = CellType::tetra4, .nodes = 4, .section = "solid", .remark = kNodal},
     {.name = "C3D5", .type = CellType::pyra5, .nodes = 5, .section = "solid"},
     {.name = "C3D6", .type = CellType::penta6, .nodes = 6, .section = "solid"},
     {.name = "C3D8", .type = CellType::hexa8, .nodes = 8, .section = "solid", .remark = kStabilised},
     {.name = "C3D8I",
      .type = CellType::hexa8,
      .nodes = 8,
      .section = "solid",
      .remark = "with enhanced strains in closed form (stabilised)"},
     {.name = "C3D8R",
      .type = CellType::hexa8,
      .nodes = 8,
      .section = "solid",
      .formulation = "one_point",
      .remark = "one point with Carom's own hourglass control"},
     {.name = "C3D10", .type = CellType::tetra10, .nodes = 10, .section = "solid"},
     {.name = "C3D10M",
      .type = CellType::tetra10,
      .nodes = 10,
      .section = "solid",
      .remark = "not the modified element of Abaqus, but one with mean dilatation"},
     {.name = "C3D15", .type = CellType::penta15, .nodes = 15, .section = "solid", .remark = kVolume},
     {.name = "C3D20", .type = CellType::hexa20, .nodes = 20, .section = "solid", .remark = kVolume},
     {.name = "C3D20R", .type = CellType::hexa20, .nodes = 20, .section = "solid", .formulation = "reduced"},
     {.name = "C3D27",
      .type = CellType::hexa27,
      .nodes = 27,
      .order = kHexa27InDecks,
      .section = "solid",
      .remark = kVolume},
     {.name = "CPE3", .type = CellType::tria3, .nodes = 3, .section = "plane_strain", .remark = kNodal},
     {.name = "CPE4", .type = CellType::quad4, .nodes = 4, .section = "plane_strain", .remark = kStabilised},
     {.name = "CPE4R",
      .type = CellType::quad4,
      .nodes = 4,
      .section = "plane_strain",
      .formulation = "one_point",
      .remark = "one point with Carom's own hourglass control"},
     {.name = "CPE4I",
      .type = CellType::quad4,
      .nodes = 4,
      .section = "plane_strain",
      .remark = "with enhanced strains in closed form (stabilised)"},
     {.name = "CPE6", .type = CellType::tria6, .nodes = 6, .section = "plane_strain"},
     {.name = "CPE8", .type = CellType::quad8, .nodes = 8, .section = "plane_strain", .remark = kVolume},
     {.name = "CPE8R", .type = CellType::quad8, .nodes = 8, .section = "plane_strain", .formulation = "reduced"},
     {.name = "CPS3", .type = CellType::tria3, .nodes = 3, .section = "plane_stress"},
     {.name = "CPS4", .type = CellType::quad4, .nodes = 4, .section = "plane_stress", .remark = kStabilised},
     {.name = "CPS4R",
      .type = CellType::quad4,
      .nodes = 4,
      .section = "plane_stress",
      .formulation = "one_point",
      .remark = "one point with Carom's own hourglass control"},
     {.name = "CPS4I",
      .type = CellType::quad4,
      .nodes = 4,
      .section = "plane_stress",
      .remark = "with enhanced strains in closed form (stabilised)"},
     {.name = "CPS6", .type = CellType::tria6, .nodes = 6, .section = "plane_stress"},
     {.name = "CPS8", .type = CellType::quad8, .nodes = 8, .section = "plane_stress"},
     {.name = "CPS8R", .type = CellType::quad8, .nodes = 8, .section = "plane_stress", .formulation = "reduced"},
     {.name = "CAX3", .type = CellType::tria3, .nodes = 3, .section = "axisymmetric", .remark = kNodal},
     {.name = "CAX4", .type = CellType::quad4, .nodes = 4, .section = "axisymmetric", .remark = kStabilised},
     {.name = "CAX4R",
      .type = CellType::quad4,
      .nodes = 4,
      .section = "axisymmetric",
      .formulation = "one_point",
      .remark = "one point with Carom's own hourglass control"},
     {.name = "CAX6", .type = CellType::tria6, .nodes = 6, .section = "axisymmetric"},
     {.name = "CAX8", .type = CellType::quad8, .nodes = 8, .section = "axisymmetric", .remark = kVolume},
     {.name = "CAX8R", .type = CellType::quad8, .nodes = 8, .section = "axisymmetric", .formulation = "reduced"},
     {.name = "T2D2", .type = CellType::line2, .nodes = 2, .section = "bar"},
     {.name = "T3D2", .type = CellType::line2, .nodes = 2, .section = "bar"},
     {.name = "S3", .type = CellType::tria3, .nodes = 3},
     {.name = "S3R", .type = CellType::tria3, .nodes = 3},
     {.name = "M3D3", .type = CellType::tria3, .nodes = 3},
     {.name = "R3D3", .type = CellType::tria3, .nodes = 3},
     {.name = "SFM3D3", .type = CellType::tria3, .nodes = 3},
     {.name = "S6", .type = CellType::tria6, .nodes = 6},
     {.name = "M3D6", .type = CellType::tria6, .nodes = 6},
     {.name = "STRI65", .type = CellType::tria6, .nodes = 6},
     {.name = "SFM3D6", .type = CellType::tria6, .nodes = 6},
     {.name = "S4", .type = CellType::quad4, .nodes = 4},
     {.name = "S4R", .type = CellType::quad4, .nodes = 4},
     {.name = "M3D4", .type = CellType::quad4, .nodes = 4},
     {.name = "M3D4R", .type = CellType::quad4, .nodes = 4},
     {.name = "R3D4", .type = CellType::quad4, .nodes = 4},
     {.name = "SFM3D4", .type = CellType::quad4, .nodes = 4},
     {.name = "SFM3D4R", .type = CellType::quad4, .nodes = 4},
     {.name = "S8", .type = CellType::quad8, .nodes = 8},
     {.name = "S8R", .type = CellType::quad8, .nodes = 8},
     {.name = "M3D8", .type = CellType::quad8, .nodes = 8},
     {.name = "M3D8R", .type = CellType::quad8, .nodes = 8},
     {.name = "SFM3D8", .type = CellType::quad8, .nodes = 8},
     {.name = "B31", .type = CellType::line2, .nodes = 2},
     {.name = "R2D2", .type = CellType::line2, .nodes = 2},
     {.name = "RAX2", .type = CellType::line2, .nodes = 2},
     {.name = "T3D3", .type = CellType::line3, .nodes = 3, .order = kMiddleSecond},
     {.name = "B32", .type = CellType::line3, .nodes = 3, .order = kMiddleSecond},
     {.name = "B32R", .type = CellType::line3, .nodes = 3, .order = kMiddleSecond},
     {.name = "MASS", .kind = Kind::mass, .type = CellType::point1, .nodes = 1},
     {.name = "ROTARYI", .kind = Kind::inertia, .type = CellType::point1, .nodes = 1},
     {.name = "SPRINGA", .kind = Kind::spring, .type = CellType::line2, .nodes = 2},
     {.name = "SPRING1", .kind = Kind::ground_spring, .type = CellType::point1, .nodes = 1}}};

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
  static const DeckElementType unknown{.name = "?", .kind = Kind::unknown, .type = CellType::point1};
  return unknown;
}

}  // namespace carom
