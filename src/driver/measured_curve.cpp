#include "driver/measured_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include "base/errors.hpp"

namespace carom {

namespace {

std::optional<double> number(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t\r");
  if (begin == std::string_view::npos) return std::nullopt;
  double value = 0.0;
  const char* const last = text.data() + end + 1;
  const auto [next, error] = std::from_chars(text.data() + begin, last, value);
  if (error != std::errc() || next != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Names of columns, or a row of numbers that went wrong?
bool has_number(std::string_view line) {
  for (std::size_t k = 0; k != std::string_view::npos; k = line.find_first_of(",;\t", k + 1)) {
    const std::size_t first = line.find_first_not_of(" \t,;+-.", k);
    if (first != std::string_view::npos && line[first] >= '0' && line[first] <= '9') return true;
  }
  return false;
}

std::optional<std::array<double, 2>> pair(std::string_view line) {
  const std::size_t comma = line.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto strain = number(line.substr(0, comma)), stress = number(line.substr(comma + 1));
  if (!strain || !stress) return std::nullopt;
  return std::array{*strain, *stress};
}

}  // namespace

MeasuredCurve read_measured(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) throw CaseError({}, "--measured", fmt::format("\"{}\"", path), "a file that can be read");
  MeasuredCurve curve;
  std::string line;
  bool may_be_names = true;
  for (int row = 1; std::getline(stream, line); ++row) {
    if (line.starts_with("#") || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto point = pair(line);
    if (point) {
      curve.strain.push_back((*point)[0]);
      curve.stress.push_back((*point)[1]);
    } else if (!may_be_names || has_number(line)) {
      throw CaseError({path, row, 0}, "", fmt::format("\"{}\"", line), "two numbers: strain,stress");
    }
    may_be_names = false;
  }
  if (curve.strain.empty())
    throw CaseError({path, 0, 0}, "", "no row of numbers", "rows of two numbers: strain,stress");
  return curve;
}

double rms_difference(const MeasuredCurve& measured, std::span<const double> strain, std::span<const double> stress) {
  const double sense = strain.size() > 1 && strain[1] < strain[0] ? -1.0 : 1.0;  // compression
  std::size_t rising = 1;
  while (rising < strain.size() && sense * strain[rising] > sense * strain[rising - 1]) ++rising;
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < measured.strain.size(); ++i) {
    const double x = measured.strain[i];
    if (rising < 2 || sense * x < sense * strain[0] || sense * x > sense * strain[rising - 1]) continue;
    const auto nearer = [&](double a, double b) { return sense * a < sense * b; };
    const auto first = strain.begin() + 1, last = strain.begin() + static_cast<std::ptrdiff_t>(rising);
    const auto k =
        static_cast<std::size_t>(std::min(std::lower_bound(first, last, x, nearer), last - 1) - strain.begin());
    const double share = (x - strain[k - 1]) / (strain[k] - strain[k - 1]);
    const double difference = stress[k - 1] + share * (stress[k] - stress[k - 1]) - measured.stress[i];
    sum += difference * difference;
    ++count;
  }
  return std::sqrt(sum / count);
}

}  // namespace carom
