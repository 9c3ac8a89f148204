#include "compare/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom::compare {

namespace {

/// The values without repetitions, or the one value "as the case says".
template <class T>
std::vector<std::optional<T>> values_of(const std::vector<T>& given) {
  std::vector<std::optional<T>> values;
  for (const T& value : given) {
    if (std::find(values.begin(), values.end(), std::optional<T>(value)) == values.end()) values.emplace_back(value);
  }
  if (values.empty()) values.emplace_back();
  return values;
}

/// Every choice with every value of one more member.
template <class T>
std::vector<Choice> crossed(const std::vector<Choice>& choices, std::optional<T> Choice::*member,
                            const std::vector<T>& given) {
  std::vector<Choice> all;
  for (const Choice& choice : choices) {
    for (const std::optional<T>& value : values_of(given)) {
      all.push_back(choice);
      all.back().*member = value;
    }
  }
  return all;
}

}  // namespace

std::vector<Choice> combinations(const Options& options) {
  std::vector<Choice> choices{Choice{}};
  choices = crossed(choices, &Choice::scheme, options.schemes);
  choices = crossed(choices, &Choice::enforcement, options.enforcements);
  choices = crossed(choices, &Choice::stiffness, options.stiffnesses);
  choices = crossed(choices, &Choice::cells, options.cells);
  choices = crossed(choices, &Choice::courant, options.courants);
  return crossed(choices, &Choice::refine, options.refinements);
}

Choice common_choice(const Options& options) {
  const auto only = [](const auto& given) {
    const auto values = values_of(given);
    return values.size() == 1 ? values.front() : std::nullopt;
  };
  return {only(options.schemes), only(options.enforcements), only(options.stiffnesses),
          only(options.cells),   only(options.courants),     only(options.refinements)};
}

Choice varied(Choice choice, const Choice& common) {
  if (common.scheme) choice.scheme.reset();
  if (common.enforcement) choice.enforcement.reset();
  if (common.stiffness) choice.stiffness.reset();
  if (common.cells) choice.cells.reset();
  if (common.courant) choice.courant.reset();
  if (common.refine) choice.refine.reset();
  return choice;
}

std::string label_of(const Choice& choice) {
  std::vector<std::string> words;
  for (const auto& kind : {choice.scheme, choice.enforcement}) {
    if (!kind) continue;
    words.push_back(*kind);
    std::replace(words.back().begin(), words.back().end(), ':', ' ');
  }
  if (choice.stiffness) words.push_back("stiffness " + *choice.stiffness);
  if (choice.cells) words.push_back(fmt::format("{} cells", *choice.cells));
  if (choice.courant) words.push_back(fmt::format("Courant {:g}", *choice.courant));
  if (choice.refine) words.push_back(fmt::format("refined {}", *choice.refine));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace carom::compare
