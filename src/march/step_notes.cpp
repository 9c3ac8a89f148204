#include "march/step_notes.hpp"

#include <fmt/format.h>

#include <utility>

namespace carom {

namespace {

struct Words {
  const char* what;  ///< why a step was cut
  const char* help;  ///< what makes longer ones; nullptr: energy_remedy
};

constexpr std::array<Words, static_cast<std::size_t>(ShortStep::count)> words{{
    {"contact would have closed by more than half a cell in them", "Larger cells at the contact make longer steps"},
    {"they were to end at a touch", "time.event_tolerance asks for it"},
    {"contact that closed or opened in them misplaced more than 0.02 % of the energy",
     "A lower contact.stiffness (contact.stiffness_factor), or more cells that share a touch, make longer steps"},
    {"they made energy, or the scheme lent them much", nullptr},
    {"the stable step had fallen: cells that are flattened or stiffen, or springs of contact",
     "mass_scaling_step, distortion_control, larger cells or a lower contact.stiffness make longer steps"},
    {"they failed", "Where that is often, lower time.step (explicit: time.safety)"},
}};

}  // namespace

void StepNotes::add(ShortStep reason, const Step& step, std::string place) {
  Entry& entry = entries_[static_cast<std::size_t>(reason)];
  if (entry.count++ == 0) entry.first = step;
  if (entry.count > 1 && step.dt >= entry.shortest.dt) return;
  entry.shortest = step;
  entry.place = std::move(place);
}

std::vector<std::string> StepNotes::lines(double usual, const std::string& energy_remedy) const {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const Entry& e = entries_[k];
    if (e.count == 0) continue;
    out.push_back(fmt::format(
        "steps: shortened {} time{}, since {}: first step {} at t = {:.6g}; the shortest was step {} at t = {:.6g}, "
        "{:.3g}, {:.2g} of the usual one{}{}. {}",
        e.count, e.count == 1 ? "" : "s", words[k].what, e.first.number, e.first.t, e.shortest.number, e.shortest.t,
        e.shortest.dt, e.shortest.dt / usual, e.place.empty() ? "" : ", ", e.place,
        words[k].help == nullptr ? energy_remedy : words[k].help));
  }
  return out;
}

}  // namespace carom
