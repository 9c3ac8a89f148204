#include "advise/locking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "advise/cell_columns.hpp"
#include "advise/simplex_layers.hpp"
#include "base/types.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "parallel/threads.hpp"
#include "solid/cell_values.hpp"
#include "solid/element_table.hpp"
#include "solid/node_patches.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

namespace {

/// Along which directions a part is thin: the mean of t t^T over its thin cells, t along their thickness.
class Thinness {
 public:
  void add(const Vec3& t, double volume) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum_[i][j] += volume * t[i] * t[j];
    volume_ += volume;
  }
  /// Square of the share of a vector that is along the thickness, a mean over the part.
  double share_of(const Vec3& f) const {
    double along = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) along += f[i] * sum_[i][j] * f[j];
    const double square = dot(f, f) * volume_;
    return square > 0.0 ? along / square : 0.0;
  }
  /// More than a twentieth of it.
  bool is_along(const Vec3& f) const { return share_of(f) > 0.0025; }

 private:
  double sum_[3][3]{};
  double volume_ = 0.0;
};

/// Does anything push or carry along the thickness of a part?
class Actions {
 public:
  Actions(const Simulation& s, const Thinness& thinness) : s_(s), thin_(thinness) {}

  bool any() const {
    const Model& model = s_.model();
    const auto loads = [&](const Load& load) { return std::visit([&](const auto& l) { return pushes(l); }, load); };
    const auto touches = [&](const ContactDefinition& contact) { return pushes(parts_of(contact)); };
    return std::any_of(model.loads.begin(), model.loads.end(), loads) || is_moved(false) ||
           (flies() && is_moved(true)) || std::any_of(model.contacts.begin(), model.contacts.end(), touches);
  }

 private:
  bool pushes(const NodalForce& load) const { return thin_.is_along(load.force); }
  bool pushes(const Pressure& load) const { return faces(load.surface); }
  bool pushes(const Gravity& load) const { return thin_.is_along(load.acceleration); }

  bool faces(const Surface& surface) const {
    return std::any_of(surface.facets.begin(), surface.facets.end(), [&](const Facet& facet) {
      if (facet.size == 1) return false;
      const PlacedFacet placed = place(facet, s_.mesh().coordinates);
      const ParentPoint centre = facet_centre(facet.size);
      constexpr double third = 0.1;  // square of the cosine: 70 degrees off the thickness at most
      return thin_.share_of(facet_frame(placed, centre.xi, centre.eta).normal) > third;
    });
  }

  /// Does a contact push along the thickness: by the normal of its plane or stop, or by its facets?
  bool pushes(const ContactParts& contact) const {
    if (contact.nature == ContactNature::bonds) return false;
    if (contact.direction) return thin_.is_along(*contact.direction);
    if (contact.own == nullptr || !flies()) return false;
    return faces(*contact.own) || (contact.other != nullptr && faces(*contact.other));
  }

  /// Is a component along the thickness imposed somewhere: as zero, or as a motion?
  bool is_moved(bool as_zero) const {
    const std::vector<PrescribedMotion>& motions = s_.model().motions;
    return std::any_of(motions.begin(), motions.end(), [&](const PrescribedMotion& motion) {
      Vec3 direction{};
      direction[at(motion.component)] = 1.0;
      return is_zero(motion.function.value) == as_zero && thin_.is_along(direction);
    });
  }
  bool flies() const {
    const std::vector<InitialState>& initial = s_.model().initial;
    return std::any_of(initial.begin(), initial.end(), [&](const InitialState& i) {
      return std::any_of(i.velocity.begin(), i.velocity.end(), [&](const Vec3& v) { return thin_.is_along(v); });
    });
  }

  const Simulation& s_;
  const Thinness& thin_;
};

/// Which components of the nodes never move.
std::vector<std::array<bool, 3>> held_components(const Simulation& s) {
  std::vector<std::array<bool, 3>> held(s.mesh().node_count());
  for (const PrescribedMotion& motion : s.model().motions) {
    if (!is_zero(motion.function.value)) continue;
    for (const Index n : motion.nodes) held[at(n)][at(motion.component)] = true;
  }
  return held;
}

/// One cell's place in a thin part, and how much too stiff its bending is.
struct Thin {
  Vec3 direction{};               ///< along the thickness
  int cells = 1;                  ///< through it
  double length_to_height = 1.0;  ///< of the cell along the bending, to the thickness
  double ratio = 1.0;
};

/// How far a ratio is from 1, either way.
double excess(double ratio) {
  return std::abs(std::log(ratio));
}

class Examiner {
 public:
  explicit Examiner(const Simulation& s) : s_(s), columns_(s.mesh(), s.solid()), held_(held_components(s)) {}

