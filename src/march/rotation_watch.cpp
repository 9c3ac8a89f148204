#include "march/rotation_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "solid/cell_values.hpp"

namespace carom {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

}  // namespace

double stress_of_rotation(const IsotropicElastic& material, Section section, double angle) {
  const double s = std::sin(0.5 * angle), strain = 2.0 * s * s;  // 1 - cos(angle)
  if (section == Section::bar) return material.E * strain;
  if (section == Section::plane_stress) return material.E * strain / (1.0 - material.nu);
  return material.E * strain / ((1.0 + material.nu) * (1.0 - 2.0 * material.nu));
}

RotationWatch::RotationWatch(const Simulation& simulation) : simulation_(simulation) {}

const Part& RotationWatch::turned_part(const Rotation& rotation) const {
  return *simulation_.model().part_of(simulation_.solid().cells()[at(rotation.cell)]);
}

std::string RotationWatch::describe(const Rotation& rotation) const {
  const CellRef cell = simulation_.solid().cells()[static_cast<std::size_t>(rotation.cell)];
  const Part& part = turned_part(rotation);
  const double stress = stress_of_rotation(part.material.at_rest(), part.section, rotation.angle);
  return fmt::format(
      "cell {} of part \"{}\" has turned by {:.3g} degrees, which its small-strain law takes for a "
      "stress of about {:.3g}",
      simulation_.mesh().cell_label(cell), part.name, rotation.angle / degree, stress);
}

void RotationWatch::see(const StepView& view) {
  const State& state = view.state;
  const long long step = view.step;
  if (step == 0 || !view.alarm.empty()) return;
  if (is_explicit(view.stage.settings().kind) && step < next_ && !view.ends_stage) return;
  constexpr long long every = 10, seldom = 50;  // explicit steps
  const CaseGuards& guards = simulation_.given().guards;
  const Rotation rotation = largest_rotation(simulation_.solid(), state.q, state.alive());
  const double angle = rotation.angle / degree;
  growth_ = std::max(0.0, angle - angle_) / static_cast<double>(std::max(1LL, step - looked_));
  angle_ = angle;
  looked_ = step;
  const bool has_warned = !warnings_.empty();
  const double limit = has_warned || angle > guards.rotation_warning ? guards.rotation_stop : guards.rotation_warning;
  const auto may_reach = [&](long long steps, double share) {
    return angle + 2.0 * growth_ * static_cast<double>(steps) > share * limit;
  };
  next_ = step + (may_reach(every, 1.0) ? 1 : (may_reach(seldom, 0.5) ? every : seldom));
  if (angle > guards.rotation_stop) {
    throw RunError(
        static_cast<int>(step), state.t,
        fmt::format("{}; the limit is {:g} degrees (rotation_stop in [guards]). Choose law = {} in "
                    "[materials]",
                    describe(rotation), guards.rotation_stop, turned_part(rotation).material.law->when_turning));
  }
  if (has_warned || angle <= guards.rotation_warning) return;
  warnings_.push_back(
      fmt::format("at t = {:.6g}, step {}, {}; the error grows with the square of the angle. Take law = {} where that "
                  "matters (rotation_warning in [guards])",
                  state.t, step, describe(rotation), turned_part(rotation).material.law->when_turning));
}

}  // namespace carom
