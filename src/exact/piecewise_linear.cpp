#include "exact/piecewise_linear.hpp"

#include <algorithm>
#include <cassert>

namespace carom {

void PiecewiseLinear::append(double begin, double value, double slope) {
  assert(begin >= pieces_.back().begin);
  pieces_.push_back({begin, value, slope, pieces_.back().integral_at(begin)});
}

const PiecewiseLinear::Piece& PiecewiseLinear::piece_at(double t) const {
  assert(t <= end_ * (1.0 + 1e-9));  // callers may add up their times
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), t,
                                      [](double time, const Piece& piece) { return time < piece.begin; });
  return *(after - 1);
}

std::vector<double> PiecewiseLinear::breaks(double from, double to) const {
  auto piece = std::upper_bound(pieces_.begin() + 1, pieces_.end(), from,
                                [](double time, const Piece& p) { return time < p.begin; });
  std::vector<double> found;
  for (; piece != pieces_.end() && piece->begin < to; ++piece) found.push_back(piece->begin);
  return found;
}

}  // namespace carom