  /// The ways through a cell that are thin: one of a plate, two of a rod.
  std::vector<Thin> thin(std::size_t k, const Part& part) const {
    constexpr double slender = 5.0;
    std::vector<Thin> found;
    for (int across = 0; across < columns_.dimension(k); ++across) {
      const CellColumn& through = columns_.column(k, across);
      std::vector<int> spans;
      for (int axis = 0; axis < columns_.dimension(k); ++axis)
        if (columns_.column(k, axis).length >= slender * through.length) spans.push_back(axis);
      if (spans.empty() || is_held(through)) continue;
      const bool is_plate =
          spans.size() == 2 || part.section == Section::plane_strain || part.section == Section::axisymmetric;
      Thin& way = found.emplace_back(Thin{through.direction, through.cells, 0.0, 1.0});
      for (const int axis : spans) {
        way.length_to_height = std::max(way.length_to_height, columns_.length(k, axis) / through.length);
        const double n = through.cells, ratio = 1.0 + (quotient(k, part, across, axis, is_plate) - 1.0) / (n * n);
        if (excess(ratio) > excess(way.ratio)) way.ratio = ratio;
      }
    }
    return found;
  }

  /// Fewest cells across the body at cell k, of the ways that are not held.
  int fewest_across(std::size_t k) const {
    int fewest = std::numeric_limits<int>::max();
    for (int axis = 0; axis < columns_.dimension(k); ++axis) {
      const CellColumn& through = columns_.column(k, axis);
      if (std::isfinite(through.length) && !is_held(through)) fewest = std::min(fewest, through.cells);
    }
    return fewest;
  }

 private:
  /// R of cell k (locking.hpp), bent along one axis, thin along another.
  double quotient(std::size_t k, const Part& part, int thin_axis, int long_axis, bool is_plate) const {
    const IsotropicElastic at_rest = part.material.at_rest();
    const double nu = at_rest.nu, across = is_plate ? nu / (1.0 - nu) : nu;
    const double modulus = is_plate ? at_rest.E / (1.0 - nu * nu) : at_rest.E;
    const std::span<const Index> nodes = s_.solid().cells().nodes_of(k);
    const Vec3 t = columns_.direction(k, thin_axis), along = columns_.direction(k, long_axis);
    const Vec3 a = normalized(subtract(along, scaled(t, dot(along, t)))), w = cross(t, a);
    Vec3 centre{};
    for (const Index n : nodes)
      centre = add(centre, scaled(s_.mesh().coordinates[at(n)], 1.0 / static_cast<double>(nodes.size())));
    std::vector<double> height;
    for (const Index n : nodes) height.push_back(dot(subtract(s_.mesh().coordinates[at(n)], centre), t));
    // The width of a strip contracts by c y, as its cells want it.
    const auto energy = [&](double c) {
      std::vector<Vec3> u;
      for (const Index n : nodes) {
        const Vec3 place = subtract(s_.mesh().coordinates[at(n)], centre);
        const double x = dot(place, a), y = dot(place, t), z = is_plate ? 0.0 : dot(place, w);
        const double deflection = 0.5 * (x * x + across * y * y - c * z * z);
        u.push_back(add(add(scaled(a, -x * y), scaled(t, deflection)), scaled(w, c * y * z)));
      }
      return energy_at_rest(s_.solid(), k, u);
    };
    double least = energy(0.0);
    if (!is_plate) {
      const double up = energy(1.0), down = energy(-1.0), slope = 0.5 * (up - down), bend = 0.5 * (up + down) - least;
      if (bend > 0.0) least -= 0.25 * slope * slope / bend;
    }
    return 2.0 * least / (modulus * square_integral(s_.solid(), k, height));
  }
  /// A plane of symmetry at one end keeps a column from bending.
  bool is_held(const CellColumn& column) const {
    for (std::size_t c = 0; c < 3; ++c) {
      constexpr double along = 0.99;
      if (std::abs(column.direction[c]) < along) continue;
      const auto is_held_node = [&](Index n) { return held_[at(n)][c]; };
      for (const Facet* face : {&column.first, &column.last})
        if (std::all_of(face->begin(), face->end(), is_held_node)) return true;
    }
    return false;
  }

  const Simulation& s_;
  CellColumns columns_;
  std::vector<std::array<bool, 3>> held_;
};

/// The thin ways through a part that lie nearest to one axis.
struct Way {
  Thinness thinness;
  double volume = 0.0;
  double ratio_sum = 0.0;  ///< times volume
  Thin example;            ///< the worst
};

