#include "record/part_extremes.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "record/stress_measures.hpp"

namespace carom {
namespace {

struct Extreme {
  std::string_view quantity;
  double (*of_stress)(const Voigt&) = nullptr;  ///< null: of the plastic strain
  bool is_smallest = false;
};

const Extreme extremes[] = {
    {"largest_von_mises", [](const Voigt& s) { return von_mises(s); }},
    {"largest_principal_stress", [](const Voigt& s) { return principal_stress(s)[0]; }},
    {"smallest_principal_stress", [](const Voigt& s) { return principal_stress(s)[2]; }, true},
    {"largest_pressure", pressure},
    {"largest_plastic_strain"},
};

const Extreme* find_extreme(std::string_view quantity) {
  const auto* const found = std::ranges::find(extremes, quantity, &Extreme::quantity);
  return found == std::end(extremes) ? nullptr : found;
}

}  // namespace

bool is_part_extreme(std::string_view quantity) {
  return find_extreme(quantity) != nullptr;
}

bool is_extreme_of_stress(std::string_view quantity) {
  const Extreme* found = find_extreme(quantity);
  return found != nullptr && found->of_stress != nullptr;
}

double part_extreme(std::string_view quantity, std::span<const Index> cells, FieldsNow& now) {
  const Extreme& wanted = *find_extreme(quantity);
  const std::span<const std::uint8_t> alive = now.view.state.alive();
  std::vector<double> values;
  const auto collect = [&](const auto& of) {
    for (const Index k : cells)
      if (alive.empty() || alive[at(k)] != 0) values.push_back(of(at(k)));
  };
  if (wanted.of_stress != nullptr) {
    const std::vector<Voigt>& stress = now.stress();
    collect([&](std::size_t k) { return wanted.of_stress(stress[k]); });
  } else {
    const FieldValues strain = now.evaluate("equivalent_plastic_strain");
    collect([&](std::size_t k) { return strain.values[k]; });
  }
  if (values.empty()) return 0.0;  // all have gone
  return wanted.is_smallest ? std::ranges::min(values) : std::ranges::max(values);
}

}  // namespace carom
