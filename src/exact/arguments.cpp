#include "exact/arguments.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace carom {

namespace {

void require(bool good, std::string_view whose, const NamedNumber& number, std::string_view expected) {
  if (!good)
    throw std::invalid_argument(fmt::format("{}: {} is {:g}, expected {}", whose, number.name, number.value, expected));
}

}  // namespace

void require_positive(std::string_view whose, std::initializer_list<NamedNumber> numbers) {
  for (const NamedNumber& number : numbers)
    require(number.value > 0.0 && std::isfinite(number.value), whose, number, "a positive number");
}

void require_not_negative(std::string_view whose, std::initializer_list<NamedNumber> numbers) {
  for (const NamedNumber& number : numbers)
    require(number.value >= 0.0 && std::isfinite(number.value), whose, number, "zero or a positive number");
}

}  // namespace carom
