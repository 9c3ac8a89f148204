#include "surface/node_query.hpp"

namespace carom {

bool NodeQuery::is_too_deep(Index f, double gap) const {
  if (is_behind) return false;
  if (gap < -range.depth[f]) return true;
  if (was_behind() || range.body.empty()) return false;
  if (range.body_of(node) != range.body_of(surface.facet(f)[0])) return false;
  return gap < -SearchRange::side_slack * facet_size(surface.placed(f)) && projection_at_begin(f).gap < 0.0;
}

double NodeQuery::rim_width(Index f) const {
  return range.width.empty() ? SearchRange::rim_slack * facet_size(surface.placed(f)) : range.width[f];
}

}  // namespace carom
