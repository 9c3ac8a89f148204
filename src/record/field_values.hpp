// The values of fields at one instant, by their names.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "build/simulation.hpp"
#include "march/observer.hpp"
#include "math/voigt.hpp"
#include "output/quantities.hpp"
#include "record/contact_fields.hpp"

namespace carom {

/// Values entry after entry; they may be those of the state, or of what FieldsNow keeps.
struct FieldValues {
  std::vector<double> own{};
  std::vector<Voigt> tensors{};
  std::span<const double> values{};

  explicit FieldValues(std::span<const double> kept) : values(kept) {}
  explicit FieldValues(std::vector<double> made) : own(std::move(made)), values(own) {}
  explicit FieldValues(std::vector<Voigt> made) : tensors(std::move(made)), values(entries(tensors)) {}
  FieldValues(FieldValues&&) = default;  // the values stay where they are

  static std::span<const double> entries(const std::vector<Voigt>& tensors) {
    return {tensors.empty() ? nullptr : tensors.front().data(), 6 * tensors.size()};
  }
};

/// What a field is: of a quantity of the table, or of a variable that laws remember.
struct FieldKind {
  Place place = Place::points;
  Form form = Form::scalar;

  bool is_at_nodes() const { return place == Place::nodes; }
};
/// Nothing where the case has no such field: of contact without one, of what no law remembers, or no field of frames.
std::optional<FieldKind> field_kind(const Simulation& simulation, std::string_view name);

/// Fields at an instant. What several of them need is made once: ask for those that need stresses one after the other.
class FieldsNow {
 public:
  /// slip: ContactSlip::path. stressed: increasing, the cells whose stresses are asked for; empty: all of them.
  FieldsNow(const Simulation& s, const StepView& now, std::span<const double> slip,
            std::span<const Index> stressed = {})
      : simulation(s), view(now), contact_slip(slip), stressed_(stressed) {}

  /// Precondition: field_kind has one.
  FieldValues evaluate(std::string_view name);
  /// Does it need the stresses of all cells, the largest array of all?
  static bool needs_stress(std::string_view name);
  void forget_stress() { stress_ = std::vector<Voigt>(); }  // {} would empty it and keep its memory

  const std::vector<Voigt>& stress();
  const NodalContact& contact();

  const Simulation& simulation;
  const StepView& view;
  const std::span<const double> contact_slip;

 private:
  std::span<const Index> stressed_;
  std::vector<Voigt> stress_;
  std::optional<NodalContact> contact_;
};

/// The fields that this case has, in the order of the table, what its laws remember last.
std::vector<std::string> fields_of(const Simulation& simulation);
/// Names of the fields that can be evaluated; those of points join by themselves.
std::vector<std::string_view> evaluated_fields();

}  // namespace carom
