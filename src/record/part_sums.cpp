#include "record/part_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "math/vec3.hpp"
#include "output/quantities.hpp"
#include "record/part_extremes.hpp"
#include "solid/solid.hpp"

namespace carom {

namespace {

[[noreturn]] void refuse(const CaseProbe& given, const std::string& found, const std::string& expected) {
  throw CaseError(given.part->where, "probe.part", found, expected);
}

}  // namespace

bool PartSums::is_known_to_all(std::string_view quantity) {
  const Quantity* found = find_quantity(quantity);
  return found != nullptr && found->place == Place::part && !is_part_extreme(quantity);
}

PartSums::PartSums(const CaseProbe& given, const Simulation& simulation, const CurveTable& parts)
    : simulation_(&simulation), parts_(&parts) {
  const Model& model = simulation.model();
  const std::vector<double>& volumes = simulation.solid().cells().volumes;
  Index body = -1, first = 0;
  bool body_has_others = false;
  for (const Part& part : model.parts) {
    const auto end = first + static_cast<Index>(part.cells.size());
    if (part.name == **given.part) {
      body = part.rigid_body;
      for (Index k = first; k < end; ++k) {
        cells_.push_back(k);
        mass_ += part.material.rho * volumes[at(k)];
      }
    }
    first = end;
  }
  for (const Part& part : model.parts)
    body_has_others = body_has_others || (body >= 0 && part.rigid_body == body && part.name != **given.part);
  if (body_has_others)
    refuse(given, fmt::format("\"{}\", one of several parts of a rigid body", **given.part),
           "a deformable part, or the only part of a rigid body");
  is_rigid_ = body >= 0;
  if (is_rigid_) mass_ = model.turning_bodies[at(body)].mass;
  refuse_extremes(given);
  find_columns(given);
  find_centre();
}

void PartSums::find_columns(const CaseProbe& given) {
  for (const auto& quantity : given.quantities) {
    if (*quantity == "mass" || !is_known_to_all(*quantity)) continue;
    for (const std::string& head : column_names(*quantity)) {
      const std::optional<std::size_t> column = parts_->find(**given.part + "." + head);
      if (!column)
        refuse(given, fmt::format("{} of \"{}\", which nothing in this case has", *quantity, **given.part),
               "what its elements, laws and viscosities have: a column of parts.csv");
      columns_[*quantity].push_back(*column);
    }
  }
}

void PartSums::refuse_extremes(const CaseProbe& given) const {
  const auto yields = [&](const Part& part) {
    return part.name == **given.part && std::ranges::count(part.material.history(), "equivalent_plastic_strain") > 0;
  };
  for (const auto& quantity : given.quantities) {
    if (!is_part_extreme(*quantity)) continue;
    if (is_rigid_)
      refuse(given, fmt::format("{} of \"{}\", a rigid part", *quantity, **given.part), "a part that deforms");
    if (!is_extreme_of_stress(*quantity) && std::ranges::none_of(simulation_->model().parts, yields))
      refuse(given, fmt::format("{} of \"{}\", which does not yield", *quantity, **given.part),
             "a part whose law yields");
  }
}

void PartSums::find_centre() {
  const Solid& solid = simulation_->solid();
  double volume = 0.0;
  for (const Index k : cells_) {
    const std::span<const Index> nodes = solid.cells().nodes_of(at(k));
    const double share = solid.cells().volumes[at(k)] / static_cast<double>(nodes.size());
    for (const Index n : nodes) centre_ = add(centre_, scaled(simulation_->mesh().coordinates[at(n)], share));
    volume += solid.cells().volumes[at(k)];
  }
  centre_ = scaled(centre_, 1.0 / volume);
}

void PartSums::append(std::string_view quantity, FieldsNow& now, std::vector<double>& row) const {
  if (is_part_extreme(quantity)) return row.push_back(part_extreme(quantity, cells_, now));
  if (quantity == "mass") return row.push_back(mass_);
  for (const std::size_t column : columns_.find(quantity)->second) row.push_back(parts_->row[column]);
}

}  // namespace carom
