#include "mesh/deck_elements.hpp"

#include <algorithm>
#include <array>
#include <deque>
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

/// What is left out with the keyword that gives it its properties, where that is accepted.
constexpr std::array<DeckElementType, 6> kLeftOut{
    {{.name = "DASHPOTA", .kind = Kind::unknown, .type = CellType::point1, .remark = "left out with its *DASHPOT"},
     {.name = "DASHPOT1", .kind = Kind::unknown, .type = CellType::point1, .remark = "left out with its *DASHPOT"},
     {.name = "DASHPOT2", .kind = Kind::unknown, .type = CellType::point1, .remark = "left out with its *DASHPOT"},
     {.name = "GAPUNI", .kind = Kind::unknown, .type = CellType::point1, .remark = "left out with its *GAP"},
     {.name = "CONN2D2",
      .kind = Kind::unknown,
      .type = CellType::point1,
      .remark = "left out with its *CONNECTOR SECTION"},
     {.name = "CONN3D2",
      .kind = Kind::unknown,
      .type = CellType::point1,
      .remark = "left out with its *CONNECTOR SECTION"}}};

/// Types that are otherwise those whose names lack the suffix.
struct Twins {
  std::string_view suffix, remark;
  std::vector<std::string_view> names;
};

const std::array<Twins, 2> kTwins{
    {{"T", "its nodes have no temperatures", {"C3D4T",   "C3D6T",  "C3D8T",  "C3D8RT", "C3D10T", "C3D10MT", "C3D20T",
                                              "C3D20RT", "CPE3T",  "CPE4T",  "CPE4RT", "CPE6T",  "CPE8T",   "CPE8RT",
                                              "CPS3T",   "CPS4T",  "CPS4RT", "CPS6T",  "CPS8T",  "CPS8RT",  "CAX3T",
                                              "CAX4T",   "CAX4RT", "CAX6T",  "CAX8T",  "CAX8RT"}},
     {"H",
      "its pressure is no unknown of its own, so that nu has to be below 0.5",
      {"C3D4H",  "C3D6H",   "C3D8H", "C3D8IH", "C3D8RH", "C3D10H", "C3D10MH", "C3D15H",
       "C3D20H", "C3D20RH", "CPE3H", "CPE4H",  "CPE4RH", "CPE4IH", "CPE6H",   "CPE8H",
       "CPE8RH", "CAX3H",   "CAX4H", "CAX4RH", "CAX6H",  "CAX8H",  "CAX8RH"}}}};

std::vector<DeckElementType> all_types() {
  static std::deque<std::string> remarks;
  std::vector<DeckElementType> types(kOwn.begin(), kOwn.end());
  types.insert(types.end(), kLeftOut.begin(), kLeftOut.end());
  for (const Twins& family : kTwins)
    for (const std::string_view name : family.names) {
      const std::string_view twin = name.substr(0, name.size() - family.suffix.size());
      DeckElementType type = *std::ranges::find(kOwn, twin, &DeckElementType::name);
      type.name = name;
      const std::string own(type.remark);
      type.remark = remarks.emplace_back(std::string(family.remark) + (own.empty() ? "" : "; " + own));
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