/// What is known of one part after a look at all of its cells.
struct Findings {
  double volume = 0.0;
  std::array<Way, 3> ways;  ///< along x, y and z
  int fewest = std::numeric_limits<int>::max();

  void add(const Thin& thin, double of_volume) {
    std::size_t along = 0;
    for (std::size_t c = 1; c < 3; ++c)
      if (std::abs(thin.direction[c]) > std::abs(thin.direction[along])) along = c;
    Way& way = ways[along];
    way.volume += of_volume;
    way.ratio_sum += of_volume * thin.ratio;
    way.thinness.add(thin.direction, of_volume);
    if (excess(thin.ratio) >= excess(way.example.ratio)) way.example = thin;
  }
};

/// How a part bends: the means over the ways along which something acts, where these hold most of it.
struct Bending {
  double ratio = 1.0;
  Thin example;
};
std::optional<Bending> bending(const Simulation& s, const Findings& found) {
  double volume = 0.0, sum = 0.0;
  Bending out;
  for (const Way& way : found.ways) {
    if (way.volume == 0.0 || !Actions(s, way.thinness).any()) continue;
    volume += way.volume;
    sum += way.ratio_sum;
    if (excess(way.example.ratio) >= excess(out.example.ratio)) out.example = way.example;
  }
  if (!(volume > 0.5 * found.volume)) return std::nullopt;
  out.ratio = sum / volume;
  return out;
}

bool is_nodal(const Part& part) {
  return find_element(part.type, part.section, part.formulation)->formulation == Formulation::nodal;
}

std::string_view bending_remedy(const Part& part) {
  if (is_nodal(part)) return "Take two or more cells through the thickness, HEXA8, or TETRA10";
  if (part.type == CellType::tetra4) return "Take formulation = \"nodal\", HEXA8, or TETRA10";
  if (find_element(part.type, part.section, part.formulation)->formulation == Formulation::stabilised)
    return "Its cells are distorted across the bending, or hourglass is not 1: take straighter ones, or more";
  return "Leave the formulation out: stabilised cells bend as the body does";
}

/// What messages call Model::parts[p]; the cells of one of the types of a part by it.
std::string title(const Model& model, std::size_t p) {
  const std::vector<Index> numbers = model.part_numbers();
  const Part& part = model.parts[p];
  return std::count(numbers.begin(), numbers.end(), numbers[p]) == 1
             ? fmt::format("part \"{}\"", part.name)
             : fmt::format("part \"{}\" ({})", part.name, name(part.type));
}

std::string bending_warning(const std::string& who, const Part& part, const Bending& bent) {
  const Thin& example = bent.example;
  const double ratio = bent.ratio;
  const Formulation formulation = find_element(part.type, part.section, part.formulation)->formulation;
  const bool is_stiff = ratio > 1.0;
  return fmt::format(
      "{} {}: about {:.2g} times too {} (deflections come out at {:.3g} %), with {} cell{} of formulation "
      "\"{}\" through its thickness, up to {:.2g} times as long as it is thick, nu = {:g}. {}. Fields and probes "
      "show the mean stress of a cell, {:.2g} % of what bending makes at the surface",
      who, is_stiff ? "will lock where it bends" : "bends too easily", is_stiff ? ratio : 1.0 / ratio,
      is_stiff ? "stiff" : "soft", 100.0 / ratio, example.cells, example.cells == 1 ? "" : "s", name(formulation),
      example.length_to_height, part.material.at_rest().nu, bending_remedy(part), 100.0 * (1.0 - 1.0 / example.cells));
}

std::string volume_warning(const std::string& who, const Part& part, int cells, double ratio) {
  const double nu = part.material.at_rest().nu;
  return fmt::format(
      "{}: nu = {:g} is nearly incompressible, and fully integrated cells lock where shape changes at "
      "constant volume: with {} cell{} across, bending and bulging may come out up to {:.2g} times too stiff. Leave "
      "the formulation out, or take nu = 0.49 and less where the compressibility does not matter",
      who, nu, cells, cells == 1 ? "" : "s", ratio);
}

bool is_fully_integrated(const Part& part) {
  return find_element(part.type, part.section, part.formulation)->formulation == Formulation::full;
}

/// Too few freedoms a cell to move at constant volume: one strain per cell, where the body yields or is nearly
/// incompressible; full integration of the other linear cells, where it yields.
bool locks_at_constant_volume(const Part& part) {
  constexpr double incompressible = 0.4;
  if (part.section == Section::plane_stress || part.section == Section::bar) return false;
  const bool yields = !part.material.law->history.empty();
  if (part.type == CellType::tetra4 || part.type == CellType::tria3)
    return is_fully_integrated(part) && (yields || part.material.at_rest().nu > incompressible);
  return yields && node_count(part.type) == corner_count(part.type) && is_fully_integrated(part);
}

