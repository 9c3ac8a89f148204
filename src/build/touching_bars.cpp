#include "build/touching_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/types.hpp"

namespace carom {

std::vector<BarSide> touching_bars(const Mesh& mesh, const Groups& groups, const Parts& parts,
                                   const Located<std::string>& group, const std::string& key,
                                   const std::optional<Located<double>>& radius) {
  std::vector<bool> is_named(mesh.node_count()), is_end(mesh.node_count());
  for (const Index n : groups.nodes(group, key)) is_named[at(n)] = true;
  const auto named = [&](Index n) { return static_cast<bool>(is_named[at(n)]); };
  bool has_faces = false;
  for (const OuterFacet& outer : *groups.outer_facets()) {
    if (outer.facet.size == 1)
      is_end[at(outer.facet[0])] = true;
    else
      has_faces = has_faces || std::all_of(outer.facet.begin(), outer.facet.end(), named);
  }
  std::vector<BarSide> bars;
  bool ends_alone = true;
  for (std::size_t p = 0; p < parts.parts().size(); ++p) {
    const Part& part = parts.parts()[p];
    if (part.section != Section::bar) continue;
    for (const Index cell : part.cells) {
      const std::span<const Index> nodes = mesh.block(part.type)->nodes(cell);
      if (!named(nodes[0]) || !named(nodes[1])) continue;
      ends_alone = ends_alone && is_end[at(nodes[0])] && is_end[at(nodes[1])];
      bars.push_back({{nodes[0], nodes[1]},
                      radius ? **radius : std::sqrt(part.thickness / std::numbers::pi),
                      static_cast<Index>(p)});
    }
  }
  if (radius && (bars.empty() || has_faces)) {
    throw CaseError(
        radius->where, "contact.bar_radius",
        fmt::format("\"{}\", {}", *group, bars.empty() ? "which holds no bar" : "which holds faces as well"),
        "a group of bars alone", "Contacts of faces and of bars are two [[contact]] sections.");
  }
  if (!radius && (ends_alone || has_faces)) bars.clear();
  return bars;
}

}  // namespace carom
