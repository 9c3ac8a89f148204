#include "output/readable_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

namespace carom {

namespace {

struct Prefix {
  std::string_view sign;
  int power;
};
constexpr std::array<Prefix, 8> prefixes{
    {{"n", -9}, {"µ", -6}, {"m", -3}, {"", 0}, {"k", 3}, {"M", 6}, {"G", 9}, {"T", 12}}};

/// A unit that may stand behind a prefix, and the largest prefix that is usual for it.
struct BaseUnit {
  std::string_view name;
  int most;
};
constexpr std::array<BaseUnit, 5> base_units{{{"m", 3}, {"s", 0}, {"N", 9}, {"Pa", 12}, {"J", 12}}};

/// The prefix and the base unit of "MPa"; nothing for "kg" and "t".
std::optional<std::pair<Prefix, BaseUnit>> parts_of(std::string_view unit) {
  for (const BaseUnit& base : base_units) {
    for (const Prefix& prefix : prefixes) {
      if (unit.size() == prefix.sign.size() + base.name.size() && unit.starts_with(prefix.sign) &&
          unit.ends_with(base.name))
        return std::pair{prefix, base};
    }
  }
  return std::nullopt;
}

std::string superscript(int number) {
  static constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(number))) text += digits.at(static_cast<std::size_t>(c - '0'));
  return text;
}

}  // namespace

std::string number_text(double value, int digits) {
  return std::isnan(value) ? "–" : fmt::format("{:.{}g}", value, digits);
}

ReadableUnit readable_unit(double largest, const std::string& unit) {
  if (!(largest > 0.0) || !std::isfinite(largest) || (largest >= 0.1 && largest < 1e3)) return {0, unit};
  const int power = 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0));
  const std::size_t end = std::min(unit.find_first_of(" /"), unit.size());
  const std::string_view first(unit.data(), end);
  if (const auto parts = parts_of(first)) {
    const auto& [prefix, base] = *parts;
    const int least = end == unit.size() ? -9 : -6, wanted = std::clamp(prefix.power + power, least, base.most);
    const auto* const found =
        std::find_if(prefixes.begin(), prefixes.end(), [&, now = wanted](const Prefix& p) { return p.power == now; });
    const int rest = prefix.power + power - wanted;
    if (rest == 0) return {power, fmt::format("{}{}{}", found->sign, base.name, unit.substr(end))};
  }
  if (largest >= 0.1 && largest < 1e4) return {0, unit};
  return {power, fmt::format("10{}{}{}", superscript(power), unit.empty() ? "" : " ", unit)};
}

std::string with_readable_unit(double value, const std::string& unit, int digits) {
  const ReadableUnit readable = readable_unit(std::abs(value), unit);
  const std::string number = number_text(value * std::pow(10.0, -readable.power), digits);
  return readable.name.empty() || std::isnan(value) ? number : number + " " + readable.name;
}

}  // namespace carom
