#include "material/hardening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

Hardening::Hardening(const Material& material)
    : yield_(material.value("yield_stress")),
      modulus_(material.value("hardening_modulus")),
      saturation_(material.value("saturation_stress") > 0.0 ? material.value("saturation_stress") - yield_ : 0.0),
      rate_(material.value("saturation_rate")),
      curve_(material.curve) {
  double sum = 0.0;
  for (std::size_t i = 0; i < curve_.size(); ++i) {
    if (i > 0) sum += 0.5 * (curve_[i][0] - curve_[i - 1][0]) * (curve_[i][1] + curve_[i - 1][1]);
    work_.push_back(sum);
  }
}

/// The last point of the curve that is not right of alpha.
std::size_t Hardening::segment(double alpha) const {
  const auto after = std::upper_bound(curve_.begin(), curve_.end(), alpha,
                                      [](double value, const auto& point) { return value < point[0]; });
  return static_cast<std::size_t>(std::max(after - curve_.begin(), std::ptrdiff_t{1}) - 1);
}

double Hardening::slope(double alpha) const {
  if (curve_.empty()) return saturation_ > 0.0 ? modulus_ + saturation_ * rate_ * std::exp(-rate_ * alpha) : modulus_;
  const std::size_t i = segment(alpha);
  if (i + 1 == curve_.size()) return 0.0;
  return (curve_[i + 1][1] - curve_[i][1]) / (curve_[i + 1][0] - curve_[i][0]);
}

double Hardening::stress(double alpha) const {
  const double linear = yield_ + modulus_ * alpha;
  if (curve_.empty()) return saturation_ > 0.0 ? linear - saturation_ * std::expm1(-rate_ * alpha) : linear;
  const std::size_t i = segment(alpha);
  return curve_[i][1] + slope(alpha) * (alpha - curve_[i][0]);
}

double Hardening::work(double alpha) const {
  if (!curve_.empty()) {
    const std::size_t i = segment(alpha);
    return work_[i] + 0.5 * (curve_[i][1] + stress(alpha)) * (alpha - curve_[i][0]);
  }
  const double linear = (yield_ + 0.5 * modulus_ * alpha) * alpha;
  return saturation_ > 0.0 ? linear + saturation_ * (alpha + std::expm1(-rate_ * alpha) / rate_) : linear;
}

double Hardening::increment(double trial, double three_G, double alpha) const {
  if (!curve_.empty()) {  // the segment on which the return ends: the curve rises, the stress falls
    std::size_t i = segment(alpha);
    while (i + 1 < curve_.size() && trial - three_G * (curve_[i + 1][0] - alpha) > curve_[i + 1][1]) ++i;
    const double H = slope(curve_[i][0]);
    return (trial - curve_[i][1] - H * (alpha - curve_[i][0])) / (three_G + H);
  }
  // The excess of the stress is convex and falls: Newton's method approaches the root from the left. Without
  // saturation the first step meets it.
  double x = 0.0;
  constexpr int most = 50;
  for (int i = 0; i < most; ++i) {
    const double step = (trial - three_G * x - stress(alpha + x)) / (three_G + slope(alpha + x));
    x += step;
    if (!(step > 1e-16 * x) || !(saturation_ > 0.0)) break;
  }
  return x;
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
