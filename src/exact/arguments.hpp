// Checks of the numbers given to an exact solution.
#pragma once

#include <initializer_list>
#include <string_view>

namespace carom {

struct NamedNumber {
  std::string_view name;
  double value = 0.0;
};

/// Throws std::invalid_argument "<whose>: <name> is <value>, expected ..." at the first number that is not positive
/// and finite.
void require_positive(std::string_view whose, std::initializer_list<NamedNumber> numbers);

/// The same for numbers that may also be zero.
void require_not_negative(std::string_view whose, std::initializer_list<NamedNumber> numbers);

}  // namespace carom
