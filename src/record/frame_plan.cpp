#include "record/frame_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/amounts.hpp"
#include "record/field_values.hpp"

namespace carom {

namespace {

constexpr double fields_budget = 2e9, most_default_intervals = 50.0;

/// Intervals between frames where nobody says how often.
long long default_intervals(const Simulation& s) {
  const FieldBytes bytes = field_bytes(s);
  return intervals_within(fields_budget - bytes.mesh, bytes.frame);
}

}  // namespace

FieldBytes field_bytes(const Simulation& s) {
  const CaseOutput& output = s.given().output;
  if (output.fields.empty()) return {};
  const double real = output.precision == CaseOutput::Precision::in_single ? 4.0 : 8.0;
  double of_node = 0.0, of_cell = s.model().erosion.empty() ? 0.0 : 1.0, corners = 0.0;  // which cells are there
  for (const auto& field : output.fields) {
    const std::optional<FieldKind> kind = field_kind(s, *field);
    if (!kind) continue;
    (kind->is_at_nodes() ? of_node : of_cell) +=
        kind->form == Form::category ? 1.0 : real * static_cast<double>(components(kind->form));
  }
  for (std::size_t k = 0; k < s.solid().cells().size(); ++k)
    corners += static_cast<double>(s.solid().cells().nodes_of(k).size());
  const auto nodes = static_cast<double>(s.mesh().node_count()), cells = static_cast<double>(s.solid().cells().size());
  const double values = of_node * nodes + of_cell * cells;
  // Coordinates, cells, numbers and parts; where frames share them, the cells are there twice (vtkhdf.hpp).
  const bool is_shared = frame_format(s).shares_mesh;
  const double mesh = 28.0 * nodes + (is_shared ? 17.0 : 13.0) * cells + (is_shared ? 8.0 : 4.0) * corners;
  return is_shared ? FieldBytes{values, mesh} : FieldBytes{values + mesh, 0.0};
}

long long intervals_within(double bytes, double of_frame) {
  return static_cast<long long>(
      std::clamp(std::floor(bytes / std::max(1.0, of_frame)) - 1.0, 1.0, most_default_intervals));
}

long long frame_interval(const Simulation& s) {
  const int wanted = s.given().output.fields_every;
  if (wanted > 0) return wanted;
  const long long intervals = default_intervals(s);
  return std::max(1LL, (s.steps() + intervals - 1) / intervals);
}

long long FrameClock::due(long long step, double t) const {
  if (simulation_.given().output.fields_every > 0) return step / interval_;
  constexpr double rounding = 1e-6;  // of a step, by which sums of steps may miss a time
  double usual_steps = rounding;
  for (const auto& stage : simulation_.stages())
    usual_steps += std::clamp((t - stage->begin()) / stage->dt(), 0.0, static_cast<double>(stage->steps()));
  return static_cast<long long>(usual_steps / static_cast<double>(interval_));
}

std::string frame_note(const Simulation& s) {
  const CaseOutput& output = s.given().output;
  if (output.fields.empty() || output.fields_every > 0) return {};
  const long long intervals = default_intervals(s);
  if (static_cast<double>(intervals) == most_default_intervals || intervals >= s.steps()) return {};
  const FieldBytes bytes = field_bytes(s);
  return fmt::format(
      "fields every {} steps, so that they take at most {} of disk ({} a frame before compression); "
      "output.fields_every asks for others",
      frame_interval(s), about_bytes(std::max(fields_budget, bytes.mesh + 2.0 * bytes.frame)),
      about_bytes(bytes.frame));
}

const FrameFormat& frame_format(const Simulation& s) {
  return frame_formats()[static_cast<std::size_t>(s.given().output.format)];
}

}  // namespace carom
