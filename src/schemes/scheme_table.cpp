#include "schemes/scheme_table.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

namespace carom {

namespace {

const SchemeRow& row(SchemeKind kind) {
#define CAROM_SCHEME_ROW(scheme) scheme##_row(),
  static const std::array<SchemeRow, scheme_count> rows{CAROM_SCHEMES(CAROM_SCHEME_ROW)};
#undef CAROM_SCHEME_ROW
  return rows[static_cast<std::size_t>(kind)];
}

}  // namespace

std::unique_ptr<Scheme> make_scheme(const SchemeRequest& request) {
  return row(request.settings.kind).make(request);
}

std::string describe(const SchemeSettings& settings) {
  std::string text(title(settings.kind, settings.enforcement));
  for (const SchemeNumber& number : scheme_numbers) {
    if (const std::optional<double> value = number.value(settings.parameters))
      text += fmt::format(" {} {:g}", number.key, *value);
  }
  return text;
}

int parts_of_step(SchemeKind kind) {
  return row(kind).parts_of_step;
}

double stability_limit(const SchemeSettings& settings) {
  const auto limit = row(settings.kind).stability_limit;
  return limit != nullptr ? limit(settings.parameters) : std::numeric_limits<double>::infinity();
}

std::optional<double> touch_rebound(const SchemeSettings& settings) {
  const auto rebound = row(settings.kind).touch_rebound;
  if (rebound == nullptr || !traits(settings.enforcement).throws_back) return std::nullopt;
  return rebound(settings.parameters);
}

}  // namespace carom
