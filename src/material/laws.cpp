#include <algorithm>
#include <stdexcept>

#include "material/law_list.hpp"

namespace carom {

namespace {

Material elastic(const char* law, const IsotropicElastic& given) {
  return {law, given.rho, {{"E", given.E}, {"nu", given.nu}}};
}

const Law& row_of(std::string_view name) {
  const Law* law = find_law(name);
  if (law == nullptr) throw std::invalid_argument("no law " + std::string(name));
  return *law;
}

std::size_t position(const Law& law, std::string_view key) {
  const auto it = std::find_if(law.parameters.begin(), law.parameters.end(),
                               [&](const LawParameter& parameter) { return parameter.key == key; });
  if (it == law.parameters.end())
    throw std::invalid_argument("law " + law.name + " has no parameter " + std::string(key));
  return static_cast<std::size_t>(it - law.parameters.begin());
}

}  // namespace

Material::Material(const LinearElastic& given) : Material(elastic("linear_elastic", given)) {}
Material::Material(const StVenantKirchhoff& given) : Material(elastic("st_venant_kirchhoff", given)) {}
Material::Material(const NeoHookean& given) : Material(elastic("neo_hookean", given)) {}

Material::Material(std::string_view law_name, double rho_,
                   const std::vector<std::pair<std::string_view, double>>& given)
    : Material(row_of(law_name), rho_, given) {}

Material::Material(const Law& row, double rho_, const std::vector<std::pair<std::string_view, double>>& given)
    : law(&row), rho(rho_) {
  for (const LawParameter& parameter : law->parameters) values.push_back(parameter.initial.value_or(0.0));
  for (const auto& [key, value] : given) values[position(*law, key)] = value;
}

double Material::value(std::string_view key) const {
  return values[position(*law, key)];
}

std::vector<std::string> Material::history() const {
  std::vector<std::string> names = law->history;
  if (damage) names.emplace_back(damaged_by);
  return names;
}

IsotropicElastic Material::at_rest() const {
  return law->at_rest(*this);
}

const std::vector<Law>& laws() {
#define CAROM_LAW_ROW(law) law##_row(),
  static const std::vector<Law> rows{CAROM_LAWS(CAROM_LAW_ROW)};
#undef CAROM_LAW_ROW
  return rows;
}

const Law* find_law(std::string_view name) {
  const auto it = std::find_if(laws().begin(), laws().end(), [name](const Law& law) { return law.name == name; });
  return it == laws().end() ? nullptr : &*it;
}

std::size_t index_of(const Law& law) {
  return static_cast<std::size_t>(&law - laws().data());
}

}  // namespace carom
