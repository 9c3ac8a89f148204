#include "run/locking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/types.hpp"
#include "contact/facet_geometry.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "run/cell_columns.hpp"
#include "solid/element_table.hpp"

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

bool is_zero(const TimeFunction& f) {
  return std::all_of(f.value.begin(), f.value.end(), [](double v) { return v == 0.0; });
}

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
      return is_zero(motion.function) == as_zero && thin_.is_along(direction);
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
    if (!is_zero(motion.function)) continue;
    for (const Index n : motion.nodes) held[at(n)][at(motion.component)] = true;
  }
  return held;
}

/// One cell's place in a thin part: its bending and how much too stiff that is.
struct Thin {
  Vec3 direction{};
  BentLayer layer;
  double ratio = 1.0;
};

class Examiner {
 public:
  explicit Examiner(const Simulation& s) : s_(s), columns_(s.mesh(), s.solid()), held_(held_components(s)) {}

  /// The thinnest way through a cell, if it is thin.
  std::optional<Thin> thin(std::size_t k, const Part& part) const {
    constexpr double slender = 5.0;
    int thickness = 0;
    for (int axis = 1; axis < columns_.dimension(k); ++axis)
      if (columns_.column(k, axis).length < columns_.column(k, thickness).length) thickness = axis;
    const CellColumn& through = columns_.column(k, thickness);
    double length = 0.0;
    int spans = 0;
    for (int axis = 0; axis < columns_.dimension(k); ++axis) {
      if (columns_.column(k, axis).length < slender * through.length) continue;
      length = std::max(length, columns_.length(k, axis));
      ++spans;
    }
    if (spans == 0 || is_held(through)) return std::nullopt;
    Thin found{through.direction, {through.cells, length / through.length, part.material.at_rest().nu}, 1.0};
    const bool is_plate = spans == 2 || part.section == Section::plane_strain || part.section == Section::axisymmetric;
    found.ratio = is_plate ? plate_stiffness_ratio(found.layer) : strip_stiffness_ratio(found.layer);
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

/// What is known of one part after a look at all of its cells.
struct Findings {
  Thinness thinness;
  double volume = 0.0, thin_volume = 0.0;
  double ratio_sum = 0.0;  ///< over thin cells, times volume
  Thin example;            ///< the stiffest
  int fewest = std::numeric_limits<int>::max();
};

/// Cells through the thickness that leave a tenth of too much stiffness to the strain across it.
int enough_cells(double nu) {
  const double excess = plate_stiffness_ratio({1, 0.0, nu}) - 1.0;
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(excess / 0.1))));
}

std::string bending_warning(const Part& part, const Findings& found, double ratio) {
  const BentLayer& layer = found.example.layer;
  return fmt::format(
      "part \"{}\" will lock where it bends: about {:.2g} times too stiff (deflections come out at {:.2g} %), with {} "
      "cell{} through its thickness that {} up to {:.2g} times as long as it is thick, nu = {:g}. Fully integrated "
      "cells "
      "want a length of at most half of the thickness, and {} cell{} through it",
      part.name, ratio, 100.0 / ratio, layer.cells, layer.cells == 1 ? "" : "s", layer.cells == 1 ? "is" : "are",
      layer.length_to_height, layer.nu, enough_cells(layer.nu), enough_cells(layer.nu) == 1 ? "" : "s");
}

std::string volume_warning(const Part& part, int cells, double ratio) {
  const double nu = part.material.at_rest().nu;
  return fmt::format(
      "part \"{}\": nu = {:g} is nearly incompressible, and fully integrated cells lock where shape changes at "
      "constant "
      "volume: with {} cell{} across, bending and bulging may come out up to {:.2g} times too stiff. Take more cells, "
      "or nu = 0.49 and less where the compressibility does not matter",
      part.name, nu, cells, cells == 1 ? "" : "s", ratio);
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
    return yields || part.material.at_rest().nu > incompressible;
  return yields && node_count(part.type) == corner_count(part.type) && is_fully_integrated(part);
}

