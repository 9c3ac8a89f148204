#include "driver/material_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "kernels/kernels.hpp"
#include "math/voigt.hpp"
#include "parallel/threads.hpp"
#include "report/csv_table.hpp"

namespace carom {

namespace {

constexpr std::array<const char*, 3> path_kinds{"uniaxial_stress", "uniaxial_strain", "simple_shear"};
constexpr std::array<const char*, 3> axes{"x", "y", "z"};
constexpr std::array<std::size_t, 6> voigt_row{0, 1, 2, 0, 1, 2}, voigt_column{0, 1, 2, 1, 2, 0};
constexpr std::array<const char*, 6> components{"xx", "yy", "zz", "xy", "yz", "zx"};

constexpr Gradient unity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Gradient at_strain(PathKind kind, double strain) {
  Gradient F = unity;
  (kind == PathKind::simple_shear ? F[0][1] : F[0][0]) += strain;
  return F;
}

/// From rest over the turning points, in equal steps.
MaterialPath programme(PathKind kind, const PathRequest& request) {
  MaterialPath path{kind, {0.0}, {0.0}, {unity}};
  double from = 0.0, time = 0.0;
  for (const double to : request.to) {
    if (kind != PathKind::simple_shear && !(to > -1.0))
      throw CaseError({}, "--to", fmt::format("{:g}", to),
                      "engineering strains > -1: at -1 nothing is left of the length");
    if (to == from)
      throw CaseError({}, "--to", fmt::format("{:g} after {:g}", to, from),
                      "turning points that differ from the one before", "The path begins at 0.");
    const double duration = std::abs(to - from) / request.rate;
    for (int i = 1; i <= request.steps; ++i) {
      const double share = static_cast<double>(i) / request.steps;
      path.strain.push_back(std::lerp(from, to, share));
      path.time.push_back(time + share * duration);
      path.F.push_back(at_strain(kind, path.strain.back()));
    }
    from = to;
    time += duration;
  }
  return path;
}

double determinant(const Gradient& F) {
  return F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
         F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
}

/// F of the rows of a table: columns F_xx, F_xy, ... (absent ones are those of 1), or strain_xx, ..., strain_xy, ...
/// (the tensor's; absent ones are 0), the strain of a symmetric F = 1 + strain.
std::vector<Gradient> gradients(const CsvTable& table, const std::string& file) {
  std::vector<Gradient> F(table.rows(), unity);
  std::vector<std::string> known{"time"};
  std::size_t found = 0;
  const auto take = [&](const std::string& name, const auto& put) {
    known.push_back(name);
    const std::vector<double>* values = table.column(name);
    if (values == nullptr) return;
    ++found;
    for (std::size_t r = 0; r < F.size(); ++r) put(F[r], (*values)[r]);
  };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      take(fmt::format("F_{}{}", axes[i], axes[j]), [i, j](Gradient& f, double value) { f[i][j] = value; });
  const bool has_gradient = found > 0;
  for (std::size_t c = 0; c < 6; ++c)
    take(fmt::format("strain_{}", components[c]), [c](Gradient& f, double value) {
      f[voigt_row[c]][voigt_column[c]] += value;
      if (c >= 3) f[voigt_column[c]][voigt_row[c]] += value;
    });
  for (const std::string& column : table.columns)
    if (std::find(known.begin(), known.end(), column) == known.end())
      throw CaseError({file, 1, 0}, "", fmt::format("the column {}", column),
                      fmt::format("columns among {}", fmt::join(known, ", ")));
  const bool has_both = has_gradient && found > 0 &&
                        std::any_of(table.columns.begin(), table.columns.end(),
                                    [](const std::string& name) { return name.rfind("strain_", 0) == 0; });
  if (found == 0 || has_both)
    throw CaseError({file, 1, 0}, "", has_both ? "columns of F and of strain" : "no column of F or strain",
                    "columns F_xx, F_xy, ..., F_zz or strain_xx, ..., strain_zx");
  return F;
}

MaterialPath tabulated(const std::string& file, const CsvTable* table) {
  if (table == nullptr)
    throw CaseError({}, "--path", fmt::format("\"{}\"", file),
                    fmt::format("one of {}, or a .csv file that is there", fmt::join(path_kinds, ", ")));
  if (!table->damage.empty() || table->rows() == 0 || table->columns.front() != "time")
    throw CaseError({file, 0, 0}, "", table->damage.empty() ? "no row, or no column of time" : table->damage,
                    "a first line `time,F_xx,...` or `time,strain_xx,...` and a row for each point");
  MaterialPath path{PathKind::table, table->values.front(), {}, gradients(*table, file)};
  for (std::size_t r = 0; r < path.F.size(); ++r) {
    if (!(determinant(path.F[r]) > 0.0))
      throw CaseError({file, 0, 0}, "", fmt::format("det F = {:.4g} in row {}", determinant(path.F[r]), r + 1),
                      "deformations that do not turn the body inside out: det F > 0");
    if (r > 0 && !(path.time[r] > path.time[r - 1]))
      throw CaseError({file, 0, 0}, "",
                      fmt::format("time {:g} after {:g} in row {}", path.time[r], path.time[r - 1], r + 1),
                      "times in increasing order");
  }
  if (path.F.front() != unity || path.time.front() != 0.0) {
    if (!(path.time.front() > 0.0))
      throw CaseError({file, 0, 0}, "", fmt::format("time {:g} in row 1", path.time.front()),
                      "the body at rest at time 0, or a first row at a later time");
    path.time.insert(path.time.begin(), 0.0);
    path.F.insert(path.F.begin(), unity);
  }
  return path;
}

/// The strain of the law's measure.
Voigt strain_of(Measure measure, const Gradient& F) {
  Voigt e{};
  for (std::size_t c = 0; c < 6; ++c) {
    const std::size_t i = voigt_row[c], j = voigt_column[c];
    const double one = i == j ? 1.0 : 0.0;
    double value = 0.5 * (F[i][j] - one + F[j][i] - one);
    if (measure == Measure::green_lagrange)
      for (std::size_t k = 0; k < 3; ++k)
        value += 0.5 * (F[k][i] - (k == i ? 1.0 : 0.0)) * (F[k][j] - (k == j ? 1.0 : 0.0));
    e[c] = c < 3 ? value : 2.0 * value;
  }
  return e;
}

/// The lateral stretches that belong to the lateral strains that a law has found.
void complete(Measure measure, const Voigt& strain, int free_directions, Gradient& F) {
  for (std::size_t i = 3 - static_cast<std::size_t>(free_directions); i < 3; ++i)
    F[i][i] = measure == Measure::small_strain ? 1.0 + strain[i] : std::sqrt(1.0 + 2.0 * strain[i]);
}

/// F S F^T / det F of finite strain.
Voigt cauchy(Measure measure, const Gradient& F, const Voigt& S) {
  if (measure == Measure::small_strain) return S;
  Voigt sigma{};
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t d = 0; d < 6; ++d) {
      const std::size_t i = voigt_row[c], j = voigt_column[c], k = voigt_row[d], l = voigt_column[d];
      sigma[c] += S[d] * (F[i][k] * F[j][l] + (k == l ? 0.0 : F[i][l] * F[j][k]));
    }
    sigma[c] /= determinant(F);
  }
  return sigma;
}

