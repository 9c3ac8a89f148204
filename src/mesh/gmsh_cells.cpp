#include "mesh/gmsh_cells.hpp"

#include <algorithm>
#include <array>

namespace carom {

namespace {

constexpr std::array<LocalNode, 9> kAsWritten{0, 1, 2, 3, 4, 5, 6, 7, 8};
constexpr std::array<LocalNode, 10> kTetra10{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array<LocalNode, 13> kPyra13{0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12};
constexpr std::array<LocalNode, 15> kPenta15{0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11};
constexpr std::array<LocalNode, 20> kHexa20{0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
constexpr std::array<LocalNode, 27> kHexa27{0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                            19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};

struct Entry {
  std::int64_t number;
  GmshCellType cell;
};

const std::array<Entry, 17> kGmshTypes{{{1, {CellType::line2, kAsWritten}},
                                        {2, {CellType::tria3, kAsWritten}},
                                        {3, {CellType::quad4, kAsWritten}},
                                        {4, {CellType::tetra4, kAsWritten}},
                                        {5, {CellType::hexa8, kAsWritten}},
                                        {6, {CellType::penta6, kAsWritten}},
                                        {7, {CellType::pyra5, kAsWritten}},
                                        {8, {CellType::line3, kAsWritten}},
                                        {9, {CellType::tria6, kAsWritten}},
                                        {10, {CellType::quad9, kAsWritten}},
                                        {11, {CellType::tetra10, kTetra10}},
                                        {12, {CellType::hexa27, kHexa27}},
                                        {15, {CellType::point1, kAsWritten}},
                                        {16, {CellType::quad8, kAsWritten}},
                                        {17, {CellType::hexa20, kHexa20}},
                                        {18, {CellType::penta15, kPenta15}},
                                        {19, {CellType::pyra13, kPyra13}}}};

}  // namespace

const GmshCellType* gmsh_cell_type(std::int64_t number) {
  const auto found =
      std::find_if(kGmshTypes.begin(), kGmshTypes.end(), [&](const Entry& e) { return e.number == number; });
  return found == kGmshTypes.end() ? nullptr : &found->cell;
}

}  // namespace carom