std::string constant_volume_warning(const Part& part) {
  const bool is_simplex = part.type == CellType::tetra4 || part.type == CellType::tria3;
  return fmt::format(
      "part \"{}\": {} cells {} lock where shape changes at constant volume, as it does {}: take {}, or results will "
      "be "
      "too stiff",
      part.name, name(part.type), is_simplex ? "have one strain each and" : "in full integration",
      part.material.law->history.empty() ? "near nu = 0.5" : "in plastic flow",
      dimension(part.type) == 3
          ? "TETRA10 (Gmsh: Mesh.ElementOrder = 2) or HEXA8 without a formulation"
          : "QUAD4 without a formulation");
}

}  // namespace

double plate_stiffness_ratio(const BentLayer& layer) {
  const double n = layer.cells, nu = layer.nu, a = layer.length_to_height;
  return 1.0 + ((1.0 - nu) * (1.0 - nu) / (1.0 - 2.0 * nu) - 1.0) / (n * n) + 0.5 * (1.0 - nu) * a * a;
}

double strip_stiffness_ratio(const BentLayer& layer) {
  const double n = layer.cells, nu = layer.nu, a = layer.length_to_height;
  return 1.0 + (1.0 / (1.0 - nu * nu) - 1.0) / (n * n) + a * a / (2.0 * (1.0 + nu));
}

std::vector<std::string> locking_warnings(const Simulation& s) {
  const Examiner examiner(s);
  std::vector<Findings> all(s.model().parts.size());
  std::vector<std::vector<Index>> part_of(s.mesh().blocks.size());
  for (std::size_t b = 0; b < part_of.size(); ++b) part_of[b].assign(s.mesh().blocks[b].size(), -1);
  for (std::size_t p = 0; p < all.size(); ++p) {
    const Part& part = s.model().parts[p];
    const auto block = static_cast<std::size_t>(s.mesh().block(part.type) - s.mesh().blocks.data());
    for (const Index cell : part.cells) part_of[block][at(cell)] = static_cast<Index>(p);
  }
  for (std::size_t k = 0; k < s.solid().cell_count(); ++k) {
    const CellRef& cell = s.solid().cells()[k];
    const std::size_t p = at(part_of[at(cell.block)][at(cell.cell)]);
    const Part& part = s.model().parts[p];
    if (part.section == Section::bar || !is_fully_integrated(part)) continue;
    Findings& found = all[p];
    const double volume = s.solid().cell_volumes()[k];
    found.volume += volume;
    if (part.section != Section::plane_stress) found.fewest = std::min(found.fewest, examiner.fewest_across(k));
    const std::optional<Thin> thin = examiner.thin(k, part);
    if (!thin) continue;
    found.thin_volume += volume;
    found.ratio_sum += volume * thin->ratio;
    found.thinness.add(thin->direction, volume);
    if (thin->ratio > found.example.ratio) found.example = *thin;
  }
  std::vector<std::string> out;
  for (std::size_t p = 0; p < all.size(); ++p) {
    constexpr double bent_too_stiff = 1.1, bulged_too_stiff = 1.5;
    const Part& part = s.model().parts[p];
    if (locks_at_constant_volume(part)) out.push_back(constant_volume_warning(part));
    const Findings& found = all[p];
    const double ratio = found.thin_volume > 0.0 ? found.ratio_sum / found.thin_volume : 1.0;
    const bool is_bent = found.thin_volume > 0.5 * found.volume && Actions(s, found.thinness).any();
    if (is_bent && ratio > bent_too_stiff) {
      out.push_back(bending_warning(part, found, ratio));
      continue;
    }
    if (found.fewest == std::numeric_limits<int>::max()) continue;
    const double bulging = plate_stiffness_ratio({found.fewest, 0.0, part.material.at_rest().nu});
    if (bulging > bulged_too_stiff) out.push_back(volume_warning(part, found.fewest, bulging));
  }
  return out;
}

}  // namespace carom
