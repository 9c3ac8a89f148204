#include <fmt/format.h>

#include "casefile/schema.hpp"
#include "model/compatibility.hpp"

namespace carom {

std::string compatibility_markdown() {
  std::string text =
      "# Which scheme takes which contact\n\n"
      "Made from `src/model/compatibility.hpp`, from which the error messages and the tests come as well. `[scheme]\n"
      "enforcement` names the column; without it a case gets the first that its scheme takes, but the augmented\n"
      "Lagrangian where no stage takes springs and no contact gives its stiffness or is a stop.\n\n| scheme |";
  std::string line = "|---|";
  for (const std::string_view enforcement : enforcement_names) {
    text += fmt::format(" `{}` |", enforcement);
    line += ":-:|";
  }
  text += " |\n" + line + "---|\n";
  for (const SchemeTraits& scheme : scheme_table) {
    text += fmt::format("| `{}` |", scheme.name);
    for (const bool taken : scheme.takes.all()) text += taken ? " yes |" : " - |";
    text += is_explicit(scheme.kind) ? " explicit |\n" : " implicit |\n";
  }
  text += "\nElastic parts alone, without viscosity, distortion_control and ties that tear:";
  for (const SchemeTraits& scheme : scheme_table)
    if (!scheme.takes_history) text += fmt::format(" `{}`", scheme.name);
  text += ".\n\nNames of the literature, which a case may give as its `kind`:\n\n";
  for (const SchemeAlias& alias : scheme_aliases)
    text += fmt::format("- `{}`: `{}` with `enforcement = \"{}\"`.\n", alias.name, traits(alias.kind).name,
                        name(alias.enforcement));
  text += "\nWhy not:\n\n";
  for (const SchemeTraits& scheme : scheme_table) text += fmt::format("- `{}`: {}.\n", scheme.name, scheme.why_not);
  return text;
}

}  // namespace carom
