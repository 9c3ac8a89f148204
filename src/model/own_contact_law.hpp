// Laws of contact that a case or a program brings along.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Pressure over depth, straight from (0, 0) over the points of a table and on with its last slope; stored energy is
/// its integral. Stress over length (of rows that are counted per node: force).
class PressureTable {
 public:
  /// Precondition: as many depths as pressures, at least one; both positive, depths increasing, pressures not falling.
  PressureTable(std::vector<double> depths, std::vector<double> pressures)
      : depth_(std::move(depths)), pressure_(std::move(pressures)) {
    depth_.insert(depth_.begin(), 0.0);
    pressure_.insert(pressure_.begin(), 0.0);
    energy_.push_back(0.0);
    for (std::size_t i = 1; i < depth_.size(); ++i) {
      const double width = depth_[i] - depth_[i - 1];
      energy_.push_back(energy_.back() + 0.5 * (pressure_[i - 1] + pressure_[i]) * width);
      slope_.push_back((pressure_[i] - pressure_[i - 1]) / width);
    }
  }

  /// At a depth >= 0.
  double pressure(double depth) const {
    const std::size_t i = piece(depth);
    return pressure_[i] + slope_[i] * (depth - depth_[i]);
  }
  double slope(double depth) const { return slope_[piece(depth)]; }
  double energy(double depth) const {
    const std::size_t i = piece(depth);
    const double beyond = depth - depth_[i];
    return energy_[i] + (pressure_[i] + 0.5 * slope_[i] * beyond) * beyond;
  }
  double largest_slope() const { return *std::ranges::max_element(slope_); }
  /// Of the pieces down to a depth.
  double largest_slope(double depth) const {
    return *std::max_element(slope_.begin(), slope_.begin() + static_cast<std::ptrdiff_t>(piece(depth)) + 1);
  }
  double last_depth() const { return depth_.back(); }
  /// The least depth of a pressure >= 0; infinite where the last piece is level and the pressure above it.
  double depth(double pressure) const {
    const auto next = std::lower_bound(pressure_.begin() + 1, pressure_.end() - 1, pressure);
    const auto i = static_cast<std::size_t>(next - pressure_.begin()) - 1;
    if (pressure <= pressure_[i]) return depth_[i];
    return slope_[i] > 0.0 ? depth_[i] + (pressure - pressure_[i]) / slope_[i]
                           : std::numeric_limits<double>::infinity();
  }

 private:
  std::size_t piece(double depth) const {
    const auto next = std::upper_bound(depth_.begin() + 1, depth_.end() - 1, depth);
    return static_cast<std::size_t>(next - depth_.begin()) - 1;
  }

  std::vector<double> depth_, pressure_, energy_, slope_;
};

/// What a law of friction sees of the rows of a contact at the beginning of a step.
struct RubbingRows {
  std::vector<double> pressure;   ///< normal force over measure, >= 0
  std::vector<double> slip_rate;  ///< size of the tangential relative velocity
  std::vector<Vec3> position;     ///< where the row is
  double time = 0.0;
};
/// The coefficient of friction of each, >= 0. It holds for the step that begins there, so that tangents and cones are
/// those of Coulomb's law whatever the enforcement. The same values for the same rows: steps may be made again.
using FrictionLaw = std::function<std::vector<double>(const RubbingRows&)>;

}  // namespace carom
