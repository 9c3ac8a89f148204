#include "run/exact_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace carom {

namespace {

BarImpact make_bar(const CaseExact& e) {
  const bool rigid = *e.solution == "bar_on_rigid_wall";
  try {
    return BarImpact({e.length, e.modulus, e.density, e.area, e.speed, e.gap, rigid ? 0.0 : e.stiffness});
  } catch (const std::invalid_argument& error) {
    throw CaseError(e.where, "exact", error.what(), "the data of a bar that flies against a wall");
  }
}

/// Lowest coordinate of the parts along the axis: the face that hits the wall.
double foot(const Simulation& simulation, std::size_t axis) {
  double lowest = std::numeric_limits<double>::infinity();
  const std::vector<Index>& connectivity = simulation.mesh().block(CellType::hexa8)->connectivity;
  for (const Index cell : simulation.solid().cells()) {
    for (std::size_t a = 0; a < 8; ++a) {
      const auto n = static_cast<std::size_t>(connectivity[8 * static_cast<std::size_t>(cell) + a]);
      lowest = std::min(lowest, simulation.mesh().coordinates[n][axis]);
    }
  }
  return lowest;
}

}  // namespace

ExactCurves::ExactCurves(const Simulation& simulation, const ProbeCurves& probes)
    : bar_(make_bar(*simulation.given().exact)), initial_displacement_(simulation.given().exact->initial_displacement) {
  const Case& given = simulation.given();
  const auto axis = static_cast<std::size_t>(given.exact->axis);
  const char letter = "xyz"[axis];
  const double z0 = foot(simulation, axis);
  for (std::size_t p = 0; p < given.probes.size(); ++p) {
    const std::string& probe = *given.probes[p].name;
    const double z = std::clamp(probes.positions()[p][axis] - z0, 0.0, given.exact->length);
    columns_.push_back({fmt::format("{}.displacement_{}", probe, letter), Quantity::displacement, z});
    columns_.push_back({fmt::format("{}.velocity_{}", probe, letter), Quantity::velocity, z});
    columns_.push_back({fmt::format("{}.stress_{}{}", probe, letter, letter), Quantity::stress, z});
  }
  if (given.contacts.size() == 1) {
    columns_.push_back({fmt::format("{}.force_{}", *given.contacts[0].name, letter), Quantity::force});
  }
  std::erase_if(columns_,
                [&](const Column& c) { return c.quantity != Quantity::force && !probes.table().find(c.name); });
  columns_.push_back({"kinetic", Quantity::kinetic});
  columns_.push_back({"strain", Quantity::strain});
  columns_.push_back({"contact_stored", Quantity::contact_stored});
  table_.columns = {"time"};
  for (const Column& c : columns_) table_.columns.push_back(c.name);
}

double ExactCurves::evaluate(const Column& column, double t) const {
  switch (column.quantity) {
    case Quantity::displacement:
      return initial_displacement_ + bar_.displacement(column.z, t);
    case Quantity::velocity:
      return bar_.velocity(column.z, t);
    case Quantity::stress:
      return bar_.stress(column.z, t);
    case Quantity::force:
      return bar_.contact_force(t);
    case Quantity::kinetic:
      return bar_.kinetic_energy(t);
    case Quantity::strain:
      return bar_.strain_energy(t);
    case Quantity::contact_stored:
      return bar_.contact_energy(t);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> ExactCurves::value(const std::string& column, double t) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == column; });
  if (found == columns_.end()) return std::nullopt;
  return evaluate(*found, t);
}

void ExactCurves::sample(double t) {
  table_.row = {t};
  for (const Column& c : columns_) table_.row.push_back(evaluate(c, t));
}

}  // namespace carom
