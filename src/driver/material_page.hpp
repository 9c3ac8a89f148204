// What the point driver leaves: a table and a page.
#pragma once

#include <optional>
#include <string>

#include "casefile/case.hpp"
#include "driver/material_path.hpp"
#include "driver/measured_curve.hpp"

namespace carom {

/// The part of this name, or the only one when the name is "". Throws CaseError.
const CasePart& part_named(const Case& given, const std::string& name);

/// A law along a path, and all that table and page show of it.
struct MaterialDrive {
  const Case& given;
  const CasePart& part;
  Material material;
  MaterialPath path;
  MaterialCurve curve;
  std::optional<MeasuredCurve> measured;
  std::string description;

  std::vector<double> column(const std::string& name) const { return curve.column(name); }
  /// Of the stress of the law less the measured one, over the first branch (rms_difference). Precondition: measured.
  double rms_off_measured() const;
};

/// Follows the path with the law and the section of the part (part_named), which the case outlives. Throws CaseError
/// where part and path do not go together.
MaterialDrive follow_material(const Case& given, const std::string& part, const PathRequest& request);
/// Writes <folder>/<part>.csv and .html. Returns what the command prints: the files and the key figures. Throws
/// OutputError.
std::string write_material(const MaterialDrive& drive, const std::string& folder);
/// Both.
std::string drive_material(const Case& given, const std::string& part, const PathRequest& request,
                           const std::string& folder);

}  // namespace carom
