// The largest and smallest values of one part.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "record/field_values.hpp"

namespace carom {

/// Is this quantity of parts (output/quantities.hpp) an extreme over the cells, and does it need their stresses?
bool is_part_extreme(std::string_view quantity);
bool is_extreme_of_stress(std::string_view quantity);

/// Its value over these cells (positions in Solid::cells()) that are there: of a field's means over cells.
double part_extreme(std::string_view quantity, std::span<const Index> cells, FieldsNow& now);

}  // namespace carom