std::vector<std::string> columns_of(const std::vector<std::string>& remembered, const MaterialPath& path) {
  std::vector<std::string> columns{"time"};
  if (!path.strain.empty()) columns.emplace_back("strain");
  for (const char* row : axes)
    for (const char* column : axes) columns.push_back(fmt::format("F_{}{}", row, column));
  for (const char* component : components) columns.push_back(fmt::format("stress_{}", component));
  for (const char* name : {"von_mises", "energy", "dissipation"}) columns.emplace_back(name);
  columns.insert(columns.end(), remembered.begin(), remembered.end());
  return columns;
}

}  // namespace

MaterialPath make_path(const PathRequest& request) {
  if (request.table) return tabulated(request.path, request.table.get());
  const auto kind = std::find(path_kinds.begin(), path_kinds.end(), request.path);
  if (kind == path_kinds.end()) {
    const std::optional<CsvTable> table = read_csv(request.path);
    return tabulated(request.path, table ? &*table : nullptr);
  }
  return programme(static_cast<PathKind>(kind - path_kinds.begin()), request);
}

std::vector<double> MaterialCurve::column(const std::string& name) const {
  const auto place = std::find(columns.begin(), columns.end(), name);
  std::vector<double> values;
  if (place == columns.end()) return values;
  for (const std::vector<double>& row : rows) values.push_back(row[static_cast<std::size_t>(place - columns.begin())]);
  return values;
}

MaterialCurve follow(const Material& material, int free_directions, const MaterialPath& path) {
  const Law& law = *material.law;
  const int free = path.kind == PathKind::uniaxial_stress ? 2 : free_directions;
  const PreparedLaw prepared = prepare(material, free, kernels_reference().laws);
  const std::vector<std::string> remembered = material.history();
  MaterialCurve curve{columns_of(remembered, path), {}};
  std::vector<double> history(static_cast<std::size_t>(prepared.history), 0.0), next(history.size());
  for (std::size_t p = 0; p < path.F.size(); ++p) {
    Gradient F = path.F[p];
    Voigt strain = strain_of(law.measure, F), S{};
    double energy = 0.0, dissipation = 0.0;
    const double dt = p == 0 ? 0.0 : path.time[p] - path.time[p - 1];
    prepared.kernels.update(prepared.parameters.get(),
                            {1, strain.data(), S.data(), &energy, dt, history.data(), next.data(), &dissipation});
    complete(law.measure, strain, free, F);
    const Voigt sigma = cauchy(law.measure, F, S);
    std::swap(history, next);
    std::vector<double> row{path.time[p]};
    if (!path.strain.empty()) row.push_back(path.strain[p]);
    for (const auto& line : F) row.insert(row.end(), line.begin(), line.end());
    row.insert(row.end(), sigma.begin(), sigma.end());
    row.insert(row.end(), {von_mises(sigma), energy, dissipation});
    row.insert(row.end(), history.begin(), history.begin() + static_cast<std::ptrdiff_t>(remembered.size()));
    if (!is_finite(row))
      throw RunError(static_cast<int>(p), path.time[p],
                     fmt::format("the law {} gives no number on this path", law.name));
    curve.rows.push_back(std::move(row));
  }
  return curve;
}

}  // namespace carom
