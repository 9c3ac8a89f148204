#include "material/loaded_law.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <random>
#include <set>

#include "base/checksum.hpp"
#include "material/loaded_update.hpp"

namespace carom {

namespace {

IsotropicElastic loaded_at_rest(const Material& material) {
  IsotropicElastic moduli{0.0, 0.0, material.rho};
  material.law->loaded->at_rest(material.values.data(), &moduli.E, &moduli.nu);
  return moduli;
}

std::shared_ptr<const void> prepare_loaded(const Material& material) {
  const std::shared_ptr<double[]> values(new double[material.values.size()]);
  std::copy(material.values.begin(), material.values.end(), values.get());
  return std::make_shared<const LoadedParameters>(
      LoadedParameters{material.law->loaded, values, material.rho, material.at_rest().lame()});
}

using Strain = std::array<double, 6>;

/// What the law answers to strains of a body at rest before, as it is called by the kernels of so many lanes.
struct Probe {
  Probe(const Material& material, int lanes, const std::vector<Strain>& strains, const std::vector<Strain>& changes)
      : n(static_cast<std::size_t>(lanes)), history(static_cast<std::size_t>(material.law->loaded->history_count)) {
    const carom_law& law = *material.law->loaded;
    const std::size_t count = strains.size();
    std::vector<double> strain(6 * count), change(6 * count), before(history * count), after(history * count);
    std::vector<double> energy(count), lost(count), wave(count);
    stress.resize(6 * count);
    stress_change.resize(6 * count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 6; ++c) {
        strain[place(i, c)] = strains[i][c];
        change[place(i, c)] = changes[i][c];
      }
    const double* values = material.values.data();
    const int points = static_cast<int>(count / n);
    const carom_law_points update{.points = points,
                                  .lanes = lanes,
                                  .parameters = values,
                                  .rho = material.rho,
                                  .dt = 1.0,
                                  .strain = strain.data(),
                                  .history = before.data(),
                                  .is_over = 0,
                                  .stress = stress.data(),
                                  .energy = energy.data(),
                                  .dissipation = lost.data(),
                                  .new_history = after.data(),
                                  .wave_modulus = wave.data(),
                                  .yield_stress = nullptr,
                                  .mode_square = nullptr,
                                  .share = nullptr};
    law.update(&update);
    if (law.tangent == nullptr) return;
    const carom_law_changes tangent{.points = points,
                                    .lanes = lanes,
                                    .parameters = values,
                                    .rho = material.rho,
                                    .dt = 1.0,
                                    .strain = strain.data(),
                                    .history = before.data(),
                                    .strain_change = change.data(),
                                    .stress_change = stress_change.data(),
                                    .mode_square = nullptr,
                                    .half_change = nullptr,
                                    .share = nullptr,
                                    .along = nullptr};
    law.tangent(&tangent);
  }
  std::size_t place(std::size_t i, std::size_t c) const { return (6 * (i / n) + c) * n + i % n; }

  std::size_t n, history;
  std::vector<double> stress, stress_change;
};

/// Strains from small ones to some that make metals yield.
struct Samples {
  Samples() {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (const double size : {1e-6, 1e-4, 1e-3, 1e-2, 0.05})
      for (int k = 0; k < 16; ++k) {
        for (double& component : strains.emplace_back()) component = size * normal(random);
        for (double& component : changes.emplace_back()) component = normal(random);
      }
  }
  std::vector<Strain> strains, changes;
};

/// Where what was computed together differs from what was computed one by one, of its size.
double lane_error(const Material& material, const Samples& samples, int lanes) {
  const Probe together(material, lanes, samples.strains, samples.changes),
      single(material, 1, samples.strains, samples.changes);
  double worst = 0.0;
  const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < samples.strains.size(); ++i) {
      double size = 0.0, error = 0.0;
      for (std::size_t c = 0; c < 6; ++c) {
        const double x = a[together.place(i, c)], y = b[single.place(i, c)];
        size = std::max(size, std::abs(y));
        error =
            std::max(error, std::isnan(x) != std::isnan(y) ? std::numeric_limits<double>::infinity() : std::abs(x - y));
      }
      if (error > 0.0) worst = std::max(worst, size > 0.0 ? error / size : std::numeric_limits<double>::infinity());
    }
  };
  compare(together.stress, single.stress);
  compare(together.stress_change, single.stress_change);
  return worst;
}

