// A law on a path of deformation, without a mesh: the point driver.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "driver/measured_curve.hpp"
#include "material/law.hpp"

namespace carom {

struct CsvTable;

using Gradient = std::array<std::array<double, 3>, 3>;  ///< F

/// What a path does to the lateral directions.
enum class PathKind : std::uint8_t { uniaxial_stress, uniaxial_strain, simple_shear, table };

/// What the user asks for.
struct PathRequest {
  std::string path;                               ///< the name of a kind, or a .csv file of F or strain
  std::vector<double> to{0.1};                    ///< turning points of the engineering strain, or of gamma
  int steps = 200;                                ///< from one turning point to the next
  std::string measured{};                         ///< file of a measured curve of stress over strain; "": none
  double rate = 1.0;                              ///< of that strain, per unit of time
  std::shared_ptr<const CsvTable> table{};        ///< what such a file would hold; `path` names it in messages
  std::optional<MeasuredCurve> measured_curve{};  ///< what the file `measured` would hold
};

/// Points of a path: deformation at times, from rest.
struct MaterialPath {
  PathKind kind = PathKind::table;
  std::vector<double> time;
  std::vector<double> strain;  ///< engineering strain l / l_0 - 1 or gamma; empty for tables
  std::vector<Gradient> F;     ///< uniaxial stress: F_yy = F_zz = 1 stand for what is found
};

/// Throws CaseError where the request makes no sense or the table is none.
MaterialPath make_path(const PathRequest& request);

/// What the law answers along a path, one row per point.
struct MaterialCurve {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  std::vector<double> column(const std::string& name) const;
};

/// free_directions: those of the part's section (material/law_kernels.hpp); uniaxial stress has two of its own.
/// Columns: time, strain (where the path has one), F_xx ... , Cauchy stress_xx ..., von_mises, energy and dissipation
/// per reference volume, and the law's history variables by their names. Throws RunError when the law gives no number,
/// with the step.
MaterialCurve follow(const Material& material, int free_directions, const MaterialPath& path);

}  // namespace carom