/// What helps tetrahedra and triangles of one strain each.
std::string remedy_of_simplex(const Part& part, const Mesh& mesh) {
  const Valence valence = largest_valence(mesh, part.type, part.cells);
  if (valence.is_within_patch()) return "leave the formulation out: nodal cells do not";
  return fmt::format(
      "mesh the part without the fan about node {}, which has {} neighbours and {} cells where nodal cells "
      "have at most {} and {}",
      mesh.node_label(valence.node), valence.neighbours, valence.cells, most_neighbours, most_patch_cells);
}

std::string constant_volume_warning(const Part& part, const Mesh& mesh) {
  const bool is_simplex = part.type == CellType::tetra4 || part.type == CellType::tria3;
  const char* other =
      dimension(part.type) == 3 ? "take HEXA8 without a formulation or TETRA10" : "take QUAD4 without a formulation";
  return fmt::format(
      "part \"{}\": {} cells {} lock where shape changes at constant volume, as it does {}: {}, or results will be "
      "too stiff",
      part.name, name(part.type), is_simplex ? "have one strain each and" : "in full integration",
      part.material.law->history.empty() ? "near nu = 0.5" : "in plastic flow",
      is_simplex ? remedy_of_simplex(part, mesh) : other);
}

/// What is found of every part.
std::vector<Findings> examine(const Simulation& s) {
  const Examiner examiner(s);
  const std::vector<std::vector<SimplexLayer>> simplex = simplex_layers(s.model(), held_components(s));
  std::vector<Findings> all(s.model().parts.size());
  std::size_t k = 0;  // the solid has the cells part after part
  for (std::size_t p = 0; p < all.size(); ++p) {
    const Part& part = s.model().parts[p];
    Findings& found = all[p];
    const bool has_columns = part.section != Section::bar && node_count(part.type) == corner_count(part.type);
    for (const std::size_t end = k + part.cells.size(); k < end; ++k) {
      if (!has_columns) continue;
      const double volume = s.solid().cells().volumes[k];
      found.volume += volume;
      if (part.section != Section::plane_stress) found.fewest = std::min(found.fewest, examiner.fewest_across(k));
      for (const Thin& thin : examiner.thin(k, part)) found.add(thin, volume);
    }
    for (const SimplexLayer& layer : simplex[p]) {
      const double edge = layer.edge_to_thickness;
      const int cells = std::max(1, static_cast<int>(std::lround(1.0 / edge)));
      found.add({layer.direction, cells, edge, simplex_bending_ratio(edge, is_nodal(part))}, layer.volume);
    }
  }
  return all;
}

}  // namespace

double volume_stiffness_ratio(int cells, double nu) {
  const double n = cells;
  return 1.0 + ((1.0 - nu) * (1.0 - nu) / (1.0 - 2.0 * nu) - 1.0) / (n * n);
}

std::vector<std::optional<double>> bending_stiffness_ratios(const Simulation& simulation) {
  std::vector<std::optional<double>> out;
  for (const Findings& found : examine(simulation)) {
    const std::optional<Bending> bent = bending(simulation, found);
    out.push_back(bent ? std::optional(bent->ratio) : std::nullopt);
  }
  return out;
}

std::vector<Doubt> locking_doubts(const Simulation& s) {
  const std::vector<Findings> all = examine(s);
  std::vector<Doubt> out;
  for (std::size_t p = 0; p < all.size(); ++p) {
    constexpr double bulged_too_stiff = 1.5;
    const Part& part = s.model().parts[p];
    const std::string who = title(s.model(), p);
    if (locks_at_constant_volume(part))
      out.push_back({who + " locks at constant volume", constant_volume_warning(part, s.mesh())});
    const Findings& found = all[p];
    const std::optional<Bending> bent = bending(s, found);
    if (bent && excess(bent->ratio) > std::log(1.1)) {
      const bool is_stiff = bent->ratio > 1.0;
      out.push_back({fmt::format("{} bends about {:.2g} times too {}", who, is_stiff ? bent->ratio : 1.0 / bent->ratio,
                                 is_stiff ? "stiffly" : "easily"),
                     bending_warning(who, part, *bent)});
      continue;
    }
    if (found.fewest == std::numeric_limits<int>::max() || !is_fully_integrated(part)) continue;
    const double bulging = volume_stiffness_ratio(found.fewest, part.material.at_rest().nu);
    if (bulging > bulged_too_stiff)
      out.push_back({who + " locks at constant volume", volume_warning(who, part, found.fewest, bulging)});
  }
  return out;
}

}  // namespace carom
