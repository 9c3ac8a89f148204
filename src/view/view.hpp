// The three-dimensional view of a run for its page.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "output/units.hpp"

namespace carom {

struct View {
  std::string json;  ///< all that view.js draws, safe inside a <script> element
  std::string note;  ///< what was left out to keep the page small; "" when nothing was
};

/// What the frames of a results folder do not tell.
struct ViewLabels {
  Units units;
  std::vector<std::string> parts;     ///< in their order in the case; "part 1" ... where there are fewer
  std::vector<std::string> contacts;  ///< likewise: of obstacles
  std::optional<double> opening{};    ///< the time at which the view opens, where one is known
};

/// Reads the index of the folder and its frames, as many of them as a page can hold: the outer surface, its motion and
/// all fields on it, quantised (numbers of 16 bits between the smallest and the largest of each component over all
/// times), differences in time, deflated. Until json is no longer than `most_bytes`: numbers of 12 bits, without
/// components of tensors, fewer times, fewer nodes. Nothing where there are no frames. Throws std::runtime_error for
/// frames that cannot be read.
std::optional<View> make_view(const std::string& folder, const ViewLabels& labels, std::size_t most_bytes);

}  // namespace carom
