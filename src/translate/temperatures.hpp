// Temperatures at the start, and what tables of materials say at them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "translate/translation.hpp"

namespace carom {

/// [plastic strain, yield stress] in increasing order of the strains.
using HardeningCurve = std::vector<std::pair<double, double>>;

/// Of the parts of a material at the start, 0 of nodes that the deck gives none. Several are refused; accepted, the
/// lowest holds.
double initial_temperature(Translation& t, const std::string& material);

/// The first `most` values of a line, at least `least` of them, at the temperature of the material at the start: each
/// line is for the temperature behind them, and values in between are linear. Where steps change the temperature,
/// lines of several are refused unless accepted.
std::vector<double> values_at_start(Translation& t, const std::string& material, const DeckKeyword& keyword,
                                    std::size_t least, std::size_t most, const std::string& what);
/// The curve of *PLASTIC likewise, from lines of stress, strain, temperature.
HardeningCurve curve_at_start(Translation& t, const std::string& material, const DeckKeyword& plastic);

}  // namespace carom