/// How far from symmetric the tangent is, of its largest products. What is no number is beyond the law's range.
double asymmetry(const Material& material, const Samples& samples) {
  std::vector<Strain> others = samples.changes;
  std::rotate(others.begin(), others.begin() + 1, others.end());
  const Probe of_a(material, 1, samples.strains, samples.changes), of_b(material, 1, samples.strains, others);
  double worst = 0.0;
  for (std::size_t i = 0; i < samples.strains.size(); ++i) {
    const auto product = [i](const Probe& probe, const Strain& with) {
      double sum = 0.0;
      for (std::size_t c = 0; c < 6; ++c) sum += probe.stress_change[probe.place(i, c)] * with[c];
      return sum;
    };
    const Strain &a = samples.changes[i], &b = others[i];
    const double ab = product(of_a, b), ba = product(of_b, a);
    const double size = std::sqrt(std::abs(product(of_a, a) * product(of_b, b)));
    if (std::isfinite(ab - ba) && size > 0.0) worst = std::max(worst, std::abs(ab - ba) / size);
  }
  return worst;
}

/// The law's own rules, and what the program takes for granted of every law.
std::optional<LawProblem> check_loaded(const Material& material) {
  const carom_law& law = *material.law->loaded;
  if (const char* problem = law.check == nullptr ? nullptr : law.check(material.values.data()))
    return LawProblem{"", problem, "values that the law takes", ""};
  const IsotropicElastic moduli = loaded_at_rest(material);
  if (!(moduli.E > 0.0 && std::isfinite(moduli.E) && moduli.nu > -1.0 && moduli.nu < 0.5))
    return LawProblem{
        "law", fmt::format("\"{}\", whose moduli at rest are E = {:g}, nu = {:g}", law.name, moduli.E, moduli.nu),
        "E > 0 and nu > -1 and < 0.5 of carom_law.at_rest", ""};
  double strain[6] = {}, stress[6] = {}, energy = 0.0, dissipation = 0.0, wave = 0.0;
  std::vector<double> at_rest(static_cast<std::size_t>(law.history_count), 0.0);
  PointBatch rest{1, strain, stress, &energy, 1.0, nullptr, at_rest.data(), &dissipation, &wave};
  loaded_update<double>(prepare_loaded(material).get(), rest);
  const auto is_zero = [](double value) { return value == 0.0; };
  if (!std::all_of(stress, stress + 6, is_zero) || !std::all_of(at_rest.begin(), at_rest.end(), is_zero) ||
      energy != 0.0 || dissipation != 0.0)
    return LawProblem{"law", fmt::format("\"{}\", which at strain 0 has a stress, an energy or a history", law.name),
                      "a law whose body at rest has none", "Let the history be the difference to its value at rest."};
  if (!(wave > 0.0 && std::isfinite(wave)))
    return LawProblem{"law", fmt::format("\"{}\", whose wave_modulus at rest is {:g}", law.name, wave),
                      "at least the largest rho c^2 of its waves", ""};
  constexpr double rounding = 1e-6;  // far above that of arithmetic, and what iterations may leave
  const Samples samples;
  for (const int lanes : {2, 4, 8})
    if (const double error = lane_error(material, samples, lanes); error > rounding)
      return LawProblem{
          "law", fmt::format("\"{}\", which answers {} lanes otherwise than one, by {:.2g}", law.name, lanes, error),
          "the same answers for any number of lanes",
          "Component c of n of point p, lane l stands at [(n p + c) lanes + l] (carom_law.h)."};
  if (law.tangent == nullptr) return std::nullopt;
  if (const double worst = asymmetry(material, samples); worst > rounding)
    return LawProblem{"law", fmt::format("\"{}\", whose tangent is unsymmetric, by {:.2g} of itself", law.name, worst),
                      "a symmetric tangent: all solvers count on it",
                      "Leave the tangent null: the law then takes explicit schemes, which need none."};
  return std::nullopt;
}

void need(bool is_there, const std::string& law, const std::string& what) {
  if (!is_there)
    throw LawLibraryError(fmt::format("law \"{}\" without {}", law, what), "laws that are whole (docs/user_laws.md)");
}

std::string text_of(const char* text) {
  return text == nullptr ? "" : text;
}

Dimension unit_of(const std::string& unit, const std::string& law, const std::string& key) {
  if (unit.empty()) return Dimension::none;
  for (const Dimension dimension : dimensions)
    if (name(dimension) == unit) return dimension;
  throw LawLibraryError(fmt::format("law \"{}\" with {} in \"{}\"", law, key, unit),
                        "a unit of the last table of docs/case_format.md");
}

