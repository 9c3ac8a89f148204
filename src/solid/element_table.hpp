// The elements there are: which cells under which formulation a part can be made of.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "element/cell_list.hpp"
#include "element/formulation.hpp"
#include "kernels/stages.hpp"
#include "model/model.hpp"

namespace carom {

/// One row of the table.
struct Element {
  CellType type{};
  Section section{};
  Formulation formulation{};
  CellKind kind{};
  std::optional<VolumeField> dilatation{};  ///< of cells under mean dilatation
};

/// All rows. The first of a type and section is the one that parts without a formulation get (cells of second order
/// that keep their volume: that with a linear volume, build/parts.cpp).
std::span<const Element> elements();

/// The row; nullptr where there is none.
const Element* find_element(CellType type, Section section, std::optional<Formulation> formulation);

/// "full", "mean_dilatation", "one_point".
std::string_view name(Formulation formulation);

/// What a message says of a section: its cell types; and of a cell type in it: the names of its formulations.
std::string types_of(Section section);
std::string formulations_of(CellType type, Section section);

}  // namespace carom
