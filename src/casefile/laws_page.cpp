#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "casefile/schema.hpp"
#include "material/law.hpp"

namespace carom {

namespace {

std::string range_text(const Interval& range) {
  std::string text;
  if (std::isfinite(range.low)) text = fmt::format(">{} {:g}", range.is_closed_low ? "=" : "", range.low);
  if (std::isfinite(range.high))
    text += fmt::format("{}<{} {:g}", text.empty() ? "" : " and ", range.is_closed_high ? "=" : "", range.high);
  return text;
}

std::string default_text(const LawParameter& parameter) {
  if (!parameter.initial_phrase.empty()) return parameter.initial_phrase;
  return parameter.initial ? fmt::format("`{:g}`", *parameter.initial) : "**required**";
}

void write_law(const Law& law, std::string& text) {
  const bool is_small = law.measure == Measure::small_strain;
  fmt::format_to(std::back_inserter(text), "\n## {}\n\n{}{}. Its measure of deformation is the {} strain.\n\n{}\n",
                 law.name, static_cast<char>(std::toupper(law.summary.front())), law.summary.substr(1),
                 is_small ? "small" : "Green-Lagrange", law.formula);
  text += "\n| key | meaning | unit | range | default |\n|---|---|---|---|---|\n";
  for (const LawParameter& p : law.parameters)
    fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} | {} | {} |\n", p.key, p.meaning, name(p.unit),
                   range_text(p.range), default_text(p));
  if (!law.curve_key.empty())
    fmt::format_to(std::back_inserter(text), "| `{}` | {} |  |  | none |\n", law.curve_key, law.curve_meaning);
  if (!law.rates_key.empty())
    fmt::format_to(std::back_inserter(text), "| `{}` | {} |  |  | none |\n", law.rates_key, law.rates_meaning);
  if (law.history.empty()) return;
  text += "\nWhat a point remembers:";
  for (const std::string& variable : law.history)
    text += fmt::format("{} `{}`", &variable == &law.history.front() ? "" : ",", variable);
  text += ".\n";
}

}  // namespace

std::string laws_markdown() {
  std::string text =
      "# Constitutive laws\n\n<!-- Written from the table in src/material; do not edit. -->\n\n"
      "What `law` in `[materials.NAME]` names. All of them take every section: plane stress and bars are the law in\n"
      "three dimensions with the lateral strain solved for. `rho` is the density in the reference configuration; "
      "lambda "
      "= E nu /\n((1 + nu)(1 - 2 nu)) and G = E / (2 (1 + nu)) are Lame's constants, K = lambda + 2 G / 3. "
      "[notation.md](notation.md) has the other symbols.\n"
      "`carom material CASE --part NAME --path PATH` draws a law's stress on a path of deformation. Laws of your own "
      "come "
      "from libraries: [user_laws.md](user_laws.md).\n";
  for (const Law& law : laws()) write_law(law, text);
  return text;
}

}  // namespace carom
