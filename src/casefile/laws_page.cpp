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

const char* const damage_text = R"(
## Damage

`damage = { D1 = ..., D2 = ..., ... }` in `[materials.NAME]` gives a law that yields, one of those above that remember
`equivalent_plastic_strain`, the damage of Johnson and Cook. A point remembers it as `damage` behind the law's own variables: 0
at rest, fracture at 1. It grows as d `damage` = d alpha / eps_f with the equivalent plastic strain alpha,

    eps_f = [D1 + D2 exp(D3 eta)] [1 + D4 ln(max(rate / reference_rate, 1))] [1 + D5 theta]

(G. R. Johnson and W. H. Cook, Eng. Fract. Mech. 21, 1985, pp. 31-48). eta is the mean over the von Mises stress at the end of the
step, tension positive: 1/3 in a bar under tension, 0 in shear, -1/3 under compression. D3 of metals is below 0, as in the paper;
Abaqus writes exp(-d3 eta). rate is that of alpha over the step. theta is that of johnson_cook, at the beginning of the step; laws
without a temperature take no D5. The keys are those of [materials.NAME.damage](case_format.md#materialsnamedamage).

- It is an indicator: the stress does not soften, and the damage may exceed 1. `[[erosion]]` lets the cells go whose points have
  reached a damage, and fields, probes and `carom material` have it by its name.
- Below reference_rate the rate has no influence, as in johnson_cook's yield stress; so it is in OpenRadioss, too.
- The formula holds for every eta. Under pressure it gives large strains at fracture, so that little damage grows; other programs
  let none grow below a limit of their own (Y. Bao and T. Wierzbicki, Eng. Fract. Mech. 72, 2005, find -1/3), with which the parameters of
  the formula have not been fitted. The paper uses it up to 1.5 and passes over to spall beyond, which is not done here.
- In a step the damage of a point grows by 1 at most. It does so where a point flows for which the formula gives no strain above that
  of the step: with D1 < 0 it comes to 0 and below at a high eta.
)";

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
  text += damage_text;
  return text;
}

}  // namespace carom
