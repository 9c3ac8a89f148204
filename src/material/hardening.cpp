#include "material/hardening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace carom {

Hardening::Hardening(const Material& material)
    : yield_(material.value("yield_stress")),
      modulus_(material.value("hardening_modulus")),
      saturation_(material.value("saturation_stress") > 0.0 ? material.value("saturation_stress") - yield_ : 0.0),
      rate_(material.value("saturation_rate")) {
  const auto& curve = material.curve;
  if (curve.empty()) return;
  std::vector<Point> points;
  double work = 0.0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (i > 0) work += 0.5 * (curve[i][0] - curve[i - 1][0]) * (curve[i][1] + curve[i - 1][1]);
    const bool is_last = i + 1 == curve.size();
    const double slope = is_last ? 0.0 : (curve[i + 1][1] - curve[i][1]) / (curve[i + 1][0] - curve[i][0]);
    points.push_back({curve[i][0], curve[i][1], slope, work});
  }
  size_ = std::ssize(points);
  owner_ = std::make_shared<const std::vector<Point>>(std::move(points));
  points_ = owner_->data();
}

const Hardening::Point* Hardening::first_segment(double alpha) const {
  const Point* after = std::upper_bound(points_, points_ + size_, alpha,
                                        [](double value, const Point& point) { return value < point.alpha; });
  return std::max(after - 1, points_);
}

std::vector<LawParameter> hardening_parameters() {
  const Interval not_negative{.low = 0.0, .is_closed_low = true};
  return {{"yield_stress",
           "First yield stress in tension.",
           Dimension::stress,
           {.low = 0.0},
           0.0,
           {"yield", "sigma_y", "sigma_0"},
           "that of hardening_table"},
          {"hardening_modulus",
           "Slope H of the yield stress over the plastic strain.",
           Dimension::stress,
           not_negative,
           0.0,
           {"H", "tangent_modulus"}},
          {"saturation_stress",
           "Yield stress that Voce's hardening approaches.",
           Dimension::stress,
           {.low = 0.0},
           0.0,
           {"sigma_inf"},
           "no such hardening"},
          {"saturation_rate",
           "Exponent of Voce's hardening: 1 over the plastic strain of its first 63 %.",
           Dimension::none,
           {.low = 0.0},
           0.0,
           {"delta"},
           "no such hardening"}};
}

namespace {

std::optional<LawProblem> check_curve(const Material& material) {
  const auto& curve = material.curve;
  const std::string key = "hardening_table";
  if (curve.front()[0] != 0.0)
    return LawProblem{key, fmt::format("a first plastic strain of {:g}", curve.front()[0]), "0", ""};
  if (!(curve.front()[1] > 0.0))
    return LawProblem{key, "a first yield stress of 0", "a yield stress > 0",
                      "A body that yields at once has no elastic states; take an elastic law, or a small stress."};
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (!(curve[i][0] > curve[i - 1][0]))
      return LawProblem{key, fmt::format("plastic strain {:g} after {:g}", curve[i][0], curve[i - 1][0]),
                        "plastic strains in increasing order", ""};
    if (curve[i][1] < curve[i - 1][1])
      return LawProblem{key, fmt::format("yield stress {:g} after {:g}", curve[i][1], curve[i - 1][1]),
                        "yield stresses that do not fall",
                        "Softening bodies localise in single cells; end the table at its highest stress."};
  }
  for (const char* other : {"yield_stress", "hardening_modulus", "saturation_stress", "saturation_rate"})
    if (material.value(other) > 0.0)
      return LawProblem{other, fmt::format("{} beside hardening_table", other), "one of the two",
                        "The table says it all."};
  return std::nullopt;
}

}  // namespace

std::optional<LawProblem> check_hardening(const Material& material) {
  if (!material.curve.empty()) return check_curve(material);
  const double yield = material.value("yield_stress"), saturation = material.value("saturation_stress");
  if (!(yield > 0.0)) return LawProblem{"yield_stress", "nothing", "a yield stress > 0, or a hardening_table", ""};
  const bool has_saturation = saturation > 0.0, has_rate = material.value("saturation_rate") > 0.0;
  if (has_saturation != has_rate)
    return LawProblem{has_rate ? "saturation_rate" : "saturation_stress",
                      has_rate ? "a rate without saturation_stress" : "a stress without saturation_rate",
                      "both, for Voce's hardening", ""};
  if (has_saturation && saturation < yield)
    return LawProblem{"saturation_stress", fmt::format("{:g}, below the yield stress of {:g}", saturation, yield),
                      "at least the yield stress", "Softening bodies localise in single cells."};
  return std::nullopt;
}

}  // namespace carom
