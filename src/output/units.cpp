#include "output/units.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace carom {

namespace {

/// Unit of a moment: a force times a length, and so on; empty when a factor is unknown.
std::string product(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? std::string() : a + " " + b;
}

std::string per(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? std::string() : a + "/" + b;
}

/// The part of a column name that says what it holds: "B.displacement_z" -> "displacement".
std::string_view quantity_of(std::string_view column) {
  const std::size_t dot = column.rfind('.');
  if (dot != std::string_view::npos) column.remove_prefix(dot + 1);
  for (const std::string_view tail :
       {"_x", "_y", "_z", "_xx", "_yy", "_zz", "_xy", "_yz", "_xz", "_zx", "_yx", "_zy"}) {
    if (column.ends_with(tail)) return column.substr(0, column.size() - tail.size());
  }
  return column;
}

}  // namespace

Units units_of(std::string_view label) {
  if (label == "SI") return {"m", "s", "kg", "N", "Pa", "J"};
  if (label == "mm-t-s") return {"mm", "s", "t", "N", "MPa", "mJ"};
  if (label == "mm-kg-ms") return {"mm", "ms", "kg", "kN", "GPa", "J"};
  return {};
}

std::string units_comment(const Units& units) {
  return fmt::format("units: {}, {}, {}, {}, {}, {}", units.length, units.time, units.mass, units.force, units.stress,
                     units.energy);
}

std::optional<Units> parse_units_comment(std::string_view comment) {
  constexpr std::string_view begin = "units: ";
  if (!comment.starts_with(begin)) return std::nullopt;
  comment.remove_prefix(begin.size());
  std::vector<std::string> names(1);
  for (const char c : comment) {
    if (c == ',') {
      names.emplace_back();
    } else if (c != ' ') {
      names.back() += c;
    }
  }
  if (names.size() != 6) return std::nullopt;
  return Units{names[0], names[1], names[2], names[3], names[4], names[5]};
}

std::string unit_of_column(const Units& units, std::string_view column) {
  const std::string_view quantity = quantity_of(column);
  const std::string velocity = per(units.length, units.time);
  if (quantity == "time" || quantity == "dt") return units.time;
  if (quantity == "displacement" || quantity == "penetration") return units.length;
  if (quantity == "velocity") return velocity;
  if (quantity == "acceleration") return velocity.empty() ? std::string() : velocity + "²";
  if (quantity == "stress") return units.stress;
  if (quantity == "force" || quantity == "section_force") return units.force;
  if (quantity == "impulse") return product(units.force, units.time);
  if (quantity == "momentum") return product(units.mass, velocity);
  if (quantity == "angular_momentum")
    return velocity.empty() ? std::string() : product(units.mass, units.length + "²/" + units.time);
  constexpr std::array<std::string_view, 16> energies{"kinetic",    "strain",        "contact_stored", "friction",
                                                      "damping",    "external_work", "support_work",   "algorithmic",
                                                      "quadrature", "imbalance",     "ENER_CIN",       "ENER_TOT",
                                                      "TRAV_EXT",   "TRAV_AMOR",     "TRAV_LIAI",      "DISS_SCH"};
  for (const std::string_view energy : energies) {
    if (quantity == energy) return units.energy;
  }
  return {};
}

}  // namespace carom