/// Keys that every material has.
const std::set<std::string> reserved{"law", "library", "checksum", "rho"};

Law row_of(const carom_law& given) {
  const std::string law = text_of(given.name);
  need(!law.empty(), law, "name");
  need(given.measure == CAROM_SMALL_STRAIN || given.measure == CAROM_GREEN_LAGRANGE, law, "measure of strain");
  need(given.update != nullptr, law, "update");
  need(given.at_rest != nullptr, law, "at_rest");
  need(given.parameter_count == 0 || (given.parameter_count > 0 && given.parameters != nullptr), law, "parameters");
  need(given.history_count == 0 ||
           (given.history_count > 0 && given.history_count <= CAROM_LAW_MOST_HISTORY && given.history != nullptr),
       law, fmt::format("history, or with more than {} variables", CAROM_LAW_MOST_HISTORY));
  Law row;
  row.name = law;
  row.summary = text_of(given.summary);
  row.formula = text_of(given.formula);
  row.measure = given.measure == CAROM_SMALL_STRAIN ? Measure::small_strain : Measure::green_lagrange;
  if (row.measure == Measure::small_strain)
    row.when_turning = "one of Green-Lagrange strain, such as \"neo_hookean\" or \"j2\"";
  std::set<std::string> names;
  for (int p = 0; p < given.parameter_count; ++p) {
    const carom_law_parameter& own = given.parameters[p];
    const std::string key = text_of(own.key);
    need(!key.empty() && !reserved.contains(key) && names.insert(key).second, law,
         fmt::format("a name of its own for parameter {}, \"{}\"", p, key));
    LawParameter parameter{key, text_of(own.meaning), unit_of(text_of(own.unit), law, key)};
    parameter.range = {own.low, own.high, own.is_closed_low != 0, own.is_closed_high != 0};
    if (!std::isnan(own.initial)) parameter.initial = own.initial;
    row.parameters.push_back(std::move(parameter));
  }
  names.clear();
  for (int v = 0; v < given.history_count; ++v) {
    const std::string variable = text_of(given.history[v]);
    need(!variable.empty() && names.insert(variable).second, law,
         fmt::format("a name of its own for history variable {}", v));
    row.history.push_back(variable);
  }
  row.has_tangent = given.tangent != nullptr;
  row.at_rest = loaded_at_rest;
  row.prepare = prepare_loaded;
  row.check = check_loaded;
  row.loaded = &given;
  return row;
}

std::string checksum_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw LawLibraryError("a file that cannot be read", "a library with laws");
  return fmt::format("{:016x}", checksum(bytes));
}

std::unique_ptr<const LawLibrary> read_library(void* handle, const std::string& path) {
  const auto entry = reinterpret_cast<const carom_law_library* (*)()>(dlsym(handle, "carom_laws"));
  if (entry == nullptr)
    throw LawLibraryError("a library without carom_laws()", "one made with carom_law.h (docs/user_laws.md)");
  const carom_law_library* given = entry();
  if (given == nullptr || given->interface_version != CAROM_LAW_INTERFACE)
    throw LawLibraryError(
        fmt::format("a library for version {} of the interface", given == nullptr ? 0 : given->interface_version),
        fmt::format("version {}: compile it with the carom_law.h of this program", CAROM_LAW_INTERFACE));
  if (given->law_count < 1 || given->laws == nullptr)
    throw LawLibraryError("a library without laws", "at least one law");
  auto library = std::make_unique<LawLibrary>();
  library->version = text_of(given->version);
  library->checksum = checksum_of(path);
  for (int l = 0; l < given->law_count; ++l) library->laws.push_back(row_of(given->laws[l]));
  return library;
}

}  // namespace

const Law* LawLibrary::find(std::string_view name) const {
  const auto it = std::find_if(laws.begin(), laws.end(), [name](const Law& law) { return law.name == name; });
  return it == laws.end() ? nullptr : &*it;
}

const LawLibrary& load_laws(const std::string& path) {
  static std::mutex mutex;
  static std::map<void*, std::unique_ptr<const LawLibrary>> libraries;
  const std::lock_guard lock(mutex);
  if (!std::ifstream(path)) throw LawLibraryError("no such file", "a library with laws");
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw LawLibraryError(dlerror(), "a library with laws, made for this machine");
  std::unique_ptr<const LawLibrary>& library = libraries[handle];
  if (!library) library = read_library(handle, path);
  return *library;
}

}  // namespace carom
